#pragma once

#include <cstdint>
#include <vector>

#include "scan_order.hpp"

namespace lekalo::locate {

/// Tells exactly whether a point has an odd number of outlines around it. The edges are filed in horizontal
/// strips.
class ParityIndex {
 public:
  static constexpr std::uint32_t kNoLoop = 0xffffffff;
  ParityIndex(const geom::Ring& points, const std::vector<Loop>& loops);
  /// Loop `except` is not counted. For a point on an edge either answer may come.
  [[nodiscard]] bool odd(geom::Point p, std::uint32_t except = kNoLoop) const;

 private:
  struct Segment {
    geom::Point low, high;
    std::uint32_t loop = 0;
  };
  [[nodiscard]] std::size_t strip(double y) const;

  std::vector<Segment> segments_;
  double bottom_ = 0, per_strip_ = 0;
  std::vector<std::uint32_t> starts_, in_strip_;
};

}  // namespace lekalo::locate
