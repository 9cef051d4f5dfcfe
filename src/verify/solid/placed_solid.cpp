#include "placed_solid.hpp"

#include <algorithm>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

std::vector<Box3> boxes_of(const SolidMesh& mesh, const std::vector<Vec3>& at) {
  std::vector<Box3> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    Box3 box = box_of(at[triangle[0]]);
    for (const std::uint32_t vertex : {triangle[1], triangle[2]}) box.hold(box_of(at[vertex]));
    boxes.push_back(box);
  }
  return boxes;
}

/// Returns twice the area that a, b, c turn about as seen from above.
template <class Number>
Number turn(const Of3<Number>& a, const Of3<Number>& b, const Of3<Number>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
template <class Number>
Number volume(const std::array<Of3<Number>, 3>& t, const Of3<Number>& p) {
  return dot(normal(t), p - t[0]);
}

/// The signs that a way straight up from a point asks for: the filter answers nearly always.
class WayUp {
 public:
  WayUp(const PlacedSolid& body, std::uint32_t number, const Vec3& p, const Exact3& exact_p)
      : body_(body), number_(number), t_(body.triangle(number)), p_(p), exact_p_(exact_p) {}

  bool crosses() {
    const int first = side_of_edge(0, 1);
    if (first == 0 || side_of_edge(1, 2) != first || side_of_edge(2, 0) != first) return false;
    // Seen from above the triangle turns as it does about the point, so its normal looks up where that is 1.
    const int sure = sure_sign(volume(t_, p_));
    return (sure != 0 ? sure : sgn(volume(exact(), exact_p_))) == -first;
  }

 private:
  const ExactTriangle& exact() {
    if (!exact_) exact_ = body_.exact_triangle(number_);
    return *exact_;
  }

  /// Returns the side of an edge on which the moved point lies, as seen from above; 0 for an upright edge.
  int side_of_edge(std::size_t from, std::size_t to) {
    if (const int sure = sure_sign(turn(t_[from], t_[to], p_)); sure != 0) return sure;
    const Exact3 &a = exact()[from], &b = exact()[to];
    if (const int sign = sgn(turn(a, b, exact_p_)); sign != 0) return sign;
    const int along_x = sgn(Fraction(b[0] - a[0]));
    return along_x != 0 ? along_x : -sgn(Fraction(b[1] - a[1]));
  }

  const PlacedSolid& body_;
  std::uint32_t number_;
  Triangle3 t_;
  const Vec3& p_;
  const Exact3& exact_p_;
  std::optional<ExactTriangle> exact_;
};

}  // namespace

SolidMotion::SolidMotion(const SolidPose& pose) {
  std::array<Fraction, 4> q;
  for (std::size_t k = 0; k < 4; ++k) q[k] = to_fraction(pose.quaternion[k]);
  const auto& [w, x, y, z] = q;
  const Fraction ww = w * w, xx = x * x, yy = y * y, zz = z * z, all = ww + xx + yy + zz;
  rows_[0] = {ww + xx - yy - zz, 2 * (x * y - w * z), 2 * (x * z + w * y)};
  rows_[1] = {2 * (x * y + w * z), ww - xx + yy - zz, 2 * (y * z - w * x)};
  rows_[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), ww - xx - yy + zz};
  for (std::size_t k = 0; k < 3; ++k) {
    for (Fraction& entry : rows_[k]) entry /= all;
    enclosed_rows_[k] = enclosed(rows_[k]);
    shift_[k] = to_fraction(pose.shift[k]);
  }
  enclosed_shift_ = enclosed(shift_);
}

Exact3 SolidMotion::operator()(const Exact3& p) const {
  return Exact3{dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)} + shift_;
}

Vec3 SolidMotion::operator()(const Vec3& p) const {
  return Vec3{dot(enclosed_rows_[0], p), dot(enclosed_rows_[1], p), dot(enclosed_rows_[2], p)} +
         enclosed_shift_;
}

PlacedSolid::PlacedSolid(const SolidMesh& mesh, const std::optional<SolidMotion>& motion)
    : mesh_(&mesh), motion_(motion) {
  at_.reserve(mesh.near.size());
  for (std::uint32_t v = 0; v < mesh.near.size(); ++v) {
    ask();
    const Vec3 own{mesh.enclosed(v, 0), mesh.enclosed(v, 1), mesh.enclosed(v, 2)};
    at_.push_back(motion_ ? (*motion_)(own) : own);
  }
  tree_ = BoxTree(boxes_of(mesh, at_));
  if (mesh.widths.empty()) return;
  narrowest_ = std::ranges::min(mesh.widths, {}, &Span::low).low;
  widest_ = std::ranges::max(mesh.widths, {}, &Span::high).high;
}

Exact3 PlacedSolid::exactly_at(std::uint32_t vertex) const {
  const Exact3 own{mesh_->exact(vertex, 0), mesh_->exact(vertex, 1), mesh_->exact(vertex, 2)};
  return motion_ ? (*motion_)(own) : own;
}

Triangle3 PlacedSolid::triangle(std::uint32_t number) const {
  const auto& [a, b, c] = mesh_->triangles[number];
  return {at_[a], at_[b], at_[c]};
}

ExactTriangle PlacedSolid::exact_triangle(std::uint32_t number) const {
  ask(10);
  const auto& [a, b, c] = mesh_->triangles[number];
  return {exactly_at(a), exactly_at(b), exactly_at(c)};
}

bool PlacedSolid::holds(const Vec3& enclosed, const Exact3& point) const {
  bool odd = false;
  Box3 way = box_of(enclosed);
  way.high[2] = kInfinity;
  tree_.visit([&](const Box3& box) { return gap(way, box) == 0; },
              [&](std::uint32_t number) {
                if (WayUp(*this, number, enclosed, point).crosses()) odd = !odd;
              });
  return odd;
}

std::vector<std::vector<std::uint32_t>> PlacedSolid::components() const {
  std::vector<std::uint32_t> parent(mesh_->near.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<char> used(parent.size(), 0);
  for (const auto& triangle : mesh_->triangles) {
    ask();
    for (const std::uint32_t vertex : triangle) {
      used[vertex] = 1;
      const std::uint32_t a = root(triangle.front()), b = root(vertex);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<std::uint32_t>> made;
  std::vector<std::size_t> number(parent.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    if (used[v] == 0) continue;
    // The root of a component is its first vertex.
    if (parent[v] == v) number[v] = made.size(), made.emplace_back();
    made[number[root(v)]].push_back(v);
  }
  return made;
}

std::vector<std::uint32_t> PlacedSolid::one_of_each_component() const {
  std::vector<std::uint32_t> firsts;
  for (const auto& component : components()) firsts.push_back(component.front());
  return firsts;
}

bool PlacedSolid::touches(const Vec3& enclosed, const Exact3& point) const {
  const Box3 place = box_of(enclosed);
  bool found = false;
  tree_.visit([&](const Box3& box) { return !(gap(place, box) > 0); },
              [&](std::uint32_t number) {
                if (distance({enclosed, enclosed, enclosed}, triangle(number)).low > 0) return;
                if (sgn(exact_squared_distance(point, exact_triangle(number))) == 0) found = true;
              });
  return found;
}

}  // namespace lekalo::verify
