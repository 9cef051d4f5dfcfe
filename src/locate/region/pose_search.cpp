#include "pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lekalo/base/angle.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Point;

/// Cells larger than this part of the shapes' size are bounded by single points, smaller ones by programs.
constexpr double kFine = 1.0 / 128;
/// The points of the part that bound large cells are no further apart along an edge than this part of its
/// reach. Two points on a circle would say nothing about shifts across them.
constexpr double kSampleSpacing = 0.2;
/// A cell that is bounded by programs is turned by halves to this first, rad, however long it is.
constexpr double kFirstTurn = 0.25;
/// Contacts are looked for in one cell this many times before it is split.
constexpr int kRounds = 3;
/// A cell hands at most this many pairs on to its halves.
constexpr std::size_t kMostPairs = 48;
/// The deepest crossings of one pose are used, at most this many.
constexpr std::size_t kMostCrossings = 8;
/// A ball larger than this many times the shapes is as good as a half-plane, and one smaller than that part
/// of them as good as a point.
constexpr double kLargestBall = 200, kSmallestBall = 1e-3;
/// After this many divided cells the first climb starts from the most promising cell, and the next one after
/// twice as many each time. A climb finds a placement to measure cells by where the bounds of large cells say
/// little.
constexpr std::uint64_t kFirstDive = 256;
/// This many climbs are made where no cell promised anything.
constexpr int kHopelessClimbs = 8;
/// The progress listener is called after this many units of work.
constexpr std::uint64_t kReportEvery = 1024;

BlankFromPart pose_at(double theta, Point pivot) { return BlankFromPart::from_angle(theta, pivot); }

/// Gives the points of a, between its ends, whose distance from b's line or circle is extremal; returns how
/// many there are.
std::size_t deepest_points(const geom::Curve& a, const geom::Curve& b, std::array<Point, 2>& point) {
  const bool a_line = a.edge.kind == geom::EdgeKind::line, b_line = b.edge.kind == geom::EdgeKind::line;
  if (a_line && b_line) return 0;
  if (a_line) {
    const Point along = a.edge.to - a.edge.from;
    const double t = dot(b.edge.centre - a.edge.from, along) / dot(along, along);
    if (!(t > 0 && t < 1)) return 0;
    point[0] = a.edge.from + t * along;
    return 1;
  }
  const Point axis = b_line ? geom::perpendicular(b.edge.to - b.edge.from) : b.edge.centre - a.edge.centre;
  const double length = norm(axis);
  std::size_t count = 0;
  for (const double side : {1.0, -1.0}) {
    if (!(length > 0) || !faces(a, side * axis)) continue;
    point[count++] = a.edge.centre + side * a.radius / length * axis;
  }
  return count;
}

double turn_distance(double far, double half_theta) {
  return 2 * far * std::sin(0.5 * std::min(half_theta, kPi));
}

/// Returns how far the part reaches from its pivot.
double reach(const geom::RegionIndex& part) {
  double far = 0;
  for (const geom::Curve& curve : part.curves()) {
    const geom::Box box = curve_box(curve);
    for (const Point& corner :
         {box.low, box.high, Point{box.low.x, box.high.y}, Point{box.high.x, box.low.y}})
      far = std::max(far, norm(corner));
  }
  return far;
}

}  // namespace

PoseSearch::PoseSearch(const phi::RegionClearance& clearance, const std::vector<LocalCap>& caps,
                       const PoseCell& root, double far, const Goal& goal, const RunControl& run)
    : clearance_(clearance),
      caps_(caps),
      root_(root),
      goal_(goal),
      run_(run),
      reach_(reach(clearance.part())),
      blank_grid_(clearance.blank(), root.pivot, std::max(root.half_x, root.half_y) + reach_),
      part_grid_(clearance.part(), {0, 0}, reach_) {
  best_.value = -kInfinity;
  const geom::Box box = clearance.blank().bounds();
  scale_ = std::max(norm(box.high - box.low), reach_);
  doubt_ = geom::kEdgeDistanceError * far;
  rounding_ = 4 * doubt_ + 16 * geom::kEdgeDistanceError * kLargestBall * scale_;
  fine_ = kFine * norm(box.high - box.low);
  collect_samples();
  collect_voids();
}

