#include "lekalo/locate/region.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/same_outline.hpp"
#include "lekalo/phi/region.hpp"
#include "locate/search/search_limits.hpp"
#include "pose_search.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Box;
using geom::Contour;
using geom::Edge;
using geom::Point;
using geom::Region;

/// Returns the edges moved by -origin and, if asked for, mirrored in x afterwards.
std::vector<Edge> to_local(const std::vector<Edge>& edges, Point origin, bool mirrored) {
  const auto moved = [&](Point p) {
    const Point q = p - origin;
    return mirrored ? Point{-q.x, q.y} : q;
  };
  std::vector<Edge> local;
  for (const Edge& edge : edges) {
    Edge e{edge.kind, moved(edge.from), moved(edge.to), {}};
    if (edge.kind != geom::EdgeKind::line) e.centre = moved(edge.centre);
    if (mirrored && edge.kind != geom::EdgeKind::line)
      e.kind = edge.kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
    local.push_back(e);
  }
  return local;
}

/// Moves and mirrors regions likewise. Mirrored ones have their material on the right, and nothing here asks
/// for the side.
std::vector<Region> to_local(const std::vector<Region>& regions, Point origin, bool mirrored) {
  std::vector<Region> local;
  for (const Region& region : regions) {
    Region out;
    out.outer = to_local(region.outer, origin, mirrored);
    for (const Contour& hole : region.holes) out.holes.push_back(to_local(hole, origin, mirrored));
    local.push_back(std::move(out));
  }
  return local;
}

double largest(const Box& box) {
  return std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
}

Point middle(const Box& box) {
  return {0.5 * box.low.x + 0.5 * box.high.x, 0.5 * box.low.y + 0.5 * box.high.y};
}

std::optional<std::uint32_t> optional_cap(std::uint32_t cap) {
  return cap == kNoCap ? std::nullopt : std::optional(cap);
}

/// The search cannot close a gap smaller than this part of the coordinates: the bound of every box has a few
/// times 2^-35 of them for rounding.
constexpr double kLeastGap = 0x1p-32;

class RegionLocaliser {
 public:
  RegionLocaliser(const RegionProblem& problem, const RegionOptions& options)
      : problem_(problem), options_(options), given_(problem.part, problem.blank) {
    // A locked shift is that of the part's own origin, because only that stays where it is when the part
    // turns.
    if (!problem.locked.x && !problem.locked.y) part_origin_ = middle(given_.part().bounds());
    blank_origin_ = middle(given_.blank().bounds());
    far_ = largest(given_.part().bounds()) + largest(given_.blank().bounds());
    for (const std::optional<double>& locked : {problem.locked.x, problem.locked.y})
      far_ += std::abs(locked.value_or(0));
    // The pivot need not be material. If it is not, the box grows by its distance from the material.
    pivot_off_ = given_.part().contains(part_origin_) ? 0 : given_.part().nearest(part_origin_).distance;
    gap_ = std::max(options.gap, kLeastGap * far_);
  }

  RegionResult run() {
    RegionResult result;
    result.pivot = part_origin_;
    result.upper_bound = -std::numeric_limits<double>::infinity();
    double best = -std::numeric_limits<double>::infinity();
    bool finished = true;
    for (const bool mirrored : {false, true}) {
      if (problem_.mirror == (mirrored ? Mirror::no : Mirror::yes)) continue;
      const phi::RegionClearance local(to_local(problem_.part, part_origin_, mirrored),
                                       to_local(problem_.blank, blank_origin_, false));
      RunControl run = options_.run;
      if (run.work_limit != std::numeric_limits<std::uint64_t>::max())
        run.work_limit = run.work_limit > result.work ? run.work_limit - result.work : 0;
      const std::vector<LocalCap> caps = local_caps(part_origin_, mirrored);
      const PoseSearch::Goal goal{
          search_gap(), std::max({best, options_.not_above - search_gap(), -furthest_out() - search_gap()}),
          options_.enough + taken(), options_.min_allowance};
      PoseSearch search(local, caps, root(), far_, goal, run);
      search.run();
      finished = finished && search.finished();
      result.work += search.work();
      result.upper_bound = std::max(result.upper_bound, search.upper());
      if (options_.keep_certificate) result.certificate.push_back(tree(search, mirrored));
      if (search.best().value > best) {
        best = search.best().value;
        result.found = true;
        result.mirrored = mirrored;
        result.best = placement(search.best(), mirrored);
        result.contacts = contacts(search, mirrored);
      }
    }
    // The root holds the pivots of poses that stick out by less than furthest_out(), but for rounding.
    result.upper_bound = std::max(result.upper_bound, -furthest_out() + rounding());
    result.upper_bound += problem_.part_tolerance + problem_.blank_tolerance;
    result.upper_bound = std::nextafter(result.upper_bound, std::numeric_limits<double>::infinity());
    result.shortfall = std::max(0.0, options_.min_allowance - result.best.clearance);
    const bool closed = result.upper_bound - result.best.clearance <= std::max(gap_, 2 * taken());
    result.status = finished && closed ? Status::optimal : Status::stopped;
    if (result.upper_bound < options_.min_allowance) result.status = Status::infeasible;
    return result;
  }

