#include "fronts.hpp"

#include <algorithm>
#include <cmath>

#include "arrival.hpp"
#include "corridors.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "load.hpp"
#include "mill/path/edge_path.hpp"
#include "step_law.hpp"

namespace lekalo::mill {
namespace {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;
using geom::RegionIndex;

constexpr double kSpacing = 0.3;    // mm between places at which a boundary is compared with the one before
constexpr double kOnIt = 2e-4;      // mm: a place nearer to what is cut than this is cut
constexpr double kLeastGap = 4e-3;  // mm: a stretch that is nowhere farther from it than this is no front
constexpr double kOnWall = 1e-6;    // mm
constexpr double kMouth = 1.5;      // of the strip: what is farther from the walls is a corridor's mouth
constexpr std::size_t kMostLayers = 20000;
constexpr double kPitch = 0.07;  // of the tool's radius
constexpr double kMostNodes = 6e5;
constexpr double kLeastShare = 0.3;

// Step 5 of docs/design/pocket.md, as shares of the angle of a straight pass: what a layer is to hold, what a
// part of its length may reach, and what counts as far too much.
constexpr double kHeldByFront = 1.02, kPeak = 1.185, kFarBeyond = 1.287;
constexpr double kBeyond = 0.07;    // of the length: how much of it may pass kHeldByFront
constexpr double kLookEvery = 0.2;  // of the tool's radius
constexpr int kMostTrials = 6;
/// A pass leaves a wall on an arc that begins and ends at most this share of the step from where it would
/// leave without one.
constexpr double kCorner = 1.2;
constexpr double kShortRun = 2;          // of the step: a way along a wall that two passes may share
constexpr double kLeft = 0.75;           // of the step: what a pass may leave at a wall
constexpr double kTouching = 0.05;       // of the tool's radius
constexpr double kNearlyTangent = 0.94;  // cosine of 20 degrees

bool on_wall(const Edge& edge, const FieldWalls& walls) {
  const Point middle = place_at(edge, 0.5);
  for (const Point p : {middle, edge.from, edge.to})
    if (!(walls.fields.nearest(p).distance < kOnWall)) return false;
  return !walls.narrow.contains(middle) || walls.limit.nearest(middle).distance < kMouth * walls.strip;
}

bool is_fresh(Point p, const RegionIndex& before) {
  return before.nearest(p).distance > kOnIt && !before.contains(p);
}

/// The parts of an edge that are not cut yet, as shares of its length.
std::vector<std::pair<double, double>> fresh_parts(const Edge& edge, const RegionIndex& before) {
  std::vector<std::pair<double, double>> parts;
  const double pieces = std::max(1.0, std::ceil(length_of(edge) / kSpacing));
  const auto change = [&](double low, double high, bool fresh_low) {
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (is_fresh(place_at(edge, middle), before) == fresh_low ? low : high) = middle;
    }
    return fresh_low ? low : high;
  };
  // An edge that is one piece is looked at in its middle as well.
  const double count = std::max(2.0, pieces);
  bool last = is_fresh(edge.from, before);
  double begin = 0;
  for (double i = 1; i <= count; ++i) {
    const bool now = is_fresh(place_at(edge, i / count), before);
    if (now != last) {
      const double at = change((i - 1) / count, i / count, last);
      if (now)
        begin = at;
      else if (at > begin)
        parts.emplace_back(begin, at);
    }
    last = now;
  }
  if (last && begin < 1) parts.emplace_back(begin, 1.0);
  return parts;
}

void add_fronts(const Contour& contour, const RegionIndex& before, std::vector<Front>& fronts) {
  std::vector<Front> found;
  bool joins = false;  // the last ends where an edge ends
  for (const Edge& edge : contour) {
    const auto parts = fresh_parts(edge, before);
    if (parts.empty()) joins = false;
    for (const auto& [from, to] : parts) {
      if (!(joins && from == 0)) found.emplace_back();
      found.back().edges.push_back(from == 0 && to == 1 ? edge : part_of(edge, from, to));
      joins = to == 1;
    }
  }
  if (joins && !found.empty() && found.front().edges.front().from == contour.front().from) {
    if (found.size() == 1) {
      found[0].closed = true;
    } else {
      Front& last = found.back();
      last.edges.insert(last.edges.end(), found.front().edges.begin(), found.front().edges.end());
      found.erase(found.begin());
    }
  }
  for (Front& front : found) {
    double gap = 0;
    for (const Point p : places_on(front.edges, kSpacing)) gap = std::max(gap, before.nearest(p).distance);
    if (gap < kLeastGap) continue;
    fronts.push_back(std::move(front));
  }
}

class Grower {
 public:
  Grower(const RegionIndex& limit, const std::vector<Region>& fields, const std::vector<Region>& narrow,
         const GrowthLaw& law, const AreaListener& listener)
      : limit_(limit),
        fields_(fields),
        narrow_(narrow),
        walls_(fields),
        corridors_(narrow),
        bounds_{walls_, limit, corridors_, law.wall_strip},
        law_(law),
        degrees_(law.angle / kDegree),
        listener_(listener),
        r_(law.tool_radius),
        step_(law.step) {}

