// Twenty orders, nested and cut once with a gap between all parts and once with common lines: cut length,
// material and time of either, as a table in markdown. Every program is held against its layout by the
// independent checker; status 1 where it refutes one.
//
//   bench_common_line [WORK [KERF [GAP]]]
//
// Orders 1 to 10 are rectangles alone, 11 to 20 have right triangles and other polygons among them. The
// number of an order is its seed.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/nc/machine_time.hpp"
#include "lekalo/verify/claims.hpp"

namespace {

using namespace lekalo;

constexpr int kOrders = 20;

std::int64_t steps(double mm) { return geom::grid_from_mm(mm); }

layout::Part part_of(const std::string& id, const std::vector<std::pair<double, double>>& corners,
                     std::int64_t demand, bool free_angles) {
  layout::Part part;
  part.id = id;
  std::vector<geom::GridPoint> loop;
  for (const auto& [x, y] : corners) loop.push_back({steps(x), steps(y)});
  part.outline.polygon = geom::make_grid_region({loop}).value();
  for (const double degrees : {0.0, 90.0, 180.0, 270.0})
    if (!free_angles) part.rotations.push_back({degrees, degrees});
  part.demand = demand;
  return part;
}

layout::Document order(std::uint64_t seed, double gap) {
  Random random(seed, 1);
  layout::Document document;
  document.rules.gap = geom::grid_from_mm_up(gap);
  document.rules.border_gap = steps(10);
  layout::Stock stock;
  stock.id = "sheet";
  stock.count = 40;
  stock.outline.polygon =
      geom::make_grid_region({{{0, 0}, {steps(2000), 0}, {steps(2000), steps(1000)}, {0, steps(1000)}}})
          .value();
  document.stocks.push_back(stock);
  const auto whole = [&](int low, int high) {
    return low + static_cast<double>(random.below(static_cast<std::uint64_t>(high - low + 1)));
  };
  const int kinds = 3 + static_cast<int>(random.below(4));
  for (int k = 0; k < kinds; ++k) {
    const double width = whole(8, 60) * 5, height = whole(8, 40) * 5;
    document.parts.push_back(part_of(fmt::format("plate {}", k),
                                     {{0, 0}, {width, 0}, {width, height}, {0, height}},
                                     static_cast<std::int64_t>(whole(4, 20)), false));
  }
  if (seed <= kOrders / 2) return document;
  const double a = whole(10, 50) * 5, b = whole(10, 40) * 5;
  document.parts.push_back(
      part_of("gusset", {{0, 0}, {a, 0}, {0, b}}, 2 * static_cast<std::int64_t>(whole(3, 8)), false));
  for (int k = 0; k < 2; ++k) {
    std::vector<std::pair<double, double>> corners;
    const int count = 5 + static_cast<int>(random.below(5));
    const double size = whole(60, 160);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * 3.14159265358979 * i / count, radius = size * random.uniform(0.5, 1);
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    document.parts.push_back(
        part_of(fmt::format("other {}", k), corners, static_cast<std::int64_t>(whole(4, 10)), true));
  }
  return document;
}

/// A layout with its programs.
struct Made {
  double material_mm2 = 0, cut_mm = 0, seconds = 0, off_mm = 0;
  std::size_t pierces = 0, missing = 0;
  bool is_confirmed = true;
};

double used_material(const layout::Document& document) {
  double sum = 0, left = 0;
  for (const layout::SheetUse& use : layout::completeness(document).sheets) {
    sum += use.material_area;
    left = std::max(left, (2000 - use.used_length_mm) * 1000);
  }
  return sum - left;
}

Made made(layout::Document document, bool common, double kerf, double gap, std::uint64_t work) {
  jobs::NestOptions options;
  if (common) options.common_line_gap_mm = gap, document.rules.gap = geom::grid_from_mm_up(kerf);
  document.rules.kerf = geom::grid_from_mm_up(kerf);
  RunControl control;
  control.work_limit = work;
  const jobs::Nested nested = jobs::nest(document, options, control).value();
  Made figures;
  figures.material_mm2 = used_material(nested.document);
  for (const nest::Unplaced& missing : nested.unplaced)
    figures.missing += static_cast<std::size_t>(missing.count);

  io::ExportRequest request;
  request.form = io::ExportForm::gcode;
  nc::ProfileOptions& profile = request.profile;
  profile.kerf_mm = kerf, profile.feed_mm_per_min = 3000, profile.lead_in_mm = 3, profile.pierce_s = 0.5;
  profile.common_line = common;
  const auto exported = io::export_layout(nested.document, "bench", request);
  if (!exported) {
    fmt::print(stderr, "{}\n", exported.error().message);
    std::exit(1);
  }
  for (const std::string& note : exported->notes) {
    double off = 0;
    const std::size_t at = note.find("at half a kerf, within ");
    if (at != std::string::npos && std::sscanf(note.c_str() + at, "at half a kerf, within %lf", &off) == 1)
      figures.off_mm = std::max(figures.off_mm, off);
  }
  nc::MachineModel machine;
  machine.rapid_mm_per_min.fill(30'000);
  machine.acceleration_mm_per_s2.fill(3'000);
  for (const io::ExportedFile& file : exported->files) {
    const auto timed = nc::timed_program(file.bytes, file.sheet, 1, machine).value();
    for (const nc::TimedMotion& motion : timed.motions) {
      figures.seconds += motion.seconds;
      if (motion.kind == nc::TimedKind::cut) figures.cut_mm += motion.length_mm;
    }
    figures.pierces += timed.pierces.size();
    verify::ProfileWords words;
    words.sheet = file.sheet, words.kerf_mm = kerf, words.common_line = common;
    const auto report =
        verify::verify_profile({"program", file.bytes}, {"layout", nested.bytes}, words).value();
    for (const std::string& finding : report.findings) fmt::print(stderr, "{}\n", finding);
    figures.is_confirmed = figures.is_confirmed && report.findings.empty() && report.unchecked.empty();
  }
  return figures;
}

double percent_less(double before, double after) { return 100 * (before - after) / before; }

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t work = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 600'000;
  const double kerf = argc > 2 ? std::strtod(argv[2], nullptr) : 0.5,
               gap = argc > 3 ? std::strtod(argv[3], nullptr) : 5;
  fmt::print(
      "| order | cut, m | with common lines | less by | material, m2 | with common lines | more by | "
      "pierces | with common lines | time, min | with common lines | less by | at size within, mm | "
      "confirmed |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  double cut = 0, material = 0, seconds = 0;
  bool is_confirmed = true;
  for (std::uint64_t seed = 1; seed <= kOrders; ++seed) {
    const Made apart = made(order(seed, gap), false, kerf, gap, work),
               common = made(order(seed, gap), true, kerf, gap, work);
    const bool fine = apart.is_confirmed && common.is_confirmed && apart.missing == 0 && common.missing == 0;
    is_confirmed = is_confirmed && fine;
    fmt::print(
        "| {} | {:.1f} | {:.1f} | {:.1f} % | {:.3f} | {:.3f} | {:.2f} % | {} | {} | {:.1f} | {:.1f} | "
        "{:.1f} % | {:.5f} | {} |\n",
        seed, apart.cut_mm / 1000, common.cut_mm / 1000, percent_less(apart.cut_mm, common.cut_mm),
        apart.material_mm2 / 1e6, common.material_mm2 / 1e6,
        -percent_less(apart.material_mm2, common.material_mm2), apart.pierces, common.pierces,
        apart.seconds / 60, common.seconds / 60, percent_less(apart.seconds, common.seconds), common.off_mm,
        fine ? "yes" : "no");
    std::fflush(stdout);
    cut += percent_less(apart.cut_mm, common.cut_mm) / kOrders;
    material -= percent_less(apart.material_mm2, common.material_mm2) / kOrders;
    seconds += percent_less(apart.seconds, common.seconds) / kOrders;
  }
  fmt::print("| mean | | | {:.1f} % | | | {:.2f} % | | | | | {:.1f} % | | |\n", cut, material, seconds);
  return is_confirmed ? 0 : 1;
}
