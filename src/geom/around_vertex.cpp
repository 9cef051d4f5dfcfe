#include "around_vertex.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom::detail {
namespace {

/// Two edges of which one is an arc are not ordered by directions closer than this, in radians, because their
/// ends were snapped.
constexpr double kNearlyParallel = 1e-4;

/// A half-edge as seen from its start.
struct Spoke {
  std::uint32_t half_edge = 0, end = 0;
  /// The direction at the start; an arc's is its tangent.
  Point direction;
  double chord = 0, height = 0;
  bool curved = false;
};

class Fan {
 public:
  Fan(const Arrangement& arrangement, std::uint32_t* begin, std::uint32_t* end) : a_(arrangement) {
    for (const std::uint32_t* h = begin; h != end; ++h) spokes_.push_back(spoke(*h));
    centre_ = a_.vertices[start_of(a_, *begin)];
  }

  void sort() {
    std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
      const bool a_left = is_left(a.direction), b_left = is_left(b.direction);
      if (a_left != b_left) return b_left;
      const int turned = orientation({}, a.direction, b.direction);
      return turned != 0 ? turned > 0 : a.half_edge < b.half_edge;
    });
    begin_between_far_ones();
    for (std::size_t i = 1; i < spokes_.size(); ++i)
      for (std::size_t j = i;
           j > 0 && near(spokes_[j - 1], spokes_[j]) && turn_of(spokes_[j - 1], spokes_[j]) < 0; --j)
        std::swap(spokes_[j - 1], spokes_[j]);
  }

  [[nodiscard]] const std::vector<Spoke>& spokes() const noexcept { return spokes_; }

 private:
  /// Says which of two groups a direction belongs to. Directions from straight down over the right to
  /// straight up come first, the others last.
  static bool is_left(Point d) noexcept { return d.x < 0 || (d.x == 0 && d.y > 0); }

  [[nodiscard]] Spoke spoke(std::uint32_t h) const {
    const Stretch& s = a_.stretches[a_.edges[h / 2].stretch];
    const Point from = a_.vertices[start_of(a_, h)], chord = a_.vertices[end_of(a_, h)] - from;
    Spoke made{h, end_of(a_, h), chord, norm(chord), h % 2 == 0 ? s.height : -s.height, s.curved};
    if (s.curved) {
      const Piece& piece = a_.pieces[s.piece];
      const bool left_turn = (piece.kind == EdgeKind::arc_ccw) == (h % 2 == 0);
      const Point tangent = perpendicular(from - piece.centre);
      made.direction = left_turn ? tangent : -tangent;
    }
    return made;
  }

  [[nodiscard]] bool near(const Spoke& a, const Spoke& b) const {
    if (!(dot(a.direction, b.direction) > 0)) return false;
    const double tolerance = std::max(kNearlyParallel, 8 * a_.snap / std::min(a.chord, b.chord));
    return std::abs(cross(a.direction, b.direction)) <= tolerance * norm(a.direction) * norm(b.direction);
  }

  /// Returns a positive number where b leaves on the left of a. That is decided where the two are furthest
  /// apart: the end of the shorter one lies further from the longer one than an edge passes from a vertex.
  [[nodiscard]] double turn_of(const Spoke& a, const Spoke& b) const {
    if (a.end == b.end) return b.height - a.height;
    if (!a.curved && !b.curved) return orientation(centre_, a_.vertices[a.end], a_.vertices[b.end]);
    return a.chord <= b.chord ? -side_of(b, a_.vertices[a.end]) : side_of(a, a_.vertices[b.end]);
  }
  [[nodiscard]] double side_of(const Spoke& spoke, Point p) const {
    const double left = side(a_.pieces[a_.stretches[a_.edges[spoke.half_edge / 2].stretch].piece], p);
    return spoke.half_edge % 2 == 0 ? left : -left;
  }

  void begin_between_far_ones() {
    const auto down = [](const Spoke& s) { return s.direction.y < 0; };
    if (!down(spokes_.front()) || !down(spokes_.back()) || !near(spokes_.back(), spokes_.front())) return;
    for (std::size_t k = 1; k < spokes_.size(); ++k) {
      if (near(spokes_[k - 1], spokes_[k])) continue;
      std::rotate(spokes_.begin(), spokes_.begin() + static_cast<std::ptrdiff_t>(k), spokes_.end());
      return;
    }
  }

  const Arrangement& a_;
  Point centre_;
  std::vector<Spoke> spokes_;
};

}  // namespace

void sort_counter_clockwise(const Arrangement& arrangement, std::uint32_t* begin, std::uint32_t* end) {
  if (end - begin < 2) return;
  Fan fan(arrangement, begin, end);
  fan.sort();
  for (const Spoke& s : fan.spokes()) *begin++ = s.half_edge;
}

}  // namespace lekalo::geom::detail
