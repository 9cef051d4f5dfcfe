#include "self_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

/// Returns about where the way from p to q meets the plane of a triangle that parts them.
Near3 meeting_of(const Vec3& p, const Vec3& q, const Triangle3& t) {
  const std::array<Near3, 3> plane = near_middle(t);
  const Near3 from = near_middle(p), way = near_middle(q) - from, n = normal(plane);
  // Heights that are lost in rounding leave a place between p and q nevertheless.
  const double lost = std::numeric_limits<double>::min();
  const double before = std::abs(dot(n, from - plane[0])) + lost;
  const double after = std::abs(dot(n, from + way - plane[0])) + lost;
  return from + way * (before / (before + after));
}

/// An edge of a triangle; those of the same ends stand side by side when they are sorted.
struct SheetEdge {
  std::pair<std::uint32_t, std::uint32_t> ends;
  std::uint32_t triangle, from;
  auto operator<=>(const SheetEdge&) const = default;
};

std::vector<SheetEdge> sheet_edges(const SolidMesh& mesh) {
  std::vector<SheetEdge> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}})
      edges.push_back({std::minmax({from, to}), t, from});
  }
  ask(edges.size());
  std::ranges::sort(edges);
  return edges;
}

/// The sheets of a surface: triangles that hang together by edges with just two of them. Each triangle has
/// two faces, 2 t before it and 2 t + 1 behind, and those of one side of a sheet are one set. So a sheet of
/// one side alone, which always goes through itself, is one set.
class Sheets {
 public:
  explicit Sheets(const SolidMesh& mesh) : parent_(2 * mesh.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Returns a face that stands for all of its side.
  std::uint32_t of(std::uint32_t face) {
    while (parent_[face] != face) face = parent_[face] = parent_[parent_[face]];
    return face;
  }

  void unite(const SheetEdge& one, const SheetEdge& other) {
    // Two triangles that look to one side run along their edge in opposite directions.
    const std::uint32_t turned = one.from == other.from ? 1 : 0;
    for (const std::uint32_t face : {0U, 1U}) {
      const auto [first, second] =
          std::minmax({of(2 * one.triangle + face), of(2 * other.triangle + (face ^ turned))});
      parent_[second] = first;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
};

class CrossingSearch {
 public:
  explicit CrossingSearch(const PlacedSolid& body)
      : body_(body),
        sheets_(body.mesh()),
        pairs_left_(limits::most_meeting_pieces(body.mesh().triangles.size())) {
    const Box3& whole = body.tree().whole();
    found_.depth = std::min(kThick, kThickPart * near_length(whole.high - whole.low));
  }

  SelfCrossings run() {
    look_at_edges();
    for (const auto& [triangle, through, place] : to_look_at_)
      if (changes_at(triangle, through, place)) return found_;
    look_at_sheets();
    return found_;
  }

 private:
  struct Look {
    std::uint32_t triangle, through;
    Near3 place;
  };

  void look_at_edges() {
    const std::vector<SheetEdge> edges = sheet_edges(body_.mesh());
    for (auto edge = edges.begin(), behind = edge; edge != edges.end(); edge = behind) {
      behind = std::ranges::upper_bound(edge, edges.end(), edge->ends, {}, &SheetEdge::ends);
      if (behind - edge == 2) sheets_.unite(edge[0], edge[1]);
      if (found_.complete) look_along(*edge);
    }
  }

  /// Notes the triangles that an edge runs through.
  void look_along(const SheetEdge& edge) {
    const std::array<std::uint32_t, 2> ends{edge.ends.first, edge.ends.second};
    const Vec3 &p = body_.at(ends[0]), &q = body_.at(ends[1]);
    Box3 around = box_of(p);
    around.hold(box_of(q));
    std::size_t met = 0;
    body_.tree().visit([&](const Box3& box) { return meet(box, around); },
                       [&](std::uint32_t t) {
                         ++met;
                         // No edge that ends at a corner of a triangle runs through its inside.
                         if (std::ranges::find_first_of(ends, body_.mesh().triangles[t]) == ends.end() &&
                             runs_through(ends, t))
                           note(edge.triangle, t, meeting_of(p, q, body_.triangle(t)));
                       });
    found_.complete = met <= pairs_left_;
    pairs_left_ -= met;
  }

  /// Says exactly whether an edge runs through a triangle's inside from one side to the other.
  [[nodiscard]] bool runs_through(const std::array<std::uint32_t, 2>& ends, std::uint32_t t) const {
    const Vec3 &p = body_.at(ends[0]), &q = body_.at(ends[1]);
    if (distance({p, q, q}, body_.triangle(t), 0).low > 0) return false;
    return pierces(body_.exactly_at(ends[0]), body_.exactly_at(ends[1]), body_.exact_triangle(t));
  }

  void note(std::uint32_t triangle, std::uint32_t through, const Near3& place) {
    if (!found_.first) found_.first = SelfCrossing{place, triangle};
    if (to_look_at_.size() < kMostCloseLooks)
      to_look_at_.insert(to_look_at_.end(), {{triangle, through, place}, {through, triangle, place}});
  }

  /// Returns 1 where inside is before a triangle, which is the side from which its corners turn
  /// counter-clockwise, -1 where it is behind, and 0 where balls have no room at that place, or inside is on
  /// both sides or none.
  [[nodiscard]] int inside_at(std::uint32_t triangle, const Near3& place) const {
    const int before = ball_beside(triangle, place, found_.depth);
    const int behind = ball_beside(triangle, place, -found_.depth);
    return before * behind < 0 ? before : 0;
  }

  /// Returns 1 where the middle of a ball that touches a triangle is inside, and -1 where it is outside; 0
  /// where the ball has no room. The side of the triangle is that of the sign of the depth.
  [[nodiscard]] int ball_beside(std::uint32_t triangle, const Near3& place, double depth) const {
    const Near3 n = normal(near_middle(body_.triangle(triangle)));
    const double length = near_length(n);
    if (!(length > 0)) return 0;
    const Near3 middle = place + n * (depth / length);
    if (!has_room(middle)) return 0;
    const Exact3 exactly{Fraction(middle[0]), Fraction(middle[1]), Fraction(middle[2])};
    return body_.holds(just(middle), exactly) ? 1 : -1;
  }

  [[nodiscard]] bool has_room(const Near3& middle) const {
    const Near3 reach{found_.depth, found_.depth, found_.depth};
    const Box3 around{middle - reach, middle + reach};
    const Vec3 at = just(middle);
    double nearest = found_.depth;
    body_.tree().visit([&](const Box3& box) { return meet(box, around); },
                       [&](std::uint32_t number) {
                         nearest = std::min(nearest, distance({at, at, at}, body_.triangle(number)).low);
                       });
    return nearest >= (1 - kTouch) * found_.depth;
  }

  /// Says whether inside changes sides on a triangle where another one runs through it: on either side of the
  /// line of both.
  bool changes_at(std::uint32_t triangle, std::uint32_t through, const Near3& place) {
    const Near3 n = normal(near_middle(body_.triangle(triangle)));
    const Near3 across = cross(n, cross(n, normal(near_middle(body_.triangle(through)))));
    // Planes so near to each other that this has no length give no place on the triangle.
    const Near3 step = across * (found_.depth / near_length(across));
    if (inside_along(triangle, place, step) * inside_along(triangle, place, step * -1.0) >= 0) return false;
    found_.changing = SelfCrossing{place, triangle};
    return true;
  }

  /// Returns inside_at() the first place on a triangle that tells it, in steps that double.
  [[nodiscard]] int inside_along(std::uint32_t triangle, const Near3& from, Near3 step) const {
    int inside = 0;
    while (inside == 0) {
      const Vec3 at = just(from + step);
      if (!(distance({at, at, at}, body_.triangle(triangle)).high <= kTouch * found_.depth)) break;
      inside = inside_at(triangle, from + step);
      step = step * 2.0;
    }
    return inside;
  }

  /// Bodies that overlap on the same planes have no edge that runs through a triangle's inside. So the
  /// middles of the triangles of a sheet are compared.
  void look_at_sheets() {
    const std::size_t count = body_.mesh().triangles.size();
    const std::size_t step = found_.first ? 1 : 1 + count / kMostMiddles;
    // The triangles of a sheet at whose middles inside is on this side of it.
    std::vector<std::vector<std::uint32_t>> of_side(2 * count);
    for (std::uint32_t t = 0; t < count; t += static_cast<std::uint32_t>(step)) {
      const int inside = inside_at(t, middle_of(t));
      const std::uint32_t face = 2 * t + static_cast<std::uint32_t>(1 - inside) / 2;
      if (inside != 0) of_side[sheets_.of(face)].push_back(t);
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      const auto &before = of_side[sheets_.of(2 * t)], &behind = of_side[sheets_.of(2 * t + 1)];
      if (before.empty() || behind.empty()) continue;
      // The fewer ones are those that are odd.
      const std::uint32_t odd =
          std::ranges::min(before, behind, {}, &std::vector<std::uint32_t>::size).front();
      found_.changing = SelfCrossing{middle_of(odd), odd};
      return;
    }
  }

  [[nodiscard]] Near3 middle_of(std::uint32_t triangle) const {
    const auto [a, b, c] = near_middle(body_.triangle(triangle));
    return (a + b + c) * (1.0 / 3);
  }

  const PlacedSolid& body_;
  Sheets sheets_;
  SelfCrossings found_;
  std::size_t pairs_left_;
  std::vector<Look> to_look_at_;
};

}  // namespace

SelfCrossings self_crossings(const PlacedSolid& body) { return CrossingSearch(body).run(); }

}  // namespace lekalo::verify
