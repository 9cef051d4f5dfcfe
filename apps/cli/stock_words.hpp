#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/stock.hpp"

namespace lekalo::cli {

/// A line for people about a piece of stock.
[[nodiscard]] std::string item_text(const jobs::StockItem& item);

/// A line for each material.
[[nodiscard]] std::string sums_text(const std::vector<jobs::StockSums>& sums);

/// A line that says what is allocated to an order.
[[nodiscard]] std::string allocated_text(const jobs::StockOrder& order,
                                         const std::vector<jobs::StockItem>& items);

}  // namespace lekalo::cli
