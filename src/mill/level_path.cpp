#include "level_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "arc_through.hpp"
#include "cleared_grid.hpp"
#include "edge_path.hpp"
#include "fronts.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "load.hpp"
#include "opening.hpp"
#include "peels.hpp"
#include "step_law.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

constexpr double kStrip = 0.12;        // of the tool's radius, left to the pass along the walls
constexpr double kFieldFillet = 0.55;  // of the tool's radius: corners of the fields
// How much a peel may take, of the tool's radius: the last, which comes to the corner itself, and others.
constexpr double kSharpPeel = 0.12, kPeel = 0.22;
constexpr double kHotSpacing = 0.02, kHotMoment = 0.04;  // of the tool's radius
constexpr std::size_t kManyEdges = 40;
constexpr double kLeastCorridor = 2.8;  // of the radius the fields are opened by: what is shorter is a corner
constexpr double kFieldSpacing = 0.5, kFieldFit = 0.01;  // mm
constexpr double kWallWay = 6;     // of the step: a way along a wall instead of one across, at most
constexpr double kApproach = 1;    // mm above the stock: from there on at the plunge feed
constexpr double kMissed = 5e-3;   // mm
constexpr double kSubtree = 0.05;  // mm of way for a mm of fronts that wait for one

/// Whether a piece leads on: more than one stretch of its boundary is no wall, or it goes round something.
bool leads_on(const Region& piece, const geom::RegionIndex& walls) {
  if (!piece.holes.empty()) return true;
  const auto is_open = [&](const Edge& edge) { return walls.nearest(place_at(edge, 0.5)).distance > 1e-3; };
  int stretches = 0;
  bool last = is_open(piece.outer.back());
  for (const Edge& edge : piece.outer) {
    const bool now = is_open(edge);
    stretches += now && !last ? 1 : 0;
    last = now;
  }
  return stretches > 1;
}

/// Long contours of short edges as lines and arcs near them: the fields need not be exact.
std::vector<Region> with_fewer_edges(std::vector<Region> regions) {
  std::vector<geom::Contour> contours;
  bool fewer = false;
  const auto look = [&](const geom::Contour& contour) {
    contours.push_back(contour);
    if (contour.size() < kManyEdges) return;
    contours.back().clear();
    fit_arcs(places_on(contour, kFieldSpacing), kFieldFit, contours.back());
    fewer = true;
  };
  for (const Region& region : regions) {
    look(region.outer);
    for (const geom::Contour& hole : region.holes) look(hole);
  }
  if (!fewer) return regions;
  auto made = geom::nest_contours(std::move(contours));
  return made ? std::move(*made) : regions;
}

EdgeKind mirrored(EdgeKind kind) {
  return kind == EdgeKind::line ? kind : kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
}

/// With x for -x.
Result<std::vector<Region>> mirrored(const std::vector<Region>& regions) {
  const auto turn = [](const geom::Contour& contour) {
    geom::Contour made;
    for (const Edge& e : contour)
      made.push_back({mirrored(e.kind), {-e.from.x, e.from.y}, {-e.to.x, e.to.y}, {-e.centre.x, e.centre.y}});
    return made;
  };
  std::vector<Region> made;
  for (const Region& region : regions) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& hole : region.holes) holes.push_back(turn(hole));
    auto other = geom::make_region(turn(region.outer), std::move(holes));
    if (!other) return tl::unexpected(other.error());
    made.push_back(std::move(*other));
  }
  return made;
}

class Clearing {
 public:
  Clearing(const Region& allowed, const PocketOptions& o, const AreaListener& listener)
      : o_(o),
        listener_(listener),
        radius_(o.tool_diameter / 2),
        step_(o.step_over * o.tool_diameter),
        thinness_(std::min(1.0, o.step_over / 0.4)),
        allowed_{allowed},
        limit_(allowed_) {}

  Result<PocketPath> run() {
    if (auto split = find_fields(); !split) return tl::unexpected(split.error());
    std::vector<Region> left = fields_.empty() ? allowed_ : fields_;
    while (!left.empty()) {
      choose_entry(left);
      auto start = start_region();
      if (!start) return tl::unexpected(start.error());
      if (auto grown = grow_from(*start); !grown) return tl::unexpected(grown.error());
      enter();
      cut_fronts();
      // Pieces the tool cannot come to from there are entered anew.
      const geom::RegionIndex cut(growth_.cut.back());
      const std::size_t before = left.size();
      std::erase_if(left, [&](const Region& piece) {
        return cut.contains(piece.outer.front().from) ||
               cut.nearest(piece.outer.front().from).distance < 1e-2 ||
               cut.contains(entry_) == geom::RegionIndex({piece}).contains(entry_);
      });
      if (left.size() == before) break;
    }
    if (auto walls = cut_walls(); !walls) return tl::unexpected(walls.error());
    cut_missed_walls({});
    go({.kind = PathMove::Kind::rapid, .to = at_, .z = o_.safe_height});
    return std::move(path_);
  }

