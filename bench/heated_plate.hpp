#pragma once

#include <array>
#include <functional>
#include <vector>

#include "lekalo/field/grid.hpp"

/// A plate with pockets through it, heated on their outlines, in a steady state; for a figure of
/// docs/design/functional-voxel.md. Textbook thermoelasticity of a plate that is free across its depth
/// (plane stress; S. Timoshenko & J. Goodier, Theory of Elasticity):
///   heat    laplace(T) = 0; outlines are insulated but where heat enters; the plate's border stays at T = 0
///   stress  div sigma = 0, sigma = D (strain(u) - alpha T); outlines are free, u = 0 on the border
/// solved on the grid of the pockets' functional-voxel model, which alone says where material is: where it is
/// negative, linear along the sides of a cell. Heat by finite volumes, with the part of each side that is in
/// the material (Y. Ng, C. Min & F. Gibou, J. Comput. Phys. 2009); u by bilinear finite elements, integrated
/// over a cell's material; both by conjugate gradients, in one order: the same input gives the same bytes.
namespace lekalo::heated_plate {

using Numbers = std::vector<double>;

// Aluminium 6061-T6, handbook values.
inline constexpr double kConduction = 0.167;          // W / (mm K)
inline constexpr double kExpansion = 23.6e-6;         // 1 / K
inline constexpr double kYoung = 68.9e3, kNu = 0.33;  // MPa

inline constexpr double kHeat = 10;                   // W per mm of depth, in all
inline constexpr double kPitch = 0.5, kSampling = 1;  // mm: of the grid; the model's chords at most

/// A cell between four nodes, as the model's values there cut it.
struct Cell {
  std::vector<geom::Point> material;  ///< a polygon, in the unit square
  bool whole = false;
  double right = 0, top = 0;  ///< shares of these sides in the material
  double wall = 0;            ///< mm of outline, `at` its middle; 0 where it crosses twice
  geom::Point at;
};

struct Plate {
  field::GridFrame nodes, cells;              ///< cells: their centres
  Numbers model;                              ///< at the nodes, negative: material
  std::function<double(geom::Point)> within;  ///< distance from the outer border, positive inside
  std::vector<Cell> cut;

  [[nodiscard]] std::array<std::size_t, 4> corners(std::size_t n) const {
    const std::size_t low = n / cells.columns * nodes.columns + n % cells.columns;
    return {low, low + 1, low + nodes.columns + 1, low + nodes.columns};
  }
  [[nodiscard]] geom::Point node(std::size_t n) const {
    return nodes.node(n % nodes.columns, n / nodes.columns);
  }
  [[nodiscard]] geom::Point cell(std::size_t n) const {
    return cells.node(n % cells.columns, n / cells.columns);
  }
};

/// The plate between `border`, within which `within` is positive, and the pockets' functional-voxel model
/// (quadratic FLOZ of the whole outlines).
[[nodiscard]] Result<Plate> plate_with(const std::vector<geom::Region>& pockets, geom::Box border,
                                       std::function<double(geom::Point)> within);

struct State {
  Numbers temperature, stress;  ///< K, MPa (von Mises): at the cells' centres
  Numbers moved;                ///< mm: x and y of each node in turns
};
/// \param density  of the heat that enters along the outlines, W per mm of length and mm of depth
/// Fails where the heat that goes in or comes out at the border is not kHeat within 1 %.
[[nodiscard]] Result<State> heated(const Plate& plate, const std::function<double(geom::Point)>& density);

/// What `of` gives at a grid's nodes, bilinear between them. \pre p is between four
template <class Of>
auto between(const field::GridFrame& frame, Of of, geom::Point p) {
  const geom::Point d = (1 / frame.pitch) * (p - frame.origin);
  const auto i = static_cast<std::size_t>(d.x), j = static_cast<std::size_t>(d.y);
  const double s = d.x - static_cast<double>(i), t = d.y - static_cast<double>(j);
  const std::size_t n = j * frame.columns + i, above = n + frame.columns;
  return (1 - t) * ((1 - s) * of(n) + s * of(n + 1)) + t * ((1 - s) * of(above) + s * of(above + 1));
}
[[nodiscard]] geom::Point moved_at(const Plate& plate, const State& state, geom::Point p);

/// The outlines as the model has them, closed.
[[nodiscard]] std::vector<std::vector<geom::Point>> outlines_of(const Plate& plate);

/// Fails where a round hole in a round plate, heated evenly, is off its closed form by more than 1 % of the
/// hole's temperature, 2 % of its displacement or 4 % of its stress; says by how much.
[[nodiscard]] Result<void> check_round_hole();

}  // namespace lekalo::heated_plate
