#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/nc/profile.hpp"
#include "lekalo/nc/program_writer.hpp"

namespace lekalo::nc {

/// The grid of the last decimal of a program's words.
struct Resolution {
  int decimals = 4;
  LengthUnit unit = LengthUnit::millimetre;

  [[nodiscard]] double step_mm() const noexcept;
  [[nodiscard]] WrittenPoint rounded(geom::Point mm) const noexcept;
  [[nodiscard]] geom::Point mm(WrittenPoint p) const noexcept;
};
[[nodiscard]] Resolution resolution_of(const ProfileOptions& options) noexcept;

/// One motion as written; the centre of an arc is a whole number of units too.
struct WrittenEdge {
  geom::EdgeKind kind = geom::EdgeKind::line;
  WrittenPoint from, to, centre;
  bool joint = false;  ///< a joint stays here: the edge is not cut, or not down to the bottom
  bool slow = false;   ///< near a corner (profile_corners.hpp)
};
/// The edge in mm, within rounding of a double.
[[nodiscard]] geom::Edge edge_mm(const WrittenEdge& edge, const Resolution& resolution) noexcept;

/// The length of a line or an arc, mm.
[[nodiscard]] double length_of(const geom::Edge& edge) noexcept;

/// Edges as they are written (step 4 of docs/design/export.md): arcs of at most half a turn, arcs that are
/// lines to the resolution as lines, and no edge of no length.
[[nodiscard]] std::vector<WrittenEdge> written_edges(const std::vector<geom::Edge>& edges,
                                                     const Resolution& resolution);

/// A contour to cut, in the direction of the cut; or a line or rim of a cluster (common_cuts.hpp).
struct Cut {
  std::size_t part = 0;  ///< index into the parts
  bool outline = true;   ///< of a part or a cluster; or a hole, or what is cut within a cluster
  std::size_t hole = 0;
  std::vector<WrittenEdge> path;  ///< closed but for lines
  /// The parts along a cut of a cluster, ascending; empty for a contour of one part.
  std::vector<std::size_t> members{};
  bool is_line = false;
  bool either_way = false;  ///< a line that may be cut from its other end, too

  [[nodiscard]] bool is_hole() const noexcept { return !outline && members.empty(); }
};

/// Steps 3 and 4: the cuts of all parts in their order, holes of a part before its outline. Fails like
/// profile_program where the kerf closes something.
[[nodiscard]] Result<std::vector<Cut>> compensated_cuts(const std::vector<ProfilePart>& parts,
                                                        const ProfileOptions& options);

}  // namespace lekalo::nc