 private:
  [[nodiscard]] std::vector<LocalCap> local_caps(Point origin, bool mirrored) const {
    std::vector<LocalCap> caps;
    for (const Cap& cap : problem_.caps) {
      caps.push_back({{}, cap.most});
      for (const Edge& edge : to_local(cap.edges, origin, mirrored))
        caps.back().edges.push_back(geom::make_curve(edge));
    }
    return caps;
  }

  /// Returns how much of the gap is taken by rounding and the tolerances.
  [[nodiscard]] double taken() const {
    return rounding() + 2 * (problem_.part_tolerance + problem_.blank_tolerance);
  }
  [[nodiscard]] double rounding() const { return 64 * geom::kEdgeDistanceError * far_; }
  [[nodiscard]] double search_gap() const { return std::max(gap_ - taken(), 0.25 * gap_); }

  /// Placements where more of the part sticks out than this are not searched, mm.
  [[nodiscard]] double furthest_out() const {
    const Box box = given_.blank().bounds();
    return 0.03125 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  }

  [[nodiscard]] PoseCell root() const {
    // If no material of the part is deeper outside the blank than furthest_out(), the pivot is no further
    // outside the blank's box than that and its distance from the material.
    const Box box = given_.blank().bounds();
    const Point half = 0.5 * (box.high - box.low);
    const double more = pivot_off_ + furthest_out();
    const AngleWindow& window = problem_.window;
    PoseCell cell{0.5 * (window.from + window.to),
                  0.5 * (window.to - window.from) * (1 + 0x1p-50),
                  {0, 0},
                  half.x + more,
                  half.y + more};
    const LockedShift& locked = problem_.locked;
    if (locked.x) cell.pivot.x = *locked.x - blank_origin_.x, cell.half_x = 0;
    if (locked.y) cell.pivot.y = *locked.y - blank_origin_.y, cell.half_y = 0;
    return cell;
  }

  /// Returns the pose in the file's coordinates. Its doubles are fixed first, and its clearance is measured
  /// at those.
  [[nodiscard]] Placement placement(const PoseSearch::MeasuredPose& found, bool mirrored) const {
    const Point pivot = BlankFromPart::from_angle(found.theta, {}, mirrored).rotate(part_origin_);
    Placement placement{found.pivot.x + blank_origin_.x - pivot.x, found.pivot.y + blank_origin_.y - pivot.y,
                        found.theta, 0};
    if (problem_.locked.x) placement.x = *problem_.locked.x;
    if (problem_.locked.y) placement.y = *problem_.locked.y;
    const BlankFromPart pose =
        BlankFromPart::from_angle(placement.theta, {placement.x, placement.y}, mirrored);
    const phi::RegionClearance::Value value = given_.at(pose);
    double measured = value.inside ? value.distance : -given_.depth(pose, 0.25 * gap_);
    std::vector<phi::RegionContact> places;
    for (const LocalCap& cap : local_caps({}, false))
      measured = std::min(measured, cap.most - given_.deepest(pose, cap.edges, 0.125 * gap_, 0, places));
    const double far = far_ + std::abs(placement.x) + std::abs(placement.y);
    placement.clearance =
        measured - 4 * geom::kEdgeDistanceError * far - problem_.part_tolerance - problem_.blank_tolerance;
    return placement;
  }

  /// Returns a point of the local part in the part's own frame.
  [[nodiscard]] Point given_point(Point p, bool mirrored) const {
    return Point{mirrored ? -p.x : p.x, p.y} + part_origin_;
  }

  [[nodiscard]] std::vector<Touch> contacts(PoseSearch& search, bool mirrored) const {
    std::vector<Touch> touches;
    for (const PoseSearch::Held& held : search.held_at(search.best())) {
      const phi::RegionContact& c = held.contact;
      touches.push_back({c.part_edge, c.blank_edge, given_point(c.part, mirrored), c.blank + blank_origin_,
                         c.distance, held.multiplier, optional_cap(held.cap)});
    }
    return touches;
  }

