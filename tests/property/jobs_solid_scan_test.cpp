#include <gtest/gtest.h>

#include <cstdint>

#include "lekalo/jobs/locate_solid.hpp"
#include "support/cases.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_files.hpp"

// Placements in scanned blanks as they are handed out: the checker, which makes the widths anew, confirms
// each of them, also the certificate, and the placed part has its clearance in the true blank.

namespace lekalo::jobs::jobs_solid_scan_test {
namespace {

using cases::Bitten;
using solid::Vector;

TEST(SolidScan, EveryPlacementIsConfirmedAndHoldsInTheTrueBlank) {
  const std::uint64_t seed = cases::seed();
  std::size_t placed = 0, of_points = 0;
  for (std::size_t k = 0; k < cases::case_count(4); ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    Random random(seed, 2000 + k);
    const Bitten blank = cases::bitten(random);
    SolidScanOptions scan;
    scan.uncertainty = random.uniform(0.001, 0.04), scan.min_radius = blank.radius;
    solid::Mesh part = cases::scanned(blank, 20, 0, random);
    for (Vector& p : part.vertices) p = 0.88 * p;
    const solid::Mesh mesh =
        cases::scanned(blank, static_cast<std::uint32_t>(200 / blank.radius), 1.9 * scan.uncertainty, random);
    // Binary numbers of either length, decimals, and points alone.
    SolidLocateJob job;
    job.part = {"part.stl", solid_files::stl_binary(part)};
    job.blank = k % 4 == 0   ? File{"scan.stl", solid_files::stl_binary(mesh)}
                : k % 4 == 1 ? File{"scan.ply", solid_files::ply<double>(mesh, solid_files::PlyForm::big)}
                : k % 4 == 2 ? File{"scan.obj", solid_files::obj(mesh)}
                             : File{"scan.xyz", solid_files::points(mesh.vertices)};
    if (k % 4 == 3) job.outputs.mesh = "mesh.ply";
    job.options.scan = scan;
    job.options.gap = 0.02, job.options.shift = 1, job.options.tilt_deg = 1;
    RunControl run;
    run.work_limit = 1500;
    const auto located = locate_solid(job, run);
    ASSERT_TRUE(located.has_value()) << located.error().message;
    const io::SolidDocument& d = located->document;
    if (!d.inside() || !d.scan->proved()) continue;
    ++placed, of_points += k % 4 == 3 ? 1 : 0;
    const solid::Motion motion = motion_of(d.pose);
    for (const Vector p : part.vertices) {
      // The part's own numbers are rounded in its file.
      EXPECT_GE(blank.depth(motion(p)), *d.clearance - 1e-5);
    }
  }
  EXPECT_GE(8 * of_points, cases::case_count(4)) << "few points were placed in, so little was tested";
  EXPECT_GE(3 * placed, cases::case_count(4)) << "few parts were placed, so little was tested";
}

}  // namespace
}  // namespace lekalo::jobs::jobs_solid_scan_test
