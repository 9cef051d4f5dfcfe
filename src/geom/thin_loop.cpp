#include "thin_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::geom::detail {
namespace {

using Interval = std::pair<double, double>;
using Intervals = std::vector<Interval>;

/// The centres of discs that touch one piece or corner: a line, or the part of a circle that begins at an
/// angle and runs counter-clockwise. Places along a track are lengths or angles.
struct Track {
  bool round = false;
  /// A line's start and its direction, a unit vector.
  Point from, direction;
  Point centre;
  double radius = 0, first = 0;
  double length = 0;
  /// The length along the piece for a length of 1 along the track.
  double scale = 1;

  /// Returns angles from -margin on, so that rounding does not send the first ones once around.
  [[nodiscard]] double angle_from_first(double angle) const {
    constexpr double kMargin = 1e-9;
    double beyond = angle - first;
    while (beyond < -kMargin) beyond += kTurn;
    while (beyond >= kTurn - kMargin) beyond -= kTurn;
    return beyond;
  }
};

/// Returns the intervals in which the track is within `reach` of c.
Intervals in_disc(const Track& track, Point c, double reach) {
  if (!(reach > 0)) return {};
  if (!track.round) {
    const Point to = c - track.from;
    const double foot = dot(to, track.direction), height = std::abs(cross(track.direction, to));
    if (!(height < reach)) return {};
    const double half = std::sqrt((reach - height) * (reach + height));
    return {{foot - half, foot + half}};
  }
  const Point to = c - track.centre;
  const double apart = norm(to);
  if (apart + track.radius < reach) return {{0, kTurn}};
  if (!(apart > 0) || !(track.radius > 0) || !(std::abs(apart - track.radius) < reach)) return {};
  const double cosine =
      ((track.radius - reach) * (track.radius + reach) + apart * apart) / (2 * track.radius * apart);
  if (!(cosine > -1)) return {{0, kTurn}};
  if (!(cosine < 1)) return {};
  const double half = direction_angle(cosine, std::sqrt((1 - cosine) * (1 + cosine)));
  const double low = track.angle_from_first(direction_angle(to.x, to.y) - half);
  return {{low, low + 2 * half}, {low - kTurn, low + 2 * half - kTurn}};
}

/// Returns the intervals of the track on which normal . (y - through) > 0.
Intervals in_half_plane(const Track& track, Point through, Point normal) {
  if (!track.round) {
    const double slope = dot(normal, track.direction), begin = dot(normal, track.from - through);
    if (slope == 0) return begin > 0 ? Intervals{{0, track.length}} : Intervals{};
    const double at = -begin / slope;
    if (slope > 0) return {{std::min(at, track.length), track.length}};
    return {{0, std::max(at, 0.0)}};
  }
  const double size = norm(normal), level = dot(normal, track.centre - through) / size;
  const double cosine = -level / track.radius;
  if (!(cosine < 1)) return {};
  if (!(cosine > -1)) return {{0, kTurn}};
  const double half = direction_angle(cosine, std::sqrt((1 - cosine) * (1 + cosine)));
  const double low = track.angle_from_first(direction_angle(normal.x, normal.y) - half);
  return {{low, low + 2 * half}, {low - kTurn, low + 2 * half - kTurn}};
}

Intervals both(const Intervals& a, const Intervals& b) {
  Intervals found;
  for (const Interval& p : a)
    for (const Interval& q : b)
      if (std::max(p.first, q.first) < std::min(p.second, q.second))
        found.push_back({std::max(p.first, q.first), std::min(p.second, q.second)});
  return found;
}

/// Returns what some intervals leave of a line, or of [-kTurn, 2 kTurn].
Intervals without(const Track& track, Intervals taken) {
  std::sort(taken.begin(), taken.end());
  Intervals left;
  double at = track.round ? -kTurn : 0;
  const double end = track.round ? 2 * kTurn : track.length;
  for (const Interval& t : taken) {
    if (t.first > at) left.push_back({at, t.first});
    at = std::max(at, t.second);
  }
  if (at < end) left.push_back({at, end});
  return left;
}

void append(Intervals& to, const Intervals& more) { to.insert(to.end(), more.begin(), more.end()); }

/// Appends the intervals in which the track is within `reach` of the piece.
void append_near(const Track& track, const Piece& piece, double reach, Intervals& found) {
  append(found, in_disc(track, piece.from, reach));
  append(found, in_disc(track, piece.to, reach));
  const Point along = piece.to - piece.from;
  if (!is_arc(piece)) {
    const Point across = perpendicular(along), by = (reach / norm(along)) * across;
    append(found, both(both(in_half_plane(track, piece.from, along), in_half_plane(track, piece.to, -along)),
                       both(in_half_plane(track, piece.from - by, across),
                            in_half_plane(track, piece.from + by, -across))));
    return;
  }
  const bool ccw = piece.kind == EdgeKind::arc_ccw;
  const Point first = (ccw ? piece.from : piece.to) - piece.centre,
              last = (ccw ? piece.to : piece.from) - piece.centre;
  const Intervals facing = both(in_half_plane(track, piece.centre, perpendicular(first)),
                                in_half_plane(track, piece.centre, -perpendicular(last)));
  const Intervals outer = both(facing, in_disc(track, piece.centre, piece.radius + reach));
  append(found, both(outer, without(track, in_disc(track, piece.centre, piece.radius - reach))));
}

Point tangent(const Piece& piece, Point at) {
  if (!is_arc(piece)) return piece.to - piece.from;
  const Point left = perpendicular(at - piece.centre);
  return piece.kind == EdgeKind::arc_ccw ? left : -left;
}

/// Says whether the chain turns right from one piece to the next. At a tip the directions alone do not tell,
/// so there the end of the shorter piece decides by the side of the longer one it is on.
bool points_inwards(const Piece& in, const Piece& out, Point arriving, Point leaving) {
  const double turn = cross(arriving, leaving);
  constexpr double kTip = 1e-4;
  const bool back = dot(arriving, leaving) < 0 && std::abs(turn) < kTip * norm(arriving) * norm(leaving);
  if (!back) return turn < 0;
  if (!is_arc(in) && !is_arc(out)) return orientation(in.from, in.to, out.to) < 0;
  const bool in_longer = norm(in.to - in.from) >= norm(out.to - out.from);
  return (in_longer ? side(in, out.to) : side(out, in.from)) < 0;
}

/// Looks for a disc that fits, as docs/design/boolean.md describes it under Bounds.
class Probe {
 public:
  Probe(const std::vector<Piece>& chain, double radius, double blur)
      : chain_(chain), radius_(radius), blur_(blur), tree_(boxes()) {}

