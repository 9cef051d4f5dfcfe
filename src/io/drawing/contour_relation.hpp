#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/region_index.hpp"

namespace lekalo::io {

/// How two contours that cross or touch lie to each other, when what is within `repair` of a contour counts
/// as on it.
enum class Relation {
  beside,      ///< neither holds anything of the other
  first_in,    ///< the second holds the first
  second_in,   ///< the first holds the second
  same,        ///< each runs along the other
  crossing,    ///< they overlap by more than `repair`
  neighbours,  ///< they cross, but two shapes that were drawn too near to each other do so too
};

/// A contour, counter-clockwise, as it is asked about others.
class PlacedContour {
 public:
  /// \pre accepted by make_region
  explicit PlacedContour(const geom::Contour& contour);

  [[nodiscard]] bool contains(geom::Point p) const { return index_.contains(p); }
  [[nodiscard]] const geom::Box& box() const noexcept { return box_; }
  [[nodiscard]] double area() const noexcept { return area_; }
  [[nodiscard]] geom::Point start() const noexcept { return contour_.front().from; }

  friend Relation relation_of(const PlacedContour& a, const PlacedContour& b, double repair,
                              std::size_t& work);
  friend double shared_part(const PlacedContour& a, const PlacedContour& b);

 private:
  /// Says whether the contour goes more than `reach` outside of another, and more than that inside of it.
  struct Sides {
    bool outside = false, inside = false;
  };
  [[nodiscard]] Sides sides_of(const PlacedContour& other, double reach, std::size_t& work) const;

  geom::Contour contour_;
  geom::RegionIndex index_;
  geom::Box box_;
  double area_;
};

/// Cost: O((length of what runs along each other / repair) log n).
/// Never `neighbours`, which the rest of the drawing decides too. Takes a unit of `work` for each step; where
/// none is left, contours count as crossing.
[[nodiscard]] Relation relation_of(const PlacedContour& a, const PlacedContour& b, double repair,
                                   std::size_t& work);

/// Returns how much of the smaller of two contours lies in the other, 0 to 1; 1 where that cannot be told.
/// Cost: that of geom::combine.
[[nodiscard]] double shared_part(const PlacedContour& a, const PlacedContour& b);

}  // namespace lekalo::io
