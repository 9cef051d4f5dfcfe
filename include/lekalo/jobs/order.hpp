#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/part_file.hpp"
#include "lekalo/io/text/length_word.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::jobs {

/// Outlines of one file that are wanted: a drawing, regions or a tree of primitives.
struct OrderedPart {
  File file;
  std::int64_t quantity = 1;  ///< of every outline in the file, from 1 to 1,000,000,000
  /// The parts' name; empty: that of the file without folder and ending. Several outlines in a file, and
  /// names that come again, get -2, -3 behind it.
  std::string name;
  std::vector<layout::AngleRange> rotations;  ///< an empty list allows any
  bool may_mirror = false;
  std::optional<layout::Grain> grain;
  int priority = 0;
};

/// A size in mm, from limits::kShortestSide to limits::kLargestOutline.
using SheetSize = io::PlaneSize;
/// Stock to cut from: rectangles, a strip, or the outlines of a drawing.
struct OrderedStock {
  /// Rectangles of this size; for a strip the width is left at 0 and the length is open.
  std::optional<SheetSize> size;
  /// Else the outlines of a drawing, each a sheet with its holes.
  File file;
  /// How many there are, from 1; without a value as many as may be needed: one for every piece.
  std::optional<std::int64_t> count;
};

/// An order says which outlines are wanted, how often, and what they are cut from.
struct Order {
  std::vector<OrderedPart> parts;
  std::vector<OrderedStock> stocks;
  double gap_mm = 0;     ///< between finished parts
  double border_mm = 0;  ///< from finished parts to the border
  /// The width of the cut; a smaller gap is raised to it, with a notice.
  double kerf_mm = 0;
  /// The direction of the grain on every stock, degrees from x.
  std::optional<double> grain_degrees;
  /// It adds to a layout that is there, with rules of its own: parts or stocks alone are enough, and a stock
  /// of which as many as needed are there has the count 0 (layout::Additions).
  bool adds = false;
  io::PartOptions reading;
};

/// Makes the layout that an order describes: parts, stocks and rules, and nothing placed. Its `inputs` are
/// the files of the order.
///
/// Fails with ErrorCode::usage where parts or stocks are missing, with ErrorCode::bad_input and one sentence
/// that lists what is wrong in every file that cannot be read. Cost: that of reading the files.
[[nodiscard]] Result<Layout> open_order(const Order& order);

}  // namespace lekalo::jobs
