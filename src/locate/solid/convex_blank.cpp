#include "convex_blank.hpp"

#include <algorithm>

#include "lekalo/solid/mesh_clearance.hpp"

namespace lekalo::locate {
namespace {

using solid::Vector;

/// A blank with more triangles takes the usual way.
constexpr std::size_t kMostTriangles = 1024;
/// A vertex counts as behind a plane up to this part of the coordinates, and directions are the same if the
/// product is that.
constexpr double kBehind = 0x1p-40, kSame = 1 - 0x1p-42;
/// The foremost vertex of a part with more of them is found by its tree.
constexpr std::size_t kFewVertices = 512;

}  // namespace

std::optional<ConvexBlank> ConvexBlank::of(const solid::Mesh& blank, const solid::TriangleTree& tree) {
  if (blank.triangles.size() > kMostTriangles || surface_points(blank).size() != 1) return std::nullopt;
  const double behind = kBehind * tree.largest();
  ConvexBlank made;
  Vector middle;
  for (const Vector v : blank.vertices)
    middle = middle + 1.0 / static_cast<double>(blank.vertices.size()) * v;
  if (!tree.holds(middle)) return std::nullopt;
  for (const auto& [i, j, k] : blank.triangles) {
    const Vector at = blank.vertices[i], across = cross(blank.vertices[j] - at, blank.vertices[k] - at);
    const double size = norm(across);
    if (!(size > 0)) continue;
    Vector n = 1 / size * across;
    if (dot(n, middle - at) < 0) n = -n;
    const auto same = [&](const Plane& plane) { return dot(plane.normal, n) > kSame; };
    if (std::any_of(made.planes_.begin(), made.planes_.end(), same)) continue;
    const Vector foremost = *std::min_element(blank.vertices.begin(), blank.vertices.end(),
                                              [n](Vector a, Vector b) { return dot(n, a) < dot(n, b); });
    if (dot(n, foremost - at) < -behind) return std::nullopt;
    made.planes_.push_back({n, foremost});
  }
  if (made.planes_.empty()) return std::nullopt;
  return made;
}

void ConvexBlank::foremost(const solid::Mesh& part, const solid::TriangleTree& tree,
                           const solid::Motion& motion, double most, std::size_t count,
                           std::vector<Foremost>& found) const {
  found.clear();
  for (const Plane& plane : planes_) {
    const Vector n = motion.turned_back(plane.normal);
    Vector first = part.vertices.front();
    if (part.vertices.size() > kFewVertices) {
      first = tree.foremost(n);
    } else {
      double least = dot(n, first);
      for (const Vector v : part.vertices)
        if (const double along = dot(n, v); along < least) least = along, first = v;
    }
    const double height = dot(plane.normal, motion(first) - plane.place);
    if (height < most) found.push_back({&plane, first, height});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Foremost& a, const Foremost& b) { return a.height < b.height; });
  if (found.size() > count) found.resize(count);
}

}  // namespace lekalo::locate
