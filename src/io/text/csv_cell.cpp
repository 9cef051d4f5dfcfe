#include "lekalo/io/text/csv_cell.hpp"

#include <string_view>

#include "lekalo/base/double_of_text.hpp"

namespace lekalo::io {
namespace {

/// Marks text that a spreadsheet would run as a formula, so that it shows it instead: an apostrophe goes
/// before it. Some take a semicolon or a tab for the end of a cell, so what follows one counts as a beginning
/// too.
std::string not_run_as_formula(const std::string& text) {
  if (double_of_text(text)) return text;
  std::string safe;
  bool begins = true;
  for (const char c : text) {
    if (begins && std::string_view("=+-@\t\r").find(c) != std::string_view::npos) safe += '\'';
    safe += c;
    begins = std::string_view(",;\t\r\n\"").find(c) != std::string_view::npos || (begins && c == ' ');
  }
  return safe;
}

}  // namespace

std::string csv_cell(const std::string& text) {
  const std::string safe = not_run_as_formula(text);
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace lekalo::io
