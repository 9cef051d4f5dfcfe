#include "level_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::mill {
namespace {

using geom::Point;
using geom::Region;
constexpr double kSpacing = 0.25;    // mm between places of a front
constexpr double kLeastGap = 0.005;  // mm: a boundary nearer to what is cut than this is cut
constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::size_t kMostLayers = 5000;

struct Front {
  std::vector<Point> at;      ///< on the new boundary
  std::vector<Point> before;  ///< the nearest places cut before, of each
  bool closed = false;
  std::vector<std::size_t> parents;
  bool done = false;
};

/// Step from a front of convex radius R0 that holds the angle of a straight pass a_e:
/// (R0 + r)^2 = R1^2 + r^2 + 2 R1 r cos(alpha), cos(alpha) = 1 - a_e / r.
double held_step(double r0, double r, double step_over) {
  const double b = r * (1 - step_over / r);
  return -b + std::sqrt(b * b + (r0 + r) * (r0 + r) - r * r) - r0;
}

void sample_edge(const geom::Edge& edge, std::vector<Point>& points) {
  const bool arc = edge.kind != geom::EdgeKind::line;
  const double sweep = arc ? arc_sweep(edge) : 0;
  const double length = arc ? sweep * arc_radius(edge) : norm(edge.to - edge.from);
  const double pieces = std::max(1.0, std::ceil(length / kSpacing));
  for (double i = 0; i < pieces; ++i) {
    if (!arc) {
      points.push_back(edge.from + (i / pieces) * (edge.to - edge.from));
      continue;
    }
    const auto [sine, cosine] =
        geom::sincos((edge.kind == geom::EdgeKind::arc_ccw ? sweep : -sweep) * i / pieces);
    const Point out = edge.from - edge.centre;
    points.push_back(edge.centre + cosine * out + sine * perpendicular(out));
  }
}

class Clearing {
 public:
  Clearing(std::vector<Region> allowed, const PocketOptions& o)
      : o_(o),
        radius_(o.tool_diameter / 2),
        step_(o.step_over * o.tool_diameter),
        allowed_(std::move(allowed)),
        limit_(allowed_) {}

  Result<PocketPath> run() {
    make_grid();
    if (auto entered = choose_entry(); !entered) return tl::unexpected(entered.error());
    if (auto grown = grow(); !grown) return tl::unexpected(grown.error());
    make_ramp();
    enter();
    cut_fronts();
    finish();
    lift();
    return std::move(path_);
  }

 private:
  // ---- grid of places, for links
  void make_grid() {
    const geom::Box box = limit_.bounds();
    pitch_ = std::max(0.08 * radius_, std::max(box.high.x - box.low.x, box.high.y - box.low.y) / 600);
    low_ = box.low - Point{pitch_, pitch_};
    columns_ = static_cast<std::size_t>((box.high.x - box.low.x) / pitch_) + 4;
    rows_ = static_cast<std::size_t>((box.high.y - box.low.y) / pitch_) + 4;
    owner_.assign(columns_ * rows_, kNone);
  }
  [[nodiscard]] Point node(std::size_t n) const {
    return low_ + pitch_ * Point{static_cast<double>(n % columns_), static_cast<double>(n / columns_)};
  }
  [[nodiscard]] bool open(std::size_t n) const {
    return owner_[n] != kNone && (owner_[n] == 0 || fronts_[owner_[n] - 1].done);
  }

  // ---- entry: the deepest place, a disc of some of the tool's radius about it
  Result<void> choose_entry() {
    double deepest = -1;
    for (std::size_t n = 0; n < owner_.size(); ++n) {
      const Point p = node(n);
      if (!limit_.contains(p)) continue;
      const double depth = limit_.nearest(p).distance;
      if (depth > deepest) deepest = depth, entry_ = p;
    }
    if (deepest < 0) {  // narrower than the grid: a place on its boundary
      entry_ = limit_.curves()[0].edge.from;
      deepest = 0;
    }
    helix_ = std::min(0.8 * radius_, 0.98 * deepest);
    return {};
  }