void PoseSearch::collect_samples() {
  const auto add = [&](const std::vector<geom::Curve>& curves, std::uint32_t k, std::uint32_t cap) {
    const geom::Curve& curve = curves[k];
    const geom::Edge& edge = curve.edge;
    const bool line = edge.kind == geom::EdgeKind::line;
    const double sweep = line ? 0 : geom::arc_sweep(edge) * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
    const double length = line ? curve.length : curve.radius * std::abs(sweep);
    const double pieces = std::max(2.0, std::ceil(length / (kSampleSpacing * reach_)));
    samples_.push_back({edge.from, norm(edge.from), k, cap});
    for (double j = 1; j < pieces; ++j) {
      const Point p =
          line ? edge.from + (j / pieces) * (edge.to - edge.from)
               : nearest_on(curve, edge.centre + pose_at(j / pieces * sweep, {})(edge.from - edge.centre));
      samples_.push_back({p, norm(p), k, cap});
    }
  };
  const auto& part = clearance_.part().curves();
  for (std::uint32_t k = 0; k < part.size(); ++k) add(part, k, kNoCap);
  for (std::uint32_t cap = 0; cap < caps_.size(); ++cap)
    for (std::uint32_t k = 0; k < caps_[cap].edges.size(); ++k) add(caps_[cap].edges, k, cap);
  // The furthest points come first, because they tell angles apart.
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Sample& a, const Sample& b) { return a.far > b.far; });
}

/// Finds a large ball in each hole of the blank, by halving steps about the middle of the hole's box.
void PoseSearch::collect_voids() {
  const geom::RegionIndex& blank = clearance_.blank();
  const auto& starts = blank.contour_starts();
  for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
    geom::Box box = curve_box(blank.curves()[starts[c]]);
    for (std::uint32_t k = starts[c] + 1; k < starts[c + 1]; ++k) {
      const geom::Box more = curve_box(blank.curves()[k]);
      box = {{std::min(box.low.x, more.low.x), std::min(box.low.y, more.low.y)},
             {std::max(box.high.x, more.high.x), std::max(box.high.y, more.high.y)}};
    }
    const auto empty = [&](Point p) { return blank.contains(p) ? -1.0 : blank.nearest(p).distance; };
    Ball ball{0.5 * (box.low + box.high), 0};
    ball.radius = empty(ball.centre);
    for (double step = 0.25; step > 1e-3; step *= 0.5) {
      const Point size = step * (box.high - box.low), from = ball.centre;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const Point p = from + Point{i * size.x, j * size.y};
          if (const double radius = empty(p); radius > ball.radius) ball = {p, radius};
        }
    }
    // A ball outside the blank altogether says little that samples do not say.
    const geom::Box all = blank.bounds();
    const bool within = ball.centre.x > all.low.x && ball.centre.x < all.high.x &&
                        ball.centre.y > all.low.y && ball.centre.y < all.high.y;
    if (ball.radius > doubt_ && within) voids_.push_back({ball.centre, ball.radius - doubt_});
  }
}

double PoseSearch::size(const PoseCell& cell) const {
  return std::max({cell.half_x, cell.half_y, reach_ * cell.half_theta});
}

std::array<double, 3> PoseSearch::trusted(double half) const {
  return {root_.half_x > 0 ? half : 0, root_.half_y > 0 ? half : 0, root_.half_theta > 0 ? half : 0};
}

void PoseSearch::take(Node& node, double bound, const CellProof& proof) {
  // Below minus the radius of a ball the sum of distances no longer bounds the clearance.
  for (std::size_t j = 0; j < proof.terms; ++j)
    if (proof.term[j].cap == kNoCap) bound = std::max(bound, -proof.term[j].pair.blank.radius);
  if (!(bound < node.upper)) return;
  node.upper = bound;
  cover_[node.cover].proof = proof;
}

/// Step 1 of docs/design/locate-region.md.
void PoseSearch::bound_coarsely(Node& node) {
  ++work_;
  bound_by_samples(node);
  if (!closed(node.upper)) bound_by_voids(node);
}

