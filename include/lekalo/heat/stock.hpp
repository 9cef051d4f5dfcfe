#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lekalo::heat {

/// A block as it is said in words: its sides along X, Y and Z, mm, and where its lower left corner lies.
struct StockWords {
  double width = 0, depth = 0, thickness = 0;
  std::optional<std::array<double, 2>> corner;  ///< else the pocket lies in its middle
};

/// Reads `120x100x20` or `120x100x20@X,Y`; nothing for other words, and for sides that are not above 0 or
/// beyond 1e5 mm.
[[nodiscard]] std::optional<StockWords> read_stock(std::string_view words);

/// A block with its upper face at Z 0.
struct StockBox {
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0, thickness = 0;  ///< mm

  /// Distance from the border of its upper face, mm, positive inside.
  [[nodiscard]] double inside(double x, double y) const noexcept;
};

/// \param middle  of the pocket
[[nodiscard]] StockBox stock_box(const StockWords& words, std::array<double, 2> middle) noexcept;

}  // namespace lekalo::heat