  Result<Growth> run(const std::vector<Region>& start) {
    growth_.cut.push_back(start);
    for (;;) {
      LEKALO_CHECK(grow_fields());
      LEKALO_TRY(auto filled, fill());
      if (!filled) break;
    }
    return std::move(growth_);
  }

 private:
  /// Grows through the fields by level lines of the arrival time, and says whether there were fronts.
  Result<bool> grow_fields() {
    if (fields_.empty()) return false;
    const std::size_t first = growth_.fronts.size();
    const geom::Box box = walls_.bounds();
    const double area = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    const double pitch = std::max(kPitch * r_, std::sqrt(area / kMostNodes));
    const ArrivalField field(walls_, growth_.cut.back(), pitch,
                             {.tool_radius = r_,
                              .step = step_,
                              .cosine = geom::sincos(kNext * law_.angle).cosine,
                              .beyond = law_.wall_strip});
    double time = 0, share = 1;
    bool held = true;
    for (std::size_t layer = 0; layer < kMostLayers && time <= field.last(); ++layer) {
      const RegionIndex before(growth_.cut.back());
      std::vector<Region> cut;
      std::vector<Front> fronts;
      if (held) share = std::min(1.0, 1.06 * share);
      held = true;
      for (int trial = 0;; ++trial) {
        ask();
        LEKALO_TRY(auto tried, reached_by(field, time + share));
        cut = std::move(tried);
        fronts = split_at_walls(fresh_stretches(cut, before), before);
        const double less = relief(fronts, before);
        if (less >= 1 || trial == kMostTrials || share <= kLeastShare) break;
        share = std::max(kLeastShare, share * less);
        held = false;
      }
      time += share;
      if (fronts.empty()) continue;
      add(std::move(fronts), before);
      growth_.cut.push_back(std::move(cut));
      listener_(geom::area(growth_.cut.back()));
    }
    return growth_.fronts.size() > first;
  }

  /// Grows through corridors hardly wider than the tool by loops, and says whether there were any.
  Result<bool> fill() {
    if (narrow_.empty()) return false;
    std::vector<Front> fronts = corridor_loops(limit_, corridors_, growth_.cut.back(), growth_.fronts, law_);
    if (fronts.empty()) return false;
    std::vector<Region> pieces = growth_.cut.back();
    for (const Front& front : fronts) {
      ask(1 + front.edges.size());
      if (!front.loop) continue;
      const Edge& arc = front.edges.front();
      LEKALO_TRY(auto disc, geom::make_region({{EdgeKind::arc_ccw, arc.from, arc.from, arc.centre}}));
      pieces.push_back(std::move(disc));
    }
    LEKALO_TRY(auto all, geom::united(pieces));
    const RegionIndex before(growth_.cut.back());
    const std::size_t first = growth_.fronts.size();
    for (Front& front : fronts) {
      for (std::size_t& parent : front.parents) parent += first;
      front.layer = growth_.cut.size();
      growth_.fronts.push_back(std::move(front));
    }
    for (std::size_t i = first; i < growth_.fronts.size(); ++i)
      if (growth_.fronts[i].parents.empty()) find_parents(i, first, before);
    growth_.cut.push_back(std::move(all.regions));
    return true;
  }

  /// Lets a ring begin at its place nearest to what is cut; false where no place is near.
  bool begin_where_it_touches(Front& front, const RegionIndex& before) const {
    double gap = kTouching * r_;
    std::size_t begin = front.edges.size();
    double share = 0;
    for (std::size_t i = 0; i < front.edges.size(); ++i) {
      const double pieces = std::max(1.0, std::ceil(length_of(front.edges[i]) / kSpacing));
      for (double k = 0; k < pieces; ++k)
        if (const double d = before.nearest(place_at(front.edges[i], k / pieces)).distance; d < gap)
          gap = d, begin = i, share = k / pieces;
    }
    if (begin == front.edges.size()) return false;
    std::rotate(front.edges.begin(), front.edges.begin() + static_cast<std::ptrdiff_t>(begin),
                front.edges.end());
    if (share > 0) {
      const Edge first = front.edges.front();
      front.edges.front() = part_of(first, share, 1);
      front.edges.push_back(part_of(first, 0, share));
    }
    return true;
  }

