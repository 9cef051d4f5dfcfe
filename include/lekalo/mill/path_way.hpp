#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/mill/path.hpp"

namespace lekalo::mill {

/// A path by millimetres along it, in plan. Cost: one pass; a place among k moves log k.
class PathWay {
 public:
  explicit PathWay(PocketPath path);

  [[nodiscard]] const PocketPath& path() const { return path_; }
  [[nodiscard]] const std::vector<PathMove>& moves() const { return path_.moves; }
  /// mm to where a move ends, and to where it begins; the first begins anywhere.
  [[nodiscard]] double end_of(std::size_t move) const { return ends_[move]; }
  [[nodiscard]] double begin_of(std::size_t move) const { return move > 0 ? ends_[move - 1] : 0; }
  /// \pre move > 0
  [[nodiscard]] geom::Edge edge_of(std::size_t move) const;
  /// Of the moves first to last the one that holds a place.
  [[nodiscard]] std::size_t move_at(std::size_t first, std::size_t last, double along) const;
  /// At one depth, of some length, and neither an entry nor a rapid motion.
  [[nodiscard]] bool is_level(std::size_t move) const;

 private:
  PocketPath path_;
  std::vector<double> ends_;
};

}  // namespace lekalo::mill
