// Placements of solids by seed: what a climb and the search find, in processor time and boxes.

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/solid_cases.hpp"

namespace {

using namespace lekalo;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

cases::SolidCase make(std::string_view kind, Random& random) {
  if (kind == "convex") return cases::convex_in_convex(random, 30, 1.5);
  if (kind == "uneven") return cases::convex_in_convex(random, 30, 1, true);
  if (kind == "cored") return cases::cored_block(random);
  if (kind == "turned") return cases::turned_part(random);
  return cases::wavy_part(random);
}

}  // namespace

/// bench_locate_solid [KIND|all] [CASES] [SEED] [GAP]
int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "all";
  const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 5,
                      seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const double gap = argc > 4 ? std::strtod(argv[4], nullptr) : 0.01;
  for (const std::string_view kind : {"convex", "uneven", "cored", "turned", "wavy"}) {
    if (wanted != "all" && wanted != kind) continue;
    for (std::uint64_t k = 0; k < count; ++k) {
      Random random(seed, 100 + k);
      const cases::SolidCase pair = make(kind, random);
      const solid::MeshClearance meter(pair.part, pair.blank);
      const double there = meter.inside(pair.there) ? meter.nearest(pair.there)->low : 0;
      const locate::SolidProblem problem{pair.part, pair.blank, {}, locate::SolidFreedom::six, 5, 0.0873};
      double start = seconds();
      const auto placed = locate::place_solid(problem, {});
      fmt::print("{} {}: {} in {} triangles; drawn at {:.4f}; climbed to {:.6f} in {:.0f} ms, {} units\n",
                 kind, k, pair.part.triangles.size(), pair.blank.triangles.size(), there, placed->clearance,
                 1e3 * (seconds() - start), placed->work);
      locate::SolidOptions options;
      options.threads = 1;
      options.gap = gap;
      options.run.work_limit = 200'000;
      start = seconds();
      const auto found = locate::locate_solid(problem, options);
      fmt::print("    {:.6f} of at most {:.6f} in {:.0f} ms, {} boxes, {} units{}\n", found->best.clearance,
                 found->upper_bound, 1e3 * (seconds() - start), found->boxes, found->best.work,
                 found->status == locate::Status::optimal ? "" : ", stopped");
    }
  }
}
