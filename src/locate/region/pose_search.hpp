#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "distance_grid.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"
#include "locate/search/cell_program.hpp"
#include "locate/search/sinusoid.hpp"
#include "tangent_balls.hpp"

namespace lekalo::locate {

/// Marks what belongs to no cap. A cap pair is a point of one of a cap's edges (part.radius 0) and a ball in
/// the blank's material, its radius less by LocalCap::most: however the part lies, `most` less the depth of
/// the point is at most the pair's distance.
inline constexpr std::uint32_t kNoCap = 0xffffffff;

/// A cap in the local coordinates of a search.
struct LocalCap {
  std::vector<geom::Curve> edges;
  double most = 0;
};

/// A box of poses, given by middle and half widths: where the part's pivot lies in the blank, and the angle.
struct PoseCell {
  double theta = 0, half_theta = 0;
  geom::Point pivot;
  double half_x = 0, half_y = 0;
};

/// Pairs of balls with multipliers that sum to 1. The weighted sum of their distances bounds the objective.
struct CellProof {
  struct Term {
    BallPair pair;
    double multiplier = 0;
    /// The cap of the problem; `pair` is then a cap pair.
    std::uint32_t cap = kNoCap;
  };
  std::array<Term, 4> term;
  std::size_t terms = 0;
};

/// One node of the subdivision that a search made. Leaves carry the proof of their bound.
struct CoverNode {
  CoverTree::Axis axis = CoverTree::Axis::leaf;
  /// The place where the node is split.
  double at = 0;
  std::uint32_t low = 0, high = 0;  ///< children
  CellProof proof;
};

/// A best-first branch and bound over poses of a part in a blank of any shape (docs/design/locate-region.md).
/// The objective is the least of two things: the clearance, and for every cap `most` less the greatest depth
/// of its edges.
class PoseSearch {
 public:
  struct MeasuredPose {
    double theta = 0;
    geom::Point pivot;  ///< in the blank's frame
    /// The objective as measured, not yet rounded down.
    double value = 0;
    bool inside = false;
  };

  struct Goal {
    /// The bound may lie this far above the best objective at the end.
    double gap = 0;
    /// A value known to be reachable: cells that prove no more need not be divided.
    double at_least = 0;
    /// The search ends when it has found this much.
    double enough = 0;
    /// While this is not reached, cells that prove less are closed sooner.
    double demanded = 0;
  };
  /// \param clearance  part (its points counted from the pivot) and blank, in local coordinates
  /// \param far        largest |coordinate| of the problem in its own frames, which rounding follows
  PoseSearch(const phi::RegionClearance& clearance, const std::vector<LocalCap>& caps, const PoseCell& root,
             double far, const Goal& goal, const RunControl& run);

  void run();

  /// A contact that holds the part at a pose. held_at() gives them by blank edge, then by part edge, with
  /// multipliers that balance.
  struct Held {
    phi::RegionContact contact;
    double multiplier = 0;
    std::uint32_t cap = kNoCap;
  };
  [[nodiscard]] std::vector<Held> held_at(const MeasuredPose& found);

  [[nodiscard]] const MeasuredPose& best() const { return best_; }
  [[nodiscard]] double upper() const { return upper_; }
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] std::uint64_t work() const { return work_; }
  [[nodiscard]] const std::vector<CoverNode>& cover() const { return cover_; }

 private:
  /// If the demand is not met, what is missing need only be known to this part of it.
  static constexpr double kOfWhatIsMissing = 1.0 / 16;
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  struct Node {
    PoseCell cell;
    double upper = 0;
    std::uint32_t cover = 0;
    /// Those of known_ that may matter here.
    std::vector<std::uint32_t> pairs;
  };
  /// A point of the part by which large cells are bounded.
  struct Sample {
    geom::Point at;
    double far = 0;          ///< from the pivot
    std::uint32_t edge = 0;  ///< of the part, or of the cap
    std::uint32_t cap = kNoCap;
  };
  /// A place where the outlines come close, or cross. `distance` is negative where the part's point lies
  /// outside the blank or the blank's point inside the part. The normal points from the blank's outside to
  /// its material, in the blank's frame.
  struct PoseContact {
    geom::Point part, blank, normal;
    double distance = 0;
    /// If there is a cap, the contact is where the cap's edge lies deepest. `distance` is then what the cap
    /// has left, and the normal points from the part's point to the blank's.
    std::uint32_t cap = kNoCap;
  };
  /// A pair found at a contact. It begins as two points and gets its balls when its curvature matters.
  struct Known {
    BallPair pair;
    /// The two points.
    geom::Point part, blank;
    geom::Point normal_of_part, normal_of_blank;
    bool grown = false;
    std::uint32_t cap = kNoCap;
  };

  void collect_samples();
  void collect_voids();
  void bound_by_samples(Node& node);
  void bound_by_voids(Node& node);
  void bound_coarsely(Node& node);
  void bound_closely(Node& node);
  void take(Node& node, double bound, const CellProof& proof);
  [[nodiscard]] CellRow row_of(const BallPair& pair, const PoseCell& cell) const;
  void fill_rows(const Node& node);
  bool solve(Node& node, CellSolution& solution);
  bool add_contacts(Node& node, double theta, geom::Point pivot, double within);
  void grow(Known& known) const;
  void grow_about_points(Known& known, const geom::BlankFromPart& pose) const;
  void keep_relevant(Node& node) const;
  MeasuredPose measure(double theta, geom::Point pivot, double margin);
  void measure_crossing(const geom::BlankFromPart& pose, MeasuredPose& found);
  void measure_caps(const geom::BlankFromPart& pose, double margin, MeasuredPose& found);
  void offer(const MeasuredPose& found, double trust);
  void polish(MeasuredPose found, double trust);
  void climb_from_anywhere();
  void report_progress(const PoseCell& closed_cell);
  std::array<Node, 2> split(const Node& node);
  [[nodiscard]] double size(const PoseCell& cell) const;
  [[nodiscard]] bool closed(double upper) const {
    if (upper <= std::max(best_.value, goal_.at_least) + goal_.gap) return true;
    const double missing = goal_.demanded - best_.value;
    return missing < kInfinity && upper <= best_.value + kOfWhatIsMissing * missing;
  }
  /// Returns the half widths of a box of steps that leaves what is locked as it is.
  [[nodiscard]] std::array<double, 3> trusted(double half) const;

  const phi::RegionClearance& clearance_;
  const std::vector<LocalCap>& caps_;
  PoseCell root_;
  Goal goal_;
  const RunControl& run_;
  double reach_;
  double scale_ = 0, doubt_ = 0, rounding_ = 0, fine_ = 0;
  std::vector<Sample> samples_;
  /// A ball in each hole of the blank.
  std::vector<Ball> voids_;
  DistanceGrid blank_grid_, part_grid_;
  std::vector<Known> known_;
  std::vector<CoverNode> cover_;
  std::vector<PoseContact> contacts_;
  std::vector<phi::RegionContact> touching_, deepest_;
  std::vector<CellRow> rows_;
  MeasuredPose best_;
  double upper_ = 0;
  bool finished_ = false;
  std::uint64_t work_ = 0, next_report_ = 0;
  double closed_share_ = 0;
};

}  // namespace lekalo::locate
