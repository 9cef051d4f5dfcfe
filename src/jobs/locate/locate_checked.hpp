#pragma once

#include <functional>

#include "locate_search.hpp"

namespace lekalo::jobs {

/// Does what searched() does, and knows when to stop.
using Searcher = std::function<Result<Search>(const locate::Problem&, const LocateOptions&)>;

/// Does with the findings of any search what locate() does with those of its own: a test hands in one that is
/// wrong.
[[nodiscard]] Result<Located> locate_checked(const Searcher& searcher, const LocateJob& job);

}  // namespace lekalo::jobs
