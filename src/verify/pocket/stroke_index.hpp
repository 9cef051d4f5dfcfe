#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stroke.hpp"

namespace lekalo::verify {

/// Finds the strokes near a place by squares that are quartered down to the size of a cell, where there are
/// strokes. A stroke stands in the squares of about its own size that its box meets, at most four, so that
/// neither long strokes nor large areas cost more than others. Strokes may be added in between. Those outside
/// of the area stand in the squares at its border, which reach as far as anything.
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
  struct Box {
    Place low, high;
  };
  struct Square {
    /// The quarters: bit 0 of the place says right, bit 1 above. 0 where there is none.
    std::array<std::uint32_t, 4> quarters{};
    std::vector<std::uint32_t> strokes;
  };

  /// Calls visit(quarter, middle of it) for the quarters of a square that a box meets.
  template <class Visit>
  static void each_quarter(Place middle, double side, const Box& box, Visit&& visit);
  void add(std::uint32_t at, Place middle, double side, double least_side, const Box& box,
           std::uint32_t number);
  void collect(std::uint32_t at, Place middle, double side, const Box& box,
               std::vector<std::uint32_t>& numbers) const;
  /// Lowers `least` to the least distance in a square. \param reaches  what belongs to the square
  template <class Distance>
  void lower(std::uint32_t at, Place middle, double side, const Box& reaches, Place p, double widest,
             const Distance& distance_of, double& least) const;

  Place middle_;
  double side_ = 0, cell_ = 1;
  std::vector<Square> squares_;
  std::vector<Box> boxes_;  ///< by number of the stroke
};

/// Gives the corners of a box that holds the stroke.
void box_of(const Stroke& stroke, Place& low, Place& high);

}  // namespace lekalo::verify
