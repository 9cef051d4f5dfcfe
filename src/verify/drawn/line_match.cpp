#include "line_match.hpp"

#include <algorithm>
#include <iterator>

#include "lekalo/base/stop.hpp"
#include "placed_sheet.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

using Parents = std::vector<std::uint32_t>;

Parents common(const Parents& a, const Parents& b) {
  Parents both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace

EdgeSet::EdgeSet(const std::vector<const DrawnLine*>& lines) {
  std::uint32_t parent = 0;
  Place low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const DrawnLine* line : lines)
    for (const Stroke& edge : line->edges) {
      add_pieces(edge, kInfinity, pieces_);
      for (std::size_t i = parent_of_piece_.size(); i < pieces_.size(); ++i) {
        Place from, to;
        box_of(pieces_[i], from, to);
        low = {std::min(low.x, from.x), std::min(low.y, from.y)};
        high = {std::max(high.x, to.x), std::max(high.y, to.y)};
      }
      parent_of_piece_.resize(pieces_.size(), parent++);
    }
  if (pieces_.empty()) return;
  index_ = StrokeIndex(low, high, 1e-3 + length(high - low) / 300);
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) index_.add(i, pieces_[i]);
}

Parents EdgeSet::parents_near(Place p, double reach) const {
  Parents near, parents;
  index_.near(p, reach, near);
  for (const std::uint32_t i : near)
    if (distance(p, pieces_[i]) <= reach) parents.push_back(parent_of_piece_[i]);
  std::sort(parents.begin(), parents.end());
  parents.erase(std::unique(parents.begin(), parents.end()), parents.end());
  return parents;
}

bool EdgeSet::holds(const Stroke& edge, const Likeness& likeness) const {
  const bool as_chords = likeness.chords > 0 && edge.arc;
  // A chord over an angle a lies within r a^2 / 8 of its arc: these are within a fiftieth of `chords`.
  const double longest = as_chords ? std::sqrt(8 * edge.radius * likeness.chords / 50) : kInfinity;
  std::vector<Stroke> pieces;
  add_pieces(edge, longest, pieces);
  const double reach = likeness.places, middle_reach = reach + 1.02 * likeness.chords;
  return std::all_of(pieces.begin(), pieces.end(), [&](const Stroke& piece) {
    ask();
    if (as_chords)
      return !parents_near(piece.from, middle_reach).empty() && !parents_near(piece.to, middle_reach).empty();
    const Parents ends = common(parents_near(piece.from, reach), parents_near(piece.to, reach));
    return !common(ends, parents_near(at_share(piece, 0.5), middle_reach)).empty();
  });
}

}  // namespace lekalo::verify
