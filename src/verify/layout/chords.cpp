#include "chords.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "grid_number.hpp"
#include "lekalo/base/angle.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

constexpr double kStep = 0x1p-20;  // mm
/// Rounding to the grid and joining points that are too close take a vertex no further than 0.71 + 3 steps.
constexpr double kCorner = 4 * kStep;

/// The doubles that the written numbers of one drawn edge stand for, mm.
struct DrawnEdge {
  bool arc = false, ccw = true, full = false;
  Vec from, to, centre;
};

Vec vector(double x, double y) { return {just(x), just(y)}; }
Vec in_mm(GridPoint p) { return vector(static_cast<double>(p.x) * kStep, static_cast<double>(p.y) * kStep); }

std::vector<DrawnEdge> edges_of(const Shape& shape, std::size_t contour) {
  std::vector<DrawnEdge> edges;
  for (std::size_t k = shape.contour_starts[contour]; k < shape.contour_starts[contour + 1]; ++k) {
    if (!shape.sides[k].written) continue;
    const WrittenSide& e = shape.exact[k];
    edges.push_back({e.arc, e.ccw, shape.sides[k].sweep == Sweep::full,
                     vector(approximate(e.from_x), approximate(e.from_y)),
                     vector(approximate(e.to_x), approximate(e.to_y)),
                     e.arc ? vector(approximate(e.centre_x), approximate(e.centre_y)) : Vec{}});
  }
  return edges;
}

/// Encloses the distance of c from the segment. Where it is open which point of the segment is nearest, the
/// upper end is the distance from the nearer end of the segment; its line is never farther.
Span distance(const Vec& c, const Vec& from, const Vec& to) {
  const Vec along = to - from;
  const Span ends{std::min(length(from - c).low, length(to - c).low),
                  std::min(length(from - c).high, length(to - c).high)};
  const Span before = dot(c - from, along), after = dot(to - c, along);
  if (is_positive(-before) || is_positive(-after)) return ends;
  const Span line = absolute(cross(along, c - from)) / length(along);
  if (is_positive(before) && is_positive(after)) return line;
  return {line.low, ends.high};
}

double angle(const Vec& a, const Vec& b) { return std::atan2(cross(a, b).high, dot(a, b).high); }

/// Checks the chords that stand beside one arc, from one vertex of the drawing to the next.
std::optional<std::string> fault_of_arc(const std::vector<Vec>& chain, const DrawnEdge& arc, bool outside,
                                        double tolerance) {
  const Span first = length(arc.from - arc.centre), last = length(arc.to - arc.centre);
  const double least = std::min(first.low, last.low), most = std::max(first.high, last.high);
  // The chords may reach this far: the tolerance, the band of an arc whose two radii differ, and a rounding.
  const double reach = tolerance + (most - least) + kCorner;
  double turned = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const bool at_first = i == 0, at_last = i + 2 == chain.size();
    const double end = std::min(at_first ? first.low : most, at_last ? last.low : most);
    const Span chord = distance(arc.centre, chain[i], chain[i + 1]);
    if (outside) {
      const double nearest_allowed = at_first || at_last ? end - kCorner : most + 2 * kStep;
      if (!surely_above(chord, just(nearest_allowed))) return "a chord cuts into an arc";
      if (!surely_above(just(most + reach), length(chain[i + 1] - arc.centre)))
        return "a chord is farther from an arc than the tolerance";
    } else {
      // The ends are no farther from those of the arc than they may be.
      if (!at_last &&
          !surely_above(just(std::max(least - 2 * kStep, 2 * kStep)), length(chain[i + 1] - arc.centre)))
        return "a chord reaches out of an arc";
      if (!(chord.high >= least - reach)) return "a chord is farther from an arc than the tolerance";
    }
    turned += angle(chain[i] - arc.centre, chain[i + 1] - arc.centre);
  }
  double sweep = arc.full ? kTurn : angle(arc.from - arc.centre, arc.to - arc.centre) * (arc.ccw ? 1 : -1);
  if (sweep < 0) sweep += kTurn;
  // The chords must turn as the arc does. Chords that go around another time, or the other way, are off by a
  // whole turn, and rounding is far below half of one. Arcs of a few steps are not asked, because their ends
  // may be anywhere in them.
  if (most > 64 * kStep && !(std::abs(turned * (arc.ccw ? 1 : -1) - sweep) < 1))
    return "the chords of an arc do not run around its centre with it";
  return std::nullopt;
}

