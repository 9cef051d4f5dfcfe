#include "lekalo/mill/relief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/front/step_law.hpp"
#include "mill/path/allowed_places.hpp"
#include "mill/path/arc_fit.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

namespace {

constexpr double kWorthPass = 0.1;   // mm of more than is held that are worth a pass
constexpr double kTogether = 0.5;    // of the tool's radius: hot stretches so near are one
constexpr double kRamp = 1;          // of the tool's radius: on the way from the path to the pass beside it
constexpr double kShortRamp = 0.08;  // of a ramp: where there is less way the pass begins beside the path
constexpr double kSpacing = 0.02;    // of the tool's radius, between places of a pass
constexpr double kCusp = 0.5;        // cosine of the turn between two moves at which a stretch ends
/// Depths of the shallower pass that are tried one after the other, as shares of the depth at which the
/// stretch would meet as much as a straight pass.
constexpr double kDepths[] = {1, 1.6, 0.6, 0.3};
constexpr double kMostDepth = 0.95;  // of the tool's radius
constexpr double kBetter = 0.7;      // of the excess before: what a pass has to bring
constexpr double kNoExcess = 0.05;   // degrees times mm
constexpr double kOutside = 1e-3;    // mm: arcs in place of the path's points may reach so far into a wall

/// Rises from 0 to 1 without corners.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Result<Relief> Relief::make(PocketPath path, const std::vector<geom::Region>& pockets,
                            const PocketOptions& options) {
  LEKALO_TRY(const auto places, allowed_places(pockets, options));
  return Relief(std::move(path), places, options);
}

Relief::Relief(PocketPath path, const std::vector<geom::Region>& places, const PocketOptions& options)
    : given_(std::move(path)),
      path_(given_.path()),
      limit_(places),
      radius_(options.tool_diameter / 2),
      straight_(straight_pass_angle(options.step_over)),
      held_(most_held_degrees(options.step_over)),
      fit_tolerance_(options.fit_tolerance) {}

/// Adds up, over the passes of a site and its stretch of the path, how much more is met than is held.
double Relief::excess_of(const Site& site, const std::vector<std::vector<MoveLoad>>& loads) const {
  const auto number = static_cast<std::size_t>(&site - sites_.data());
  double sum = 0;
  for (std::size_t i = site.moves.first; i <= site.moves.last; ++i) {
    if (origins_[i].site != kNone && origins_[i].site != number) continue;
    double at = origins_[i].begin;
    for (const MoveLoad& load : loads[i]) {
      if (origins_[i].site == number || (at >= site.begin && at < site.end))
        sum += std::max(0.0, load.engagement_deg - held_) * load.length;
      at += load.length;
    }
  }
  return sum;
}

bool Relief::improve(const std::vector<std::vector<MoveLoad>>& loads) {
  if (stage_ == Stage::begin) {
    find_sites(loads);
    stage_ = Stage::trials;
  } else if (stage_ == Stage::trials) {
    judge_trials(loads);
  } else if (!leave_out(loads)) {
    return false;
  }
  if (stage_ == Stage::trials) {
    for (Site& site : sites_)
      if (!site.settled) try_next(site);
    // A pass that was tried and left out may have made its neighbours look better, so that all that stay are
    // measured once more without it.
    if (std::all_of(sites_.begin(), sites_.end(), [](const Site& site) { return site.settled; }))
      stage_ = Stage::confirmation;
  }
  compose();
  return !wanted().empty();
}

