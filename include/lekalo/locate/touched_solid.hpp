#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::locate {

/// The guaranteed blank of a probe: a nominal mesh N, moved to touches. Stated is that for one motion M of a
/// box of motions
///   the surface of the blank and that of M N lie less than `form` from each other, both ways, and what lies
///   inside M N, `form` or farther from its surface, is material;
///   each touch was where it says within `guard`, with the ball on the blank from outside.
/// So each touch keeps M from going too far either way. What all of them leave of the box is enclosed, and
/// the farthest that it takes a triangle of the moved mesh is the triangle's width, with `form`
/// (docs/design/touch-probe.md).

struct TouchStatement {
  double ball = 0;   ///< diameter of the probe's ball, mm, >= 0; 0 for points of the surface itself
  double form = 0;   ///< mm, > 0
  double guard = 0;  ///< mm, >= 0
  /// The box about the motion that fits the touches: the place of their middle by so much along each axis,
  /// mm, and each part of tan(angle / 2) times the axis up to tan(turn / 2), rad, at most an eighth of a
  /// turn.
  double shift = 5, turn = 0.034906585039886593;
  /// Touches that the fit leaves farther off the surface are left out, mm, > 0.
  std::optional<double> drop_outliers;
  /// Every coordinate of mesh and touches may differ from that of its file by up to this, mm.
  double coordinate_error = 0;
  /// Out of the blank, of any length but 0, one for each touch, or none at all. With them it is stated that
  /// the ball met the blank, within `guard`, half of its diameter from its centre against the direction.
  std::vector<solid::Vector> directions = {};
};

/// A touch and a ball of the nominal mesh that has nothing of its surface inside: how far the two stay apart.
struct TouchTerm {
  std::uint32_t touch = 0, ball = 0;
  std::uint32_t multiplier = 0;  ///< of any scale
};
/// The touches leave no motion of the box beyond `at` along the axis: the weighted sum of these terms is not
/// above 0 there, though each of them would be.
struct TouchCut {
  SolidTree::Axis axis = SolidTree::Axis::x;
  bool above = false;  ///< which side is taken off the box
  double at = 0;
  std::uint32_t first = 0, count = 0;  ///< of the terms
};
/// No motion that is left takes a corner of the box around the nominal mesh farther along the axis than `at`,
/// mm, from where `moved` takes it: it would be one term more, with a multiplier.
struct TouchWay {
  std::uint32_t corner = 0;                   ///< bit k says if it is the high one along axis k
  SolidTree::Axis axis = SolidTree::Axis::x;  ///< x, y or z
  bool above = false;                         ///< or the other way
  double at = 0;
  std::uint32_t multiplier = 0;
  std::uint32_t first = 0, count = 0;
};

/// The box of motions that is stated, counted as in SolidTree, what touches cut off it, one after the other,
/// and how far those that are left take the mesh.
struct TouchProof {
  solid::Vector pivot;  ///< coordinates of the nominal mesh
  std::array<double, 4> quaternion{1, 0, 0, 0};
  std::array<double, 6> low{}, high{};
  std::vector<SolidBall> balls;  ///< coordinates of the nominal mesh
  std::vector<TouchCut> cuts;
  SolidPose moved;    ///< the place of the nominal mesh that is taken
  solid::Box around;  ///< the nominal mesh
  std::vector<TouchWay> ways;
  std::vector<TouchTerm> terms;  ///< of the cuts and of the ways

  /// The box that is left.
  [[nodiscard]] std::array<std::array<double, 2>, 6> left() const;
};

struct TouchedSolid {
  /// The nominal mesh at its place.
  solid::Mesh mesh;
  /// One for each triangle, mm, rounded up.
  std::vector<double> widths;
  double widest = 0;  ///< mm
  /// No width is above the exact one by more than this, mm.
  double width_error = 0;
  TouchProof proof;
  std::vector<std::uint32_t> left_out;  ///< touches, by their numbers
  std::vector<std::string> assumptions, notices;
};

/// Fits the mesh to the touches, from where it is, and encloses what they allow. Deterministic. Fails with
/// bad_input where no motion of the box lets all touches be, with the place of the worst, and where there are
/// none or more than 5,000, or where most directions lead into the nominal mesh; with usage for numbers out
/// of range. \param nominal  closed (solid::closed_mesh) \param centres  of the ball at each touch
[[nodiscard]] Result<TouchedSolid> touched_solid(const solid::Mesh& nominal,
                                                 const std::vector<solid::Vector>& centres,
                                                 const TouchStatement& stated);

}  // namespace lekalo::locate
