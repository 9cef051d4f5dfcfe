#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/heat.hpp"
#include "lekalo/jobs/phases.hpp"

namespace lekalo::jobs {

/// A corrected program that is asked for.
struct CorrectionWish {
  /// A pass along a wall that takes at most this is a finishing pass, mm; half the tool's radius where it is
  /// not stated.
  std::optional<double> finish;
};

/// The walls of the cold workpiece after a program whose finishing passes are moved.
struct HeatCorrection {
  double finish = 0;    ///< mm
  std::string program;  ///< empty where none is worth writing
  std::string why_not;  ///< one sentence, where there is no program
  HeatFound found;      ///< of the corrected program
  std::vector<double>
      errors_um;             ///< of each of its places at the middles, by the places of the program as it is
  WallErrors after;          ///< at the middles
  WallIntervals after_over;  ///< over film, force and share
  int rounds = 0;            ///< how often a program was written and followed
  double still_um = 0;       ///< how far the last round would have moved a pass on
  double dropped_um =
      0;  ///< what some controls drop of its lengths (nc::MovedRounding), which is in no figure
};

/// At every corner of the intervals a corrected program may go this far into the cold workpiece, um. Rounding
/// to the decimals of the control is in it.
inline constexpr double kMostOvercut = 1;
/// A corrected program leaves at most this part of the largest error at the middles.
inline constexpr double kMostLeft = 0.2;

/// Moves the finishing passes of a program with the workpiece as it was displaced when they cut, follows the
/// new program through the voxels, and again until nothing changes, three times at most.
/// docs/design/heat-correction.md.
///
/// There is a program only where the largest error is at most kMostLeft of what it was and less than the best
/// scaling leaves, is nowhere in the intervals larger than the largest was, and no wall lies more than
/// kMostOvercut inside the cold workpiece at any corner of them. Without heat it is the program's own bytes.
///
/// Errors: bad_input where passes at half of the places of walls take more than `finish`, and where one would
/// be moved by more than finishing passes within a tool's diameter take; those of heat() and nc::move_path().
/// Cost: heat() for each round. \param found heat(job)
[[nodiscard]] Result<HeatCorrection> heat_correction(const HeatJob& job, const HeatFound& found,
                                                     const CorrectionWish& wish,
                                                     const PhaseListener& phases = {});

}  // namespace lekalo::jobs
