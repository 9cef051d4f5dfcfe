#pragma once

#include <optional>
#include <vector>

#include "verify/shape/shape_distance.hpp"

namespace lekalo::verify {

/// A stretch of a curve that is to be cut: the curve itself and the side lie within `off` of each other.
struct CurvePiece {
  Side side;
  double off = 0;
  /// Others may be farther from it than from the rest by this.
  double more = 0;
};

/// Curves, with a tree over their boxes.
class CurvePieces {
 public:
  explicit CurvePieces(std::vector<CurvePiece> pieces);

  /// Returns a point of the pieces that is not shown to lie within `reach` of these, or nothing where all
  /// are shown to. Each piece is halved until a part is within reach of one of these, or too short to be.
  /// \param work  counts looks at pairs; where they are above `most_work` nothing is halved
  [[nodiscard]] std::optional<Vec> first_not_within(const std::vector<CurvePiece>& pieces, double reach,
                                                    std::size_t& work, std::size_t most_work) const;
  /// Calls f(k) for every piece k that p lies within `reach` of.
  template <class F>
  void each_near(const Vec& p, double reach, F f) const {
    index_.visit_near(box_of(p), reach, [&](std::size_t k) {
      if (distance(p, pieces_[k].side).low <= reach + pieces_[k].off + pieces_[k].more) f(k);
    });
  }
  /// Says whether p surely lies farther than `reach` from all pieces.
  [[nodiscard]] bool surely_away(const Vec& p, double reach) const {
    bool away = true;
    each_near(p, reach, [&](std::size_t) { away = false; });
    return away;
  }

 private:
  std::vector<CurvePiece> pieces_;
  SideTree index_;
};

/// Returns the sides of a shape as pieces.
[[nodiscard]] std::vector<CurvePiece> pieces_of(const Shape& shape);

}  // namespace lekalo::verify
