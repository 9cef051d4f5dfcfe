#include <algorithm>
#include <bit>
#include <utility>

#include "cut_path.hpp"
#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// Squares are not divided below this side.
constexpr double kLeaf = 0.004;  // mm
/// Uncut spots are reported from this width on.
constexpr double kTold = 0.02;  // mm

using Numbers = std::vector<std::uint32_t>;

/// Step 8 of docs/design/simulate.md: divides squares until each is surely cut, surely not to be cut, or no
/// larger than kLeaf.
class Coverage {
 public:
  Coverage(const CutPath& path, const PocketReach& pocket, double radius, SimulateReport& report)
      : pocket_(pocket), radius_(radius), report_(report) {
    for (const std::vector<Cut>* cuts : {&path.before, &path.cuts}) {
      const std::vector<bool> again = repeated(*cuts);
      for (std::size_t i = 0; i < cuts->size(); ++i) {
        const Cut& cut = (*cuts)[i];
        if (again[i] || std::max(cut.from_z, cut.to_z) > path.deepest + kSameLevel) continue;
        floor_.push_back(cut.stroke);
        wider_.push_back(cut.radius - radius);
        widest_ = std::max(widest_, wider_.back());
      }
    }
    const Place pad{radius, radius};
    index_ = StrokeIndex(pocket.low() - pad, pocket.high() + pad, radius);
    for (std::size_t i = 0; i < floor_.size(); ++i) index_.add(static_cast<std::uint32_t>(i), floor_[i]);
  }

  void run() {
    const double side = radius_ / 2;
    const Place low = pocket_.low(), high = pocket_.high();
    Numbers cuts, limits;
    for (double y = low.y; y < high.y; y += side)
      for (double x = low.x; x < high.x; x += side) {
        ask();
        const Place middle{x + side / 2, y + side / 2};
        const double reach = radius_ + 2.2 * side;
        index_.near(middle, reach + widest_, cuts);
        pocket_.limit_index().near(middle, reach, limits);
        spot_ = {};
        look(middle, side, cuts, limits, false, cuts.empty() ? swept_at(middle) : kInfinity);
        if (spot_.width_mm > kTold) spots_.push_back(spot_);
      }
    tell_spots();
    report_.coverage_percent = 100 * (1 - report_.uncut_mm2 / report_.reachable_mm2);
    report_.coverage_low_percent = std::max(0.0, 100 * (1 - undecided_ / report_.reachable_mm2));
  }

 private:
  /// Returns the distance from what is cut, as if this tool had cut all of it along paths. A path that a
  /// wider tool cut counts as nearer by the difference of the radii. A place is cut where the distance is
  /// below this tool's radius.
  [[nodiscard]] double swept_at(Place p) const { return index_.nearest(p, floor_, wider_, widest_); }

  /// Returns the distance from `middle` to the nearest, and keeps those that may matter to the square.
  template <class Distance>
  static double nearest(double reach, const Numbers& from, Numbers& kept, Distance&& distance_of) {
    double least = kInfinity;
    for (const std::uint32_t i : from) {
      const double d = distance_of(i);
      least = std::min(least, d);
      if (d <= reach) kept.push_back(i);
    }
    return least;
  }

  /// \param farthest  a bound: no nearest cut is farther from the middle than this
  void look(Place middle, double side, const Numbers& cuts, const Numbers& limits, bool all_reachable,
            double farthest) {
    const double half = side * 0.7071067811865476;
    const bool beside_air = pocket_.air().from_borders(middle) < half;
    if ((!beside_air || side <= kLeaf) && pocket_.air().holds(middle)) return;
    Numbers near_cuts, near_limits;
    // The distance from the places where the tool's middle may be.
    double off = 0;
    if (!all_reachable) {
      off = nearest(radius_ + half, limits, near_limits,
                    [&](std::uint32_t i) { return distance(middle, pocket_.limit()[i]); });
      // The whole square is among these places, or none of it can be cut.
      if (near_limits.empty()) {
        if (!pocket_.allowed(middle)) return;
        off = 0;
      } else if (off > radius_ - half && pocket_.allowed(middle)) {
        off = 0;
      }
      if (off - half > radius_) return;
      all_reachable = off + half <= radius_;
    }
    // Cuts that are a little too far are kept, because they tell how wide a strip is that stays.
    const double swept =
        std::min(farthest, nearest(radius_ + 3 * half, cuts, near_cuts,
                                   [&](std::uint32_t i) { return distance(middle, floor_[i]) - wider_[i]; }));
    if (swept + half <= radius_ && (!beside_air || side <= kLeaf)) {
      if (all_reachable) {
        report_.reachable_mm2 += side * side;
        return;
      }
      if (side <= 16 * kLeaf) {
        report_.reachable_mm2 += side * side * share(radius_ - off, side);
        return;
      }
    }
    if (swept > radius_ + half && all_reachable && !beside_air) return add_uncut(middle, side);
    if (side <= kLeaf) return add_leaf(middle, side, off, swept);
    for (const Place corner : {Place{-1, -1}, Place{1, -1}, Place{-1, 1}, Place{1, 1}})
      look(middle + side / 4 * corner, side / 2, near_cuts, near_limits, all_reachable, swept + half);
  }

