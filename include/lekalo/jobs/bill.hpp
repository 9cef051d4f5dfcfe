#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "lekalo/jobs/order_words.hpp"

namespace lekalo::jobs {

/// Returns the rows of files that an order asks for: those of its table, or those that a bill of materials
/// comes to, each with the pieces that are wanted of it in all. A row of a bill whose file has the name of an
/// assembly is as many of that assembly, to any depth; rows that differ in nothing but assembly and quantity
/// become one. Assemblies that are not built, and are in none that is, give no rows.
///
/// Fails with ErrorCode::usage where a bill comes without builds, builds without a bill, or a build names no
/// assembly; with ErrorCode::bad_input for an assembly that is a part of itself, and for more than
/// limits::kMostCount of anything, with the row. Cost: O(n log n) of n rows.
/// \param name    of the table, for sentences
/// \param prefix  stands before the word "build" in sentences, as in read_order_words
[[nodiscard]] Result<io::OrderTable> ordered_rows(io::OrderTable table, const std::string& name,
                                                  const std::vector<Build>& builds, std::string_view prefix);

}  // namespace lekalo::jobs
