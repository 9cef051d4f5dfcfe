#include "solid_clearance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

std::string place(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0].high, p[1].high, p[2].high);
}
std::string place(const PlacedSolid& body, std::uint32_t triangle) {
  return place(body.at(body.mesh().triangles[triangle][0]));
}

/// The number of a triangle in its file, from 1.
std::size_t number(const PlacedSolid& body, std::uint32_t triangle) {
  return std::size_t{body.mesh().numbers[triangle]} + 1;
}

bool is_zero(const Decimal& value) { return sgn(value.digits) == 0; }

/// Returns a bound above the distance of a point from a surface.
double distance_from(const Vec3& p, const PlacedSolid& body) {
  const BoxTree point({box_of(p)});
  double least = kInfinity;
  point.visit_pairs(body.tree(), least, [&](std::uint32_t, std::uint32_t number) {
    least = std::min(least, distance({p, p, p}, body.triangle(number), least).high);
  });
  return least;
}

}  // namespace

Result<SolidPair> SolidPair::make(const SolidMesh& part, const SolidMesh& blank, const SolidPose& pose) {
  if (std::ranges::all_of(pose.quaternion, is_zero))
    return failure(ErrorCode::bad_input, "the quaternion is 0, which is no rotation");
  for (const Decimal& shift : pose.shift)
    if (!(std::abs(approximate(shift)) <= limits::kLargestDerived))
      return failure(ErrorCode::bad_input, fmt::format("the shift {} is not within {:g} mm",
                                                       approximate(shift), limits::kLargestDerived));
  return SolidPair(part, blank, SolidMotion(pose));
}

SolidPair::Nearest SolidPair::nearest() const {
  Nearest found{{kInfinity, kInfinity}};
  double limit = kInfinity;
  part_.tree().visit_pairs(blank_.tree(), limit, [&](std::uint32_t a, std::uint32_t b) {
    const Span width = blank_.mesh().width(b),
               apart = beyond(distance(part_.triangle(a), blank_.triangle(b), limit), width);
    found.least.low = std::min(found.least.low, apart.low);
    if (!(apart.high < found.least.high)) return;
    found.least.high = apart.high, found.part = a, found.blank = b;
    limit = blank_.mesh().widths.empty() ? apart.high : plus(just(apart.high), blank_.widest()).high;
  });
  return found;
}

SolidAnswer SolidPair::check(const Decimal& clearance) const {
  SolidAnswer answer = check_surface(both(clearance));
  if (answer.fault || answer.open) return answer;
  for (const std::uint32_t vertex : blank_.one_of_each_component()) {
    if (!part_.holds(blank_.at(vertex), blank_.exactly_at(vertex))) continue;
    answer.fault = fmt::format("the blank's surface at {} lies within the part", place(blank_.at(vertex)));
    break;
  }
  return answer;
}

SolidAnswer SolidPair::check_surface(const Both& clearance) const {
  const Nearest near = nearest();
  SolidAnswer answer{near.least, std::nullopt, std::nullopt};
  const Span claimed = clearance.near;
  if (sgn(clearance.exact) < 0) {
    answer.open =
        fmt::format("the clearance {} is below 0: how far a part sticks out is not rechecked", claimed.low);
    return answer;
  }
  if (claimed.low > near.least.high) {
    answer.fault = fmt::format(
        "the clearance {} mm is above {} mm: so near is triangle {} of the part, placed at {}, to triangle "
        "{} "
        "of the blank, at {}{}",
        verify::nearest(clearance.exact), near.least.high, number(part_, near.part), place(part_, near.part),
        number(blank_, near.blank), place(blank_, near.blank),
        blank_.mesh().widths.empty() ? "" : ", less its width");
    return answer;
  }
  if (!(near.least.low > claimed.high)) check_exactly(clearance, answer);
  if (answer.fault || answer.open) return answer;
  // The surfaces have no point in common, so one vertex says where all that hangs together lies.
  for (const std::uint32_t vertex : part_.one_of_each_component()) {
    if (blank_.holds(part_.at(vertex), part_.exactly_at(vertex))) continue;
    answer.fault =
        fmt::format("the part is not in the blank: its surface at {} lies outside", place(part_.at(vertex)));
    break;
  }
  return answer;
}

