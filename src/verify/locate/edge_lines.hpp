#pragma once

#include <optional>
#include <string>
#include <vector>

#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {

/// Returns the largest |x| or |y| of the points.
[[nodiscard]] Integer largest_coordinate(const Ring& points);

/// The line of a blank edge, which runs from file point k to the next point that was not dropped.
///
/// `outside` >= 0 is how far the blank reaches across the line, times the edge's length. For the true edge of
/// a convex blank it is 0. The line moved out by it has the whole blank on its left and touches a hull
/// corner. Its normal is c1 n1 + c2 n2 of the two hull edges at that corner, with c1, c2 >= 0, and `spread` =
/// c1 + c2 >= 1. So where every hull edge is at least (signed) r away, this line is at least r away if r >=
/// 0, and at least spread r if r < 0.
struct EdgeLine {
  /// The material is on the left, whichever way the file runs.
  Point start, direction;
  Integer outside;
  /// The spread is exactly 1 when `outside` is 0.
  Interval length, spread;
  /// The length in kRough bits.
  Interval short_length;
  /// The length in doubles, in units of 2^EdgeLines::flat_scale().
  Span flat_length;
};

/// The edges of a blank by the names that a result gives them; each is measured when it is first asked for.
/// The list of dropped points is only a hint: whatever it says, an EdgeLine tells the truth about its line.
class EdgeLines {
 public:
  EdgeLines(const Outline& blank, const std::vector<std::size_t>& dropped, Precision precision);

  /// Returns nullptr, with the reason in `why`, when there is no such edge.
  [[nodiscard]] const EdgeLine* find(std::size_t k, std::string& why);
  /// Returns the line along hull edge j (cyclic), whether or not a file edge runs along it.
  [[nodiscard]] const EdgeLine& along_hull(std::size_t j);
  [[nodiscard]] const Outline& outline() const { return blank_; }
  /// Returns the scale at which 2^flat_scale() is about the size of the blank. In that unit lengths are
  /// doubles of moderate size, whatever unit the file has.
  [[nodiscard]] long flat_scale() const { return flat_scale_; }

 private:
  /// \param near  a hull edge from which the search for what lies outside begins
  [[nodiscard]] EdgeLine measure(const Point& from, const Point& to, std::size_t near) const;

  const Outline& blank_;
  Precision precision_;
  long flat_scale_ = 0;
  std::vector<bool> dropped_;
  /// By file point: the next point that was not dropped.
  std::vector<std::size_t> next_kept_;
  /// By file point: the hull edge that it lies under.
  std::vector<std::size_t> under_;
  /// By file point: the line of the edge that begins there.
  std::vector<std::optional<EdgeLine>> lines_;
  /// By hull edge: the line along it.
  std::vector<std::optional<EdgeLine>> hull_lines_;
};

}  // namespace lekalo::verify
