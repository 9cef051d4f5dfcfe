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
  int tool_number = 0;  ///< 1 to 9999: the post's change to this tool; 0: the one in the spindle
  double spindle = 0;   ///< rev/min, the S word with M3; 0: left alone
  Coolant coolant = Coolant::off;
  double feed_mm_per_min = 1500;  ///< feed of the cut; helices run at half of it
  double link_feed_mm_per_min = 5000;
  double plunge_feed_mm_per_min = 300;
  std::vector<std::string> comments;  ///< at the beginning; letters, digits, points and dashes stay
};

/// The path as a program: a block that sets all modes it depends on, lines and arcs (G1 G2 G3, centres as
/// I J, at most half a turn), an end that stops spindle and coolant above the stock. Coordinates have the
/// decimals of the post, of an inch at least five. The centre of an arc is the one on that grid whose circle
/// comes nearest to the arc through the rounded ends. No point of the written path is further than
/// kWritingError from the path, if the post has three decimals or more. The tool's radius is in the path: no
/// G41 or G42. \pre options in range, the path of arcs up to 1 m radius (fitted). Cost: O(moves).
/// \param move_of_line  if given, gets for each line the number of the move it was written for, or kNoMove
[[nodiscard]] std::string program_of(const PocketPath& path, const ProgramOptions& options,
                                     std::vector<std::size_t>* move_of_line = nullptr);

inline constexpr std::size_t kNoMove = static_cast<std::size_t>(-1);

inline constexpr double kWritingError = 1e-3;  ///< mm; held by tests/property/mill_program_test.cpp

}  // namespace lekalo::mill
