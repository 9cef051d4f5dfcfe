#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "convex_pieces.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::nest {

/// An outline as the search sees it: its loops and convex pieces that cover it. Loops counter-clockwise,
/// those of holes clockwise.
struct Shape {
  std::vector<std::vector<geom::Point>> loops;
  std::vector<ConvexPiece> pieces;
};
struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
[[nodiscard]] Shape turned(const Shape& shape, double c, double s);

/// How deep an outline b, moved by t, lies in an outline a: the shifts at which they overlap (or come nearer
/// than a gap) form a region, and the depth is the distance of t from its border. In doubles: exact to their
/// rounding near the border, interpolated from a raster further in. docs/design/nest.md
class NoFit {
 public:
  using IsFree = std::function<bool(geom::Point)>;
  /// \param cells    about how many cells the raster has
  /// \param is_free  decides whether a shift at which edges fit exactly is free; absent: it is not
  /// \param with_areas  common_area() is wanted
  /// \param window   b is never asked about where it reaches out of it; empty: anywhere
  NoFit(const Shape& a, const Shape& b, double gap, std::size_t cells, const IsFree& is_free = {},
        const Box& window = {}, bool with_areas = false);

  /// mm; 0 where they do not overlap.
  [[nodiscard]] double depth(double x, double y) const noexcept {
    const double fx = (x - x0_) * per_mm_, fy = (y - y0_) * per_mm_;
    if (!(fx >= 0 && fy >= 0 && fx < width_ && fy < height_)) return 0;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    const std::uint32_t cell = cells_[iy * columns_ + ix];
    if (cell == kClear) return 0;
    if (cell != kDeep) return depth_near(cell, x, y);
    const float* node = &nodes_[iy * (columns_ + 1) + ix];
    const float u = static_cast<float>(fx) - static_cast<float>(ix),
                v = static_cast<float>(fy) - static_cast<float>(iy);
    const float low = node[0] + u * (node[1] - node[0]);
    const float high = node[columns_ + 1] + u * (node[columns_ + 2] - node[columns_ + 1]);
    return static_cast<double>(low + v * (high - low));
  }
  /// Material that both have in common, interpolated from a coarser raster, mm^2; 0 without areas.
  double common_area(double x, double y) const noexcept {
    const double fx = (x - x0_) * area_per_mm_, fy = (y - y0_) * area_per_mm_;
    if (!(fx >= 0 && fy >= 0 && fx < area_width_ && fy < area_height_)) return 0;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    const float* node = &areas_[iy * (area_columns_ + 1) + ix];
    const float u = static_cast<float>(fx) - static_cast<float>(ix),
                v = static_cast<float>(fy) - static_cast<float>(iy);
    const float low = node[0] + u * (node[1] - node[0]);
    const float high = node[area_columns_ + 1] + u * (node[area_columns_ + 2] - node[area_columns_ + 1]);
    return static_cast<double>(low + v * (high - low));
  }
  /// The depth and the direction, unit, in which b gets free.
  struct Way {
    double depth = 0;
    geom::Point direction;
  };
  [[nodiscard]] Way way_out(double x, double y) const noexcept;

  struct Segment {
    geom::Point from, direction;  ///< forbidden on the left
    double length = 0;
    bool two_sided = false;  ///< forbidden on both sides: a slot just wide enough
  };
  [[nodiscard]] const std::vector<Segment>& border() const noexcept { return segments_; }

 private:
  static constexpr std::uint32_t kClear = 0, kDeep = 1;
  /// Signed distance, positive within, and the nearest point of the border.
  struct Signed {
    double distance = 0;
    geom::Point nearest;
  };
  [[nodiscard]] Signed signed_distance(const std::uint16_t* begin, const std::uint16_t* end, double x,
                                       double y) const noexcept;
  [[nodiscard]] double depth_near(std::uint32_t cell, double x, double y) const noexcept;
  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t size,
            const std::vector<std::uint16_t>& candidates);

  double x0_ = 0, y0_ = 0, per_mm_ = 0, width_ = 0, height_ = 0, gap_ = 0, tie_ = 0;
  std::uint32_t columns_ = 0, rows_ = 0;
  double area_per_mm_ = 0, area_width_ = 0, area_height_ = 0;
  std::uint32_t area_columns_ = 0;
  std::vector<float> areas_;
  std::vector<std::uint32_t> cells_;
  std::vector<float> nodes_;
  std::vector<std::uint16_t> lists_;  ///< a count, then segments
  std::vector<Segment> segments_;
};

}  // namespace lekalo::nest
