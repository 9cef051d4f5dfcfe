#include "lekalo/solid/symmetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/solid/motion.hpp"
#include "lekalo/solid/principal_axes.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {
namespace {

/// So many vertices are looked at.
constexpr std::size_t kLooked = 150;
/// No vertex nearer to the centre than this part of the farthest is brought to others.
constexpr double kFarEnough = 0.25;
/// Vertices are as far from the centre as each other within this part of the farthest: coordinates in four
/// bytes are.
constexpr double kAlike = 0x1p-21;
/// With more pairs of vertices than this, or rotations that bring two to them, nothing is said.
constexpr std::size_t kMostPairs = 1'000'000, kMostTried = 4000;
/// Axes are the same if their product is this.
constexpr double kSameAxis = 0.9999;
/// Two axes of inertia are as long as each other within this part.
constexpr double kSameSpread = 1e-3;
/// Turns that are no part of one which a body could have instead of any, rad.
constexpr std::array kOddTurns{0.377, 1.123, 2.459};

Motion turn_about(Vector axis, double angle) {
  const geom::SinCos turn = geom::sincos(angle);
  const double c = turn.cosine, s = turn.sine, d = 1 - c;
  const Vector n = axis;
  return {{{{c + n.x * n.x * d, n.x * n.y * d - n.z * s, n.x * n.z * d + n.y * s},
            {n.x * n.y * d + n.z * s, c + n.y * n.y * d, n.y * n.z * d - n.x * s},
            {n.x * n.z * d - n.y * s, n.y * n.z * d + n.x * s, c + n.z * n.z * d}}},
          {}};
}

Vector unit(Vector v) { return 1 / norm(v) * v; }

/// Axes across each other, the first along a, the second as near to b as can be.
std::array<Vector, 3> frame_of(Vector a, Vector b) {
  const Vector x = unit(a), z = unit(cross(a, b));
  return {x, cross(z, x), z};
}

/// The rotation that brings one frame onto another.
Motion rotation_between(const std::array<Vector, 3>& from, const std::array<Vector, 3>& to) {
  Motion made;
  made.rotation = {};
  for (std::size_t k = 0; k < 3; ++k) {
    made.rotation[0] = made.rotation[0] + to[k].x * from[k];
    made.rotation[1] = made.rotation[1] + to[k].y * from[k];
    made.rotation[2] = made.rotation[2] + to[k].z * from[k];
  }
  return made;
}

class Finder {
 public:
  Finder(const Mesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {}

  Symmetry find() {
    const PrincipalAxes inertia = principal_axes(mesh_);
    found_.centre = inertia.centre;
    if (!(inertia.volume > 0)) return found_;
    const std::size_t step = mesh_.vertices.size() / kLooked + 1;
    for (std::size_t v = 0; v < mesh_.vertices.size(); v += step) looked_.push_back(seen(v));
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = inertia.spread[(k + 1) % 3], b = inertia.spread[(k + 2) % 3];
      if (std::abs(a - b) <= kSameSpread * std::max(a, b)) try_any_turn(inertia.axes[k]);
    }
    if (found_.axes.empty()) try_vertices();
    if (found_.axes.empty()) return found_;
    std::stable_sort(found_.axes.begin(), found_.axes.end(), [](const auto& a, const auto& b) {
      return a.turns - 1 > b.turns - 1;  // 0 is the most
    });
    return found_;
  }

 private:
  [[nodiscard]] Vector seen(std::size_t vertex) const { return mesh_.vertices[vertex] - found_.centre; }

  bool leaves_as_it_is(const Motion& turn) {
    if (!tree_) tree_.emplace(mesh_);
    const auto is_on = [&](Vector p) {
      const auto near = tree_->nearest(found_.centre + p, 2 * tolerance_);
      return near && near->low <= tolerance_;
    };
    return std::all_of(looked_.begin(), looked_.end(),
                       [&](Vector p) { return is_on(turn.turned(p)) && is_on(turn.turned_back(p)); });
  }

  bool has_any_turn(Vector axis) {
    return std::all_of(kOddTurns.begin(), kOddTurns.end(),
                       [&](double angle) { return leaves_as_it_is(turn_about(axis, angle)); });
  }