/// Bounds a cell by single points: a point of the part is no further inside the blank than its distance from
/// the boundary, nor less.
void PoseSearch::bound_by_samples(Node& node) {
  const PoseCell& cell = node.cell;
  const geom::SinCos turn = geom::sincos(cell.theta);
  const double slide = std::sqrt(cell.half_x * cell.half_x + cell.half_y * cell.half_y);
  const double per_far = turn_distance(1, cell.half_theta);
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const Point p = samples_[k].at;
    const Point q{turn.cosine * p.x - turn.sine * p.y + cell.pivot.x,
                  turn.sine * p.x + turn.cosine * p.y + cell.pivot.y};
    const DistanceGrid::Value value = blank_grid_.near(q);
    const std::uint32_t cap = samples_[k].cap;
    const double at_middle = cap == kNoCap ? value.signed_distance : caps_[cap].most - value.signed_distance;
    const double bound = at_middle + value.off + slide + per_far * samples_[k].far + rounding_;
    if (!(bound < node.upper)) continue;
    CellProof proof;
    proof.terms = 1;
    const double depth = -value.signed_distance;
    if (cap != kNoCap) {
      if (!(depth < 0)) continue;
      proof.term[0] = {{{p, 0}, {value.at, -depth - caps_[cap].most}}, 1, cap};
    } else {
      proof.term[0] = {{{p, 0}, depth > 0 ? Ball{value.at, depth} : Ball{value.nearest, 0}}, 1, kNoCap};
    }
    take(node, bound, proof);
    if (closed(node.upper)) {
      // A sample that closes cells often is tried early.
      std::swap(samples_[k], samples_[k / 2]);
      return;
    }
  }
}

/// Bounds a cell by the holes of the blank: a hole is no further from the part's material than its ball.
void PoseSearch::bound_by_voids(Node& node) {
  const PoseCell& cell = node.cell;
  const geom::SinCos turn = geom::sincos(cell.theta);
  const double slide = std::sqrt(cell.half_x * cell.half_x + cell.half_y * cell.half_y);
  for (const Ball& ball : voids_) {
    const Point d = ball.centre - cell.pivot;
    const Point p{turn.cosine * d.x + turn.sine * d.y, turn.cosine * d.y - turn.sine * d.x};
    const DistanceGrid::Value value = part_grid_.near(p);
    const double bound = -value.signed_distance - ball.radius + value.off + slide +
                         turn_distance(norm(p), cell.half_theta) + rounding_;
    if (!(bound < node.upper)) continue;
    CellProof proof;
    proof.terms = 1;
    proof.term[0] = {
        {value.signed_distance > 0 ? Ball{value.at, value.signed_distance} : Ball{value.nearest, 0}, ball},
        1,
        kNoCap};
    take(node, bound, proof);
    if (closed(node.upper)) return;
  }
}

CellRow PoseSearch::row_of(const BallPair& pair, const PoseCell& cell) const {
  const geom::SinCos turn = geom::sincos(cell.theta);
  const Point c = pair.part.centre;
  const Point p{turn.cosine * c.x - turn.sine * c.y, turn.sine * c.x + turn.cosine * c.y};
  const Point w = p + cell.pivot - pair.blank.centre;
  const double distance = norm(w), far = norm(p), h = cell.half_theta;
  const double radii = pair.part.radius + pair.blank.radius;
  const double slide = std::sqrt(cell.half_x * cell.half_x + cell.half_y * cell.half_y);
  // No pose of the cell moves the centre further than this.
  const double anyway = slide + turn_distance(far, h);
  CellRow row{{0, 0, 0}, distance + anyway - radii};
  if (!(distance > 0)) return row;
  const Point u = (1 / distance) * w;
  // The bound is |w + d| <= u . (w + d) + |d across u|^2 / (2 u . (w + d)), where d = slide + turn J p + a
  // rest below turn^2 / 2 |p|. Of the rest, only the part towards the middle of the turn counts along u.
  const double lever = dot(u, geom::perpendicular(p)), along_p = dot(u, p), rest = 0.5 * h * h * far;
  const double along = std::abs(u.x) * cell.half_x + std::abs(u.y) * cell.half_y + std::abs(lever) * h + rest;
  const double across =
      std::abs(u.y) * cell.half_x + std::abs(u.x) * cell.half_y + std::abs(along_p) * h + rest;
  if (!(distance > along)) return row;
  const double curved = across * across / (2 * (distance - along)) + 0.5 * h * h * std::max(0.0, -along_p) +
                        h * h * h / 6 * far;
  if (!(curved < anyway)) return row;
  row.slope = {u.x, u.y, lever / reach_};
  row.level = distance - radii + curved;
  return row;
}

