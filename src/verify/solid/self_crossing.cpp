#include "self_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

/// Layers that are nowhere as thick as this, mm, or as this part of the body, are too thin to hold anything:
/// twice what `lekalo locate` lets pass, so that nothing it made is refused for its last digits.
constexpr double kThick = 0.02, kThickPart = 0x1p-9;
/// A ball touches a triangle where it comes nearer than its radius by this part of it at most.
constexpr double kTouch = 0x1p-10;
/// So many crossings are looked at closely, and so many triangles where none was found.
constexpr std::size_t kMostCloseLooks = 2000, kMostMiddles = 20'000;

Near3 near_middle(const Vec3& p) {
  Near3 middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = p[axis].low / 2 + p[axis].high / 2;
  return middle;
}
std::array<Near3, 3> near_middle(const Triangle3& t) {
  return {near_middle(t[0]), near_middle(t[1]), near_middle(t[2])};
}
double near_length(const Near3& v) { return std::sqrt(dot(v, v)); }

template <class Number>
Number height(const std::array<Of3<Number>, 3>& t, const Of3<Number>& p) {
  return dot(normal(t), p - t[0]);
}
/// Returns the volume that the way from p to q turns about an edge with.
template <class Number>
Number turn_about(const Of3<Number>& from, const Of3<Number>& to, const Of3<Number>& p,
                  const Of3<Number>& q) {
  return dot(cross(from - p, to - p), q - p);
}
/// Says whether the line through p and q surely passes a triangle by: it turns about one edge one way, and
/// about another the other way.
bool passes_by(const Triangle3& t, const Vec3& p, const Vec3& q) {
  int least = 1, most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int sure = sure_sign(turn_about(t[k], t[(k + 1) % 3], p, q));
    least = std::min(least, sure), most = std::max(most, sure);
  }
  return least < 0 && most > 0;
}

/// Returns twice the area of a, b, c as seen along an axis.
Span area_along(std::size_t axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

/// Says whether p and q surely lie beyond one edge of a triangle, as seen along the axis that its normal
/// leans to. Neighbours in a flat face do.
bool is_beside(const Triangle3& t, const Vec3& p, const Vec3& q) {
  const Near3 n = normal(near_middle(t));
  std::size_t axis = 0;
  for (const std::size_t other : {1U, 2U})
    if (std::abs(n[other]) > std::abs(n[axis])) axis = other;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = t[k], &to = t[(k + 1) % 3];
    const int inwards = sure_sign(area_along(axis, from, to, t[(k + 2) % 3]));
    if (inwards != 0 && sure_sign(area_along(axis, from, to, p)) == -inwards &&
        sure_sign(area_along(axis, from, to, q)) == -inwards)
      return true;
  }
  return false;
}

/// The sheets of a surface: triangles that hang together by edges with just two of them. Each is turned as
/// the first one of its sheet, or against it.
class Sheets {
 public:
  explicit Sheets(const SolidMesh& mesh) : parent_(mesh.triangles.size()), against_(mesh.triangles.size()) {
    for (std::uint32_t t = 0; t < parent_.size(); ++t) parent_[t] = t;
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, bool>> edges;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
        edges.emplace_back(std::min(from, to), std::max(from, to), t, from < to);
      }
    ask(edges.size());
    std::ranges::sort(edges);
    const auto same = [](const auto& a, const auto& b) {
      return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
    };
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && same(edges[begin], edges[end])) ++end;
      if (end - begin == 2) unite(edges[begin], edges[begin + 1]);
    }
  }

  /// Returns the number of the sheet, and whether the triangle is turned against it.
  std::pair<std::uint32_t, bool> of(std::uint32_t triangle) {
    std::uint32_t at = triangle;
    bool against = false;
    while (parent_[at] != at) {
      // Each second triangle on the way goes on to the one behind its next; the first of a sheet is not
      // against itself.
      const std::uint32_t next = parent_[at];
      against_[at] = static_cast<char>(against_[at] != against_[next]);
      parent_[at] = parent_[next];
      against = against != (against_[at] != 0);
      at = parent_[at];
    }
    return {at, against};
  }

 private:
  template <class Edge>
  void unite(const Edge& one, const Edge& other) {
    const auto [a, a_against] = of(std::get<2>(one));
    const auto [b, b_against] = of(std::get<2>(other));
    if (a == b) return;
    // Two triangles that look to one side run along their edge in opposite directions.
    const bool turned = std::get<3>(one) == std::get<3>(other);
    parent_[std::max(a, b)] = std::min(a, b);
    against_[std::max(a, b)] = static_cast<char>((a_against != b_against) != turned);
  }

  std::vector<std::uint32_t> parent_;
  std::vector<char> against_;
};

