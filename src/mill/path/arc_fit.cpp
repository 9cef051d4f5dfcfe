#include "arc_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::mill {
namespace {

using geom::EdgeKind;
using geom::Point;

constexpr double kLargestRadius = 1000;  // mm; beyond it controls lose digits of I and J
constexpr double kSameCentre = 1e-7;     // mm
constexpr double kHalfTurn = 3.1415926;

struct Fit {
  EdgeKind shape = EdgeKind::line;
  Point centre;
};

bool fits_line(std::span<const Point> points, double tolerance) {
  const Point a = points.front(), way = points.back() - a;
  const double whole = norm(way);
  if (!(whole > 0)) return false;
  double before = 0;
  for (const Point p : points) {
    const double along = dot(p - a, way) / whole;
    if (!(std::abs(cross(way, p - a)) <= 0.5 * tolerance * whole && along >= before)) return false;
    before = along;
  }
  return true;
}

/// Arcs through the two ends are told apart by the tangent of half their sweep, positive to the left; each
/// point allows those that pass within the tolerance, an interval of it.
std::optional<Fit> fitting_arc(std::span<const Point> points, double tolerance) {
  const Point a = points.front(), b = points.back();
  const double chord = norm(b - a);
  if (!(chord > 0)) return std::nullopt;
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    ask();
    const Point along = points[i + 1] - points[i - 1];
    const double length = norm(along);
    if (!(length > 0)) return std::nullopt;
    const Point off = (0.4 * tolerance / length) * geom::perpendicular(along);
    const auto tangent = [&](Point q) {
      const double d = dot(q - a, b - q);
      return d > 0 ? cross(q - a, b - q) / d : std::nan("");
    };
    const double left = tangent(points[i] + off), right = tangent(points[i] - off);
    if (!(left <= right)) return std::nullopt;
    low = std::max(low, left), high = std::min(high, right);
  }
  if (!(low <= high)) return std::nullopt;
  const double t = 0.5 * (low + high);
  if (!(std::abs(t) > 1e-9)) return std::nullopt;
  const Point centre = 0.5 * (a + b) + (1 / (2 * t)) * geom::perpendicular(b - a);
  const double radius = norm(a - centre), turn = t > 0 ? 1 : -1;
  if (!(radius <= kLargestRadius)) return std::nullopt;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point p = points[i] - centre, q = points[i + 1] - centre, way = q - p;
    if (!(turn * cross(p, q) > 0 && std::abs(norm(q) - radius) <= 0.5 * tolerance)) return std::nullopt;
    // The line's place nearest to the centre lies deepest in the circle.
    const double share = std::clamp(-dot(p, way) / dot(way, way), 0.0, 1.0);
    if (!(radius - norm(p + share * way) <= tolerance)) return std::nullopt;
  }
  return Fit{t > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, centre};
}

std::optional<Fit> fit_of(std::span<const Point> points, double tolerance) {
  if (points.size() == 2 || fits_line(points, tolerance)) return Fit{};
  return fitting_arc(points, tolerance);
}

class Fitter {
 public:
  Fitter(const PocketPath& path, double tolerance) : path_(path), tolerance_(tolerance) {}

  PocketPath run() {
    result_.fronts = path_.fronts;
    for (std::size_t i = 0; i < path_.moves.size();) {
      const PathMove& move = path_.moves[i];
      if (i == 0) {
        add(move);
        ++i;
      } else if (move.shape != EdgeKind::line) {
        add_arc(move);
        ++i;
      } else if (!level(i) || move.kind == PathMove::Kind::rapid) {
        add(move);
        ++i;
      } else {
        std::size_t end = i + 1;
        while (end < path_.moves.size() && like(move, path_.moves[end]) && level(end)) ++end;
        add_run(i, end);
        i = end;
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool level(std::size_t i) const { return path_.moves[i].z == path_.moves[i - 1].z; }
  static bool like(const PathMove& a, const PathMove& b) {
    return b.shape == EdgeKind::line && a.kind == b.kind && a.feed == b.feed;
  }
  [[nodiscard]] const PathMove& last() const { return result_.moves.back(); }

  void add(const PathMove& move) {
    if (!result_.moves.empty() && move.shape == EdgeKind::line && move.to == last().to && move.z == last().z)
      return;
    result_.moves.push_back(move);
  }

  void add_run(std::size_t begin, std::size_t end) {
    points_.assign(1, last().to);
    for (std::size_t i = begin; i < end; ++i)
      if (!(path_.moves[i].to == points_.back())) points_.push_back(path_.moves[i].to);
    const std::span<const Point> points(points_);
    for (std::size_t i = 0; i + 1 < points.size();) {
      // The reach of one motion is doubled while it fits, then halved between what fits and what does not.
      std::size_t good = 1, bad = 0;
      Fit best;
      while (bad == 0 || bad - good > 1) {
        const std::size_t most = points.size() - 1 - i;
        const std::size_t tried = bad == 0 ? std::min(2 * good, most) : (good + bad) / 2;
        if (tried == good) break;
        if (const auto fit = fit_of(points.subspan(i, tried + 1), tolerance_))
          good = tried, best = *fit;
        else
          bad = tried;
      }
      PathMove move = path_.moves[begin];
      move.to = points[i + good], move.shape = best.shape, move.centre = best.centre;
      add(move);
      i += good;
    }
  }

  void add_arc(const PathMove& move) {
    const Point from = last().to;
    const geom::Edge arc = arc_of(move, from);
    if (arc_radius(arc) > kLargestRadius) return add_chords(move, arc);
    if (result_.moves.size() >= 2) {
      PathMove& before = result_.moves.back();
      const PathMove& earlier = result_.moves[result_.moves.size() - 2];
      if (before.shape == move.shape && before.kind == move.kind && before.feed == move.feed &&
          before.z == move.z && earlier.z == move.z && norm(before.centre - move.centre) <= kSameCentre &&
          arc_sweep(arc_of(before, earlier.to)) + arc_sweep(arc) <= kHalfTurn) {
        before.to = move.to;
        return;
      }
    }
    add(move);
  }

  void add_chords(PathMove move, const geom::Edge& arc) {
    const double radius = arc_radius(arc), sweep = arc_sweep(arc);
    const double piece = std::sqrt(4 * tolerance_ / radius);  // half of the sagitta that is allowed
    const double pieces = std::ceil(std::max(1.0, sweep / piece)), z = last().z, drop = move.z - z;
    const Point end = move.to;
    move.shape = EdgeKind::line;
    for (double i = 1; i <= pieces; ++i) {
      const auto [sine, cosine] = geom::sincos((arc.kind == EdgeKind::arc_ccw ? sweep : -sweep) * i / pieces);
      const Point out = arc.from - arc.centre;
      move.to = i < pieces ? arc.centre + cosine * out + sine * geom::perpendicular(out) : end;
      move.z = z + drop * (i / pieces);
      add(move);
    }
  }

  const PocketPath& path_;
  double tolerance_;
  PocketPath result_;
  std::vector<Point> points_;
};

}  // namespace

PocketPath fitted(const PocketPath& path, double tolerance) { return Fitter(path, tolerance).run(); }

}  // namespace lekalo::mill
