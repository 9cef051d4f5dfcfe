#include "unfold.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "expression.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/nc_names.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/nc/program.hpp"
#include "letters.hpp"

namespace lekalo::nc {
namespace {

using Fault = std::optional<std::string>;

constexpr std::size_t kDeepestCall = 10, kMostBytes = 10'000'000;
constexpr double kMostRepeats = 9999;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// A line without its end, and its code: capitals without comments and blanks.
struct Line {
  std::string_view text, end;
  std::string code;
};

/// Returns the place behind the comment that begins at `at`.
std::size_t comment_end(std::string_view text, std::size_t at) {
  if (text[at] == ';') return text.size();
  int depth = 0;
  for (; at < text.size(); ++at) {
    depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    if (depth == 0) return at + 1;
  }
  return text.size();
}

std::string code_without_comments(std::string_view text) {
  std::string code;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '(' || text[at] == ';') {
      at = comment_end(text, at);
      continue;
    }
    if (!is_space(text[at])) code += to_upper(text[at]);
    ++at;
  }
  return code;
}

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = text.find('\n', begin);
    const std::size_t next = newline == std::string_view::npos ? text.size() : newline + 1;
    std::size_t end = newline == std::string_view::npos ? text.size() : newline;
    if (end > begin && end < next && text[end - 1] == '\r') --end;
    const std::string_view line = text.substr(begin, end - begin);
    lines.push_back({line, text.substr(end, next - end), code_without_comments(line)});
    begin = next;
  }
  return lines;
}

/// `code` without the number of the block.
std::string_view without_number(std::string_view code) {
  if (!code.starts_with('N')) return code;
  const std::size_t end = code.find_first_not_of("0123456789", 1);
  return code.substr(std::min(end, code.size()));
}

/// The digits behind the first letter, or nothing.
std::string_view digits_of(std::string_view code) {
  const std::size_t end = std::min(code.find_first_not_of("0123456789", 1), code.size());
  return code.substr(std::min<std::size_t>(1, code.size()), end > 0 ? end - 1 : 0);
}

std::string trimmed_number(std::string_view digits) {
  const std::size_t first = std::min(digits.find_first_not_of('0'), digits.size());
  return std::string(digits.substr(first));
}

/// True for the number in `code` of an M word.
bool has_m(std::string_view code, std::string_view number) {
  for (std::size_t at = code.find('M'); at != std::string_view::npos; at = code.find('M', at + 1))
    if (trimmed_number(digits_of(code.substr(at))) == number) return true;
  return false;
}

/// The number or name behind O.
std::string name_of(std::string_view code) {
  if (!code.starts_with('O')) return {};
  if (code.substr(1).starts_with('<'))
    return std::string(code.substr(1, std::min(code.find('>'), code.size() - 1)));
  return std::string(digits_of(code));
}

bool branches(std::string_view code) {
  constexpr std::array kWords{"IF[", "WHILE[", "GOTO", "DO1", "DO2", "DO3", "END1", "END2", "END3"};
  constexpr std::array kOWords{"IF[",     "ELSE",      "ELSEIF[", "ENDIF", "WHILE[",  "ENDWHILE",
                               "REPEAT[", "ENDREPEAT", "DO",      "BREAK", "CONTINUE"};
  if (std::ranges::any_of(kWords, [&](std::string_view word) { return code.starts_with(word); })) return true;
  if (!code.starts_with('O')) return false;
  const std::string_view rest = code.substr(std::min(1 + name_of(code).size(), code.size()));
  return std::ranges::any_of(kOWords, [&](std::string_view word) { return rest.starts_with(word); });
}

bool is_folded(std::string_view code) {
  if (code.find_first_of("#[") != std::string_view::npos || branches(without_number(code))) return true;
  return has_m(code, "97") || has_m(code, "98") || has_m(code, "99") ||
         (code.starts_with('O') && (code.ends_with("SUB") || code.find("CALL") != std::string_view::npos));
}

struct Subprogram {
  std::size_t first = 0, last = 0;  ///< the lines between its name and its end
};

class Unfolder {
 public:
  explicit Unfolder(std::string_view text) : lines_(lines_of(text)) {}

  [[nodiscard]] bool has_work() const {
    return std::ranges::any_of(lines_, [](const Line& line) { return is_folded(line.code); });
  }

  Fault run() {
    if (Fault fault = find_branches()) return fault;
    if (Fault fault = find_subprograms()) return fault;
    for (here_ = 0; here_ < lines_.size(); ++here_) {
      if (const auto end = end_of_definition(here_)) {
        // The lines from O to M99 run where the program comes to them; SUB is passed over.
        if (!ended_ && !lines_[here_].code.ends_with("SUB"))
          return "the program runs into a subprogram; put M2 or M30 before it";
        here_ = *end;
        continue;
      }
      if (ended_ && lines_[here_].code != "%") continue;
      if (Fault fault = step(here_)) return fault;
      const std::string_view code = lines_[here_].code;
      ended_ = ended_ || has_m(code, "2") || has_m(code, "30");
    }
    if (definitions_.empty() || result_.calls > 0) return {};
    here_ = definitions_.front().second.first - 1;
    return "a subprogram that nothing in this file calls; take it out";
  }