class CrossingSearch {
 public:
  explicit CrossingSearch(const PlacedSolid& body) : body_(body) {
    const Box3& whole = body.tree().whole();
    found_.depth = std::min(kThick, kThickPart * near_length(whole.high - whole.low));
  }

  SelfCrossings run() {
    look_at_pairs();
    for (const auto& [triangle, through, place] : to_look_at_)
      if (changes_at(triangle, through, place) || changes_at(through, triangle, place)) return found_;
    look_at_sheets();
    return found_;
  }

 private:
  struct Look {
    std::uint32_t triangle, through;
    Near3 place;
  };

  void look_at_pairs() {
    std::size_t left = limits::most_meeting_pieces(body_.mesh().triangles.size());
    body_.tree().visit_meeting([&](std::uint32_t a, std::uint32_t b) {
      found_.complete = left-- > 0;
      // One that lies on one side of the other's plane, but for a corner of both, does not meet its inside.
      if (found_.complete && look_at_edges(a, b)) look_at_edges(b, a);
      return found_.complete;
    });
  }

  /// Notes the edges of s that run through t's inside. Returns whether t's may run through that of s.
  bool look_at_edges(std::uint32_t s, std::uint32_t t) {
    const auto &of_s = body_.mesh().triangles[s], &of_t = body_.mesh().triangles[t];
    std::array<bool, 3> common{};
    for (std::size_t k = 0; k < 3; ++k) common[k] = std::ranges::find(of_t, of_s[k]) != of_t.end();
    if (std::ranges::count(common, true) > 1) return false;
    const Triangle3 at = body_.triangle(t), from = body_.triangle(s);
    const Vec3 n = normal(at);
    std::array<int, 3> side{};
    for (std::size_t k = 0; k < 3; ++k)
      if (!common[k]) side[k] = sure_sign(dot(n, from[k] - at[0]));
    const auto lies = [&](int where) {
      for (std::size_t k = 0; k < 3; ++k)
        if (!common[k] && side[k] != where) return false;
      return true;
    };
    if (lies(1) || lies(-1)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      // A corner that both have lies in t's plane.
      if (common[k] || common[next] || side[k] * side[next] > 0) continue;
      if (passes_by(at, from[k], from[next]) || is_beside(at, from[k], from[next])) continue;
      if (!runs_through(s, k, t)) continue;
      const std::array<Near3, 3> plane = near_middle(at);
      const Near3 p = near_middle(from[k]), q = near_middle(from[next]);
      const double before = std::abs(height(plane, p)), after = std::abs(height(plane, q));
      const Near3 place = before + after > 0 ? p + (q - p) * (before / (before + after)) : p;
      if (!found_.first) found_.first = SelfCrossing{place, s};
      if (to_look_at_.size() < kMostCloseLooks) to_look_at_.push_back({s, t, place});
    }
    return true;
  }

  /// Says exactly whether edge k of s runs through t's inside from one side to the other.
  [[nodiscard]] bool runs_through(std::uint32_t s, std::size_t k, std::uint32_t t) const {
    const ExactTriangle of_s = body_.exact_triangle(s), of_t = body_.exact_triangle(t);
    const Exact3 &p = of_s[k], &q = of_s[(k + 1) % 3];
    if (sgn(height(of_t, p)) * sgn(height(of_t, q)) >= 0) return false;
    const int first = sgn(turn_about(of_t[0], of_t[1], p, q));
    return sgn(turn_about(of_t[1], of_t[2], p, q)) == first &&
           sgn(turn_about(of_t[2], of_t[0], p, q)) == first;
  }

  /// Says whether inside is before a triangle, which is the side from which its corners turn
  /// counter-clockwise; nothing where balls have no room at that place, or inside is on both sides or none.
  [[nodiscard]] std::optional<bool> inside_before(std::uint32_t triangle, const Near3& place) const {
    const std::optional<bool> before = holds_beside(triangle, place, 1, true);
    const std::optional<bool> behind = before ? holds_beside(triangle, place, -1, true) : std::nullopt;
    return behind && *before != *behind ? before : std::nullopt;
  }

