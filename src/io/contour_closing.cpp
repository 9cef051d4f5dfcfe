#include "contour_closing.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Distances here are rounded by 3 u at most.
constexpr double kUp = 1 + 0x1p-50;
/// An arc whose end moves by h lies within this times h of what it was, both ways, if the conditions of
/// can_move hold: its mean radius changes by h / 2 (h if both ends move), its ends turn by at most
/// asin(h / r) about the centre, which is 1.26 h along the curve.
constexpr double kArcMoves = 2.5;

bool is_line(const Edge& edge) { return edge.kind == EdgeKind::line; }

bool is_consistent(const Edge& arc) {
  const double from = norm(arc.from - arc.centre), to = norm(arc.to - arc.centre);
  return std::abs(from - to) <= geom::kArcConsistency + geom::kArcConsistencyRelative * std::max(from, to);
}

/// Whether moving an end of the arc by half the gap keeps it nearly what it is. A short chord may belong to
/// an arc of nearly a full turn, which a moved end could turn into nothing.
bool can_move(const Edge& arc, double gap) {
  const double from = norm(arc.from - arc.centre), to = norm(arc.to - arc.centre);
  return norm(arc.to - arc.from) >= 8 * gap && std::max(from, to) <= 1.25 * std::min(from, to);
}

class Closing {
 public:
  explicit Closing(LooseContour& contour) : contour_(contour), line_after_(contour.edges.size(), false) {}

  std::vector<ClosedGap> run() {
    const std::size_t n = contour_.edges.size();
    for (std::size_t i = 0; i < n; ++i) close(i, i + 1 == n ? 0 : i + 1);
    rebuild();
    return std::move(gaps_);
  }

 private:
  void close(std::size_t i, std::size_t next) {
    Edge &a = contour_.edges[i], &b = contour_.edges[next];
    const Point p = a.to, q = b.from;
    if (p == q) return;
    ClosedGap gap{0.5 * (p + q), norm(q - p) * kUp, contour_.curves[i], contour_.curves[next], 0, 0};
    const double to_middle = std::max(norm(gap.at - p), norm(gap.at - q)) * kUp;
    if (is_line(a) && is_line(b)) {
      a.to = b.from = gap.at;
      gap.moved_before = gap.moved_after = to_middle;
    } else if (is_line(a)) {
      a.to = q;
      gap.moved_before = gap.size;
    } else if (is_line(b)) {
      b.from = p;
      gap.moved_after = gap.size;
    } else if (i != next && arcs_meet(a, b, gap)) {
      gap.moved_before = gap.moved_after = kArcMoves * to_middle;
    } else {
      line_after_[i] = true;
      gap.moved_before = to_middle;
    }
    gaps_.push_back(gap);
  }

  static bool arcs_meet(Edge& a, Edge& b, const ClosedGap& gap) {
    if (!can_move(a, gap.size) || !can_move(b, gap.size)) return false;
    Edge moved_a = a, moved_b = b;
    moved_a.to = moved_b.from = gap.at;
    if (!is_consistent(moved_a) || !is_consistent(moved_b)) return false;
    a = moved_a;
    b = moved_b;
    return true;
  }

  void rebuild() {
    LooseContour made;
    for (std::size_t i = 0; i < contour_.edges.size(); ++i) {
      const Edge& edge = contour_.edges[i];
      if (!is_line(edge) || edge.from != edge.to) {
        made.edges.push_back(edge);
        made.curves.push_back(contour_.curves[i]);
      }
      if (!line_after_[i]) continue;
      const Point next = contour_.edges[i + 1 == contour_.edges.size() ? 0 : i + 1].from;
      made.edges.push_back({EdgeKind::line, edge.to, next, {}});
      made.curves.push_back(contour_.curves[i]);
    }
    contour_ = std::move(made);
  }

  LooseContour& contour_;
  std::vector<bool> line_after_;
  std::vector<ClosedGap> gaps_;
};

}  // namespace

std::vector<ClosedGap> close_gaps(LooseContour& contour) { return Closing(contour).run(); }

}  // namespace lekalo::io
