#include "lekalo/mill/feeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/front/step_law.hpp"

namespace lekalo::mill {
namespace {

using geom::EdgeKind;
using geom::Point;

constexpr double kAroundLoad = 1;  // mm of path before and after a load

struct MovePart {
  std::size_t move = 0;
  double begin = 0, end = 0;  ///< shares of the move
  double length = 0, feed = 0;
  bool joined = false;  ///< the part before leads here without a motion between
};

/// The six feeds to choose from, ascending.
std::array<double, 6> steps_of(const FeedOptions& o) {
  // A step is a third of the way by ratio. Newton's method gives the same cube root on every machine.
  const double ratio = o.most_mm_per_min / o.feed_mm_per_min;
  double root = 1;
  for (int i = 0; i < 60; ++i) root -= (root * root * root - ratio) / (3 * root * root);
  const double f = o.feed_mm_per_min;
  return {0.5 * f, 0.7 * f, f, f * root, f * root * root, o.most_mm_per_min};
}

double wanted_feed(double degrees, const FeedOptions& o) {
  const double angle = straight_pass_angle(o.step_over), nominal = angle / kDegree;
  const double sine = geom::sincos(angle).sine, held = most_held_degrees(o.step_over);
  if (degrees > nominal) return o.feed_mm_per_min * std::min(1.0, held / degrees);
  const double found = geom::sincos(degrees * kDegree).sine;
  if (!(found * o.most_mm_per_min > sine * o.feed_mm_per_min)) return o.most_mm_per_min;
  return o.feed_mm_per_min * sine / found;
}

double stepped(double feed, const std::array<double, 6>& steps) {
  double best = steps.front();
  for (const double step : steps)
    if (step <= feed * (1 + 1e-12)) best = step;
  return best;
}

/// Gives each part the least feed of the path within kAroundLoad of it, as far as the motion is not
/// interrupted.
void look_around(std::vector<MovePart>& parts) {
  std::vector<double> least(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ask();
    double feed = parts[i].feed, way = 0;
    for (std::size_t k = i + 1; k < parts.size() && parts[k].joined && way < kAroundLoad; ++k) {
      feed = std::min(feed, parts[k].feed);
      way += parts[k].length;
    }
    way = 0;
    for (std::size_t k = i; k > 0 && parts[k].joined && way < kAroundLoad; --k) {
      feed = std::min(feed, parts[k - 1].feed);
      way += parts[k - 1].length;
    }
    least[i] = feed;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].feed = least[i];
}

PathMove part_of_move(const PathMove& move, Point from, double from_z, double share) {
  PathMove part = move;
  if (share >= 1) return part;
  part.z = from_z + share * (move.z - from_z);
  if (move.shape == EdgeKind::line) {
    part.to = from + share * (move.to - from);
    return part;
  }
  const double sweep = geom::arc_sweep(arc_of(move, from)) * share;
  const auto [sine, cosine] = geom::sincos(move.shape == EdgeKind::arc_ccw ? sweep : -sweep);
  const Point out = from - move.centre;
  part.to = move.centre + cosine * out + sine * geom::perpendicular(out);
  return part;
}

}  // namespace

PocketPath with_feeds(const PocketPath& path, const std::vector<std::vector<MoveLoad>>& loads,
                      const FeedOptions& o) {
  const std::array<double, 6> steps = steps_of(o);
  std::vector<MovePart> parts;
  for (std::size_t i = 0; i < path.moves.size() && i < loads.size(); ++i) {
    const PathMove::Kind kind = path.moves[i].kind;
    if (kind != PathMove::Kind::cut && kind != PathMove::Kind::lead) continue;
    double whole = 0, so_far = 0;
    for (const MoveLoad& load : loads[i]) whole += load.length;
    if (!(whole > 0)) continue;
    for (const MoveLoad& load : loads[i]) {
      MovePart part;
      part.move = i;
      part.begin = so_far / whole;
      so_far += load.length;
      part.end = &load == &loads[i].back() ? 1 : so_far / whole;
      part.length = load.length;
      part.feed = stepped(wanted_feed(load.engagement_deg, o), steps);
      part.joined = !parts.empty() && (parts.back().move == i || parts.back().move + 1 == i);
      parts.push_back(part);
    }
  }
  look_around(parts);
  PocketPath result;
  result.fronts = path.fronts;
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.moves.size(); ++i) {
    const PathMove& move = path.moves[i];
    if (i == 0 || next == parts.size() || parts[next].move != i) {
      result.moves.push_back(move);
      continue;
    }
    const Point from = path.moves[i - 1].to;
    const double from_z = path.moves[i - 1].z;
    for (; next < parts.size() && parts[next].move == i; ++next) {
      const bool changes =
          next + 1 == parts.size() || parts[next + 1].move != i || parts[next + 1].feed != parts[next].feed;
      if (!changes) continue;
      PathMove shorter = part_of_move(move, from, from_z, parts[next].end);
      shorter.feed = parts[next].feed;
      result.moves.push_back(shorter);
    }
  }
  return result;
}

PocketPath with_cutting_links_slow(const PocketPath& path, const std::vector<std::vector<MoveLoad>>& loads,
                                   const FeedOptions& o, double link_mm_per_min) {
  const double sine =
      geom::sincos(straight_pass_angle(o.step_over)).sine * o.feed_mm_per_min / link_mm_per_min;
  if (!(sine < 1)) return path;
  const double most = geom::direction_angle(std::sqrt(1 - sine * sine), sine) / kDegree;
  PocketPath result;
  result.fronts = path.fronts;
  for (std::size_t i = 0; i < path.moves.size(); ++i) {
    const PathMove& move = path.moves[i];
    double whole = 0, begin = std::numeric_limits<double>::infinity(), end = 0;
    if (move.kind == PathMove::Kind::link)
      for (const MoveLoad& load : loads[i]) {
        if (load.engagement_deg > most) begin = std::min(begin, whole), end = whole + load.length;
        whole += load.length;
      }
    if (!(end > 0)) {
      result.moves.push_back(move);
      continue;
    }
    const Point from = path.moves[i - 1].to;
    const double from_z = path.moves[i - 1].z;
    if (begin > kAroundLoad)
      result.moves.push_back(part_of_move(move, from, from_z, (begin - kAroundLoad) / whole));
    const bool ends = end + kAroundLoad < whole;
    result.moves.push_back(part_of_move(move, from, from_z, ends ? (end + kAroundLoad) / whole : 1));
    result.moves.back().kind = PathMove::Kind::cut;
    if (ends) result.moves.push_back(move);
  }
  return result;
}

}  // namespace lekalo::mill