  // ---- layers
  Result<void> grow() {
    const Point side{helix_, 0};
    std::vector<Region> cut;
    if (helix_ > 0.01) {
      auto disc = geom::make_region({{geom::EdgeKind::arc_ccw, entry_ + side, entry_ + side, entry_}});
      if (!disc) return tl::unexpected(disc.error());
      cut = {*disc};
    } else {
      helix_ = 0;
      const double tiny = 0.01;
      auto square = geom::make_region(
          {{geom::EdgeKind::arc_ccw, entry_ + Point{tiny, 0}, entry_ + Point{tiny, 0}, entry_}});
      if (!square) return tl::unexpected(square.error());
      auto clipped = geom::combine({*square}, allowed_, geom::BooleanOperation::intersect);
      if (!clipped) return tl::unexpected(clipped.error());
      cut = clipped->regions;
    }
    own_nodes(cut, 0, 0);
    double grown = helix_;
    std::vector<std::size_t> last;
    for (std::size_t layer = 0; layer < kMostLayers && !cut.empty(); ++layer) {
      const double step = held_step(grown, radius_, step_);
      auto wider = geom::offset(cut, step);
      if (!wider) return tl::unexpected(wider.error());
      auto next =
          geom::combine(wider->regions, allowed_, geom::BooleanOperation::intersect, wider->edge_error);
      if (!next) return tl::unexpected(next.error());
      const geom::RegionIndex before(cut);
      const std::size_t first = fronts_.size();
      for (const Region& region : next->regions) {
        add_fronts(region.outer, before);
        for (const geom::Contour& hole : region.holes) add_fronts(hole, before);
      }
      if (first == fronts_.size()) break;
      find_parents(first, last, step);
      own_nodes(next->regions, first, fronts_.size());
      last.clear();
      for (std::size_t i = first; i < fronts_.size(); ++i) last.push_back(i);
      cut = std::move(next->regions);
      grown += step;
    }
    path_.fronts = fronts_.size();
    return {};
  }

  /// Stretches of a contour that are not nearly cut yet.
  void add_fronts(const geom::Contour& contour, const geom::RegionIndex& before) {
    std::vector<Point> points;
    for (const geom::Edge& edge : contour) sample_edge(edge, points);
    const std::size_t n = points.size();
    std::vector<Point> nearest(n);
    std::vector<char> fresh(n);
    std::size_t some_old = n;
    for (std::size_t i = 0; i < n; ++i) {
      const auto near = before.nearest(points[i]);
      nearest[i] = near.point;
      fresh[i] = near.distance > kLeastGap && !before.contains(points[i]);
      if (!fresh[i]) some_old = i;
    }
    if (some_old == n) {
      Front front{points, nearest, true, {}, false};
      front.at.push_back(points[0]), front.before.push_back(nearest[0]);
      fronts_.push_back(std::move(front));
      return;
    }
    Front front;
    for (std::size_t k = 1; k <= n; ++k) {
      const std::size_t i = (some_old + k) % n;
      if (fresh[i]) {
        if (front.at.empty()) {
          const std::size_t b = (i + n - 1) % n;
          front.at.push_back(points[b]), front.before.push_back(nearest[b]);
        }
        front.at.push_back(points[i]), front.before.push_back(nearest[i]);
      } else if (!front.at.empty()) {
        front.at.push_back(points[i]), front.before.push_back(nearest[i]);
        fronts_.push_back(std::move(front));
        front = {};
      }
    }
  }

  void find_parents(std::size_t first, const std::vector<std::size_t>& last, double step) {
    for (std::size_t i = first; i < fronts_.size(); ++i) {
      for (const std::size_t p : last) {
        bool near = false;
        for (std::size_t a = 0; a < fronts_[i].before.size() && !near; a += 2)
          for (std::size_t b = 0; b < fronts_[p].at.size() && !near; b += 2)
            near = norm(fronts_[i].before[a] - fronts_[p].at[b]) < 0.5 * step;
        if (near) fronts_[i].parents.push_back(p);
      }
    }
  }