  void try_any_turn(Vector axis) {
    if (!has_any_turn(axis)) return;
    found_.axes.push_back({axis, 0});
    found_.rotations = 0;
    // Half a turn over is one about any line across then.
    const Vector across = unit(cross(axis, std::abs(axis.x) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0}));
    if (leaves_as_it_is(turn_about(across, kPi))) found_.axes.push_back({across, 2});
  }

  /// The vertices that are as far from the centre as one that has the fewest others so far.
  std::vector<std::uint32_t> fewest_alike() {
    std::vector<std::uint32_t> order(mesh_.vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<double> far;
    for (const std::uint32_t v : order) far.push_back(norm(seen(v)));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return far[a] > far[b]; });
    alike_ = std::min(tolerance_, kAlike * far[order[0]]);
    std::vector<std::uint32_t> best;
    for (std::size_t first = 0; first < order.size() && far[order[first]] > kFarEnough * far[order[0]];) {
      // All that follow closely are alike, so that no two of them are told apart by rounding.
      std::size_t end = first + 1;
      while (end < order.size() && far[order[end - 1]] - far[order[end]] <= alike_) ++end;
      if (best.empty() || end - first < best.size())
        best.assign(order.begin() + static_cast<std::ptrdiff_t>(first),
                    order.begin() + static_cast<std::ptrdiff_t>(end));
      first = end;
    }
    return best;
  }

  /// Two vertices, which say how the body lies, are brought to all others that are as far from the centre and
  /// each other.
  void try_vertices() {
    const std::vector<std::uint32_t> alike = fewest_alike();
    const Vector first = seen(alike.front());
    std::uint32_t other = 0;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
      if (norm(cross(first, seen(v))) > norm(cross(first, seen(other)))) other = v;
    const Vector second = seen(other);
    std::vector<Vector> as_second;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
      if (std::abs(norm(seen(v)) - norm(second)) <= 2 * alike_) as_second.push_back(seen(v));
    if (alike.size() * as_second.size() > kMostPairs) return;
    const std::array<Vector, 3> from = frame_of(first, second);
    std::size_t tried = 0;
    for (const std::uint32_t v : alike) {
      ask();
      for (const Vector to : as_second) {
        if (std::abs(norm(seen(v) - to) - norm(first - second)) > 4 * alike_) continue;
        if (++tried > kMostTried) {
          found_ = {found_.centre, {}, 1};
          return;
        }
        const Motion turn = rotation_between(from, frame_of(seen(v), to));
        if (!does_nothing(turn) && leaves_as_it_is(turn)) count(turn);
      }
    }
    for (SymmetryAxis& axis : found_.axes) ++axis.turns;  // the one that does nothing
    for (SymmetryAxis& axis : found_.axes)
      if (axis.turns > 2 && leaves_as_it_is(turn_about(axis.direction, kPi / axis.turns)) &&
          has_any_turn(axis.direction))
        axis.turns = 0, found_.rotations = 0;
  }

  static bool does_nothing(const Motion& turn) {
    const auto& [x, y, z] = turn.rotation;
    return x.x + y.y + z.z > 3 - 1e-9;
  }

  /// Counts a rotation for its axis.
  void count(const Motion& turn) {
    const auto& [x, y, z] = turn.rotation;
    Vector axis{z.y - y.z, x.z - z.x, y.x - x.y};
    if (norm(axis) < 1e-3) {
      // Half a turn: the rotation and the identity together are twice the projection on the axis.
      const std::array<Vector, 3> columns{{{x.x + 1, y.x, z.x}, {x.y, y.y + 1, z.y}, {x.z, y.z, z.z + 1}}};
      axis = *std::max_element(columns.begin(), columns.end(),
                               [](Vector a, Vector b) { return norm(a) < norm(b); });
    }
    axis = unit(axis);
    ++found_.rotations;
    for (SymmetryAxis& one : found_.axes)
      if (std::abs(dot(one.direction, axis)) > kSameAxis) return void(++one.turns);
    found_.axes.push_back({axis, 1});
  }

  const Mesh& mesh_;
  double tolerance_, alike_ = 0;
  Symmetry found_;
  std::vector<Vector> looked_;  ///< from the centre
  std::optional<TriangleTree> tree_;
};

}  // namespace

Symmetry symmetry(const Mesh& mesh, double tolerance) { return Finder(mesh, tolerance).find(); }

}  // namespace lekalo::solid
