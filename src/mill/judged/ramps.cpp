#include "lekalo/mill/ramps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/mill/path_way.hpp"
#include "lekalo/mill/straight_pass.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::Point;
using Kind = PathMove::Kind;

constexpr double kLastingMm = 0.15;  // mm: the checker looks every 0.05 mm for what lasts over 0.2
constexpr double kAroundHot = 1;     // of the tool's radius, before and after what is too hot
constexpr double kLongest = 4;       // of the tool's radius, of one ramp
constexpr double kLeastDrop = 0.02, kMostDrop = 0.1;  // of the tool's diameter, of one way down
constexpr double kNoLength = 1e-6;                    // mm
constexpr double kBelowTop = 0.01;  // of a level: at its top the tool would be out of the stock

struct Stretch {
  double begin = 0, end = 0;  // mm along the path
  double largest = 0;         // degrees
};

class Ramping {
 public:
  Ramping(PocketPath path, const PocketOptions& options)
      : way_(std::move(path)),
        radius_(options.tool_diameter / 2),
        held_(most_held_degrees(options.step_over)),
        level_(level_depth(options)) {
    const auto [sine, cosine] = geom::sincos(options.ramp_angle);
    slope_ = sine / cosine;
  }

  RampedPath run(const std::vector<std::vector<MoveLoad>>& loads) {
    for (std::size_t i = 0; i < way_.moves().size();) {
      if (!way_.is_level(i)) {
        result_.path.moves.push_back(way_.moves()[i++]);
        continue;
      }
      std::size_t last = i;
      while (last + 1 < way_.moves().size() && way_.is_level(last + 1)) ++last;
      ramp_run(i, last, hot_stretches(i, last, loads));
      i = last + 1;
    }
    result_.path.fronts = way_.path().fronts;
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::vector<Stretch> hot_stretches(std::size_t first, std::size_t last,
                                                   const std::vector<std::vector<MoveLoad>>& loads) const {
    std::vector<Stretch> hot;
    const double begin = way_.begin_of(first), end = way_.end_of(last);
    Stretch now;
    const auto finish = [&] {
      if (now.end - now.begin >= kLastingMm) {
        now.begin = std::max(begin, now.begin - kAroundHot * radius_);
        now.end = std::min(end, now.end + kAroundHot * radius_);
        if (!hot.empty() && now.begin <= hot.back().end)
          hot.back().end = now.end, hot.back().largest = std::max(hot.back().largest, now.largest);
        else
          hot.push_back(now);
      }
      now = {};
    };
    for (std::size_t i = first; i <= last; ++i) {
      ask();
      double at = way_.begin_of(i);
      for (const MoveLoad& load : loads[i]) {
        const double from = at;
        at = std::min(at + load.length, way_.end_of(i));
        if (!(load.engagement_deg > held_)) {
          finish();
          continue;
        }
        if (!(now.end > 0)) now.begin = from;
        now.end = at;
        now.largest = std::max(now.largest, load.engagement_deg);
      }
    }
    finish();
    return hot;
  }

  void ramp_run(std::size_t first, std::size_t last, const std::vector<Stretch>& hot) {
    double at = way_.begin_of(first);
    for (const Stretch& stretch : hot) {
      const double z = way_.moves()[first].z, length = stretch.end - stretch.begin;
      for (const Part& part : parts_between(first, last, at, stretch.begin)) add(part.move);
      const Point from = result_.path.moves.back().to;
      const double pieces = std::ceil(length / (kLongest * radius_) * (1 - 1e-12));
      for (double k = 0; k < pieces; ++k)
        ramp_down(parts_between(first, last, stretch.begin + length * (k / pieces),
                                stretch.begin + length * ((k + 1) / pieces)),
                  z);
      result_.ramps.push_back({from, result_.path.moves.back().to, z, length, stretch.largest});
      at = stretch.end;
    }
    for (const Part& part : parts_between(first, last, at, way_.end_of(last))) add(part.move);
  }

  struct Part {
    PathMove move;
    Edge edge;
    double length = 0;
  };

  [[nodiscard]] std::vector<Part> parts_between(std::size_t first, std::size_t last, double begin,
                                                double end) const {
    std::vector<Part> parts;
    for (std::size_t i = first; i <= last; ++i) {
      const double from = way_.begin_of(i), whole = way_.end_of(i) - from;
      const double a = std::max(0.0, (begin - from) / whole), b = std::min(1.0, (end - from) / whole);
      if (!((b - a) * whole > kNoLength)) continue;
      Part part{way_.moves()[i], part_of(way_.edge_of(i), a, b), (b - a) * whole};
      part.move.to = part.edge.to;
      parts.push_back(part);
    }
    return parts;
  }

  /// Lets the tool, which is at the floor, rise and go along the parts to their end again and again, each
  /// time deeper.
  void ramp_down(const std::vector<Part>& parts, double floor) {
    double length = 0;
    for (const Part& part : parts) length += part.length;
    const double most = std::clamp(length * slope_, kLeastDrop * 2 * radius_, kMostDrop * 2 * radius_);
    const double drop = (1 - kBelowTop) * level_, top = floor + drop;
    const double ways = std::ceil(drop / most);
    const Point begin = result_.path.moves.back().to, end = parts.back().edge.to;
    rise_or_sink(begin, top);
    for (double k = 0; k < ways; ++k) {
      const double above = floor + drop * (1 - k / ways), below = floor + drop * (1 - (k + 1) / ways);
      double so_far = 0;
      for (const Part& part : parts) {
        so_far += part.length;
        PathMove down = part.move;
        down.kind = Kind::entry;
        down.z = above + (below - above) * (so_far / length);
        if (&part == &parts.back()) down.z = below;
        add(down);
      }
      rise_or_sink(end, above);
      for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
        PathMove back = part->move;
        const Edge edge = geom::reversed(part->edge);
        back.kind = Kind::link, back.shape = edge.kind, back.to = edge.to, back.z = above;
        add(back);
      }
      rise_or_sink(begin, below);
    }
    for (const Part& part : parts) {
      add(part.move);
      result_.path.moves.back().kind = Kind::entry;
    }
  }

  void rise_or_sink(Point at, double z) { add({.kind = Kind::link, .to = at, .z = z}); }
  void add(const PathMove& move) { result_.path.moves.push_back(move); }

  PathWay way_;
  double radius_, held_;  ///< mm, degrees
  double level_;          ///< mm, the depth of a level
  double slope_ = 0;
  RampedPath result_;
};

}  // namespace

RampedPath with_ramps(PocketPath path, const std::vector<std::vector<MoveLoad>>& loads,
                      const PocketOptions& options) {
  return Ramping(std::move(path), options).run(loads);
}

}  // namespace lekalo::mill
