#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/jobs/locate_solid.hpp"
#include "support/cases.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"
#include "support/stopwatch.hpp"

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

/// The sides and the top of a box as a scanner sees them, 2 mm apart, and nothing of its underside.
std::vector<Vector> seen_from_above(int x, int y, int z) {
  std::vector<Vector> points;
  for (int i = 0; i <= x; i += 2)
    for (int j = 0; j <= y; j += 2)
      for (int k = 0; k <= z; k += 2)
        if (k == z || i == 0 || j == 0 || i == x || j == y)
          points.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return points;
}

SolidLocateJob without_underside() {
  SolidLocateJob job;
  job.part = {"part.stl", solid_files::stl_binary(cases::block({10, 10, 10}, {50, 40, 25}))};
  job.blank = {"scan.xyz", solid_files::points(seen_from_above(60, 50, 30))};
  job.outputs.mesh = "mesh.ply";
  job.options.scan = SolidScanOptions{0.01, 2, 5, {}, {}, {}, {}};
  job.options.method = SolidMethod::climb;
  return job;
}

/// Hears of phases, and counts what it is told.
struct Heard {
  std::vector<std::string> phases;
  std::vector<double> last;  ///< fraction of each phase
  std::size_t calls = 0;
  std::function<void()> each = [] {};

  [[nodiscard]] PhaseListener listener() {
    return [this](const char* phase) -> ProgressListener {
      phases.emplace_back(phase);
      last.push_back(0);
      return [this](const Progress& progress) {
        EXPECT_GE(progress.fraction, last.back());
        EXPECT_LE(progress.fraction, 1);
        last.back() = progress.fraction;
        ++calls;
        each();
      };
    };
  }
};

TEST(SolidScan, MeshingIsTold) {
  const SolidLocateJob job = without_underside();
  Heard heard;
  const auto located = locate_solid(job, {}, {}, heard.listener());
  ASSERT_TRUE(located.has_value()) << located.error().message;
  EXPECT_FALSE(located->document.scan->proved());
  ASSERT_GE(heard.phases.size(), 4U);
  for (std::size_t k = 0; k + 1 < heard.phases.size(); ++k) {
    EXPECT_EQ(heard.phases[k], k % 2 == 0 ? "meshing the points" : "looking for gaps between the points");
    EXPECT_GT(heard.last[k], 0.5) << k;
  }
  EXPECT_EQ(heard.phases.back(), "checking what was found");
  EXPECT_GT(heard.calls, 30U);
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(SolidScan, MeshingHearsAStop) {
  const SolidLocateJob job = without_underside();
  for (const std::size_t when : {1U, 12U, 20U, 30U}) {
    std::atomic<bool> stop = false;
    double at = 0;
    Heard heard;
    heard.each = [&] {
      if (heard.calls == when) stop = true, at = processor_seconds();
    };
    RunControl run;
    run.stop = &stop;
    const auto done = stoppable(run, [&] { return locate_solid(job, run, {}, heard.listener()); });
    EXPECT_FALSE(done.has_value()) << when;
    EXPECT_LE(processor_seconds() - at, 0.25 * cases::kSlowdown) << when;
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_solid_scan_test
