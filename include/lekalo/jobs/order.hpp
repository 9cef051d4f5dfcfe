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
  layout::Material material{};
  layout::Purpose purpose{};
  std::string said_in{};  ///< "o.csv: line 7", for sentences; empty: they name the file
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
  layout::Material material{};
};

/// An order says which outlines are wanted, how often, and what they are cut from.
struct Order {
  std::vector<OrderedPart> parts;
  std::vector<OrderedStock> stocks;
  /// Stock that is there (jobs/stock.hpp): its outline, count, cost, material and id stay as they are.
  std::vector<layout::Stock> in_store;
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

/// The layout of what is cut from one material.
struct MaterialLayout {
  layout::Material material;
  Layout layout;
  /// Tells its files from those of the others of an order: "steel-2" (jobs/material.hpp); empty where it is
  /// the only one.
  std::string file_word;
};

/// Makes the layouts that an order describes, one for each material and thickness, in the order in which
/// parts name them: parts, stocks and rules, and nothing placed. Parts come beside the stock of their
/// material, to the letter; what is said of one material alone counts for what says nothing
/// (share_materials). A layout's `inputs` are its files. Stock of which nothing is cut is told in a notice.
///
/// Fails with ErrorCode::usage where parts or stocks are missing, with ErrorCode::bad_input and one sentence
/// that lists what is wrong in every file that cannot be read, and the materials without stock. Cost: that of
/// reading the files.
[[nodiscard]] Result<std::vector<MaterialLayout>> open_orders(const Order& order);

/// The same for an order that is to be one layout. Fails also with ErrorCode::bad_input where it is more.
[[nodiscard]] Result<Layout> open_order(const Order& order);

}  // namespace lekalo::jobs
