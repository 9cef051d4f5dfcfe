// Castings by number (tests/support/castings.hpp): how long a placement and its bound take, on true blanks or
// on scanner's meshes of them.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/castings.hpp"
#include "support/solid_files.hpp"

namespace {

using namespace lekalo;

constexpr double kGap = 0.02, kNoise = 0.02;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The numbers of one case, or of all.
struct Tally {
  std::uint64_t cases = 0, quick = 0, closed = 0, placed = 0, icp_inside = 0, cut_in = 0;
  std::vector<double> times, climbs;
};

/// Tells whether the placement is what it says in the true blank.
bool cuts_in(const solid::MeshClearance& truth, const locate::SolidPlacement& placed) {
  if (!placed.inside) return false;
  const solid::Motion motion = motion_of(placed.pose);
  const auto near = truth.nearest(motion);
  return !(near->high >= placed.clearance && truth.inside(motion));
}

/// How the castings are placed and timed, and how many times as many triangles they have.
struct How {
  locate::SolidFreedom freedom = locate::SolidFreedom::six;
  double finer = 1;
  unsigned threads = 1;

  /// Other work on the machine adds to the clock; the time of a processor is that of all threads.
  [[nodiscard]] double seconds() const { return threads > 1 ? clock_seconds() : processor_seconds(); }
};

void try_one(std::uint64_t number, std::uint64_t seed, double limit, std::uint64_t points, const How& how,
             Tally& all) {
  cases::SolidCase drawn = cases::casting(number, seed);
  if (how.finer > 1)
    for (solid::Mesh* const mesh : {&drawn.part, &drawn.blank})
      *mesh = cases::refined_by(std::move(*mesh), how.finer * static_cast<double>(mesh->triangles.size()));
  const double there = solid::MeshClearance(drawn.part, drawn.blank).nearest(drawn.there)->low;
  locate::SolidProblem problem{drawn.part, drawn.blank, {}, how.freedom};
  if (how.freedom != locate::SolidFreedom::six) {
    // It lies upright, and off by a turn about z and a shift.
    solid::Motion off = cases::turn({0, 0, 1}, how.freedom == locate::SolidFreedom::xyz ? 0 : 0.04);
    off.shift = {2, -1.5, 1};
    for (solid::Vector& p : problem.part.vertices) p = off(drawn.there(p));
  }
  double seen = 1;
  if (points > 0) {
    Random random(seed, 10'000 + number);
    cases::CastingScan scan = cases::scan_of(drawn.blank, points, kNoise, random);
    locate::SolidScan said;
    said.guard = scan.guard, said.max_dip = 0;
    locate::GuaranteedSolid made = guaranteed_solid(scan.mesh, said).value();
    problem.blank = std::move(scan.mesh), problem.blank_widths = std::move(made.widths);
    problem.blank_width_error = made.width_error;
    seen = scan.seen;
  }
  locate::SolidOptions options;
  options.threads = how.threads, options.gap = kGap;
  const auto seconds = [&] { return how.seconds(); };
  double start = seconds();
  const locate::SolidPlacement climbed = place_solid(problem, options).value();
  const double climb = seconds() - start;
  start = seconds();
  const locate::SolidPlacement rival = place_solid_icp(problem, options).value();
  const double icp = seconds() - start;

  const solid::MeshClearance truth(problem.part, drawn.blank);
  // The search asks now and then, and ends a little after the limit.
  std::atomic<bool> stop = false;
  start = seconds();
  options.run.stop = &stop;
  options.run.progress = [&](const Progress&) { stop = seconds() - start > limit; };
  const locate::SolidResult found = locate_solid(problem, options).value();
  const double time = seconds() - start;
  const double gap = found.upper_bound - found.best.clearance;
  const bool closed = found.status == locate::Status::optimal;
  fmt::print("{} {}: {} in {} vertices, {:.0f} % seen; drawn at {:.4f}\n", number, drawn.kind,
             drawn.part.vertices.size(), problem.blank.vertices.size(), 100 * seen, there);
  fmt::print(
      "    climb {:.4f} in {:.2f} s; icp {} in {:.2f} s; search {:.4f} of at most {:.4f}, gap {:.1f} um, "
      "{} boxes, {} units, {:.2f} s{}\n",
      climbed.clearance, climb, rival.inside ? fmt::format("{:.4f}", rival.clearance) : "cuts in", icp,
      found.best.clearance, found.upper_bound, 1e3 * gap, found.boxes, found.best.work, time,
      closed ? "" : ", not closed");
  std::fflush(stdout);
  ++all.cases;
  all.closed += closed, all.quick += closed && time <= 10;
  all.placed += climbed.inside, all.icp_inside += rival.inside;
  all.cut_in += cuts_in(truth, climbed) || cuts_in(truth, found.best);
  all.times.push_back(time), all.climbs.push_back(climb);
}

/// A binary STL.
solid::Mesh read_stl(const char* name) {
  std::ifstream file(name, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  solid::Mesh mesh;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    std::array<float, 9> corners{};
    std::memcpy(corners.data(), bytes.data() + at + 12, sizeof(corners));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t k = 0; k < 9; k += 3)
      mesh.vertices.push_back({corners[k], corners[k + 1], corners[k + 2]});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return closed_mesh(std::move(mesh)).value().mesh;
}

/// Prints the seconds of a climb by the clock and of processor time, its pose and its clearance, for
/// open3d_icp.py.
void place_files(const char* part_name, const char* blank_name, unsigned threads) {
  const solid::Mesh part = read_stl(part_name), blank = read_stl(blank_name);
  const locate::SolidProblem problem{part, blank, {}};
  locate::SolidOptions options;
  options.threads = threads, options.gap = kGap;
  const double start = processor_seconds(), clock = clock_seconds();
  const locate::SolidPlacement placed = place_solid(problem, options).value();
  fmt::print("{:.4f} {:.4f} {} {} {:.6f}\n", clock_seconds() - clock, processor_seconds() - start,
             part.vertices.size(), blank.vertices.size(), placed.clearance);
}

double median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of[of.size() / 2];
}

}  // namespace

