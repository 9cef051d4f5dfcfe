#include "rim_cover.hpp"

#include <algorithm>

namespace lekalo::verify {
namespace {

/// A rim place this much outside of what an earlier stroke swept counts as in it, mm: where the tool comes
/// back to the very place it was at, rounding would decide. Of the stroke the tool is on it is the other way
/// round.
constexpr double kMargin = 1e-9;

/// Grows with the angle, without an arctangent: 0, 1, 2, 3 at the four axes.
double diamond(Place u) {
  const double sum = std::abs(u.x) + std::abs(u.y);
  const double share = u.y / sum;
  if (u.x >= 0) return u.y >= 0 ? share : 4 + share;
  return 2 - share;
}

Place of_diamond(double d) {
  if (d < 1) return unit({1 - d, d});
  if (d < 2) return unit({1 - d, 2 - d});
  if (d < 3) return unit({d - 3, 2 - d});
  return unit({d - 3, d - 4});
}

}  // namespace

void RimCover::begin(Place at, double radius) {
  at_ = at, radius_ = radius;
  covered_.clear();
}

void RimCover::add_circle_cuts(Place centre, double circle_radius) {
  const Place way = at_ - centre;
  const double square = dot(way, way);
  if (!(square > 0)) return;
  const double apart = std::sqrt(square);
  const double cosine = (circle_radius * circle_radius - square - radius_ * radius_) / (2 * apart * radius_);
  if (!(std::abs(cosine) < 1)) return;
  const double sine = std::sqrt(1 - cosine * cosine);
  const Place along = (1 / apart) * way;
  cuts_.push_back(diamond(cosine * along + sine * left_of(along)));
  cuts_.push_back(diamond(cosine * along - sine * left_of(along)));
}

/// Where the rim meets the line parallel to `direction` (a unit vector), `offset` to its left.
void RimCover::add_line_cuts(Place through, Place direction, double offset) {
  const double sine = (offset - cross(direction, at_ - through)) / radius_;
  if (!(std::abs(sine) < 1)) return;
  const double cosine = std::sqrt(1 - sine * sine);
  cuts_.push_back(diamond(sine * left_of(direction) + cosine * direction));
  cuts_.push_back(diamond(sine * left_of(direction) - cosine * direction));
}

void RimCover::cover_between_cuts(const Stroke& stroke, const Place* trailing_heading) {
  cuts_.push_back(0), cuts_.push_back(4);
  std::sort(cuts_.begin(), cuts_.end());
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (!(cuts_[i + 1] > cuts_[i])) continue;
    const Place u = of_diamond(0.5 * (cuts_[i] + cuts_[i + 1]));
    const bool trails = trailing_heading != nullptr && dot(u, *trailing_heading) < 0;
    const double limit = radius_ + (trailing_heading != nullptr ? -kMargin : kMargin);
    if (trails || distance(at_ + radius_ * u, stroke) <= limit) covered_.push_back({cuts_[i], cuts_[i + 1]});
  }
}

void RimCover::add(const Stroke& s) {
  if (distance(at_, s) >= 2 * radius_) return;
  cuts_.clear();
  add_circle_cuts(s.from, radius_);
  add_circle_cuts(s.to, radius_);
  if (s.arc) {
    add_circle_cuts(s.centre, s.radius + radius_);
    add_circle_cuts(s.centre, std::abs(s.radius - radius_));
    add_line_cuts(s.centre, unit(s.from - s.centre), 0);
    add_line_cuts(s.centre, unit(s.to - s.centre), 0);
  } else if (length(s.to - s.from) > 0) {
    const Place way = unit(s.to - s.from);
    add_line_cuts(s.from, way, radius_);
    add_line_cuts(s.from, way, -radius_);
  }
  cover_between_cuts(s, nullptr);
}

void RimCover::add_own(const Stroke& s) {
  if (!(length(s.to - s.from) > 0)) return;
  const Place way = heading(s, s.to);
  cuts_.clear();
  add_circle_cuts(s.from, radius_);
  add_line_cuts(at_, left_of(way), 0);  // between leading and trailing half
  if (s.arc) {
    add_circle_cuts(s.centre, s.radius + radius_);
    add_circle_cuts(s.centre, std::abs(s.radius - radius_));
    add_line_cuts(s.centre, unit(s.from - s.centre), 0);
  }
  cover_between_cuts(s, &way);
}

double RimCover::open_angle() {
  std::sort(covered_.begin(), covered_.end(), [](Stretch a, Stretch b) { return a.begin < b.begin; });
  double open = 0, at = 0;
  const auto add_gap = [&](double begin, double end) {
    if (!(end > begin)) return;
    // At most a quarter turn at a time, so that the angle between directions is the angle meant.
    for (double from = begin; from < end;) {
      const double to = std::min(end, std::floor(from) + 1);
      open += std::abs(angle_between(of_diamond(from), of_diamond(to >= 4 ? 0 : to)));
      from = to;
    }
  };
  for (const Stretch& stretch : covered_) {
    add_gap(at, stretch.begin);
    at = std::max(at, stretch.end);
  }
  add_gap(at, 4);
  return open;
}

}  // namespace lekalo::verify
