#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::verify {

/// The simulator of simulate.hpp also says what the tool takes off along its way: when, where, how deep and
/// with which part of its rim. docs/design/simulate.md, step 12.

/// A part of the tool's rim, over some height, that meets material.
struct EngagedLayer {
  double low_z = 0, high_z = 0;  ///< mm
  /// The engaged arc runs counter-clockwise from begin to end, radians, from the direction of X; begin in
  /// (-pi, pi], end at most half a turn later.
  double begin = 0, end = 0;
  double width = 0;  ///< mm across the heading
};

/// A short piece of the tool's way, straight: an arc is its chords.
struct CutPiece {
  double start = 0, seconds = 0;
  double from_x = 0, from_y = 0, from_z = 0;  ///< the middle of the tool's tip, mm
  double to_x = 0, to_y = 0, to_z = 0;
  double length = 0;     ///< mm across, along the arc
  double feed = 0;       ///< mm/min as programmed; 0 for a rapid and a dwell
  std::size_t line = 0;  ///< of the program, from 1; 0 for a dwell
  bool rapid = false;
  /// The centre of the arc whose chord a piece below the stock's upper face is, mm; none for a line.
  std::optional<std::array<double, 2>> centre;
  /// In the middle of the piece, the lowest first. Empty where the rim meets nothing.
  std::vector<EngagedLayer> rim;
  /// The area below the tip that is material, mm2; a piece that goes down takes it off. Else 0.
  double floor_area = 0;

  /// Returns the volume that the piece takes off, mm3.
  [[nodiscard]] double volume() const;
};

struct CutHistory {
  std::vector<CutPiece> pieces;  ///< in the order of time, without a gap
  double seconds = 0;            ///< with dwells (G4), but those at the bottoms of canned cycles
};

/// Follows a program. Material is where no piece of the path so far was as deep; outside of the pocket
/// everything is, but for the air beyond its open edges. Pieces below the stock's upper face are at most
/// `longest` long, mm, or as long as they must be for 200,000 of them.
///
/// The volumes are sums of values at the middles of pieces, with an error of second order in `longest`. The
/// floor that a ramp leaves is a staircase to what comes after it, with steps of at most half a radius, so
/// that up to half of what the ramp sinks along one is booked twice over its ground. Errors are those
/// of simulate(). Cost: about that of simulate() with as many samples, times the levels that overlap.
[[nodiscard]] Result<CutHistory> cut_history(const Document& program, const Document& pocket,
                                             const SimulateOptions& options,
                                             const std::vector<EarlierProgram>& earlier, double longest,
                                             const ProgressListener& progress = {});

}  // namespace lekalo::verify
