#include <cmath>
#include <cstdint>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/locate/solid_reference.hpp"
#include "locate/solid/solid_climb.hpp"
#include "locate/solid/solid_placement.hpp"
#include "normal_equations.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

/// So many points are spread over the part's surface.
constexpr std::size_t kPoints = 10'000;
/// The iteration ends with a sum of squares that changes by less than this part of itself, or after so many
/// steps.
constexpr double kSettled = 1e-6;
constexpr int kMostSteps = 100;

/// One point for each equal share of the surface. Where in its triangle it lies goes by the multiples of two
/// irrational numbers, which fill a square evenly (Roberts 2018).
std::vector<Vector> spread_points(const solid::Mesh& mesh) {
  std::vector<double> area_up_to;
  double area = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector a = mesh.vertices[i];
    area += 0.5 * norm(cross(mesh.vertices[j] - a, mesh.vertices[k] - a));
    area_up_to.push_back(area);
  }
  std::vector<Vector> points;
  std::size_t triangle = 0;
  for (std::size_t n = 0; n < kPoints; ++n) {
    const auto number = static_cast<double>(n);
    const double at = (number + 0.5) / kPoints * area;
    while (triangle + 1 < area_up_to.size() && area_up_to[triangle] < at) ++triangle;
    double u = std::fmod(0.7548776662466927 * number, 1.0), v = std::fmod(0.5698402909980532 * number, 1.0);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [i, j, k] = mesh.triangles[triangle];
    const Vector a = mesh.vertices[i];
    points.push_back(a + u * (mesh.vertices[j] - a) + v * (mesh.vertices[k] - a));
  }
  return points;
}

class SolidRegistration {
 public:
  explicit SolidRegistration(const SolidMeter& meter)
      : meter_(meter), points_(spread_points(meter.part())), near_(points_.size(), 0) {
    for (const auto& [i, j, k] : meter.blank().triangles) {
      const Vector a = meter.blank().vertices[i];
      const Vector n = cross(meter.blank().vertices[j] - a, meter.blank().vertices[k] - a);
      normals_.push_back(norm(n) > 0 ? 1 / norm(n) * n : Vector{});
    }
  }

  /// Moves the pose by one least-squares step and returns the sum of the squares before it.
  double step(FramedPose& pose) {
    const SolidFrame& frame = meter_.frame();
    const Steps free = frame.trusted(1);
    const Motion motion = frame.motion(pose);
    NormalEquations<6> sum;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      ask();
      const Vector p = motion(points_[i]);
      const auto nearest = *meter_.clearance().blank().nearest(p, kInfinity, near_[i]);
      near_[i] = nearest.triangle;
      const Vector n = normals_[nearest.triangle], g = 1 / frame.reach * cross(p - pose.at, n);
      Steps row{n.x, n.y, n.z, g.x, g.y, g.z};
      for (std::size_t k = 0; k < row.size(); ++k) row[k] *= free[k];
      sum.add(row, dot(n, nearest.place - p));
    }
    pose = frame.moved(pose, sum.solve());
    return sum.squares;
  }

 private:
  const SolidMeter& meter_;
  std::vector<Vector> points_, normals_;
  std::vector<std::uint32_t> near_;
};

}  // namespace

Result<SolidPlacement> place_solid_icp(const SolidProblem& problem, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  const SolidMeter meter(problem, frame_of(problem));
  SolidRegistration registration(meter);
  const RunControl nobody;
  const Listening to_the_end(nobody);
  FramedPose pose = meter.frame().window.middle();
  std::uint64_t steps = 0;
  double before = kInfinity;
  while (steps < kMostSteps && !options.run.stop_requested()) {
    ++steps;
    const double squares = registration.step(pose);
    if (std::abs(before - squares) <= kSettled * squares) break;
    before = squares;
  }
  std::vector<SolidContact> contacts;
  const MeasuredSolid there = meter.measure(pose, kInfinity, 1, contacts);
  SolidPlacement made = placement(meter, pose);
  made.contacts = holding_contacts(meter, there, options.gap);
  made.work = steps;
  return made;
}

}  // namespace lekalo::locate
