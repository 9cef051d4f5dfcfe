// Nests instance files within a budget and checks every layout again with the independent checker. It prints
// a table in markdown: a line for each file and seed, and means where there are several seeds.
//
//   bench_nest [--cpu SECONDS | --work N] [--seeds 1,2,3] [--threads N] [--angles N] [--save FOLDER]
//              [--scale 50,200,1000,5000] FILE...
//
// --scale makes orders of so many pieces: 20 polygons of 4 to 9 corners, 20 to 120 mm across, at four angles,
// with a gap of 1 mm, on a strip 1,000 mm wide.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/workspace.hpp"
#include "lekalo/nest/nest.hpp"
#include "lekalo/verify/layout.hpp"

namespace {

using namespace lekalo;

struct Words {
  double cpu_seconds = 60;
  std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> seeds = {1};
  unsigned threads = 2;
  std::size_t angles = 24;
  std::string save;
  std::vector<std::uint64_t> scale;
  std::vector<std::string> files;
};

[[noreturn]] void refuse(const std::string& sentence) {
  fmt::print(stderr, "bench_nest: {}\n", sentence);
  std::exit(2);
}

std::vector<std::uint64_t> numbers_of(const std::string& value) {
  std::vector<std::uint64_t> numbers;
  for (std::size_t at = 0; at < value.size(); at = value.find_first_of("0123456789", at)) {
    std::size_t used = 0;
    numbers.push_back(std::stoull(value.substr(at), &used));
    at += used;
  }
  return numbers;
}

Words words_of(int argc, char** argv) {
  Words words;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (!word.starts_with("--")) {
      words.files.push_back(word);
      continue;
    }
    if (++k == argc) refuse(word + " needs a value");
    const std::string value = argv[k];
    if (word == "--cpu") {
      words.cpu_seconds = std::strtod(value.c_str(), nullptr);
    } else if (word == "--work") {
      words.work = std::strtoull(value.c_str(), nullptr, 10);
      words.cpu_seconds = std::numeric_limits<double>::infinity();
    } else if (word == "--threads") {
      words.threads = static_cast<unsigned>(std::strtoul(value.c_str(), nullptr, 10));
    } else if (word == "--angles") {
      words.angles = std::strtoul(value.c_str(), nullptr, 10);
    } else if (word == "--save") {
      words.save = value;
    } else if (word == "--seeds") {
      words.seeds = numbers_of(value);
    } else if (word == "--scale") {
      words.scale = numbers_of(value);
    } else {
      refuse("unknown option " + word);
    }
  }
  if (words.files.empty() && words.scale.empty()) refuse("no files");
  if (!(words.cpu_seconds > 0) || words.work == 0 || words.threads == 0 || words.seeds.empty())
    refuse("budgets, threads and seeds are positive numbers");
  return words;
}