class Walk {
 public:
  Walk(const GridLoop& loop, std::size_t start, bool backwards)
      : loop_(loop), at_(start), backwards_(backwards) {}
  [[nodiscard]] Vec point(std::size_t ahead = 0) const {
    const std::size_t n = loop_.size(), by = ahead % n;
    return in_mm(loop_[backwards_ ? (at_ + n - by) % n : (at_ + by) % n]);
  }
  void advance(std::size_t by) {
    const std::size_t n = loop_.size();
    walked_ += by;
    at_ = backwards_ ? (at_ + n - by % n) % n : (at_ + by) % n;
  }
  [[nodiscard]] std::size_t left() const { return loop_.size() - walked_; }

 private:
  const GridLoop& loop_;
  std::size_t at_, walked_ = 0;
  bool backwards_;
};

bool near(const Vec& a, const Vec& b) { return !surely_above(length(a - b), just(kCorner)); }

/// Returns how many points the walk must go to reach the next vertex of the drawing: of several near points
/// in a row the nearest one. Returns nothing when there is none.
std::optional<std::size_t> steps_to(const Walk& walk, const DrawnEdge& edge) {
  std::optional<std::size_t> found;
  const std::size_t most = edge.arc ? walk.left() : std::min<std::size_t>(1, walk.left());
  for (std::size_t i = edge.full ? 3 : 0; i <= most; ++i) {
    const bool is_near = near(walk.point(i), edge.to);
    if (is_near &&
        (!found || length(walk.point(i) - edge.to).low <= length(walk.point(*found) - edge.to).low))
      found = i;
    // A vertex that is near at once may be the beginning of a short arc that comes back, so a vertex farther
    // on takes precedence.
    if (!is_near && found && *found > 0) break;
  }
  return found;
}

std::optional<std::string> fault_of_walk(Walk walk, const std::vector<DrawnEdge>& edges, bool material_left,
                                         ChordSide side, double tolerance) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto steps = steps_to(walk, edges[e]);
    if (!steps) return fmt::format("no point is where edge {} of the drawing ends", e);
    if (edges[e].arc && *steps > 0) {
      std::vector<Vec> chain;
      for (std::size_t i = 0; i <= *steps; ++i) chain.push_back(walk.point(i));
      const bool outside = (edges[e].ccw == material_left) == (side == ChordSide::outside);
      if (auto fault = fault_of_arc(chain, edges[e], outside, tolerance))
        return fmt::format("{} (edge {} of the drawing)", *fault, e);
    }
    if (edges[e].arc && *steps == 0 && length(edges[e].from - edges[e].centre).high > 64 * kStep &&
        !near(edges[e].from, edges[e].to))
      return fmt::format("the arc of edge {} of the drawing is missing", e);
    walk.advance(*steps);
  }
  if (walk.left() != 0) return "it has more points than the drawing has edges for";
  return std::nullopt;
}

bool runs_counter_clockwise(const GridLoop& loop) {
  // The call turns the loop counter-clockwise.
  const GridOutline outline = make_outline({loop});
  return outline.edges.front().from == loop.front();
}

std::optional<std::string> fault_of_loop(const GridLoop& loop, bool is_hole,
                                         const std::vector<DrawnEdge>& edges, ChordSide side,
                                         double tolerance) {
  std::optional<std::string> first_fault;
  const bool ccw = runs_counter_clockwise(loop);
  for (std::size_t start = 0; start < loop.size(); ++start) {
    if (!near(in_mm(loop[start]), edges.front().from)) continue;
    for (const bool backwards : {false, true}) {
      const bool material_left = (ccw != backwards) != is_hole;
      auto fault = fault_of_walk(Walk(loop, start, backwards), edges, material_left, side, tolerance);
      if (!fault) return std::nullopt;
      if (!first_fault) first_fault = std::move(fault);
    }
  }
  return first_fault ? first_fault : "no point is where edge 0 of the drawing begins";
}

}  // namespace

std::optional<std::string> fault_of_chords(const std::vector<GridLoop>& loops, const Shape& drawn,
                                           ChordSide side, double tolerance_mm) {
  if (drawn.piece_starts.size() != 2) return "its curves are more than one piece";
  if (drawn.contour_starts.size() != loops.size() + 1)
    return fmt::format("it has {} loops and its curves {} contours", loops.size(),
                       drawn.contour_starts.size() - 1);
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (auto fault = fault_of_loop(loops[l], l > 0, edges_of(drawn, l), side, tolerance_mm))
      return l == 0 ? *fault : fmt::format("hole {}: {}", l - 1, *fault);
  return std::nullopt;
}

}  // namespace lekalo::verify
