#include "rim_cover.hpp"

#include <algorithm>

namespace lekalo::verify {
namespace {

/// Step 3 of docs/design/simulate.md: a rim place this much outside of what an earlier stroke swept counts as
/// swept, mm. Otherwise rounding would decide where the tool comes back to the very place it was at. Of the
/// stroke that the tool is on, a rim place counts as swept only this much inside of it.
constexpr double kMargin = 1e-9;
/// A stroke that is this much farther than the radius from all of the open rim covers none of it, mm.
constexpr double kSurely = 1e-6;

}  // namespace

/// Returns the direction of a diamond angle. Diamond angles grow with the angle and need no arctangent: 0 is
/// to the right of the heading, 1 ahead, 2 to the left.
Place RimCover::direction_of(double d) const {
  const double ahead = d < 1 ? d : 2 - d, aside = 1 - d;
  return unit(ahead * heading_ - aside * left_of(heading_));
}

void RimCover::add_cut(Place direction) {
  const double ahead = dot(direction, heading_), right = cross(direction, heading_);
  if (!(ahead > 0)) return;
  const double share = ahead / (ahead + std::abs(right));
  cuts_.push_back(right >= 0 ? share : 2 - share);
}

void RimCover::begin(Place at, double radius, const Stroke& s) {
  at_ = at, radius_ = radius, heading_ = heading(s, s.to);
  open_.assign(1, {0, 2});
  cuts_.clear();
  add_circle_cuts(s.from, radius_);
  if (s.arc) {
    add_circle_cuts(s.centre, s.radius + radius_);
    add_circle_cuts(s.centre, std::abs(s.radius - radius_));
    add_line_cuts(s.centre, unit(s.from - s.centre), 0);
  }
  cover([&](Place rim) { return distance(rim, s) <= radius_ - kMargin; });
  bound();
}

void RimCover::add_circle_cuts(Place centre, double circle_radius) {
  const Place way = at_ - centre;
  const double square = dot(way, way), apart = std::sqrt(square);
  const double cosine = (circle_radius * circle_radius - square - radius_ * radius_) / (2 * apart * radius_);
  if (!(std::abs(cosine) < 1)) return;  // nor is it about the rim's own middle, where it is no number
  const double sine = std::sqrt(1 - cosine * cosine);
  const Place along = (1 / apart) * way;
  add_cut(cosine * along + sine * left_of(along));
  add_cut(cosine * along - sine * left_of(along));
}

/// Adds the cuts at which the rim meets a line parallel to `direction` (a unit vector), `offset` to its left.
/// A stroke of no length has none.
void RimCover::add_line_cuts(Place through, Place direction, double offset) {
  const double sine = (offset - cross(direction, at_ - through)) / radius_;
  if (!(std::abs(sine) < 1)) return;
  const double cosine = std::sqrt(1 - sine * sine);
  add_cut(sine * left_of(direction) + cosine * direction);
  add_cut(sine * left_of(direction) - cosine * direction);
}

/// Step 2: takes away the covered stretches. Between two cuts the rim is covered as a whole or not at all.
template <class Gone>
bool RimCover::cover(Gone&& is_gone) {
  std::sort(cuts_.begin(), cuts_.end());
  left_.clear();
  bool changed = false;
  std::size_t next = 0;
  for (const Stretch& open : open_) {
    for (double from = open.begin; from < open.end;) {
      double to = open.end;
      if (next < cuts_.size() && cuts_[next] < to) to = cuts_[next++];
      if (!(to > from)) continue;
      if (is_gone(at_ + radius_ * direction_of(0.5 * (from + to))))
        changed = true;
      else if (!left_.empty() && left_.back().end == from)
        left_.back().end = to;
      else
        left_.push_back({from, to});
      from = to;
    }
  }
  if (changed) open_.swap(left_);
  return changed;
}

/// Finds a disc around all that is open. An arc of at most half a turn lies in the disc that has its chord as
/// diameter.
void RimCover::bound() {
  if (open_.empty()) return;
  const Place from = direction_of(open_.front().begin), to = direction_of(open_.back().end);
  bound_middle_ = at_ + (0.5 * radius_) * (from + to);
  bound_radius_ = 0.5 * radius_ * length(to - from);
}

bool RimCover::add(const Stroke& s, double swept_radius) {
  if (open_.empty()) return false;
  const double reach = bound_radius_ + swept_radius + kSurely;
  const Place off = bound_middle_ - nearest_on(s, bound_middle_);
  if (!(dot(off, off) < reach * reach)) return false;
  cuts_.clear();
  add_circle_cuts(s.from, swept_radius);
  add_circle_cuts(s.to, swept_radius);
  if (s.arc) {
    add_circle_cuts(s.centre, s.radius + swept_radius);
    add_circle_cuts(s.centre, std::abs(s.radius - swept_radius));
    add_line_cuts(s.centre, unit(s.from - s.centre), 0);
    add_line_cuts(s.centre, unit(s.to - s.centre), 0);
  } else {
    const Place way = unit(s.to - s.from);
    add_line_cuts(s.from, way, swept_radius);
    add_line_cuts(s.from, way, -swept_radius);
  }
  if (!cover([&](Place rim) { return distance(rim, s) <= swept_radius + kMargin; })) return false;
  bound();
  return true;
}

void RimCover::add_air(const Air& air) {
  if (open_.empty()) return;
  cuts_.clear();
  for (const Stroke& s : air.borders_near(at_, radius_)) {
    if (s.arc)
      add_circle_cuts(s.centre, s.radius);
    else
      add_line_cuts(s.from, unit(s.to - s.from), 0);
  }
  if (cover([&](Place rim) { return air.holds(rim); })) bound();
}

double RimCover::width_of(const Stretch& stretch) const {
  return radius_ * dot(direction_of(stretch.begin) - direction_of(stretch.end), -1.0 * left_of(heading_));
}

/// The stretch is summed in parts of at most a quarter turn, so that the angle between two directions is the
/// one that is meant.
void RimCover::add_angle(const Stretch& stretch, double& sum) const {
  for (double from = stretch.begin; from < stretch.end;) {
    const double to = std::min(stretch.end, std::floor(from) + 1);
    sum += std::abs(angle_between(direction_of(from), direction_of(to)));
    from = to;
  }
}

double RimCover::open_width() const {
  double width = 0;
  for (const Stretch& stretch : open_) width += width_of(stretch);
  return width;
}

double RimCover::open_beyond(double low) const {
  double open = 0;
  for (const Stretch& stretch : open_) add_angle({std::max(low, stretch.begin), stretch.end}, open);
  return open;
}

void RimCover::add_open_arcs(std::vector<OpenArc>& arcs) const {
  for (const Stretch& stretch : open_) {
    OpenArc arc{direction_of(stretch.begin), 0, width_of(stretch)};
    add_angle(stretch, arc.angle);
    arcs.push_back(arc);
  }
}

}  // namespace lekalo::verify
