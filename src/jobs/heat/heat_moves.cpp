#include "heat_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::jobs {
namespace {

/// Two stretches of the way that meet more sharply than this have no corner to be moved to: 1 + cosine.
constexpr double kSharpest = 0.35;
/// Two stretches make a corner where the sine of the angle between them is above this.
constexpr double kCorner = 0.3;

using FlatVector = std::array<double, 2>;

/// How far the way is moved at a place of it, um: with the workpiece, and to its left.
struct WayShift {
  std::size_t piece = 0;
  double at = 0;  ///< along the way, mm
  FlatVector with{};
  double left = 0;
};

/// A stretch of the way along walls without a lift.
struct MovedStretch {
  std::size_t first = 0, last = 0;  ///< pieces
  std::vector<WayShift> shifts;     ///< along it
};

FlatVector direction_at(const heat::ToolPiece& piece, bool end) {
  double x = piece.to[0] - piece.from[0], y = piece.to[1] - piece.from[1];
  if (piece.centre) {
    const auto& c = *piece.centre;
    const auto& p = end ? piece.to : piece.from;
    const double turn =
        (piece.from[0] - c[0]) * (piece.to[1] - c[1]) - (piece.from[1] - c[1]) * (piece.to[0] - c[0]);
    x = turn < 0 ? p[1] - c[1] : c[1] - p[1], y = turn < 0 ? c[0] - p[0] : p[0] - c[0];
  }
  const double length = std::hypot(x, y);
  return {x / length, y / length};
}

double across_length(const heat::ToolPiece& piece) {
  return std::hypot(piece.to[0] - piece.from[0], piece.to[1] - piece.from[1]);
}

class MovedWay {
 public:
  MovedWay(const std::vector<heat::ToolPiece>& pieces, double spacing, double radius)
      : pieces_(pieces), spacing_(spacing), radius_(radius) {
    ends_.reserve(pieces.size());
    double so_far = 0;
    for (const heat::ToolPiece& piece : pieces) ends_.push_back(so_far += across_length(piece));
  }

  void take(const std::vector<WallPasses>& stations) {
    std::vector<WayShift> shifts;
    for (const WallPasses& passes : stations)
      for (const WallPass& pass : passes) {
        if (!pass.finishing || !pass.across) continue;
        const heat::ToolPiece& piece = pieces_[pass.at.piece];
        const FlatVector way = direction_at(piece, pass.at.share > 0.5), to = pass.at.towards;
        const double side = -way[1] * to[0] + way[0] * to[1] > 0 ? 1 : -1;
        const double more = pass.moved - (pass.displaced[0] * to[0] + pass.displaced[1] * to[1]);
        shifts.push_back({pass.at.piece, ends_[pass.at.piece] - (1 - pass.at.share) * across_length(piece),
                          pass.displaced, side * more});
      }
    std::ranges::stable_sort(shifts, {}, [](const WayShift& s) { return std::pair(s.piece, s.at); });
    for (const WayShift& shift : shifts) {
      if (stretches_.empty() || !goes_on(stretches_.back(), shift.piece, shift.at))
        stretches_.push_back({shift.piece, shift.piece, {}});
      stretches_.back().last = shift.piece;
      stretches_.back().shifts.push_back(shift);
    }
  }

  [[nodiscard]] std::vector<nc::MovedMotion> motions() const {
    std::vector<FlatVector> by(pieces_.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      ask();
      while (next < stretches_.size() && stretches_[next].last < k) ++next;
      by[k] = moved_at(k, next);
    }
    std::vector<nc::MovedMotion> motions;
    for (std::size_t begin = 0, end = 0; begin < pieces_.size(); begin = end) {
      end = begin + 1;
      const std::size_t line = pieces_[begin].line;
      while (end < pieces_.size() && pieces_[end].line == line) ++end;
      if (line > 0) add_motion(begin, end, by, motions);
    }
    std::ranges::stable_sort(motions, {}, &nc::MovedMotion::line);
    return motions;
  }

 private:
  [[nodiscard]] bool goes_on(const MovedStretch& stretch, std::size_t piece, double at) const {
    // Round the corner of an island there is no place of a wall for half a turn of the tool at most.
    if (at - stretch.shifts.back().at > 2 * spacing_ + kTurn / 2 * radius_) return false;
    for (std::size_t k = stretch.last; k <= piece; ++k)
      if (pieces_[k].rapid || pieces_[k].line == 0 || !(across_length(pieces_[k]) > 0)) return false;
    return true;
  }

  /// The end of a piece is moved as its stretch is; between stretches that falls off to nothing.
  [[nodiscard]] FlatVector moved_at(std::size_t k, std::size_t next) const {
    if (next < stretches_.size() && stretches_[next].first <= k) return moved_in(stretches_[next], k);
    FlatVector sum{};
    double weights = 0;
    const auto add = [&](const MovedStretch& stretch, double away) {
      const double weight = std::clamp(1 - (away - spacing_) / radius_, 0.0, 1.0);
      if (!(weight > 0)) return;
      const FlatVector moved = moved_in(stretch, k);
      sum = {sum[0] + weight * moved[0], sum[1] + weight * moved[1]}, weights += weight;
    };
    if (next > 0) add(stretches_[next - 1], ends_[k] - stretches_[next - 1].shifts.back().at);
    if (next < stretches_.size()) add(stretches_[next], stretches_[next].shifts.front().at - ends_[k]);
    if (weights > 1) sum = {sum[0] / weights, sum[1] / weights};
    return sum;
  }

