// Placements of solids by seed: what a climb and the search find, in processor time and boxes.

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "lekalo/solid/symmetry.hpp"
#include "support/castings.hpp"
#include "support/solid_cases.hpp"

namespace {

using namespace lekalo;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

cases::SolidCase make(std::string_view kind, Random& random) {
  if (kind == "convex") return cases::convex_in_convex(random, 30, 1.5);
  if (kind == "uneven") return cases::convex_in_convex(random, 30, 1, true);
  if (kind == "cored") return cases::cored_block(random);
  if (kind == "turned") return cases::turned_part(random);
  if (kind == "fine-cored") return cases::cored_block(random, 160);
  if (kind == "fine-turned") return cases::turned_part(random, 300);
  if (kind == "fine") return cases::wavy_part(random, 158);
  return cases::wavy_part(random);
}

/// A text STL, as the pair of data/solid is.
solid::Mesh read_stl(const char* name) {
  solid::Mesh mesh;
  std::ifstream file(name);
  for (std::string word; file >> word;) {
    if (word != "vertex") continue;
    solid::Vector p;
    file >> p.x >> p.y >> p.z;
    mesh.vertices.push_back(p);
  }
  for (std::uint32_t k = 0; k + 2 < mesh.vertices.size(); k += 3) mesh.triangles.push_back({k, k + 1, k + 2});
  return closed_mesh(std::move(mesh)).value().mesh;
}

/// Returns the time of the search.
double try_both(const cases::SolidCase& pair, std::uint64_t number, double gap, locate::SolidFreedom freedom,
                const locate::SolidPose& from = {}, double turn = 0.0873) {
  const solid::MeshClearance meter(pair.part, pair.blank);
  const double there = meter.inside(pair.there) ? meter.nearest(pair.there)->low : 0;
  const locate::SolidProblem problem{pair.part, pair.blank, from, freedom, 5, turn};
  double start = seconds();
  const auto placed = locate::place_solid(problem, {.gap = gap, .run = {}});
  fmt::print("{} {}: {} in {} triangles; drawn at {:.4f}; climbed to {:.6f} in {:.0f} ms, {} units\n",
             pair.kind, number, pair.part.triangles.size(), pair.blank.triangles.size(), there,
             placed->clearance, 1e3 * (seconds() - start), placed->work);
  locate::SolidOptions options;
  options.threads = 1;
  options.gap = gap;
  options.run.work_limit = 100'000;
  start = seconds();
  const auto found = locate::locate_solid(problem, options);
  const double took = seconds() - start;
  fmt::print("    {:.6f} of at most {:.6f} in {:.0f} ms, {} boxes, {} units{}\n", found->best.clearance,
             found->upper_bound, 1e3 * took, found->boxes, found->best.work,
             found->status == locate::Status::optimal      ? ""
             : found->status == locate::Status::infeasible ? ", infeasible"
                                                           : ", not closed");
  return took;
}

/// Some rotation, with the middle of the part where it would be without it.
locate::SolidPose anyhow(const solid::Mesh& part, Random& random) {
  locate::SolidPose pose;
  for (double& q : pose.quaternion) q = random.uniform(-1, 1);
  const solid::Box box = box_of(part.vertices);
  const solid::Vector middle = 0.5 * (box.low + box.high);
  pose.shift = middle - motion_of(pose).turned(middle);
  return pose;
}

/// Looks for the start of castings that are turned anyhow, each `step` of the hundred.
void find_starts(std::uint64_t step) {
  for (std::uint64_t k = 0; k < cases::kCastings; k += step) {
    const cases::SolidCase pair = cases::casting(k);
    const solid::MeshClearance meter(pair.part, pair.blank);
    const double there = meter.inside(pair.there) ? meter.nearest(pair.there)->low : 0;
    Random random(77, k);
    double start = seconds();
    const auto found = locate::find_start({pair.part, pair.blank, anyhow(pair.part, random)}, {});
    const double took = seconds() - start;
    const auto placed = locate::place_solid({pair.part, pair.blank, found->pose}, {});
    start = seconds();
    const std::uint32_t rotations = solid::symmetry(pair.part, 0.01).rotations;
    fmt::print(
        "{} {}: {} in {} triangles; drawn at {:.4f}; {:.4f} from the start that was found in {:.0f} ms; "
        "symmetry {} in {:.0f} ms\n",
        pair.kind, k, pair.part.triangles.size(), pair.blank.triangles.size(), there, placed->clearance,
        1e3 * took, rotations, 1e3 * (seconds() - start));
  }
}

}  // namespace

/// bench_locate_solid start [STEP]
/// bench_locate_solid stl PART BLANK [GAP]
/// bench_locate_solid [KIND|all] [CASES] [SEED] [GAP] [all-rotations]
int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "all";
  if (wanted == "start") {
    find_starts(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    return 0;
  }
  if (wanted == "stl" && argc > 3) {
    const cases::SolidCase pair{"files", read_stl(argv[2]), read_stl(argv[3]), {}, 0};
    const double gap = argc > 4 ? std::strtod(argv[4], nullptr) : 0.01;
    for (const auto freedom :
         {locate::SolidFreedom::xyz, locate::SolidFreedom::c_xyz, locate::SolidFreedom::six})
      try_both(pair, static_cast<std::uint64_t>(freedom), gap, freedom);
    return 0;
  }
  const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 5,
                      seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const double gap = argc > 4 ? std::strtod(argv[4], nullptr) : 0.01;
  for (const std::string_view kind :
       {"convex", "uneven", "cored", "turned", "wavy", "fine", "fine-cored", "fine-turned"}) {
    if (wanted != "all" && wanted != kind) continue;
    std::vector<double> took;
    for (std::uint64_t k = 0; k < count; ++k) {
      Random random(seed, 100 + k);
      const cases::SolidCase pair = make(kind, random);
      took.push_back(argc > 5 ? try_both(pair, k, gap, locate::SolidFreedom::six, anyhow(pair.part, random),
                                         locate::SolidProblem::kAllTurns)
                              : try_both(pair, k, gap, locate::SolidFreedom::six));
    }
    std::sort(took.begin(), took.end());
    if (!took.empty())
      fmt::print("{}: a search takes {:.0f} ms in the median, {:.0f} ms at most\n", kind,
                 1e3 * took[took.size() / 2], 1e3 * took.back());
  }
}
