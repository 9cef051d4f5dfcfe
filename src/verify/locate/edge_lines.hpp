#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {

/// The line of a blank edge from file point k to the next that was not dropped.
///
/// `outside` >= 0 is how far the blank reaches across the line, times the edge's length: 0 for the true edge
/// of a convex blank. The line moved out by it has the whole blank on its left and touches a hull corner
/// there; its normal is c1 n1 + c2 n2 of the two hull edges at that corner, c1, c2 >= 0, and `spread` = c1 +
/// c2 >= 1. So where every hull edge is at least (signed) r away, this line is at least r away if r >= 0, and
/// at least spread r if r < 0.
struct EdgeLine {
  Point start, direction;  ///< material on the left, whichever way the file runs
  Integer outside;
  Interval length, spread;  ///< spread is exactly 1 when outside is 0
  Interval short_length;    ///< length in 64 bits
  Span flat_length;         ///< length in doubles, in units of 2^EdgeLines::flat_scale()
};

/// The edges of a blank as a result names them, each measured when first asked for. The list of dropped
/// points is a hint: whatever it says, an EdgeLine tells the truth about its line.
class EdgeLines {
 public:
  EdgeLines(const Outline& blank, const std::vector<std::size_t>& dropped, Precision precision);

  /// nullptr, with the reason in `why`, when there is no such edge.
  [[nodiscard]] const EdgeLine* find(std::size_t k, std::string& why);
  /// Hull edge j (cyclic), whether or not a file edge runs along it.
  [[nodiscard]] const EdgeLine& along_hull(std::size_t j);
  [[nodiscard]] const Outline& outline() const { return blank_; }
  /// About the size of the blank: 2^flat_scale() makes lengths doubles of moderate size, whatever the units.
  [[nodiscard]] long flat_scale() const { return flat_scale_; }

 private:
  /// `near`: a hull edge to look from for what lies outside.
  [[nodiscard]] EdgeLine measure(const Point& from, const Point& to, std::size_t near) const;

  const Outline& blank_;
  Precision precision_;
  long flat_scale_ = 0;
  std::vector<bool> dropped_;
  std::vector<std::size_t> next_kept_;               ///< per file point: the next one not dropped
  std::vector<std::size_t> under_;                   ///< per file point: hull edge it lies under
  std::vector<std::optional<EdgeLine>> lines_;       ///< per file point
  std::vector<std::optional<EdgeLine>> hull_lines_;  ///< per hull edge
};

}  // namespace lekalo::verify