  /// Returns the part of a square on this side of a line that passes `past` beyond its middle.
  static double share(double past, double side) { return std::clamp(0.5 + past / side, 0.0, 1.0); }

  void add_uncut(Place middle, double side) {
    report_.reachable_mm2 += side * side;
    report_.uncut_mm2 += side * side;
    undecided_ += side * side;
    widen(middle, side);
  }

  /// Looks for the widest uncut place of a square, where it may be wider than the widest one known.
  void widen(Place middle, double side) {
    // No place can be wider, and a search for a path far away would take long.
    if (whole_ <= report_.uncut_width_mm) return;
    const double half = side * 0.7071067811865476, deep = swept_at(middle) - radius_;
    const double most = std::min(2 * (deep + half), whole_);
    spot(middle, 2 * deep);
    if (most <= report_.uncut_width_mm) return;
    if (side <= kLeaf || half <= 0.01 * deep) return widest(most);
    for (const Place corner : {Place{-1, -1}, Place{1, -1}, Place{-1, 1}, Place{1, 1}})
      widen(middle + side / 4 * corner, side / 2);
  }

  void add_leaf(Place middle, double side, double off, double swept) {
    const double half = side * 0.7071067811865476;
    const double reachable = share(radius_ - off, side), left = share(swept - radius_, side);
    report_.reachable_mm2 += side * side * reachable;
    report_.uncut_mm2 += side * side * std::max(0.0, reachable + left - 1);
    undecided_ += side * side;
    const double width =
        std::min({2 * (swept + half - radius_), (swept - radius_) + (radius_ - off) + 2 * half, whole_});
    widest(width);
    spot(middle, width);
  }

  void widest(double width) { report_.uncut_width_mm = std::max(report_.uncut_width_mm, width); }
  void spot(Place at, double width) {
    if (width > spot_.width_mm) spot_ = {at.x, at.y, std::min(width, whole_)};
  }

  void tell_spots() {
    constexpr std::size_t kMost = 1000;
    std::stable_sort(spots_.begin(), spots_.end(),
                     [](const UncutSpot& a, const UncutSpot& b) { return a.width_mm > b.width_mm; });
    for (const UncutSpot& s : spots_) {
      const bool apart = std::all_of(report_.uncut.begin(), report_.uncut.end(), [&](const UncutSpot& t) {
        return length(Place{s.x - t.x, s.y - t.y}) >= radius_;
      });
      if (apart && report_.uncut.size() < kMost) report_.uncut.push_back(s);
    }
  }

  const PocketReach& pocket_;
  double radius_;
  SimulateReport& report_;
  std::vector<Stroke> floor_;
  /// By stroke of the floor: its tool's radius less this one's.
  std::vector<double> wider_;
  double widest_ = 0;
  StrokeIndex index_;
  double undecided_ = 0;
  /// The size of the pocket, mm; no place is wider.
  double whole_ = length(pocket_.high() - pocket_.low());
  /// The widest spot of the square that is looked at.
  UncutSpot spot_;
  std::vector<UncutSpot> spots_;
};

/// A stroke with the depth of its middle, the signed distance from the outline.
struct Sounded {
  const Stroke* stroke;
  double half, middle;
  /// No place of the stroke is less deep.
  [[nodiscard]] double least() const { return middle - half; }
};
Sounded sounded(const Stroke& stroke, const PocketReach& pocket) {
  return {&stroke, 0.5 * length(stroke), pocket.depth(at_share(stroke, 0.5))};
}

