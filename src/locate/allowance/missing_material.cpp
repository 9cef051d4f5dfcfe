#include <algorithm>
#include <cmath>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/locate/edge_allowance.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;
using geom::RegionIndex;

constexpr double kRelative = 1.0 / 64;

/// A search over the part by a quadtree, the most promising square first.
class Missing {
 public:
  Missing(const std::vector<geom::Region>& part, const std::vector<geom::Region>& blank,
          const geom::BlankFromPart& pose)
      : part_(part), blank_(blank), pose_(pose) {}

  /// Returns the deepest place that is not in the discs, unless nothing there reaches `least`.
  [[nodiscard]] std::optional<MissingPlace> deepest(const std::vector<MissingPlace>& before, double apart,
                                                    double least) const {
    MissingPlace best;
    std::vector<Square> open;
    const auto add = [&](Point centre, double half) {
      const double radius = 1.4142135623730952 * half;
      const auto covered = [&](const MissingPlace& place) {
        return norm(centre - place.in_part) + radius <= apart;
      };
      if (std::any_of(before.begin(), before.end(), covered)) return;
      Point point = centre;
      if (!part_.contains(centre)) {
        const RegionIndex::Nearest nearest = part_.nearest(centre);
        if (nearest.distance > radius) return;
        point = nearest.point;
      }
      const double most = outside(centre) + radius;
      if (!(most > enough(best.depth, least))) return;
      const double depth = point == centre ? most - radius : outside(point);
      const auto taken = [&](const MissingPlace& place) { return norm(point - place.in_part) <= apart; };
      if (depth > best.depth && std::none_of(before.begin(), before.end(), taken))
        best = {point, pose_(point), depth};
      open.push_back({centre, half, most});
      std::push_heap(open.begin(), open.end());
    };
    const geom::Box box = part_.bounds();
    add(0.5 * (box.low + box.high), 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y));
    for (std::size_t step = 0; step < kMostSplits && !open.empty(); ++step) {
      ask();
      const Square square = open.front();
      if (!(square.most > enough(best.depth, least))) break;
      std::pop_heap(open.begin(), open.end());
      open.pop_back();
      const double quarter = 0.5 * square.half;
      for (const double dx : {-quarter, quarter})
        for (const double dy : {-quarter, quarter}) add(square.centre + Point{dx, dy}, quarter);
    }
    if (!(best.depth > least)) return std::nullopt;
    return best;
  }

 private:
  struct Square {
    Point centre;
    double half = 0, most = 0;
    friend bool operator<(const Square& a, const Square& b) { return a.most < b.most; }
  };
  static double enough(double depth, double least) { return depth + std::max(least, kRelative * depth); }
  [[nodiscard]] double outside(Point in_part) const {
    const Point p = pose_(in_part);
    const double distance = blank_.nearest(p).distance;
    return blank_.contains(p) ? -distance : distance;
  }

  RegionIndex part_, blank_;
  geom::BlankFromPart pose_;
};

}  // namespace

std::vector<MissingPlace> missing_material(const std::vector<geom::Region>& part,
                                           const std::vector<geom::Region>& blank,
                                           const geom::BlankFromPart& pose, std::size_t most, double apart,
                                           double tolerance) {
  const Missing search(part, blank, pose);
  std::vector<MissingPlace> places;
  while (places.size() < most) {
    const std::optional<MissingPlace> place = search.deepest(places, apart, tolerance);
    if (!place) break;
    places.push_back(*place);
  }
  return places;
}

}  // namespace lekalo::locate
