#include "lekalo/heat/stock.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/double_of_text.hpp"

namespace lekalo::heat {
namespace {

constexpr double kLargest = 1e5;  // mm

/// Takes the number up to a mark off the beginning of a text.
std::optional<double> number_before(char mark, std::string_view& text) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::optional<double> number = double_of_text(text.substr(0, at));
  text.remove_prefix(at + 1);
  return number;
}

}  // namespace

std::optional<StockWords> read_stock(std::string_view words) {
  StockWords stock;
  const std::size_t at = words.find('@');
  if (at != std::string_view::npos) {
    std::string_view corner = words.substr(at + 1);
    const std::optional<double> x = number_before(',', corner), y = double_of_text(corner);
    if (!x || !y || !(std::max(std::abs(*x), std::abs(*y)) <= kLargest)) return std::nullopt;
    stock.corner = {*x, *y};
  }
  std::string_view sides = words.substr(0, at);
  const std::optional<double> width = number_before('x', sides), depth = number_before('x', sides),
                              thickness = double_of_text(sides);
  for (const std::optional<double>& side : {width, depth, thickness})
    if (!side || !(*side > 0 && *side <= kLargest)) return std::nullopt;
  stock.width = *width, stock.depth = *depth, stock.thickness = *thickness;
  return stock;
}

double StockBox::inside(double x, double y) const noexcept {
  const double dx = std::min(x - low_x, high_x - x), dy = std::min(y - low_y, high_y - y);
  if (dx < 0 && dy < 0) return -std::hypot(dx, dy);
  return std::min(dx, dy);
}

StockBox stock_box(const StockWords& words, std::array<double, 2> middle) noexcept {
  const std::array<double, 2> low =
      words.corner.value_or(std::array{middle[0] - words.width / 2, middle[1] - words.depth / 2});
  return {low[0], low[1], low[0] + words.width, low[1] + words.depth, words.thickness};
}

}  // namespace lekalo::heat
