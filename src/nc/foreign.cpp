#include "foreign.hpp"

#include <algorithm>
#include <array>

namespace lekalo::nc {
namespace {

struct Sign {
  std::string_view word, control;
};

/// Words with which a line begins, behind the number of its block.
constexpr std::array kSigns{
    Sign{"BEGIN PGM", "Heidenhain"}, Sign{"TOOL CALL", "Heidenhain"}, Sign{"CYCL DEF", "Heidenhain"},
    Sign{"BLK FORM", "Heidenhain"},  Sign{"%_N_", "Siemens"},         Sign{";%_N_", "Siemens"},
    Sign{"MSG(", "Siemens"},         Sign{"MCALL", "Siemens"},        Sign{"CYCLE8", "Siemens"},
    Sign{"CYCLE9", "Siemens"},       Sign{"ATRANS", "Siemens"},       Sign{"TRANS ", "Siemens"},
    Sign{"AROT ", "Siemens"},        Sign{"SUPA", "Siemens"},         Sign{"WORKPIECE(", "Siemens"},
    Sign{"DEF REAL", "Siemens"},
};

std::string code_of(std::string_view line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string_view::npos) return {};
  if (line[at] == 'N' || line[at] == 'n') ++at;
  at = std::min(line.find_first_not_of("0123456789", at), line.size());
  at = std::min(line.find_first_not_of(" \t", at), line.size());
  std::string code(line.substr(at, 24));
  std::ranges::transform(code, code.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return code;
}

}  // namespace

std::optional<ForeignProgram> foreign_program(std::string_view text) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string code = code_of(text.substr(0, end));
    for (const Sign& sign : kSigns)
      if (code.starts_with(sign.word))
        return ForeignProgram{std::string(sign.control), std::string(sign.word), line};
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::nullopt;
}

}  // namespace lekalo::nc