  /// Cuts a way along a wall off where it touches what is cut, and returns what lies behind; nothing where it
  /// does not touch.
  std::vector<Edge> behind_touch(std::vector<Edge>& along, const RegionIndex& before) const {
    double gap = kTouching * r_;
    std::size_t at = along.size();
    double share = 0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      const double pieces = std::max(1.0, std::ceil(length_of(along[i]) / kSpacing));
      for (double k = 0; k < pieces; ++k)
        if (const double d = before.nearest(place_at(along[i], k / pieces)).distance; d < gap)
          gap = d, at = i, share = k / pieces;
    }
    if (at == along.size()) return {};
    std::vector<Edge> behind{share > 0 ? part_of(along[at], share, 1) : along[at]};
    behind.insert(behind.end(), along.begin() + static_cast<std::ptrdiff_t>(at) + 1, along.end());
    const Edge cut = along[at];
    along.resize(at);
    if (share > 0) along.push_back(part_of(cut, 0, share));
    return behind;
  }

  /// Divides passes where they meet a wall on their way, and lets rings begin where they touch what is cut.
  std::vector<Front> split_at_walls(std::vector<Front> given, const RegionIndex& before) const {
    std::vector<Front> fronts;
    for (Front& front : given) {
      std::vector<char> wall;
      for (const Edge& edge : front.edges) wall.push_back(on_wall(edge, bounds_) ? 1 : 0);
      if (front.closed) {
        if (!begin_where_it_touches(front, before)) {
          fronts.push_back(std::move(front));
          continue;
        }
        wall.clear();
        for (const Edge& edge : front.edges) wall.push_back(on_wall(edge, bounds_) ? 1 : 0);
        front.closed = false;
      }
      const std::size_t n = wall.size();
      Front part;
      for (std::size_t i = 0; i < n;) {
        std::size_t k = i;
        double run = 0;
        while (k < n && wall[k] != 0) run += length_of(front.edges[k++]);
        std::vector<Edge> along(front.edges.begin() + static_cast<std::ptrdiff_t>(i),
                                front.edges.begin() + static_cast<std::ptrdiff_t>(k));
        std::vector<Edge> next = along;
        if (const bool between = i > 0 && k > i && k < n; between && run >= kShortRun * step_)
          next = behind_touch(along, before);
        else if (!between)
          next.clear();
        part.edges.insert(part.edges.end(), along.begin(), along.end());
        if (!next.empty()) {
          fronts.push_back(std::move(part));
          part = {};
          part.edges = std::move(next);
        }
        i = k;
        while (i < n && wall[i] == 0) part.edges.push_back(front.edges[i++]);
      }
      fronts.push_back(std::move(part));
    }
    return fronts;
  }

  Result<std::vector<Region>> reached_by(const ArrivalField& field, double time) const {
    std::vector<Region> cut = fields_;
    if (time <= field.last() || !field.reaches_all()) {
      LEKALO_TRY(auto early, field.before(time));
      LEKALO_TRY(auto inside, geom::combine(early, fields_, geom::BooleanOperation::intersect));
      cut = std::move(inside.regions);
    }
    if (narrow_.empty()) return cut;
    LEKALO_TRY(auto all, geom::combine(cut, growth_.cut.back(), geom::BooleanOperation::unite));
    return std::move(all.regions);
  }

  /// The share of the step that would hold the angle; 1 where it is held in both directions.
  [[nodiscard]] double relief(const std::vector<Front>& fronts, const RegionIndex& before) const {
    double length = 0, beyond = 0, largest = 0;
    for (const Front& front : fronts)
      for (const bool back : {false, true}) {
        const Load load = load_of(pass_along(front, back, bounds_, before, step_), back, before, r_,
                                  kHeldByFront * degrees_, kLookEvery * r_);
        length += load.length, beyond += load.beyond;
        largest = std::max(largest, load.largest);
      }
    if (beyond <= kBeyond * length && largest <= kPeak * degrees_) return 1;
    return largest > kFarBeyond * degrees_ ? 0.85 : 0.93;
  }

  void add(std::vector<Front> fronts, const RegionIndex& before) {
    const std::size_t first = growth_.fronts.size();
    for (Front& front : fronts) {
      front.layer = growth_.cut.size();
      growth_.fronts.push_back(std::move(front));
    }
    for (std::size_t i = first; i < growth_.fronts.size(); ++i) find_parents(i, first, before);
  }

