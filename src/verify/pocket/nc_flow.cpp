#include "nc_flow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kMostLines = 1'000'000, kDeepestCall = 10;

/// A line in capitals, without blanks, comments and the number of its block.
struct Code {
  std::string text;
  std::string block;             ///< the digits of N, without zeros before them
  std::string_view remarks;      ///< what follows the code in the line
  bool remarks_between = false;  ///< a comment stands before some of the code
};

std::string digits_at(std::string_view text, std::size_t at) {
  std::string digits;
  for (; at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0; ++at)
    digits += text[at];
  return digits;
}

std::string without_zeros(const std::string& digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

Code code_of(std::string_view line) {
  Code code;
  int depth = 0;
  bool remarked = false;
  std::size_t end = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == ';' && depth == 0) break;
    depth += c == '(' ? 1 : 0;
    remarked = remarked || depth > 0;
    if (depth == 0 && c != ' ' && c != '\t' && c != '\r') {
      code.text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      code.remarks_between = remarked;
      end = at + 1;
    }
    depth -= c == ')' && depth > 0 ? 1 : 0;
  }
  code.remarks = line.substr(end);
  if (!code.text.starts_with('N')) return code;
  const std::string digits = digits_at(code.text, 1);
  code.block = without_zeros(digits);
  code.text.erase(0, 1 + digits.size());
  return code;
}

/// The number behind the first `letter`, without zeros before it; empty: there is none.
std::string number_of(const std::string& code, char letter) {
  const std::size_t at = code.find(letter);
  return at == std::string::npos ? "" : without_zeros(digits_at(code, at + 1));
}

class Flow {
 public:
  Flow(const Document& program, words::Control control) : name_(program.name), control_(control) {
    std::string_view rest = program.bytes;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      lines_.push_back({lines_.size() + 1, rest.substr(0, end), false});
      codes_.push_back(code_of(lines_.back().text));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  Result<std::vector<NcLine>> run() {
    const bool calls = std::ranges::any_of(codes_, [](const Code& code) { return is_call(code.text); });
    if (!calls) return lines_;
    std::size_t line = 0;
    find_subprograms();
    bool ended = false;
    for (; line < lines_.size() && complaint_.empty(); ++line) {
      if (const auto body = bodies_by_line_.find(line); body != bodies_by_line_.end()) {
        at_ = line;
        if (!ended && !codes_[line].text.ends_with("SUB"))
          complain("the program runs into a subprogram; M2 or M30 is missing before it");
        line = body->second;
        continue;
      }
      // Behind its end a program has subprograms only.
      if (!ended || codes_[line].text == "%") take(line);
      const std::string m = number_of(codes_[line].text, 'M');
      ended = ended || m == "2" || m == "30";
    }
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", name_, at_ + 1, complaint_));
    return std::move(order_);
  }

 private:
  static bool is_call(const std::string& code) {
    const std::string m = number_of(code, 'M');
    return m == "97" || m == "98" || (code.starts_with('O') && code.ends_with("CALL"));
  }

  static std::string name_of(const std::string& code) {
    if (code.starts_with("O<")) return code.substr(1, code.find('>'));
    return without_zeros(digits_at(code, 1));
  }

  void find_subprograms() {
    bool any = false;
    for (std::size_t k = 0; k < codes_.size(); ++k) {
      const std::string& code = codes_[k].text;
      const bool opens = code.starts_with('O') && code.ends_with("SUB") && !code.ends_with("ENDSUB");
      const bool numbered = any && code == "O" + digits_at(code, 1);
      any = any || (!code.empty() && code != "%");
      if (!opens && !numbered) continue;
      const std::string last = opens ? code.substr(0, code.size() - 3) + "ENDSUB" : "M99";
      std::size_t end = k;
      while (end < codes_.size() && codes_[end].text != last) ++end;
      at_ = k;
      if (end == codes_.size()) return complain("a subprogram without an end");
      bodies_[name_of(code)] = {k + 1, end};
      bodies_by_line_[k] = end;
      k = end;
    }
  }

  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }

  void take(std::size_t line) {
    ask();
    if (complaint_.empty()) at_ = line;
    const std::string& code = codes_[line].text;
    if (order_.size() >= kMostLines) return complain("the program runs more than a million lines");
    if (!is_call(code)) {
      if (number_of(code, 'M') == "99") return complain("M99 outside a subprogram");
      return order_.push_back({line + 1, lines_[line].text, depth_ > 0});
    }
    const words::FlowWord& word = code.starts_with('O')          ? words::kNamedSubprogram
                                  : number_of(code, 'M') == "97" ? words::kLocalCall
                                                                 : words::kCall;
    if (!words::knows(word, control_))
      return complain(fmt::format("{} is no word of this control", word.name));
    if (codes_[line].remarks_between) return complain("a comment before the words of a call");
    order_.push_back({line + 1, codes_[line].remarks, false});
    call(code);
  }

  void call(const std::string& code) {
    if (code.starts_with('O')) return repeat(bodies_.find(name_of(code)), 1);
    long repeats = 1;
    std::string rest;
    for (const char letter : {'M', 'P', 'L'}) {
      const std::size_t at = code.find(letter);
      if (at == std::string::npos) continue;
      const std::string digits = digits_at(code, at + 1);
      rest += letter + digits;
      // No control counts to more than 9999.
      if (letter == 'L') repeats = digits.size() > 4 || digits.empty() ? 0 : std::stol(digits);
    }
    if (rest.size() != code.size()) return complain("a call beside other words");
    if (repeats < 1) return complain("a call that is repeated L times is not understood");
    const std::string wanted = number_of(code, 'P');
    if (number_of(code, 'M') == "98") return repeat(bodies_.find(wanted), repeats);
    if (wanted.empty()) return complain("a call without P");
    const auto first =
        static_cast<std::size_t>(std::ranges::find(codes_, wanted, &Code::block) - codes_.begin());
    if (first == codes_.size()) return void(order_.back().text = lines_[at_].text);
    std::size_t end = first;
    while (end < codes_.size() && codes_[end].text != "M99") ++end;
    if (end == codes_.size()) return complain("a subprogram without an end");
    repeat(bodies_.insert_or_assign("N" + wanted, std::pair(first, end)).first, repeats);
  }

  using Bodies = std::map<std::string, std::pair<std::size_t, std::size_t>>;

  void repeat(Bodies::const_iterator body, long repeats) {
    if (body == bodies_.end()) return complain("a subprogram that is not in this file");
    if (++depth_ > kDeepestCall) return complain("subprograms call each other too deeply");
    const auto [first, end] = body->second;
    for (long k = 0; k < repeats; ++k)
      for (std::size_t line = first; line < end && complaint_.empty(); ++line) {
        const std::string m = number_of(codes_[line].text, 'M');
        if (m == "2" || m == "30") at_ = line, complain("the program ends in a subprogram");
        take(line);
      }
    --depth_;
  }

  std::string name_;
  words::Control control_;
  std::vector<NcLine> lines_, order_;
  std::vector<Code> codes_;
  Bodies bodies_;
  std::map<std::size_t, std::size_t> bodies_by_line_;
  std::string complaint_;
  std::size_t at_ = 0, depth_ = 0;
};

}  // namespace

Result<std::vector<NcLine>> lines_in_order(const Document& program, words::Control control) {
  return Flow(program, control).run();
}

}  // namespace lekalo::verify
