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

/// No point of these edges may lie more than `most` mm inside the blank: material that a cut cannot take, or
/// a feature that is finished. They need not be edges of the part.
struct Cap {
  std::vector<geom::Edge> edges;  ///< part coordinates
  double most = 0;
};

/// Holds the shift of the placement where one is given: x, y of p -> R(theta) p + (x, y), mm. (The angle is
/// locked by a window of one angle.)
struct LockedShift {
  std::optional<double> x, y;
};

struct RegionProblem {
  std::vector<geom::Region> part, blank;
  AngleWindow window;
  Mirror mirror = Mirror::no;
  /// How far the true outlines may be from the regions, mm. Taken off the clearance and added to the bound.
  double part_tolerance = 0, blank_tolerance = 0;
  LockedShift locked = {};
  /// With caps the least of the clearance and what each cap has left (`most` less the greatest depth of its
  /// edges) is maximised, and stands for the clearance everywhere here.
  std::vector<Cap> caps = {};
};

struct RegionOptions {
  double gap = 1e-3;         ///< stop when upper bound - clearance is this small, mm, > 0
  double min_allowance = 0;  ///< mm; when provably not reachable the status is infeasible
  bool keep_certificate = true;
  /// The search ends when a placement reaches `enough`; boxes that prove no more than `not_above` are closed.
  /// Together they decide whether a clearance can be reached, for less than the largest one costs.
  double enough = std::numeric_limits<double>::infinity();
  double not_above = -std::numeric_limits<double>::infinity();
  RunControl run;  ///< one unit of work is one box bounded, one program solved or one pose measured
};

/// One ball in the part's material, one in whose inside the blank has none, radii >= 0 (0: a point of the
/// outline); part coordinates and blank coordinates. With a cap: a point of one of its edges, and a ball in
/// the blank's material.
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
    double at = 0;            ///< where it is split
    std::uint32_t first = 0;  ///< of a leaf: its terms are terms[first, first + count)
    std::uint32_t count = 0;
  };
  std::vector<Node> nodes;
  std::vector<BallTerm> terms;
};

struct RegionResult {
  Status status = Status::stopped;
  Placement best;      ///< clearance rounded down: an exact recheck never finds less
  bool found = false;  ///< whether a placement was looked at at all
  bool mirrored = false;
  double upper_bound = 0;  ///< no placement in the window has more; rounded up
  double shortfall = 0;    ///< max(0, min_allowance - clearance)
  std::vector<Touch> contacts;
  geom::Point pivot;  ///< of the certificate, part coordinates
  std::vector<CoverTree> certificate;
  std::uint64_t work = 0;
};

/// ErrorCode::usage for a window with from > to, a gap that is not positive or a value that is not finite;
/// bad_input for shapes without edges. Deterministic; single-threaded.
///
/// Cost: a few thousand boxes where the optimum is a sharp peak, each O(log edges) while large and O(edges)
/// when small; grows as the clearance gets flat in some direction (parts of k-fold symmetry, roomy blanks).
[[nodiscard]] Result<RegionResult> locate_regions(const RegionProblem& problem, const RegionOptions& options);

}  // namespace lekalo::locate
