#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::disk {

/// Returns the files that a word means, in the order of their names: the file of that name; of a folder the
/// files in it that `counts` says yes to; else those that match it as a pattern with *, ? and [...].
///
/// Fails with ErrorCode::bad_input where it means none.
[[nodiscard]] Result<std::vector<std::string>> files_meant(
    const std::string& word, const std::function<bool(const std::string& name)>& counts);

}  // namespace lekalo::disk
