#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "convex_pieces.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::nest {

/// An outline as the search sees it: its loops, and convex pieces that cover it. Outer loops run
/// counter-clockwise, those of holes clockwise.
struct SearchOutline {
  std::vector<std::vector<geom::Point>> loops;
  std::vector<ConvexPiece> pieces;
};
/// A rectangle along the axes, mm.
struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  /// This box moved by (x, y), and larger by a margin on every side.
  Box at(double x, double y, double margin = 0) const noexcept {
    return {x + x0 - margin, y + y0 - margin, x + x1 + margin, y + y1 + margin};
  }
  bool meets(const Box& other) const noexcept {
    return x0 < other.x1 && x1 > other.x0 && y0 < other.y1 && y1 > other.y0;
  }
};
/// The outline turned about the origin by an angle of this cosine and sine.
[[nodiscard]] SearchOutline turned(const SearchOutline& outline, double c, double s);

/// A table that says how deep an outline b, moved by t, lies in an outline a. The shifts at which they
/// overlap, or come nearer than a gap, form a region; the depth is the distance of t from the region's
/// border. It is exact to the rounding of doubles near the border and interpolated from a raster further
/// in. docs/design/nest.md, step 1.
///
/// Cost of making one: O(contacts x pairs of convex pieces), then O(border edges) for each cell near them.
/// There is no limit on the edges of a border: beyond kMostNarrow of them the table takes twice the memory.
class NoFit {
 public:
  using IsFree = std::function<bool(geom::Point)>;
  /// Edges of a border up to which cells list them by two bytes each.
  static constexpr std::size_t kMostNarrow = 65'535;
  /// \param cells    about how many cells the raster has
  /// \param is_free  decides whether a shift at which edges fit exactly is free; without it such a shift is
  /// not \param window   nobody asks about places where b reaches out of this; empty: b may be anywhere
  /// \param with_areas  makes common_area() answer
  /// \param most_narrow  for tests: at most kMostNarrow
  NoFit(const SearchOutline& a, const SearchOutline& b, double gap, std::size_t cells,
        const IsFree& is_free = {}, const Box& window = {}, bool with_areas = false,
        std::size_t most_narrow = kMostNarrow);

  /// The depth at a shift, mm; 0 where the two do not overlap.
  [[nodiscard]] double depth(double x, double y) const noexcept {
    const double fx = (x - x0_) * per_mm_, fy = (y - y0_) * per_mm_;
    if (!(fx >= 0 && fy >= 0 && fx < width_ && fy < height_)) return 0;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    const std::uint32_t cell = cells_[iy * columns_ + ix];
    if (cell == kClear) return 0;
    if (cell != kDeep) return depth_near(cell, x, y);
    return between(&nodes_[iy * (columns_ + 1) + ix], columns_ + 1, fx, fy);
  }
  /// The area that both have in common, interpolated from a coarser raster, mm^2; 0 for tables without
  /// areas.
  double common_area(double x, double y) const noexcept {
    const double fx = (x - x0_) * area_per_mm_, fy = (y - y0_) * area_per_mm_;
    if (!(fx >= 0 && fy >= 0 && fx < area_width_ && fy < area_height_)) return 0;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    return between(&areas_[iy * (area_columns_ + 1) + ix], area_columns_ + 1, fx, fy);
  }
  /// The depth and the direction, unit, in which b gets free.
  struct Way {
    double depth = 0;
    geom::Point direction;
  };
  [[nodiscard]] Way way_out(double x, double y) const noexcept;

  /// An edge of the border. Shifts on its left are forbidden.
  struct Segment {
    geom::Point from, direction;
    double length = 0;
    bool two_sided = false;  ///< its right is forbidden too: b fits a slot of a exactly
  };
  [[nodiscard]] const std::vector<Segment>& border() const noexcept { return segments_; }

 private:
  static constexpr std::uint32_t kClear = 0, kDeep = 1;
  /// Signed distance, positive within, and the nearest point of the border.
  struct Signed {
    double distance = 0;
    geom::Point nearest;
  };
  /// Interpolates between four nodes of a raster with rows of this length, at (fx, fy) cells.
  static double between(const float* node, std::uint32_t row, double fx, double fy) noexcept {
    const float u = static_cast<float>(fx) - static_cast<float>(static_cast<std::uint32_t>(fx)),
                v = static_cast<float>(fy) - static_cast<float>(static_cast<std::uint32_t>(fy));
    const float low = node[0] + u * (node[1] - node[0]);
    const float high = node[row] + u * (node[row + 1] - node[row]);
    return static_cast<double>(low + v * (high - low));
  }
  template <class Index>
  [[nodiscard]] Signed signed_distance(const Index* begin, const Index* end, double x,
                                       double y) const noexcept;
  template <class Index>
  [[nodiscard]] Way way_near(const Index* begin, const Index* end, geom::Point p) const noexcept;
  [[nodiscard]] double depth_near(std::uint32_t cell, double x, double y) const noexcept;
  /// Visits the list of edges of a cell near the border.
  template <class Visit>
  auto near_border(std::uint32_t cell, Visit visit) const noexcept;
  template <class Index>
  void fill_all(std::vector<Index>& lists);
  template <class Index>
  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t size, const std::vector<Index>& candidates,
            std::vector<Index>& lists);

  double x0_ = 0, y0_ = 0, per_mm_ = 0, width_ = 0, height_ = 0, gap_ = 0, tie_ = 0;
  std::uint32_t columns_ = 0, rows_ = 0;
  double area_per_mm_ = 0, area_width_ = 0, area_height_ = 0;
  std::uint32_t area_columns_ = 0;
  std::vector<float> areas_;
  std::vector<std::uint32_t> cells_;
  std::vector<float> nodes_;
  /// By cell near the border: a count, then the edges that can be nearest. One of the two is empty.
  std::vector<std::uint16_t> lists_;
  std::vector<std::uint32_t> wide_lists_;
  std::vector<Segment> segments_;
};

}  // namespace lekalo::nest