  void find_parents(std::size_t number, std::size_t first, const RegionIndex& before) {
    while (places_.size() < growth_.fronts.size()) {
      places_.push_back(places_on(growth_.fronts[places_.size()].edges, 0.5 * kSpacing));
      Box box{places_.back()[0], places_.back()[0]};
      for (const Point p : places_.back()) box.add(p);
      boxes_.push_back(box);
    }
    Front& front = growth_.fronts[number];
    const std::vector<Point>& at = places_[number];
    constexpr double kReach = 0.25 * kSpacing + 1e-3;
    for (std::size_t i = 0; i < at.size(); i += 2) {
      const Point p = before.nearest(at[i]).point;
      for (std::size_t parent = first; parent-- > 0;) {
        if (!boxes_[parent].holds(p, kReach)) continue;
        bool near = false;
        for (std::size_t k = 0; k < places_[parent].size() && !near; ++k)
          near = norm(places_[parent][k] - p) < kReach;
        if (!near) continue;
        if (std::find(front.parents.begin(), front.parents.end(), parent) == front.parents.end())
          front.parents.push_back(parent);
        break;
      }
    }
  }

  struct Box {
    Point low, high;
    void add(Point p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    [[nodiscard]] bool holds(Point p, double reach) const {
      return p.x >= low.x - reach && p.x <= high.x + reach && p.y >= low.y - reach && p.y <= high.y + reach;
    }
  };

  const RegionIndex& limit_;
  const std::vector<Region>&fields_, &narrow_;
  const RegionIndex walls_, corridors_;  ///< of the fields and of what is narrow
  const FieldWalls bounds_;
  GrowthLaw law_;
  double degrees_;  ///< of a straight pass
  const AreaListener& listener_;
  double r_, step_;
  Growth growth_;
  std::vector<std::vector<Point>> places_;  ///< of each front
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<Front> fresh_stretches(const std::vector<Region>& cut, const RegionIndex& before) {
  std::vector<Front> fronts;
  for (const Region& region : cut) {
    add_fronts(region.outer, before, fronts);
    for (const Contour& hole : region.holes) add_fronts(hole, before, fronts);
  }
  return fronts;
}

/// Replaces the corner before edges[corner] by an arc that begins and ends at the same distance from it, and
/// is tangent where it begins; nothing where it would not be nearly tangent at its end.
std::vector<Edge> around_corner(const std::vector<Edge>& edges, std::size_t corner, double reach) {
  double before = reach, after = reach;
  std::size_t leave = corner - 1, meet = corner;
  while (leave > 0 && length_of(edges[leave]) <= before) before -= length_of(edges[leave--]);
  while (meet + 1 < edges.size() && length_of(edges[meet]) <= after) after -= length_of(edges[meet++]);
  const double first = length_of(edges[leave]), last = length_of(edges[meet]);
  if (!(after < 0.98 * last)) return {};
  const double at = std::max(0.0, 1 - before / first);
  const Point from = place_at(edges[leave], at);
  const Point way = heading_at(edges[leave], from);
  const Edge rest = part_of(edges[meet], after / last, 1);
  const Point chord = rest.from - from;
  const double off = cross(way, chord);
  if (!(dot(way, chord) > 0) || std::abs(off) < 1e-3 * norm(chord)) return {};
  const Point centre = from + (dot(chord, chord) / (2 * off)) * perpendicular(way);
  const Edge arc{off > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, from, rest.from, centre};
  if (dot(heading_at(arc, rest.from), heading_at(rest, rest.from)) < kNearlyTangent) return {};
  std::vector<Edge> smooth(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(leave));
  if (at > 1e-9) smooth.push_back(part_of(edges[leave], 0, at));
  smooth.push_back(arc);
  smooth.push_back(rest);
  smooth.insert(smooth.end(), edges.begin() + static_cast<std::ptrdiff_t>(meet) + 1, edges.end());
  return smooth;
}

std::vector<Edge> pass_along(const Front& front, bool back, const FieldWalls& walls,
                             const RegionIndex& before, double step) {
  std::vector<Edge> edges = back ? geom::reversed(front.edges) : front.edges;
  if (front.closed) return edges;
  std::size_t begin = 0, end = edges.size();
  double run = 0, gap = 0;
  while (end > 1 && on_wall(edges[end - 1], walls)) {
    --end;
    run += length_of(edges[end]);
    for (const double share : {0.0, 0.5})
      gap = std::max(gap, before.nearest(place_at(edges[end], share)).distance);
  }
  if (run < kShortRun * step && gap < kLeft * step) edges.resize(end);
  run = 0;
  while (begin < edges.size() && on_wall(edges[begin], walls)) run += length_of(edges[begin++]);
  if (begin == 0 || begin == edges.size()) return edges;
  double reach = std::min(run, kCorner * step);
  for (int trial = 0; trial < 3; ++trial, reach /= 2)
    if (auto smooth = around_corner(edges, begin, reach); !smooth.empty()) return smooth;
  return edges;
}

Result<Growth> grow(const RegionIndex& limit, const std::vector<Region>& fields,
                    const std::vector<Region>& narrow, const std::vector<Region>& start, const GrowthLaw& law,
                    const AreaListener& listener) {
  return Grower(limit, fields, narrow, law, listener).run(start);
}

}  // namespace lekalo::mill
