#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/point.hpp"

namespace lekalo::geom::detail {

/// Points of which no two are closer than a snapping distance. Coordinates may be up to 2^45 times that
/// distance.
class PointTable {
 public:
  PointTable(double snap, std::size_t expected) : snap_(snap) {
    std::size_t size = 16;
    while (size < 2 * expected) size *= 2;
    heads_.assign(size, kNone);
  }

  /// Returns the older of two points in the table if p is within the snapping distance of one, and else
  /// enters p itself.
  std::uint32_t snapped(Point p) {
    const std::int64_t x = cell(p.x), y = cell(p.y);
    std::uint32_t best = kNone;
    double least = snap_;
    for (std::int64_t i = x - 1; i <= x + 1; ++i)
      for (std::int64_t j = y - 1; j <= y + 1; ++j)
        for (std::uint32_t at = heads_[slot(i, j)]; at != kNone; at = next_[at]) {
          const double distance = norm(points_[at] - p);
          if (distance < least || (distance == least && at < best)) least = distance, best = at;
        }
    if (best != kNone) return best;
    if (2 * points_.size() >= heads_.size()) grow();
    points_.push_back(p);
    next_.push_back(kNone);
    link(static_cast<std::uint32_t>(points_.size() - 1));
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  [[nodiscard]] const std::vector<Point>& points() const noexcept { return points_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  [[nodiscard]] std::int64_t cell(double v) const noexcept {
    const double scaled = v / snap_;
    const auto whole = static_cast<std::int64_t>(scaled);
    return static_cast<double>(whole) > scaled ? whole - 1 : whole;
  }
  [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                      (static_cast<std::uint64_t>(y) + 0x7f4a7c159e3779b9u) * 0xc2b2ae3d27d4eb4fu;
    h ^= h >> 29;
    return static_cast<std::size_t>(h * 0xbf58476d1ce4e5b9u >> 20) & (heads_.size() - 1);
  }
  void link(std::uint32_t at) {
    std::uint32_t& head = heads_[slot(cell(points_[at].x), cell(points_[at].y))];
    next_[at] = head;
    head = at;
  }
  void grow() {
    heads_.assign(2 * heads_.size(), kNone);
    for (std::uint32_t at = 0; at < points_.size(); ++at) link(at);
  }

  double snap_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> next_, heads_;
};

}  // namespace lekalo::geom::detail
