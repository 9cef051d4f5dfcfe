#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lekalo/base/units.hpp"
#include "lekalo/mill/path.hpp"
#include "lekalo/nc/dialect.hpp"

namespace lekalo::mill {

enum class Coolant { off, mist, flood };

struct ProgramOptions {
  nc::Dialect post = nc::posts().front();
  LengthUnit unit = LengthUnit::millimetre;  ///< the program's words are in it: G21 or G20
  int work_offset = 1;                       ///< 1 to 6: G54 to G59
  /// The tool that the post changes to, 1 to 9999; 0 leaves the tool that is in the spindle.
  int tool_number = 0;
  /// The S word with M3, rev/min; 0 leaves the spindle alone.
  double spindle = 0;
  Coolant coolant = Coolant::off;
  /// The feed of the cut; helices run at half of it.
  double feed_mm_per_min = 1500;
  double link_feed_mm_per_min = 5000;
  double plunge_feed_mm_per_min = 300;
  /// Comments at the beginning of the program; their letters, digits, points and dashes stay.
  std::vector<std::string> comments;
};

/// Returns the path as a program: a block that sets all modes it depends on, lines and arcs (G1 G2 G3,
/// centres as I J, at most half a turn), and an end that stops spindle and coolant above the stock.
/// Coordinates have the decimals of the post, of an inch at least five. The centre of an arc is the one on
/// that grid whose circle comes nearest to the arc through the rounded ends. No point of the written path is
/// further than kWritingError from the path, if the post has three decimals or more. The tool's radius is in
/// the path: there is no G41 or G42.
/// \pre options in range, the path of arcs up to 1 m radius (fitted). Cost: O(moves).
/// \param move_of_line  if given, gets for each line the number of the move it was written for, or kNoMove
[[nodiscard]] std::string program_of(const PocketPath& path, const ProgramOptions& options,
                                     std::vector<std::size_t>* move_of_line = nullptr);

inline constexpr std::size_t kNoMove = static_cast<std::size_t>(-1);

/// The test tests/property/mill_program_test.cpp holds this bound.
inline constexpr double kWritingError = 1e-3;  ///< mm

}  // namespace lekalo::mill