void SolidPair::check_exactly(const Both& clearance, SolidAnswer& answer) const {
  const double claimed = clearance.near.high;
  const Fraction& exact = clearance.exact;
  // It is below 0 once there is a fault, which ends the walk.
  double limit = blank_.mesh().widths.empty() ? claimed : plus(just(claimed), blank_.widest()).high;
  part_.tree().visit_pairs(blank_.tree(), limit, [&](std::uint32_t a, std::uint32_t b) {
    const Span width = blank_.mesh().width(b), apart = distance(part_.triangle(a), blank_.triangle(b), limit);
    if (beyond(apart, width).low > claimed) return;
    const Fraction most = exact + Fraction(width.high), least = exact + Fraction(width.low);
    const ExactDistance found = exact_distance(part_.exact_triangle(a), blank_.exact_triangle(b));
    const auto say = [&](const char* how) {
      return fmt::format("triangle {} of the part, placed at {}, {} triangle {} of the blank, at {}",
                         number(part_, a), place(part_, a), how, number(blank_, b), place(blank_, b));
    };
    if (found.pierces) {
      answer.fault = say("passes through");
    } else if (found.squared < least * least) {
      answer.fault = say(sgn(found.squared) == 0 ? "touches" : "is nearer than the clearance to");
    } else if (found.squared < most * most) {
      answer.open = say("is as near as the clearance and the width allow to") +
                    ": which of the two is more is a matter of the last digits, and was not rechecked";
    } else if (sgn(found.squared) == 0 && !answer.open) {
      answer.open =
          say("touches") + ": that the part does not pass through the blank's surface was not rechecked";
    }
    if (answer.fault) limit = -kInfinity;
  });
}

std::optional<std::string> SolidPair::swallowed() const {
  for (const auto& component : blank_.components()) {
    const auto is_outside = [&](std::uint32_t vertex) {
      ask();
      const Exact3 exact = blank_.exactly_at(vertex);
      return !part_.touches(blank_.at(vertex), exact) && !part_.holds(blank_.at(vertex), exact);
    };
    if (std::ranges::none_of(component, is_outside))
      return fmt::format("all of the blank's surface that hangs together at {} lies within the part",
                         place(blank_.at(component.front())));
  }
  return std::nullopt;
}

Result<double> SolidPair::bound_of(const SolidContact& contact, double slack, Span width) const {
  Vec3 near_part{}, near_blank{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    near_part[axis] = enclosed(contact.part_point[axis]);
    near_blank[axis] = enclosed(contact.blank_point[axis]);
  }
  near_part = motion_(near_part);
  const double off_part = distance_from(near_part, part_), off_blank = distance_from(near_blank, blank_);
  const Span between = length(near_part - near_blank), apart = beyond(between, width),
             said = enclosed(contact.distance);
  const auto refuse = [](std::string sentence) { return failure(ErrorCode::refuted, std::move(sentence)); };
  if (!(off_part <= slack))
    return refuse(
        fmt::format("part_point, placed at {}, is {} mm off the part's surface", place(near_part), off_part));
  if (!(off_blank <= slack))
    return refuse(
        fmt::format("blank_point {} is {} mm off the blank's surface", place(near_blank), off_blank));
  if (!(apart.low <= said.high + slack && apart.high >= said.low - slack))
    return refuse(fmt::format("the points are {} mm apart{}, not {}", apart.low,
                              width.high > 0 ? " but for the width of the blank's triangle" : "",
                              approximate(contact.distance)));
  return (between + just(off_part) + just(off_blank)).high;
}

}  // namespace lekalo::verify
