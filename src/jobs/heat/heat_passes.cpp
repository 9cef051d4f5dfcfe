#include "heat_passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::jobs {
namespace {

/// An engaged arc begins at the wall within this, radians.
constexpr double kAtTheWall = 0.15;
/// The wall is across the way where the way goes along it within this part.
constexpr double kAcross = 0.25;
/// Passes that give a wall its surface come as near as the nearest within this, mm.
constexpr double kOnTheWall = 0.005;

/// How much a piece takes off a wall in some direction: the engaged arcs from there on.
double stock_towards(const heat::ToolPiece& piece, const std::array<double, 2>& towards, double radius) {
  const double wall = geom::direction_angle(towards[0], towards[1]);
  double thickest = 0;
  for (const heat::RimContact& arc : piece.rim) {
    double begin = arc.begin - wall;
    begin -= kTurn * std::round(begin / kTurn);
    const double end = begin + (arc.end - arc.begin);
    const bool from_wall = std::abs(begin) <= kAtTheWall || std::abs(end) <= kAtTheWall ||
                           (begin < 0 && end > 0) || std::abs(end - kTurn) <= kAtTheWall;
    if (!from_wall) continue;
    const double past =
        end > kTurn - kAtTheWall ? std::abs(begin - kTurn) : std::max(std::abs(begin), std::abs(end));
    const double most = std::min(past, kTurn / 2);
    thickest = std::max(thickest, radius * (1 - geom::sincos(most).cosine));
  }
  return thickest;
}

bool is_across(const heat::ToolPiece& piece, const BesideWall& at) {
  double along_x = piece.to[0] - piece.from[0], along_y = piece.to[1] - piece.from[1];
  const double length = std::hypot(along_x, along_y);
  if (!(length > 0)) return false;
  if (piece.centre) {
    const double x = piece.from[0] + at.share * along_x - (*piece.centre)[0],
                 y = piece.from[1] + at.share * along_y - (*piece.centre)[1], out = std::hypot(x, y);
    return out > 0 && std::abs(x * at.towards[1] - y * at.towards[0]) <= kAcross * out;
  }
  return std::abs(along_x * at.towards[0] + along_y * at.towards[1]) <= kAcross * length;
}

double along(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

}  // namespace

std::vector<WallPasses> wall_passes(const HeatFound& found, double tool_radius, double finish) {
  std::vector<WallPasses> all;
  const std::vector<WallPoint>& walls = found.walls;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i == 0 || walls[i].x != walls[i - 1].x || walls[i].y != walls[i - 1].y ||
        walls[i].outward != walls[i - 1].outward)
      all.emplace_back();
    WallPasses& passes = all.back();
    for (std::size_t v = 0; v < found.visits[i].size(); ++v) {
      const WallVisit& visit = found.visits[i][v];
      const BesideWall at = beside(found.source, walls[i], visit);
      auto same = std::ranges::find_if(passes, [&](const WallPass& pass) {
        const WallVisit& other = found.visits[pass.heights.back().place][pass.heights.back().visit];
        return visit.first <= other.last && other.first <= visit.last;
      });
      if (same == passes.end()) same = passes.insert(passes.end(), WallPass{});
      // Places of one station go downwards.
      same->at = at, same->seconds = visit.at;
      same->heights.push_back({i, v});
    }
  }
  for (WallPasses& passes : all) {
    std::ranges::sort(passes, {}, &WallPass::seconds);
    for (WallPass& pass : passes) {
      const std::size_t lowest = pass.heights.back().place;
      pass.nearest = pass.at.distance;
      for (const WallVisit& visit : found.visits[lowest])
        pass.nearest = std::min(pass.nearest, beside(found.source, walls[lowest], visit).distance);
      const heat::ToolPiece& piece = found.source.pieces[pass.at.piece];
      pass.stock = stock_towards(piece, pass.at.towards, tool_radius);
      pass.across = is_across(piece, pass.at);
      pass.on_wall = pass.at.distance <= pass.nearest + kOnTheWall;
      pass.finishing = pass.on_wall && pass.stock <= finish;
    }
  }
  return all;
}

PassView::PassView(const HeatFound& first, const HeatFound& now)
    : first_(first), now_(now), places_(now.walls) {}

PassView::Seen PassView::seen(const WallPass::Height& height) const {
  const std::size_t place = places_.find(first_.walls[height.place]);
  if (place == now_.walls.size() || now_.visits[place].empty()) return {now_.walls.size(), 0};
  // Corrected programs take a little longer or shorter.
  const double at =
      first_.visits[height.place][height.visit].at * now_.source.work.seconds / first_.source.work.seconds;
  const std::vector<WallVisit>& visits = now_.visits[place];
  const auto nearest =
      std::ranges::min_element(visits, {}, [&](const WallVisit& visit) { return std::abs(visit.at - at); });
  return {place, static_cast<std::size_t>(nearest - visits.begin())};
}

std::array<double, 2> PassView::displaced(
    const WallPass& pass, const WallPass::Height& height,
    const std::vector<std::vector<std::array<double, 2>>>& moved) const {
  const Seen there = seen(height);
  return there.place < moved.size() ? moved[there.place][there.visit] : pass.displaced;
}

double PassView::reached(const WallPass& pass) const {
  const WallPass::Height& lowest = pass.heights.back();
  const Seen there = seen(lowest);
  if (there.place == now_.walls.size()) return pass.moved;
  return 1000 *
         (pass.nearest -
          beside(now_.source, now_.walls[there.place], now_.visits[there.place][there.visit]).distance);
}

std::vector<double> wanted_moves(WallPasses& passes, const PassView& view, const HeatFound& now,
                                 double overcut) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> least(passes.size(), kNone), supported(passes.size(), kNone);
  // Each height, and how far passes that go as far as they may everywhere leave it behind.
  std::vector<std::pair<std::size_t, double>> behind;
  const auto at_height = [&](std::size_t place) -> double& {
    for (auto& [number, value] : behind)
      if (number == place) return value;
    return behind.emplace_back(place, kNone).second;
  };
  for (std::size_t k = 0; k < passes.size(); ++k) {
    WallPass& pass = passes[k];
    if (!pass.finishing) continue;
    std::array<double, 2> sum{};
    std::vector<double> middles;
    for (const WallPass::Height& height : pass.heights) {
      for (const HeatCase& one : now.cases) {
        const double u = along(view.displaced(pass, height, one.moved_um), pass.at.towards);
        for (const double part : {now.heat_parts.least, 1.0, now.heat_parts.greatest})
          supported[k] = std::min(supported[k], part * u);
      }
      const auto u = view.displaced(pass, height, now.middle().moved_um);
      sum = {sum[0] + u[0], sum[1] + u[1]};
      middles.push_back(along(u, pass.at.towards));
      least[k] = std::min(least[k], middles.back());
    }
    const auto count = static_cast<double>(pass.heights.size());
    pass.displaced = {sum[0] / count, sum[1] / count};
    for (std::size_t h = 0; h < pass.heights.size(); ++h) {
      double& value = at_height(pass.heights[h].place);
      value = std::min(value, middles[h] - least[k]);
    }
  }
  double worst = 0;
  for (const auto& [place, value] : behind) worst = std::max(worst, value);
  std::vector<double> wanted(passes.size(), 0);
  for (std::size_t k = 0; k < passes.size(); ++k)
    if (passes[k].finishing) wanted[k] = std::min(least[k] + worst / 2, supported[k] + overcut);
  return wanted;
}

}  // namespace lekalo::jobs
