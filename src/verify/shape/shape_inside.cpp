#include "shape_inside.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "edge_of_side.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "shape_distance.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

/// The direction of a ray, as the rotation that takes it to the right.
struct Ray {
  Span cosine, sine;
};
Vec turned(const Vec& v, const Ray& ray) {
  return {ray.cosine * v.x - ray.sine * v.y, ray.sine * v.x + ray.cosine * v.y};
}
Side turned(Side side, const Ray& ray) {
  for (Vec* v : {&side.from, &side.to, &side.centre, &side.first, &side.last}) *v = turned(*v, ray);
  return side;
}

/// Returns -1 when a is certainly below b, 1 when it is certainly above, 0 when that cannot be told.
int compare(Span a, Span b) { return surely_above(b, a) ? -1 : (surely_above(a, b) ? 1 : 0); }

/// Counts how often a line passes the ray from p to the right upwards, less how often downwards.
std::optional<int> crossings_of_line(const Vec& begin, const Vec& end, const Vec& p) {
  if (surely_above(p.x, begin.x) && surely_above(p.x, end.x)) return 0;
  const int from = compare(begin.y, p.y), to = compare(end.y, p.y);
  if (from * to == 0) return std::nullopt;
  if (from == to) return 0;
  if (surely_above(begin.x, p.x) && surely_above(end.x, p.x)) return to;
  const int turn = compare(cross(end - begin, p - begin), just(0));
  if (turn == 0) return std::nullopt;
  return turn == to ? to : 0;
}

std::optional<int> crossings_of_arc(const Side& arc, const Vec& p) {
  // Nothing is counted for a ray level with an end, or with what joins the end to the circle, and another ray
  // is tried.
  const Span off{-arc.off, arc.off};
  const auto level = [&](const Vec& end) { return compare(p.y, end.y + off) == 0; };
  if (level(arc.from) || level(arc.to)) return std::nullopt;
  const Span height = p.y - arc.centre.y;
  const int beyond_circle = compare(absolute(height), arc.radius);
  if (beyond_circle > 0) return 0;
  if (beyond_circle == 0) return std::nullopt;
  const Span half = square_root((arc.radius - height) * (arc.radius + height));
  int count = 0;
  for (const bool right : {true, false}) {
    const Span step = right ? half : -half;
    const int beyond = compare(arc.centre.x + step, p.x);
    if (beyond < 0) continue;
    if (!may_face(arc, {step, height})) continue;
    if (beyond == 0 || !surely_faces(arc, {step, height})) return std::nullopt;
    count += right == arc.ccw ? 1 : -1;
  }
  return count;
}

constexpr std::size_t kNoContour = std::numeric_limits<std::size_t>::max();

/// Returns how often a contour winds about p, or nothing where the ray does not tell.
std::optional<int> winding(const Shape& shape, std::size_t contour, const Vec& p, const Ray& ray) {
  const bool straight = ray.sine.high == 0;
  const Vec at = straight ? p : turned(p, ray);
  const Box place = box_of(p);
  std::optional<int> sum = 0;
  shape.contours->visit_chains(contour, place, [&](std::size_t first, std::size_t last) {
    const Side& side = shape.sides[first];
    std::optional<int> count;
    if (!side.arc || surely_apart(shape.tree->box(first), place)) {
      const Vec &from = side.from, &to = shape.sides[last].to;
      count = straight ? crossings_of_line(from, to, at)
                       : crossings_of_line(turned(from, ray), turned(to, ray), at);
    } else {
      count = straight ? crossings_of_arc(side, at) : crossings_of_arc(turned(side, ray), at);
    }
    sum = count ? std::optional(*sum + *count) : std::nullopt;
    return sum.has_value();
  });
  return sum;
}

/// The contours around a point, and those of which rounding leaves open whether they are; both ascending and
/// without the contour that the point is on.
struct Around {
  std::vector<std::size_t> surely, maybe;
};

Around around(const Shape& shape, const Vec& p, std::size_t except = kNoContour) {
  Around found;
  shape.contours->visit_about(box_of(p), [&](std::size_t contour) {
    if (contour == except) return;
    ask();
    // One ray may graze an end or a tangent where another does not. The first runs along x, and each other is
    // turned on by an angle that is no fraction of a turn, while those of corners of regular shapes are.
    Ray ray{just(1), just(0)};
    std::optional<int> turns = winding(shape, contour, p, ray);
    for (int others = 5; !turns && others != 0; --others) {
      const Span cosine = just(3) / just(5), sine = just(4) / just(5);
      ray = {ray.cosine * cosine - ray.sine * sine, ray.sine * cosine + ray.cosine * sine};
      turns = winding(shape, contour, p, ray);
    }
    if (turns == 0) return;
    (turns == 1 || turns == -1 ? found.surely : found.maybe).push_back(contour);
  });
  std::sort(found.surely.begin(), found.surely.end());
  std::sort(found.maybe.begin(), found.maybe.end());
  return found;
}