void PoseSearch::fill_rows(const Node& node) {
  rows_.clear();
  for (const std::uint32_t k : node.pairs) rows_.push_back(row_of(known_[k].pair, node.cell));
}

bool PoseSearch::solve(Node& node, CellSolution& solution) {
  const PoseCell& cell = node.cell;
  ++work_;
  solution = solve_cell(rows_, {cell.half_x, cell.half_y, reach_ * cell.half_theta});
  CellProof proof;
  for (std::size_t j = 0; j < solution.rows; ++j) {
    const Known& known = known_[node.pairs[solution.row[j]]];
    proof.term[proof.terms++] = {known.pair, solution.multiplier[j], known.cap};
  }
  take(node, solution.bound + rounding_, proof);
  return closed(node.upper);
}

/// Adds pairs for the contacts of the last measurement. Returns false when all were known.
bool PoseSearch::add_contacts(Node& node, double theta, Point pivot, double within) {
  const geom::SinCos turn = geom::sincos(theta);
  const double same = 1e-9 * scale_;
  const auto near = [&](Point a, Point b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y) < same; };
  double least = kInfinity;
  for (const PoseContact& contact : contacts_) least = std::min(least, contact.distance);
  bool added = false;
  for (const PoseContact& contact : contacts_) {
    if (contact.distance > least + within) continue;
    Known known;
    known.pair = {{contact.part, 0}, {contact.blank, 0}};
    known.part = contact.part, known.blank = contact.blank, known.cap = contact.cap;
    known.normal_of_blank = contact.normal;
    known.normal_of_part = {turn.cosine * contact.normal.x + turn.sine * contact.normal.y,
                            turn.cosine * contact.normal.y - turn.sine * contact.normal.x};
    const bool again = std::any_of(node.pairs.begin(), node.pairs.end(), [&](std::uint32_t k) {
      const Known& other = known_[k];
      return other.cap == contact.cap && near(other.part, contact.part) && near(other.blank, contact.blank);
    });
    if (again) continue;
    if (contact.distance < 0 || contact.cap != kNoCap) grow(known);
    if (contact.distance < 0 && contact.cap == kNoCap) grow_about_points(known, pose_at(theta, pivot));
    node.pairs.push_back(static_cast<std::uint32_t>(known_.size()));
    known_.push_back(known);
    rows_.push_back(row_of(known.pair, node.cell));
    added = true;
  }
  return added;
}

void PoseSearch::grow(Known& known) const {
  known.grown = true;
  const double most = kLargestBall * scale_, least = kSmallestBall * scale_;
  if (known.cap != kNoCap) {
    // The ball lies in the material and touches the blank's outline where the point is nearest to it.
    const Ball ball = tangent_ball(clearance_.blank(), known.blank, -known.normal_of_blank, most, 0, doubt_);
    const bool held = ball.radius > 0 && clearance_.blank().contains(ball.centre);
    known.pair.blank = {held ? ball.centre : known.blank, (held ? ball.radius : 0) - caps_[known.cap].most};
    return;
  }
  const Ball outside =
      tangent_ball(clearance_.blank(), known.pair.blank.centre, -known.normal_of_blank, most, least, doubt_);
  if (outside.radius > 0 && !clearance_.blank().contains(outside.centre)) known.pair.blank = outside;
  const Ball inside =
      tangent_ball(clearance_.part(), known.pair.part.centre, known.normal_of_part, scale_, least, doubt_);
  if (inside.radius > 0 && clearance_.part().contains(inside.centre)) known.pair.part = inside;
}

