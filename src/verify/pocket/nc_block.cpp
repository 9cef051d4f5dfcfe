#include "nc_block.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lekalo/base/double_of_text.hpp"

namespace lekalo::verify {
namespace {

using words::Control;
using words::Group;

/// LinuxCNC reads no longer lines, and no more M words in one. More digits of N than these fit no integer.
constexpr std::size_t kLongestLine = 252, kMostMWords = 4, kMostDigitsOfN = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_count(double value) { return value >= 0 && value == std::floor(value); }

/// LinuxCNC runs some comments. Those that run code, open files or end the program are not understood.
bool acts(std::string_view comment) {
  const std::size_t comma = comment.find(',');
  if (comma == std::string_view::npos) return false;
  std::string keyword;
  for (const char c : comment.substr(0, comma))
    if (!is_blank(c)) keyword += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 8> kActing{"PY",         "PYTHON",  "ABORT",     "PROBEOPEN",
                                                    "PROBECLOSE", "LOGOPEN", "LOGAPPEND", "LOGCLOSE"};
  return std::ranges::find(kActing, keyword) != kActing.end();
}

/// A block that the machine may skip does nothing on which a later one depends.
bool may_be_skipped(const NcBlock& block) {
  constexpr std::array kHarmless{0, 10, 70, 80, 90};
  for (const words::Word* code : block.codes)
    if (code->letter == 'G' ? code->tenths != words::kDwell
                            : std::ranges::find(kHarmless, code->tenths) == kHarmless.end())
      return false;
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (block[letter] && std::string_view("NPS").find(letter) == std::string_view::npos) return false;
  return !block['P'] || block.code(Group::once) != nullptr;
}

}  // namespace

bool NcBlock::empty() const {
  return codes.empty() && allowed.empty() &&
         std::ranges::none_of(words, [](const auto& word) { return word.has_value(); });
}

std::string name_of(const words::Word& word) {
  return fmt::format("{}{:g}", word.letter, word.tenths / 10.0);
}

bool NcLines::complain(const std::string& sentence) {
  if (complaint_.empty()) complaint_ = sentence;
  return false;
}

bool NcLines::read(std::string_view text, bool in_subprogram, NcBlock& block) {
  in_subprogram_ = in_subprogram;
  if (!check_bytes(text)) return false;
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return true;
  if (text[first] == '%') return tape_mark(text.substr(first));
  any_text_ = true;
  if (const std::string_view code = text.substr(first); code.front() == '#') return set_variable(code);
  const bool skipped = text[first] == '/';
  if (skipped) text.remove_prefix(first + 1);
  if (!take_apart(text, block)) return false;
  if (skipped && !may_be_skipped(block))
    return complain("a block that may be skipped is not understood; take out the /");
  if (skipped) block = {.line = block.line, .codes = {}, .allowed = {}, .words = {}, .pointless = {}};
  if (block.empty()) return true;
  if (ended_) return complain("words after the end of the program");
  any_words_ = true;
  return fit(block);
}

bool NcLines::check_bytes(std::string_view& text) {
  if (text.size() > kLongestLine)
    return complain(fmt::format("the line is longer than {} bytes", kLongestLine));
  if (text.ends_with('\r')) text.remove_suffix(1);
  for (const char c : text) {
    if (c == '\r') return complain("a carriage return inside a line; line ends are LF or CR LF");
    if ((static_cast<unsigned char>(c) < ' ' && c != '\t') || c == 127)
      return complain("a control character inside a line");
  }
  return true;
}

/// As LinuxCNC has it, a program that begins with % ends at the next one.
bool NcLines::tape_mark(std::string_view text) {
  if (text.find_last_not_of(" \t") != 0) return complain("% does not stand alone on its line");
  if (any_text_ && !begun_by_mark_) return complain("% after a beginning without %");
  if (any_text_) ended_ = true;
  begun_by_mark_ = any_text_ = true;
  return true;
}

/// A remark may stand behind an assignment.
bool NcLines::set_variable(std::string_view code) {
  if (ended_) return complain("words after the end of the program");
  any_words_ = true;
  const std::string_view assignment = code.substr(0, code.find_first_of("(;"));
  return knows_variables(assignment) && assign(assignment, variables_, in_subprogram_, complaint_);
}

bool NcLines::knows_variables(std::string_view code) {
  const words::FlowWord& word =
      code.find("#<") == std::string_view::npos ? words::kVariable : words::kNamedVariable;
  return words::knows(word, control_) || complain(fmt::format("{} is no word of this control", word.name));
}

bool NcLines::take_apart(std::string_view text, NcBlock& block) {
  std::size_t at = 0;
  for (;;) {
    while (at < text.size() && is_blank(text[at])) ++at;
    if (at == text.size()) return true;
    const char c = text[at];
    if (c == ';') {
      if (acts(text.substr(at + 1))) return complain("a comment that acts on the control is not understood");
      return true;
    }
    if (!(c == '(' ? take_comment(text, at) : take_word(text, at, block))) return false;
  }
}

bool NcLines::take_comment(std::string_view text, std::size_t& at) {
  const std::size_t open = at++;
  for (int depth = 1; at < text.size(); ++at) {
    if (text[at] == '(' && control_ == Control::linuxcnc) return complain("a comment inside a comment");
    depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    if (depth > 0) continue;
    if (acts(text.substr(open + 1, at++ - open - 1)))
      return complain("a comment that acts on the control is not understood");
    return true;
  }
  return complain("a comment is not closed");
}

bool NcLines::take_word(std::string_view text, std::size_t& at, NcBlock& block) {
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[at])));
  if (letter < 'A' || letter > 'Z')
    return complain(fmt::format("the character {:?} is not understood", text.substr(at, 1)));
  ++at;
  while (at < text.size() && is_blank(text[at])) ++at;
  const std::size_t begin = at;
  const bool signed_one = at < text.size() && (text[at] == '-' || text[at] == '+');
  const std::size_t opens = signed_one ? text.find_first_not_of(" \t", at + 1) : at;
  if (opens < text.size() && (text[opens] == '#' || text[opens] == '[')) {
    const std::optional<double> value = computed(text, at, variables_, in_subprogram_, complaint_);
    return value && knows_variables(text.substr(begin, at - begin)) &&
           (letter == 'N' || letter == 'O' ? complain("the number of a block is computed")
                                           : keep(letter, *value, block));
  }
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.' || text[at] == '-' || text[at] == '+'))
    ++at;
  std::string_view digits = text.substr(begin, at - begin);
  if (letter == 'N' || letter == 'O') return take_name(letter, digits, block);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  const std::optional<double> value = double_of_text(digits);
  if (!value) return complain(fmt::format("{} is not followed by a plain number", letter));
  if (*value != 0 && digits.find('.') == std::string_view::npos) block.pointless += letter;
  return keep(letter, *value, block);
}