bool has(const std::vector<std::size_t>& numbers, std::size_t number) {
  return std::binary_search(numbers.begin(), numbers.end(), number);
}

/// Says whether any of the sorted numbers is one of [begin, end).
bool has_any(const std::vector<std::size_t>& numbers, std::size_t begin, std::size_t end) {
  const auto first = std::lower_bound(numbers.begin(), numbers.end(), begin);
  return first != numbers.end() && *first < end;
}

/// Says whether a piece holds a point with these contours around it, of which one is the piece's.
std::optional<bool> piece_holds(const Shape& shape, std::size_t piece, const Around& at) {
  const std::size_t outer = shape.piece_starts[piece], end = shape.piece_starts[piece + 1];
  if (has_any(at.surely, outer + 1, end)) return false;
  if (has(at.surely, outer) && !has_any(at.maybe, outer + 1, end)) return true;
  return std::nullopt;
}

/// Returns the piece that a contour belongs to.
std::size_t piece_of(const Shape& shape, std::size_t contour) {
  const auto after = std::upper_bound(shape.piece_starts.begin(), shape.piece_starts.end(), contour);
  return static_cast<std::size_t>(after - shape.piece_starts.begin()) - 1;
}

/// Returns the answer for any point of a contour for which rounding lets it be decided.
template <class Question>
auto for_any_point(const Shape& shape, std::size_t contour, Question question)
    -> decltype(question(std::declval<Vec>())) {
  const Side* const sides = shape.sides.data();
  for (const Side& side :
       std::span(sides + shape.contour_starts[contour], sides + shape.contour_starts[contour + 1]))
    for (const Vec& p : points_of(side))
      if (auto answer = question(p)) return answer;
  return std::nullopt;
}

}  // namespace

std::optional<bool> holds(const Shape& shape, const Vec& p) {
  const Around at = around(shape, p);
  bool sure = true;
  // A piece whose outer contour is not around the point does not hold it.
  for (const auto* contours : {&at.surely, &at.maybe})
    for (const std::size_t contour : *contours) {
      const auto in = piece_holds(shape, piece_of(shape, contour), at);
      if (in && *in) return true;
      if (!in) sure = false;
    }
  if (sure) return false;
  return std::nullopt;
}

Span signed_distance(const Vec& p, const Shape& shape) {
  const Span d = distance(p, shape);
  const std::optional<bool> in = holds(shape, p);
  if (!in) return {-d.high, d.high};
  return *in ? d : -d;
}

std::optional<bool> lies_within(const Shape& inner, const Shape& outer) {
  // A contour that meets no other lies on one side of it, and any of its points tells on which. If some
  // material of `inner` lay beyond `outer`, there would be one of two things: an outline of `inner` that is
  // not in `outer`, or a gap of `outer` filled by `inner`, whose outline then lies in `inner`.
  const auto all = [](const Shape& points, const Shape& shape, bool wanted) -> std::optional<bool> {
    for (std::size_t c = 0; c + 1 < points.contour_starts.size(); ++c) {
      const auto in = for_any_point(points, c, [&](const Vec& p) { return holds(shape, p); });
      if (!in) return std::nullopt;
      if (*in != wanted) return false;
    }
    return true;
  };
  const auto inside = all(inner, outer, true);
  if (!inside || !*inside) return inside;
  return all(outer, inner, false);
}

