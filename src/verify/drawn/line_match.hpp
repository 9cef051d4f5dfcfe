#pragma once

#include <vector>

#include "drawn_file.hpp"
#include "verify/pocket/stroke_index.hpp"

namespace lekalo::verify {

/// The distances, mm, within which two drawings are the same: of ends and middles of edges, and besides of
/// chords from their arcs.
struct Likeness {
  double places, chords;
};

/// A set of edges that others are looked for on.
class EdgeSet {
 public:
  explicit EdgeSet(const std::vector<const DrawnLine*>& lines);

  /// Says whether all of an edge lies on one edge of the set: it is cut at every quarter turn, and of each
  /// piece both ends lie within `places` of that edge and the middle within `places` and `chords`. Where
  /// edges may be arcs drawn as chords, pieces of an arc are so short that they are nearly straight, and may
  /// lie on several edges.
  [[nodiscard]] bool holds(const Stroke& edge, const Likeness& likeness) const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> parents_near(Place p, double reach) const;

  std::vector<Stroke> pieces_;
  std::vector<std::uint32_t> parent_of_piece_;
  StrokeIndex index_;
};

}  // namespace lekalo::verify
