#include "point_blank.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/solid/point_surface.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::jobs {
namespace {

using solid::Vector;

tl::unexpected<Error> bad(const File& file, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", file.name, sentence));
}

/// The part of the radius that the ball of the mesh may have: what it does not pass is then small enough for
/// the assumption to cover.
constexpr double kBall = 0.8;

/// Looks, in coarse cells, for a larger ball that does not fall in between the points, while the next smaller
/// one does. The surface that it leaves shows where points are missing, so that its cells need not be finer
/// than the ball asks for: a large one beside small cells takes time with the square of its radius.
bool widen(const std::vector<Vector>& points, bool step_is_said, solid::PointSurfaceOptions& how,
           const ProgressListener& progress) {
  // The first ball is not smaller than a share of the whole, so that no trial has many cells.
  constexpr double kWider = 1.15, kCells = 6, kSafety = 1.1, kSmallest = 1.0 / 24, kFinalCells = 24;
  const solid::Box box = solid::box_of(points);
  const Vector size = box.high - box.low;
  const double largest = std::max({size.x, size.y, size.z});
  std::vector<double> balls;
  for (double ball = std::max(how.ball, kSmallest * largest); ball < largest; ball *= kWider)
    balls.push_back(ball);
  const int trials = static_cast<int>(std::bit_width(balls.size()));
  int tried = 0;
  const auto falls_in = [&](double ball) {
    solid::PointSurfaceOptions trial = how;
    trial.ball = ball, trial.step = ball / kCells;
    const Result<solid::PointSurface> made = solid::surface_through(points, trial);
    ++tried;
    if (progress) progress({static_cast<std::uint64_t>(tried), std::min(1.0, tried / double(trials))});
    return !made || !made->encloses;
  };
  const auto first = std::partition_point(balls.begin(), balls.end(), falls_in);
  if (first == balls.end()) return false;
  how.ball = kSafety * *first;
  if (!step_is_said) how.step = std::max(how.step.value_or(0), how.ball / kFinalCells);
  return true;
}

}  // namespace

Result<void> mesh_points(const SolidLocateJob& job, const io::SolidFile& file, const PhaseListener& phases,
                         SolidInputs& in) {
  const std::optional<SolidScanOptions>& scan = job.options.scan;
  if (job.outputs.mesh.empty() || !scan || !scan->min_radius)
    return bad(
        job.blank,
        "points are not a closed surface, so nothing says where the material is; with --uncertainty MM, "
        "--min-radius MM and --mesh FILE.ply they are meshed first, and --underside z=LEVEL --flat MM closes "
        "the side on which the blank stands");
  if (scan->max_dip)
    return bad(job.blank,
               "a dip is said of the triangles of a mesh, and points have none yet; leave --max-dip out");
  const double guard = scan->coverage_factor * scan->uncertainty;
  if (!(*scan->min_radius > guard))
    return failure(
        ErrorCode::usage,
        fmt::format("a smallest radius of {} mm must be above {} mm, what the points are uncertain by",
                    *scan->min_radius, guard));
  std::vector<Vector> points = file.mesh.vertices;
  if (scan->drop_outliers) {
    in.left_out = solid::lonely_points(points, *scan->drop_outliers);
    std::vector<Vector> kept;
    std::size_t next = 0;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      if (next < in.left_out.size() && in.left_out[next] == k)
        ++next;
      else
        kept.push_back(points[k]);
    }
    if (!in.left_out.empty())
      in.notices.push_back(fmt::format("{}: {} points have no other within {} mm and are left out",
                                       job.blank.name, in.left_out.size(), *scan->drop_outliers));
    points = std::move(kept);
  }
  solid::PointSurfaceOptions how;
  how.ball = kBall * (*scan->min_radius - guard);
  how.step = scan->step;
  if (scan->underside) how.floor = scan->underside->z;
  const double first = how.ball;
  const auto meshed = [&] {
    return solid::surface_through(points, how, begin_phase(phases, "meshing the points"));
  };
  Result<solid::PointSurface> made = meshed();
  while (made && !made->encloses) {
    if (!scan->step) how.step = made->step;
    if (!widen(points, scan->step.has_value(), how,
               begin_phase(phases, "looking for gaps between the points")))
      break;
    made = meshed();
  }
  if (!made) return failure(made.error().code, fmt::format("{}: {}", job.blank.name, made.error().message));
  if (!made->encloses)
    return bad(
        job.blank,
        "the points enclose nothing; measure all sides, or close the one on which the blank stands with "
        "--underside z=LEVEL --flat MM");
  if (how.ball > first)
    in.notices.push_back(
        fmt::format("{}: somewhere a ball of {:.4g} mm falls in between the points; gaps that one of "
                    "{:.4g} mm does not pass are bridged, and unknown where they are wide",
                    job.blank.name, first, how.ball));
  if (made->below > 0)
    in.notices.push_back(
        fmt::format("{}: {} points lie below the underside and are not used", job.blank.name, made->below));
  in.points = std::move(points);
  in.meshed =
      MeshedPoints{{job.outputs.mesh, io::ply_text(made->mesh)}, file.unit, file.mesh.vertices.size()};
  return {};
}

Result<void> hold_against_points(const SolidLocateJob& job, SolidInputs& in) {
  const locate::SolidProblem& p = in.problem;
  const solid::TriangleTree tree(p.blank);
  if (!in.scan->proved()) return {};
  const double guard = in.scan->guard, widest = in.scan->widest;
  const double narrowest = *std::min_element(p.blank_widths.begin(), p.blank_widths.end());
  std::size_t against = 0;
  double deepest = 0;
  Vector there;
  for (const Vector q : in.points) {
    ask();
    if (tree.nearest(q, guard + narrowest)) continue;
    const double depth = tree.least_sum(q, p.blank_widths, -1, -widest);
    if (!(depth > guard) || !tree.holds(q)) continue;
    ++against;
    if (depth > deepest) deepest = depth, there = q;
  }
  if (against == 0) return {};
  return bad(
      job.blank,
      fmt::format(
          "{} of its points lie inside the material that --min-radius {} promises, the deepest {:.4g} "
          "mm deep at ({:.6g}, {:.6g}, {:.6g}): they are outliers, which --drop-outliers MM leaves out, "
          "or the surface has places that no such ball reaches, or voids",
          against, *in.scan->min_radius, deepest, there.x, there.y, there.z));
}

}  // namespace lekalo::jobs