namespace {

/// Neighbours that cross again, away from the end they share, make a loop. A loop this deep is a mistake; a
/// smaller one comes from the digits of a drawing at a smooth joint. The depth is in mm, and more by a share
/// of the radius, as for the ends of arcs (docs/design/geometry.md).
constexpr double kLoop = 1e-3, kLoopOfRadius = 1e-6;

/// \pre one of them is an arc
bool cross_again(const Side& a, const Side& b, const Vec& shared) {
  if (!a.arc) return cross_again(b, a, shared);
  const Vec along = b.arc ? b.centre - a.centre : b.to - b.from;
  if (!surely_not_zero(along)) return false;
  // The other crossing is the shared point mirrored in the line of the centres, or in the perpendicular from
  // the arc's centre to the line.
  const Vec u = unit(along), w = shared - a.centre;
  const Vec part = u * (dot(u, w) + dot(u, w));
  const Vec other = b.arc ? a.centre + part - w : shared - part;
  const Span apart = length(other - shared);
  const Span depth = squared(apart) / (just(8) * a.radius);
  return surely_above(depth, just(kLoop) + just(kLoopOfRadius) * a.radius) && surely_beside(a, other) &&
         surely_beside(b, other);
}

/// \param whole  no other sides are in the contour
std::optional<std::string> fault_of_neighbours(const Shape& shape, std::size_t i, std::size_t j, bool whole) {
  const Side &a = shape.sides[i], &b = shape.sides[j];
  if (!a.written || !b.written) return std::nullopt;
  if (a.arc || b.arc) {
    // Two sides that make up the whole contour meet at both ends, and curves like these meet nowhere else. A
    // crossing beside the other end only comes from the digits of the radii.
    if (whole) return std::nullopt;
    if (!cross_again(a, b, a.written_to)) return std::nullopt;
    return fmt::format("sides {} and {} cross", i, j);
  }
  const Vec u = a.to - a.from, v = b.to - b.from;
  if (compare(cross(u, v), just(0)) != 0 || compare(dot(u, v), just(0)) > 0) return std::nullopt;
  return fmt::format("side {} runs back along side {}", j, i);
}

/// Checks neighbours in a contour of three sides. The third side joins their other ends and is a neighbour of
/// both, so no other check asks whether the two meet there.
std::optional<std::string> fault_of_three(const Shape& shape, std::size_t i, std::size_t j) {
  const Side &a = shape.sides[i], &b = shape.sides[j];
  if (!(a.arc || b.arc) || !a.written || !b.written) return std::nullopt;
  if (is_positive(distance(b.to, a)) && is_positive(distance(a.from, b))) return std::nullopt;
  return fmt::format("sides {} and {} meet, or cannot be told from it", std::min(i, j), std::max(i, j));
}

std::optional<std::string> misplaced(const Shape& shape, std::size_t contour) {
  const std::size_t p = piece_of(shape, contour), outer = shape.piece_starts[p];
  const bool is_hole = contour != outer;
  const auto at = for_any_point(shape, contour, [&](const Vec& point) -> std::optional<Around> {
    Around found = around(shape, point, contour);
    return found.maybe.empty() ? std::optional(found) : std::nullopt;
  });
  if (is_hole) {
    const std::vector<std::size_t> surely = at.value_or(Around{}).surely;
    if (!has(surely, outer))
      return fmt::format("hole {} of piece {} is not inside it", contour - outer - 1, p);
    const auto other = std::upper_bound(surely.begin(), surely.end(), outer);
    if (other != surely.end() && *other < shape.piece_starts[p + 1])
      return fmt::format("hole {} of piece {} lies in its hole {}", contour - outer - 1, p,
                         *other - outer - 1);
    return std::nullopt;
  }
  if (!at) return fmt::format("piece {} lies in other pieces, or cannot be told from it", p);
  for (const std::size_t around_it : at->surely) {
    const std::size_t q = piece_of(shape, around_it);
    if (piece_holds(shape, q, *at) == true)
      return fmt::format("piece {} lies in the material of piece {}", p, q);
  }
  return std::nullopt;
}

/// Returns the number of each side among the written ones of its contour. A line that joins an arc has the
/// arc's number.
std::vector<std::size_t> numbers_of(const Shape& shape) {
  std::vector<std::size_t> numbers = edge_of_side(shape);
  for (std::size_t c = 0; c + 1 < shape.contour_starts.size(); ++c) {
    const std::size_t begin = shape.contour_starts[c], first = numbers[begin];
    for (std::size_t k = begin; k < shape.contour_starts[c + 1]; ++k) numbers[k] -= first;
  }
  return numbers;
}

}  // namespace

std::optional<std::string> fault_of(const Shape& shape) {
  const std::vector<std::size_t> number = numbers_of(shape);
  const std::size_t most = limits::most_meeting_boxes(shape.sides.size());
  std::size_t left = most;
  for (std::size_t c = 0; c + 1 < shape.contour_starts.size(); ++c) {
    const std::size_t begin = shape.contour_starts[c], end = shape.contour_starts[c + 1];
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<std::size_t> others;
      shape.tree->visit([&](const Box& box) { return meet(box, shape.tree->box(i)); },
                        [&](std::size_t j) {
                          if (j > i) others.push_back(j);
                        });
      if (others.size() > left)
        return fmt::format("more than {} pairs of its sides have boxes that meet, too many to look at", most);
      left -= others.size();
      std::sort(others.begin(), others.end());
      ask(1 + others.size());
      for (const std::size_t j : others) {
        const bool next = j < end && number[j] <= number[i] + 1;
        const bool round = j < end && number[i] == 0 && number[j] == number[end - 1];
        const bool two = number[end - 1] == 1, three = number[end - 1] == 2;
        std::optional<std::string> fault;
        if (next) fault = fault_of_neighbours(shape, i, j, two);
        if (round && !fault) fault = fault_of_neighbours(shape, j, i, two);
        if (three && !fault) fault = round ? fault_of_three(shape, j, i) : fault_of_three(shape, i, j);
        if (fault) return fault;
        if (next || round) continue;
        if (carriers_apart(shape.sides[i], shape.sides[j])) continue;
        if (!is_positive(distance(shape.sides[i], shape.sides[j])))
          return fmt::format("sides {} and {} meet, or cannot be told from it", i, j);
      }
    }
  }
  for (std::size_t c = 0; c + 1 < shape.contour_starts.size(); ++c)
    if (auto fault = misplaced(shape, c)) return fault;
  return std::nullopt;
}

}  // namespace lekalo::verify
