#include "scanner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lekalo/base/angle.hpp"

namespace lekalo::io::detail {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// The number of characters of the number that the text begins with, 0 for none.
std::size_t number_length(std::string_view text) {
  std::size_t at = 0, digits = 0;
  const auto digits_here = [&] {
    const std::size_t first = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - first;
  };
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  digits = digits_here();
  if (at < text.size() && text[at] == '.') {
    ++at;
    digits += digits_here();
  }
  if (digits == 0) return 0;
  // "1em" is a number and a unit, so an e alone does not belong to the number.
  const std::size_t end = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits_here() > 0) return at;
  }
  return end;
}

Bounded quotient(double a, double b) { return over({a, 0}, {b, 0}); }

Affine entries(const std::array<Bounded, 6>& n) {
  return {n[0].value,
          n[2].value,
          n[1].value,
          n[3].value,
          {n[4].value, n[5].value},
          std::max({n[0].error, n[1].error, n[2].error, n[3].error}),
          std::max(n[4].error, n[5].error)};
}
const Bounded kOne{1, 0}, kZero{};

/// The sine and cosine of an angle in degrees that has an error itself.
struct Turn {
  Bounded sine, cosine;
};
Turn turn_by(const Bounded& degrees) {
  const Direction direction = direction_of_degrees(degrees.value);
  const double error = (direction.exact ? 0 : kDegreesError) + degrees.error * kDegree;
  return {{direction.unit.y, error}, {direction.unit.x, error}};
}

Affine translation(const Bounded& x, const Bounded& y) { return entries({kOne, kZero, kZero, kOne, x, y}); }

Read<Affine> skewed(const Bounded& degrees, bool along_x) {
  const auto [sine, cosine] = turn_by(degrees);
  if (!(std::abs(cosine.value) > 1e-6)) return tl::unexpected(std::string("it skews by a quarter turn"));
  const Bounded tangent = over(sine, cosine);
  return along_x ? entries({kOne, kZero, tangent, kOne, kZero, kZero})
                 : entries({kOne, tangent, kZero, kOne, kZero, kZero});
}

Read<Affine> transform_of(std::string_view word, const std::vector<Bounded>& n) {
  const auto optional = [&](std::size_t i) { return i < n.size() ? n[i] : kZero; };
  if (word == "matrix" && n.size() == 6) return entries({n[0], n[1], n[2], n[3], n[4], n[5]});
  if (word == "translate" && (n.size() == 1 || n.size() == 2)) return translation(n[0], optional(1));
  if (word == "scale" && (n.size() == 1 || n.size() == 2))
    return entries({n[0], kZero, kZero, n.back(), kZero, kZero});
  if (word == "rotate" && (n.size() == 1 || n.size() == 3)) {
    const auto [sine, cosine] = turn_by(n[0]);
    const Affine turned = entries({cosine, sine, negative(sine), cosine, kZero, kZero});
    if (n.size() == 1) return turned;
    return composed(translation(n[1], n[2]), composed(turned, translation(negative(n[1]), negative(n[2]))));
  }
  if (word == "skewX" && n.size() == 1) return skewed(n[0], true);
  if (word == "skewY" && n.size() == 1) return skewed(n[0], false);
  for (const char* known : {"matrix", "translate", "scale", "rotate", "skewX", "skewY"})
    if (word == known) return tl::unexpected(fmt::format("{} has {} numbers", word, n.size()));
  return tl::unexpected(fmt::format(
      "{} is no transform; known: matrix, translate, scale, rotate, skewX, skewY", excerpt(word)));
}

}  // namespace

void SvgScanner::skip_blanks() noexcept {
  while (!at_end() && is_blank(text_[at_])) ++at_;
}

bool SvgScanner::skip_comma() noexcept {
  skip_blanks();
  if (peek() != ',') return false;
  ++at_;
  skip_blanks();
  return true;
}

bool SvgScanner::number_ahead() const noexcept { return number_length(rest()) > 0; }

