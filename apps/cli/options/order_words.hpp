#pragma once

#include "form.hpp"
#include "layout_words.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// The options that make a job of drawings; as typed.
struct OrderWords {
  std::vector<std::string> parts;
  std::string table, stock;
  jobs::OrderWords terms;
};

void add_order(Form& form, OrderWords& words);

/// Returns what was ordered, or nothing where no option of an order was given. Drawings are read as `layout`
/// says, and a file that stands there beside options of an order is its first part.
[[nodiscard]] Result<std::optional<OrderSource>> to_order(const OrderWords& words, const LayoutWords& layout);

}  // namespace lekalo::cli
