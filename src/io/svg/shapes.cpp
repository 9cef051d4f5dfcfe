#include "shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "path.hpp"

namespace lekalo::io::detail {
namespace {

using Shapes = std::vector<BoundedShape>;

class ShapeReader {
 public:
  ShapeReader(const SvgElement& element, const Viewport& viewport) : element_(element), viewport_(viewport) {}

  Read<Shapes> run() {
    Shapes shapes = shapes_of();
    if (!fault_.empty()) return tl::unexpected(fault_);
    return shapes;
  }

 private:
  Shapes shapes_of() {
    if (element_.name == "path") return path();
    if (element_.name == "line") return line();
    if (element_.name == "polyline") return poly(false);
    if (element_.name == "polygon") return poly(true);
    if (element_.name == "rect") return rect();
    return round();
  }

  [[nodiscard]] std::optional<Bounded> length(const char* key, Along along) {
    const std::string* text = element_.attribute(key);
    if (text == nullptr || *text == "auto") return std::nullopt;
    const auto read = read_svg_length(*text, viewport_, along);
    if (!read) {
      fault_ = fmt::format("{}: {}", key, read.error());
      return std::nullopt;
    }
    return *read;
  }
  [[nodiscard]] Bounded length_or_zero(const char* key, Along along) {
    return length(key, along).value_or(Bounded{});
  }
  /// Reads a length that must not be below 0.
  [[nodiscard]] std::optional<Bounded> size(const char* key, Along along) {
    auto read = length(key, along);
    if (read && read->value < 0) {
      fault_ = fmt::format("{} is {}; it must not be below 0", key, read->value);
      return std::nullopt;
    }
    return read;
  }

  Shapes path() {
    const std::string* data = element_.attribute("d");
    if (data == nullptr) return {};
    const auto segments = read_svg_path(*data);
    if (!segments) {
      fault_ = "d: " + segments.error();
      return {};
    }
    Shapes shapes;
    for (const PathSegment& segment : *segments)
      if (auto shape = shape_of(segment)) shapes.push_back(*std::move(shape));
    return shapes;
  }

  Shapes line() {
    const BoundedPoint from = point_of(length_or_zero("x1", Along::x), length_or_zero("y1", Along::y)),
                       to = point_of(length_or_zero("x2", Along::x), length_or_zero("y2", Along::y));
    return joined({from, to}, false);
  }

  Shapes poly(bool closed) {
    const std::string* text = element_.attribute("points");
    if (text == nullptr) return {};
    SvgScanner scanner(*text);
    std::vector<BoundedPoint> points;
    scanner.skip_blanks();
    while (!scanner.at_end()) {
      const auto x = scanner.number();
      scanner.skip_comma();
      const auto y = x ? scanner.number() : x;
      if (!x || !y) {
        fault_ = "points: " + (x ? y : x).error();
        return {};
      }
      points.push_back(point_of(*x, *y));
      scanner.skip_comma();
    }
    return joined(points, closed && points.size() > 2);
  }

  static Shapes joined(const std::vector<BoundedPoint>& points, bool closed) {
    Shapes shapes;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i + 1 == points.size() && !closed) break;
      const BoundedPoint &from = points[i], &to = points[(i + 1) % points.size()];
      if (!(from.at == to.at)) shapes.push_back(line_between(from, to));
    }
    return shapes;
  }

  Shapes rect() {
    const Bounded x = length_or_zero("x", Along::x), y = length_or_zero("y", Along::y);
    const auto width = size("width", Along::x), height = size("height", Along::y);
    auto rx = size("rx", Along::x), ry = size("ry", Along::y);
    if (!width || !height || !(width->value > 0 && height->value > 0)) return {};
    if (!rx) rx = ry;
    if (!ry) ry = rx;
    const Bounded right = plus(x, *width), bottom = plus(y, *height);
    if (!rx || !(rx->value > 0 && ry->value > 0)) {
      return joined({point_of(x, y), point_of(right, y), point_of(right, bottom), point_of(x, bottom)}, true);
    }
    const Bounded half{0.5, 0};
    if (2 * rx->value > width->value) rx = times(half, *width);
    if (2 * ry->value > height->value) ry = times(half, *height);
    return rounded(x, y, right, bottom, *rx, *ry);
  }