/// Gives a ball to a crossing without balls that touch both outlines, such as a corner deep in a narrow
/// notch. It would be two points, whose distance says nothing. The ball is the empty disc about the part's
/// point outside the blank, or the disc in the part about the blank's point.
void PoseSearch::grow_about_points(Known& known, const BlankFromPart& pose) const {
  if (known.pair.part.radius > 0 || known.pair.blank.radius > 0) return;
  const Point part = pose(known.part), blank = pose.inverse()(known.blank);
  if (!clearance_.blank().contains(part)) {
    const double radius = clearance_.blank().nearest(part).distance - doubt_;
    if (radius > 0) known.pair.blank = {part, radius};
  } else if (clearance_.part().contains(blank)) {
    const double radius = clearance_.part().nearest(blank).distance - doubt_;
    if (radius > 0) known.pair.part = {blank, radius};
  }
}

/// Keeps those pairs of a cell that can be the least somewhere in it, the lowest ones first.
void PoseSearch::keep_relevant(Node& node) const {
  const PoseCell& cell = node.cell;
  struct Ranked {
    double level;
    std::uint32_t pair;
  };
  std::vector<Ranked> ranked;
  for (std::size_t k = 0; k < node.pairs.size(); ++k) {
    const CellRow& row = rows_[k];
    const double lowest = row.level - std::abs(row.slope[0]) * cell.half_x -
                          std::abs(row.slope[1]) * cell.half_y -
                          std::abs(row.slope[2]) * reach_ * cell.half_theta;
    if (lowest <= node.upper) ranked.push_back({row.level, node.pairs[k]});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.level != b.level ? a.level < b.level : a.pair < b.pair;
  });
  if (ranked.size() > kMostPairs) ranked.resize(kMostPairs);
  node.pairs.clear();
  for (const Ranked& r : ranked) node.pairs.push_back(r.pair);
}

/// Step 2 of docs/design/locate-region.md.
void PoseSearch::bound_closely(Node& node) {
  const PoseCell& cell = node.cell;
  const double within = size(cell);
  fill_rows(node);
  double theta = cell.theta;
  Point pivot = cell.pivot;
  CellSolution solution;
  bool solved = false;
  for (int round = 0;; ++round) {
    if (!rows_.empty()) {
      if (solve(node, solution)) return;
      solved = true;
      theta = cell.theta + solution.z[2] / reach_;
      pivot = cell.pivot + Point{solution.z[0], solution.z[1]};
    }
    if (round == kRounds) break;
    const MeasuredPose found = measure(theta, pivot, within);
    const std::vector<PoseContact> here = contacts_;
    offer(found, size(cell));
    if (closed(node.upper)) return;
    contacts_ = here;
    if (!add_contacts(node, theta, pivot, within)) break;
  }
  if (!solved) return;
  // The pairs that prove the bound get their balls now.
  bool grown = false;
  for (std::size_t j = 0; j < solution.rows; ++j) {
    const std::uint32_t row = solution.row[j];
    Known& known = known_[node.pairs[row]];
    if (known.grown) continue;
    grow(known);
    rows_[row] = row_of(known.pair, cell);
    grown = true;
  }
  if (grown) solve(node, solution);
  keep_relevant(node);
}

PoseSearch::MeasuredPose PoseSearch::measure(double theta, Point pivot, double margin) {
  ++work_;
  const BlankFromPart pose = pose_at(theta, pivot);
  const phi::RegionClearance::Value value = clearance_.at(pose, margin, &touching_);
  contacts_.clear();
  for (const phi::RegionContact& touching : touching_) {
    const Point out = pose(touching.part) - touching.blank;
    const double distance = norm(out);
    // Points at one place give no direction.
    if (!(distance > 1e-9 * scale_)) continue;
    contacts_.push_back({touching.part, touching.blank, (1 / distance) * out, distance, kNoCap});
  }
  MeasuredPose found{theta, pivot, value.distance, value.inside};
  if (!value.inside) measure_crossing(pose, found);
  if (!caps_.empty()) measure_caps(pose, margin, found);
  return found;
}