  [[nodiscard]] bool fits() const {
    for (std::size_t i = 0; i < chain_.size(); ++i) {
      const auto at = static_cast<std::uint32_t>(i);
      if (is_free(along(chain_[i]), at)) return true;
      const Piece& next = chain_[i + 1 == chain_.size() ? 0 : i + 1];
      const Point arriving = tangent(chain_[i], chain_[i].to), leaving = tangent(next, next.from);
      if (points_inwards(chain_[i], next, arriving, leaving) &&
          is_free(about(chain_[i].to, arriving, leaving), kNone))
        return true;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  [[nodiscard]] std::vector<Box> boxes() const {
    std::vector<Box> made;
    for (const Piece& piece : chain_) made.push_back(box_of(piece));
    return made;
  }

  [[nodiscard]] Track along(const Piece& piece) const {
    Track track;
    if (!is_arc(piece)) {
      const Point d = piece.to - piece.from;
      track.length = norm(d);
      track.direction = (1 / track.length) * d;
      track.from = piece.from + radius_ * perpendicular(track.direction);
      return track;
    }
    const bool ccw = piece.kind == EdgeKind::arc_ccw;
    const Point first = (ccw ? piece.from : piece.to) - piece.centre,
                last = (ccw ? piece.to : piece.from) - piece.centre;
    // The inside lies towards the centre of a counter-clockwise arc, and beyond the centre where the arc is
    // smaller than the disc.
    const double from_centre = ccw ? piece.radius - radius_ : piece.radius + radius_;
    track.round = true;
    track.centre = piece.centre;
    track.radius = std::max(std::abs(from_centre), 1e-3 * blur_);
    track.first = direction_angle(first.x, first.y) + (from_centre < 0 ? kPi : 0);
    track.length = direction_angle(dot(first, last), cross(first, last));
    if (track.length < 0) track.length += kTurn;
    track.scale = piece.radius;
    return track;
  }

  [[nodiscard]] Track about(Point corner, Point arriving, Point leaving) const {
    Track track;
    const Point first = perpendicular(leaving);
    track.round = true;
    track.centre = corner;
    track.radius = track.scale = radius_;
    track.first = direction_angle(first.x, first.y);
    track.length = direction_angle(dot(leaving, arriving), cross(leaving, arriving));
    if (track.length < 0) track.length += kTurn;
    return track;
  }

  /// Says whether some stretch of the track, longer than rounding makes, is near no piece but its own.
  [[nodiscard]] bool is_free(const Track& track, std::uint32_t own) const {
    const double reach = radius_ + blur_ / 256;
    Intervals taken;
    tree_.visit_meeting(box_around(track, reach), [&](std::uint32_t i) {
      const bool at_corner = own == kNone && (chain_[i].from == track.centre || chain_[i].to == track.centre);
      if (i != own && !at_corner) append_near(track, chain_[i], reach, taken);
    });
    std::sort(taken.begin(), taken.end());
    const double longest = 0.1 * blur_;
    double at = 0;
    for (const Interval& t : taken) {
      if ((std::min(t.first, track.length) - at) * track.scale > longest) return true;
      at = std::max(at, t.second);
      if (at >= track.length) return false;
    }
    return (track.length - at) * track.scale > longest;
  }

  [[nodiscard]] static Box box_around(const Track& track, double reach) {
    Box box{track.centre, track.centre};
    double by = reach + track.radius;
    if (!track.round) {
      const Point to = track.from + track.length * track.direction;
      box = box_of(track.from, to);
      by = reach;
    }
    return grown(box, by);
  }

  const std::vector<Piece>& chain_;
  double radius_, blur_;
  BoxTree tree_;
};

}  // namespace

bool is_thin(const std::vector<Piece>& chain, double radius, double blur) {
  return !Probe(chain, radius, blur).fits();
}

}  // namespace lekalo::geom::detail
