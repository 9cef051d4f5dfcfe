#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/nc/program.hpp"
#include "lekalo/nc/rewrite.hpp"

namespace lekalo::nc {

/// A point of the program's own frame, exact.
struct GridPoint {
  Grains x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

enum class MotionKind { line, arc_by_centre, arc_by_radius, cycle };

/// A block that moves in X and Y, bores where it stands, or both.
struct Motion {
  std::size_t block = 0;  ///< index into Program::blocks
  MotionKind kind = MotionKind::line;
  LengthUnit unit = LengthUnit::millimetre;
  bool incremental = false;      ///< G91
  bool start_known = false;      ///< false: the machine may stand anywhere
  GridPoint start, end;          ///< `end` after all repeats
  std::int64_t repeats = 1;      ///< L of a cycle under G91
  bool clockwise = false;        ///< arcs
  bool absolute_centre = false;  ///< G90.1
  GridPoint centre;              ///< arcs by centre only
  Grains radius = 0;             ///< arcs by radius only; negative: the long way round
  std::int64_t turns = 1;        ///< P of an arc
  /// The plane of an arc: 170, 180 or 190. Outside G17 the heights count too, and the centre has one of X and
  /// Y and a height.
  int plane = 170;
  Grains start_z = 0, end_z = 0, centre_z = 0;
  bool inverse_time = false;                                          ///< G93
  const Word *x = nullptr, *y = nullptr, *i = nullptr, *j = nullptr;  ///< into the program
};

/// A word that says a height of the program's own frame: Z, or R of a cycle, under G90.
struct Height {
  std::size_t block = 0;       ///< index into Program::blocks
  const Word* word = nullptr;  ///< into the program
  LengthUnit unit = LengthUnit::millimetre;
};

/// A program's effect, as far as a motion in the plane is concerned, or one that a shift along Z goes with.
struct Interpretation {
  std::vector<Motion> motions;
  std::vector<Height> heights;                  ///< of solids alone
  std::optional<std::size_t> first_axis_block;  ///< first block with X Y Z, or with G41 G42
  LengthUnit unit_at_first =
      LengthUnit::millimetre;  ///< the one in force before it, or the first one said, if it says it itself
  bool incremental_at_first = false;
  bool unit_stated = false, distance_stated = false, plane_stated = false,
       offset_stated = false;            ///< before it
  std::optional<std::size_t> end_block;  ///< M2, M30 or the final %
  bool end_moves = false;                ///< the end block moves too
  bool cycle_at_end = false, compensation_at_end = false;
  /// The work offsets that the program selects, 1 to 9, each once, in the order of their first use.
  std::vector<int> offsets;
  std::vector<const Word*> late_offsets;       ///< G54.. not before first_axis_block
  std::optional<std::size_t> rotation_cancel;  ///< first G69: its line
  std::optional<std::size_t> other_plane;      ///< first G18 or G19: its line
  std::optional<std::size_t> program_number;   ///< O word: its line
  std::optional<std::size_t> sideways_bore;    ///< first G76 or G87: its line
  /// The blocks that go to points of the machine after first_axis_block.
  std::vector<std::size_t> machine_blocks;
  std::vector<std::string> notes;
};

/// Step 3 of docs/design/nc-rewrite.md: runs the program on the white list.
/// \param program  must outlive the result, and every word of it be on the control's list
[[nodiscard]] Result<Interpretation> interpret(const Program& program, const std::string& name,
                                               const RewriteOptions& options, words::Control control);

}  // namespace lekalo::nc
