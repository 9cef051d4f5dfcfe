#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/heat/material.hpp"

namespace lekalo::heat {

/// The work of cutting along a program's path, and how much of it heats the workpiece.
/// docs/design/heat-source.md.

/// A part of the tool's rim that cuts, over some height.
struct RimContact {
  double low_z = 0, high_z = 0;  ///< mm
  /// The arc runs counter-clockwise from begin to end, radians from the direction of X, at most half a turn.
  double begin = 0, end = 0;
  double width = 0;  ///< mm across the heading
};

/// A short straight piece of the tool's way, in the order of time. jobs/heat_source.hpp makes them of a
/// program.
struct ToolPiece {
  double start = 0, seconds = 0;
  std::array<double, 3> from{}, to{};  ///< the middle of the tool's tip, mm
  double length = 0;                   ///< mm across
  std::size_t line = 0;                ///< of the program, from 1; 0 for a dwell
  bool rapid = false;
  /// The centre of the arc whose chord the piece is, mm; none for a line.
  std::optional<std::array<double, 2>> centre;
  std::vector<RimContact> rim;
  double floor_area = 0;  ///< mm2 of material under the tip, where the piece goes down
};

struct CuttingConditions {
  double tool_diameter = 0;  ///< mm
  int teeth = 0;
  double spindle_rpm = 0;
  Interval cutting_force;   ///< k_c1.1, N/mm2
  Interval force_exponent;  ///< m_c
  /// A worn edge needs this many times the force of a sharp one.
  Interval wear{1, 1};
  Interval share;  ///< of the power, that heats the workpiece
};

/// A part of the work: one contact of the rim, or the floor, along one piece.
struct CutStep {
  double start = 0, seconds = 0;
  std::array<double, 3> from{}, to{};  ///< the middle of the tool's tip, mm
  std::size_t line = 0;
  /// True for the floor under a tip that goes down; then the heights are those of the tip and there is no
  /// arc.
  bool floor = false;
  double low_z = 0, high_z = 0;  ///< mm; the axial depth is their difference
  double begin = 0, end = 0;     ///< the engaged arc, as in RimContact
  double chip_mm = 0;            ///< mean thickness
  double volume_mm3 = 0;
  Interval work_j;  ///< over the force, its exponent and wear

  [[nodiscard]] double power_w(const Interval& share) const noexcept {
    return seconds > 0 ? work_j.middle() * share.middle() / seconds : 0;
  }
};

struct CuttingWork {
  std::vector<CutStep> steps;  ///< in the order of time
  double seconds = 0;          ///< of the whole program
  double cutting_seconds = 0;  ///< in which something is cut
  double volume_mm3 = 0;
  Interval work_j;  ///< all of it
  /// Work times the share, and the rest, which chips, tool and fluid carry off.
  Interval into_workpiece_j, carried_off_j;
  Interval greatest_power_w;  ///< of any piece, before it is shared
};

/// Mean thickness of the chip, mm, over an arc of the rim: f_z w / (r phi). For an arc that begins at the
/// side of the tool w = r (1 - cos phi), and this is f_z (1 - cos phi) / phi.
[[nodiscard]] double mean_chip(double feed_per_tooth, double radius, double width, double arc) noexcept;

/// Kienzle's law k_c1.1 h^-m_c with wear, N/mm2. \pre chip above 0, mm
[[nodiscard]] Interval specific_force(const CuttingConditions& conditions, double chip) noexcept;

/// bad_input with one sentence for figures of which no force follows: no teeth, no speed.
[[nodiscard]] Result<void> check_conditions(const CuttingConditions& conditions);

/// Returns the work of each contact: specific force times volume. The feed per tooth is that of the speed at
/// which the machine really goes; the floor under a descending tip is cut with the feed per tooth downwards.
/// What lies below `bottom_z` is no material. bad_input with one sentence as of check_conditions(), where a
/// rapid cuts, and where nothing is cut. Cost: linear.
[[nodiscard]] Result<CuttingWork> cutting_work(const std::vector<ToolPiece>& pieces,
                                               const CuttingConditions& conditions, double bottom_z);

}  // namespace lekalo::heat
