#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sqlite.hpp"

namespace lekalo::server {

/// These bring a store of format 1 or 2 forward, within a transaction of the caller's: its tables are set
/// aside, those of today are made by the caller, and what the old ones hold goes into them with digests.
[[nodiscard]] Result<void> set_old_tables_aside(const Database& database, std::int64_t format);

/// Old rows have no digests. So a row gets one only where it agrees with the others: a change with the state
/// before it, a snapshot with the changes that lead to it, an outline with the curves that it was made of.
/// Other rows are kept without one and are damaged from then on. Where a point is off its curves, the outline
/// can be drawn again: the layout with it becomes one more, and a sentence in `notices` says so, or what
/// would add it where the tables are those of a copy that is not kept. Returns how many were added.
[[nodiscard]] Result<std::int64_t> convert_tables(const Database& database, bool is_kept,
                                                  std::vector<std::string>& notices);

}  // namespace lekalo::server