void PoseSearch::measure_caps(const BlankFromPart& pose, double margin, MeasuredPose& found) {
  for (std::uint32_t cap = 0; cap < caps_.size(); ++cap) {
    const double most = caps_[cap].most;
    const double deepest = clearance_.deepest(pose, caps_[cap].edges, 0.125 * goal_.gap, margin, deepest_);
    found.value = std::min(found.value, most - deepest);
    for (const phi::RegionContact& at : deepest_) {
      // Points at one place give no direction.
      if (!(at.distance > 1e-9 * scale_)) continue;
      contacts_.push_back(
          {at.part, at.blank, (1 / at.distance) * (at.blank - pose(at.part)), most - at.distance, cap});
    }
  }
}

void PoseSearch::measure_crossing(const BlankFromPart& pose, MeasuredPose& found) {
  std::vector<PoseContact> crossing;
  const auto add = [&](Point part, Point blank, double depth) {
    const Point in = blank - pose(part);
    if (depth > 1e-9 * scale_) crossing.push_back({part, blank, (1 / depth) * in, -depth, kNoCap});
  };
  const auto back = pose.inverse();
  /// Returns the blank's edge nearest to a point of the part, if the point lies outside the blank.
  const auto sticks_out = [&](Point p) -> std::optional<std::uint32_t> {
    const Point q = pose(p);
    const DistanceGrid::Value value = blank_grid_.near(q);
    // The grid alone shows that the point is inside.
    if (value.signed_distance > value.off) return std::nullopt;
    if (value.signed_distance > -value.off && clearance_.blank().contains(q)) return std::nullopt;
    const auto nearest = clearance_.blank().nearest(q, value.edge);
    add(p, nearest.point, nearest.distance);
    return nearest.edge;
  };
  const auto sticks_in = [&](Point b) {
    const Point p = back(b);
    if (!clearance_.part().contains(p)) return;
    const auto nearest = clearance_.part().nearest(p);
    add(nearest.point, b, nearest.distance);
  };
  // Between its ends a curve is deepest behind another one where it turns towards that one.
  const auto deepest = [&](std::uint32_t part_edge, std::uint32_t blank_edge) {
    const geom::Curve part = phi::placed(clearance_.part().curves()[part_edge], pose);
    const geom::Curve& blank = clearance_.blank().curves()[blank_edge];
    std::array<Point, 2> point;
    for (std::size_t k = deepest_points(part, blank, point); k-- > 0;) sticks_out(back(point[k]));
    for (std::size_t k = deepest_points(blank, part, point); k-- > 0;) sticks_in(point[k]);
  };
  for (const Sample& sample : samples_) {
    // Its point is another sample too.
    if (sample.cap != kNoCap) continue;
    if (const auto edge = sticks_out(sample.at)) deepest(sample.edge, *edge);
  }
  for (const geom::Curve& curve : clearance_.blank().curves()) sticks_in(curve.edge.from);
  for (const phi::RegionContact& pair : touching_)
    if (!(pair.distance > 1e-9 * scale_)) deepest(pair.part_edge, pair.blank_edge);
  const std::size_t kept = std::min(crossing.size(), kMostCrossings);
  std::partial_sort(crossing.begin(), crossing.begin() + static_cast<std::ptrdiff_t>(kept), crossing.end(),
                    [](const PoseContact& a, const PoseContact& b) {
                      if (a.distance != b.distance) return a.distance < b.distance;
                      return a.part.x != b.part.x ? a.part.x < b.part.x : a.part.y < b.part.y;
                    });
  crossing.resize(kept);
  found.value = crossing.empty() ? -1e-9 * scale_ : crossing.front().distance;
  for (const Ball& ball : voids_)
    if (clearance_.part().contains(back(ball.centre))) found.value = std::min(found.value, -ball.radius);
  contacts_.insert(contacts_.begin(), crossing.begin(), crossing.end());
}

void PoseSearch::offer(const MeasuredPose& found, double trust) {
  if (!(found.value > best_.value)) return;
  best_ = found;
  polish(found, trust);
}