  /// Nodes that came in with this layer belong to the nearest of its fronts (number + 1), or to the entry
  /// (0).
  void own_nodes(const std::vector<Region>& regions, std::size_t first, std::size_t last) {
    if (regions.empty()) return;
    const geom::RegionIndex index(regions);
    const geom::Box box = index.bounds();
    for (std::size_t n = 0; n < owner_.size(); ++n) {
      if (owner_[n] != kNone) continue;
      const Point p = node(n);
      if (p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y || !index.contains(p))
        continue;
      if (first == last) {
        owner_[n] = 0;
        continue;
      }
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t a = 0; a < fronts_[i].at.size(); a += 3) {
          const double d = norm(fronts_[i].at[a] - p);
          if (d < least) least = d, owner_[n] = i + 1;
        }
    }
  }

  // ---- motion
  void go(PathMove::Kind kind, Point to, double z) {
    if (!path_.moves.empty() && path_.moves.back().to == to && path_.moves.back().z == z) return;
    at_ = to;
    const std::size_t n = path_.moves.size();
    if (n >= 2 && path_.moves[n - 1].kind == kind && path_.moves[n - 1].z == z && path_.moves[n - 2].z == z) {
      const Point a = path_.moves[n - 1].to - path_.moves[n - 2].to, b = to - path_.moves[n - 1].to;
      if (std::abs(cross(a, b)) <= 1e-9 * norm(a) && dot(a, b) > 0) {  // straight on
        path_.moves[n - 1].to = to;
        return;
      }
    }
    path_.moves.push_back({kind, to, z});
  }
  /// No place outside what is allowed; and a chord beside a wall that bends into the pocket would cut the
  /// wall: it goes round in shorter ones.
  void cut_to(Point to, int divided = 0) {
    constexpr double kChord = 1e-3;
    if (divided == 0 && !limit_.contains(to)) to = limit_.nearest(to).point;
    const Point middle = 0.5 * (at_ + to);
    if (divided < 6 && !limit_.contains(middle)) {
      const auto wall = limit_.nearest(middle);
      if (wall.distance > kChord) {
        cut_to(wall.point, divided + 1);
        return cut_to(to, divided + 1);
      }
    }
    go(PathMove::Kind::cut, to, -o_.depth);
  }

  void enter() {
    const Point start = entry_ + Point{helix_, 0};
    go(PathMove::Kind::rapid, start, o_.safe_height);
    go(PathMove::Kind::plunge, start, 0.0);
    if (!(helix_ > 0)) return go(PathMove::Kind::plunge, start, -o_.depth);
    const double turn_drop = 6.283185307179586 * helix_ * o_.ramp_angle;
    const double turns = std::ceil(o_.depth / turn_drop);
    constexpr double kPieces = 48;
    for (double i = 1; i <= (turns + 1) * kPieces; ++i) {
      const auto [sine, cosine] = geom::sincos(6.283185307179586 * i / kPieces);
      const double z = -std::min(o_.depth, o_.depth * i / (turns * kPieces));
      go(z > -o_.depth ? PathMove::Kind::helix : PathMove::Kind::cut, entry_ + helix_ * Point{cosine, sine},
         z);
    }
  }

