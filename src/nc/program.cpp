#include "lekalo/nc/program.hpp"

#include <fmt/core.h>

#include <optional>

#include "lekalo/base/stop.hpp"
#include "letters.hpp"

namespace lekalo::nc {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t'; }
bool is_control(char c) noexcept { return (static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127; }
bool is_ascii(char c) noexcept { return static_cast<unsigned char>(c) < 128; }
bool is_letter(char c) noexcept { return to_upper(c) >= 'A' && to_upper(c) <= 'Z'; }
bool in_number(char c) noexcept { return is_digit(c) || c == '.' || c == '+' || c == '-'; }

constexpr const char* kSubprograms =
    "O words (subprograms, branches) cannot be rewritten; let the CAM system write them out";

/// The fault of a line, as words that complete `name:line:`; none when all is well.
using Fault = std::optional<std::string>;

/// LinuxCNC executes some comments. Those that only show a text pass. Those that run code, open files, stop
/// the program or read variables do not.
Fault comment_fault(std::string_view body) {
  std::string keyword;
  std::size_t comma = 0;
  for (; comma < body.size() && body[comma] != ','; ++comma)
    if (!is_blank(body[comma])) keyword += to_upper(body[comma]);
  if (comma == body.size()) return {};

  for (const char* refused :
       {"PY", "PYTHON", "PROBEOPEN", "PROBECLOSE", "LOGOPEN", "LOGAPPEND", "LOGCLOSE", "ABORT"})
    if (keyword == refused)
      return fmt::format("the comment ({},...) acts on the control; remove it", keyword);
  for (const char* printing : {"DEBUG", "PRINT", "LOG"})
    if (keyword == printing && body.find('#') != std::string_view::npos)
      return fmt::format("the comment ({},...) reads variables, which may hold positions; remove it",
                         keyword);
  return {};
}

std::string shown(char c) {
  return is_ascii(c) && !is_control(c) ? fmt::format("'{}'", c)
                                       : fmt::format("byte 0x{:02X}", static_cast<unsigned char>(c));
}

std::string character_fault(char c) {
  switch (c) {
    case '#':
      return "variables (#) cannot be rewritten; let the CAM system write plain numbers";
    case '[':
    case ']':
      return "expressions ([...]) cannot be rewritten; let the CAM system write plain numbers";
    case '@':
    case '^':
      return "polar words (@ ^) cannot be rewritten; give X and Y";
    case '%':
      return "% must stand alone on its line";
    case '/':
      return "/ may only begin a line";
    case ')':
      return "a comment is closed that was not opened";
    default:
      break;
  }
  if (!is_ascii(c)) return fmt::format("{} outside a comment is not ASCII", shown(c));
  return fmt::format("{} does not belong in a program", shown(c));
}

/// Reads one line; `at` always stands on the next unread byte.
class LineReader {
 public:
  LineReader(std::string_view text, Block& block) : text_(text), block_(block), at_(block.begin) {}

  Fault read() {
    if (block_.end - block_.begin > kMaxBlockLength)
      return fmt::format("the line has {} bytes, more than the {} a control reads", block_.end - block_.begin,
                         kMaxBlockLength);
    for (std::size_t k = block_.begin; k < block_.end; ++k)
      if (is_control(text_[k]))
        return text_[k] == '\r'
                   ? std::string("a carriage return inside a line; line ends must be LF or CR LF")
                   : fmt::format("control character {}", shown(text_[k]));
    skip_blanks();
    if (peek() == '%') return read_tape_mark();
    if (peek() == '/') {
      block_.block_delete = true;
      ++at_;
      skip_blanks();
      if (is_digit(peek())) return "numbered block delete (/2) is not on the list of what can be rewritten";
    }
    while (!at_end())
      if (Fault fault = read_item()) return fault;
    return {};
  }

 private:
  bool at_end() const noexcept { return at_ == block_.end; }
  char peek() const noexcept { return at_end() ? '\0' : text_[at_]; }
  void skip_blanks() noexcept {
    while (is_blank(peek())) ++at_;
  }

  Fault read_tape_mark() {
    ++at_;
    skip_blanks();
    if (!at_end()) return character_fault('%');
    block_.tape_mark = true;
    return {};
  }

  Fault read_item() {
    const char c = peek();
    if (is_blank(c)) {
      ++at_;
      return {};
    }
    if (c == ';') return read_rest_as_comment();
    if (c == '(') return read_comment();
    if (is_letter(c)) return read_word();
    return character_fault(c);
  }

  Fault read_rest_as_comment() {
    const std::string_view body = text_.substr(at_ + 1, block_.end - at_ - 1);
    at_ = block_.end;
    return comment_fault(body);
  }

  Fault read_comment() {
    const std::size_t open = at_++;
    for (int depth = 1; !at_end(); ++at_) {
      block_.nested_comment = block_.nested_comment || peek() == '(';
      depth += peek() == '(' ? 1 : peek() == ')' ? -1 : 0;
      if (depth == 0) return comment_fault(text_.substr(open + 1, at_++ - open - 1));
    }
    return "a comment is opened and not closed";
  }

  Fault read_word() {
    Word word;
    word.letter_at = at_;
    word.letter = to_upper(text_[at_++]);
    skip_blanks();
    word.number_begin = at_;
    while (in_number(peek())) ++at_;
    word.number_end = at_;
    const std::string_view number = text_.substr(word.number_begin, word.number_end - word.number_begin);
    if (number.empty()) return missing_number(word.letter);

    const ParsedDecimal parsed = parse_decimal(number);
    if (!parsed.value)
      return parsed.fault == DecimalFault::too_long
                 ? fmt::format("the number of {}{} has more than {} digits", word.letter, number, kMaxDigits)
                 : fmt::format("{}{} is not a number", word.letter, number);
    skip_blanks();
    if (in_number(peek())) return fmt::format("a blank inside the number after {}{}", word.letter, number);
    if (word.letter == 'O' && !at_end() && peek() != '(' && peek() != ';') return std::string(kSubprograms);
    word.value = *parsed.value;
    word.has_point = number.find('.') != std::string_view::npos;
    block_.words.push_back(word);
    return {};
  }

  Fault missing_number(char letter) const {
    if (letter == 'O') return std::string(kSubprograms);
    const char next = peek();
    if (next == '#' || next == '[' || next == '@' || next == '^') return character_fault(next);
    return fmt::format("the letter {} has no number", letter);
  }

  std::string_view text_;
  Block& block_;
  std::size_t at_;
};

/// The program stands between the tape marks. A control ignores what follows the last one, so nothing may
/// stand there.
Fault tape_mark_fault(const Block& block, bool& seen_words, int& marks) {
  if (marks == 2 && (block.tape_mark || !block.words.empty())) return "words after the final %";
  if (block.tape_mark) marks = seen_words ? 2 : marks + 1;
  seen_words = seen_words || !block.words.empty();
  return {};
}

}  // namespace

tl::unexpected<Error> refusal(const std::string& name, std::size_t line, const std::string& reason) {
  return failure(ErrorCode::program_refused, fmt::format("{}:{}: {}", name, line, reason));
}

Program parse_program(std::string_view text, const std::vector<std::size_t>& lines) {
  Program program;
  bool seen_words = false;
  int marks = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    ask();
    std::size_t newline = text.find('\n', begin);
    const bool ends = newline != std::string_view::npos;
    if (!ends) newline = text.size();
    Block block;
    const std::size_t index = program.blocks.size();
    block.line = index < lines.size() ? lines[index] : index + 1;
    block.begin = begin;
    block.end = newline > begin && ends && text[newline - 1] == '\r' ? newline - 1 : newline;
    if (ends && program.line_end.empty()) program.line_end = text.substr(block.end, newline + 1 - block.end);

    Fault fault = LineReader(text, block).read();
    if (!fault) fault = tape_mark_fault(block, seen_words, marks);
    if (fault) program.faults.push_back({block.line, *std::move(fault)});
    program.blocks.push_back(std::move(block));
    begin = newline + 1;
  }
  if (program.line_end.empty()) program.line_end = "\n";
  return program;
}

}  // namespace lekalo::nc
