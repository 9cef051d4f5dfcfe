#include "profile_loose.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::nc {
namespace {

using geom::Box;
using geom::Point;
using geom::Region;

/// Edges of a union lie on those of its operands but for geom::united's errors, which are far smaller.
constexpr double kSamePlace = 1e-6;  // mm

/// The middle of an edge; across from the start for a full circle.
Point middle_of_edge(const geom::Edge& edge) {
  if (edge.kind == geom::EdgeKind::line) return edge.from + 0.5 * (edge.to - edge.from);
  const auto [sine, cosine] =
      geom::sincos((edge.kind == geom::EdgeKind::arc_ccw ? 0.5 : -0.5) * geom::arc_sweep(edge));
  const Point out = edge.from - edge.centre;
  return edge.centre + cosine * out + sine * geom::perpendicular(out);
}

/// Outlines that nothing encloses, or the same hole.
class LooseGroup {
 public:
  LooseGroup(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
             const std::vector<std::size_t>& members, const ProfileOptions& options)
      : parts_(parts), cuts_(cuts), members_(members), options_(options) {}

  /// True where kerfs of two outlines meet, or one outline may lie in a bay of another. Boxes decide, which
  /// costs little and errs on the side of looking closer.
  [[nodiscard]] bool is_crowded() const {
    std::vector<Box> boxes;
    for (const std::size_t cut : members_)
      boxes.push_back(grown(geom::bounds(outline(cut)), options_.kerf_mm + options_.tolerance_mm));
    bool crowded = false;
    geom::BoxTree(boxes).visit_pairs_while([&](std::uint32_t, std::uint32_t) { return !(crowded = true); });
    return crowded;
  }

  /// Gives the rings of the members.
  Result<void> put(std::vector<Ring>& rings) const {
    std::vector<Region> grown_outlines;
    for (const std::size_t cut : members_) {
      LEKALO_TRY(const auto grown,
                 geom::offset({{outline(cut), {}}}, options_.kerf_mm + options_.tolerance_mm));
      grown_outlines.push_back({grown.regions.front().outer, {}});
      // A bay that its own kerf closes stays a hole of what is grown, and what lies in it is not on the rim.
      grown_outlines.back().holes = grown.regions.front().holes;
    }
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < members_.size(); ++i) left.push_back(i);
    for (std::size_t depth = 0; !left.empty(); ++depth) {
      LEKALO_TRY(const std::vector<Region> rims, rims_of(grown_outlines, left));
      if (depth == 0) put_heaps(rims, rings);
      const std::vector<bool> on_rim = on_rims(rims, grown_outlines, left);
      std::vector<std::size_t> deeper;
      for (std::size_t k = 0; k < left.size(); ++k) {
        rings[members_[left[k]]].depth = depth;
        if (!on_rim[k]) deeper.push_back(left[k]);
      }
      // If none has a free way to the rim, all of them border on it alike.
      if (deeper.size() == left.size()) break;
      left = std::move(deeper);
    }
    return {};
  }

 private:
  [[nodiscard]] const geom::Contour& outline(std::size_t cut) const {
    return parts_[cuts_[cut].part].region.outer;
  }

  /// Fills the outermost contours of the union of the grown outlines.
  static Result<std::vector<Region>> rims_of(const std::vector<Region>& grown_outlines,
                                             const std::vector<std::size_t>& of) {
    std::vector<Region> pieces;
    for (const std::size_t i : of) pieces.push_back(grown_outlines[i]);
    LEKALO_TRY(auto all, geom::united(pieces));
    for (Region& region : all.regions) region.holes.clear();
    LEKALO_TRY(auto filled, geom::united(all.regions));
    return std::move(filled.regions);
  }

  void put_heaps(const std::vector<Region>& rims, std::vector<Ring>& rings) const {
    std::vector<Box> boxes;
    std::vector<geom::RegionIndex> inside;
    for (const Region& rim : rims) {
      boxes.push_back(geom::bounds(rim.outer));
      inside.emplace_back(std::vector<Region>{rim});
    }
    const geom::BoxTree tree(boxes);
    std::map<std::uint32_t, std::size_t> first_of;
    for (const std::size_t cut : members_) {
      const Point at = outline(cut).front().from;
      tree.visit_meeting({at, at}, [&](std::uint32_t i) {
        if (inside[i].contains(at)) rings[cut].heap = first_of.emplace(i, cut).first->second;
      });
    }
  }

