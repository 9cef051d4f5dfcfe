#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cell_program.hpp"
#include "distance_grid.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/phi/region.hpp"
#include "sinusoid.hpp"
#include "tangent_balls.hpp"

namespace lekalo::locate {

/// A box of poses: where the part's pivot lies in the blank, and the angle; middle and half widths.
struct PoseCell {
  double theta = 0, half_theta = 0;
  geom::Point pivot;
  double half_x = 0, half_y = 0;
};

/// Pairs of balls with multipliers that sum to 1: the weighted sum of their distances bounds the clearance.
struct CellProof {
  struct Term {
    BallPair pair;
    double multiplier = 0;
  };
  std::array<Term, 4> term;
  std::size_t terms = 0;
};

/// One node of the subdivision that a search made. Leaves carry the proof of their bound.
struct CoverNode {
  enum class Axis : std::uint8_t { leaf, theta, x, y };
  Axis axis = Axis::leaf;
  double at = 0;                    ///< where it is split
  std::uint32_t low = 0, high = 0;  ///< children
  CellProof proof;
};

/// Best-first branch and bound over poses of a part in a blank of any shape (docs/design/locate-region.md).
class PoseSearch {
 public:
  struct Found {
    double theta = 0;
    geom::Point pivot;  ///< in the blank's frame
    double value = 0;   ///< signed clearance as measured; not yet rounded down
    bool inside = false;
  };

  /// \param clearance  part (its points counted from the pivot) and blank, in local coordinates
  /// \param far        largest |coordinate| of the problem in its own frames, which rounding follows
  /// \param at_least   a clearance known to be reachable: cells that prove no more need not be divided
  PoseSearch(const phi::RegionClearance& clearance, const PoseCell& root, double far, double gap,
             double at_least, const RunControl& run);

  void run();

  /// What holds the part at a pose: contacts in the order of `within`'s pairs, with multipliers that balance.
  struct Held {
    phi::RegionContact contact;
    double multiplier = 0;
  };
  [[nodiscard]] std::vector<Held> held_at(const Found& found);

  [[nodiscard]] const Found& best() const { return best_; }
  [[nodiscard]] double upper() const { return upper_; }
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] std::uint64_t work() const { return work_; }
  [[nodiscard]] const std::vector<CoverNode>& cover() const { return cover_; }

 private:
  struct Node {
    PoseCell cell;
    double upper = 0;
    std::uint32_t cover = 0;
    std::vector<std::uint32_t> pairs;  ///< of known_, those that may matter here
  };
  /// A point of the part by which large cells are bounded.
  struct Sample {
    geom::Point at;
    double far = 0;          ///< from the pivot
    std::uint32_t edge = 0;  ///< of the part
  };
  /// A place where the outlines come close, or cross: `distance` is negative where the part's point lies
  /// outside the blank or the blank's point inside the part. The normal points from the blank's outside to
  /// its material, in the blank's frame.
  struct Contact {
    geom::Point part, blank, normal;
    double distance = 0;
  };
  /// A pair found at a contact. It begins as two points and gets its balls when its curvature matters.
  struct Known {
    BallPair pair;
    geom::Point normal_of_part, normal_of_blank;
    bool grown = false;
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
  bool add_contacts(Node& node, double theta, double within);
  void grow(Known& known) const;
  void keep_relevant(Node& node) const;
  Found measure(double theta, geom::Point pivot, double margin);
  void measure_crossing(const geom::BlankFromPart& pose, Found& found);
  void offer(const Found& found, double trust);
  void polish(Found found, double trust);
  void report_progress(const PoseCell& closed_cell);
  std::array<Node, 2> split(const Node& node);
  [[nodiscard]] double size(const PoseCell& cell) const;
  [[nodiscard]] bool closed(double upper) const { return upper <= std::max(best_.value, at_least_) + gap_; }

  const phi::RegionClearance& clearance_;
  PoseCell root_;
  double gap_;
  const RunControl& run_;
  double reach_;
  double scale_ = 0, doubt_ = 0, rounding_ = 0, fine_ = 0;
  std::vector<Sample> samples_;
  std::vector<Ball> voids_;  ///< a ball in each hole of the blank
  DistanceGrid blank_grid_, part_grid_;
  std::vector<Known> known_;
  std::vector<CoverNode> cover_;
  std::vector<Contact> contacts_;
  std::vector<phi::RegionContact> touching_;
  std::vector<CellRow> rows_;
  Found best_;
  double at_least_;
  double upper_ = 0;
  bool finished_ = false;
  std::uint64_t work_ = 0, next_report_ = 0;
  double closed_share_ = 0;
};

}  // namespace lekalo::locate