  /// In mm.
  [[nodiscard]] FlatVector moved_in(const MovedStretch& stretch, std::size_t k) const {
    const std::vector<WayShift>& shifts = stretch.shifts;
    if (const auto corner = moved_corner(shifts, k)) return *corner;
    const auto after = std::ranges::upper_bound(shifts, ends_[k], {}, &WayShift::at);
    WayShift shift = after == shifts.end() ? shifts.back() : *after;
    if (after != shifts.begin() && after != shifts.end()) {
      const WayShift& before = *std::prev(after);
      const double t = (ends_[k] - before.at) / (after->at - before.at);
      const auto mix = [t](double a, double b) { return a + t * (b - a); };
      shift = {k,
               ends_[k],
               {mix(before.with[0], after->with[0]), mix(before.with[1], after->with[1])},
               mix(before.left, after->left)};
    }
    const FlatVector corner = left_at(k);
    return {(shift.with[0] + shift.left * corner[0]) / 1000, (shift.with[1] + shift.left * corner[1]) / 1000};
  }

  /// Returns the direction to the left of a piece at its beginning or its end.
  [[nodiscard]] std::optional<FlatVector> left_of(std::size_t piece, bool end) const {
    if (piece >= pieces_.size() || pieces_[piece].rapid || !(across_length(pieces_[piece]) > 0)) return {};
    const FlatVector way = direction_at(pieces_[piece], end);
    return FlatVector{-way[1], way[0]};
  }

  /// Moves the corner in which a piece meets the next, mm: both lines are moved as far as the places beside
  /// each of them have it, and the corner is where they meet then. None where there is no corner.
  [[nodiscard]] std::optional<FlatVector> moved_corner(const std::vector<WayShift>& shifts,
                                                       std::size_t k) const {
    const auto here = left_of(k, true), there = left_of(k + 1, false);
    if (!here || !there) return {};
    const FlatVector &a = *here, &b = *there;
    const double sine = a[0] * b[1] - a[1] * b[0];
    if (1 + a[0] * b[0] + a[1] * b[1] < kSharpest) return {};
    const auto next = std::ranges::upper_bound(shifts, k, {}, &WayShift::piece);
    if (std::abs(sine) < kCorner || next == shifts.begin() || next == shifts.end()) return {};
    const auto across = [](const FlatVector& left, const WayShift& shift) {
      return left[0] * shift.with[0] + left[1] * shift.with[1] + shift.left;
    };
    const double by_a = across(a, *std::prev(next)), by_b = across(b, *next);
    return FlatVector{(by_a * b[1] - by_b * a[1]) / sine / 1000, (by_b * a[0] - by_a * b[0]) / sine / 1000};
  }

  /// Returns the vector that moves the end of a piece to the left of both it and the next piece by 1.
  [[nodiscard]] FlatVector left_at(std::size_t k) const {
    const auto here = left_of(k, true), there = left_of(k + 1, false);
    if (!here || !there) return here ? *here : there.value_or(FlatVector{});
    const double meet = 1 + (*here)[0] * (*there)[0] + (*here)[1] * (*there)[1];
    if (meet < kSharpest) return *here;
    return {((*here)[0] + (*there)[0]) / meet, ((*here)[1] + (*there)[1]) / meet};
  }

  void add_motion(std::size_t begin, std::size_t end, const std::vector<FlatVector>& by,
                  std::vector<nc::MovedMotion>& motions) const {
    double whole = 0, so_far = 0;
    for (std::size_t k = begin; k < end; ++k) whole += pieces_[k].length;
    if (!(whole > 0)) return;
    nc::MovedMotion motion{pieces_[begin].line, {}};
    for (std::size_t k = begin; k < end; ++k) {
      so_far += pieces_[k].length;
      const bool last = k + 1 == end;
      // A rapid goes straight to its moved end.
      if (!last && (pieces_[begin].rapid || !(pieces_[k].length > 0))) continue;
      motion.nodes.push_back({last ? 1 : so_far / whole, pieces_[k].to[2], by[k]});
    }
    const bool moves =
        std::ranges::any_of(motion.nodes, [](const nc::MovedNode& node) { return node.by != FlatVector{}; });
    if (moves) motions.push_back(std::move(motion));
  }

  const std::vector<heat::ToolPiece>& pieces_;
  double spacing_, radius_;
  std::vector<double> ends_;  ///< along the way, of each piece, mm
  std::vector<MovedStretch> stretches_;
};

}  // namespace

std::vector<nc::MovedMotion> moved_motions(const HeatFound& found, const std::vector<WallPasses>& stations,
                                           double tool_radius, double spacing) {
  MovedWay way(found.source.pieces, spacing, tool_radius);
  way.take(stations);
  return way.motions();
}

}  // namespace lekalo::jobs