/// Finds the hot stretches of level runs without a cusp.
void Relief::find_sites(const std::vector<std::vector<MoveLoad>>& loads) {
  for (std::size_t first = 1; first < given_.moves().size();) {
    if (!given_.is_level(first)) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < given_.moves().size() && given_.is_level(last + 1)) {
      const Edge before = given_.edge_of(last), after = given_.edge_of(last + 1);
      if (dot(heading_at(before, before.to), heading_at(after, after.from)) < kCusp) break;
      ++last;
    }
    const double run_begin = given_.begin_of(first), run_end = given_.end_of(last);
    Site site;
    double hot = 0, left = 0, right = 0;
    const auto finish = [&] {
      if (hot >= kWorthPass) {
        site.run = {first, last};
        site.side = left > right ? 1 : -1;
        site.begin = std::max(run_begin, site.hot_begin - kRamp * radius_);
        site.end = std::min(run_end, site.hot_end + kRamp * radius_);
        site.excess = site.given_excess;
        sites_.push_back(site);
      }
      site = {}, hot = left = right = 0;
    };
    for (std::size_t i = first; i <= last; ++i) {
      double at = given_.begin_of(i);
      for (const MoveLoad& load : loads[i]) {
        const double from = at;
        at += load.length;
        if (!(load.engagement_deg > held_)) continue;
        if (hot > 0 && from - site.hot_end > kTogether * radius_) finish();
        if (hot == 0) site.hot_begin = from;
        site.hot_end = at;
        hot += load.length;
        site.largest = std::max(site.largest, load.engagement_deg);
        site.given_excess += (load.engagement_deg - held_) * load.length;
        left += load.left_deg * load.length, right += (load.engagement_deg - load.left_deg) * load.length;
      }
    }
    finish();
    first = last + 1;
  }
}

void Relief::judge_trials(const std::vector<std::vector<MoveLoad>>& loads) {
  for (Site& site : sites_) {
    if (site.settled) continue;
    const double excess = excess_of(site, loads);
    if (excess < kBetter * site.excess) {
      site.best = site.tried;
      site.excess = excess;
    }
    site.tried.clear();
    site.settled = site.excess <= kNoExcess;
  }
}

/// Leaves out passes that do not help, and says whether there were any.
bool Relief::leave_out(const std::vector<std::vector<MoveLoad>>& loads) {
  bool any = false;
  for (Site& site : sites_)
    if (!site.best.empty() && excess_of(site, loads) >= kBetter * site.given_excess) {
      site.best.clear();
      any = true;
    }
  return any;
}

void Relief::try_next(Site& site) {
  while (site.trials < static_cast<int>(std::size(kDepths))) {
    ask();
    // A straight stretch would need the depth that lies between the two angles.
    const double depth =
        kDepths[site.trials++] * radius_ *
        (geom::sincos(straight_).cosine - geom::sincos(site.largest / kDegreesPerRadian).cosine);
    site.tried = pass_beside(site, std::min(depth, kMostDepth * radius_));
    if (!site.tried.empty()) return;
  }
  site.settled = true;
}

bool Relief::is_inside(const Edge& edge) const {
  const double pieces = std::max(1.0, std::ceil(length_of(edge) / (kSpacing * radius_)));
  for (double k = 0; k <= pieces; ++k) {
    ask();
    const Point p = place_at(edge, k / pieces);
    if (!limit_.contains(p) && limit_.nearest(p).distance > kOutside) return false;
  }
  return true;
}

