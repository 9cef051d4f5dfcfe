#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::heat {

/// A place, a displacement or a size in space, mm.
struct Place {
  double x = 0, y = 0, z = 0;
};

/// The faces of the box that a workpiece is cut from, in this order wherever they are counted.
enum class Side : std::uint8_t { x_low, x_high, y_low, y_high, z_low, z_high };
inline constexpr std::size_t kSides = 6;
/// Returns where a side stands in an array of all of them.
[[nodiscard]] constexpr std::size_t of(Side side) noexcept { return static_cast<std::size_t>(side); }

/// Voxels need 470 bytes each while a program is followed, 0.9 GB for this many.
inline constexpr std::size_t kMostVoxels = 2'000'000;

/// A box in equal voxels, whose borders lie on the box: its pitches differ a little from axis to axis.
struct Grid {
  Place low;                              ///< mm
  Place pitch;                            ///< mm
  std::array<std::size_t, 3> count = {};  ///< voxels along x, y, z

  /// Divides a box so that each pitch is the nearest to the one asked for. bad_input where the box is empty,
  /// a number is not finite, or there would be more than kMostVoxels.
  [[nodiscard]] static Result<Grid> divide(Place low, Place high, double pitch);

  [[nodiscard]] std::size_t size() const noexcept { return count[0] * count[1] * count[2]; }
  [[nodiscard]] double volume() const noexcept { return pitch.x * pitch.y * pitch.z; }  ///< of one, mm^3
  [[nodiscard]] std::array<double, 3> pitches() const noexcept { return {pitch.x, pitch.y, pitch.z}; }
  /// Returns the number of a voxel, which counts x first and z last.
  [[nodiscard]] std::size_t cell(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return (k * count[1] + j) * count[0] + i;
  }
  [[nodiscard]] Place middle(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return {low.x + (static_cast<double>(i) + 0.5) * pitch.x,
            low.y + (static_cast<double>(j) + 0.5) * pitch.y,
            low.z + (static_cast<double>(k) + 0.5) * pitch.z};
  }
  /// Returns the voxel of a place; one outside the box has the nearest.
  [[nodiscard]] std::array<std::size_t, 3> voxel_of(Place p) const noexcept;
};

/// A flat cutter with a vertical axis sweeps this, and all above it, while its tip goes straight from one
/// place to another, mm.
struct Stroke {
  Place from, to;
  double radius = 0;
};

/// A voxel whose material a cut has changed.
struct Changed {
  std::size_t cell = 0;
  double before = 0, after = 0;  ///< shares of the voxel that are material, in [0, 1]
};

/// A workpiece as a function at the corners of voxels, positive in the material, as the functional-voxel
/// model has it; a cut is its R-conjunction with the cutter's. Between corners it is linear, so that voxels
/// have parts: the share that is material, the open share of each face, and the area of the wall inside (24
/// tetrahedra a voxel, exact for one plane). docs/design/heat.md, steps 1 and 2.
class Body {
 public:
  /// \param within  distance from the stock's border, positive inside, mm, asked at the corners of voxels;
  ///                empty: the whole box
  explicit Body(const Grid& grid, const std::function<double(Place)>& within = {});

  /// Takes away what the cutter sweeps. Shares are as before until settle(). Cost: corners near the stroke.
  void cut(const Stroke& stroke);
  /// Computes the voxels anew that were cut since the last time, and returns those whose share changed, in
  /// ascending order.
  std::vector<Changed> settle();

  [[nodiscard]] const Grid& grid() const noexcept { return grid_; }
  /// Share of a voxel that is material.
  [[nodiscard]] double share(std::size_t cell) const noexcept { return share_[cell]; }
  /// Area of the wall inside a voxel, mm^2; borders of the box are no walls.
  [[nodiscard]] double wall(std::size_t cell) const noexcept { return wall_[cell]; }
  /// Distance of a voxel's middle from its wall, mm; 0 where the middle is outside the material.
  [[nodiscard]] double depth(std::size_t cell) const noexcept { return depth_[cell]; }
  /// Open share of the lower face of a voxel across an axis; the last face has i = count.
  [[nodiscard]] double open(std::size_t axis, std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return open_[axis][face(axis, i, j, k)];
  }
  /// The function at a corner.
  [[nodiscard]] double at_corner(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return model_[corner(i, j, k)];
  }
  [[nodiscard]] double volume() const noexcept;  ///< of all material, mm^3

 private:
  [[nodiscard]] std::size_t corner(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return (k * (grid_.count[1] + 1) + j) * (grid_.count[0] + 1) + i;
  }
  [[nodiscard]] std::size_t face(std::size_t axis, std::size_t i, std::size_t j,
                                 std::size_t k) const noexcept {
    return (k * (grid_.count[1] + (axis == 1 ? 1 : 0)) + j) * (grid_.count[0] + (axis == 0 ? 1 : 0)) + i;
  }
  [[nodiscard]] Place place_of_corner(std::size_t i, std::size_t j, std::size_t k) const noexcept;
  void compute(std::size_t i, std::size_t j, std::size_t k);

  Grid grid_;
  std::vector<double> model_;  // at corners
  std::vector<double> share_, wall_, depth_;
  std::array<std::vector<double>, 3> open_;
  std::vector<char> stale_;  // of each voxel: a corner changed
};

}  // namespace lekalo::heat
