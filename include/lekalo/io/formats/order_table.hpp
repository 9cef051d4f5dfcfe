#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// A row of an order: which file is cut, how often, and how it may lie.
struct OrderRow {
  std::string said_in;  ///< "o.csv: line 7", for sentences; empty without a table
  std::string file;     ///< as it is written; a pattern or a folder too
  std::int64_t quantity = 1;
  /// A value that the row does not give is left to whoever asked for the order.
  std::optional<std::vector<layout::AngleRange>> rotations;
  std::optional<bool> may_mirror;
  std::optional<layout::Grain> grain;
  int priority = 0;
  std::string name;  ///< empty: that of the file
  layout::Material material{};
  layout::Purpose purpose{};
  std::string assembly{};  ///< in a bill of materials: what the row is a part of
};

struct OrderTable {
  std::vector<OrderRow> rows;
  /// The table has the column `assembly`: `file` is a file or the name of another assembly, and `quantity`
  /// what one of the assembly holds (jobs/bill.hpp).
  bool is_bill = false;
  std::vector<std::string> notices;  ///< sentences about columns that are not read
};

/// Reads an order as a table (CSV): the first row names the columns, in any order and case. `file` is needed;
/// `quantity`, `rotations`, `mirror`, `grain`, `priority`, `name`, `material`, `thickness`, `customer`,
/// `due`, `label` and `assembly` may be there; where `assembly` is, every row has one. Cells are separated by
/// whatever the first row is separated by: a semicolon, a tab or a comma; a cell in "quotes" may hold
/// separators, line ends and "" for a quote. Empty cells say nothing, empty rows are passed over.
///
/// Fails with ErrorCode::bad_input and one sentence that lists everything that is wrong, with its line.
[[nodiscard]] Result<OrderTable> read_order(std::string_view bytes, const std::string& name);

/// Reads angles as "any", or degrees between commas or blanks: "0,90" or "0 90 180". Nothing for other words.
[[nodiscard]] std::optional<std::vector<layout::AngleRange>> rotations_of(std::string_view text);
/// Reads the direction of a grain in degrees: "x" is 0, "y" is 90, else a number. Nothing for other words.
[[nodiscard]] std::optional<double> grain_of(std::string_view text);
/// Reads the number of pieces, from 1 to 1,000,000,000. Nothing for other words.
[[nodiscard]] std::optional<std::int64_t> quantity_of(std::string_view text);
/// Reads a thickness as io::length_of does, in grid steps. Nothing for other words, and for less than
/// limits::kShortestSide or more than limits::kLargestOutline.
[[nodiscard]] std::optional<std::int64_t> thickness_of(std::string_view text);
/// Returns the text as a layout keeps it, in UTF-8. Nothing for more than 1,000 bytes and for control
/// characters.
[[nodiscard]] std::optional<std::string> kept_text(std::string_view text);

}  // namespace lekalo::io
