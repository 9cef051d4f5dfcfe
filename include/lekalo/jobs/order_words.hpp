#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "lekalo/jobs/order.hpp"

namespace lekalo::jobs {

/// The terms of an order beside its parts, as people type them: the options of `lekalo nest`, and the fields of
/// the page. Lengths may have units (io::length_of).
struct OrderWords {
  std::vector<std::string> sheets;  ///< "3000x1500", "8ftx4ft=5", or the file of a drawing
  std::vector<std::string> strips;  ///< widths
  std::string gap, border, kerf;    ///< lengths; empty: 0
  std::string rotations;            ///< "any", or degrees as in "0,90"; empty: any
  std::string grain;                ///< "x", "y" or degrees; empty: none
  bool may_mirror = false;
};

/// Stock as it was typed: a size, or else the file of a drawing.
struct StockWord {
  std::string said;
  std::optional<SheetSize> size;
  std::optional<std::int64_t> count;
};

/// The same as values.
struct OrderTerms {
  std::vector<StockWord> stocks;
  double gap_mm = 0, border_mm = 0, kerf_mm = 0;
  /// These count for parts whose row of a table says nothing else.
  std::vector<layout::AngleRange> rotations;
  bool may_mirror = false;
  std::optional<double> grain_degrees;
};

/// Reads the words. Fails with ErrorCode::usage and one sentence that lists everything that is wrong.
/// \param prefix  stands before the names of the words in sentences: "--" for options, nothing for fields
[[nodiscard]] Result<OrderTerms> read_order_words(const OrderWords& words, std::string_view prefix);

/// A word and the number behind its last "=", as in "lids/*.svg=2"; nothing where the number is out of range.
struct CountedWord {
  std::string word;
  std::optional<std::int64_t> count;
};
[[nodiscard]] std::optional<CountedWord> counted_word(const std::string& word);

/// The part that a row of a table orders, or one that was named without a table.
[[nodiscard]] OrderedPart ordered_part(const io::OrderRow& row, File file, const OrderTerms& terms);

/// An order under these terms, without parts and stocks.
[[nodiscard]] Order order_of(const OrderTerms& terms);

}  // namespace lekalo::jobs
