#include "view.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr double kCloser = 0.04;  ///< mm of paper; a quarter of a pixel at 1600 pixels
constexpr double kBeyond = 20;    ///< mm outside the visible rectangle, wider than any line

/// The ring on the side of a line where `inside` (signed) is positive; Sutherland and Hodgman's step. Edges
/// that then run along the line lie outside the visible rectangle.
template <class Signed>
Ring cut(const Ring& ring, Signed inside) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
    const double da = inside(a), db = inside(b);
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) != (db >= 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

}  // namespace

View fitted(const geom::Box& box, const Rect& paper) {
  const Point size = box.high - box.low;
  // Through division by the paper, so that a box without width or height still gives a finite scale.
  const double larger = std::max(size.x / paper.width, size.y / paper.height);
  return {box.low + 0.5 * size, paper.centre(), larger > 0 ? 1 / larger : 1};
}

Ring on_paper(const Ring& ring, const View& view, const Rect& visible) {
  Ring paper;
  for (const Point p : ring) {
    const Point q = view(p);
    if (paper.empty() || !(geom::norm(q - paper.back()) < kCloser)) paper.push_back(q);
  }
  const Rect page = visible.grown(kBeyond);
  const bool all_visible = std::all_of(paper.begin(), paper.end(), [&page](Point p) {
    return p.x >= page.x && p.x <= page.right() && p.y >= page.y && p.y <= page.bottom();
  });
  if (all_visible) return paper;
  paper = cut(paper, [&page](Point p) { return p.x - page.x; });
  paper = cut(paper, [&page](Point p) { return page.right() - p.x; });
  paper = cut(paper, [&page](Point p) { return p.y - page.y; });
  return cut(paper, [&page](Point p) { return page.bottom() - p.y; });
}

std::optional<Segment> clipped(const Segment& segment, const Rect& rect) {
  const Point along = segment.b - segment.a;
  double from = 0, to = 1;
  // Liang and Barsky: `ahead` is how fast the segment leaves a side, `room` how far inside it begins.
  const auto side = [&](double ahead, double room) {
    if (ahead == 0) return room >= 0;
    const double t = room / ahead;
    if (ahead > 0) {
      to = std::min(to, t);
    } else {
      from = std::max(from, t);
    }
    return from <= to;
  };
  if (!side(-along.x, segment.a.x - rect.x) || !side(along.x, rect.right() - segment.a.x) ||
      !side(-along.y, segment.a.y - rect.y) || !side(along.y, rect.bottom() - segment.a.y)) {
    return std::nullopt;
  }
  return Segment{segment.a + from * along, segment.a + to * along};
}

}  // namespace lekalo::draw
