#include "corridors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;
using geom::RegionIndex;

constexpr double kHeldInCorridor = 1.032;  // of the angle of a straight pass
constexpr double kLeastLoop = 0.03;        // of the tool's radius: below it the tool goes straight
constexpr double kLeastInCorner = 0.006;   // of the tool's radius
constexpr double kRoom = 0.9;              // of the tool's radius: from there on fronts go on
constexpr double kOffWall =
    0.003;                      // of the tool's radius, at most a tenth of a loop's: left to the wall's pass
constexpr double kTaper = 0.6;  // a loop that much smaller than the last goes into a corner
constexpr double kSlotStep = 0.05;     // of the tool's radius
constexpr double kShortSlot = 0.5;     // of the tool's radius: a shorter one that leads nowhere is a corner
constexpr double kLeadSpacing = 0.03;  // of the tool's radius
constexpr std::size_t kMostSteps = 100000;
constexpr int kOutside = 6;  // loops beyond a corridor's mouth, at most

Point turned(Point p, double angle) {
  const auto [sine, cosine] = geom::sincos(angle);
  return cosine * p + sine * perpendicular(p);
}

Point unit(Point p) { return (1 / norm(p)) * p; }

/// The angle from one direction to another, from -pi to pi.
double angle_between(Point from, Point to) {
  const double angle = geom::direction_angle(dot(from, to), cross(from, to));
  return angle > kPi ? angle - kTurn : angle;
}

class Walker {
 public:
  Walker(const RegionIndex& limit, const RegionIndex& narrow, const std::vector<Region>& cut,
         const std::vector<Front>& done, const GrowthLaw& law)
      : limit_(limit),
        narrow_(narrow),
        cut_(cut),
        r_(law.tool_radius),
        step_(law.step),
        held_(kHeldInCorridor * law.angle / kDegree) {
    for (const Front& front : done)
      if (front.slot)
        for (const Edge& edge : front.edges) discs_.push_back({edge.to, 0});
  }

