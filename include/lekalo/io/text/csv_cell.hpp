#pragma once

#include <string>

namespace lekalo::io {

/// A text as one cell of CSV, quoted as RFC 4180 asks for. What a spreadsheet would run as a formula gets an
/// apostrophe before it, so that it shows it instead; numbers stay numbers.
[[nodiscard]] std::string csv_cell(const std::string& text);

}  // namespace lekalo::io
