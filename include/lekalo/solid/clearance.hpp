#pragma once

#include <array>
#include <cstdint>
#include <limits>
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
  /// Points that lie beside each other.
  struct Group {
    std::array<float, 3> centre{};  ///< as from_middle
    float radius = 0;               ///< mm, around all of them
    /// No point of it was nearer than this when it was looked at, at the pose with this number.
    float low = -std::numeric_limits<float>::infinity();
    std::uint32_t seen = 0;
    double bound = 0;  ///< the same at the pose that is asked for
  };
  /// How points, as seen from their middle, have moved since a pose: by `shift` and `turn` times the place.
  struct Step {
    Vector shift;
    std::array<Vector, 3> turn;
    double most = 0;  ///< the turn makes no way longer than by this factor
    double off = 0;   ///< mm, what rounding may have added
  };
  std::uint32_t remembered(const Motion& motion);
  void find_steps(const Motion& motion);

  const TriangleTree* tree_;
  PointCloud cloud_;
  DistanceField field_;
  unsigned threads_;
  std::vector<float> bounds_;
  std::vector<Group> groups_;
  std::vector<Motion> poses_;
  std::vector<Step> steps_;
  std::size_t last_ = 0;  ///< the nearest point of the pose before
};

}  // namespace lekalo::solid