  /// What other tools have left, place by place: fronts that grow from where they have been, then the walls
  /// they did not come to.
  Result<PocketPath> run_from(const std::vector<Region>& cleared, const std::vector<Region>& left) {
    if (auto split = find_fields(); !split) return tl::unexpected(split.error());
    auto fields = geom::combine(fields_, cleared, geom::BooleanOperation::unite);
    if (!fields) return tl::unexpected(fields.error());
    fields_ = std::move(fields->regions);
    field_limit_.emplace(fields_);
    if (auto grown = grow_from(cleared); !grown) return tl::unexpected(grown.error());
    Peels peels(allowed_, centres_, cleared, radius_, thinness_);
    const auto roundest = peels.first();
    if (!roundest) return tl::unexpected(roundest.error());
    const auto found = peels.between(*roundest, peels.last());
    if (!found) return tl::unexpected(found.error());
    const std::vector<Front>& corners = **found;
    const geom::RegionIndex grown(growth_.cut.back());
    const std::vector<Front> walls = fresh_stretches((*peels.at(*roundest))->regions, grown);
    std::vector<geom::RegionIndex> places;
    for (const Region& piece : left) places.emplace_back(std::vector<Region>{piece});
    std::vector<std::vector<std::size_t>> fronts_of(left.size()), walls_of(left.size()),
        corners_of(left.size());
    for (std::size_t i = 0; i < growth_.fronts.size(); ++i)
      fronts_of[place_of(growth_.fronts[i], places)].push_back(i);
    for (std::size_t i = 0; i < walls.size(); ++i) walls_of[place_of(walls[i], places)].push_back(i);
    for (std::size_t i = 0; i < corners.size(); ++i) corners_of[place_of(corners[i], places)].push_back(i);
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < left.size(); ++i)
      if (!fronts_of[i].empty() || !walls_of[i].empty() || !corners_of[i].empty()) waiting.push_back(i);
    const geom::RegionIndex start(cleared);
    while (!waiting.empty()) {
      const auto nearest =
          std::min_element(waiting.begin(), waiting.end(), [&](std::size_t a, std::size_t b) {
            return !path_.moves.empty() && places[a].nearest(at_).distance < places[b].nearest(at_).distance;
          });
      const std::size_t place = *nearest;
      waiting.erase(nearest);
      if (path_.moves.empty()) {
        const Front& first = !fronts_of[place].empty()  ? growth_.fronts[fronts_of[place].front()]
                             : !walls_of[place].empty() ? walls[walls_of[place].front()]
                                                        : corners[corners_of[place].front()];
        come_down(roomy_place(first.edges.front().from, start));
      }
      cut_fronts(&fronts_of[place]);
      cut_all(walls, walls_of[place]);
      for (std::vector<std::size_t>& open = corners_of[place]; !open.empty();) {
        const auto next = std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
          return norm(corners[a].edges.back().to - at_) < norm(corners[b].edges.back().to - at_);
        });
        bool back = true;
        if (auto cut = cut_corner(peels, *roundest, corners[*next], back); !cut)
          return tl::unexpected(cut.error());
        open.erase(next);
      }
    }
    // What the fronts do not come to from there stays for a helix.
    cut_missed_walls(cleared);
    go({.kind = PathMove::Kind::rapid, .to = at_, .z = o_.safe_height});
    return std::move(path_);
  }

 private:
  Result<void> grow_from(const std::vector<Region>& start) {
    auto growth = grow(limit_, fields_, narrow_, start, {radius_, step_, strip_, straight_pass_angle(o_.step_over)},
                       [this](double mm2) { listener_(planned_ + mm2); });
    if (!growth) return tl::unexpected(growth.error());
    planned_ += area_of(growth->cut.back());
    growth_ = std::move(*growth);
    grid_.emplace(growth_, radius_);
    waiting_.assign(growth_.fronts.size(), 0.0);
    for (std::size_t i = growth_.fronts.size(); i-- > 0;) {
      waiting_[i] += length_of(growth_.fronts[i].edges);
      if (!growth_.fronts[i].parents.empty()) waiting_[growth_.fronts[i].parents.front()] += waiting_[i];
    }
    path_.fronts += growth_.fronts.size();
    return {};
  }

  /// Which of the places a front lies in or is nearest to.
  static std::size_t place_of(const Front& front, const std::vector<geom::RegionIndex>& places) {
    const Point p = place_at(front.edges[front.edges.size() / 2], 0.5);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double d = places[i].contains(p) ? 0 : places[i].nearest(p).distance;
      if (d < least) least = d, best = i;
    }
    return best;
  }

  /// Near p, with some room about it.
  [[nodiscard]] Point roomy_place(Point p, const geom::RegionIndex& cleared) const {
    Point best = cleared.nearest(p).point;
    double most = -1;
    for (double reach = 0.5; reach <= 4; reach += 0.5)
      for (int k = 0; k < 16; ++k) {
        const auto [sine, cosine] = geom::sincos(0.39269908169872414 * k);
        const Point q = p + (reach * radius_) * Point{cosine, sine};
        if (!cleared.contains(q)) continue;
        const double room = std::min(0.5 * radius_, cleared.nearest(q).distance) - 0.1 * reach * radius_;
        if (room > most) most = room, best = q;
      }
    return best;
  }

  /// Where nothing stands.
  void come_down(Point p) {
    go({.kind = PathMove::Kind::rapid, .to = p, .z = o_.safe_height});
    go({.kind = PathMove::Kind::rapid, .to = p, .z = std::min(o_.safe_height, kApproach)});
    go(PathMove::Kind::plunge, p);
  }

  /// The nearest first.
  void cut_all(const std::vector<Front>& walls, std::vector<std::size_t> open) {
    while (!open.empty()) {
      const auto next = std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
        return norm(walls[a].edges.front().from - at_) < norm(walls[b].edges.front().from - at_);
      });
      link(walls[*next].edges.front().from, nullptr);
      for (const Edge& edge : walls[*next].edges) go(PathMove::Kind::cut, edge);
      open.erase(next);
    }
  }

  /// Fields keep a strip off the walls and are rounded in corners; what is too narrow for them is a corridor.
  Result<void> find_fields() {
    strip_ = kStrip * radius_;
    const double fillet = kFieldFillet * radius_;
    auto fields = opened_by(allowed_, strip_, fillet);
    if (!fields) return tl::unexpected(fields.error());
    fields_ = with_fewer_edges(std::move(*fields));
    field_limit_.emplace(fields_);
    corridors_.emplace(narrow_);
    auto reached = geom::offset(fields_, 1.01 * strip_);
    if (!reached) return tl::unexpected(reached.error());
    auto lost =
        geom::combine(allowed_, reached->regions, geom::BooleanOperation::subtract, reached->edge_error);
    if (!lost) return tl::unexpected(lost.error());
    // What is short leads into a corner.
    std::erase_if(lost->regions, [&](const Region& piece) {
      const geom::Box box = geom::bounds(piece.outer);
      return !fields_.empty() && norm(box.high - box.low) < kLeastCorridor * (strip_ + fillet) &&
             !leads_on(piece, limit_);
    });
    if (lost->regions.empty()) return {};
    auto wider = geom::offset(lost->regions, 2 * strip_ + fillet);
    if (!wider) return tl::unexpected(wider.error());
    auto narrow =
        geom::combine(wider->regions, allowed_, geom::BooleanOperation::intersect, wider->edge_error);
    if (!narrow) return tl::unexpected(narrow.error());
    narrow_ = std::move(narrow->regions);
    corridors_.emplace(narrow_);
    return {};
  }

  // ---- entry: the widest disc of places
  void choose_entry(const std::vector<Region>& places) {
    const geom::RegionIndex limit(places);
    const geom::Box box = limit.bounds();
    const auto depth_at = [&](Point p) {
      const double d = limit.nearest(p).distance;
      return limit.contains(p) ? d : -d;
    };
    entry_ = limit.curves()[0].edge.from;
    disc_ = 0;
    constexpr int kPlaces = 64;
    const Point size = box.high - box.low;
    for (int y = 0; y <= kPlaces; ++y)
      for (int x = 0; x <= kPlaces; ++x) {
        const Point p = box.low + Point{size.x * x / kPlaces, size.y * y / kPlaces};
        const double depth = depth_at(p);
        if (depth > disc_) disc_ = depth, entry_ = p;
      }
    for (double step = std::max(size.x, size.y) / kPlaces; step > 1e-7; step /= 2)
      for (const Point d : {Point{step, 0}, Point{-step, 0}, Point{0, step}, Point{0, -step},
                            Point{step, step}, Point{step, -step}, Point{-step, step}, Point{-step, -step}}) {
        const double depth = depth_at(entry_ + d);
        if (depth > disc_ + 1e-9) disc_ = depth, entry_ = entry_ + d;
      }
    disc_ = std::max(0.0, disc_ - 1e-6);
    helix_ = std::min(0.8 * radius_, disc_);
  }

  Result<std::vector<Region>> start_region() {
    const double r = std::max(disc_, 0.01);
    auto disc = geom::make_region({{EdgeKind::arc_ccw, entry_ + Point{r, 0}, entry_ + Point{r, 0}, entry_}});
    if (!disc) return tl::unexpected(disc.error());
    if (disc_ >= 0.01) return std::vector<Region>{*disc};
    auto clipped = geom::combine({*disc}, allowed_, geom::BooleanOperation::intersect);
    if (!clipped) return tl::unexpected(clipped.error());
    return clipped->regions;
  }

  // ---- motion
  void go(const PathMove& move) {
    if (move.shape == EdgeKind::line && !path_.moves.empty() && path_.moves.back().to == move.to &&
        path_.moves.back().z == move.z)
      return;
    at_ = move.to;
    path_.moves.push_back(move);
  }
  void go(PathMove::Kind kind, Point to) { go({.kind = kind, .to = to, .z = -o_.depth}); }
  /// Both ends at the same distance from the centre, whatever rounding or a way along a wall made of them.
  void go(PathMove::Kind kind, const Edge& edge) {
    const Point chord = edge.to - at_;
    const double square = dot(chord, chord);
    Point centre = edge.centre;
    if (edge.kind != EdgeKind::line && square > 0)
      centre = centre - (dot(centre - 0.5 * (at_ + edge.to), chord) / square) * chord;
    go({.kind = kind, .to = edge.to, .z = -o_.depth, .shape = edge.kind, .centre = centre});
  }

  /// A helix, its level turn, and a spiral out to the widest disc.
  void enter() {
    using Kind = PathMove::Kind;
    const Point ahead = spiral_end();
    const Point start = entry_ + helix_ * ahead;
    if (!path_.moves.empty()) go({.kind = Kind::rapid, .to = at_, .z = o_.safe_height});
    go({.kind = Kind::rapid, .to = start, .z = o_.safe_height});
    go({.kind = Kind::rapid, .to = start, .z = std::min(o_.safe_height, kApproach)});
    go({.kind = Kind::plunge, .to = start, .z = 0});
    if (!(helix_ > 1e-3)) return go({.kind = Kind::plunge, .to = start, .z = -o_.depth});
    const double turn_drop = 6.283185307179586 * helix_ * o_.ramp_angle;
    const double turns = std::ceil(o_.depth / turn_drop);
    const auto quarter = [](Point out, double quarters) -> Point {
      const int q = static_cast<int>(quarters) % 4;
      return q == 0 ? out : q == 1 ? perpendicular(out) : q == 2 ? -out : -perpendicular(out);
    };
    for (double i = 1; i <= 4 * turns; ++i)
      go({.kind = Kind::entry,
          .to = entry_ + quarter(helix_ * ahead, i),
          .z = -o_.depth * i / (4 * turns),
          .shape = EdgeKind::arc_ccw,
          .centre = entry_});
    turn_about(helix_ * ahead, Kind::entry);
    if (!(disc_ > helix_)) return;
    std::vector<double> steps;
    const double cosine = geom::sincos(kNext * straight_pass_angle(o_.step_over)).cosine;
    double reach = helix_;
    while (reach < disc_) {
      // The second turn meets the step of the first: what a turn may add depends on where it begins.
      steps.push_back(std::min(step_, step_for(reach, radius_, cosine)));
      reach += steps.back();
    }
    const double scale = (disc_ - helix_) / (reach - helix_);
    double r = helix_;
    for (const double step : steps) {
      // Four quarters about the corners of a small square: tangent to each other, and back on the axis.
      const double more = scale * step / 4;
      Point out = ahead, centre = entry_;
      for (int q = 0; q < 4; ++q) {
        centre = centre - more * out;
        r += more;
        out = perpendicular(out);
        go(Kind::cut, Edge{EdgeKind::arc_ccw, at_, centre + r * out, centre});
      }
    }
    turn_about(r * ahead, Kind::cut);
  }
  void turn_about(Point out, PathMove::Kind kind) {
    for (int q = 0; q < 4; ++q) {
      out = perpendicular(out);
      go({.kind = kind, .to = entry_ + out, .z = -o_.depth, .shape = EdgeKind::arc_ccw, .centre = entry_});
    }
  }
  /// Direction from the entry to where the first front begins.
  [[nodiscard]] Point spiral_end() const {
    double least = std::numeric_limits<double>::infinity();
    Point best{1, 0};
    for (std::size_t i = 0; i < growth_.fronts.size() && growth_.fronts[i].layer == 1; ++i)
      for (const Point p : {growth_.fronts[i].edges.front().from, growth_.fronts[i].edges.back().to}) {
        const double off = std::abs(norm(p - entry_) - disc_) + kSubtree * waiting_[i];
        if (off < least && norm(p - entry_) > 0) least = off, best = (1 / norm(p - entry_)) * (p - entry_);
      }
    return best;
  }

  // ---- fronts
  /// The next: near, and of two near ones the one that less waits for, so that what is small is not left
  /// behind.
  /// \param among  if given, of these
  void cut_fronts(const std::vector<std::size_t>* among = nullptr) {
    const std::vector<Front>& fronts = growth_.fronts;
    const std::size_t count = among != nullptr ? among->size() : fronts.size();
    for (;;) {
      std::size_t best = fronts.size();
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = among != nullptr ? (*among)[k] : k;
        const Front& f = fronts[i];
        if (grid_->is_done(i) || !std::all_of(f.parents.begin(), f.parents.end(),
                                              [&](std::size_t p) { return grid_->is_done(p); }))
          continue;
        const double d = std::min(norm(f.edges.front().from - at_), norm(f.edges.back().to - at_)) +
                         kSubtree * waiting_[i];
        if (d < least) least = d, best = i;
      }
      if (best == fronts.size()) return;
      cut(fronts[best]);
      grid_->set_done(best);
    }
  }

  /// Round, begun where it leaves what is cut before least; where that is nowhere near it, over a ramp, and
  /// over the ramp's stretch again.
  void cut_ring(const Front& front) {
    const geom::RegionIndex before(growth_.cut[front.layer - 1]);
    const std::vector<Point> at = places_on(front.edges, 0.1 * radius_);
    std::size_t start = 0;
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const auto near = before.nearest(at[i]);
      const double here = near.distance + 0.01 * norm(near.point - at_);
      if (here < gap) gap = here, start = i;
    }
    const std::size_t n = at.size() - 1;
    // What a short ring goes round is nearly all cut from outside of it.
    const bool ramped =
        before.nearest(at[start]).distance >= 0.05 * radius_ && length_of(front.edges) > 6 * step_;
    const double ramp = ramped ? 3 * step_ : 0;
    link(before.nearest(at[start]).point, &growth_.cut[front.layer - 1]);
    double along = 0;
    for (std::size_t k = 1; along < ramp || k <= n; ++k) {
      const Point q = at[(start + k) % n];
      along += norm(q - at[(start + k - 1) % n]);
      const double share = along < ramp ? along / ramp : 1;
      const Point p = share < 1 ? before.nearest(q).point : q;
      go(PathMove::Kind::cut, p + share * (q - p));
    }
    for (std::size_t k = 1; k <= n && ramped; ++k) {
      const Point q = at[(start + k) % n];
      go(PathMove::Kind::cut, q);
      if (norm(q - at[start]) > ramp) break;
    }
    cuts_.push_back({at_, at_, at_});
  }

  /// One loop of a trochoid, begun at the side where the one before ended.
  void cut_loop(const Front& front) {
    const bool back = o_.direction == Direction::any &&
                      norm(front.left_lead.front() - at_) < norm(front.right_lead.front() - at_);
    const std::vector<Point>& lead = back ? front.left_lead : front.right_lead;
    // Across what the loop before has cut, if there is only that to cross.
    if (norm(lead.front() - at_) < 3 * arc_radius(front.edges.front()) && is_inside(at_, lead.front())) {
      if (norm(lead.front() - at_) > 1e-6) go(PathMove::Kind::link, lead.front());
    } else {
      link(lead.front(), nullptr);
    }
    for (std::size_t i = 1; i < lead.size(); ++i) go(PathMove::Kind::cut, lead[i]);
    for (const Edge& edge : back ? turned_back(front.edges) : front.edges) go(PathMove::Kind::cut, edge);
    cuts_.push_back({lead.back(), lead.back(), at_});
    centres_.push_back(front.edges.front().centre);
  }

  void cut(const Front& front) {
    if (front.closed) return cut_ring(front);
    if (front.loop) return cut_loop(front);
    if (front.slot) {
      link(front.edges.front().from, nullptr);
      for (const Edge& edge : front.edges) {
        go(PathMove::Kind::slot, edge);
        centres_.push_back(at_);
      }
      return;
    }
    const bool back = o_.direction == Direction::any
                          ? norm(front.edges.back().to - at_) < norm(front.edges.front().from - at_)
                          : false;
    Front given = front;
    const Point begin = back ? front.edges.back().to : front.edges.front().from;
    if (norm(begin - at_) > 1e-3)
      // The pass before may have left the wall before it came here: begun where that one began.
      for (const Cut& before : cuts_)
        if (norm(before.corner - begin) < 1e-2)
          if (const auto wall = along_wall(before.from, begin, *field_limit_)) {
            const std::vector<Edge> more = back ? turned_back(*wall) : *wall;
            given.edges.insert(back ? given.edges.end() : given.edges.begin(), more.begin(), more.end());
            break;
          }
    std::vector<Edge> edges = pass_along(given, back, {*field_limit_, limit_, *corridors_, strip_},
                                         geom::RegionIndex(growth_.cut[front.layer - 1]), step_);
    if (!std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) { return is_inside(edge); }))
      edges = back ? turned_back(given.edges) : given.edges;
    link(edges.front().from, &growth_.cut[front.layer - 1]);
    for (const Edge& edge : edges) go(PathMove::Kind::cut, edge);
    // Where its front meets the wall.
    Point corner = begin;
    for (const Edge& edge : back ? turned_back(given.edges) : given.edges) {
      if (field_limit_->nearest(place_at(edge, 0.5)).distance > 1e-6) break;
      corner = edge.to;
    }
    cuts_.push_back({edges.front().from, corner, at_});
  }

  // ---- walls
  /// Once along each wall; corners in thinner peels, to and fro.
  Result<void> cut_walls() {
    Peels peels(allowed_, centres_, {}, radius_, thinness_);
    const auto roundest = peels.first();
    if (!roundest) return tl::unexpected(roundest.error());
    const auto found = peels.between(*roundest, peels.last());
    if (!found) return tl::unexpected(found.error());
    const std::vector<Front>& corners = **found;
    const geom::RegionIndex& walls = (*peels.at(*roundest))->index;
    // Where along the walls each corner is left.
    std::vector<std::vector<std::pair<double, std::size_t>>> stops(walls.curves().size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point end = corners[i].edges.back().to;
      const auto near = walls.nearest(end);
      const Edge& edge = walls.curves()[near.edge].edge;
      stops[near.edge].emplace_back(length_of(Edge{edge.kind, edge.from, end, edge.centre}), i);
    }
    for (auto& list : stops) std::sort(list.begin(), list.end());
    std::vector<std::size_t> left;
    for (std::size_t c = 0; c + 1 < walls.contour_starts().size(); ++c) left.push_back(c);
    while (!left.empty()) {
      const WallStart start = wall_start(walls, left, stops);
      const std::uint32_t first = walls.contour_starts()[left[start.contour]],
                          count = walls.contour_starts()[left[start.contour] + 1] - first;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(start.contour));
      const Edge begun = walls.curves()[start.edge].edge;
      if (start.from) link(*start.from, nullptr);
      const Point on = start.share < 1 ? place_at(begun, start.share) : begun.to;
      if (start.from && is_inside(at_, on))
        go(PathMove::Kind::cut, on);
      else
        link(on, nullptr);
      for (std::uint32_t k = 0; k <= count; ++k) {
        const std::uint32_t e = first + (start.edge - first + k) % count;
        Edge edge = walls.curves()[e].edge;
        if (k == 0) {
          if (!(start.share < 1)) continue;
          edge.from = on;
        } else if (k == count) {
          if (!(start.share > 0)) continue;
          edge.to = on;
        }
        const double skipped = k == 0 ? start.share * length_of(begun) : 0;
        const double length = skipped + length_of(edge);
        for (const auto& [along, corner] : stops[e]) {
          if (along < skipped - 1e-6 || (k == count && along > length - 1e-6)) continue;
          const Point stop = corners[corner].edges.back().to;
          if (norm(stop - edge.from) > 1e-6) {
            const bool ends = norm(stop - edge.to) < 1e-6;
            go(PathMove::Kind::cut, ends ? edge : Edge{edge.kind, edge.from, stop, edge.centre});
            edge.from = ends ? edge.to : stop;
          }
          bool back = true;
          if (auto cut = cut_corner(peels, *roundest, corners[corner], back); !cut) return cut;
          link(stop, nullptr);
        }
        if (!(edge.from == edge.to)) go(PathMove::Kind::cut, edge);
      }
    }
    return {};
  }

  /// Where the pass along a wall begins: ahead of where a pass came near it, at a small angle to it.
  struct WallStart {
    std::size_t contour = 0;  ///< of those left
    std::uint32_t edge = 0;
    double share = 0;           ///< of the edge
    std::optional<Point> from;  ///< near the wall, cut
  };
  [[nodiscard]] WallStart wall_start(
      const geom::RegionIndex& walls, const std::vector<std::size_t>& left,
      const std::vector<std::vector<std::pair<double, std::size_t>>>& stops) const {
    WallStart best;
    double least = std::numeric_limits<double>::infinity();
    for (const Cut& pass : cuts_) {
      const auto near = walls.nearest(pass.to);
      if (near.distance > 1.5 * strip_) continue;
      const auto& starts = walls.contour_starts();
      const auto contour = static_cast<std::size_t>(
                               std::upper_bound(starts.begin(), starts.end(), near.edge) - starts.begin()) -
                           1;
      const auto listed = std::find(left.begin(), left.end(), contour);
      if (listed == left.end()) continue;
      const Edge& edge = walls.curves()[near.edge].edge;
      if (edge.from == edge.to) continue;
      const double length = length_of(edge);
      double along = norm(near.point - edge.from) < 1e-9
                         ? 0
                         : length_of(Edge{edge.kind, edge.from, near.point, edge.centre});
      along = std::min(length, along + 4 * strip_);
      bool corner = false;
      for (const auto& [at, number] : stops[near.edge]) corner = corner || std::abs(at - along) < radius_;
      const double d = norm(pass.to - at_) + (corner ? 3 * radius_ : 0) +
                       (norm(place_at(edge, along / length) - pass.to) < 2 * strip_ ? 3 * radius_ : 0);
      if (d < least) {
        least = d;
        best = {static_cast<std::size_t>(listed - left.begin()), near.edge, along / length, pass.to};
      }
    }
    if (best.from) return best;
    for (std::size_t i = 0; i < left.size(); ++i)
      for (std::uint32_t e = walls.contour_starts()[left[i]]; e < walls.contour_starts()[left[i] + 1]; ++e) {
        const double d = norm(walls.curves()[e].edge.from - at_);
        if (d < least) least = d, best = {i, e, 0, std::nullopt};
      }
    return best;
  }

  /// Stretches of the walls no pass came along, if peels of odd corners have left any.
  /// \param cleared  where other tools have been
  void cut_missed_walls(const std::vector<Region>& cleared) {
    const geom::RegionIndex before(cleared);
    std::vector<geom::Curve> passes;
    std::vector<geom::Box> boxes;
    Point from;
    for (const PathMove& move : path_.moves) {
      if (move.kind == PathMove::Kind::cut && !(move.to == from)) {
        passes.push_back(geom::make_curve({move.shape, from, move.to, move.centre}));
        boxes.push_back(geom::curve_box(passes.back()));
      }
      from = move.to;
    }
    const auto is_missed = [&](Point p) {
      for (std::size_t i = 0; i < passes.size(); ++i)
        if (p.x > boxes[i].low.x - kMissed && p.x < boxes[i].high.x + kMissed &&
            p.y > boxes[i].low.y - kMissed && p.y < boxes[i].high.y + kMissed &&
            norm(geom::nearest_on(passes[i], p) - p) < kMissed)
          return false;
      return true;
    };
    std::vector<std::vector<Edge>> missed;
    for (const geom::Curve& wall : limit_.curves()) {
      const double pieces = std::max(1.0, std::ceil(length_of(wall.edge) / (0.1 * radius_)));
      for (double i = 0; i < pieces; ++i) {
        const Point middle = place_at(wall.edge, (i + 0.5) / pieces);
        if (!is_missed(middle)) continue;
        if (!cleared.empty() && (before.contains(middle) || before.nearest(middle).distance < kMissed))
          continue;
        const Edge piece = part_of(wall.edge, i / pieces, (i + 1) / pieces);
        if (missed.empty() || !(missed.back().back().to == piece.from)) missed.emplace_back();
        missed.back().push_back(piece);
      }
    }
    for (const std::vector<Edge>& stretch : missed) {
      link(stretch.front().from, nullptr);
      for (const Edge& edge : stretch) go(PathMove::Kind::cut, edge);
    }
  }

  static bool lies_on(Point p, const Front& zone) {
    return std::any_of(zone.edges.begin(), zone.edges.end(), [&](const Edge& edge) {
      return norm(geom::nearest_on(geom::make_curve(edge), p) - p) < 1e-3;
    });
  }

  /// Whether more than a moment of passes meets too much of the rim.
  [[nodiscard]] bool is_hot(const std::vector<Front>& passes, const geom::RegionIndex& before) const {
    const double held = most_held_degrees(o_.step_over);
    return std::any_of(passes.begin(), passes.end(), [&](const Front& pass) {
      return load_of(pass.edges, false, before, radius_, held, kHotSpacing * radius_).beyond > kHotMoment * radius_;
    });
  }

  /// What the zone of a corner holds beyond a round: to and fro, each peel as deep as it may be.
  Result<void> cut_corner(Peels& peels, std::size_t outer, const Front& zone, bool& back) {
    const std::size_t last = peels.last();
    if (outer == last) return {};
    const auto round = peels.at(outer);
    if (!round) return tl::unexpected(round.error());
    const geom::RegionIndex& before = (*round)->index;
    // The deepest that may be: the last at once, else halved between what may be and what may not.
    std::vector<Front> chosen;
    std::size_t inner = outer, beyond = last + 1;
    for (std::size_t tried = last; inner + 1 < beyond; tried = (inner + beyond) / 2) {
      const auto fronts = peels.between(outer, tried);
      if (!fronts) return tl::unexpected(fronts.error());
      std::vector<Front> peel;
      double depth = 0;
      for (const Front& front : **fronts) {
        if (!lies_on(front.edges.front().from, zone) || !lies_on(front.edges.back().to, zone)) continue;
        peel.push_back(front);
        for (const Point p : places_on(front.edges, 0.1 * radius_))
          depth = std::max(depth, before.nearest(p).distance);
      }
      // At the end of a corridor the other corner is met as well.
      const double most = thinness_ * (tried == last ? kSharpPeel : kPeel) *
                          (corridors_->contains(zone.edges.front().from) ? 0.5 : 1);
      if (tried == outer + 1 || (depth < most * radius_ && !is_hot(peel, before))) {
        inner = tried;
        chosen = std::move(peel);
      } else {
        beyond = tried;
      }
    }
    if (chosen.empty()) return cut_corner(peels, inner, zone, back);
    if (back) std::reverse(chosen.begin(), chosen.end());
    for (const Front& peel : chosen) {
      const bool turned = back && o_.direction == Direction::any;
      const std::vector<Edge> edges = turned ? turned_back(peel.edges) : peel.edges;
      link(edges.front().from, nullptr);
      for (const Edge& edge : edges) go(PathMove::Kind::cut, edge);
      bool next = !back;
      if (auto cut = cut_corner(peels, inner, peel, next); !cut) return cut;
    }
    back = !back;
    return {};
  }

  // ---- links at depth through what is cut
  void link(Point to, const std::vector<Region>* cut) {
    if (norm(to - at_) < 1e-6) return;
    if (norm(to - at_) < (cut != nullptr ? 3 : kWallWay) * step_) {
      const auto wall = along_wall(at_, to, cut != nullptr ? *field_limit_ : limit_);
      // Past the mouth of a corridor the way along the wall of the fields may still be full.
      if (wall && (cut == nullptr || is_within(*wall, geom::RegionIndex(*cut), 0.02 * radius_))) {
        for (const Edge& edge : *wall) go(PathMove::Kind::link, edge);
        return;
      }
      if (cut != nullptr && is_within(at_, to, geom::RegionIndex(*cut))) return go(PathMove::Kind::link, to);
    }
    const std::vector<Point> corners = grid_->way(at_, to);
    Point last = at_;
    bool inside = !corners.empty();
    for (const Point corner : corners) {
      inside = inside && is_inside(last, corner);
      last = corner;
    }
    if (!inside) return hop(to);
    for (const Point corner : corners) go(PathMove::Kind::link, corner);
  }

  /// Over the stock, where there is no way at depth.
  void hop(Point to) {
    if (norm(to - at_) < 0.5 * radius_ && is_inside(at_, to)) return go(PathMove::Kind::cut, to);
    go({.kind = PathMove::Kind::rapid, .to = at_, .z = o_.safe_height});
    go({.kind = PathMove::Kind::rapid, .to = to, .z = o_.safe_height});
    go({.kind = PathMove::Kind::rapid, .to = to, .z = std::min(o_.safe_height, kApproach)});
    go(PathMove::Kind::plunge, to);
  }

  [[nodiscard]] bool is_inside(Point a, Point b) const { return is_inside(Edge{EdgeKind::line, a, b, {}}); }
  [[nodiscard]] bool is_inside(const Edge& edge) const {
    const std::vector<Point> places = places_on({edge}, 0.05 * radius_);
    for (const Point p : places) {
      if (!limit_.contains(p) && limit_.nearest(p).distance > 1e-4) return false;
    }
    return true;
  }

  static bool is_within(Point a, Point b, const geom::RegionIndex& cut) {
    return is_within(std::vector<Edge>{{EdgeKind::line, a, b, {}}}, cut, 1e-3);
  }
  static bool is_within(const std::vector<Edge>& edges, const geom::RegionIndex& cut, double slack) {
    const std::vector<Point> places = places_on(edges, 0.1);
    return std::all_of(places.begin() + 1, places.end() - 1,
                       [&](Point p) { return cut.contains(p) || cut.nearest(p).distance <= slack; });
  }

  /// Along the wall, where both ends are on it and not far from each other.
  [[nodiscard]] std::optional<std::vector<Edge>> along_wall(Point begin, Point to,
                                                            const geom::RegionIndex& limit) const {
    const auto from = limit.nearest(begin), goal = limit.nearest(to);
    if (from.distance > 1e-4 || goal.distance > 1e-4) return std::nullopt;
    const auto& starts = limit.contour_starts();
    const auto contour =
        static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), from.edge) - starts.begin());
    if (goal.edge >= starts[contour] || goal.edge < starts[contour - 1]) return std::nullopt;
    const std::uint32_t first = starts[contour - 1], count = starts[contour] - first;
    for (const bool back : {false, true}) {
      std::vector<Edge> edges;
      double length = 0;
      std::uint32_t e = from.edge;
      Point at = begin;
      // Once round, and the edge where it began again: a wall that is one whole circle is walked from its
      // seam on.
      for (std::uint32_t walked = 0; walked <= count && length < kWallWay * step_; ++walked) {
        Edge edge = limit.curves()[e].edge;
        if (back) edge = turned_back(edge);
        Edge rest{edge.kind, at, edge.to, edge.centre};
        if (e == goal.edge) {
          const Edge last{edge.kind, at, to, edge.centre};
          const bool from_seam = walked > 0 && edge.from == edge.to;
          const bool ahead =
              edge.kind == EdgeKind::line
                  ? dot(to - at, edge.to - edge.from) > 0
                  : from_seam || (!(rest.from == rest.to) && arc_sweep(last) < arc_sweep(rest) + 1e-9);
          if (ahead) {
            if (length + length_of(last) > kWallWay * step_) break;
            edges.push_back(last);
            return edges;
          }
        }
        if (!(rest.from == rest.to)) {
          length += length_of(rest);
          edges.push_back(rest);
        }
        at = edge.to;
        e = first + (back ? (e - first + count - 1) % count : (e - first + 1) % count);
      }
    }
    return std::nullopt;
  }

  struct Cut {
    Point from, corner, to;  ///< corner: where its front would have met the wall it began at
  };

  PocketOptions o_;
  const AreaListener& listener_;
  double planned_ = 0;  ///< mm2 of places, by growths before the one under way
  double radius_, step_, thinness_;  ///< thinness_: of peels, Peels::Peels
  std::vector<Region> allowed_;
  geom::RegionIndex limit_;
  std::vector<Region> fields_, narrow_;
  std::optional<geom::RegionIndex> field_limit_, corridors_;
  double strip_ = 0;  ///< mm between fields and walls
  Growth growth_;
  std::optional<ClearedGrid> grid_;
  std::vector<double> waiting_;  ///< mm of each front and of all that wait for it
  std::vector<Cut> cuts_;        ///< of fronts, in order
  std::vector<Point> centres_;   ///< of loops, and places of slots
  Point entry_, at_;
  double disc_ = 0;   ///< radius of the widest disc of places, about entry_
  double helix_ = 0;  ///< radius of the helix
  PocketPath path_;
};

}  // namespace

Result<PocketPath> level_path(const Region& allowed, const PocketOptions& options,
                              const std::vector<Region>& cleared, const std::vector<Region>& left,
                              const AreaListener& listener) {
  if (options.direction != Direction::conventional)
    return cleared.empty() ? Clearing(allowed, options, listener).run()
                           : Clearing(allowed, options, listener).run_from(cleared, left);
  // What is climb on one side of a mirror is conventional on the other.
  PocketOptions turned = options;
  turned.direction = Direction::climb;
  const auto other = mirrored({allowed}), start = mirrored(cleared), rest = mirrored(left);
  for (const auto* made : {&other, &start, &rest})
    if (!*made) return tl::unexpected(made->error());
  auto path = cleared.empty() ? Clearing(other->front(), turned, listener).run()
                              : Clearing(other->front(), turned, listener).run_from(*start, *rest);
  if (!path) return path;
  for (PathMove& move : path->moves) {
    move.to.x = -move.to.x, move.centre.x = -move.centre.x;
    move.shape = mirrored(move.shape);
  }
  return path;
}

}  // namespace lekalo::mill
