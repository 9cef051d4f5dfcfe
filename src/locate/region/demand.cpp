#include "lekalo/locate/demand.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "choice.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/phi/region.hpp"
#include "locate/search/search_limits.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Edge;
using geom::Point;
using geom::Region;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Searches of one bisection; halving a metre to a micrometre takes twenty.
constexpr int kMostDecisions = 40;
/// Searches until the margin of edges with scales stays.
constexpr int kMostGrowths = 12;
/// Largest allowances are decided to this part of the blank's size, or to the gap where that is larger: where
/// the deepest point is as far from two edges, bounds get sharper only as fast as boxes get smaller.
constexpr double kCapGap = 1e-4;
/// One decision of a bisection leaves this share of the bisection's own gap open.
constexpr double kDecisionGap = 0.25;
/// Units of work after which a search with caps is given up, with the bound it has.
constexpr std::uint64_t kDecisionWork = 20'000;
/// Decisions about largest allowances stay below the margin by this share of the gap of one decision.
constexpr double kStrictly = 1e-3;
/// Questions of one bisection that may stay open: each has cost all its work, or is nearer to the truth than
/// its gap.
constexpr int kMostUnanswered = 6;
/// How much less largest allowance is asked for first, in gaps.
constexpr double kFirstStep = 4;
/// This share of a sum allows for rounding where a few numbers are written as decimals and added again by
/// somebody else.
constexpr double kRounding = 0x1p-49;
/// Samples of the outline for the mean square deviation.
constexpr double kEvenSamples = 600;

std::vector<Edge> edges_of(const std::vector<Region>& regions) {
  std::vector<Edge> edges;
  for (const Region& region : regions) {
    edges.insert(edges.end(), region.outer.begin(), region.outer.end());
    for (const geom::Contour& hole : region.holes) edges.insert(edges.end(), hole.begin(), hole.end());
  }
  return edges;
}

Result<void> check_features(const DemandProblem& problem, std::size_t edges) {
  const auto wrong = [](const std::string& name, std::string_view what) {
    return failure(ErrorCode::usage, fmt::format("feature \"{}\": {}", name, what));
  };
  const auto not_negative = [](double value) { return value >= 0 && std::isfinite(value); };
  std::vector<const Feature*> owner(edges, nullptr);
  for (const Feature& f : problem.features) {
    if (f.edges.empty()) return wrong(f.name, "it has no edges");
    for (const std::uint32_t edge : f.edges) {
      if (edge >= edges)
        return wrong(f.name, fmt::format("edge {} is not one of the part's {}", edge, edges));
      if (owner[edge] != nullptr)
        return wrong(f.name, fmt::format("edge {} belongs to feature \"{}\" too", edge, owner[edge]->name));
      owner[edge] = &f;
    }
    if (f.finished) {
      if (!(*f.finished > 0) || !std::isfinite(*f.finished))
        return wrong(f.name, "the tolerance of a finished feature must be a number above 0");
      if (f.minimum != 0 || f.target || f.maximum || f.scale != 1)
        return wrong(f.name, "a finished feature has no minimum, target, maximum or scale");
      continue;
    }
    if (!not_negative(f.minimum)) return wrong(f.name, "the minimum must be a number that is not negative");
    if (f.target && !not_negative(*f.target))
      return wrong(f.name, "the target must be a number that is not negative");
    if (f.maximum && !(*f.maximum > f.minimum && std::isfinite(*f.maximum)))
      return wrong(f.name, "the maximum must be a number above the minimum");
    if (!(f.scale > 0) || !std::isfinite(f.scale)) return wrong(f.name, "the scale must be a number above 0");
  }
  if (!not_negative(problem.minimum))
    return failure(ErrorCode::usage, "the minimum allowance must be a number that is not negative");
  if (!not_negative(problem.give_up))
    return failure(ErrorCode::usage, "what may be given up must be a number that is not negative");
  if (problem.trade_off == 1) return failure(ErrorCode::usage, "a trade-off curve needs two points or more");
  if (!problem.shapes.caps.empty()) return failure(ErrorCode::usage, "caps are said by features here");
  return {};
}

