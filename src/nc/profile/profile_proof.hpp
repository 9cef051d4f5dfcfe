#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region_index.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// Step 7 of docs/design/export.md: the proof that the kerf along written paths stays out of parts. It sees
/// rounded numbers alone.
///
/// Distances are enough for it. Let a path keep d >= kerf / 2 - t > 0 from the edges of a part and have a
/// point outside of it. Then all of it lies outside. The way from a point of the path to a point x deep in
/// the part crosses its boundary: d at least before, x after. So what is within kerf / 2 of the path is at
/// most t deep.
class KerfProof {
 public:
  KerfProof(const std::vector<ProfilePart>& parts, const ProfileOptions& options);

  /// A part that the kerf enters, and how deep at most.
  struct Finding {
    double deepest_mm = 0;  ///< over all parts, rounded up; 0 where it enters none
    std::size_t part = 0;   ///< the one that is entered deepest
    bool inside = false;    ///< the path itself runs in the part's material, or may
  };
  /// \param path  connected, not empty
  [[nodiscard]] Finding look(const std::vector<WrittenEdge>& path) const;
  /// True when look() finds nothing beyond the tolerance.
  [[nodiscard]] bool stays_out(const std::vector<WrittenEdge>& path) const;
  /// True when a disc about p lies outside of every part but for the tolerance.
  [[nodiscard]] bool disc_stays_out(WrittenPoint p, double radius) const;

 private:
  [[nodiscard]] bool in_material(geom::Point p, std::size_t& part) const;

  Resolution resolution_;
  double half_kerf_ = 0, tolerance_ = 0;
  std::vector<geom::RegionIndex> indices_;
  std::vector<geom::Curve> edges_;
  std::vector<std::size_t> part_of_edge_;
  std::vector<geom::Box> part_boxes_;
  std::unique_ptr<geom::BoxTree> edge_tree_, part_tree_;
};

/// The least distance of two edges, rounded down: below that of any of the curves that arcs may mean whose
/// ends are not equally far from their centres.
[[nodiscard]] double distance_at_least(const geom::Curve& a, const geom::Curve& b);
/// The same for a point.
[[nodiscard]] double distance_at_least(const geom::Curve& curve, geom::Point p);

}  // namespace lekalo::nc