  [[nodiscard]] CoverTree tree(const PoseSearch& search, bool mirrored) const {
    CoverTree tree;
    tree.mirrored = mirrored;
    const PoseCell cell = root();
    tree.theta_from = cell.theta - cell.half_theta, tree.theta_to = cell.theta + cell.half_theta;
    const Point half{cell.half_x, cell.half_y};
    tree.box = {blank_origin_ - half, blank_origin_ + half};
    if (problem_.locked.x) tree.box.low.x = tree.box.high.x = *problem_.locked.x;
    if (problem_.locked.y) tree.box.low.y = tree.box.high.y = *problem_.locked.y;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const CoverNode& node = search.cover()[open.back()];
      open.pop_back();
      switch (node.axis) {
        case CoverTree::Axis::leaf: {
          tree.nodes.push_back({CoverTree::Axis::leaf, 0, static_cast<std::uint32_t>(tree.terms.size()),
                                static_cast<std::uint32_t>(node.proof.terms)});
          for (std::size_t j = 0; j < node.proof.terms; ++j) {
            const CellProof::Term& term = node.proof.term[j];
            const double less = term.cap == kNoCap ? 0 : problem_.caps[term.cap].most;
            tree.terms.push_back({given_point(term.pair.part.centre, mirrored), term.pair.part.radius,
                                  term.pair.blank.centre + blank_origin_, term.pair.blank.radius + less,
                                  term.multiplier, optional_cap(term.cap)});
          }
          continue;
        }
        case CoverTree::Axis::theta:
          tree.nodes.push_back({CoverTree::Axis::theta, node.at, 0, 0});
          break;
        case CoverTree::Axis::x:
          tree.nodes.push_back({CoverTree::Axis::x, node.at + blank_origin_.x, 0, 0});
          break;
        case CoverTree::Axis::y:
          tree.nodes.push_back({CoverTree::Axis::y, node.at + blank_origin_.y, 0, 0});
          break;
      }
      open.push_back(node.high);
      open.push_back(node.low);
    }
    return tree;
  }

  const RegionProblem& problem_;
  const RegionOptions& options_;
  phi::RegionClearance given_;
  Point part_origin_, blank_origin_;
  double far_ = 0, pivot_off_ = 0;
  double gap_ = 0;  ///< that is searched for, mm
};

/// Says whether the part may lie as it is drawn: not turned, not shifted, not mirrored.
bool may_stay(const RegionProblem& problem) {
  return problem.window.from <= 0 && problem.window.to >= 0 && problem.mirror != Mirror::yes &&
         problem.locked.x.value_or(0) == 0 && problem.locked.y.value_or(0) == 0;
}

/// Returns the placement of a part in a blank of its own outline, which needs no search.
RegionResult in_own_outline(const RegionProblem& problem, double min_allowance) {
  RegionResult result;
  result.own_outline = problem.one_file ? OwnOutline::file : OwnOutline::regions;
  result.found = true;
  // Twice the sum of doubles is rounded up by more than the sum was rounded down.
  const double off =
      problem.one_file ? 0 : (problem.part_tolerance + problem.blank_tolerance) * (1 + 0x1p-50);
  result.upper_bound = off;
  result.best.clearance = 0 - off;
  result.shortfall = std::max(0.0, min_allowance - result.best.clearance);
  result.status = result.upper_bound < min_allowance ? Status::infeasible : Status::optimal;
  return result;
}

}  // namespace

Result<RegionResult> locate_regions(const RegionProblem& problem, const RegionOptions& options) {
  LEKALO_CHECK(check_limits(problem.window, options.gap, options.min_allowance));
  if (!(problem.part_tolerance >= 0) || !(problem.blank_tolerance >= 0))
    return failure(ErrorCode::usage, "tolerances must not be negative");
  if (problem.part.empty() || problem.blank.empty())
    return failure(ErrorCode::bad_input, "part and blank must have an outline");
  for (const std::optional<double>& locked : {problem.locked.x, problem.locked.y})
    if (locked && !(std::abs(*locked) <= limits::kLargestCoordinate))
      return failure(ErrorCode::usage,
                     fmt::format("a locked x or y must be a number up to {:g}", limits::kLargestCoordinate));
  if (problem.caps.empty() && may_stay(problem) && geom::same_outline(problem.part, problem.blank))
    return in_own_outline(problem, options.min_allowance);
  return RegionLocaliser(problem, options).run();
}

}  // namespace lekalo::locate
