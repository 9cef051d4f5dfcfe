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
  std::size_t line = 0;  ///< in the table, from 1
  std::string file;      ///< as it is written; a pattern or a folder too
  std::int64_t quantity = 1;
  /// A value that the row does not give is left to whoever asked for the order.
  std::optional<std::vector<layout::AngleRange>> rotations;
  std::optional<bool> may_mirror;
  std::optional<layout::Grain> grain;
  int priority = 0;
  std::string name;  ///< empty: that of the file
};

struct OrderTable {
  std::vector<OrderRow> rows;
  std::vector<std::string> notices;  ///< sentences about columns that are not read
};

/// Reads an order as a table (CSV): the first row names the columns, in any order and case. `file` is needed;
/// `quantity`, `rotations`, `mirror`, `grain`, `priority` and `name` may be there. Cells are separated by
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

}  // namespace lekalo::io
