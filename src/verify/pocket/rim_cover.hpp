#pragma once

#include <vector>

#include "air.hpp"
#include "stroke.hpp"

namespace lekalo::verify {

/// Keeps the part of the leading half of the tool's rim that still meets material. Every stroke leaves less
/// of it, and only what is left is looked at, so strokes that cover much should come first.
class RimCover {
 public:
  /// \param at  the middle of the tool
  /// \param radius  the tool's radius, mm
  /// \param came_along  the stroke that ends there; what the tool swept along it is gone
  /// \pre the stroke is of positive length
  void begin(Place at, double radius, const Stroke& came_along);
  /// Says whether something in this disc may be at what is left of the rim.
  [[nodiscard]] bool may_meet(Place middle, double radius) const {
    const Place off = bound_middle_ - middle;
    return dot(off, off) < (bound_radius_ + radius) * (bound_radius_ + radius);
  }
  /// Takes away what a tool of this radius, mm, swept along a stroke. Returns whether that made a difference.
  bool add(const Stroke& stroke, double swept_radius);
  /// Takes away what lies beyond open edges.
  void add_air(const Air& air);
  [[nodiscard]] bool nothing_left() const { return open_.empty(); }
  /// Returns the angle of the rim that still meets material, radians. Rounding: 1e-7 for tools of some mm.
  [[nodiscard]] double open_angle() const { return open_beyond(0); }
  /// Returns the part of open_angle() to the left of the heading.
  [[nodiscard]] double open_left() const { return open_beyond(1); }
  /// Returns how wide the open rim is across the heading, mm: a mm of path removes so many square mm.
  [[nodiscard]] double open_width() const;
  /// A stretch of the rim that still meets material.
  struct OpenArc {
    Place right;       ///< the direction of its right end, from which it runs counter-clockwise
    double angle = 0;  ///< radians
    double width = 0;  ///< mm across the heading
  };
  /// Adds them, from the right of the heading to its left.
  void add_open_arcs(std::vector<OpenArc>& arcs) const;

 private:
  /// Returns the open angle beyond a diamond angle.
  [[nodiscard]] double open_beyond(double low) const;
  void add_circle_cuts(Place centre, double circle_radius);
  void add_line_cuts(Place through, Place direction, double offset);
  void add_cut(Place direction);
  template <class Gone>
  bool cover(Gone&& is_gone);
  void bound();
  [[nodiscard]] Place direction_of(double d) const;

  struct Stretch {
    double begin, end;  ///< diamond angles from the heading's right, 0 to 2
  };
  [[nodiscard]] double width_of(const Stretch& stretch) const;
  void add_angle(const Stretch& stretch, double& sum) const;
  Place at_, heading_;
  double radius_ = 0;
  std::vector<double> cuts_;
  std::vector<Stretch> open_, left_;
  /// The middle of a disc that holds all of what is open.
  Place bound_middle_;
  double bound_radius_ = 0;
};

}  // namespace lekalo::verify
