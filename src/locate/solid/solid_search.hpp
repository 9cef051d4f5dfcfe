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
  /// No pose of the window has more clearance.
  [[nodiscard]] double upper() const noexcept { return upper_; }
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }
  [[nodiscard]] std::uint64_t boxes() const noexcept { return boxes_; }

 private:
  struct Node {
    SolidCell cell;
    double upper = 0;
    std::uint64_t number = 0;
    /// Those of known_ that may matter here.
    std::vector<std::uint32_t> known;
  };
  /// The finds of bounding a box, besides its bound.
  struct Found {
    std::vector<KnownSolid> known;
    MeasuredSolid best;
    std::uint64_t work = 0;
  };

  void bound(Node& node, Found& found) const;
  void learn(Node& node, Found& found);
  [[nodiscard]] std::array<Node, 2> halves(const Node& node) const;
  [[nodiscard]] double size(const SolidCell& cell) const;
  [[nodiscard]] bool closed(double upper) const { return upper <= std::max(best_.value, 0.0) + options_.gap; }
  void report(const SolidCell& closed_cell);

  const SolidMeter& meter_;
  const SolidOptions& options_;
  SolidBounds bounds_;
  std::vector<KnownSolid> known_;
  MeasuredSolid best_;
  double upper_ = 0;
  bool finished_ = false;
  std::uint64_t work_ = 0, boxes_ = 0, next_report_ = 0;
  double closed_share_ = 0;
};

}  // namespace lekalo::locate
