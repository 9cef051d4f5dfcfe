#pragma once

#include <cstdint>
#include <vector>

#include "locate/search/cell_program.hpp"
#include "solid_meter.hpp"

namespace lekalo::locate {

/// A box of poses as its bounds need it.
struct CellView {
  CellView(const SolidMeter& meter, const SolidCell& cell)
      : CellView(cell, meter.far(), meter.frame().reach) {}
  /// \param longest, lever  `far` and `reach` of whatever moves
  CellView(const SolidCell& cell, double longest, double lever);

  FramedPose middle;
  solid::Motion turned;  ///< the rotation of the middle, after that of the start
  solid::Vector slide;   ///< half widths of the shift
  /// A pose of the box is turned from its middle by no more than a rotation whose tan(angle / 2) is this.
  double turn = 0;
  /// No coordinate or length is larger, mm.
  double far = 0;
  /// The half widths of the program's unknowns: the shift and 2 reach times the step of x.
  Steps half{};
  double reach = 0;

  /// The corners of the box of shifts, as seen from its middle.
  std::vector<solid::Vector> corners;
  /// The Bernstein coefficients of x_i and of its square over the box, so many: 1 for what is locked, or 3.
  std::array<std::size_t, 3> count{};
  std::array<std::array<double, 3>, 3> x{}, square{};
  /// The least coefficient of 1 + |x|^2. Where it is not above 0 nothing can be bounded.
  double least_scale = 0;
};

/// A function of poses times D = 1 + |x|^2. With t the place of the pivot as seen from the middle of a box it
/// is
///   D (constant + linear . t + square |t|^2) + sum of W_ij (D R)_ij,
///   W = turned + t lever^T + across x t, each column of `across` for itself,
/// where D R = (1 - |x|^2) + 2 x cross + 2 x x^T is the rotation after the start's. It is quadratic in x, and
/// for a fixed x convex in t, so it is nowhere in the box above the largest of its Bernstein coefficients at
/// the corners of the box of shifts. A term of a contact is so much less a bound of the clearance times
///   D whole + sum of whole_turned_ij (D R)_ij > 0.
struct PoseForm {
  double constant = 0, square = 0;
  solid::Vector linear, lever;
  std::array<solid::Vector, 3> turned{}, across{};
  double whole = 0;
  std::array<solid::Vector, 3> whole_turned{};
  /// No sum on the way to a coefficient is larger than this times a few.
  double size = 0;

  void add(double factor, const PoseForm& other) noexcept;
  /// Makes a term of the allowance one of the margin.
  void take_off(const SolidDemand& demand) noexcept;

  /// The least bound for which the term is nowhere in the box above 0; infinite if there is none, and below
  /// all numbers if it is below 0 whatever the bound.
  [[nodiscard]] double most(const CellView& cell) const;
  /// Says if the function is nowhere in the box below 0.
  [[nodiscard]] bool never_negative(const CellView& cell) const;
  /// The tangent of what the term bounds the clearance by at the middle of the box, lifted to where it is
  /// above the coefficients.
  [[nodiscard]] LinearBound<6> tangent(const CellView& cell) const;
  /// How far a step along each freedom alone, from the middle of the box to its side, may take the term: by
  /// its slope and by its bend. About, mm.
  [[nodiscard]] Steps effects(const CellView& cell) const;
};

/// n . (R p + t) - least, for an n of length 1 or less.
[[nodiscard]] PoseForm height(solid::Vector n, solid::Vector p, double least, const CellView& cell);
/// (R n) . (c - t) - least: the same of the blank's point c as the part sees it.
[[nodiscard]] PoseForm height_seen(solid::Vector n, solid::Vector c, double least, const CellView& cell);
/// (|w|^2 + l^2) / (2 l) - radii for w = R p + t - c and l > 0, which is |w| - radii where |w| = l, and more
/// elsewhere.
[[nodiscard]] PoseForm distance(solid::Vector p, solid::Vector c, double l, double radii,
                                const CellView& cell);
/// ((R d) x g) . (R p + t - q) - least: how a line from p along d passes one from q along g.
[[nodiscard]] PoseForm passing(solid::Vector p, solid::Vector d, solid::Vector q, solid::Vector g,
                               double least, const CellView& cell);

}  // namespace lekalo::locate