/// Step 3 of docs/design/locate-region.md: climbs from a pose. It solves the program of the pose's contacts
/// in a box, goes there, and halves the box where that does not help.
void PoseSearch::polish(MeasuredPose found, double trust) {
  constexpr int kMostSteps = 40;
  double margin = 2 * trust;
  found = measure(found.theta, found.pivot, margin);
  for (int step = 0; step < kMostSteps && !contacts_.empty() && !run_.stop_requested(); ++step) {
    const geom::SinCos turn = geom::sincos(found.theta);
    std::vector<CellRow> rows;
    for (const PoseContact& contact : contacts_) {
      const Point c = contact.part;
      const Point p{turn.cosine * c.x - turn.sine * c.y, turn.sine * c.x + turn.cosine * c.y};
      rows.push_back(
          {{contact.normal.x, contact.normal.y, dot(contact.normal, geom::perpendicular(p)) / reach_},
           contact.distance});
    }
    const double theta_low = root_.theta - root_.half_theta, theta_high = root_.theta + root_.half_theta;
    const CellSolution solution = solve_cell(rows, trusted(trust));
    if (!(solution.bound > found.value + 0.1 * goal_.gap)) break;
    const std::vector<PoseContact> here = contacts_;
    const double theta = std::clamp(found.theta + solution.z[2] / reach_, theta_low, theta_high);
    const MeasuredPose next = measure(theta, found.pivot + Point{solution.z[0], solution.z[1]}, margin);
    if (next.value > found.value) {
      const double gained = next.value - found.value, hoped = solution.bound - found.value;
      found = next;
      if (found.value > best_.value) best_ = found;
      if (gained < 0.25 * hoped) trust *= 0.5;
    } else {
      contacts_ = here;
      trust *= 0.25;
    }
    margin = 2 * trust;
  }
}

std::array<PoseSearch::Node, 2> PoseSearch::split(const Node& node) {
  const PoseCell& cell = node.cell;
  // Programs bound a cell well that is much longer than the part, as a spike of the blank is, once the part
  // hardly turns in it, and never while it turns all round.
  const bool turns_first = size(cell) <= fine_ && cell.half_theta > kFirstTurn;
  const double turn = turns_first ? kInfinity : reach_ * cell.half_theta;
  std::array<Node, 2> half{node, node};
  CoverTree::Axis axis;
  double at = 0;
  if (turn >= cell.half_x && turn >= cell.half_y) {
    axis = CoverTree::Axis::theta, at = cell.theta;
    for (int side = 0; side < 2; ++side) {
      PoseCell& c = half[static_cast<std::size_t>(side)].cell;
      c.half_theta = 0.5 * cell.half_theta;
      c.theta = cell.theta + (side == 0 ? -c.half_theta : c.half_theta);
    }
  } else if (cell.half_x >= cell.half_y) {
    axis = CoverTree::Axis::x, at = cell.pivot.x;
    for (int side = 0; side < 2; ++side) {
      PoseCell& c = half[static_cast<std::size_t>(side)].cell;
      c.half_x = 0.5 * cell.half_x;
      c.pivot.x = cell.pivot.x + (side == 0 ? -c.half_x : c.half_x);
    }
  } else {
    axis = CoverTree::Axis::y, at = cell.pivot.y;
    for (int side = 0; side < 2; ++side) {
      PoseCell& c = half[static_cast<std::size_t>(side)].cell;
      c.half_y = 0.5 * cell.half_y;
      c.pivot.y = cell.pivot.y + (side == 0 ? -c.half_y : c.half_y);
    }
  }
  const CellProof proof = cover_[node.cover].proof;
  for (Node& h : half) {
    h.cover = static_cast<std::uint32_t>(cover_.size());
    cover_.push_back({});
    cover_.back().proof = proof;
  }
  CoverNode& parent = cover_[node.cover];
  parent = {axis, at, half[0].cover, half[1].cover, {}};
  return half;
}

void PoseSearch::report_progress(const PoseCell& closed_cell) {
  if (!run_.progress) return;
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 1.0; };
  closed_share_ += share(closed_cell.half_theta, root_.half_theta) * share(closed_cell.half_x, root_.half_x) *
                   share(closed_cell.half_y, root_.half_y);
  if (work_ < next_report_) return;
  next_report_ = work_ + kReportEvery;
  run_.progress({work_, std::min(1.0, closed_share_)});
}

