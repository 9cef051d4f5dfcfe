#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"
#include "nc_arc.hpp"
#include "nc_moves.hpp"
#include "unsaid_modes.hpp"

namespace lekalo::verify {

/// How a program is read.
struct NcReading {
  words::Control control = words::Control::linuxcnc;
  /// The Z of the stock's upper face, mm.
  double top = 0;
  /// True for a program that is judged: everything that cuts has to be known. False for one that is compared
  /// with another: the tool may change, and places need not be known.
  bool judged = true;
  /// M words that a shop allows beside those of the table.
  std::vector<int> allowed_m = {};
  /// True where the program is compared with one that lies at another height: then events have the heights of
  /// their words apart.
  bool heights_apart = false;
};

/// A block that does something: its words but for places and for modes that its moves show, and its moves.
struct NcEvent {
  std::size_t line{};
  std::string words;
  /// The heights of Z, and of R of a cycle, in these words, mm; of G90 alone.
  std::vector<double> heights = {};
  /// Indices of its moves, the last one not among them.
  std::size_t first_move = 0, end_move = 0;
  /// An arc of G18 or G19, whose moves are chords.
  std::optional<NcArc> upright;
  /// The work offset that was selected last, in tenths of its G word; 0 before any.
  int offset = 0;
  bool by_time = false;  ///< under G93
  /// The program has said these so far, with the words of this block.
  SaidGroups said = {};
  /// It has words for X, Y or Z, though the place is not known yet and no move is seen.
  bool places = false;
};

/// The machine waits (G4).
struct NcDwell {
  std::size_t before_move = 0;
  double seconds = 0;
};

struct NcProgram {
  std::vector<Move> moves;
  std::vector<NcEvent> events;
  /// In their order. The waits at the bottoms of canned cycles are not among them.
  std::vector<NcDwell> dwells = {};
};

/// Reads a program to its end, with subprograms and expressions. A motion from a place that is not known has
/// the same place as start and end, where it is not judged. Errors as of read_moves() where it is judged.
[[nodiscard]] Result<NcProgram> read_program(const Document& program, const NcReading& reading);

}  // namespace lekalo::verify
