#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contour_ring.hpp"
#include "lekalo/verify/claims.hpp"
#include "loose_check.hpp"
#include "profile_moves.hpp"

namespace lekalo::verify {

/// A contour of a part that cuts have to run beside.
struct CommonContour {
  std::uint64_t part = 0;  ///< contours of one part stand one after the other, the outline first
  bool is_hole = false;
  std::string name;
  const ContourRing* ring = nullptr;
};

/// A pass that does not reach the bottom, which frees nothing.
struct ShallowCut {
  const CutChain* chain = nullptr;
  std::size_t through_before = 0;  ///< cuts that go through and come before it
};

/// Judges the cuts of a sheet on which parts may share them. No cut has a contour of its own; asked is of the
/// contours whether a cut runs beside each place at half a kerf, of the parts whether all of them are free in
/// the end, and of the cuts whether they go along each other, and whether they cut anything of a part that
/// the cuts before have made loose. docs/design/common-line.md says why that is enough.
class CommonLineCheck {
 public:
  /// \param cuts  those that go through, in the order of the program
  CommonLineCheck(const std::vector<const CutChain*>& cuts, const std::vector<ShallowCut>& shallow,
                  const std::vector<CommonContour>& contours, const ProfileWords& words);

  /// Adds what is not true, what is left open, and what was found, to a report.
  void judge(ClaimReport& report);

 private:
  struct Part {
    std::string name;
    std::vector<std::size_t> contours;
    Place inside;  ///< a place of its material
    StrokeExtent extent;
  };
  void add_parts();

  void check_sizes(ClaimReport& report);
  void check_once(ClaimReport& report) const;
  void check_leads(ClaimReport& report) const;
  void check_free(ClaimReport& report) const;
  void check_loose(ClaimReport& report) const;

  /// The distance from `from` along a straight edge up to which a cut is near enough.
  [[nodiscard]] double beside_up_to(const Stroke& edge, double from) const;
  /// Says what is cut of a part after it is loose and has to be cut before; empty where nothing is.
  [[nodiscard]] std::string cut_when_loose(const Part& part, const LooseCheck& held, const StrokeIndex& index,
                                           LooseCheck::Moment loose) const;
  [[nodiscard]] std::string passed_when_loose(const Part& part, std::size_t cut) const;
  [[nodiscard]] bool all_within(const Stroke& edge, double near) const;
  [[nodiscard]] double reach() const;
  [[nodiscard]] double distance_of(const Part& part, Place p) const;
  [[nodiscard]] Place nearest_of(const Part& part, Place p) const;

  const std::vector<const CutChain*>& cuts_;
  const std::vector<ShallowCut>& shallow_;
  const std::vector<CommonContour>& contours_;
  const ProfileWords& words_;
  double half_;
  Strokes pieces_;  ///< of all cuts
  std::vector<std::size_t> cut_of_piece_;
  StrokeIndex index_;
  Strokes edges_;  ///< of all contours
  StrokeIndex edge_index_;
  std::vector<Part> parts_;
};

}  // namespace lekalo::verify