class DemandLocaliser final : public Choice {
 public:
  DemandLocaliser(const DemandProblem& problem, const RegionOptions& options)
      : problem_(problem),
        shapes_(problem.shapes),
        options_(options),
        clearance_(shapes_.part, shapes_.blank),
        edges_(edges_of(shapes_.part)),
        demand_(edges_.size(), Demand{problem.minimum, 1, false, {}}) {
    for (const Feature& f : problem.features) {
      finished_ = finished_ || f.finished.has_value();
      for (const std::uint32_t edge : f.edges)
        demand_[edge] = {f.minimum, f.scale, f.finished.has_value(), f.target};
      if (!f.maximum && !f.finished) continue;
      caps_.push_back({{}, f.finished.value_or(f.maximum.value_or(0))});
      for (const std::uint32_t edge : f.edges) caps_.back().edges.push_back(edges_[edge]);
      edges_of_cap_.push_back(f.edges);
    }
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const Demand& d = demand_[k];
      if (d.finished) continue;
      least_scale_ = std::min(least_scale_, d.scale), most_scale_ = std::max(most_scale_, d.scale);
      free_edges_.push_back(geom::make_curve(edges_[k]));
    }
    if (least_scale_ == kInfinity) least_scale_ = most_scale_ = 1;  // all of it finished
    const geom::Box part = clearance_.part().bounds(), blank = clearance_.blank().bounds();
    cap_gap_ = std::max(options.gap, kCapGap * norm(blank.high - blank.low));
    for (const Point& corner : {part.low, part.high, blank.low, blank.high})
      far_ = std::max({far_, std::abs(corner.x), std::abs(corner.y)});
  }

  Result<DemandResult> run() {
    if (Result<void> done = find_margin(); !done) return tl::unexpected(std::move(done.error()));
    result_.best = pose_.at, result_.mirrored = pose_.mirrored;
    if (result_.margin >= 0 && problem_.trade_off > 0) {
      if (Result<void> done = trace_curve(); !done) return tl::unexpected(std::move(done.error()));
    }
    if (result_.margin >= 0 && problem_.criterion.choose != nullptr)
      LEKALO_CHECK(problem_.criterion.choose(*this));
    finish();
    return std::move(result_);
  }

  // Criteria ask from here on (choice.hpp).
  [[nodiscard]] const Pose& pose() const override { return pose_; }

  [[nodiscard]] bool allows(const Placement& at) const override {
    const LockedShift& locked = shapes_.locked;
    if (!(window().from <= at.theta && at.theta <= window().to) || at.x != locked.x.value_or(at.x) ||
        at.y != locked.y.value_or(at.y))
      return false;
    const Pose there{at, pose_.mirrored};
    return margin_at(there) >= margin_to_keep() &&
           (!result_.second || depth(there, free_edges_) <= result_.second->kept);
  }

  bool take(const Placement& at) override {
    const bool allowed = allows(at);
    if (allowed) pose_.at = at;
    return allowed;
  }

  Result<void> take_smallest_largest() override {
    // LEKALO_TRY moves the value, in which g++ 12 sees what is not set.
    Result<Second> smallest = smallest_largest(margin_to_keep(), pose_);
    if (!smallest) return tl::unexpected(std::move(smallest.error()));
    pose_ = smallest->pose;
    result_.second = std::move(smallest->what);
    SmallestLargest& second = *result_.second;
    const bool closed = second.found - second.bound <= second.gap;
    if (!closed && result_.status == Status::optimal) result_.status = Status::stopped;
    second.kept = std::max(second.found, second.bound + second.gap);
    return {};
  }

  [[nodiscard]] const phi::RegionClearance& clearance() const override { return clearance_; }

  [[nodiscard]] EvenSamples samples() const override {
    EvenSamples samples;
    double length = 0;
    for (const geom::Curve& curve : free_edges_)
      length +=
          curve.edge.kind == geom::EdgeKind::line ? curve.length : curve.radius * geom::arc_sweep(curve.edge);
    for (std::size_t k = 0; k < edges_.size(); ++k)
      if (!demand_[k].finished) samples.add(edges_[k], length / kEvenSamples, demand_[k].target);
    return samples;
  }

  [[nodiscard]] double spare() const override {
    return std::max(0.0, margin_at(pose_) - margin_to_keep()) * least_scale_;
  }

  [[nodiscard]] std::vector<LocalCap> caps() const override {
    std::vector<LocalCap> caps;
    if (result_.second) caps.push_back({free_edges_, result_.second->kept});
    for (const Cap& cap : caps_) {
      caps.push_back({{}, cap.most});
      for (const Edge& edge : cap.edges) caps.back().edges.push_back(geom::make_curve(edge));
    }
    return caps;
  }

  [[nodiscard]] std::array<bool, 3> free() const override {
    return {!shapes_.locked.x, !shapes_.locked.y, window().to > window().from};
  }

  [[nodiscard]] AngleWindow window() const override { return shapes_.window; }

 private:
  struct Demand {
    double minimum = 0, scale = 1;
    bool finished = false;
    std::optional<double> target;
  };
  struct Grown {
    std::vector<Region> regions;
    double tolerance = 0;
  };

  /// The largest margin less all that may be given up; result_.margin is the largest one until finish().
  [[nodiscard]] double margin_to_keep() const { return std::max(0.0, result_.margin - problem_.give_up); }

  /// True if the part has to be grown anew for every margin. Rims of finished features do not grow.
  [[nodiscard]] bool scaled() const { return least_scale_ < most_scale_ || finished_; }
  [[nodiscard]] double rounding(const Pose& pose) const {
    return 4 * geom::kEdgeDistanceError * (far_ + std::abs(pose.at.x) + std::abs(pose.at.y)) +
           shapes_.part_tolerance + shapes_.blank_tolerance;
  }

  Result<Grown> grown_for(double margin) const {
    std::vector<double> distances;
    for (const Demand& d : demand_) distances.push_back(d.minimum + d.scale * margin);
    std::size_t k = 0;
    for (const Feature& f : problem_.features)
      if (f.finished)
        for (const std::uint32_t edge : f.edges) distances[edge] = -*f.finished;
    for (k = 0; k < distances.size() && distances[k] == 0; ++k) {
    }
    if (k == distances.size()) return Grown{shapes_.part, 0};
    auto made = geom::offset_edges(shapes_.part, distances);
    if (!made) return tl::unexpected(std::move(made.error()));
    if (made->regions.empty())
      return failure(ErrorCode::bad_input, "nothing of the part is left beside its finished features");
    return Grown{std::move(made->regions), made->edge_error};
  }

  /// Some more of the work allowed.
  Result<RegionResult> search(const Grown& part, std::vector<Cap> caps, double shift, double gap,
                              double enough = kInfinity, double not_above = -kInfinity) {
    RegionProblem problem = shapes_;
    problem.part = part.regions;
    problem.part_tolerance = shapes_.part_tolerance + part.tolerance;
    problem.caps = std::move(caps);
    for (Cap& cap : problem.caps) cap.most += shift;
    RegionOptions options = options_;
    options.min_allowance = 0;
    options.gap = gap, options.enough = enough, options.not_above = not_above;
    if (options.run.work_limit != std::numeric_limits<std::uint64_t>::max())
      options.run.work_limit -= std::min(options.run.work_limit, result_.work);
    if (!problem.caps.empty()) options.run.work_limit = std::min(options.run.work_limit, kDecisionWork);
    auto found = locate_regions(problem, options);
    if (found) {
      result_.work += found->work;
      if (ran_out()) stopped_ = true;
    }
    return found;
  }
  [[nodiscard]] bool ran_out() const {
    return options_.run.stop_requested() || result_.work >= options_.run.work_limit;
  }

  /// Gives what the caps of features have left at a pose, rounded down; infinite without caps.
  [[nodiscard]] double left(const Pose& pose) const {
    double least = kInfinity;
    for (const Cap& cap : caps_) {
      std::vector<geom::Curve> curves;
      for (const Edge& edge : cap.edges) curves.push_back(geom::make_curve(edge));
      least = std::min(least, cap.most - depth(pose, curves));
    }
    return least;
  }
  [[nodiscard]] double depth(const Pose& pose, const std::vector<geom::Curve>& curves) const {
    std::vector<phi::RegionContact> places;
    return clearance_.deepest(pose.map(), curves, 0.125 * kDecisionGap * options_.gap, 0, places) +
           rounding(pose);
  }

  /// Returns how far an edge sticks out of the blank, or a little more.
  [[nodiscard]] double edge_out(const Pose& pose, const Edge& edge) const {
    constexpr double kOfLength = 1.0 / 4096, kRelative = 1.0 / 256;
    const bool is_line = edge.kind == geom::EdgeKind::line;
    const double turn = is_line ? 0 : geom::arc_sweep(edge) * (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
    const double length = is_line ? norm(edge.to - edge.from) : geom::arc_radius(edge) * std::abs(turn);
    const BlankFromPart map = pose.map();
    const auto out_at = [&](double share) {
      const Point on_arc =
          edge.centre + BlankFromPart::from_angle(share * turn, {}).rotate(edge.from - edge.centre);
      const Point p = map(is_line ? edge.from + share * (edge.to - edge.from) : on_arc);
      const double distance = clearance_.blank().nearest(p).distance;
      return clearance_.blank().contains(p) ? -distance : distance;
    };
    double reached = std::max({0.0, out_at(0), out_at(1)});
    const auto tolerance = [&] {
      return std::max({0.25 * options_.gap, kRelative * reached, kOfLength * length});
    };
    struct Stretch {
      double middle, half;
    };
    std::vector<Stretch> open{{0.5, 0.5}};
    while (!open.empty()) {
      const Stretch s = open.back();
      open.pop_back();
      const double out = out_at(s.middle);
      reached = std::max(reached, out);
      if (out + s.half * length <= reached + tolerance()) continue;
      for (const double side : {-0.5, 0.5}) open.push_back({s.middle + side * s.half, 0.5 * s.half});
    }
    return reached + tolerance();
  }

  /// Returns how far edges without a minimum stick out of the blank, or a little more. The grown part lacks
  /// their ends where the rim of a finished feature is taken off.
  [[nodiscard]] double bare_edges_out(const Pose& pose) const {
    double out = 0;
    for (std::uint32_t k = 0; k < edges_.size() && finished_; ++k) {
      if (demand_[k].finished || demand_[k].minimum > 0) continue;
      const bool inside = clearance_.blank().contains(pose.map()(edges_[k].from)) &&
                          clearance_.nearest(pose.map(), k).distance > 0;
      if (!inside) out = std::max(out, edge_out(pose, edges_[k]));
    }
    return out;
  }

  /// The margin at a pose, rounded down: of DemandResult.
  [[nodiscard]] double margin_at(const Pose& pose) const {
    const phi::RegionClearance::Value value = base_->at(pose.map());
    const double caps_left = left(pose), bare = bare_edges_out(pose);
    if (!value.inside || bare > 0) {
      // Not a rim of the demands may be missing: how deep it is.
      const double missing = value.inside ? 0 : base_->depth(pose.map(), 0.25 * options_.gap);
      return std::min(-std::max(missing, bare), caps_left) - rounding(pose) - base_tolerance_;
    }
    double least = kInfinity;
    for (std::uint32_t k = 0; k < edges_.size(); ++k) {
      if (demand_[k].finished) continue;
      const double spare = clearance_.nearest(pose.map(), k).distance - demand_[k].minimum;
      least = std::min(least, spare / demand_[k].scale);
    }
    if (least == kInfinity) least = value.distance;
    least -= rounding(pose) / least_scale_;
    return caps_left < 0 ? std::min(caps_left, least) : least;
  }

  void take_pose(const RegionResult& found) {
    const Pose pose{found.best, found.mirrored};
    const double margin = margin_at(pose);
    if (margin > result_.margin) pose_ = pose, result_.margin = margin;
  }

  void take_proof(const Grown& grown, double grown_for, bool with_caps, double shift, RegionResult& found,
                  double bound) {
    if (!(bound < result_.margin_bound)) return;
    result_.margin_bound = bound;
    // A search without caps bounds the clearance alone, so its statement holds however much is added to what
    // the caps have left.
    if (!with_caps) shift = std::max(0.0, found.upper_bound);
    result_.proof = {grown.regions,
                     grown_for,
                     grown.tolerance,
                     shift,
                     found.upper_bound,
                     found.pivot,
                     std::move(found.certificate)};
  }

  Result<void> find_margin() {
    result_.margin = -kInfinity, result_.margin_bound = kInfinity;
    auto base = grown_for(0);
    if (!base) return tl::unexpected(std::move(base.error()));
    base_.emplace(base->regions, shapes_.blank);
    base_tolerance_ = base->tolerance;
    const double gap = options_.gap;
    auto first = search(*base, {}, 0, gap * std::min(1.0, least_scale_));
    if (!first) return tl::unexpected(std::move(first.error()));
    take_pose(*first);
    const double free_bound = first->upper_bound;
    if (free_bound < 0 || !finished_)
      take_proof(*base, 0, false, 0, *first, free_bound < 0 ? free_bound : free_bound / least_scale_);
    if (free_bound < 0) return settle();
    if (finished_) result_.margin_bound = widest_margin();

    if (!caps_.empty() && left(pose_) < 0) {
      auto with_caps = search(*base, caps_, 0, cap_gap_);
      if (!with_caps) return tl::unexpected(std::move(with_caps.error()));
      take_pose(*with_caps);
      if (with_caps->upper_bound < 0) {
        take_proof(*base, 0, true, 0, *with_caps, with_caps->upper_bound);
        return settle();
      }
    }
    if (result_.margin >= 0) {
      // Without its caps first: often they do not bind.
      Result<void> done = finished_ ? Result<void>() : grow();
      if (done && !caps_.empty()) done = bisect_margin(*base);
      if (!done) return done;
    }
    return settle();
  }

  /// No point is deeper in the blank than half its width.
  [[nodiscard]] double widest_margin() const {
    const geom::Box box = clearance_.blank().bounds();
    return 0.5 * std::min(box.high.x - box.low.x, box.high.y - box.low.y) / least_scale_;
  }

  /// With finished features the first search bounds no margin (docs/design/locate-demands.md, Limits). Where
  /// no later one did, the widest margin is all that can be said, and the checker wants it proved too.
  Result<void> prove_widest_margin() {
    const double widest = widest_margin();
    auto grown = grown_for(widest);
    if (!grown) return tl::unexpected(std::move(grown.error()));
    auto found = search(*grown, {}, 0, options_.gap, 0, 0);
    if (!found) return tl::unexpected(std::move(found.error()));
    result_.margin_bound = kInfinity;
    take_proof(*grown, widest, false, 0, *found, widest + std::max(0.0, found->upper_bound) / least_scale_);
    return {};
  }

  /// Edges with scales: grown for the margin that the best pose has, no pose has more than the next bound.
  Result<void> grow() {
    for (int k = 0; scaled() && k < kMostGrowths && !stopped_; ++k) {
      const double margin = result_.margin, width = result_.margin_bound - margin;
      if (width <= options_.gap) break;
      auto grown = grown_for(margin);
      if (!grown) return tl::unexpected(std::move(grown.error()));
      auto found = search(*grown, {}, 0, 0.5 * options_.gap * least_scale_);
      if (!found) return tl::unexpected(std::move(found.error()));
      take_pose(*found);
      take_proof(*grown, margin, false, 0, *found, margin + std::max(0.0, found->upper_bound) / least_scale_);
      if (!(result_.margin_bound - result_.margin < width)) break;  // caps hold it, or rounding
    }
    return {};
  }

  /// Caps that bind: is there a placement with this margin that keeps them?
  Result<void> bisect_margin(const Grown& base) {
    const double gap = cap_gap_ * kDecisionGap * least_scale_;
    for (int k = 0; k < kMostDecisions && !stopped_; ++k) {
      const double width = result_.margin_bound - result_.margin;
      if (width <= cap_gap_) break;
      const double margin = result_.margin + 0.5 * width, before = width;
      Result<Grown> grown = scaled() ? grown_for(margin) : Result<Grown>(base);
      if (!grown) return tl::unexpected(std::move(grown.error()));
      const double level = scaled() ? 0 : margin * least_scale_;
      auto found = search(*grown, caps_, level + gap, gap, level, level + gap);
      if (!found) return tl::unexpected(std::move(found.error()));
      take_pose(*found);
      if (found->upper_bound <= level + gap)
        take_proof(*grown, scaled() ? margin : 0, true, level + gap, *found,
                   margin + std::max(0.0, found->upper_bound - level) / least_scale_);
      if (!(result_.margin_bound - result_.margin < before)) break;  // what is left is rounding
    }
    return {};
  }

  Result<void> settle() {
    if (result_.proof.certificate.empty()) LEKALO_CHECK(prove_widest_margin());
    // The checker encloses each number as it is written, by its two neighbours at worst, and must still find
    // this one above the bound that it follows from.
    for (int step = 0; step < 2; ++step)
      result_.margin_bound = std::nextafter(result_.margin_bound, kInfinity);
    const double gap = caps_.empty() ? options_.gap : cap_gap_;  // what a bisection is content with
    result_.margin_found = result_.margin, result_.margin_gap = 1.001 * gap;
    const bool closed = result_.margin_bound - result_.margin <= result_.margin_gap;
    result_.status = result_.margin_bound < 0 ? Status::infeasible
                                              : (closed && !stopped_ ? Status::optimal : Status::stopped);
    return {};
  }

  struct Second {
    Pose pose;
    SmallestLargest what;
  };
  /// Finds, among the placements with at least `margin`, one with the smallest largest allowance, from a pose
  /// on that is one of them.
  ///
  /// "Is there one with no more than c?" is answered by a pose, by a proof, or, where c is within what one
  /// decision leaves open, not at all. Then what lies to both sides is asked about.
  Result<Second> smallest_largest(double margin, const Pose& start) {
    Second best{start, {margin, depth(start, free_edges_), 0, cap_gap_, 0, {}}};
    SmallestLargest& s = best.what;
    const double grown_for_margin = scaled() ? margin : 0;
    auto grown = grown_for(grown_for_margin);
    if (!grown) return tl::unexpected(std::move(grown.error()));
    const double level = scaled() ? 0 : margin * least_scale_, gap = cap_gap_ * kDecisionGap;
    // Strictly below: so the bound holds for the very margin, and maxima are kept by what has nothing left.
    const double not_above = level - shapes_.part_tolerance - shapes_.blank_tolerance - grown->tolerance -
                             std::max(kStrictly * gap, 16 * geom::kEdgeDistanceError * far_);
    std::vector<Cap> caps = caps_;
    caps.push_back({{}, 0});
    for (const geom::Curve& curve : free_edges_) caps.back().edges.push_back(curve.edge);
    double open_from = kInfinity, open_to = -kInfinity;  // not answered
    int unanswered = 0;
    double step = kFirstStep * cap_gap_;
    for (int k = 0; k < kMostDecisions && s.found - s.bound > cap_gap_ && !stopped_; ++k) {
      const bool open = open_from <= open_to;
      const double below = open_from - s.bound, above = s.found - open_to;
      double most = 0.5 * (s.found + s.bound);
      if (open) most = below > above ? s.bound + 0.5 * below : open_to + 0.5 * above;
      if (s.bound == 0) {
        // Yes is a quicker answer than no, and the start is often nearly the best.
        const double from = open ? open_from : s.found;
        most = std::max(from - step, 0.5 * from), step *= 2;
      }
      if (unanswered == kMostUnanswered || !(most > s.bound && most < s.found)) break;
      caps.back().most = most;
      auto answer = search(*grown, caps, level, gap, level, not_above);
      if (!answer) return tl::unexpected(std::move(answer.error()));
      const Pose pose{answer->best, answer->mirrored};
      if (answer->found && margin_at(pose) >= margin) {
        const double largest = depth(pose, free_edges_);
        if (largest < s.found) best.pose = pose, s.found = largest;
      }
      if (answer->upper_bound < level) take_bound(s, *grown, grown_for_margin, level, most, *answer);
      if (s.found > most && s.bound < most) {
        ++unanswered;
        open_from = std::min(open_from, most), open_to = std::max(open_to, most);
      }
      open_from = std::max(open_from, s.bound), open_to = std::min(open_to, s.found);
      if (open_from > open_to) open_from = kInfinity, open_to = -kInfinity;
    }
    s.bound = std::min(s.bound, s.found);
    return best;
  }

  static void take_bound(SmallestLargest& s, const Grown& grown, double grown_for, double level, double most,
                         RegionResult& answer) {
    const double rounding = kRounding * (most + std::abs(level) + std::abs(answer.upper_bound));
    const double bound = most + (level - answer.upper_bound) - rounding;
    if (!(bound > s.bound)) return;
    s.bound = bound;
    s.proof.emplace();
    static_cast<DemandProof&>(*s.proof) = {grown.regions,
                                           grown_for,
                                           grown.tolerance,
                                           level,
                                           answer.upper_bound,
                                           answer.pivot,
                                           std::move(answer.certificate)};
    s.proof->most = most;
  }

  Result<void> trace_curve() {
    Pose from = pose_;
    for (std::size_t k = 0; k < problem_.trade_off && !stopped_; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(problem_.trade_off - 1);
      const double margin = result_.margin * (1 - share);
      auto smallest = smallest_largest(margin, from);
      if (!smallest) return tl::unexpected(std::move(smallest.error()));
      from = smallest->pose;
      TradeOff point{from.at, from.mirrored, margin_at(from), smallest->what.found, smallest->what.bound};
      point.at.clearance = part_clearance(from);
      result_.curve.push_back(point);
    }
    return {};
  }

  /// Gives the clearance of the part alone, rounded down.
  [[nodiscard]] double part_clearance(const Pose& pose) const {
    const phi::RegionClearance::Value value = clearance_.at(pose.map());
    const double measured =
        value.inside ? value.distance : -clearance_.depth(pose.map(), 0.25 * options_.gap);
    return measured - rounding(pose);
  }

  void finish() {
    result_.best = pose_.at, result_.mirrored = pose_.mirrored;
    result_.best.clearance = part_clearance(pose_);
    if (result_.margin >= 0) result_.margin = margin_at(pose_);
    result_.largest = depth(pose_, free_edges_);
    find_contacts();
    result_.deviation = deviation_at(samples(), clearance_, pose_.map());
  }

  /// Finds where the demands hold the part. If they are not met, it takes each place where the grown part is
  /// nearest, and gives it by the nearest point of the part itself.
  void find_contacts() {
    const double margin = std::max(options_.gap, 1e-6 * far_);
    const BlankFromPart map = pose_.map();
    std::vector<phi::RegionContact> places;
    (void)base_->at(map, margin, &places);
    std::vector<Touch>& touches = result_.contacts;
    const auto add = [&](const Touch& touch) {
      const bool known = std::any_of(touches.begin(), touches.end(), [&](const Touch& t) {
        return t.part_edge == touch.part_edge && t.blank_edge == touch.blank_edge;
      });
      if (!known) touches.push_back(touch);
    };
    if (result_.margin < 0) {
      for (const phi::RegionContact& place : places) {
        const auto own = clearance_.part().nearest(place.part);
        add({own.edge, place.blank_edge, own.point, place.blank, norm(map(own.point) - place.blank), 0, {}});
      }
    }
    for (std::uint32_t k = 0; result_.margin >= 0 && k < edges_.size(); ++k) {
      if (demand_[k].finished) continue;
      const phi::RegionContact place = clearance_.nearest(map, k);
      if ((place.distance - demand_[k].minimum) / demand_[k].scale <= result_.margin + margin)
        add({k, place.blank_edge, place.part, place.blank, place.distance, 0, {}});
    }
    for (std::uint32_t cap = 0; cap < caps_.size(); ++cap) {
      std::vector<geom::Curve> curves;
      for (const Edge& edge : caps_[cap].edges) curves.push_back(geom::make_curve(edge));
      if (caps_[cap].most - clearance_.deepest(map, curves, 0.125 * margin, margin, places) > margin)
        continue;
      for (const phi::RegionContact& place : places)
        add({edges_of_cap_[cap][place.part_edge],
             place.blank_edge,
             place.part,
             place.blank,
             place.distance,
             0,
             {}});
    }
  }

  const DemandProblem& problem_;
  const RegionProblem& shapes_;
  const RegionOptions& options_;
  phi::RegionClearance clearance_;
  std::vector<Edge> edges_;
  std::vector<Demand> demand_;  ///< by edge
  std::vector<Cap> caps_;
  std::vector<std::vector<std::uint32_t>> edges_of_cap_;  ///< of the part, by cap
  std::vector<geom::Curve> free_edges_;                   ///< those that are not finished
  double least_scale_ = kInfinity, most_scale_ = 0, far_ = 0;
  std::optional<phi::RegionClearance> base_;  ///< of the part grown for margin 0
  double base_tolerance_ = 0, cap_gap_ = 0;
  Pose pose_;
  DemandResult result_;
  bool finished_ = false, stopped_ = false;
};

}  // namespace

Result<DemandResult> locate_demands(const DemandProblem& problem, const RegionOptions& options) {
  if (Result<void> fine = check_limits(problem.shapes.window, options.gap, 0); !fine)
    return tl::unexpected(std::move(fine.error()));
  if (problem.shapes.part.empty() || problem.shapes.blank.empty())
    return failure(ErrorCode::bad_input, "part and blank must have an outline");
  if (Result<void> fine = check_features(problem, edges_of(problem.shapes.part).size()); !fine)
    return tl::unexpected(std::move(fine.error()));
  return DemandLocaliser(problem, options).run();
}

}  // namespace lekalo::locate