double processor_seconds() {
  timespec at{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

layout::Document order_of(std::uint64_t pieces) {
  constexpr std::uint64_t kParts = 20;
  constexpr double kHeight = 1000, kSmallest = 20, kLargest = 120;
  Random random(pieces, 1);
  layout::Document document;
  document.name = fmt::format("{} pieces", pieces);
  document.rules.gap = geom::grid_from_mm(1);
  const auto outline_of = [](std::vector<geom::GridPoint> loop) {
    layout::Outline outline;
    outline.polygon = *geom::make_grid_region({std::move(loop)});
    return outline;
  };
  const auto point = [](double x, double y) {
    return geom::GridPoint{geom::grid_from_mm(x), geom::grid_from_mm(y)};
  };
  for (std::uint64_t p = 0; p < kParts; ++p) {
    layout::Part part;
    part.id = fmt::format("part {}", p);
    part.rotations = {{0, 0}, {90, 90}, {180, 180}, {270, 270}};
    part.demand = static_cast<std::int64_t>((pieces + kParts - 1 - p) / kParts);
    const std::uint64_t corners = 4 + random.below(6);
    const double radius = 0.5 * random.uniform(kSmallest, kLargest);
    std::vector<geom::GridPoint> loop;
    for (std::uint64_t k = 0; k < corners; ++k) {
      const double turn = 6.283185307179586 * static_cast<double>(k) / static_cast<double>(corners);
      const double far = radius * random.uniform(0.5, 1);
      loop.push_back(point(far * std::cos(turn), far * std::sin(turn)));
    }
    part.outline = outline_of(std::move(loop));
    document.parts.push_back(std::move(part));
  }
  layout::Stock strip;
  strip.id = "strip";
  strip.kind = layout::StockKind::strip;
  strip.open_length = true;
  const double length = geom::mm_from_grid(layout::kLongestStrip);
  strip.outline = outline_of({point(0, 0), point(length, 0), point(length, kHeight), point(0, kHeight)});
  document.stocks = {strip};
  return document;
}

/// The figures of one run.
struct Figures {
  /// Per cent of the material of the stock in use, less holes; of a strip up to its used length.
  double density = 0;
  double length = 0;  ///< of a strip, mm
  double sheets = 0;  ///< in use
  /// The rest of the sheet with the smallest box, from its corner, around its parts, mm^2.
  double leftover = 0;
  double placed = 0, wanted = 0;
  double kits = 0;
  double first = 0;  ///< processor seconds to the first valid layout
  double seconds = 0;
  double work = 0;
  bool fine = true;
};

double leftover_of(const layout::Document& document) {
  std::map<layout::Sheet, geom::GridPoint> reach;
  for (const layout::Placement& p : document.placements) {
    const geom::GridBox box = geom::bounds(placed_outline(document.parts[p.part], p));
    geom::GridPoint& far = reach[{p.stock, p.copy}];
    far = {std::max(far.x, box.high.x), std::max(far.y, box.high.y)};
  }
  double most = 0;
  for (const auto& [sheet, far] : reach) {
    const geom::GridBox box = geom::bounds(document.stocks[sheet.stock].outline.polygon);
    const auto area = [&](geom::GridPoint high) {
      return geom::mm_from_grid(high.x - box.low.x) * geom::mm_from_grid(high.y - box.low.y);
    };
    most = std::max(most, area(box.high) - area(far));
  }
  return most;
}

Figures run(const layout::Document& document, const Words& words, std::uint64_t seed,
            const std::string& name) {
  Figures figures;
  const double start = processor_seconds();
  std::atomic<bool> stop{false};
  nest::Options options;
  options.seed = seed;
  options.threads = words.threads;
  options.angles = words.angles;
  options.improved = [&](const nest::Nested&) {
    if (figures.first == 0) figures.first = processor_seconds() - start;
  };
  RunControl control;
  control.stop = &stop;
  control.work_limit = words.work;
  control.progress = [&](const Progress&) {
    if (processor_seconds() - start >= words.cpu_seconds) stop = true;
  };
  const Result<nest::Nested> found = nest::nest(document, options, control);
  figures.seconds = processor_seconds() - start;
  if (!found) refuse(name + ": " + found.error().message);
  const std::string text = io::write_layout(found->document);
  const auto verdict = verify::verify_layout({name, text});
  figures.fine = verdict && verdict->violations.empty();
  if (!words.save.empty()) {
    std::ofstream file(std::filesystem::path(words.save) / fmt::format("{}-{}.json", name, seed));
    file << text;
  }
  const layout::Completeness done = layout::completeness(found->document);
  double parts = 0, material = 0;
  for (const layout::SheetUse& use : done.sheets) {
    parts += use.parts_area;
    material += use.material_area;
    figures.length = std::max(figures.length, use.used_length_mm);
  }
  figures.density = material > 0 ? 100 * parts / material : 0;
  figures.sheets = static_cast<double>(done.sheets.size());
  figures.leftover = leftover_of(found->document);
  figures.placed = static_cast<double>(found->document.placements.size());
  figures.wanted = figures.placed;
  for (const nest::Unplaced& u : found->unplaced) figures.wanted += static_cast<double>(u.count);
  for (const layout::KitCount& kit : done.kits) figures.kits += static_cast<double>(kit.complete);
  figures.work = static_cast<double>(found->work);
  return figures;
}

void print(const std::string& name, const std::string& seed, const Figures& f) {
  fmt::print(
      "| {} | {} | {:.3f} | {:.3f} | {:.4g} | {:.6g} | {:.6g} of {:.6g} | {:.4g} | {:.2f} | {:.1f} | {:.4g} "
      "| {} |\n",
      name, seed, f.density, f.length, f.sheets, f.leftover, f.placed, f.wanted, f.kits, f.first, f.seconds,
      f.work, f.fine ? "passed" : "FAILED");
  std::fflush(stdout);
}

Figures mean_of(const std::vector<Figures>& all) {
  Figures mean;
  const double share = 1.0 / static_cast<double>(all.size());
  for (const Figures& f : all) {
    for (const auto member :
         {&Figures::density, &Figures::length, &Figures::sheets, &Figures::leftover, &Figures::placed,
          &Figures::wanted, &Figures::kits, &Figures::first, &Figures::seconds, &Figures::work})
      mean.*member += share * f.*member;
    mean.fine = mean.fine && f.fine;
  }
  return mean;
}

}  // namespace

int main(int argc, char** argv) {
  const Words words = words_of(argc, argv);
  fmt::print(
      "| file | seed | density % | length | sheets | leftover | placed | kits | first s | CPU s | work | "
      "check |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool fine = true;
  const auto run_all = [&](const layout::Document& document, const std::string& name) {
    std::vector<Figures> all;
    for (const std::uint64_t seed : words.seeds) {
      all.push_back(run(document, words, seed, name));
      print(name, std::to_string(seed), all.back());
      fine = fine && all.back().fine;
    }
    if (all.size() > 1) print(name, "mean", mean_of(all));
  };
  for (const std::uint64_t pieces : words.scale) run_all(order_of(pieces), fmt::format("{} pieces", pieces));
  for (const std::string& path : words.files) {
    const auto file = disk::open_layout(path);
    if (!file) refuse(file.error().message);
    run_all(file->document, std::filesystem::path(path).stem().string());
  }
  return fine ? 0 : 1;
}
