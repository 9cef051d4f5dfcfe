#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "lekalo/field/contour_model.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::field {

/// A square grid: node (i, j) is at origin + pitch (i, j), number j * columns + i.
struct GridFrame {
  geom::Point origin;
  double pitch = 1;
  std::size_t columns = 0, rows = 0;

  [[nodiscard]] std::size_t size() const { return columns * rows; }
  [[nodiscard]] geom::Point node(std::size_t i, std::size_t j) const {
    return {origin.x + pitch * static_cast<double>(i), origin.y + pitch * static_cast<double>(j)};
  }
};

/// Allocates numbers that are not set to 0 first, which at 4096 x 4096 nodes would take as long as filling
/// them.
template <class T>
struct NotSet : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = NotSet<U>;
  };
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    if constexpr (sizeof...(Args) == 0)
      ::new (static_cast<void*>(at)) U;
    else
      ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};
using Samples = std::vector<float, NotSet<float>>;

/// Value and gradient at the nodes, single precision.
struct FieldGrid {
  GridFrame frame;
  Samples value, dx, dy;
};

/// The error of a sampled value, relative to the largest of itself, the grid's pitch and the longest
/// segment, for a linear conjunction and for distances. Held by tests/property/field_test.cpp. Gradients are
/// within kFieldGridGradientError, relative to their length or 1, where one segment has the least function by
/// more than that; elsewhere they belong to one of those that do.
inline constexpr double kFieldGridError = 1e-5;
inline constexpr double kFieldGridGradientError = 1e-4;
/// The same for a quadratic conjunction; its gradients are off by at most kQuadraticGridGradientError,
/// relative to the largest of 1, their length and the value over the distance from the nearest segment. These
/// are bounds; what is found is some 500 times less (tests/property/field_quadratic_test.cpp).
inline constexpr double kQuadraticGridError = 2e-5;
inline constexpr double kQuadraticGridGradientError = 2e-3;

/// The signed model at every node: positive inside. The same bytes for any number of threads.
/// Cost of a linear conjunction: tiles are divided by four, and keep the segments whose lower bound
/// (floz_bounds) is below the least upper bound of all, so that a node looks at few; it is for FLOZ itself,
/// not for distance: the nearest segment need not have the least FLOZ. In a quadratic conjunction every
/// segment matters everywhere, but subtrees of its fold that are far from a tile are cubic polynomials there,
/// which pays the more the finer the grid.
/// \pre frame.pitch > 0, threads > 0
[[nodiscard]] FieldGrid sample(const ContourModel& model, const GridFrame& frame, unsigned threads = 2);

/// The signed distance from the model's segments at every node, positive inside, likewise.
[[nodiscard]] FieldGrid sample_distance(const ContourModel& model, const GridFrame& frame,
                                        unsigned threads = 2);

/// The distance of each node from the boundary of regions, of their lines and arcs themselves, in double
/// precision; negative outside. Error: as geom::RegionIndex::nearest; within 1e-9 of the boundary either
/// sign. Cost: O(nodes log edges).
/// \pre frame.pitch > 0, regions that are not empty
[[nodiscard]] std::vector<double> signed_distances(const geom::RegionIndex& regions, const GridFrame& frame);

}  // namespace lekalo::field
