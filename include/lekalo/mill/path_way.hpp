#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/mill/path.hpp"

namespace lekalo::mill {

/// Finds the places of a path by the millimetres that lie behind them, in plan. Cost: one pass to make it; a
/// place among k moves takes log k.
class PathWay {
 public:
  explicit PathWay(PocketPath path);

  [[nodiscard]] const PocketPath& path() const { return path_; }
  [[nodiscard]] const std::vector<PathMove>& moves() const { return path_.moves; }
  /// The mm to where a move ends, and to where it begins; the first move begins at 0.
  [[nodiscard]] double end_of(std::size_t move) const { return ends_[move]; }
  [[nodiscard]] double begin_of(std::size_t move) const { return move > 0 ? ends_[move - 1] : 0; }
  /// \pre move > 0
  [[nodiscard]] geom::Edge edge_of(std::size_t move) const;
  /// Finds the move that holds a place, among the moves first to last.
  [[nodiscard]] std::size_t move_at(std::size_t first, std::size_t last, double along) const;
  /// True for a move at one depth, of some length, that is neither an entry nor a rapid motion.
  [[nodiscard]] bool is_level(std::size_t move) const;

 private:
  PocketPath path_;
  std::vector<double> ends_;
};

}  // namespace lekalo::mill
