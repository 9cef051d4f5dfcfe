#include "solid_clearance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "solid_number.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

std::string place(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0].high, p[1].high, p[2].high);
}
std::string place(const PlacedSolid& body, std::uint32_t triangle) {
  return place(body.at(body.mesh().triangles[triangle][0]));
}

bool is_zero(const Decimal& value) { return sgn(value.digits) == 0; }

/// Returns a distance less a width; it is itself where there is none.
Span beyond(Span distance, Span width) { return width.high > 0 ? distance - width : distance; }

/// Returns the enclosed distance of a point from a surface.
Span distance_from(const Vec3& p, const PlacedSolid& body) {
  const BoxTree point({box_of(p)});
  Span least{kInfinity, kInfinity};
  point.visit_pairs(body.tree(), least.high, [&](std::uint32_t, std::uint32_t number) {
    const Span found = distance({p, p, p}, body.triangle(number), least.high);
    least = {std::min(least.low, found.low), std::min(least.high, found.high)};
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
  const Nearest near = nearest();
  SolidAnswer answer{near.least, std::nullopt, std::nullopt};
  const Span claimed = enclosed(clearance);
  if (sgn(clearance.digits) < 0) {
    answer.open =
        fmt::format("the clearance {} is below 0: how far a part sticks out is not rechecked", claimed.low);
    return answer;
  }
  if (claimed.low > near.least.high) {
    answer.fault = fmt::format(
        "the clearance {} mm is above {} mm: so near is triangle {} of the part, placed at {}, to triangle "
        "{} "
        "of the blank, at {}{}",
        approximate(clearance), near.least.high, near.part + 1, place(part_, near.part), near.blank + 1,
        place(blank_, near.blank), blank_.mesh().widths.empty() ? "" : ", less its width");
    return answer;
  }
  if (!(near.least.low > 0 && near.least.low >= claimed.high)) check_exactly(clearance, answer);
  if (!answer.fault && !answer.open) check_inside(answer);
  return answer;
}

void SolidPair::check_exactly(const Decimal& clearance, SolidAnswer& answer) const {
  const double claimed = enclosed(clearance).high;
  const Fraction exact = to_fraction(clearance);
  // It is below 0 once there is a fault, which ends the walk.
  double limit = blank_.mesh().widths.empty() ? claimed : plus(just(claimed), blank_.widest()).high;
  part_.tree().visit_pairs(blank_.tree(), limit, [&](std::uint32_t a, std::uint32_t b) {
    if (answer.fault) return;
    const Span width = blank_.mesh().width(b), apart = distance(part_.triangle(a), blank_.triangle(b), limit);
    if (apart.low > 0 && beyond(apart, width).low >= claimed) return;
    const Fraction most = exact + Fraction(width.high), least = exact + Fraction(width.low);
    const ExactDistance found = exact_distance(part_.exact_triangle(a), blank_.exact_triangle(b));
    const auto say = [&](const char* how) {
      return fmt::format("triangle {} of the part, placed at {}, {} triangle {} of the blank, at {}", a + 1,
                         place(part_, a), how, b + 1, place(blank_, b));
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
    if (answer.fault) limit = -1;
  });
}

void SolidPair::check_inside(SolidAnswer& answer) const {
  for (const std::uint32_t vertex : part_.one_of_each_component()) {
    if (blank_.holds(part_.at(vertex), part_.exactly_at(vertex))) continue;
    answer.fault =
        fmt::format("the part is not in the blank: its surface at {} lies outside", place(part_.at(vertex)));
    return;
  }
  for (const std::uint32_t vertex : blank_.one_of_each_component()) {
    if (!part_.holds(blank_.at(vertex), blank_.exactly_at(vertex))) continue;
    answer.fault = fmt::format("the blank's surface at {} lies within the part", place(blank_.at(vertex)));
    return;
  }
}

Result<double> SolidPair::bound_of(const SolidContact& contact, double slack, Span width) const {
  Vec3 near_part{}, near_blank{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    near_part[axis] = enclosed(contact.part_point[axis]);
    near_blank[axis] = enclosed(contact.blank_point[axis]);
  }
  near_part = motion_(near_part);
  const double off_part = distance_from(near_part, part_).high,
               off_blank = distance_from(near_blank, blank_).high;
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
