#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::locate {

/// The guaranteed blank: the part of the plane that a measurement proves to be material. What exactly is
/// proved from which assumption, with the proofs: docs/design/scan.md.
///
/// Measured point p_i stands for a true surface point within g = coverage_factor * uncertainty +
/// reading_error of p_i. Outlines join neighbouring points; each edge i of theirs has a reach w_i >= g, and
///   every q inside the outlines (an odd number of them around it) whose distance from each edge i is above
///   w_i, is material,
/// where, with c the length of the edge,
///   w_i = g                                      the contour is straight between neighbours (assumed for
///                                                edges up to the step, when nothing better is stated)
///   w_i = g + H                                  it dips at most H below the chord of the true points
///   w_i = R - sqrt((R - g)^2 - (c / 2)^2)        the blank's reach is at least R: a disc of radius R rolls
///                                                along all of its contour from outside; c < 2 (R - g)
/// The regions returned are a subset of these q, at least g away from every measured point.

enum class PointOrder {
  automatic,  ///< given, if the outlines through the points in that order do not meet themselves, else none
  given,      ///< the points stand in order along each contour
  none        ///< any order; contours are found
};

struct ScanPoints {
  geom::Ring points;  ///< mm
  /// The first point of each contour; only for points in order.
  std::vector<std::uint32_t> contour_starts = {0};
};

struct ScanOptions {
  double uncertainty = 0;      ///< standard uncertainty of one point, mm, >= 0
  double coverage_factor = 2;  ///< k, > 0
  /// True when k was chosen for all points together, not for each by itself.
  bool factor_covers_all = false;
  /// A distance that is added to the guard as it is, mm.
  double reading_error = 0;
  std::optional<double> min_radius;  ///< R, mm
  std::optional<double> max_dip;     ///< H, mm, >= 0
  /// Points further apart than this are not taken as neighbours, and the stretch between them is unknown
  /// unless R or H bounds it, mm. The default is 3 times the median spacing (for points without order at
  /// least 8 guards).
  std::optional<double> step;
  /// Points with no other point within this many mm are left out and listed. Without a value nothing is left
  /// out.
  std::optional<double> drop_outliers;
  /// The edges of the result may lie this much further in than they must, mm, > 0.
  double simplify = 0.02;
  PointOrder order = PointOrder::automatic;
};

/// A stretch of contour about which the measurement says nothing.
struct UnknownStretch {
  std::uint32_t contour = 0;       ///< index into GuaranteedBlank::outlines
  std::uint32_t from = 0, to = 0;  ///< indices of measured points
  geom::Point from_at, to_at;
  double width = 0;  ///< mm
};

struct GuaranteedBlank {
  /// Regions of lines. They lie inside the true blank if the assumptions hold and `unknown` is empty. Across
  /// an unknown stretch the outline goes straight. Nothing is proved there, and no "yes" may rest on these
  /// regions.
  std::vector<geom::Region> regions;
  double guard = 0;           ///< g, mm
  double step = 0;            ///< mm, as given or chosen
  double median_spacing = 0;  ///< mm
  /// The longest edge of the outlines that is not unknown, mm.
  double widest = 0;
  /// The largest w_i - g, mm.
  double deepest = 0;
  /// The regions' boundary comes within this of every corner of the outlines, mm.
  double loss = 0;
  /// True when the given order was used.
  bool ordered = false;
  /// Indices of measured points, with material on the left.
  std::vector<std::vector<std::uint32_t>> outlines;
  std::vector<UnknownStretch> unknown;
  /// Indices of measured points that were left out, ascending.
  std::vector<std::uint32_t> dropped;
  /// Sentences. What is true of `regions` is true if all of these are.
  std::vector<std::string> assumptions;
  std::vector<std::string> notices;
  [[nodiscard]] bool proved() const noexcept { return unknown.empty(); }
};

/// Makes the guaranteed blank. Fails with ErrorCode::usage for options out of range; with bad_input, naming a
/// place in mm, for points that are not is_exact or beyond 1e9 mm, fewer than three, outlines that meet
/// themselves or each other, points without order whose neighbours cannot be told (walls, corners or noise
/// finer than the spacing), and when nothing is left.
///
/// The regions do not depend on the order of points without order.
/// Cost: O(n log n). 100,000 points in 0.1 s.
[[nodiscard]] Result<GuaranteedBlank> guaranteed_blank(const ScanPoints& scan, const ScanOptions& options);

}  // namespace lekalo::locate
