#include "touch_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::locate {
namespace {

using solid::Vector;

/// The fit ends after so many steps, or when one is shorter than this part of the mesh. None turns by more
/// than this, about, rad.
constexpr int kMostFitSteps = 100;
constexpr double kShortStep = 1e-9, kMostTurn = 0.3;
/// A direction in which touches say nothing is not gone along: this part of the others is added to what they
/// say.
constexpr double kHeld = 1e-9;
/// A touch that is so many times farther off than half of them counts half.
constexpr double kOff = 3;
/// A touch this near to the surface, as a part of the mesh, has the normal of its triangle.
constexpr double kOnSurface = 1e-7;

/// Solves the symmetric system by elimination; the matrix is positive, as that of squares is.
Steps solved(std::array<Steps, 6> matrix, Steps right) {
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t i = k + 1; i < 6; ++i) {
      const double factor = matrix[i][k] / matrix[k][k];
      for (std::size_t j = k; j < 6; ++j) matrix[i][j] -= factor * matrix[k][j];
      right[i] -= factor * right[k];
    }
  for (std::size_t k = 6; k-- > 0;) {
    for (std::size_t j = k + 1; j < 6; ++j) right[k] -= matrix[k][j] * right[j];
    right[k] /= matrix[k][k];
  }
  return right;
}

/// A touch is so far off the surface, and the steps of the mesh change that.
struct Residual {
  double off = 0;
  Steps slope{};
};

Residual residual(const TouchedPlace& at, double radius, const solid::Motion& motion,
                  const SolidFrame& frame) {
  const Vector n = motion.turned(at.normal),
               turn = 1 / frame.reach * cross(motion.turned(at.place - frame.pivot), n);
  return {at.height - radius, {-n.x, -n.y, -n.z, -turn.x, -turn.y, -turn.z}};
}

/// The step that makes the weighted squares least.
std::optional<Steps> step_of(const std::vector<Residual>& residuals) {
  std::vector<double> off;
  for (const Residual& one : residuals) off.push_back(std::abs(one.off));
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  const double usual = kOff * off[off.size() / 2];
  std::array<Steps, 6> matrix{};
  Steps right{};
  for (const Residual& one : residuals) {
    const double relative = usual > 0 ? one.off / usual : 0, weight = 1 / (1 + relative * relative);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) matrix[i][j] += weight * one.slope[i] * one.slope[j];
      right[i] -= weight * one.slope[i] * one.off;
    }
  }
  double trace = 0;
  for (std::size_t i = 0; i < 6; ++i) trace += matrix[i][i];
  if (!(trace > 0)) return std::nullopt;
  for (std::size_t i = 0; i < 6; ++i) matrix[i][i] += kHeld * trace;
  return solved(matrix, right);
}

}  // namespace

TouchedPlace touched_place(const solid::TriangleTree& nominal, Vector touch) {
  const solid::Nearest nearest = *nominal.nearest(touch);
  const double side = nominal.holds(touch) ? -1 : 1;
  const Vector way = touch - nearest.place;
  const double height = norm(way);
  TouchedPlace made{nearest.place, {}, side * height};
  if (height > kOnSurface * nominal.largest()) {
    made.normal = side / height * way;
    return made;
  }
  const solid::Corners& t = nominal.corners(nominal.place_in_order(nearest.triangle));
  const Vector across = cross(t[1] - t[0], t[2] - t[0]);
  if (const double length = norm(across); length > 0) made.normal = 1 / length * across;
  return made;
}

FramedPose fitted(const solid::TriangleTree& nominal, const SolidFrame& frame,
                  const std::vector<Vector>& touches, double radius) {
  FramedPose pose = frame.window.middle();
  for (int k = 0; k < kMostFitSteps; ++k) {
    const solid::Motion motion = frame.motion(pose);
    std::vector<Residual> residuals;
    for (const Vector touch : touches) {
      ask();
      residuals.push_back(residual(touched_place(nominal, motion.back(touch)), radius, motion, frame));
    }
    auto step = step_of(residuals);
    if (!step) break;
    const auto longest = [&](std::size_t from) {
      double most = 0;
      for (std::size_t i = from; i < 6; ++i) most = std::max(most, std::abs((*step)[i]));
      return most;
    };
    const double part = std::min(1.0, kMostTurn * frame.reach / longest(3));
    for (double& s : *step) s *= part;
    pose = frame.moved(pose, *step);
    if (longest(0) < kShortStep * frame.reach) break;
  }
  return pose;
}

}  // namespace lekalo::locate
