#pragma once

#include <string_view>

#include "lekalo/jobs/layout.hpp"

namespace lekalo::server {

/// Makes the layout that a form orders: its fields are the words of `lekalo nest` for an order
/// (jobs::OrderWords), its files the drawings, and the field `table`, if there is one, the parts as a table
/// (io::read_order) whose rows name those files. The same words and files give the layout that `lekalo new`
/// writes.
///
/// Fails with one sentence that lists everything that is wrong. Cost: that of reading the drawings.
[[nodiscard]] Result<jobs::Layout> ordered_layout(std::string_view body);

/// Reads such a form as an order that adds to a layout (jobs::Order::adds): `gap`, `border` and `kerf` are
/// none of its fields, and a form without drawings or without sheets is one too. The document has the parts
/// and stocks alone.
[[nodiscard]] Result<jobs::Layout> ordered_additions(std::string_view body);

}  // namespace lekalo::server