  void cut_fronts() {
    for (;;) {
      std::size_t best = kNone;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < fronts_.size(); ++i) {
        const Front& f = fronts_[i];
        if (f.done ||
            !std::all_of(f.parents.begin(), f.parents.end(), [&](std::size_t p) { return fronts_[p].done; }))
          continue;
        double d = std::min(norm(f.at.front() - at_), norm(f.at.back() - at_));
        if (f.closed)
          for (const Point p : f.at) d = std::min(d, norm(p - at_));
        if (d < least) least = d, best = i;
      }
      if (best == kNone) return;
      if (fronts_[best].closed)
        cut_closed(fronts_[best]);
      else
        cut_in_shares(fronts_[best]);
      fronts_[best].done = true;
    }
  }

  /// Out of the cut material at a slope that holds the angle: at depth d of a full step the rim's arc is
  /// acos(1 - d / r) and the heading adds the slope's angle; together they stay below kRampAngle.
  void make_ramp() {
    constexpr double kRampAngle = 1.50, kSteepest = 1.0, kPiece = 0.05;
    double depth = 0;
    ramp_.assign(1, 0.0);
    while (depth < step_) {
      // tan(kRampAngle - acos(c)) without an arccosine: the angle's sine and cosine are known.
      const double c = 1 - depth / radius_, s = std::sqrt(std::max(0.0, 1 - c * c));
      const auto [sa, ca] = geom::sincos(kRampAngle);
      const double sine = sa * c - ca * s, cosine = ca * c + sa * s;
      const double slope = cosine > 0 ? std::min(kSteepest, sine / cosine) : kSteepest;
      depth += kPiece * std::max(slope, 0.1);
      ramp_.push_back(std::min(1.0, depth / step_));
    }
    ramp_length_ = kPiece * static_cast<double>(ramp_.size() - 1);
  }
  [[nodiscard]] double ramp_share(double along, double whole) const {
    if (!(along < whole)) return 1;
    const double at = along / whole * static_cast<double>(ramp_.size() - 1);
    const auto i = static_cast<std::size_t>(at);
    return i + 1 < ramp_.size() ? ramp_[i] + (at - static_cast<double>(i)) * (ramp_[i + 1] - ramp_[i]) : 1;
  }

  /// Out over a ramp, then all round and over the ramp's length again.
  void cut_closed(const Front& f) {
    const std::size_t n = f.at.size() - 1;
    std::size_t start = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (norm(f.before[i] - at_) < norm(f.before[start] - at_)) start = i;
    link(f.before[start]);
    double length = 0, ramp = 0;
    for (std::size_t i = 0; i < n; ++i) length += norm(f.at[i + 1] - f.at[i]);
    const double ramp_length = std::min(ramp_length_, length / 2);
    for (std::size_t k = 1; k <= 2 * n; ++k) {
      const std::size_t i = (start + k) % n, b = (start + k - 1) % n;
      ramp += norm(f.at[i] - f.at[b]);
      const double w = ramp_share(ramp, ramp_length);
      cut_to(f.before[i] + w * (f.at[i] - f.before[i]));
      if (ramp > length + ramp_length) break;
    }
  }

  /// Where a front bends sharply, into a corner, the arc that is cut grows by the bend: it is cut in thinner
  /// layers.
  void cut_in_shares(const Front& f) {
    bool corner = false;
    for (std::size_t i = 1; i + 1 < f.at.size(); ++i) {
      const Point a = f.at[i] - f.at[i - 1], b = f.at[i + 1] - f.at[i];
      corner = corner ||
               (norm(f.at[i] - f.before[i]) > 0.3 * step_ && dot(a, b) < 0.5 * norm(a) * norm(b) &&
                limit_.nearest(f.at[i - 1]).distance < 1e-6 && limit_.nearest(f.at[i + 1]).distance < 1e-6);
    }
    if (!corner) return cut_open(f);
    constexpr double kShares = 4;
    for (double share = 1; share <= kShares; ++share) {
      Front part = f;
      for (std::size_t i = 0; i < part.at.size(); ++i) {
        part.before[i] = f.before[i] + ((share - 1) / kShares) * (f.at[i] - f.before[i]);
        part.at[i] = f.before[i] + (share / kShares) * (f.at[i] - f.before[i]);
      }
      cut_open(part);
    }
  }

  /// How far the front follows the wall at its beginning.
  [[nodiscard]] std::size_t corner_of(const std::vector<Point>& at) const {
    std::size_t i = 0;
    while (i + 1 < at.size() && limit_.nearest(at[i]).distance < 1e-6) ++i;
    return i == 0 ? 0 : i - 1;
  }

  /// Head on to a wall the tool would meet what stands between it and the place where the front before ended;
  /// a front therefore leans back before it meets the wall at its beginning.
  void bend_back(std::vector<Point>& at, std::vector<Point>& before) const {
    const std::size_t corner = corner_of(at);
    if (corner == 0 || corner + 2 >= at.size()) return;
    const double reach = 0.5 * radius_, lean = 0.2 * step_;
    std::size_t back = corner;
    double along = 0;
    while (back > 0 && along < lean) along += norm(at[back] - at[back - 1]), --back;
    const Point leant = at[back], shift = leant - at[corner];
    double wall = 0;
    for (std::size_t i = 0; i < corner; ++i) wall += norm(at[i + 1] - at[i]);
    double off = 0;
    Point last = at[corner];
    for (std::size_t i = corner + 1; i < at.size() && limit_.nearest(at[i]).distance > 1e-6; ++i) {
      off += norm(at[i] - last);
      last = at[i];
      if (off >= reach) break;
      const double t = 1 - off / reach;
      const Point bent = at[i] + (t * t) * shift;
      if (limit_.contains(bent)) at[i] = bent;
    }
    at[corner] = leant;
    // The thin strip along the wall is left to the pass along all walls.
    if (wall > 1.6 * step_) return;
    at.erase(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(corner));
    before.erase(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(corner));
  }

  /// Out over a ramp towards the nearer end, back over all of it to the other.
  void cut_open(const Front& given) {
    std::vector<Point> at = given.at, before = given.before;
    if (norm(at.back() - at_) < norm(at.front() - at_)) {
      std::reverse(at.begin(), at.end());
      std::reverse(before.begin(), before.end());
    }
    bend_back(at, before);
    std::reverse(at.begin(), at.end());
    std::reverse(before.begin(), before.end());
    bend_back(at, before);
    std::reverse(at.begin(), at.end());
    std::reverse(before.begin(), before.end());
    const std::size_t full = corner_of(at);
    std::size_t begin = full;
    double ramp_length = 0;
    while (begin + 1 < at.size() && ramp_length < ramp_length_) {
      ramp_length += norm(at[begin + 1] - at[begin]);
      ++begin;
    }
    link(before[begin]);
    double ramp = 0;
    for (std::size_t i = begin; i-- > 0;) {
      ramp += norm(at[i + 1] - at[i]);
      cut_to(before[i] + ramp_share(ramp, std::max(ramp_length, kSpacing)) * (at[i] - before[i]));
    }
    for (std::size_t i = 0; i < at.size(); ++i) cut_to(at[i]);
  }

  // ---- links at depth through what is cut
  [[nodiscard]] std::size_t nearest_open(Point p) const {
    std::size_t best = kNone;
    double least = std::numeric_limits<double>::infinity();
    const auto column = static_cast<long>((p.x - low_.x) / pitch_),
               row = static_cast<long>((p.y - low_.y) / pitch_);
    for (long reach = 2; best == kNone && reach < static_cast<long>(columns_ + rows_); reach *= 2)
      for (long y = std::max(0L, row - reach); y <= std::min(static_cast<long>(rows_) - 1, row + reach); ++y)
        for (long x = std::max(0L, column - reach);
             x <= std::min(static_cast<long>(columns_) - 1, column + reach); ++x) {
          const auto n = static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
          if (!open(n)) continue;
          const double d = norm(node(n) - p);
          if (d < least) least = d, best = n;
        }
    return best;
  }

  [[nodiscard]] bool deep_open(std::size_t n) const {
    if (n < columns_ + 1 || n + columns_ + 1 >= owner_.size()) return false;
    for (const std::size_t m : {n - 1, n + 1, n - columns_, n + columns_, n - columns_ - 1, n - columns_ + 1,
                                n + columns_ - 1, n + columns_ + 1})
      if (!open(m)) return false;
    return true;
  }

  [[nodiscard]] bool clear(Point a, Point b) const {
    const double length = norm(b - a), steps = std::max(1.0, std::ceil(length / (0.5 * pitch_)));
    for (double i = 0; i <= steps; ++i) {
      const Point p = a + (i / steps) * (b - a);
      const auto x = static_cast<std::size_t>((p.x - low_.x) / pitch_),
                 y = static_cast<std::size_t>((p.y - low_.y) / pitch_);
      for (const std::size_t n :
           {y * columns_ + x, y * columns_ + x + 1, (y + 1) * columns_ + x, (y + 1) * columns_ + x + 1})
        if (!(n < owner_.size()) || !open(n)) return false;
    }
    return true;
  }

  void link(Point to) {
    if (norm(to - at_) < 1.5 * kSpacing + 0.3 * step_) return cut_to(to);
    if (clear(at_, to)) return go(PathMove::Kind::link, to, -o_.depth);
    const std::size_t from = nearest_open(at_), goal = nearest_open(to);
    if (from == kNone || goal == kNone) return go(PathMove::Kind::cut, to, -o_.depth);
    std::vector<double> cost(owner_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> back(owner_.size(), kNone);
    using Item = std::pair<double, std::size_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    cost[from] = 0;
    queue.emplace(norm(node(from) - node(goal)), from);
    while (!queue.empty()) {
      const std::size_t n = queue.top().second;
      queue.pop();
      if (n == goal) break;
      const std::size_t column = n % columns_, row = n / columns_;
      for (std::size_t y = row == 0 ? 0 : row - 1; y <= std::min(rows_ - 1, row + 1); ++y)
        for (std::size_t x = column == 0 ? 0 : column - 1; x <= std::min(columns_ - 1, column + 1); ++x) {
          const std::size_t m = y * columns_ + x;
          if (!open(m)) continue;
          // Away from what still stands: such a way can be pulled straight.
          const double there = cost[n] + (deep_open(m) ? 1 : 4) * norm(node(m) - node(n));
          if (there < cost[m]) {
            cost[m] = there, back[m] = n;
            queue.emplace(there + norm(node(m) - node(goal)), m);
          }
        }
    }
    std::vector<Point> way{to};
    for (std::size_t n = goal; n != kNone; n = back[n]) way.push_back(node(n));
    way.push_back(at_);
    std::reverse(way.begin(), way.end());
    for (std::size_t i = 0; i + 1 < way.size();) {
      std::size_t k = way.size() - 1;
      while (k > i + 1 && !clear(way[i], way[k])) --k;
      go(PathMove::Kind::link, way[k], -o_.depth);
      i = k;
    }
  }

  // ---- walls
  void finish() {
    for (Front& f : fronts_) f.done = true;
    std::vector<geom::Contour> walls;
    for (const Region& region : allowed_) {
      walls.push_back(region.outer);
      walls.insert(walls.end(), region.holes.begin(), region.holes.end());
    }
    while (!walls.empty()) {
      std::size_t next = 0, start = 0;
      double least = std::numeric_limits<double>::infinity();
      std::vector<std::vector<Point>> points(walls.size());
      for (std::size_t w = 0; w < walls.size(); ++w) {
        for (const geom::Edge& edge : walls[w]) sample_edge(edge, points[w]);
        for (std::size_t i = 0; i < points[w].size(); ++i)
          if (norm(points[w][i] - at_) < least) least = norm(points[w][i] - at_), next = w, start = i;
      }
      const std::vector<Point>& wall = points[next];
      link(wall[start]);
      for (std::size_t k = 1; k <= wall.size(); ++k) cut_to(wall[(start + k) % wall.size()]);
      walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(next));
    }
  }
  void lift() { go(PathMove::Kind::rapid, at_, o_.safe_height); }

  PocketOptions o_;
  double radius_, step_;
  std::vector<Region> allowed_;
  geom::RegionIndex limit_;
  Point low_, entry_, at_;
  double pitch_ = 1, helix_ = 0, ramp_length_ = 0;
  std::vector<double> ramp_;  ///< share of the step, every 0.05 mm
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::size_t> owner_;
  std::vector<Front> fronts_;
  PocketPath path_;
};

}  // namespace

Result<PocketPath> level_path(const Region& allowed, const PocketOptions& options,
                              const std::vector<Region>& cut_already) {
  static_cast<void>(cut_already);
  return Clearing({allowed}, options).run();
}

}  // namespace lekalo::mill
