#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Certified global localisation of a part of any shape in a blank of any shape, both regions of lines and
/// arcs with holes, in several pieces if need be:
///   maximise the least signed distance of the placed part's material from the blank's boundary
/// by branch and bound over boxes of poses. Small boxes are bounded by linear programs over pairs of balls,
/// one in the part's material, one outside the blank's: their distance bounds the clearance of every pose.
/// docs/design/locate-region.md has the bound, its error analysis and what failed.

enum class Mirror { no, yes, either };  ///< mirrored parts are mirrored in x before they are turned

/// No point of these edges may lie more than `most` mm inside the blank. They bound material that a cut
/// cannot take, or a feature that is finished. They need not be edges of the part.
struct Cap {
  std::vector<geom::Edge> edges;  ///< part coordinates
  double most = 0;
};

/// The shift of the placement where one is given: x, y of p -> R(theta) p + (x, y), mm. (The angle is locked
/// by a window of one angle.)
struct LockedShift {
  std::optional<double> x, y;
};

struct RegionProblem {
  std::vector<geom::Region> part, blank;
  AngleWindow window;
  Mirror mirror = Mirror::no;
  /// The true outlines may be off the regions by this, mm. The tolerances are taken off the clearance and
  /// added to the bound.
  double part_tolerance = 0, blank_tolerance = 0;
  LockedShift locked = {};
  /// With caps the search maximises the least of the clearance and what each cap has left (`most` less the
  /// greatest depth of its edges). That number stands for the clearance everywhere here.
  std::vector<Cap> caps = {};
  /// Part and blank were read from one file in one way, so that equal regions stand for equal outlines.
  bool one_file = false;
};

struct RegionOptions {
  /// The search stops when upper bound - clearance is this small, mm, > 0.
  double gap = 1e-3;
  /// The status is infeasible when this is provably not reachable, mm.
  double min_allowance = 0;
  bool keep_certificate = true;
  /// The search ends when a placement reaches `enough`, and boxes that prove no more than `not_above` are
  /// closed. Together they decide whether a clearance can be reached, for less work than the largest one
  /// costs.
  double enough = std::numeric_limits<double>::infinity();
  double not_above = -std::numeric_limits<double>::infinity();
  /// One unit of work is one box bounded, one program solved or one pose measured.
  RunControl run;
};

/// A pair of balls: one in the part's material (part coordinates), one in whose inside the blank has none
/// (blank coordinates), radii >= 0 (0: a point of the outline). With a cap: a point of one of its edges, and
/// a ball in the blank's material.
struct BallTerm {
  geom::Point part_centre;
  double part_radius = 0;
  geom::Point blank_centre;
  double blank_radius = 0;
  double multiplier = 0;
  std::optional<std::uint32_t> cap;
};

/// A subdivision of a box of poses in preorder: a split is followed by its low half and its high half. Poses
/// are (theta, q), q the place of the part's point `pivot` in the blank's frame.
struct CoverTree {
  bool mirrored = false;
  double theta_from = 0, theta_to = 0;
  geom::Box box;  ///< of q
  enum class Axis : std::uint8_t { leaf, theta, x, y };
  struct Node {
    Axis axis = Axis::leaf;
    /// The place of the split.
    double at = 0;
    /// The terms of a leaf are terms[first, first + count).
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  std::vector<Node> nodes;
  std::vector<BallTerm> terms;
};

/// A part in a blank of its own outline needs no search. No placement of it has any clearance, because with
/// it grown by that the blank would have to hold more than its own area; and it has 0 where it lies.
enum class OwnOutline : std::uint8_t {
  no,
  regions,  ///< the regions are the same, and their tolerances count
  file      ///< the outlines are the same, whatever the tolerances
};

struct RegionResult {
  Status status = Status::stopped;
  /// The best placement. Its clearance is rounded down, so that an exact recheck never finds less.
  Placement best;
  /// True when a placement was looked at at all.
  bool found = false;
  bool mirrored = false;
  /// No placement in the window has more clearance; rounded up.
  double upper_bound = 0;
  double shortfall = 0;  ///< max(0, min_allowance - clearance)
  std::vector<Touch> contacts;
  /// The pivot of the certificate, part coordinates.
  geom::Point pivot;
  std::vector<CoverTree> certificate;
  /// The other proof, without a certificate.
  OwnOutline own_outline = OwnOutline::no;
  std::uint64_t work = 0;
};

/// Searches the whole window. ErrorCode::usage for a window with from > to, a gap that is not positive or a
/// value that is not finite; bad_input for shapes without edges. Deterministic; single-threaded.
///
/// A part in a blank of its own outline (geom::same_outline) that may lie as it is drawn does so, without a
/// search.
///
/// Cost: a few thousand boxes where the optimum is a sharp peak, each O(log edges) while large and O(edges)
/// when small; grows as the clearance gets flat in some direction (parts of k-fold symmetry, roomy blanks).
[[nodiscard]] Result<RegionResult> locate_regions(const RegionProblem& problem, const RegionOptions& options);

}  // namespace lekalo::locate
