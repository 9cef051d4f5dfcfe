#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::draw {

/// A rectangle of paper, mm, y down.
struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] geom::Point centre() const { return {x + width / 2, y + height / 2}; }
  [[nodiscard]] double right() const { return x + width; }
  [[nodiscard]] double bottom() const { return y + height; }
  [[nodiscard]] Rect grown(double by) const { return {x - by, y - by, width + 2 * by, height + 2 * by}; }
  [[nodiscard]] geom::Ring ring() const { return {{x, y}, {right(), y}, {right(), bottom()}, {x, bottom()}}; }
  [[nodiscard]] bool contains(const Rect& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
  [[nodiscard]] bool overlaps(const Rect& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
};

/// From the blank's millimetres to paper. The centre goes first, so that shapes far from the origin keep
/// their digits.
struct View {
  geom::Point centre;  ///< blank frame
  geom::Point at;      ///< where the centre lies on the paper
  double scale = 1;    ///< millimetres of paper for one of the blank

  [[nodiscard]] geom::Point operator()(geom::Point p) const {
    const geom::Point from_centre = p - centre;
    return {at.x + scale * from_centre.x, at.y - scale * from_centre.y};
  }
};

/// The view that shows the box in the middle of the rectangle, as large as it goes.
[[nodiscard]] View fitted(const geom::Box& box, const Rect& paper);

/// The ring on paper, without points closer than 0.04 mm to the one before, and cut off well outside
/// `visible`: painters lose their precision on numbers far outside the page.
[[nodiscard]] geom::Ring on_paper(const geom::Ring& ring, const View& view, const Rect& visible);

/// The part of segment ab within the rectangle.
struct Segment {
  geom::Point a, b;
};
[[nodiscard]] std::optional<Segment> clipped(const Segment& segment, const Rect& rect);

}  // namespace lekalo::draw
