#pragma once

#include <cstdint>
#include <vector>

#include "solid_bound.hpp"

namespace lekalo::locate {

/// A best-first branch and bound over boxes of poses (docs/design/locate-solid.md). A few boxes are bounded
/// at a time, by as many threads as there are; what one finds the others learn afterwards, so that the result
/// is the same for any number of them.
class SolidSearch {
 public:
  SolidSearch(const SolidMeter& meter, const SolidOptions& options);

  void run();

  [[nodiscard]] const MeasuredSolid& best() const noexcept { return best_; }
  /// No pose of the window that keeps the datums has more margin.
  [[nodiscard]] double upper() const noexcept;
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }
  [[nodiscard]] std::uint64_t boxes() const noexcept { return boxes_; }
  /// The reason for the bound.
  [[nodiscard]] SolidProof proof() const;

 private:
  /// A term of one of known_.
  struct Term {
    std::uint32_t known = 0;
    SolidChoice choice;
    std::uint32_t multiplier = 0;
  };
  struct Node {
    SolidCell cell;
    double upper = kInfinity;
    /// Its place in tree_.
    std::uint32_t number = 0;
    /// Those of known_ that may matter here.
    std::vector<std::uint32_t> known;
    /// They prove the bound.
    std::vector<Term> terms;
  };
  using Axis = SolidTree::Axis;
  /// The finds of bounding a box, besides its bound.
  struct Found {
    std::vector<KnownSolid> known;
    MeasuredSolid best;
    std::uint64_t work = 0;
  };

  void climb_first();
  [[nodiscard]] Node first_box(std::uint8_t chart);
  void bound(Node& node, Found& found) const;
  [[nodiscard]] std::optional<FramedPose> drawn_in(const FramedPose& pose) const;
  void learn(Node& node, Found& found);
  void add_effects(const Node& node, const CellView& view, Steps& matters) const;
  [[nodiscard]] std::array<Node, 2> halves(const Node& node);
  void keep(const Node& node);
  [[nodiscard]] double size(const SolidCell& cell) const;
  /// Says if a box with this bound need not be looked at any more.
  [[nodiscard]] bool closed(double upper) const {
    if (best_.inside) return upper <= best_.value + options_.gap;
    return upper <= meter_.floor() + options_.gap || (meter_.has_demands() && upper < options_.min_allowance);
  }
  void tell(double fraction) const;
  void count_closed(const SolidCell& closed_cell);

  const SolidMeter& meter_;
  const SolidOptions& options_;
  SolidBounds bounds_;
  std::vector<KnownSolid> known_;
  /// The boxes so far, those of the charts first. A split has the place of its low half in `first`, and the
  /// high half stands behind it.
  std::vector<SolidTree::Node> tree_;
  /// The boxes that it begins with.
  std::vector<Node> first_;
  /// The terms of those that are closed.
  std::vector<Term> terms_;
  MeasuredSolid best_;
  double upper_ = 0;
  bool finished_ = false;
  std::uint64_t work_ = 0, boxes_ = 0;
  double closed_share_ = 0;
};

}  // namespace lekalo::locate
