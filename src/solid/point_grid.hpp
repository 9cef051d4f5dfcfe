#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// Cubic cells around points. A cell is outside where a ball of a given radius, rolled over the points from
/// far away, reaches it.
class PointGrid {
 public:
  struct Place {
    std::int32_t x = 0, y = 0, z = 0;
    std::int32_t& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  };

  /// Hears how much of the cells' work is done, from 0 to 1.
  using Listener = std::function<void(double)>;

  /// \param box  of the points; the body's lower end with a floor, which nothing passes
  PointGrid(std::vector<Vector> points, const Box& box, double step, double ball, bool floor,
            const Listener& told);

  [[nodiscard]] Place counts() const noexcept { return count_; }
  [[nodiscard]] bool has(Place c) const noexcept {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < count_.x && c.y < count_.y && c.z < count_.z;
  }
  [[nodiscard]] bool outside(Place c) const { return (state_[number(c)] & kOutside) != 0; }
  [[nodiscard]] bool occupied(Place c) const { return (state_[number(c)] & kOccupied) != 0; }
  /// The corner of cells with the least coordinates of cell c.
  [[nodiscard]] Vector corner(Place c) const noexcept;
  [[nodiscard]] Vector point(std::uint32_t number) const { return points_[number]; }
  /// The point that counts as the nearest to a corner of cells, or none if the ball may lie around it.
  [[nodiscard]] std::optional<std::uint32_t> nearest_point(Place corner) const;

 private:
  static constexpr std::uint8_t kOccupied = 1, kOutside = 2, kWaits = 4;
  static constexpr std::uint32_t kNone = 0xffffffff;

  [[nodiscard]] std::size_t number(Place c) const noexcept {
    return (static_cast<std::size_t>(c.z) * static_cast<std::size_t>(count_.y) +
            static_cast<std::size_t>(c.y)) *
               static_cast<std::size_t>(count_.x) +
           static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] Place place(std::size_t number) const noexcept;
  [[nodiscard]] Vector middle(Place c) const noexcept;
  [[nodiscard]] Place cell_of(Vector p) const noexcept;

  void occupy(const Listener& told);
  void flood();
  void roll(const Listener& told);
  /// Spreads the sources of cells to the cells around, each to those nearer than `reach` that have none
  /// nearer.
  template <class At, class May>
  void spread(std::vector<std::uint32_t>& sources, std::vector<std::uint32_t> front, double reach,
              const At& at, const May& may, const Listener& told);

  std::vector<Vector> points_;
  Vector low_;
  double step_, ball_;
  bool floor_;
  Place count_;
  std::vector<std::uint8_t> state_;
  /// About the nearest point, of each cell nearer than the ball's radius to one.
  std::vector<std::uint32_t> near_;
};

}  // namespace lekalo::solid
