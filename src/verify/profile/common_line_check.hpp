#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contour_ring.hpp"
#include "lekalo/verify/claims.hpp"
#include "profile_moves.hpp"

namespace lekalo::verify {

/// A contour of a part that cuts have to run beside.
struct CommonContour {
  bool is_hole = false;
  std::string name;
  const ContourRing* ring = nullptr;
};

/// Judges the cuts of a sheet on which parts may share them. No cut has a contour of its own; asked is of the
/// contours, all of them whether a cut runs beside each place at half a kerf, and of the cuts whether they go
/// along each other, and whether they cut anything of a part that the cuts before have made loose.
/// docs/design/common-line.md says why that is enough.
class CommonLineCheck {
 public:
  /// \param cuts  those that go through, in the order of the program
  CommonLineCheck(const std::vector<const CutChain*>& cuts, const std::vector<CommonContour>& contours,
                  const ProfileWords& words);

  /// Adds what is not true, what is left open, and what was found, to a report.
  void judge(ClaimReport& report);

 private:
  /// A stretch of a cut along which the same parts lie.
  struct Along {
    std::size_t line = 0;
    Strokes strokes;
    std::vector<std::size_t> contours;  ///< ascending
    [[nodiscard]] double length_mm() const;
  };

  void check_sizes(ClaimReport& report);
  void check_once(ClaimReport& report) const;
  void check_leads(ClaimReport& report) const;
  void check_loose(ClaimReport& report) const;

  [[nodiscard]] double reach() const;
  [[nodiscard]] std::vector<std::size_t> contours_beside(Place p) const;
  [[nodiscard]] std::vector<Along> stretches() const;

  const std::vector<const CutChain*>& cuts_;
  const std::vector<CommonContour>& contours_;
  const ProfileWords& words_;
  double half_;
  Strokes pieces_;  ///< of all cuts
  std::vector<std::size_t> cut_of_piece_;
  StrokeIndex index_;
  Strokes edges_;  ///< of all contours
  std::vector<std::size_t> contour_of_edge_;
  StrokeIndex edge_index_;
};

}  // namespace lekalo::verify