  std::vector<Front> run(const std::vector<Region>& cut) {
    for (const Region& region : cut) {
      find_mouths(region.outer);
      for (const geom::Contour& hole : region.holes) find_mouths(hole);
    }
    for (std::size_t i = 0; i < starts_.size(); ++i) walk(Start(starts_[i]));
    return std::move(fronts_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct Disc {
    Point at;
    double radius = 0;
  };
  struct Start {
    Disc disc;  ///< cut
    Point heading;
    std::size_t parent = kNone;
  };

  /// The distance to the walls, negative beyond them.
  double room_at(Point p) {
    const auto near = limit_.nearest(p, likely_);
    likely_ = near.edge;
    return limit_.contains(p) ? near.distance : -near.distance;
  }

  /// Finds the places of the boundary of what is cut that have more room than those beside them: a corridor
  /// may begin there.
  void find_mouths(const geom::Contour& contour) {
    const double spacing = std::min(0.1 * r_, length_of(contour) / 24);
    struct Place {
      Point at, out;
      double room;
    };
    std::vector<Place> places;
    for (const Edge& edge : contour) {
      const double pieces = std::max(1.0, std::ceil(length_of(edge) / spacing));
      for (double i = 0; i < pieces; ++i) {
        const Point p = place_at(edge, (i + 0.5) / pieces);
        places.push_back({p, -perpendicular(heading_at(edge, p)), -1});
        if (narrow_.contains(p)) places.back().room = room_at(p);
      }
    }
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
      ask();
      const Place& p = places[i];
      if (!(p.room > 0) || places[(i + n - 1) % n].room >= p.room || places[(i + 1) % n].room > p.room)
        continue;
      const double radius = std::max(p.room, 1e-3 * r_);
      const Point centre = p.at - radius * p.out;
      starts_.push_back(
          {{centre, cut_.contains(centre) ? cut_.nearest(centre).distance : 0.0}, p.out, kNone});
    }
  }

  struct Peak {
    Point at;
    double room = -1;
  };
  /// Finds the place with most room on a circle, between two angles from a heading.
  Peak peak_about(Point centre, double radius, Point heading, double low, double high) {
    const auto at = [&](double angle) { return centre + radius * turned(heading, angle); };
    constexpr double kShare = 0.381966011250105;
    double a = low + kShare * (high - low), b = high - kShare * (high - low);
    double room_a = room_at(at(a)), room_b = room_at(at(b));
    for (int i = 0; i < 26; ++i) {
      if (room_a > room_b) {
        high = b, b = a, room_b = room_a;
        a = low + kShare * (high - low), room_a = room_at(at(a));
      } else {
        low = a, a = b, room_a = room_b;
        b = high - kShare * (high - low), room_b = room_at(at(b));
      }
    }
    return room_a > room_b ? Peak{at(a), room_a} : Peak{at(b), room_b};
  }
  Peak peak_ahead(Point centre, double radius, Point heading) {
    constexpr double kApart = 12.5 * kDegree;
    double best = -1e300, where = 0;
    int found = 0;
    for (int i = -6; i <= 6; ++i) {
      const double room = room_at(centre + radius * turned(heading, i * kApart));
      if (room > best) best = room, where = i * kApart, found = i;
    }
    if (std::abs(found) == 6) return {};  // beside a wall: there is more room behind
    return peak_about(centre, radius, heading, where - kApart, where + kApart);
  }

  /// Finds the other ways on from a place that was reached in one heading and is left in another.
  void find_branches(const Disc& disc, Point came, Point left, std::size_t parent, double reach) {
    constexpr int kDirections = 24;
    constexpr double kApart = 360.0 / kDirections * kDegree;
    std::array<double, kDirections> room{};
    for (int i = 0; i < kDirections; ++i) room[i] = room_at(disc.at + reach * turned(left, i * kApart));
    for (int i = 0; i < kDirections; ++i) {
      if (room[i] < room[(i + 1) % kDirections] || room[i] <= room[(i + kDirections - 1) % kDirections])
        continue;
      const Point way = turned(left, i * kApart);
      if (dot(way, left) > 0.766 || dot(way, -came) > 0.5) continue;
      const Peak peak = peak_about(disc.at, reach, left, (i - 1) * kApart, (i + 1) * kApart);
      if (peak.room > std::max(0.0, kTaper * disc.radius) && narrow_.contains(peak.at))
        starts_.push_back({disc, unit(peak.at - disc.at), parent});
    }
  }

  /// The largest arc of the rim in material, degrees, on a half circle about `next` beside one about `last`.
  [[nodiscard]] double engagement(const Disc& last, const Disc& next) const {
    double largest = 0;
    const Point heading = unit(next.at - last.at);
    const double before = last.radius + r_;
    for (int i = -5; i <= 5; ++i) {
      const Point out = turned(heading, i * 22 * kDegree);
      const Point from = next.at + next.radius * out - last.at;
      const double d = norm(from);
      if (!(d > 0)) continue;
      const double cosine = (before * before - d * d - r_ * r_) / (2 * d * r_);
      if (cosine >= 1) continue;
      if (cosine <= -1) return 180;
      const double half = geom::direction_angle(cosine, std::sqrt(1 - cosine * cosine));
      largest = std::max(largest, half + std::abs(angle_between(out, from)));
    }
    return largest / kDegree;
  }

  /// True when all of the circle that lies ahead is cut.
  [[nodiscard]] bool is_cut(const Disc& disc, Point heading) const {
    for (int i = -4; i <= 4; ++i) {
      const Point p = disc.at + disc.radius * turned(heading, i * 15 * kDegree);
      if (cut_.contains(p)) continue;
      if (std::none_of(discs_.begin(), discs_.end(),
                       [&](const Disc& other) { return norm(p - other.at) <= other.radius; }))
        return false;
    }
    return true;
  }

  /// True when a corridor that gets narrower is a way to somewhere and not a corner.
  bool leads_on(Disc disc, Point heading) {
    disc.radius = room_at(disc.at);
    for (int i = 0; i < 200; ++i) {
      const double reach = std::max(0.7 * disc.radius, 0.01 * r_);
      const Peak peak = peak_ahead(disc.at, reach, heading);
      if (!(peak.room > 1e-3 * r_)) return false;
      if (peak.room > 0.999 * disc.radius) return true;
      heading = unit(peak.at - disc.at);
      disc = {peak.at, peak.room};
    }
    return false;
  }

  void walk(const Start& start) {
    Disc last = start.disc;
    Point heading = start.heading;
    std::size_t parent = start.parent;
    std::optional<std::pair<Point, Point>> ends;  // of the loop before: right, left
    double step = last.radius;
    int outside = 0;
    for (std::size_t i = 0; i < kMostSteps; ++i) {
      ask();
      if (last.radius < kLeastLoop * r_ && leads_on(last, heading)) {
        if (!slot(last, heading, parent)) return;
        ends.reset();
        step = last.radius;
      }
      step = std::min(step_, 1.3 * step);
      Peak peak;
      Disc next;
      for (int trial = 0; trial < 24; ++trial, step *= 0.92) {
        peak = peak_ahead(last.at, step, heading);
        if (!(peak.room > 0)) continue;
        next = {peak.at, peak.room - std::min(kOffWall * r_, 0.1 * peak.room)};
        if (engagement(last, next) <= held_) break;
      }
      if (!(peak.room > 0)) return;
      const Point way = unit(next.at - last.at);
      if (next.radius < kTaper * last.radius && !leads_on(next, way)) return;
      if (is_cut(next, way)) {
        if (parent != start.parent || i > 8) return;
        heading = way;
        last = {next.at,
                cut_.contains(next.at) ? std::min(next.radius, cut_.nearest(next.at).distance) : 0.0};
        continue;
      }
      if (next.radius < kLeastInCorner * r_) return;
      if (next.radius >= kLeastLoop * r_ || !leads_on(next, way)) {
        add(last, next, way, ends, parent);
        parent = fronts_.size() - 1;
      }
      const bool in_corridor = narrow_.contains(next.at);
      if (in_corridor) find_branches(next, heading, way, parent, std::max(next.radius, kSlotStep * r_));
      heading = way, last = next;
      if (!in_corridor && (next.radius >= kRoom * r_ || ++outside >= kOutside)) return;
    }
  }

  void add(const Disc& last, const Disc& next, Point way, std::optional<std::pair<Point, Point>>& ends,
           std::size_t parent) {
    const auto touch = [&](double side) {
      const Point near = limit_.nearest(next.at + (side * 0.1 * next.radius) * perpendicular(way)).point;
      double angle = norm(near - next.at) > 0 ? angle_between(way, near - next.at) : 0;
      if (!(side * angle > 45 * kDegree && side * angle < 170 * kDegree)) angle = side * 95 * kDegree;
      return next.at + next.radius * turned(way, angle);
    };
    const Point right = touch(-1), left = touch(1);
    Front front;
    front.loop = true;
    front.edges.push_back({EdgeKind::arc_ccw, right, left, next.at});
    front.right_lead = ends ? lead(ends->first, right) : first_lead(last, way, right);
    front.left_lead = ends ? lead(ends->second, left) : first_lead(last, way, left);
    if (parent != kNone) front.parents.push_back(parent);
    fronts_.push_back(std::move(front));
    discs_.push_back(next);
    ends.emplace(right, left);
  }

  /// The way to the first loop: it begins behind, runs along what is cut and comes out of it slowly.
  std::vector<Point> first_lead(const Disc& last, Point way, Point to) {
    const double to_angle = angle_between(way, to - last.at);
    const double from_angle = (to_angle < 0 ? -170 : 170) * kDegree;
    const double from_radius = 0.98 * last.radius, to_radius = norm(to - last.at);
    std::vector<Point> places;
    constexpr int kPieces = 60;
    for (int i = 0; i < kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const Point p = last.at + (from_radius + share * (to_radius - from_radius)) *
                                    turned(way, from_angle + share * (to_angle - from_angle));
      places.push_back(limit_.contains(p) ? p : limit_.nearest(p).point);
    }
    places.push_back(to);
    return places;
  }

  /// The straight way between two places, led along a wall that is in the way.
  std::vector<Point> lead(Point from, Point to) {
    std::vector<Point> places{from};
    const double pieces = std::ceil(norm(to - from) / (kLeadSpacing * r_));
    for (double i = 1; i < pieces; ++i) {
      const Point p = from + (i / pieces) * (to - from);
      if (!limit_.contains(p)) places.push_back(limit_.nearest(p).point);
    }
    places.push_back(to);
    return places;
  }

  /// Goes straight on in full material as far as no loop has room, and says whether one has at its end.
  bool slot(Disc& last, Point& heading, std::size_t& parent) {
    std::vector<Point> way{last.at};
    const double reach = kSlotStep * r_;
    bool goes_on = false, is_met = false;
    while (way.size() < kMostSteps) {
      ask();
      const Peak peak = peak_ahead(way.back(), reach, heading);
      if (!(peak.room > 0)) break;
      heading = unit(peak.at - way.back());
      way.push_back(peak.at);
      is_met = cut_.contains(peak.at) || std::any_of(discs_.begin(), discs_.end(), [&](const Disc& disc) {
                 return norm(peak.at - disc.at) < std::max(disc.radius, 0.6 * reach);
               });
      if (is_met) break;
      if (narrow_.contains(peak.at)) find_branches({peak.at, peak.room}, heading, heading, kNone, reach);
      if (peak.room >= 1.2 * kLeastLoop * r_) {
        last = {peak.at, 0.5 * peak.room};
        goes_on = true;
        break;
      }
    }
    if (way.size() < 2 || (is_met && way.size() == 2) ||
        (!goes_on && !is_met && reach * static_cast<double>(way.size()) < kShortSlot * r_))
      return false;
    Front front;
    front.slot = true;
    for (std::size_t i = 1; i < way.size(); ++i) {
      front.edges.push_back({EdgeKind::line, way[i - 1], way[i], {}});
      discs_.push_back({way[i], 0});
    }
    if (parent != kNone) front.parents.push_back(parent);
    fronts_.push_back(std::move(front));
    parent = fronts_.size() - 1;
    return goes_on;
  }

  const RegionIndex &limit_, &narrow_;
  const RegionIndex cut_;
  double r_, step_, held_;  ///< held_: degrees of the rim in material
  std::uint32_t likely_ = 0;
  std::vector<Start> starts_;
  std::vector<Disc> discs_;
  std::vector<Front> fronts_;
};

}  // namespace

std::vector<Front> corridor_loops(const RegionIndex& limit, const RegionIndex& narrow,
                                  const std::vector<Region>& cut, const std::vector<Front>& done,
                                  const GrowthLaw& law) {
  return Walker(limit, narrow, cut, done, law).run(cut);
}

}  // namespace lekalo::mill
