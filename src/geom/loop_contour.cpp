#include "loop_contour.hpp"

#include <algorithm>
#include <cmath>

#include "around_vertex.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom::detail {
namespace {

/// One stretch of the loop, and which way it is run through.
struct Step {
  std::uint32_t stretch, origin;
  bool forwards;
};

/// An edge of the contour, and where its ends are on the outlines.
struct Made {
  Edge edge;
  double radius = 0;
  std::uint32_t first_origin = 0, last_origin = 0;
  bool forwards = true;
  /// True where the edge begins or ends where its outline edge does.
  bool from_whole = false, to_whole = false;
};

/// Returns the direction in which an edge leaves its start or arrives at its end, as a unit vector.
Point tangent(const Edge& edge, Point at) {
  if (edge.kind == EdgeKind::line) return (1 / norm(edge.to - edge.from)) * (edge.to - edge.from);
  const Point out = at - edge.centre, left = (1 / norm(out)) * perpendicular(out);
  return edge.kind == EdgeKind::arc_ccw ? left : -left;
}

double curvature(const Made& m) {
  if (m.edge.kind == EdgeKind::line) return 0;
  return m.edge.kind == EdgeKind::arc_ccw ? 1 / m.radius : -1 / m.radius;
}

/// Returns how far the corner between two edges moves when each of them moves by `error`.
double corner_shift(const Made& in, const Made& out, double error) {
  const Point back = -tangent(in.edge, in.edge.to), on = tangent(out.edge, out.edge.from);
  // The sine of half the opening between the two edges.
  const double half_sine = 0.5 * norm(on - back);
  // The shift if both edges were straight, which is infinite for a cusp.
  const double straight = error / half_sine;
  const double bend = std::abs(curvature(out) + curvature(in));
  if (half_sine > 0.1 || bend == 0) return straight;
  // At distance s the edges are opening * s + bend * s^2 / 2 apart. Where they bend towards each other,
  // either that lens is thinner than the error or the first term is the larger one.
  return std::min(straight, std::sqrt(4 * error / bend) + error);
}

/// Step 5 of docs/design/boolean.md: turns the stretches of a loop into edges again.
class LoopReader {
 public:
  LoopReader(const PlanarMap::Loop& loop, const Outlines& outlines, const Arrangement& a)
      : outlines_(outlines), a_(a) {
    for (const std::uint32_t h : loop.half_edges) {
      const std::uint32_t stretch = a_.edges[h / 2].stretch;
      steps_.push_back({stretch, a_.pieces[a_.stretches[stretch].piece].origin, h % 2 == 0});
    }
  }