  /// Says whether the middle of a ball that touches a triangle is inside.
  [[nodiscard]] std::optional<bool> holds_beside(std::uint32_t triangle, const Near3& place, double side,
                                                 bool needs_room) const {
    const Near3 n = normal(near_middle(body_.triangle(triangle)));
    const double length = near_length(n);
    if (!(length > 0)) return std::nullopt;
    const Near3 middle = place + n * (side * found_.depth / length);
    const Vec3 at{just(middle[0]), just(middle[1]), just(middle[2])};
    if (needs_room && !has_room(at)) return std::nullopt;
    return body_.holds(at, {Fraction(middle[0]), Fraction(middle[1]), Fraction(middle[2])});
  }

  [[nodiscard]] bool has_room(const Vec3& middle) const {
    const double radius = (1 - kTouch) * found_.depth;
    const Box3 point = box_of(middle);
    bool is_free = true;
    body_.tree().visit([&](const Box3& box) { return is_free && gap(point, box) < radius; },
                       [&](std::uint32_t number) {
                         const Triangle3 t = body_.triangle(number);
                         if (!(distance({middle, middle, middle}, t, radius).low >= radius)) is_free = false;
                       });
    return is_free;
  }

  /// Says whether inside changes sides on a triangle where another one runs through it: on either side of the
  /// line of both, in steps that double.
  bool changes_at(std::uint32_t triangle, std::uint32_t through, const Near3& place) {
    const Near3 n = normal(near_middle(body_.triangle(triangle)));
    const Near3 across = cross(n, cross(n, normal(near_middle(body_.triangle(through)))));
    const double length = near_length(across);
    if (!(length > 0)) return false;
    std::array<std::optional<bool>, 2> inside;
    for (const std::size_t side : {0U, 1U})
      for (double way = found_.depth; !inside[side]; way *= 2) {
        const Near3 p = place + across * ((side == 0 ? way : -way) / length);
        const Vec3 at{just(p[0]), just(p[1]), just(p[2])};
        if (!(distance({at, at, at}, body_.triangle(triangle)).high <= kTouch * found_.depth)) break;
        inside[side] = inside_before(triangle, p);
      }
    if (!inside[0] || !inside[1] || *inside[0] == *inside[1]) return false;
    found_.changing = SelfCrossing{place, triangle};
    return true;
  }

  [[nodiscard]] Near3 middle_of(std::uint32_t triangle) const {
    const std::array<Near3, 3> t = near_middle(body_.triangle(triangle));
    return (t[0] + t[1] + t[2]) * (1.0 / 3);
  }

  /// Bodies that overlap on the same planes have no edge that runs through a triangle's inside. So the
  /// middles of the triangles of a sheet are compared: first by a quick look, and where that differs with
  /// balls.
  void look_at_sheets() {
    Sheets sheets(body_.mesh());
    const std::size_t count = body_.mesh().triangles.size();
    const std::size_t step = found_.first ? 1 : (count + kMostMiddles - 1) / kMostMiddles;
    std::vector<std::array<std::vector<std::uint32_t>, 2>> of_sheet(count);
    for (std::uint32_t t = 0; t < count; t += static_cast<std::uint32_t>(step)) {
      ask(5);
      const std::optional<bool> before = holds_beside(t, middle_of(t), 1, false);
      const auto [sheet, against] = sheets.of(t);
      if (before) of_sheet[sheet][*before != against ? 1 : 0].push_back(t);
    }
    for (const auto& [outside, inside] : of_sheet) {
      if (outside.empty() || inside.empty()) continue;
      const bool few_inside = inside.size() < outside.size();
      const auto odd = shown(few_inside ? inside : outside, few_inside, sheets);
      if (!odd || !shown(few_inside ? outside : inside, !few_inside, sheets)) continue;
      found_.changing = SelfCrossing{middle_of(*odd), *odd};
      return;
    }
  }

  /// Returns the first of some triangles at whose middle balls show what a quick look did.
  [[nodiscard]] std::optional<std::uint32_t> shown(const std::vector<std::uint32_t>& triangles, bool inside,
                                                   Sheets& sheets) const {
    for (const std::uint32_t t : triangles) {
      const std::optional<bool> before = inside_before(t, middle_of(t));
      if (before && (*before != sheets.of(t).second) == inside) return t;
    }
    return std::nullopt;
  }

  const PlacedSolid& body_;
  SelfCrossings found_;
  std::vector<Look> to_look_at_;
};

}  // namespace

SelfCrossings self_crossings(const PlacedSolid& body) { return CrossingSearch(body).run(); }

}  // namespace lekalo::verify
