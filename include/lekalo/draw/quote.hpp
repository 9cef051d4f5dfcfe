#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::draw {

/// A quote as it is printed, in words: pages of A4, upright. Whoever reckons it says what stands there.

struct QuoteColumn {
  std::string heading;
  double width_mm = 0;     ///< all of a table: 180
  bool is_number = false;  ///< stands on the right
};

struct QuoteTable {
  std::string heading;
  std::vector<QuoteColumn> columns;
  std::vector<std::vector<std::string>> rows;  ///< as long as `columns`
};

/// A row of the sum, the last one in bold.
struct QuoteSum {
  std::string words, amount;
};

struct QuotePaper {
  std::string title;
  std::vector<std::string> issuer;                           ///< lines at the top
  std::vector<std::pair<std::string, std::string>> figures;  ///< a name and a value each
  std::vector<QuoteTable> tables;                            ///< without rows they are left out
  std::vector<QuoteSum> sums;                                ///< after the first table
  std::vector<std::string> terms;                            ///< paragraphs at the end
};

/// PDF bytes; every row of every table is there. Fails with ErrorCode::environment where the drawing library
/// does. Cost: O(rows).
[[nodiscard]] Result<std::string> quote_pdf(const QuotePaper& paper);

}  // namespace lekalo::draw