Read<Bounded> SvgScanner::number() {
  skip_blanks();
  const std::size_t length = number_length(rest());
  if (length == 0) return tl::unexpected("a number is needed " + here());
  const std::string_view text = text_.substr(at_, length);
  const auto number = read_millimetres(text, LengthUnit::millimetre);
  if (!number) return tl::unexpected(number_sentence(number.error(), text));
  at_ += length;
  return *number;
}

Read<bool> SvgScanner::flag() {
  skip_blanks();
  const char c = peek();
  if (c != '0' && c != '1') return tl::unexpected("a flag, 0 or 1, is needed " + here());
  ++at_;
  return c == '1';
}

std::string_view SvgScanner::word() noexcept {
  const std::size_t first = at_;
  while (!at_end() && is_letter(text_[at_])) ++at_;
  return text_.substr(first, at_ - first);
}

std::string SvgScanner::here() const {
  if (at_end()) return "at the end";
  return fmt::format("at character {}, {}", at_ + 1, excerpt(rest()));
}

Read<SvgLength> split_svg_length(std::string_view text) {
  SvgScanner scanner(text);
  LEKALO_TRY(const auto number, scanner.number());
  std::string_view unit = scanner.rest();
  while (!unit.empty() && is_blank(unit.back())) unit.remove_suffix(1);
  return SvgLength{number, unit};
}

std::optional<Bounded> millimetres_per_unit(std::string_view unit) {
  if (unit == "mm") return kOne;
  if (unit == "cm") return Bounded{10, 0};
  if (unit == "Q" || unit == "q") return Bounded{0.25, 0};
  if (unit == "in") return quotient(254, 10);
  if (unit == "pt") return quotient(254, 720);
  if (unit == "pc") return quotient(254, 60);
  if (unit == "px" || unit.empty()) return quotient(254, 960);
  return std::nullopt;
}

Read<Bounded> read_svg_length(std::string_view text, const Viewport& viewport, Along along) {
  LEKALO_TRY(const auto length, split_svg_length(text));
  const auto& [number, unit] = length;
  if (unit.empty() || unit == "px") return number;
  if (unit == "%") {
    const Bounded part = over(number, {100, 0});
    if (along == Along::x) return times(part, viewport.width);
    if (along == Along::y) return times(part, viewport.height);
    const Bounded square =
        plus(times(viewport.width, viewport.width), times(viewport.height, viewport.height));
    const double diagonal = std::sqrt(square.value / 2);
    return times(part,
                 {diagonal, 4 * kUnitRoundoff * diagonal + (diagonal > 0 ? square.error / diagonal : 0)});
  }
  const auto millimetres = millimetres_per_unit(unit);
  if (!millimetres) {
    return tl::unexpected(
        fmt::format("{}: the unit {} is not known here; known: px, mm, cm, in, pt, pc, Q, %", excerpt(text),
                    excerpt(unit)));
  }
  // A px becomes a user unit by 960 / 254 user units a millimetre, which rounds twice less than
  // millimetres_per_unit("px").
  return over(times(times(number, *millimetres), {960, 0}), {254, 0});
}

Read<Affine> read_svg_transform(std::string_view text) {
  SvgScanner scanner(text);
  Affine all;
  scanner.skip_blanks();
  if (scanner.rest() == "none") return all;
  while (!scanner.at_end()) {
    const std::string_view word = scanner.word();
    scanner.skip_blanks();
    if (word.empty() || scanner.peek() != '(')
      return tl::unexpected("a transform, a word and numbers in parentheses, is needed " + scanner.here());
    scanner.advance(1);
    std::vector<Bounded> numbers;
    for (scanner.skip_blanks(); scanner.peek() != ')'; scanner.skip_comma()) {
      LEKALO_TRY(const auto number, scanner.number());
      if (numbers.size() == 6) return tl::unexpected(fmt::format("{} has more than 6 numbers", word));
      numbers.push_back(number);
    }
    scanner.advance(1);
    LEKALO_TRY(const auto next, transform_of(word, numbers));
    all = composed(all, next);
    if (!(all.size() <= kLargestMillimetres))
      return tl::unexpected(fmt::format("it enlarges more than {:g} times", kLargestMillimetres));
    scanner.skip_comma();
  }
  return all;
}

}  // namespace lekalo::io::detail