/// N names a block and O a program, and neither does anything. O words at other places call or branch.
bool NcLines::take_name(char letter, std::string_view digits, NcBlock& block) {
  if (digits.empty() || !std::ranges::all_of(digits, is_digit))
    return complain(fmt::format("{} is not followed by a plain number", letter));
  if (!block.empty()) return complain(fmt::format("{} does not begin its block", letter));
  if (letter == 'N' && digits.size() > kMostDigitsOfN)
    return complain(fmt::format("N has more than {} digits", kMostDigitsOfN));
  if (letter == 'O' && any_words_) return complain("subprograms are not understood");
  block.words[static_cast<std::size_t>(letter - 'A')].emplace();
  return true;
}

bool NcLines::keep(char letter, double value, NcBlock& block) {
  if (block['O']) return complain("words beside the number of the program");
  if (letter == 'M' && std::ranges::find(allowed_m_, value) != allowed_m_.end()) {
    block.allowed.push_back(static_cast<int>(value));
    return true;
  }
  if (letter == 'G' || letter == 'M') {
    const double tenths = std::round(10 * value);
    // No code is below 0 or from 1000 on.
    const int code_tenths = std::abs(tenths) < 1e4 ? static_cast<int>(tenths) : -1;
    const words::Word* code = tenths / 10 == value ? words::word_at(letter, code_tenths, control_) : nullptr;
    if (code == nullptr) return complain(fmt::format("{}{:g} is not understood here", letter, value));
    if (const words::Word* other = block.code(code->group);
        other != nullptr && other->group != Group::auxiliary)
      return complain(fmt::format("{} and {} exclude each other", name_of(*other), name_of(*code)));
    block.codes.push_back(code);
    return true;
  }
  std::optional<double>& word = block.words[static_cast<std::size_t>(letter - 'A')];
  if (word) return complain(fmt::format("{} is given twice", letter));
  if (!words::is_letter_known(letter)) return complain(fmt::format("the word {} is not understood", letter));
  word = value;
  return true;
}

/// Refuses numbers that the words of a block cannot have.
bool NcLines::fit(const NcBlock& block) {
  for (const words::Word* code : block.codes) {
    const bool dwells = code->letter == 'G' && code->tenths == words::kDwell;
    if (!dwells && code->group != Group::output) continue;
    if (std::ranges::none_of(code->takes, [&](char letter) { return block[letter].has_value(); }))
      return complain(fmt::format("{} without P", name_of(*code)));
  }
  if (control_ == Control::linuxcnc &&
      std::ranges::count(block.codes, 'M', &words::Word::letter) > static_cast<std::ptrdiff_t>(kMostMWords))
    return complain(fmt::format("more than {} M words in a block", kMostMWords));
  for (const char letter : {'P', 'Q', 'S'})
    if (block[letter] && !(*block[letter] >= 0)) return complain(fmt::format("{} is below 0", letter));
  for (const char letter : {'T', 'H', 'D'})
    if (block[letter] && !is_count(*block[letter]))
      return complain(fmt::format("{} is not a whole number from 0 on", letter));
  if (block.code(Group::output) != nullptr && !is_count(*block['P']))
    return complain("P is not a whole number from 0 on");
  for (const char axis : {'A', 'B', 'C'})
    if (block[axis] && *block[axis] != 0)
      return complain(fmt::format("{} turns the part; programs of X, Y and Z are understood", axis));
  return true;
}

}  // namespace lekalo::verify
