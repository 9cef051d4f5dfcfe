#include "nc_expression.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/nc_names.hpp"

namespace lekalo::verify {
namespace {

constexpr double kLargest = 1e6;
constexpr int kDeepestExpression = 40;

/// Reads by precedence: a level binds closer than the one before it.
class Reader {
 public:
  Reader(std::string_view text, std::size_t at, const NcVariables& variables, bool globals_only)
      : text_(text), at_(at), variables_(variables), globals_only_(globals_only) {}

  double sum() {
    double left = product();
    for (char c = next(); c == '+' || c == '-'; c = next()) {
      ++at_;
      const double right = product();
      left = c == '+' ? left + right : left - right;
    }
    return left;
  }

  double one() {
    const char c = next();
    if (c == '+' || c == '-') {
      ++at_;
      const double value = nested();
      return c == '-' ? -value : value;
    }
    if (c == '[') return in_brackets();
    if (c == '#') return variable();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return function();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
      ++at_;
    const auto number = double_of_text(text_.substr(begin, at_ - begin));
    return number ? *number : complain("an expression without a number");
  }

  std::string name() {
    if (next() != '<') {
      const double number = one();
      if (!(number >= 1 && number <= 999 && number == std::floor(number)))
        complain(fmt::format("variable #{:g} is not one of a program's own", number));
      if (globals_only_ && number < 100) complain("a local variable in a subprogram");
      return fmt::format("{}", number);
    }
    const std::size_t end = text_.find('>', at_);
    if (end == std::string_view::npos) return complain("the name of a variable is not closed"), "";
    std::string name;
    for (const char c : text_.substr(at_, end + 1 - at_))
      if (c != ' ' && c != '\t') name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    at_ = end + 1;
    if (globals_only_ && !name.starts_with("<_")) complain("a local variable in a subprogram");
    return name;
  }

  /// The value behind the variable that is set.
  double assigned() {
    constexpr const char* kNotAlone = "a variable that is neither set alone nor used as a number";
    const double value = takes('=') ? sum() : complain(kNotAlone);
    return next() == '\0' ? value : complain(kNotAlone);
  }
  [[nodiscard]] std::size_t at() const { return at_; }
  std::string complaint;

 private:
  double complain(const std::string& sentence) {
    if (complaint.empty()) complaint = sentence;
    return 0;
  }

  char next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool takes(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }

  double nested() {
    if (++depth_ > kDeepestExpression) return complain("an expression is nested too deeply");
    const double value = one();
    --depth_;
    return value;
  }

  double product() {
    double left = nested();
    while (complaint.empty()) {
      const bool rest = word("MOD");
      const char c = rest ? '%' : next();
      if (c != '*' && c != '/' && c != '%') break;
      if (!rest) ++at_;
      if (c == '*' && next() == '*') return complain("powers are not computed");
      const double right = nested();
      if (c == '*') {
        left *= right;
        continue;
      }
      if (right == 0) return complain("a division by 0");
      if (rest && std::min(left, right) < 0) return complain("MOD of numbers below 0");
      left = rest ? std::fmod(left, right) : left / right;
    }
    return left;
  }

  double in_brackets() {
    ++depth_;  // and what they hold is nested in its turn
    if (!takes('[')) return complain("an expression without brackets");
    const double value = sum();
    if (!takes(']')) return complain("an expression that is not understood");
    --depth_;
    return value;
  }

  double variable() {
    ++at_;
    if (++depth_ > kDeepestExpression) return complain("an expression is nested too deeply");
    const std::string key = name();
    --depth_;
    const auto found = variables_.find(key);
    if (found != variables_.end()) return found->second;
    return complain(fmt::format("variable #{} is read and was not set", key));
  }

  bool word(std::string_view wanted) {
    static_cast<void>(next());
    if (text_.size() - at_ < wanted.size()) return false;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      if (std::toupper(static_cast<unsigned char>(text_[at_ + k])) != wanted[k]) return false;
    at_ += wanted.size();
    return true;
  }

  double function() {
    for (const std::string_view each :
         {"SIN", "COS", "TAN", "ATAN", "ASIN", "ACOS", "SQRT", "ABS", "FIX", "FUP"})
      if (word(each)) return value_of(each, in_brackets());
    return complain("an expression that is not understood");
  }

  double value_of(std::string_view function, double x) {
    if (function == "SIN" || function == "COS" || function == "TAN") {
      if (!(std::abs(x) <= 36'000)) return complain("an angle beyond 100 turns");
      const double angle = std::remainder(x, 360) * kPi / 180;
      if (function == "SIN") return std::sin(angle);
      if (function == "COS") return std::cos(angle);
      return std::abs(std::cos(angle)) > 1e-9 ? std::tan(angle) : complain("TAN of a right angle");
    }
    if (function == "ABS") return std::abs(x);
    if (!(x >= 0)) return complain(fmt::format("{} of a number below 0", function));
    if (function == "SQRT") return std::sqrt(x);
    if (function == "FIX") return std::floor(x);
    if (function == "FUP") return std::ceil(x);
    if (function == "ATAN") {
      if (!takes('/')) return complain("ATAN without a second number");
      const double by = in_brackets();
      return x == 0 && by == 0 ? complain("ATAN of nothing") : std::atan2(x, by) * 180 / kPi;
    }
    if (!(x <= 1)) return complain(fmt::format("{} of a number above 1", function));
    return (function == "ASIN" ? std::asin(x) : std::acos(x)) * 180 / kPi;
  }

  std::string_view text_;
  std::size_t at_;
  const NcVariables& variables_;
  bool globals_only_;
  int depth_ = 0;
};

std::optional<double> bounded(double value, std::string& complaint) {
  if (complaint.empty() && !(std::abs(value) <= kLargest)) complaint = "an expression is beyond 1000000";
  if (!complaint.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> computed(std::string_view text, std::size_t& at, const NcVariables& variables,
                               bool globals_only, std::string& complaint) {
  Reader reader(text, at, variables, globals_only);
  const double value = reader.one();
  at = reader.at();
  complaint = reader.complaint;
  return bounded(value, complaint);
}

bool assign(std::string_view text, NcVariables& variables, bool globals_only, std::string& complaint) {
  Reader reader(text, text.find('#') + 1, variables, globals_only);
  const std::string key = reader.name();
  if (key.starts_with('<') && words::is_state_name(std::string_view(key).substr(1, key.size() - 2))) {
    complaint = "the control alone sets " + key;
    return false;
  }
  const double value = reader.assigned();
  complaint = reader.complaint;
  if (const auto kept = bounded(value, complaint)) variables[key] = *kept;
  return complaint.empty();
}

}  // namespace lekalo::verify
