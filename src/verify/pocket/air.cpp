#include "air.hpp"

#include <algorithm>

#include "stroke_index.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {

bool Air::Strip::holds(Place p, double width) const {
  if (!edge.arc) {
    const Place way = unit(edge.to - edge.from);
    const double along = dot(p - edge.from, way), out = -cross(way, p - edge.from);
    return along >= 0 && along <= length(edge.to - edge.from) && out >= 0 && out <= width;
  }
  const Place off = p - edge.centre;
  const double apart = length(off);
  return faces(edge, off) && apart >= near && apart <= far;
}

Air::Air(const std::vector<Stroke>& drawn, const std::vector<char>& open, double width)
    : width_(width), drawn_(drawn) {
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (open[i] == 0) continue;
    const Stroke& edge = drawn[i];
    Strip strip{edge, 0, 0, {}, {}, {}};
    // The far side of the strip, in the direction of the edge.
    Stroke beyond = edge;
    const auto line = [](Place from, Place to) { return Stroke{false, true, from, to, {}, 0}; };
    if (edge.arc) {
      strip.near = edge.ccw ? edge.radius : std::max(0.0, edge.radius - width);
      strip.far = edge.ccw ? edge.radius + width : edge.radius;
      const double radius = edge.ccw ? strip.far : strip.near;
      beyond.from = edge.centre + (radius / edge.radius) * (edge.from - edge.centre);
      beyond.to = edge.centre + (radius / edge.radius) * (edge.to - edge.centre);
      beyond.radius = radius;
    } else {
      const Place out = (-width) * left_of(unit(edge.to - edge.from));
      beyond.from = edge.from + out, beyond.to = edge.to + out;
    }
    // The sides run counter-clockwise around the strip: out where the edge begins, along the far side, and
    // back in.
    std::vector<Stroke> sides{line(edge.from, beyond.from), line(beyond.to, edge.to)};
    if (length(beyond.to - beyond.from) > 0) sides.push_back(beyond);
    sides_.insert(sides_.end(), sides.begin(), sides.end());
    strip.borders = sides;
    strip.borders.push_back(edge);
    strip.low = {kInfinity, kInfinity}, strip.high = {-kInfinity, -kInfinity};
    for (const Stroke& s : strip.borders) {
      Place low, high;
      box_of(s, low, high);
      strip.low = {std::min(strip.low.x, low.x), std::min(strip.low.y, low.y)};
      strip.high = {std::max(strip.high.x, high.x), std::max(strip.high.y, high.y)};
    }
    borders_.insert(borders_.end(), strip.borders.begin(), strip.borders.end());
    for (const Stroke& s : drawn) {
      Place low, high;
      box_of(s, low, high);
      if (low.x <= strip.high.x && strip.low.x <= high.x && low.y <= strip.high.y && strip.low.y <= high.y)
        strip.borders.push_back(s);
    }
    strips_.push_back(std::move(strip));
  }
}

bool Air::in_strips(Place p) const {
  return std::any_of(strips_.begin(), strips_.end(), [&](const Strip& s) { return s.holds(p, width_); });
}

/// Counts the crossings of a ray to the right; an odd number means inside. Every stroke is monotone in y and
/// half open.
bool Air::in_drawing(Place p) const {
  bool in = false;
  for (const Stroke& s : drawn_)
    if (crosses_ray_to_the_right(s, p)) in = !in;
  return in;
}

double Air::from_borders(Place p) const {
  double least = kInfinity;
  for (const Stroke& s : borders_) least = std::min(least, distance(p, s));
  return least;
}

std::vector<Stroke> Air::borders_near(Place p, double reach) const {
  std::vector<Stroke> found;
  for (const Strip& s : strips_)
    if (p.x + reach >= s.low.x && p.x - reach <= s.high.x && p.y + reach >= s.low.y &&
        p.y - reach <= s.high.y)
      found.insert(found.end(), s.borders.begin(), s.borders.end());
  return found;
}

}  // namespace lekalo::verify
