#include "expression.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/geom/trig.hpp"
#include "letters.hpp"

namespace lekalo::nc {
namespace {

constexpr double kDegree = kPi / 180;
constexpr int kDeepestExpression = 50;
constexpr double kLargestAngle = 36'000;  // degrees

constexpr std::array<std::string_view, 10> kFunctions{"SIN",  "COS",  "TAN", "ATAN", "ASIN",
                                                      "ACOS", "SQRT", "ABS", "FIX",  "FUP"};

}  // namespace

char ExpressionReader::peek() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  return at_ < text_.size() ? to_upper(text_[at_]) : '\0';
}

bool ExpressionReader::takes(std::string_view word) {
  const char first = peek();
  if (first != word.front() || at_ + word.size() > text_.size()) return false;
  for (std::size_t k = 0; k < word.size(); ++k)
    if (to_upper(text_[at_ + k]) != word[k]) return false;
  at_ += word.size();
  return true;
}

double ExpressionReader::fail(std::string why) {
  if (fault_.empty()) fault_ = std::move(why);
  return 0;
}

double ExpressionReader::value() { return checked(factor()); }
double ExpressionReader::total() { return checked(sum()); }

double ExpressionReader::checked(double result) {
  if (fault_.empty() && !(std::abs(result) <= 1e6))
    return fail("an expression is beyond 1000000, or not a number");
  return result;
}

std::string ExpressionReader::key() {
  const std::string name = any_key();
  const bool global = name.starts_with("<_") || (name.size() == 3 && name.front() != '<');
  if (fault_.empty() && globals_only_ && !global)
    fail(
        fmt::format("variable #{} in a subprogram, where controls differ whether it is the caller's; #100 to "
                    "#999 and #<_name> are",
                    name));
  return name;
}

std::string ExpressionReader::any_key() {
  if (takes("<")) {
    std::string name = "<";
    for (; at_ < text_.size() && text_[at_] != '>'; ++at_)
      if (text_[at_] != ' ' && text_[at_] != '\t') name += to_upper(text_[at_]);
    if (at_ == text_.size()) return fail("the name of a variable is not closed"), std::string();
    ++at_;
    return name;
  }
  const double number = factor();
  if (!fault_.empty()) return {};
  if (!(number >= 1 && number <= 999 && number == std::floor(number)))
    return fail(fmt::format("variable #{:g}: only #1 to #999 and named ones are a program's own", number)),
           "";
  return fmt::format("{:g}", number);
}

double ExpressionReader::factor() {
  if (++depth_ > kDeepestExpression) return fail("an expression is nested too deeply");
  double result = 0;
  const char c = peek();
  if (c == '-' || c == '+') {
    ++at_;
    result = c == '-' ? -factor() : factor();
  } else if (c == '[') {
    result = bracket();
  } else if (c == '#') {
    ++at_;
    const std::string name = key();
    const auto found = variables_.find(name);
    if (fault_.empty() && found == variables_.end())
      fail(fmt::format("variable #{} is read and was not set in this program", name));
    result = fault_.empty() ? found->second : 0;
  } else if (c >= 'A' && c <= 'Z') {
    const auto name = std::ranges::find_if(kFunctions, [&](std::string_view each) { return takes(each); });
    result = name != kFunctions.end()
                 ? function(*name)
                 : fail(
                       "an expression that is not understood; variables, + - * / MOD, SIN, COS, TAN, ATAN, "
                       "ASIN, ACOS, SQRT, ABS, FIX and FUP are");
  } else {
    result = plain();
  }
  --depth_;
  return result;
}

double ExpressionReader::plain() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
  const auto number = double_of_text(text_.substr(begin, at_ - begin));
  return number ? *number : fail("a number is missing in an expression");
}

double ExpressionReader::bracket() {
  if (!takes("[")) return fail("a bracket [ is missing in an expression");
  const double result = sum();
  if (fault_.empty() && !takes("]"))
    return fail("an expression that is not understood: a bracket ] is missing, or a word before it");
  return result;
}

double ExpressionReader::sum() {
  double result = product();
  while (fault_.empty()) {
    if (takes("+"))
      result += product();
    else if (takes("-"))
      result -= product();
    else
      break;
  }
  return result;
}

double ExpressionReader::product() {
  double result = factor();
  while (fault_.empty()) {
    if (peek() == '*' && text_.substr(at_).starts_with("**")) return fail("powers (**) are not computed");
    if (takes("*")) {
      result *= factor();
    } else if (takes("/")) {
      const double by = factor();
      result = by == 0 ? fail("a division by 0") : result / by;
    } else if (takes("MOD")) {
      const double by = factor();
      result = result >= 0 && by > 0 ? std::fmod(result, by)
                                     : fail("MOD of numbers below 0, where controls differ");
    } else {
      break;
    }
  }
  return result;
}

double ExpressionReader::function(std::string_view name) {
  const double x = bracket();
  if (!fault_.empty()) return 0;
  const bool turns = name == "SIN" || name == "COS" || name == "TAN";
  if (turns && !(std::abs(x) <= kLargestAngle)) return fail("an angle beyond 100 turns in an expression");
  const auto [sine, cosine] = geom::sincos(turns ? x * kDegree : 0);
  if (name == "SIN") return sine;
  if (name == "COS") return cosine;
  if (name == "TAN") return std::abs(cosine) > 1e-9 ? sine / cosine : fail("TAN of a right angle");
  if (name == "ATAN") {
    if (!takes("/")) return fail("ATAN wants [a]/[b]");
    const double by = bracket();
    if (!(x >= 0) || (x == 0 && by == 0)) return fail("ATAN below 0 or of nothing, where controls differ");
    return geom::direction_angle(by, x) / kDegree;
  }
  if (name == "ASIN" || name == "ACOS") {
    if (!(x >= 0 && x <= 1)) return fail(fmt::format("{} of a number not from 0 to 1", name));
    const double other = std::sqrt((1 - x) * (1 + x));
    return (name == "ASIN" ? geom::direction_angle(other, x) : geom::direction_angle(x, other)) / kDegree;
  }
  if (name == "SQRT") return x >= 0 ? std::sqrt(x) : fail("SQRT of a number below 0");
  if (name == "ABS") return std::abs(x);
  // LinuxCNC rounds FIX down and FUP up; other controls to and from 0. Numbers from 0 on tell no difference.
  if (!(x >= 0)) return fail(fmt::format("{} of a number below 0, where controls differ", name));
  return name == "FIX" ? std::floor(x) : std::ceil(x);
}

std::string format_value(double value) {
  std::string text = fmt::format("{:.12f}", value);
  while (text.back() == '0') text.pop_back();
  return text == "-0." ? "0." : text;
}

}  // namespace lekalo::nc
