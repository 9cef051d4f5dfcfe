#pragma once

#include <cstddef>
#include <vector>

#include "mill/front/peels.hpp"
#include "tool_motion.hpp"

namespace lekalo::mill {

/// Step 7 of docs/design/pocket.md: the pass along the walls rounds corners, and what it leaves there is cut
/// in peels, to and fro, each as deep as it may be.
class Corners {
 public:
  /// \param piece, loop_places  kept by reference \param loop_places, cleared  as of Peels
  /// Errors, here and below: as geom::offset and geom::combine.
  [[nodiscard]] static Result<Corners> find(const Piece& piece, const std::vector<geom::Point>& loop_places,
                                            const std::vector<geom::Region>& cleared,
                                            const PocketOptions& options);

  /// The round on whose boundary the pass along the walls goes.
  [[nodiscard]] const Peels::Round& walls() const { return *walls_; }
  /// The stretches of the walls themselves that this pass leaves out.
  [[nodiscard]] const std::vector<Front>& zones() const { return *zones_; }
  /// Cuts a zone. The tool is where the pass along the walls leaves it: at the zone's end.
  Result<void> cut(std::size_t zone, ToolMotion& tool);

 private:
  struct Peel {
    std::size_t inner;  ///< round
    std::vector<Front> passes;
  };
  Corners(const Piece& piece, const std::vector<geom::Point>& loop_places,
          const std::vector<geom::Region>& cleared, const PocketOptions& options);
  Result<Peel> deepest_peel(std::size_t outer, const Front& zone);
  [[nodiscard]] bool is_hot(const std::vector<Front>& passes, const geom::RegionIndex& before) const;
  Result<void> cut_beyond(std::size_t outer, const Front& zone, bool& back, ToolMotion& tool);

  const Piece& piece_;
  double thinness_, held_degrees_;
  bool either_way_;
  Peels peels_;
  std::size_t roundest_ = 0;  ///< round of the pass along the walls
  // peels_ keeps these, and they stay where they are:
  const Peels::Round* walls_ = nullptr;
  const std::vector<Front>* zones_ = nullptr;
};

}  // namespace lekalo::mill