  static Shapes rounded(const Bounded& x, const Bounded& y, const Bounded& right, const Bounded& bottom,
                        const Bounded& rx, const Bounded& ry) {
    // The order is the standard's: from the left end of the upper side, in the direction of growing angles.
    const Bounded in_left = plus(x, rx), in_top = plus(y, ry);
    Bounded in_right = minus(right, rx), in_bottom = minus(bottom, ry);
    // Sides of which the corners leave nothing but rounding are left out.
    const auto meet = [](const Bounded& low, Bounded& high) {
      const double apart = std::abs(high.value - low.value);
      if (apart <= high.error + low.error) high = {low.value, high.error + apart};
    };
    meet(in_left, in_right);
    meet(in_top, in_bottom);
    const std::array<BoundedPoint, 8> on{point_of(in_left, y),       point_of(in_right, y),
                                         point_of(right, in_top),    point_of(right, in_bottom),
                                         point_of(in_right, bottom), point_of(in_left, bottom),
                                         point_of(x, in_bottom),     point_of(x, in_top)};
    const std::array<BoundedPoint, 4> centres{point_of(in_right, in_top), point_of(in_right, in_bottom),
                                              point_of(in_left, in_bottom), point_of(in_left, in_top)};
    Shapes shapes;
    for (std::size_t side = 0; side < 4; ++side) {
      const BoundedPoint &from = on[2 * side], &to = on[2 * side + 1], &next = on[(2 * side + 2) % 8];
      if (!(from.at == to.at)) shapes.push_back(line_between(from, to));
      const double error = std::max({to.error, next.error, centres[side].error});
      // The first corner begins straight above its centre, which is at -90 degrees where y is down.
      const double begin = (static_cast<double>(side) - 1) * (kPi / 2);
      const EllipseArc arc{to.at,         next.at, centres[side].at, {rx.value, 0},
                           {0, ry.value}, begin,   begin + kPi / 2};
      if (rx.value == ry.value) {
        shapes.push_back(
            circle_arc({geom::EdgeKind::arc_ccw, to.at, next.at, centres[side].at}, kPi / 2, error));
      } else {
        shapes.push_back(conic(arc, error + std::max(rx.error, ry.error)));
      }
    }
    return shapes;
  }

  /// Reads a circle or an ellipse.
  Shapes round() {
    const bool is_circle = element_.name == "circle";
    const BoundedPoint centre = point_of(length_or_zero("cx", Along::x), length_or_zero("cy", Along::y));
    auto rx = is_circle ? size("r", Along::diagonal) : size("rx", Along::x);
    auto ry = is_circle ? rx : size("ry", Along::y);
    if (!rx) rx = ry;
    if (!ry) ry = rx;
    if (!rx || !(rx->value > 0 && ry->value > 0)) return {};
    if (rx->value == ry->value) return {circle(centre, {rx->value, std::max(rx->error, ry->error)})};
    const geom::Point start = centre.at + geom::Point{rx->value, 0};
    const EllipseArc arc{start, start, centre.at, {rx->value, 0}, {0, ry->value}, 0, 2 * kPi};
    return {conic(arc, centre.error + rx->error + ry->error)};
  }

  const SvgElement& element_;
  const Viewport& viewport_;
  std::string fault_;
};

}  // namespace

bool is_svg_shape(std::string_view element) noexcept {
  for (const char* shape : {"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})
    if (element == shape) return true;
  return false;
}

Read<std::vector<BoundedShape>> read_svg_shape(const SvgElement& element, const Viewport& viewport) {
  return ShapeReader(element, viewport).run();
}

}  // namespace lekalo::io::detail
