#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lekalo/mill/pocket.hpp"
#include "mill/front/cleared_grid.hpp"
#include "mill/front/fields.hpp"

namespace lekalo::mill {

/// The tool at one level, from Z 0 to -options.depth: the path so far and where the tool is. A link (step 8
/// of docs/design/pocket.md) goes at depth through what is cut: along a wall, straight, or over a grid of
/// places that know which front must be cut before them. Where there is no such way it goes over the stock.
class ToolMotion {
 public:
  using Kind = PathMove::Kind;

  /// \param piece  what the tool's middle keeps to; kept by reference
  ToolMotion(const Piece& piece, const PocketOptions& options);

  [[nodiscard]] geom::Point at() const { return at_; }
  [[nodiscard]] const std::vector<PathMove>& moves() const { return moves_; }

  void go(const PathMove& move);
  /// Goes on at depth.
  void go(Kind kind, geom::Point to);
  void go(Kind kind, const geom::Edge& edge);
  void go(Kind kind, const std::vector<geom::Edge>& edges);
  /// Lifts the tool straight up, above the stock.
  void rise();
  /// Lowers the tool from above the stock to a place where nothing stands down to z.
  void come_down(geom::Point to, double z);
  void come_down(geom::Point to);

  /// From now on links go through what these fronts cut, and what they start from.
  void set_growth(const Growth& growth) { grid_.emplace(growth, piece_.tool_radius); }
  void set_done(std::size_t front) { grid_->set_done(front); }
  [[nodiscard]] bool is_done(std::size_t front) const { return grid_->is_done(front); }
  /// \pre set_growth, here and below
  void link(geom::Point to);
  /// \param walls  the tool may go along these instead of those of the piece; for instance where corners that
  /// they round are still to be cut
  void link_along(const geom::RegionIndex& walls, geom::Point to);
  /// Links to where a front begins. \param cut  what the layers before it have cut
  void link(geom::Point to, const geom::RegionIndex& cut);

  /// True when the tool's middle may go there, whether that is cut or not.
  [[nodiscard]] bool is_inside(const geom::Edge& edge) const;
  [[nodiscard]] bool is_inside(geom::Point from, geom::Point to) const;

 private:
  void link_over_grid(geom::Point to);
  /// Corners of a way that cuts nothing and leaves no wall; none where none is found.
  [[nodiscard]] std::vector<geom::Point> way_inside(geom::Point from, geom::Point to) const;
  void hop(geom::Point to);

  const Piece& piece_;
  double depth_, safe_height_, step_;  ///< mm
  std::optional<ClearedGrid> grid_;
  std::vector<PathMove> moves_;
  geom::Point at_;
};

}  // namespace lekalo::mill