/// bench_castings write NUMBER FOLDER [POINTS]
/// bench_castings place PART BLANK [THREADS]
/// bench_castings [FIRST] [COUNT] [SECONDS] [POINTS] [SEED] [six|c-xyz|xyz] [FINER] [THREADS]
/// With FINER the meshes have so many times as many triangles on the same surface. With POINTS the blanks are
/// scanned. Of one thread the seconds are processor time, of more they are those of the clock.
int main(int argc, char** argv) {
  if (argc > 3 && std::string_view(argv[1]) == "write") {
    const cases::SolidCase drawn = cases::casting(std::strtoull(argv[2], nullptr, 10));
    const std::string folder = argv[3];
    solid::Mesh blank = drawn.blank;
    if (argc > 4) {
      Random random(cases::kCastingSeed, 10'000 + std::strtoull(argv[2], nullptr, 10));
      blank = cases::scan_of(drawn.blank, std::strtoull(argv[4], nullptr, 10), kNoise, random).mesh;
    }
    std::ofstream(folder + "/part.stl", std::ios::binary) << solid_files::stl_binary(drawn.part);
    std::ofstream(folder + "/blank.stl", std::ios::binary) << solid_files::stl_binary(blank);
    return 0;
  }
  if (argc > 3 && std::string_view(argv[1]) == "place") {
    place_files(argv[2], argv[3], argc > 4 ? static_cast<unsigned>(std::strtoul(argv[4], nullptr, 10)) : 1);
    return 0;
  }
  const auto number = [&](int k, std::uint64_t otherwise) {
    return argc > k ? std::strtoull(argv[k], nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(1, 0), count = number(2, cases::kCastings), points = number(4, 0),
                      seed = number(5, cases::kCastingSeed);
  const double limit = argc > 3 ? std::strtod(argv[3], nullptr) : 60;
  How how;
  if (const std::string_view freedom = argc > 6 ? argv[6] : "six"; freedom != "six")
    how.freedom = freedom == "xyz" ? locate::SolidFreedom::xyz : locate::SolidFreedom::c_xyz;
  if (argc > 7) how.finer = std::strtod(argv[7], nullptr);
  how.threads = static_cast<unsigned>(number(8, 1));
  Tally all;
  for (std::uint64_t k = 0; k < count; ++k) try_one(first + k, seed, limit, points, how, all);
  if (all.cases == 0) return 0;
  const auto share = [&](std::uint64_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(all.cases);
  };
  fmt::print(
      "{} castings, seed {}: gap of {} um closed in 10 s for {:.0f} %, in {} s for {:.0f} %; median {:.2f} "
      "s, "
      "climb {:.2f} s\n",
      all.cases, seed, 1e3 * kGap, share(all.quick), limit, share(all.closed), median(all.times),
      median(all.climbs));
  fmt::print("placed by the climb {:.0f} %, by icp {:.0f} %; told more than the true blank has: {}\n",
             share(all.placed), share(all.icp_inside), all.cut_in);
  return all.cut_in == 0 ? 0 : 1;
}