  /// By place in `left`: whether an edge of a rim is one of the outline's, grown, and no other kerf lies
  /// between the two. Where the ways of two neighbours to the rim narrow, they may close before the outline.
  [[nodiscard]] std::vector<bool> on_rims(const std::vector<Region>& rims,
                                          const std::vector<Region>& grown_outlines,
                                          const std::vector<std::size_t>& left) const {
    const OwnedEdges grown_edges(
        left, [&](std::size_t i) -> const geom::Contour& { return grown_outlines[i].outer; });
    const OwnedEdges edges(left, [&](std::size_t i) -> const geom::Contour& { return outline(members_[i]); });
    std::vector<bool> on_rim(left.size(), false);
    for (const Region& rim : rims)
      for (const geom::Edge& edge : rim.outer) {
        const Point at = middle_of_edge(edge);
        grown_edges.tree->visit_meeting(geom::grown({at, at}, kSamePlace), [&](std::uint32_t i) {
          const std::size_t owner = grown_edges.owner[i];
          if (on_rim[owner] || geom::norm(geom::nearest_on(grown_edges.curves[i], at) - at) > kSamePlace)
            return;
          on_rim[owner] = is_way_free(edges, owner, at);
        });
      }
    return on_rim;
  }

  /// Edges of the outlines that are left, with the place of each in `left`.
  struct OwnedEdges {
    template <class Of>
    OwnedEdges(const std::vector<std::size_t>& left, const Of& contour_of) {
      std::vector<Box> boxes;
      for (std::size_t k = 0; k < left.size(); ++k)
        for (const geom::Edge& edge : contour_of(left[k])) {
          curves.push_back(geom::make_curve(edge));
          boxes.push_back(geom::curve_box(curves.back()));
          owner.push_back(k);
        }
      tree = std::make_unique<geom::BoxTree>(boxes);
    }
    std::vector<geom::Curve> curves;
    std::vector<std::size_t> owner;
    std::unique_ptr<geom::BoxTree> tree;
  };

  /// Says whether the straight way from a place on the rim to its outline keeps a kerf from all others.
  [[nodiscard]] bool is_way_free(const OwnedEdges& edges, std::size_t owner, Point at) const {
    const double kerf = options_.kerf_mm, reach = 2 * (kerf + options_.tolerance_mm);
    Point nearest = at;
    double least = reach;
    edges.tree->visit_meeting(geom::grown({at, at}, reach), [&](std::uint32_t i) {
      if (edges.owner[i] != owner) return;
      const Point on = geom::nearest_on(edges.curves[i], at);
      if (const double apart = geom::norm(on - at); apart < least) least = apart, nearest = on;
    });
    if (!(least < reach) || nearest == at) return false;
    const geom::Curve way = geom::make_curve({geom::EdgeKind::line, at, nearest, {}});
    return edges.tree->visit_meeting_while(geom::grown(geom::curve_box(way), kerf), [&](std::uint32_t i) {
      return edges.owner[i] == owner || geom::closest_points(way, edges.curves[i]).distance >= kerf;
    });
  }

  const std::vector<ProfilePart>& parts_;
  const std::vector<Cut>& cuts_;
  const std::vector<std::size_t>& members_;
  const ProfileOptions& options_;
};

}  // namespace

Result<std::vector<Ring>> loose_rings(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                                      const std::vector<std::size_t>& enclosing,
                                      const ProfileOptions& options) {
  std::vector<Ring> rings(cuts.size());
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
    rings[cut].heap = cut;
    if (cuts[cut].outline) groups[enclosing[cut] == cut ? cuts.size() : enclosing[cut]].push_back(cut);
  }
  for (const auto& [hole, members] : groups) {
    const LooseGroup group(parts, cuts, members, options);
    if (group.is_crowded()) LEKALO_CHECK(group.put(rings));
  }
  return rings;
}

}  // namespace lekalo::nc
