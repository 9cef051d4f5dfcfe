#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// The kerfs of all cuts, for the question which of them a lead or a pierce would meet. Only those that are
/// there already matter, and the order of cuts decides which these are (docs/design/cut-order.md).
class KerfsAround {
 public:
  KerfsAround(const std::vector<Cut>& cuts, const ProfileOptions& options);

  /// The other cuts whose kerf meets the kerf along `lead` or the disc about `pierce`, ascending. Distances
  /// are rounded down, so that what is left out is clear for certain. The disc counts where its diameter is
  /// known; a cut that begins on its contour without a disc meets nothing.
  [[nodiscard]] std::vector<std::size_t> met(std::size_t own, const std::vector<WrittenEdge>& lead,
                                             WrittenPoint pierce) const;

  /// True when this line keeps so far from all other cuts.
  [[nodiscard]] bool keeps_apart(std::size_t own, const geom::Edge& line, double by) const;

  /// True where this line goes along a straight edge of another cut, so near that their kerfs meet.
  [[nodiscard]] bool goes_along(std::size_t own, const WrittenEdge& line) const;
  /// The other cuts on which a place lies, within this, ascending.
  [[nodiscard]] std::vector<std::size_t> holding(std::size_t own, WrittenPoint p, double within) const;

  /// The least distance of a point from all of a cut, within rounding.
  [[nodiscard]] double distance(std::size_t cut, geom::Point p) const;
  /// True when that distance is at least this. O(1) where a box says so.
  [[nodiscard]] bool is_apart(std::size_t cut, geom::Point p, double by) const;

 private:
  Resolution resolution_;
  double kerf_ = 0, pierce_ = 0;
  std::vector<geom::Curve> edges_;
  std::vector<std::size_t> cut_of_, first_edge_;
  std::vector<geom::Box> boxes_;  ///< by cut
  std::unique_ptr<geom::BoxTree> tree_;
};

}  // namespace lekalo::nc
