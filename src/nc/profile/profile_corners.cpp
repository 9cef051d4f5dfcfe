#include "profile_corners.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::nc {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// A path has a corner where it turns by more than 33 degrees. Corners of regular polygons with ten sides
/// turn by 36, and of those with twelve by 30, so that rounding decides of neither.
constexpr double kCosineOfCorner = 0.83867056794542405, kSweepOfCorner = 0.57595865315812877;
/// The kerf goes round a corner of a part in an arc of half a kerf; rounding leaves it below this many kerfs.
constexpr double kTightKerfs = 0.75;
/// Motions shorter than so many steps of the last decimal are not made for a feed.
constexpr double kShortestInSteps = 10;

bool is_line(const Edge& edge) { return edge.kind == EdgeKind::line; }

/// The unit vector along an edge at one of its ends.
Point direction(const Edge& edge, Point at) {
  Point way = edge.to - edge.from;
  if (!is_line(edge)) {
    way = geom::perpendicular(at - edge.centre);
    if (edge.kind == EdgeKind::arc_cw) way = -way;
  }
  return (1 / geom::norm(way)) * way;
}

/// The place on an edge so far behind its beginning.
Point place_at(const Edge& edge, double along) {
  if (is_line(edge)) return edge.from + (along / length_of(edge)) * (edge.to - edge.from);
  const double angle = along / geom::arc_radius(edge);
  const Point out = edge.from - edge.centre,
              aside = (edge.kind == EdgeKind::arc_ccw ? 1 : -1) * geom::perpendicular(out);
  const geom::SinCos turn = geom::sincos(angle);
  return edge.centre + turn.cosine * out + turn.sine * aside;
}

/// The stretches of a path that are slow: ascending, apart from each other, within [0, whole].
class SlowStretches {
 public:
  SlowStretches(const std::vector<Edge>& edges, const ProfileOptions& options) {
    const double reach = options.corners.distance_mm;
    double along = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Edge &edge = edges[k], &before = edges[k == 0 ? edges.size() - 1 : k - 1];
      const bool follows = before.to == edge.from;
      if (follows && geom::dot(direction(before, before.to), direction(edge, edge.from)) < kCosineOfCorner)
        slow_.emplace_back(along - reach, along + reach);
      const double next = along + length_of(edge);
      if (!is_line(edge) && geom::arc_radius(edge) <= kTightKerfs * options.kerf_mm &&
          geom::arc_sweep(edge) > kSweepOfCorner)
        slow_.emplace_back(along - reach, next + reach);
      along = next;
    }
    whole_ = along;
    if (!edges.empty() && edges.back().to == edges.front().from) go_round();
    join();
  }

  /// The first end of a stretch beyond a place, or the end of the path.
  [[nodiscard]] double next_end(double along) const {
    const auto here = ending_behind(along);
    return here == slow_.end() ? whole_ : here->first > along ? here->first : here->second;
  }
  [[nodiscard]] bool holds(double along) const {
    const auto here = ending_behind(along);
    return here != slow_.end() && here->first <= along;
  }

 private:
  using Stretches = std::vector<std::pair<double, double>>;
  [[nodiscard]] Stretches::const_iterator ending_behind(double along) const {
    return std::upper_bound(slow_.begin(), slow_.end(), along,
                            [](double place, const auto& one) { return place < one.second; });
  }

  /// Stretches of a closed path go on behind its end at its beginning, and the other way round.
  void go_round() {
    for (std::size_t k = 0, count = slow_.size(); k < count; ++k) {
      const auto [begin, end] = slow_[k];
      slow_.emplace_back(begin + whole_, end + whole_);
      slow_.emplace_back(begin - whole_, end - whole_);
    }
  }

  void join() {
    std::sort(slow_.begin(), slow_.end());
    Stretches joined;
    for (auto [begin, end] : slow_) {
      begin = std::max(begin, 0.0), end = std::min(end, whole_);
      if (!(begin < end)) continue;
      if (!joined.empty() && begin <= joined.back().second)
        joined.back().second = std::max(joined.back().second, end);
      else
        joined.emplace_back(begin, end);
    }
    slow_ = std::move(joined);
  }

  Stretches slow_;
  double whole_ = 0;
};

}  // namespace

std::vector<WrittenEdge> with_slow_corners(const std::vector<WrittenEdge>& path,
                                           const ProfileOptions& options) {
  if (!options.corners.wanted()) return path;
  const Resolution resolution = resolution_of(options);
  const double shortest = kShortestInSteps * resolution.step_mm();
  std::vector<Edge> edges;
  for (const WrittenEdge& edge : path) edges.push_back(edge_mm(edge, resolution));
  const SlowStretches slow(edges, options);
  std::vector<WrittenEdge> made;
  double before = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const double length = length_of(edges[k]);
    WrittenEdge rest = path[k];
    double from = 0;
    for (double end = slow.next_end(before + shortest) - before; end < length - shortest;
         end = slow.next_end(before + from + shortest) - before) {
      WrittenEdge piece = rest;
      piece.to = rest.from = resolution.rounded(place_at(edges[k], end));
      piece.slow = slow.holds(before + 0.5 * (from + end));
      made.push_back(piece);
      from = end;
    }
    rest.slow = slow.holds(before + 0.5 * (from + length));
    made.push_back(rest);
    before += length;
  }
  return made;
}

}  // namespace lekalo::nc