/// Makes the pass that takes load off a site: beside its stretch of the path, farther from the material, and
/// back on the same way. Empty where there is no room beside the path.
std::vector<PathMove> Relief::pass_beside(const Site& site, double depth) const {
  const auto share_beside = [&](double along) {
    const double before = site.hot_begin - site.begin, after = site.end - site.hot_end;
    const double least = kShortRamp * kRamp * radius_;
    if (along < site.hot_begin) return before < least ? 1 : smooth_step((along - site.begin) / before);
    if (along > site.hot_end) return after < least ? 1 : smooth_step((site.end - along) / after);
    return 1.0;
  };
  const double pieces = std::max(2.0, std::ceil((site.end - site.begin) / (kSpacing * radius_)));
  const auto place_along = [&](double along) {
    const std::size_t move = given_.move_at(site.run.first, site.run.last, along);
    const Edge edge = given_.edge_of(move);
    return std::pair(
        place_at(edge, (along - given_.begin_of(move)) / (given_.end_of(move) - given_.begin_of(move))),
        edge);
  };
  const double z = given_.moves()[site.run.first].z;
  const Point start = place_along(site.begin).first;
  PocketPath there;
  there.moves.push_back({.kind = PathMove::Kind::rapid, .to = start, .z = z});
  bool beside = false;
  for (double k = 0; k <= pieces; ++k) {
    const double along = site.begin + (site.end - site.begin) * k / pieces;
    const auto [on, edge] = place_along(along);
    const Point aside = -site.side * perpendicular(heading_at(edge, on));
    double reach = depth * share_beside(along);
    Point to = on + reach * aside;
    for (int halved = 0; halved < 6 && !limit_.contains(to); ++halved) {
      reach *= 0.5;
      to = on + reach * aside;
    }
    if (!limit_.contains(to)) reach = 0, to = on;
    beside = beside || reach > 0.5 * depth;
    if (!(to == there.moves.back().to))
      there.moves.push_back({.kind = PathMove::Kind::cut, .to = to, .z = z});
  }
  if (!beside || there.moves.size() < 3) return {};
  there = fitted(there, fit_tolerance_);
  Point from = start;
  for (const PathMove& move : there.moves) {
    if (!is_inside(move.shape == EdgeKind::line ? Edge{EdgeKind::line, from, move.to, {}}
                                                : arc_of(move, from)))
      return {};
    from = move.to;
  }
  std::vector<PathMove> passes(there.moves.begin() + 1, there.moves.end());
  for (std::size_t i = there.moves.size(); --i > 0;) {
    PathMove back = there.moves[i];
    back.kind = PathMove::Kind::link;
    back.to = there.moves[i - 1].to;
    if (back.shape == EdgeKind::arc_ccw)
      back.shape = EdgeKind::arc_cw;
    else if (back.shape == EdgeKind::arc_cw)
      back.shape = EdgeKind::arc_ccw;
    passes.push_back(back);
  }
  return passes;
}

void Relief::compose() {
  path_.moves.clear();
  origins_.clear();
  auto site = sites_.begin();
  std::vector<Site*> open;  // sites whose stretches have not come to their end
  for (std::size_t i = 0; i < given_.moves().size(); ++i) {
    const PathMove& move = given_.moves()[i];
    const double begin = given_.begin_of(i);
    const auto add = [&](const PathMove& part, double upto, Origin origin) {
      path_.moves.push_back(part);
      origins_.push_back(origin);
      for (Site* s : open) s->moves.last = path_.moves.size() - 1;
      std::erase_if(open, [&](const Site* s) { return s->end <= upto; });
    };
    double at = begin;
    for (; site != sites_.end() && i > 0 && site->begin < given_.end_of(i); ++site) {
      const std::vector<PathMove>& passes = site->settled ? site->best : site->tried;
      const Edge edge = given_.edge_of(i);
      const double share = (site->begin - begin) / (given_.end_of(i) - begin);
      if (!passes.empty() && site->begin > at) {
        PathMove part = move;
        part.to = place_at(edge, share);
        add(part, site->begin, {kNone, at});
        at = site->begin;
      }
      site->moves.first = path_.moves.size();
      open.push_back(&*site);
      for (const PathMove& pass : passes)
        add(pass, site->begin, {static_cast<std::size_t>(site - sites_.begin()), 0});
    }
    add(move, given_.end_of(i), {kNone, at});
  }
}

std::vector<Relief::Moves> Relief::wanted() const {
  std::vector<Moves> moves;
  for (const Site& site : sites_)
    if (stage_ == Stage::confirmation ? !site.best.empty() : !site.settled) moves.push_back(site.moves);
  std::sort(moves.begin(), moves.end(), [](const Moves& a, const Moves& b) { return a.first < b.first; });
  std::vector<Moves> apart;
  for (const Moves& m : moves)
    if (!apart.empty() && m.first <= apart.back().last)
      apart.back().last = std::max(apart.back().last, m.last);
    else
      apart.push_back(m);
  return apart;
}

}  // namespace lekalo::mill
