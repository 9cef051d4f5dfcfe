#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/solid/mesh_clearance.hpp"
#include "solid_frame.hpp"

namespace lekalo::locate {

inline constexpr std::uint32_t kNoTriangle = 0xffffffff;

/// A place where part and blank come close, or cross. The normal, of length 1 and in the blank's frame,
/// points from what is not material of the blank into the part's material; the distance, less the width of
/// the blank's triangle, is negative where the part's point lies outside the blank, or the blank's in the
/// part.
struct SolidContact {
  solid::Vector part, blank;  ///< each in its own frame
  solid::Vector normal;
  double distance = 0;
  /// The pair of triangles, or kNoTriangle where they cross.
  std::uint32_t part_triangle = kNoTriangle, blank_triangle = kNoTriangle;
  /// False where the two points are too near to each other to give a normal.
  [[nodiscard]] bool directed() const { return !(normal == solid::Vector{}); }
};

/// The objective at one pose: where the part is inside, a bound from below of the clearance, whatever the
/// coordinates may be off. Elsewhere it is how deep points stick out, which says in which direction to go and
/// no more.
struct MeasuredSolid {
  FramedPose pose;
  double value = 0;
  bool inside = false;
};

/// Measures a part in a blank. Its answers depend on their arguments alone, so threads may share it.
class SolidMeter {
 public:
  SolidMeter(const SolidProblem& problem, const SolidFrame& frame);

  [[nodiscard]] const SolidFrame& frame() const noexcept { return frame_; }
  [[nodiscard]] const solid::MeshClearance& clearance() const noexcept { return clearance_; }
  [[nodiscard]] const solid::Mesh& part() const noexcept { return part_; }
  [[nodiscard]] const solid::Mesh& blank() const noexcept { return blank_; }
  /// A length of part and blank together that rounding follows, mm.
  [[nodiscard]] double far() const noexcept { return far_; }
  /// No point of the surfaces is farther off that of the file, mm.
  [[nodiscard]] double part_error() const noexcept { return part_error_; }
  [[nodiscard]] double blank_error() const noexcept { return blank_error_; }
  /// The widths of the blank's triangles; none of one taken as drawn.
  [[nodiscard]] const std::vector<double>& widths() const noexcept { return widths_; }
  [[nodiscard]] double width(std::uint32_t blank_triangle) const {
    return widths_.empty() ? 0 : widths_[blank_triangle];
  }
  /// No width is smaller, mm, and none is above the true one by more than the error.
  [[nodiscard]] double narrowest() const noexcept { return narrowest_; }
  [[nodiscard]] double width_error() const noexcept { return width_error_; }

  /// Measures at a pose. Where the part is inside and all is `most` apart or more, the value is at least
  /// `most`, and nothing more is known. The contacts are the nearest ones of `count` pieces of the part, less
  /// than `most` apart, and where part and blank cross the deepest points of either in the other.
  [[nodiscard]] MeasuredSolid measure(const FramedPose& pose, double most, std::size_t count,
                                      std::vector<SolidContact>& contacts) const;
  /// The contact of two triangles at a pose.
  [[nodiscard]] SolidContact contact(const solid::Motion& motion, std::uint32_t part_triangle,
                                     std::uint32_t blank_triangle) const;

 private:
  void add_crossings(const solid::Motion& motion, const std::vector<solid::NearPair>& pairs,
                     std::vector<SolidContact>& contacts) const;
  [[nodiscard]] SolidContact contact(const solid::Motion& motion, const solid::NearPair& pair) const;

  SolidFrame frame_;
  const solid::Mesh &part_, &blank_;
  const std::vector<double>& widths_;
  solid::MeshClearance clearance_;
  /// Vertices spread over the surfaces.
  std::vector<solid::Vector> of_part_, of_blank_;
  double far_ = 0, part_error_, blank_error_, width_error_, narrowest_ = 0;
};

}  // namespace lekalo::locate
