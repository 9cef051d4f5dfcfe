#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::phi {

/// A place where the boundaries of a placed part and of its blank come close.
struct RegionContact {
  std::uint32_t part_edge = 0, blank_edge = 0;  ///< their numbers (geom::Region)
  geom::Point part, blank;                      ///< the two points, each in its own frame
  double distance = 0;                          ///< mm, not negative
};

/// The clearance of a part in a blank, both regions of lines and arcs with holes, in several pieces if need
/// be: the least signed distance of any material point of the part from the boundary of the blank, positive
/// inside. Where it is not negative it is the least distance between the boundaries.
///
/// An object holds indices of both. Evaluating a pose allocates nothing that it does not keep.
class RegionClearance {
 public:
  /// \pre regions made by make_region, none crossing itself or another
  RegionClearance(const std::vector<geom::Region>& part, const std::vector<geom::Region>& blank);

  struct Value {
    /// The least distance between the boundaries, within kEdgeDistanceError * size of the exact one; 0 where
    /// they cross.
    double distance = 0;
    /// This is true when the part lies in the blank's material; then `distance` is the clearance.
    bool inside = false;
  };
  /// \param contacts  if given, filled with the pairs of points at most `margin` further apart than the
  ///                  least distance. Every pair of edges gives its nearest two points, but not those that
  ///                  another pair of edges gives as well. The nearest thousands are kept where there are
  ///                  more.
  /// Cost: O((n + k) log m) for n edges of the part, m of the blank and k pairs that come close.
  [[nodiscard]] Value at(const geom::BlankFromPart& pose, double margin = 0,
                         std::vector<RegionContact>* contacts = nullptr) const;

  /// Returns a bound on how far the part sticks out of the blank, where it does: on the largest distance of
  /// its material from the blank's. A quadtree finds it, at most `tolerance` or a 256th part (and rounding)
  /// too large.
  [[nodiscard]] double depth(const geom::BlankFromPart& pose, double tolerance) const;

  /// Returns the place where one edge of the part, placed, is nearest to the blank's boundary. The distance
  /// is 0 where it crosses it. Error as at().
  [[nodiscard]] RegionContact nearest(const geom::BlankFromPart& pose, std::uint32_t part_edge) const;

  /// Returns how deep the points of some edges, moved as the part is, lie in the blank at most: their largest
  /// distance from its boundary inside its material, 0 where none is inside. The result is never too small.
  /// It is too large by at most `tolerance` (and rounding), or by more if that takes more than kMostPieces
  /// pieces of edges.
  ///
  /// \param points  filled with one point for each place that may be within `margin` of the deepest; its
  ///                `distance` is that from `blank`, the nearest boundary point, and `part_edge` counts in
  ///                `edges`
  /// Cost: O(log m) a piece; a few pieces an edge, more where the boundary runs like the edge but for arcs.
  double deepest(const geom::BlankFromPart& pose, const std::vector<geom::Curve>& edges, double tolerance,
                 double margin, std::vector<RegionContact>& points) const;
  static constexpr std::size_t kMostPieces = 100'000;

  [[nodiscard]] const geom::RegionIndex& part() const noexcept { return part_; }
  [[nodiscard]] const geom::RegionIndex& blank() const noexcept { return blank_; }

 private:
  struct Disc {
    geom::Point centre;
    double radius = 0;
  };
  [[nodiscard]] bool inside(const geom::BlankFromPart& pose) const;
  [[nodiscard]] bool touches_from_inside(const geom::BlankFromPart& pose, double doubt) const;

  geom::RegionIndex part_, blank_;
  /// A disc around each edge of the part.
  std::vector<Disc> disc_;
};

/// Returns a curve moved by a pose.
[[nodiscard]] geom::Curve placed(const geom::Curve& curve, const geom::BlankFromPart& pose) noexcept;

}  // namespace lekalo::phi
