#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lekalo/solid/distance_field.hpp"
#include "lekalo/solid/motion.hpp"

namespace lekalo::solid {

/// Measured points, sorted so that neighbours are near each other in memory.
class PointCloud {
 public:
  /// \pre from 1 to 2^32 - 1 points, finite
  explicit PointCloud(const std::vector<Vector>& points);
  [[nodiscard]] std::span<const Vector> points() const noexcept { return points_; }
  /// The number among the points given at first.
  [[nodiscard]] std::uint32_t number(std::size_t k) const noexcept { return numbers_[k]; }
  /// The middle of their box, and each as seen from there in single precision.
  [[nodiscard]] Vector middle() const noexcept { return middle_; }
  [[nodiscard]] std::span<const std::array<float, 3>> from_middle() const noexcept { return from_middle_; }
  /// No point is farther from the middle, mm.
  [[nodiscard]] double extent() const noexcept { return extent_; }

 private:
  std::vector<Vector> points_;
  std::vector<std::uint32_t> numbers_;
  Vector middle_;
  std::vector<std::array<float, 3>> from_middle_;
  double extent_ = 0;
};

/// The point that is nearest to the body or deepest in it.
struct Clearance {
  double low = 0, high = 0;  ///< bounds of its signed distance, mm: positive where all points are outside
  std::uint32_t point = 0;   ///< as numbered at first
  std::uint32_t triangle = 0;
  Vector place;  ///< of the body
};

/// Measures points against a body at one pose after another. It holds the bounds that the poses so far asked
/// for, so the second pose near the first takes a small part of the first one's time
/// (bench/clearance.cpp).
///
/// The answer depends on mesh, points and motion alone, within the rounding of its bounds: not on threads,
/// nor on what was asked before. Of several points at the same distance within rounding any may be named.
class ClearanceMeter {
 public:
  /// \param tree  of a closed mesh; outlives the meter
  /// \param cell  of the field of bounds, mm: the finer, the fewer points are measured exactly
  ClearanceMeter(const TriangleTree& tree, const std::vector<Vector>& points, double cell, unsigned threads);

  /// \param motion  takes the points into the frame of the body
  [[nodiscard]] Clearance at(const Motion& motion);

 private:
  class Pass;

  const TriangleTree* tree_;
  PointCloud cloud_;
  DistanceField field_;
  unsigned threads_;
  std::vector<float> bounds_;
};

}  // namespace lekalo::solid
