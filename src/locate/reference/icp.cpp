#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/locate/reference.hpp"
#include "normal_equations.hpp"
#include "start.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Point;

// The perimeter is sampled in this many steps.
constexpr double kStepsAround = 360;
// A step below this part of the blank's size ends the iteration.
constexpr double kVanished = 1e-10;

double perimeter(const geom::ConvexPolygon& polygon) {
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) length += norm(polygon[polygon.next(i)] - polygon[i]);
  return length;
}

std::vector<Point> sampled_outline(const geom::ConvexPolygon& polygon) {
  const double step = perimeter(polygon) / kStepsAround;
  std::vector<Point> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], edge = polygon[polygon.next(i)] - a;
    const double pieces = std::max(1.0, std::ceil(norm(edge) / step));
    for (double j = 0; j < pieces; ++j) points.push_back(a + (j / pieces) * edge);
  }
  return points;
}

/// The part's edges with their unit normals, and a box around every run of about sqrt(m) of them, so that
/// most edges need not be looked at.
class PartLines {
 public:
  explicit PartLines(const geom::ConvexPolygon& part)
      : part_(part), run_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(part.size()))))) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Point edge = part[part.next(i)] - part[i];
      normals_.push_back((-1 / norm(edge)) * perpendicular(edge));
    }
    for (std::size_t first = 0; first < part.size(); first += run_) {
      geom::Ring corners;
      for (std::size_t i = first; i < std::min(first + run_, part.size()); ++i) {
        corners.push_back(part[i]);
        corners.push_back(part[part.next(i)]);
      }
      boxes_.push_back(geom::bounds(corners));
    }
  }

  /// Returns the edge with the point nearest to p, the first of equals.
  [[nodiscard]] std::size_t nearest(Point p) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t edge = 0;
    for (std::size_t block = 0; block < boxes_.size(); ++block) {
      if (!(distance_to(boxes_[block], p) < best)) continue;
      const std::size_t first = block * run_;
      for (std::size_t i = first; i < std::min(first + run_, part_.size()); ++i) {
        const double distance = geom::distance_to_segment(p, part_[i], part_[part_.next(i)]);
        if (distance < best) {
          best = distance;
          edge = i;
        }
      }
    }
    return edge;
  }

  /// Returns the normal that points outwards.
  [[nodiscard]] Point normal(std::size_t edge) const { return normals_[edge]; }
  /// Returns the signed distance from the line of the edge, positive outside.
  [[nodiscard]] double distance(std::size_t edge, Point p) const {
    return dot(normals_[edge], p - part_[edge]);
  }

 private:
  static double distance_to(const geom::Box& box, Point p) {
    const double dx = std::max({box.low.x - p.x, 0.0, p.x - box.high.x});
    const double dy = std::max({box.low.y - p.y, 0.0, p.y - box.high.y});
    return norm(Point{dx, dy});
  }

  const geom::ConvexPolygon& part_;
  std::size_t run_;
  std::vector<Point> normals_;
  std::vector<geom::Box> boxes_;
};

struct IcpState {
  /// The place of the part's centroid in the blank's frame.
  Point centre;
  double theta = 0;
  std::uint64_t iterations = 0;
  bool converged = false;
  double residual = 0;
};

class Registration {
 public:
  Registration(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank, const IcpOptions& options)
      : options_(options),
        lines_(part),
        source_(sampled_outline(blank)),
        part_centre_(outline_moments(part).centroid),
        size_(perimeter(blank) / 4) {}

  [[nodiscard]] IcpState run(Point centre, double theta) const {
    IcpState state{centre, theta};
    while (!state.converged && state.iterations < static_cast<std::uint64_t>(options_.max_iterations)) {
      ++state.iterations;
      const double moved = step(state);
      state.converged = moved <= kVanished * size_;
    }
    state.residual =
        std::sqrt(equations(state.centre, state.theta).squares / static_cast<double>(source_.size()));
    return state;
  }

 private:
  /// The motions are (dx, dy, size * dtheta) of the part about its centre.
  [[nodiscard]] NormalEquations<3> equations(Point centre, double theta) const {
    const BlankFromPart turn = BlankFromPart::from_angle(theta, {});
    NormalEquations<3> sum;
    for (const Point q : source_) {
      const Point arm = q - centre;
      const Point in_part = part_centre_ + turn.inverse().rotate(arm);
      const std::size_t edge = lines_.nearest(in_part);
      const Point normal = turn.rotate(lines_.normal(edge));
      sum.add({normal.x, normal.y, dot(normal, perpendicular(arm)) / size_}, lines_.distance(edge, in_part));
    }
    return sum;
  }

  /// Moves the state by one least-squares step and returns the length of the step.
  double step(IcpState& state) const {
    const auto motion = equations(state.centre, state.theta).solve();
    const double wanted = state.theta + motion[2] / size_;
    const double theta =
        options_.window.full_circle() ? wanted : std::clamp(wanted, options_.window.from, options_.window.to);
    const double turned = (theta - state.theta) * size_;
    state.centre = state.centre + Point{motion[0], motion[1]};
    state.theta = theta;
    return norm(Point{motion[0], motion[1]}) + std::abs(turned);
  }

  const IcpOptions& options_;
  PartLines lines_;
  std::vector<Point> source_;
  Point part_centre_;
  double size_;
};

Result<void> check_options(const IcpOptions& options) {
  LEKALO_CHECK(check_window(options.window));
  if (options.max_iterations < 1) {
    return failure(ErrorCode::usage,
                   fmt::format("ICP needs at least 1 iteration, not {}.", options.max_iterations));
  }
  const Placement& start = options.start;
  if (options.has_start &&
      !(std::isfinite(start.x) && std::isfinite(start.y) && std::abs(start.theta) <= geom::kMaxAngle)) {
    return failure(ErrorCode::usage, fmt::format("The start x {}, y {}, theta {} is not a usable pose.",
                                                 start.x, start.y, start.theta));
  }
  return {};
}

}  // namespace

Result<ReferenceResult> locate_icp(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                   const IcpOptions& options) {
  LEKALO_CHECK(check_options(options));
  const OutlineMoments of_part = outline_moments(part), of_blank = outline_moments(blank);
  const Registration registration(part, blank, options);

  ReferenceResult result;
  std::vector<IcpState> ends;
  if (options.has_start) {
    const Placement& start = options.start;
    const double theta = nearest_in(options.window, start.theta);
    const auto pose = BlankFromPart::from_angle(theta, {start.x, start.y});
    ends.push_back(registration.run(pose(of_part.centroid), theta));
  } else {
    for (const double angle : aligned_axes(of_part, of_blank)) {
      ends.push_back(registration.run(of_blank.centroid, nearest_in(options.window, angle)));
    }
  }
  const IcpState& end = *std::min_element(
      ends.begin(), ends.end(), [](const IcpState& a, const IcpState& b) { return a.residual < b.residual; });

  const double theta = nearest_in(options.window, end.theta);
  const Point t = translation_onto(of_part.centroid, end.centre, theta);
  result.best = measured_placement(part, blank, t.x, t.y, theta);
  result.starts_done = static_cast<int>(ends.size());
  result.iterations = end.iterations;
  result.found = result.best.clearance >= 0;
  result.converged = end.converged;
  result.residual = end.residual;
  return result;
}

}  // namespace lekalo::locate
