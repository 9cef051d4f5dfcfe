#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/fit/assembly.hpp"

namespace lekalo::fit {

/// Rings pressed together: displacements, pressures and plastic strains of bodies of revolution with finite
/// lengths, frictionless, small strains, von Mises with linear hardening; docs/design/fit.md.

enum class State : std::uint8_t {
  elastic,  ///< nothing yields
  plastic,  ///< something yields, and no ring through its whole wall
  full      ///< a ring has yielded through at z = 0, by the measure of DIN 7190 (docs/design/fit.md)
};
[[nodiscard]] std::string_view name_of(State state) noexcept;

/// How much a diameter has grown at a place along the axis, in mm.
struct Growth {
  double z = 0, diameter = 0;
};

/// The growth at z = 0, the middle of the hub. \pre the surface is one of a Pressed
[[nodiscard]] const Growth& in_middle(const std::vector<Growth>& surface);

/// Surfaces of one ring along z: from the middle to its end where all is symmetric, so that the other half is
/// its mirror; else from end to end. Corners and middles of elements alternate, so that
/// Simpson's rule integrates them as the elements do.
struct RingGrowth {
  std::vector<Growth> inner;  ///< empty in a solid shaft
  std::vector<Growth> outer;
  double largest_mises_mpa = 0;  ///< at a Gauss point; near an edge it grows with the fineness of the mesh
  double middle_mises_mpa = 0;   ///< largest in the elements at z = 0
  double plastic_part = 0;       ///< part of the wall that yields at z = 0, 0 to 1
  bool yields = false;           ///< somewhere
  bool through = false;          ///< through its wall, State::full
};

struct SeatLoad {
  double force_n = 0;       ///< of all the pressure, added up as if it were flat
  double pressure_mpa = 0;  ///< the mean over the seat: that force by the seat's area
  double middle_mpa = 0;    ///< the mean over the element beside z = 0
  double touching_mm = 0;   ///< the length, of both halves, of what is in touch
};

struct Pressed {
  State state = State::elastic;
  std::vector<double> interference;  ///< of each seat, in diameter, mm
  std::vector<RingGrowth> rings;
  std::vector<SeatLoad> seats;
};

/// A change of a surface's radius that is turned before the parts are pressed, mm; of seats the interference
/// grows by it.
struct Turned {
  int ring = 0;
  bool outer = true;
  std::function<double(double)> change;  ///< at z; z >= 0 where all is symmetric
};

/// How finely the mesh divides. Elements grow away from edges and seats.
struct Fineness {
  double least = 1.0 / 24;  ///< elements at an edge, as a part of the thinnest wall; at a seat twice that
  double across = 1.0 / 5;  ///< the largest elements across, as a part of their wall
};

/// The shaft's seat.
enum class FirstSeat : std::uint8_t {
  pressed,  ///< the shaft has its interference
  cylinder  ///< the hub's bore stays a cylinder, whose growth (in diameter) counts as the interference, and
            ///< the shaft bears the pressure that this takes
};

/// Presses rings together step by step. What yields does so along the way, so an order of calls is a history.
class Pressing {
 public:
  /// \pre check_assembly() takes it
  explicit Pressing(const Assembly& assembly, const Fineness& fineness = {},
                    const std::vector<Turned>& turned = {}, FirstSeat first_seat = FirstSeat::pressed);
  ~Pressing();
  Pressing(Pressing&&) noexcept;
  Pressing& operator=(Pressing&&) noexcept;

  /// Goes from what there is to these interferences (in diameter, mm, one of each seat), all in proportion.
  /// bad_input where the equations have no solution any more: what carries the load has yielded through and
  /// does not harden. Cost: some ten to a hundred factorings of a matrix of some thousand rows, 0.1 to 3 s.
  [[nodiscard]] Result<Pressed> press(const std::vector<double>& interference);

  /// Takes the rings apart: what stays of growths and stresses. The pressing itself is as it was before.
  [[nodiscard]] Result<Pressed> released() const;

  /// Unknowns that were solved for so far, added up over all solutions; the measure of work.
  [[nodiscard]] std::uint64_t work() const noexcept;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace lekalo::fit
