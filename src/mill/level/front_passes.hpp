#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mill/front/fronts.hpp"
#include "tool_motion.hpp"

namespace lekalo::mill {

/// Step 6 of docs/design/pocket.md: cuts what grows from a start, front by front. It chooses the next front,
/// and knows how a pass from wall to wall, a ring, a loop and a slot are begun and cut.
class FrontPasses {
 public:
  /// \param piece, tool, listener  kept by reference
  FrontPasses(const Piece& piece, ToolMotion& tool, const PocketOptions& options,
              const AreaListener& listener);

  /// Grows fronts from `start`, which is cut, in place of those before. Errors: as mill::grow.
  Result<void> grow_from(const std::vector<geom::Region>& start);
  /// The fronts of the last growth.
  [[nodiscard]] const std::vector<Front>& fronts() const { return growth_.fronts; }
  /// The places that the last growth comes to.
  [[nodiscard]] const std::vector<geom::Region>& reached() const { return growth_.cut.back(); }
  /// The direction from the middle of a disc, the start, to where the first front begins.
  [[nodiscard]] geom::Point first_direction(geom::Point centre, double disc) const;
  /// Cuts all fronts of the last growth that can be cut. Choosing takes O(fronts^2).
  void cut_all();
  /// Does the same for some fronts alone.
  void cut_all(const std::vector<std::size_t>& among);

  // These count over all growths:
  [[nodiscard]] std::size_t count() const { return count_; }
  /// The places where passes ended.
  [[nodiscard]] std::vector<geom::Point> ends() const;
  /// The centres of loops, and the places of slots.
  [[nodiscard]] const std::vector<geom::Point>& loop_places() const { return loop_places_; }

 private:
  struct Pass {
    geom::Point from, corner, to;  ///< corner: where its front would have met the wall it began at
  };
  [[nodiscard]] std::optional<std::size_t> next(const std::vector<std::size_t>& among) const;
  void cut(const Front& front);
  void cut_across(const Front& front);
  void cut_ring(const Front& front);
  void cut_loop(const Front& front);
  void cut_slot(const Front& front);
  [[nodiscard]] Front begun_like_before(const Front& front, bool back) const;
  /// The places that are cut before the front's layer.
  [[nodiscard]] geom::RegionIndex before(const Front& front) const {
    return geom::RegionIndex(growth_.cut[front.layer - 1]);
  }

  const Piece& piece_;
  ToolMotion& tool_;
  const AreaListener& listener_;
  GrowthLaw law_;
  bool either_way_;
  Growth growth_;
  std::vector<double> waiting_;  ///< mm of each front and of all that wait for it
  std::vector<Pass> passes_;     ///< in order
  std::vector<geom::Point> loop_places_;
  double planned_ = 0;  ///< mm2 of places, by growths before the one under way
  std::size_t count_ = 0;
};

}  // namespace lekalo::mill
