#pragma once

#include <vector>

#include "stroke.hpp"

namespace lekalo::verify {

/// Step 6 of docs/design/simulate.md: strips straight out of a pocket's open edges, some way out, in which
/// there is no material. Where a strip overlaps the pocket as it is drawn, the drawing counts.
class Air {
 public:
  Air() = default;
  /// \param drawn  the pocket's outline, with the part's material on its right; arcs turn by at most a
  /// quarter
  /// \param open  says of each stroke whether it is an open edge
  Air(const std::vector<Stroke>& drawn, const std::vector<char>& open, double width);

  [[nodiscard]] bool empty() const { return strips_.empty(); }
  [[nodiscard]] bool holds(Place p) const { return in_strips(p) && !in_drawing(p); }
  [[nodiscard]] bool in_strips(Place p) const;
  [[nodiscard]] bool in_drawing(Place p) const;
  /// Returns the distance from the sides of the strips, infinity where there are none.
  [[nodiscard]] double from_borders(Place p) const;
  /// Returns all borders between air and something else within `reach` of p, and some more.
  [[nodiscard]] std::vector<Stroke> borders_near(Place p, double reach) const;
  /// Returns the sides of the strips that are no open edges, with the strip on their left.
  [[nodiscard]] const std::vector<Stroke>& sides() const { return sides_; }

 private:
  struct Strip {
    Stroke edge;
    /// The distances of an arc's strip from the arc's centre.
    double near = 0, far = 0;
    /// The borders of the strip, and of the drawing in its box.
    std::vector<Stroke> borders;
    [[nodiscard]] bool holds(Place p, double width) const;
    Place low, high;
  };

  double width_ = 0;
  std::vector<Stroke> drawn_;
  std::vector<Strip> strips_;
  std::vector<Stroke> sides_, borders_;
};

}  // namespace lekalo::verify