  std::vector<Made> run() {
    const std::size_t count = steps_.size();
    const auto earliest = std::min_element(
        steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.stretch < b.stretch; });
    std::rotate(steps_.begin(), earliest, steps_.end());
    std::size_t first = 0;
    while (first < count && continues(steps_[(first + count - 1) % count], steps_[first])) ++first;
    // A full circle continues everywhere.
    if (first == count) first = 0;
    std::rotate(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(first), steps_.end());
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      end = begin + 1;
      while (end < count && continues(steps_[end - 1], steps_[end])) ++end;
      add_run(begin, end);
    }
    join_made();
    return std::move(made_);
  }

  [[nodiscard]] bool is_drawn_corner(const Made& a, const Made& b) const {
    // The two are parts of one edge, which was cut here.
    if (a.last_origin == b.first_origin && !(a.to_whole && b.from_whole)) return true;
    if (a.forwards != b.forwards || !a.to_whole || !b.from_whole) return false;
    return a.forwards ? outlines_.next[a.last_origin] == b.first_origin
                      : outlines_.next[b.first_origin] == a.last_origin;
  }

 private:
  [[nodiscard]] std::uint32_t first_stretch(std::uint32_t origin) const { return a_.origin_starts[origin]; }
  [[nodiscard]] std::uint32_t last_stretch(std::uint32_t origin) const {
    return a_.origin_starts[origin + 1] - 1;
  }

  [[nodiscard]] bool continues(const Step& a, const Step& b) const {
    if (a.origin != b.origin || a.forwards != b.forwards) return false;
    const std::uint32_t early = a.forwards ? a.stretch : b.stretch, late = a.forwards ? b.stretch : a.stretch;
    if (late == early + 1) return true;
    const Edge& edge = outlines_.edges[a.origin];
    return edge.kind != EdgeKind::line && edge.from == edge.to && early == last_stretch(a.origin) &&
           late == first_stretch(a.origin);
  }

  [[nodiscard]] Point begin_of(const Step& s) const {
    const Stretch& stretch = a_.stretches[s.stretch];
    return a_.vertices[s.forwards ? stretch.from : stretch.to];
  }
  [[nodiscard]] Point end_of(const Step& s) const {
    const Stretch& stretch = a_.stretches[s.stretch];
    return a_.vertices[s.forwards ? stretch.to : stretch.from];
  }
  [[nodiscard]] const Piece& piece_of(const Step& s) const {
    return a_.pieces[a_.stretches[s.stretch].piece];
  }

  void add_run(std::size_t begin, std::size_t end) {
    const Step &first = steps_[begin], &last = steps_[end - 1];
    const std::uint32_t origin = first.origin;
    const Edge edge = first.forwards ? outlines_.edges[origin] : reversed(outlines_.edges[origin]);
    const bool all = end - begin == last_stretch(origin) + 1 - first_stretch(origin);
    if (all && (edge.from == edge.to || (begin_of(first) == edge.from && end_of(last) == edge.to))) {
      const double radius = edge.kind == EdgeKind::line ? 0 : arc_radius(edge);
      made_.push_back({edge, radius, origin, origin, first.forwards, true, true});
      return;
    }
    for (std::size_t i = begin, stop = begin; i < end; i = stop) {
      while (stop < end && piece_of(steps_[stop]).step == piece_of(steps_[i]).step) ++stop;
      add_part(i, stop);
    }
  }

  /// Adds the edge that some steps of one line, or of one arc, make up.
  void add_part(std::size_t begin, std::size_t end) {
    ask();
    const Step &first = steps_[begin], &last = steps_[end - 1];
    const Piece& piece = piece_of(first);
    Made m;
    m.edge = {EdgeKind::line, begin_of(first), end_of(last), {}};
    m.first_origin = m.last_origin = first.origin;
    m.forwards = first.forwards;
    const std::uint32_t low = first_stretch(first.origin), high = last_stretch(first.origin);
    m.from_whole = first.stretch == (first.forwards ? low : high);
    m.to_whole = last.stretch == (last.forwards ? high : low);
    if (is_arc(piece)) {
      const double chord = norm(m.edge.to - m.edge.from);
      const bool flat = chord < kShortArc * a_.snap || chord * chord < 2 * a_.snap * piece.radius;
      // A piece turns by a quarter at most.
      std::size_t pieces = 1;
      for (std::size_t i = begin + 1; i < end; ++i)
        if (a_.stretches[steps_[i].stretch].piece != a_.stretches[steps_[i - 1].stretch].piece) ++pieces;
      // The arc goes nearly once around, which its ends alone do not show.
      if (flat && pieces > 2) {
        add_part(begin, begin + (end - begin) / 2);
        add_part(begin + (end - begin) / 2, end);
        return;
      }
      if (!flat) {
        m.edge.kind = piece.kind;
        if (!first.forwards)
          m.edge.kind = piece.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
        m.edge.centre = piece.centre;
        m.radius = piece.radius;
      }
    }
    made_.push_back(m);
  }

  /// Says whether two neighbours lie on one line exactly, or on one circle, and were not neighbours in the
  /// drawing.
  [[nodiscard]] bool joins(const Made& a, const Made& b) const {
    if (a.edge.kind != b.edge.kind || is_drawn_corner(a, b)) return false;
    if (a.edge.kind == EdgeKind::line)
      return orientation(a.edge.from, a.edge.to, b.edge.to) == 0 &&
             dot(a.edge.to - a.edge.from, b.edge.to - b.edge.from) > 0;
    return a.edge.centre == b.edge.centre && std::abs(a.radius - b.radius) <= 2 * a_.snap &&
           norm(b.edge.to - a.edge.from) >= 2 * kShortArc * a_.snap;
  }
  static void append(Made& a, const Made& b) {
    a.edge.to = b.edge.to;
    a.last_origin = b.last_origin;
    a.to_whole = b.to_whole;
  }

  void join_made() {
    std::vector<Made> joined;
    for (const Made& m : made_) {
      if (!joined.empty() && joins(joined.back(), m))
        append(joined.back(), m);
      else
        joined.push_back(m);
    }
    if (joined.size() > 2 && joins(joined.back(), joined.front())) {
      append(joined.back(), joined.front());
      joined.erase(joined.begin());
    }
    made_ = std::move(joined);
  }

  const Outlines& outlines_;
  const Arrangement& a_;
  std::vector<Step> steps_;
  std::vector<Made> made_;
};

}  // namespace

LoopContour contour_of(const PlanarMap::Loop& loop, const Outlines& outlines, const Arrangement& arrangement,
                       double edge_error) {
  LoopReader reader(loop, outlines, arrangement);
  const std::vector<Made> made = reader.run();
  LoopContour result;
  for (std::size_t i = 0; i < made.size(); ++i) {
    result.contour.push_back(made[i].edge);
    result.origins.push_back(made[i].first_origin);
    const Made& next = made[i + 1 == made.size() ? 0 : i + 1];
    if (made.size() > 1 && !reader.is_drawn_corner(made[i], next))
      result.corner_error = std::max(result.corner_error, corner_shift(made[i], next, edge_error));
  }
  return result;
}

}  // namespace lekalo::geom::detail
