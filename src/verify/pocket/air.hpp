#pragma once

#include <vector>

#include "stroke.hpp"

namespace lekalo::verify {

/// The strips straight out of a pocket's open edges, some way out, in which there is no material. Where they
/// overlap the pocket as it is drawn, the drawing holds.
class Air {
 public:
  Air() = default;
  /// \param drawn  the pocket's outline, material of the part on the right; arcs of at most a quarter turn
  /// \param open  of each stroke: whether it is an open edge
  Air(const std::vector<Stroke>& drawn, const std::vector<char>& open, double width);

  [[nodiscard]] bool empty() const { return strips_.empty(); }
  [[nodiscard]] bool holds(Place p) const { return in_strips(p) && !in_drawing(p); }
  [[nodiscard]] bool in_strips(Place p) const;
  [[nodiscard]] bool in_drawing(Place p) const;
  /// Distance from the sides of the strips; infinity where there are none.
  [[nodiscard]] double from_borders(Place p) const;
  /// All there is a border between air and something else at within `reach` of p, and some more.
  [[nodiscard]] std::vector<Stroke> borders_near(Place p, double reach) const;
  /// The sides of the strips that are no open edges; the strip on their left.
  [[nodiscard]] const std::vector<Stroke>& sides() const { return sides_; }

 private:
  struct Strip {
    Stroke edge;
    double near = 0, far = 0;     ///< of an arc: the distances from its centre
    std::vector<Stroke> borders;  ///< of it and of the drawing in its box
    [[nodiscard]] bool holds(Place p, double width) const;
    Place low, high;
  };

  double width_ = 0;
  std::vector<Stroke> drawn_;
  std::vector<Strip> strips_;
  std::vector<Stroke> sides_, borders_;
};

}  // namespace lekalo::verify
