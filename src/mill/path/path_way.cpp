#include "lekalo/mill/path_way.hpp"

#include <algorithm>
#include <utility>

#include "edge_path.hpp"

namespace lekalo::mill {

PathWay::PathWay(PocketPath path) : path_(std::move(path)) {
  double along = 0;
  for (std::size_t i = 0; i < moves().size(); ++i) {
    if (i > 0) along += length_of(edge_of(i));
    ends_.push_back(along);
  }
}

geom::Edge PathWay::edge_of(std::size_t move) const {
  const PathMove& m = moves()[move];
  const geom::Point from = moves()[move - 1].to;
  if (m.shape != geom::EdgeKind::line) return arc_of(m, from);
  return {geom::EdgeKind::line, from, m.to, {}};
}

std::size_t PathWay::move_at(std::size_t first, std::size_t last, double along) const {
  const auto begin = ends_.begin() + static_cast<std::ptrdiff_t>(first),
             end = ends_.begin() + static_cast<std::ptrdiff_t>(last);
  return static_cast<std::size_t>(std::upper_bound(begin, end, along) - ends_.begin());
}

bool PathWay::is_level(std::size_t move) const {
  if (move == 0) return false;
  const PathMove& m = moves()[move];
  const bool apart =
      m.kind == PathMove::Kind::rapid || m.kind == PathMove::Kind::plunge || m.kind == PathMove::Kind::entry;
  return !apart && m.z <= 0 && m.z == moves()[move - 1].z && length_of(edge_of(move)) > 0;
}

}  // namespace lekalo::mill