  [[nodiscard]] std::size_t line() const { return here_ + 1; }
  Unfolded take() { return std::move(result_); }

 private:
  /// Names all branches and loops at once.
  Fault find_branches() {
    std::string more;
    std::optional<std::size_t> first;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const std::string_view code = without_number(lines_[k].code);
      if (!branches(code)) continue;
      if (first) more += fmt::format("{}{}", more.empty() ? "; so in line " : ", ", k + 1);
      first = first.value_or(k);
    }
    if (!first) return {};
    here_ = *first;
    return "IF, GOTO and WHILE cannot be rewritten; let the CAM system write them out" + more;
  }

  void note_use(const words::FlowWord& word, std::size_t index) {
    const auto same = [&](const FlowUse& use) { return use.word == &word; };
    if (std::ranges::none_of(result_.uses, same)) result_.uses.push_back({&word, index + 1});
  }

  /// `O100 SUB` to `O100 ENDSUB`, and `O100` to M99 where another program was there before.
  Fault find_subprograms() {
    bool any_code = false;
    for (here_ = 0; here_ < lines_.size(); ++here_) {
      const std::string& code = lines_[here_].code;
      const std::string name = name_of(code);
      const bool named_block = !name.empty() && code == "O" + name;
      const bool opens = !name.empty() && code == "O" + name + "SUB";
      if (opens || (named_block && any_code)) {
        const std::size_t end = opens ? line_with("O" + name + "ENDSUB") : line_of_return(here_ + 1);
        if (end == lines_.size()) return fmt::format("the subprogram O{} has no end in this file", name);
        definitions_.push_back({trimmed_number(name), {here_ + 1, end}});
        here_ = end;
      }
      any_code = any_code || (!code.empty() && code != "%");
    }
    return {};
  }

  [[nodiscard]] std::size_t line_with(const std::string& code) const {
    std::size_t k = here_;
    while (k < lines_.size() && lines_[k].code != code) ++k;
    return k;
  }
  [[nodiscard]] std::size_t line_of_return(std::size_t k) const {
    while (k < lines_.size() && without_number(lines_[k].code) != "M99") ++k;
    return k;
  }

  /// The last line of the definition that begins at this line.
  [[nodiscard]] std::optional<std::size_t> end_of_definition(std::size_t line) const {
    for (const auto& [name, body] : definitions_)
      if (body.first == line + 1) return body.last;
    return std::nullopt;
  }

  Fault step(std::size_t index) {
    ask();
    const Line& line = lines_[index];
    const std::string_view code = without_number(line.code);
    if (result_.text.size() > kMostBytes) return "the program written out has more than 10 million bytes";
    if (code.find_first_of("#[") != std::string_view::npos) note_use(words::kVariable, index);
    if (code.find("#<") != std::string_view::npos) note_use(words::kNamedVariable, index);
    if (code.starts_with('#')) return assign(line, index);
    if (has_m(code, "98") || has_m(code, "97")) return call_by_m(line, code, index);
    if (code.starts_with('O') && code.ends_with("CALL")) note_use(words::kNamedSubprogram, index);
    if (code.starts_with('O') && code.ends_with("CALL"))
      return call(line, trimmed_number(name_of(code)), 1, index);
    if (code.starts_with('O') && code.find("CALL[") != std::string_view::npos)
      return "a call with arguments cannot be rewritten; let the CAM system write it out";
    if (has_m(code, "99")) return "M99 in the main program, which then never ends";
    std::string text;
    if (Fault fault = computed(line.text, text)) return fault;
    emit(text, line, index);
    return {};
  }

  void emit(const std::string& text, const Line& line, std::size_t index) {
    result_.text += text;
    result_.text += line.end.empty() && index + 1 < lines_.size() ? "\n" : line.end;
    result_.lines.push_back(index + 1);
  }

  /// The code of a line as a comment, with the comments that were there.
  void emit_as_comment(const Line& line, std::size_t index) {
    std::string remarks;
    const std::string_view text = line.text;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] != '(' && text[at] != ';') continue;
      const std::size_t end = comment_end(text, at);
      remarks += " " + std::string(text.substr(at, end - at));
      at = end - 1;
    }
    emit("(" + line.code + ")" + remarks, line, index);
  }

  Fault assign(const Line& line, std::size_t index) {
    // The code has no blanks and no comments, so a place in it says nothing about the line.
    ExpressionReader name(line.code, line.code.find('#') + 1, variables_, depth_ > 0);
    const std::string key = name.key();
    if (!name.fault().empty()) return name.fault();
    if (name.at() >= line.code.size() || line.code[name.at()] != '=')
      return "a variable that is neither set nor used as a number";
    if (key.starts_with('<') && words::is_state_name(std::string_view(key).substr(1)))
      return fmt::format("#{}> is set by the control alone", key);
    ExpressionReader sum(line.code, name.at() + 1, variables_, depth_ > 0);
    const double value = sum.total();
    if (!sum.fault().empty()) return sum.fault();
    if (sum.at() != line.code.size())
      return "an assignment that is not understood, or beside other words; give it a block of its own";
    variables_[key] = value;
    ++result_.computed;
    emit_as_comment(line, index);
    return {};
  }

  Fault call_by_m(const Line& line, std::string_view code, std::size_t index) {
    std::string name;
    double repeats = 1;
    const bool local = has_m(code, "97");
    note_use(local ? words::kLocalCall : words::kCall, index);
    for (std::size_t at = 0; at < code.size();) {
      const char letter = code[at];
      const std::string_view digits = digits_of(code.substr(at));
      at += 1 + digits.size();
      if (letter == 'P')
        name = trimmed_number(digits);
      else if (letter == 'L')
        repeats = double_of_text(digits).value_or(0);
      else if (letter != 'M')
        return "a call beside other words; give it a block of its own";
    }
    if (!(repeats >= 1 && repeats <= kMostRepeats)) return "L of a call is not a whole number from 1 to 9999";
    return local ? call_local(line, name, repeats, index) : call(line, name, repeats, index);
  }

  Fault call(const Line& line, const std::string& name, double repeats, std::size_t index) {
    const auto found = std::ranges::find(definitions_, name, &std::pair<std::string, Subprogram>::first);
    if (found == definitions_.end())
      return fmt::format(
          "the subprogram O{} is not in this file; put it there, or let the CAM system write "
          "it out",
          name);
    return write_out(line, found->second, repeats, index);
  }

  /// M97 calls what stands behind an N of the same file, up to M99. Where there is no such N the control
  /// stops with an alarm, in the result as in the original.
  Fault call_local(const Line& line, const std::string& name, double repeats, std::size_t index) {
    const auto is_named = [&](const Line& each) {
      return each.code.starts_with('N') && trimmed_number(digits_of(each.code)) == name;
    };
    const auto found = std::ranges::find_if(lines_, is_named);
    if (found == lines_.end()) {
      result_.notes.push_back(
          fmt::format("line {}: N{}, which M97 calls, is not in this program: the control stops there, as it "
                      "does with the original",
                      index + 1, name));
      emit(std::string(line.text), line, index);
      return {};
    }
    const auto first = static_cast<std::size_t>(found - lines_.begin());
    const std::size_t end = line_of_return(first);
    if (end == lines_.size()) return fmt::format("the subprogram N{} has no M99", name);
    return write_out(line, {first, end}, repeats, index);
  }

  Fault write_out(const Line& line, Subprogram body, double repeats, std::size_t index) {
    if (++depth_ > kDeepestCall) return "subprograms call each other more than ten deep";
    emit_as_comment(line, index);
    ++result_.calls;
    const std::size_t back = here_;
    for (double k = 0; k < repeats; ++k)
      for (here_ = body.first; here_ < body.last; ++here_) {
        if (has_m(lines_[here_].code, "2") || has_m(lines_[here_].code, "30"))
          return "the program ends in a subprogram";
        if (Fault fault = step(here_)) return fault;
      }
    here_ = back;
    --depth_;
    return {};
  }

  /// The line with numbers in the place of variables and expressions.
  Fault computed(std::string_view text, std::string& result) {
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] == '(' || text[at] == ';') {
        const std::size_t end = comment_end(text, at);
        result += text.substr(at, end - at);
        at = end;
        continue;
      }
      const bool sign =
          text[at] == '-' && at + 1 < text.size() && (text[at + 1] == '#' || text[at + 1] == '[');
      if (text[at] != '#' && text[at] != '[' && !sign) {
        result += text[at++];
        continue;
      }
      ExpressionReader reader(text, at, variables_, depth_ > 0);
      const double value = reader.value();
      if (!reader.fault().empty()) return reader.fault();
      result += format_value(value);
      at = reader.at();
      ++result_.computed;
    }
    return {};
  }

  std::vector<Line> lines_;
  std::vector<std::pair<std::string, Subprogram>> definitions_;
  Variables variables_;
  Unfolded result_;
  std::size_t here_ = 0, depth_ = 0;
  bool ended_ = false;
};

}  // namespace

bool is_folded_line(std::string_view line) { return is_folded(code_without_comments(line)); }

tl::expected<Unfolded, LineFault> unfold(std::string_view text) {
  Unfolder unfolder(text);
  if (!unfolder.has_work()) return Unfolded{std::string(text), {}, 0, 0, {}, {}};
  if (const Fault fault = unfolder.run()) return tl::unexpected(LineFault{unfolder.line(), *fault});
  return unfolder.take();
}

}  // namespace lekalo::nc
