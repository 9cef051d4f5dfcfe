#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/heat_picture.hpp"

namespace lekalo::draw {

/// The colours of errors have this many bands on each side of 0.
inline constexpr int kHeatBands = 32;

/// The colour of an error: blue where the pocket is too small, orange where it is too large.
/// \param share  of the largest error, from -1 to 1; in bands, so that equal colours are equal
[[nodiscard]] Colour heat_error_colour(double share);

/// Columns that follow one another on one contour, and how far along it each of them is, mm.
struct HeatStretch {
  std::vector<const HeatColumn*> columns;
  std::vector<double> along;
  [[nodiscard]] double length() const { return along.back(); }
};

/// The walls of a pocket as strips, whose places have letters.
class UnrolledWalls {
 public:
  /// \param columns  live longer than this; spacing and height of their places are in mm
  UnrolledWalls(const std::vector<HeatColumn>& columns, double spacing, double height, double tool_diameter);

  [[nodiscard]] const std::vector<HeatStretch>& stretches() const { return stretches_; }

  /// Calls draw(stretch, number of the column in it, letter) for the places that have letters.
  template <class F>
  void letters(F draw) const {
    char letter = 'A';
    for (const HeatStretch& stretch : stretches_)
      for (int k = 0; k < kLetters && letter <= 'Z'; ++k, ++letter) {
        const double along = stretch.length() * k / kLetters;
        const auto at = std::ranges::lower_bound(stretch.along, along - 1e-9);
        draw(stretch, static_cast<std::size_t>(at - stretch.along.begin()), std::string(1, letter));
      }
  }

  /// Draws the strips, each place in the colour of its error, heights to the left and letters below.
  void draw(const Rect& room, double largest_um, std::vector<Item>& items) const;

 private:
  static constexpr int kLetters = 4;  // for each contour
  std::vector<HeatStretch> stretches_;
  double spacing_, height_;
  double low_z_ = HUGE_VAL, high_z_ = -HUGE_VAL;
};

/// Draws the bar of colours that errors have, with its numbers below, from the top of `room` down.
void draw_error_scale(const Rect& room, double largest_um, std::vector<Item>& items);

}  // namespace lekalo::draw