std::vector<PoseSearch::Held> PoseSearch::held_at(const MeasuredPose& found) {
  const double margin = std::max(goal_.gap, 1e-6 * scale_);
  (void)measure(found.theta, found.pivot, margin);
  const BlankFromPart pose = pose_at(found.theta, found.pivot);
  std::vector<CellRow> rows;
  std::vector<Held> near;
  const auto add = [&](const phi::RegionContact& contact, std::uint32_t cap) {
    const Point out = pose(contact.part) - contact.blank;
    const double distance = norm(out), side = cap == kNoCap ? 1 : -1;
    if (!(distance > 1e-9 * scale_)) return;
    const Point n = (side / distance) * out, p = pose.rotate(contact.part);
    const double left = cap == kNoCap ? distance : caps_[cap].most - distance;
    rows.push_back({{n.x, n.y, dot(n, geom::perpendicular(p)) / reach_}, left});
    near.push_back({contact, 0, cap});
  };
  for (const phi::RegionContact& contact : touching_) add(contact, kNoCap);
  for (std::uint32_t cap = 0; cap < caps_.size(); ++cap) {
    (void)clearance_.deepest(pose, caps_[cap].edges, 0.125 * goal_.gap, margin, deepest_);
    for (const phi::RegionContact& contact : deepest_) add(contact, cap);
  }
  std::vector<Held> held;
  if (rows.empty()) return held;
  const CellSolution solution = solve_cell(rows, trusted(0.1 * fine_));
  for (std::size_t j = 0; j < solution.rows; ++j) {
    held.push_back(near[solution.row[j]]);
    held.back().multiplier = solution.multiplier[j];
  }
  std::sort(held.begin(), held.end(), [](const Held& a, const Held& b) {
    return a.contact.blank_edge != b.contact.blank_edge ? a.contact.blank_edge < b.contact.blank_edge
                                                        : a.contact.part_edge < b.contact.part_edge;
  });
  return held;
}

void PoseSearch::run() {
  const auto lower = [](const Node& a, const Node& b) {
    return a.upper != b.upper ? a.upper < b.upper : a.cover > b.cover;
  };
  std::vector<Node> open;
  cover_.assign(1, {});
  open.push_back({root_, kInfinity, 0, {}});
  // The bound of what is closed.
  upper_ = -kInfinity;
  finished_ = true;
  std::uint64_t divided = 0, next_dive = kFirstDive;
  while (!open.empty()) {
    if (closed(open.front().upper) || best_.value >= goal_.enough) break;
    // The root is always divided: before that nothing bounds it.
    if (divided > 0 && (work_ >= run_.work_limit || run_.stop_requested())) {
      finished_ = false;
      break;
    }
    std::pop_heap(open.begin(), open.end(), lower);
    const Node node = std::move(open.back());
    open.pop_back();
    if (++divided == next_dive && size(node.cell) > fine_) {
      polish(measure(node.cell.theta, node.cell.pivot, size(node.cell)), size(node.cell));
      next_dive *= 2;
    }
    for (Node& half : split(node)) {
      if (size(half.cell) > fine_) {
        bound_coarsely(half);
      } else {
        bound_closely(half);
      }
      if (closed(half.upper)) {
        upper_ = std::max(upper_, half.upper);
        report_progress(half.cell);
      } else {
        open.push_back(std::move(half));
        std::push_heap(open.begin(), open.end(), lower);
      }
    }
  }
  for (const Node& node : open) upper_ = std::max(upper_, node.upper);
  if (best_.value == -kInfinity) climb_from_anywhere();
}

/// Looks for the least bad placement that a few climbs find, because nowhere was there hope enough to look
/// closely.
void PoseSearch::climb_from_anywhere() {
  const int count = root_.half_theta > 0 ? kHopelessClimbs : 1;
  for (int k = 0; k < count; ++k) {
    const double share = (2 * k + 1.0) / count - 1;
    const MeasuredPose start = measure(root_.theta + share * root_.half_theta, root_.pivot, fine_);
    if (start.value > best_.value) best_ = start;
    if (run_.stop_requested()) return;  // some placement is there to be told
    polish(start, 0.25 * scale_);
  }
}

}  // namespace lekalo::locate
