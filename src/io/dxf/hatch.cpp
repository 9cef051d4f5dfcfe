#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "entities.hpp"

// Reads of HATCH what it fills: its boundaries are copies of curves, no outlines.

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Point;

/// Programs write copies of curves with the same digits; these are the last ones they may differ by, mm.
constexpr double kSameBox = 1e-6;

void grow(Box& box, Point p) {
  box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
  box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
}

constexpr Box kNothing{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

/// The box of the numbers that a hatch repeats of a curve: ends of lines, poles of splines, circles.
void grow(Box& box, const Shape& shape) {
  if (const auto* spline = std::get_if<Spline>(&shape)) {
    for (const Point& pole : spline->poles) grow(box, pole);
  } else if (const auto* edge = std::get_if<geom::Edge>(&shape)) {
    const bool whole = edge->kind != geom::EdgeKind::line && edge->from == edge->to;
    const double radius = whole ? geom::norm(edge->from - edge->centre) : 0;
    for (const Point p : {whole ? edge->centre : edge->from, whole ? edge->centre : edge->to}) {
      grow(box, p - Point{radius, radius});
      grow(box, p + Point{radius, radius});
    }
  }
}

}  // namespace

Result<void> DxfEntities::read_hatch(DxfBlock& into) {
  bool solid = false, in_boundary = false;
  Box box = kNothing;
  std::vector<Box> paths;
  Point at;
  const auto end_path = [&] {
    if (box.low.x <= box.high.x) paths.push_back(box);
    box = kNothing;
  };
  while (at_.next() && at_.code() != 0) {
    const int code = at_.code();
    if (code == 92 || code == 97 || code == 75) {
      if (in_boundary) end_path();
      in_boundary = code == 92;
    }
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    if (code == 70) solid = at_.value() == "1";
    if (!in_boundary || (code != 10 && code != 20 && code != 11 && code != 21 && code != 40)) continue;
    LEKALO_TRY(const auto value, number(true));
    if (code == 10 || code == 11) at.x = value.value;
    if (code == 20 || code == 21) {
      at.y = value.value;
      grow(box, at);
    }
    // Knots of splines, which have this code too, stand before their poles; a circle's radius behind its
    // centre.
    if (code == 40 && box.low == at && box.high == at) {
      grow(box, at - Point{value.value, value.value});
      grow(box, at + Point{value.value, value.value});
    }
  }
  if (!at_.ok() || is_out_of_sight(into)) return {};
  into.count_unread("HATCH", common_.line);
  if (solid) into.fills.insert(into.fills.end(), paths.begin(), paths.end());
  return {};
}

void DxfEntities::note_fills(const DxfBlock& block) {
  if (block.fills.empty()) return;
  const auto less = [](const Box& a, double low_x) { return a.low.x < low_x; };
  std::vector<Box> fills = block.fills;
  std::sort(fills.begin(), fills.end(), [](const Box& a, const Box& b) { return a.low.x < b.low.x; });
  const auto near = [](double a, double b) { return std::abs(a - b) <= kSameBox; };
  for (std::size_t i = 0, end = 0; i < block.curves.size(); i = end) {
    Box box = kNothing;
    for (end = i; end < block.curves.size() && block.curves[end].entity == block.curves[i].entity; ++end)
      grow(box, block.curves[end].shape);
    for (auto fill = std::lower_bound(fills.begin(), fills.end(), box.low.x - kSameBox, less);
         fill != fills.end() && near(fill->low.x, box.low.x); ++fill)
      if (near(fill->low.y, box.low.y) && near(fill->high.x, box.high.x) && near(fill->high.y, box.high.y))
        entities_[block.curves[i].entity].filled = true;
  }
}

}  // namespace lekalo::io
