#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"

namespace lekalo::nc {

/// A place on the way of one motion, and how far it is moved.
struct MovedNode {
  double share = 1;            ///< of the motion's length, above 0 to 1
  double z = 0;                ///< mm, where the motion is there
  std::array<double, 2> by{};  ///< mm along X and Y
};

/// A motion in the plane: a line, or an arc of G17.
struct MovedMotion {
  std::size_t line = 0;          ///< of the program, from 1
  std::vector<MovedNode> nodes;  ///< with ascending shares; the last one is 1
};

/// Moves stretches of a program's path by little, differently from place to place. Between two nodes a motion
/// is moved by what lies linearly between them, and motions that are not named keep their ends. A line
/// becomes lines, an arc becomes arcs of at most a quarter turn; both stay within 0.0001 mm of the moved way,
/// and the rounding to the decimals that the control reads. Every other byte stays. docs/design/nc-rewrite.md
/// has the words that programs may have.
///
/// \return  the program. program_refused with `name:line: reason` for words that are not on the list, for
///          subprograms and variables, and where a motion that has to be moved, or goes on from one, is under
///          G91 or G93, a canned cycle, an arc of G18 or G19 or one of several turns, or stands beside M0,
///          M1, M2 or M30.
/// \param motions  ascending lines
/// Cost: the nodes times those that one line or arc replaces.
[[nodiscard]] Result<std::string> move_path(std::string_view program, const std::string& name,
                                            words::Control control, const std::vector<MovedMotion>& motions);

/// The effect of decimals on a path that is moved, mm.
struct MovedRounding {
  double most = 0;  ///< how far rounding may move a place of it
  /// The words of a Fanuc or Haas program may have more decimals than a control of increment system IS-B
  /// reads. It drops the others: up to this.
  double dropped = 0;
};

/// Returns what decimals may do to the path that move_path() writes of this program: rounding 0.00007 to
/// 0.00009 mm where its words are written with four decimals of a millimetre, and 0.0018 to 0.0024 mm with
/// four of an inch. Errors: as those of move_path() for the program as it is. Cost: linear in its bytes.
[[nodiscard]] Result<MovedRounding> moved_path_rounding(std::string_view program, const std::string& name,
                                                        words::Control control);

}  // namespace lekalo::nc