/// Lowers `least` to the least depth of a stroke's places, rounded down, where that is less. It is exact to
/// rounding where the stroke is not near to crossing the outline, and otherwise within `step`.
void lower_to_depth(const Sounded& whole, const PocketReach& pocket, double& least,
                    std::vector<std::uint32_t>& near) {
  ask();
  constexpr double kSlack = 1e-9;  // more than rounding
  if (whole.least() > least + kSlack * (1 + std::abs(whole.middle))) return;
  // The whole stroke is inside.
  if (whole.least() > 0) {
    pocket.outline_index().near(at_share(*whole.stroke, 0.5), whole.middle + 2 * whole.half, near);
    for (const std::uint32_t i : near)
      least = std::min(least, distance_apart(*whole.stroke, pocket.outline()[i]));
    return;
  }
  constexpr double kStep = 1e-3;
  if (whole.half <= kStep) {
    least = std::min(least, whole.least());
    return;
  }
  const Place cut = at_share(*whole.stroke, 0.5);
  const Stroke before = until(*whole.stroke, cut), after = beginning(*whole.stroke, cut);
  Sounded first = sounded(before, pocket), second = sounded(after, pocket);
  if (second.least() < first.least()) std::swap(first, second);
  lower_to_depth(first, pocket, least, near);
  lower_to_depth(second, pocket, least, near);
}

}  // namespace

void measure_coverage(const CutPath& path, const PocketReach& pocket, double radius, SimulateReport& report) {
  Coverage(path, pocket, radius, report).run();
}

void measure_gouge(const CutPath& path, const PocketReach& pocket, SimulateReport& report) {
  double least = pocket.clearance();
  std::vector<Sounded> strokes;
  for (const Stroke& stroke : path.strokes) {
    ask();
    strokes.push_back(sounded(stroke, pocket));
  }
  // Those that may lie farthest outside come first. Of a path far away hardly any other is cut into parts.
  std::sort(strokes.begin(), strokes.end(),
            [](const Sounded& a, const Sounded& b) { return a.least() < b.least(); });
  std::vector<std::uint32_t> near;
  for (const Sounded& stroke : strokes) lower_to_depth(stroke, pocket, least, near);
  report.gouge_mm = pocket.clearance() - least;
}

void find_unreachable(const PocketReach& pocket, double radius, SimulateReport& report) {
  const Place low = pocket.low(), size = pocket.high() - low;
  const double step = std::max(radius / 12, std::max(size.x, size.y) / 2000);
  const auto columns = static_cast<std::size_t>(size.x / step) + 1,
             rows = static_cast<std::size_t>(size.y / step) + 1;
  std::vector<float> off(columns * rows, 0.0F);
  const auto place = [&](std::size_t i) {
    return low + step * Place{static_cast<double>(i % columns) + 0.5, static_cast<double>(i / columns) + 0.5};
  };
  // Step 10: a block is left alone when it lies wholly outside or wholly within reach of the tool, which its
  // middle tells when it is so by more than half the block's diagonal.
  constexpr double kSurely = 1e-5;  // mm
  const auto look = [&](const auto& self, std::size_t column, std::size_t row, std::size_t side) -> void {
    if (column >= columns || row >= rows) return;
    if (side == 1) {
      const std::size_t i = row * columns + column;
      const Place p = place(i);
      if (pocket.in_drawing(p)) off[i] = static_cast<float>(std::max(0.0, pocket.from_allowed(p) - radius));
      return;
    }
    const double wide = static_cast<double>(side) * step, half = 0.7071067811865476 * wide + kSurely;
    const Place middle = low + Place{step * static_cast<double>(column) + wide / 2,
                                     step * static_cast<double>(row) + wide / 2};
    if (pocket.depth(middle) < -half || pocket.from_allowed(middle) + half <= radius) return;
    for (const std::size_t k : {0U, 1U, 2U, 3U})
      self(self, column + (k & 1) * (side / 2), row + (k >> 1) * (side / 2), side / 2);
  };
  look(look, 0, 0, std::bit_ceil(std::max(columns, rows)));
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (!(off[i] > 0)) continue;
    UnreachableSpot spot;
    open.assign(1, i);
    const auto take = [&](std::size_t k) {
      spot.area_mm2 += step * step;
      if (off[k] > spot.distance_mm) {
        const Place p = place(k);
        spot.x = p.x, spot.y = p.y, spot.distance_mm = static_cast<double>(off[k]);
      }
      off[k] = 0;
    };
    take(i);
    while (!open.empty()) {
      ask();
      const std::size_t k = open.back();
      open.pop_back();
      const std::size_t column = k % columns, row = k / columns;
      for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(rows - 1, row + 1); ++r)
        for (std::size_t c = column == 0 ? 0 : column - 1; c <= std::min(columns - 1, column + 1); ++c)
          if (off[r * columns + c] > 0) {
            take(r * columns + c);
            open.push_back(r * columns + c);
          }
    }
    report.unreachable.push_back(spot);
  }
}

}  // namespace lekalo::verify
