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

/// The terms of an order beside its parts, as people type them: the options of `lekalo nest`, and the fields
/// of the page. Lengths may have units (io::length_of).
struct OrderWords {
  /// "3000x1500", "8ftx4ft=5", "3000x1500=5@steel:2", or the file of a drawing likewise.
  std::vector<std::string> sheets;
  std::vector<std::string> strips;  ///< widths, "1500" or "1500@felt:3"
  std::string gap, border, kerf;    ///< lengths; empty: 0
  std::string rotations;            ///< "any", or degrees as in "0,90"; empty: any
  std::string grain;                ///< "x", "y" or degrees; empty: none
  bool may_mirror = false;
  std::vector<std::string> builds;  ///< assemblies of a bill of materials: "cabinet", "cabinet=2"
};

/// Stock as it was typed: a size, or else the file of a drawing.
struct StockWord {
  std::string said;
  std::optional<SheetSize> size;
  std::optional<std::int64_t> count;
  layout::Material material{};
};

/// How many of an assembly of a bill of materials are built (jobs/bill.hpp).
struct Build {
  std::string assembly;
  std::int64_t count = 1;  ///< from 1 to limits::kMostCount
};

/// The same as values.
struct OrderTerms {
  std::vector<StockWord> stocks;
  double gap_mm = 0, border_mm = 0, kerf_mm = 0;
  /// These count for parts whose row of a table says nothing else.
  std::vector<layout::AngleRange> rotations;
  bool may_mirror = false;
  std::optional<double> grain_degrees;
  std::vector<Build> builds;
};

/// Reads the words. Fails with ErrorCode::usage and one sentence that lists everything that is wrong.
/// \param prefix  stands before the names of the words in sentences: "--" for options, nothing for fields
[[nodiscard]] Result<OrderTerms> read_order_words(const OrderWords& words, std::string_view prefix);

/// A word, the number behind its last "=" and the material behind its last "@", in either order:
/// "lids/*.svg=2", "3000x1500=5@steel:2". What is behind the last "@" of the name of a file, "a@b.dxf", is
/// none.
struct OrderedWord {
  std::string word;
  std::optional<std::int64_t> count;
  layout::Material material{};
};
/// Fails with ErrorCode::usage and what a sentence says behind the word, "does not end in a number...", where
/// the number is not from 1 to 1,000,000,000 or the thickness is none.
[[nodiscard]] Result<OrderedWord> ordered_word(const std::string& word);

/// The part that a row of a table orders, or one that was named without a table.
[[nodiscard]] OrderedPart ordered_part(const io::OrderRow& row, File file, const OrderTerms& terms);

/// An order under these terms, without parts and stocks.
[[nodiscard]] Order order_of(const OrderTerms& terms);

}  // namespace lekalo::jobs
