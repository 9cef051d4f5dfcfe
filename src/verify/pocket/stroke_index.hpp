#pragma once

#include <cstdint>
#include <vector>

#include "stroke.hpp"

namespace lekalo::verify {

/// Finds the strokes near a place by square cells that know which strokes' boxes meet them. Strokes may be
/// added in between. There are at most 2^20 cells, however large the area is.
class StrokeIndex {
 public:
  StrokeIndex() = default;
  StrokeIndex(Place low, Place high, double cell);

  void add(std::uint32_t number, const Stroke& stroke);
  /// Gives the numbers of all strokes within `reach` of p, and of some others, ascending, each once.
  void near(Place p, double reach, std::vector<std::uint32_t>& numbers) const;
  /// Returns the distance to the nearest of `strokes`, infinity when there is none.
  [[nodiscard]] double nearest(Place p, const std::vector<Stroke>& strokes) const;
  /// Returns the least of all distances, each lessened by what `wider` says of the stroke. No `wider` is more
  /// than `widest`.
  [[nodiscard]] double nearest(Place p, const std::vector<Stroke>& strokes, const std::vector<double>& wider,
                               double widest) const;

 private:
  struct Cells {
    long low_x, low_y, high_x, high_y;
  };
  [[nodiscard]] Cells cells(Place low, Place high) const;
  template <class Distance>
  [[nodiscard]] double least(Place p, double widest, Distance&& distance_of) const;

  Place low_;
  double cell_ = 1;
  long columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> lists_;
};

/// Gives the corners of a box that holds the stroke.
void box_of(const Stroke& stroke, Place& low, Place& high);

}  // namespace lekalo::verify
