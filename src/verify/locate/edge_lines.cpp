#include "edge_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace lekalo::verify {

Integer largest_coordinate(const Ring& points) {
  Integer largest = 0;
  for (const Point& p : points) {
    for (const Integer& value : {p.x, p.y}) largest = std::max<Integer>(largest, abs(value));
  }
  return largest;
}

EdgeLines::EdgeLines(const Outline& blank, const std::vector<std::size_t>& dropped, Precision precision)
    : blank_(blank),
      precision_(precision),
      dropped_(blank.points.size(), false),
      next_kept_(blank.points.size()),
      under_(blank.points.size()),
      lines_(blank.points.size()),
      hull_lines_(blank.hull.size()) {
  const std::size_t n = blank.points.size();
  for (const std::size_t k : dropped) {
    if (k < n) dropped_[k] = true;
  }
  // Goes around twice, so that the first points find the kept point that lies across the end of the file.
  std::size_t kept = n;
  for (std::size_t i = 2 * n; i-- > 0;) {
    next_kept_[i % n] = kept;
    if (!dropped_[i % n]) kept = i % n;
  }
  for (std::size_t j = 0; j < blank.hull.size(); ++j) {
    const Point side = blank.side(j);
    flat_scale_ = std::max({flat_scale_, bits_of(side.x), bits_of(side.y)});
    const std::size_t to = blank.hull[(j + 1) % blank.hull.size()];
    for (std::size_t i = blank.hull[j]; i != to;) {
      under_[i] = j;
      i = blank.counter_clockwise ? (i + 1) % n : (i + n - 1) % n;
    }
  }
}

const EdgeLine* EdgeLines::find(std::size_t k, std::string& why) {
  if (k >= lines_.size()) {
    why = fmt::format("blank edge {} does not exist, the blank has {} points", k, lines_.size());
  } else if (dropped_[k]) {
    why = fmt::format("blank edge {} begins at a point that the result lists as dropped", k);
  } else if (blank_.points[k] == blank_.points[next_kept_[k]]) {
    why = fmt::format("blank edge {} has no length", k);
  } else {
    if (!lines_[k]) {
      const Point *from = &blank_.points[k], *to = &blank_.points[next_kept_[k]];
      if (!blank_.counter_clockwise) std::swap(from, to);
      lines_[k] = measure(*from, *to, under_[k]);
    }
    return &*lines_[k];
  }
  return nullptr;
}

const EdgeLine& EdgeLines::along_hull(std::size_t j) {
  j %= blank_.hull.size();
  if (!hull_lines_[j]) hull_lines_[j] = measure(blank_.corner(j), blank_.corner(j + 1), j);
  return *hull_lines_[j];
}

EdgeLine EdgeLines::measure(const Point& from, const Point& to, std::size_t near) const {
  EdgeLine line{from, to - from, 0, Interval(precision_), Interval(Integer(1), precision_), Interval(kRough),
                {}};
  const Integer squared = dot(line.direction, line.direction);
  line.length = square_root(Interval(squared, precision_));
  line.short_length = square_root(Interval(squared, kRough));
  line.flat_length = {line.length.low_double(flat_scale_), line.length.high_double(flat_scale_)};
  const std::size_t lowest = lowest_corner(blank_, line.direction, near);
  line.outside = -cross(line.direction, blank_.corner(lowest) - line.start);
  if (line.outside == 0) return line;

  const Point before = blank_.side(lowest + blank_.hull.size() - 1), after = blank_.side(lowest);
  const auto length_of = [this](const Point& side) {
    return square_root(Interval(dot(side, side), precision_));
  };
  const Interval shares = Interval(cross(line.direction, after), precision_) * length_of(before) +
                          Interval(cross(before, line.direction), precision_) * length_of(after);
  line.spread = maximum(line.spread, shares / (Interval(cross(before, after), precision_) * line.length));
  return line;
}

}  // namespace lekalo::verify
