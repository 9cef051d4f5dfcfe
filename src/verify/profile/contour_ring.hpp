#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "verify/drawn/placed_sheet.hpp"
#include "verify/number/span.hpp"
#include "verify/pocket/stroke_index.hpp"

namespace lekalo::verify {

using Strokes = std::vector<Stroke>;

/// A line or arc as pieces that are nearly straight: within `off` mm of their chords.
inline void add_straight(const Stroke& edge, double off, Strokes& pieces) {
  add_pieces(edge, edge.arc ? std::sqrt(8 * edge.radius * off) : kInfinity, pieces);
}

struct StrokeExtent {
  Place low{kInfinity, kInfinity}, high{-low.x, -low.y};
  void add(const Strokes& strokes) {
    for (const Stroke& s : strokes) {
      Place from, to;
      box_of(s, from, to);
      low = {std::min(low.x, from.x), std::min(low.y, from.y)};
      high = {std::max(high.x, to.x), std::max(high.y, to.y)};
    }
  }
  [[nodiscard]] bool holds(Place p, double margin) const {
    return std::max({low.x - p.x, p.x - high.x, low.y - p.y, p.y - high.y}) <= margin;
  }
};

/// The pieces of closed contours, the places near them, and which places they enclose.
class ContourRing {
 public:
  ContourRing(const std::vector<Strokes>& contours, double off) {
    for (const Strokes& contour : contours)
      for (const Stroke& edge : contour) {
        add_pieces(edge, kInfinity, pieces);
        add_straight(edge, off, straight_);
      }
    extent_.add(pieces);
    index_ = StrokeIndex(extent_.low, extent_.high, 1 + length(extent_.high - extent_.low) / 300);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) index_.add(i, pieces[i]);
  }

  [[nodiscard]] bool is_near(Place p, double margin) const { return extent_.holds(p, margin); }
  [[nodiscard]] double distance_of(Place p) const { return index_.nearest(p, pieces); }
  [[nodiscard]] bool encloses(Place p) const {
    if (!is_near(p, 0)) return false;
    bool in = false;
    for (const Stroke& s : straight_)
      if (crosses_ray_to_the_right({false, true, s.from, s.to, {}, 0}, p)) in = !in;
    return in;
  }
  [[nodiscard]] double area() const {
    double twice = 0;
    for (const Stroke& s : straight_) twice += cross(s.from - extent_.low, s.to - extent_.low);
    return 0.5 * twice;
  }
  [[nodiscard]] std::vector<std::uint32_t> near(Place p, double reach) const {
    std::vector<std::uint32_t> numbers;
    index_.near(p, reach, numbers);
    return numbers;
  }

  Strokes pieces;

 private:
  Strokes straight_;
  StrokeExtent extent_;
  StrokeIndex index_;
};

}  // namespace lekalo::verify
