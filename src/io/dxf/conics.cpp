#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "entities.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/double_double.hpp"

// Reads CIRCLE, ARC and ELLIPSE.

namespace lekalo::io {
namespace {

using geom::Point;

/// Programs write the whole turn of an ellipse with 6 digits or more.
constexpr double kTurnSlack = 1e-6;

bool reaches_too_far(Point centre, double reach) {
  return !(std::max(std::abs(centre.x), std::abs(centre.y)) + reach <= kLargestMillimetres);
}

/// A coordinate centre + radius * (x or y of a direction), rounded once; the error is that of rounding.
Millimetres along(double centre, double radius, double direction) {
  const geom::DoubleDouble step = geom::two_product(radius, direction), sum = geom::two_sum(centre, step.hi);
  return {sum.hi, std::abs(sum.lo) + std::abs(step.lo)};
}

BoundedPoint end_of_arc(const BoundedPoint& centre, const Millimetres& radius, const Millimetres& degrees) {
  const Direction direction = direction_of_degrees(degrees.value);
  const Millimetres x = along(centre.at.x, radius.value, direction.unit.x);
  const Millimetres y = along(centre.at.y, radius.value, direction.unit.y);
  const double turned = (direction.exact ? 0 : kDegreesError) + degrees.error * kDegree;
  const double error = centre.error + radius.error + turned * radius.value + std::max(x.error, y.error);
  return {{x.value, y.value}, error * (1 + 0x1p-40)};
}

}  // namespace

Result<void> DxfEntities::read_circle(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {
      {10, true, true}, {20, true, true}, {30, true, false}, {40, true, true}};
  Numbers numbers;
  LEKALO_CHECK(read_numbers(kWanted, numbers));
  if (!at_.ok() || is_out_of_sight(into)) return {};
  const BoundedPoint centre = numbers.point(10, 20);
  const Millimetres radius = numbers.get(40);
  const auto world = plane(numbers.get(30).value);
  if (!world || !(radius.value > 0)) {
    count_unread(into, !world ? "tilted" : "radius not above 0");
    return {};
  }
  if (reaches_too_far(centre.at, radius.value)) {
    return refuse_entity(fmt::format("reaches beyond {:g} mm", kLargestMillimetres));
  }
  return add(into, *world, circle(centre, radius));
}

Result<void> DxfEntities::read_arc(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {{10, true, true}, {20, true, true},  {30, true, false},
                                       {40, true, true}, {50, false, true}, {51, false, true}};
  Numbers numbers;
  LEKALO_CHECK(read_numbers(kWanted, numbers));
  if (!at_.ok() || is_out_of_sight(into)) return {};
  const BoundedPoint centre = numbers.point(10, 20);
  const Millimetres radius = numbers.get(40), begin = numbers.get(50), end = numbers.get(51);
  const auto world = plane(numbers.get(30).value);
  if (!world || !(radius.value > 0)) {
    count_unread(into, !world ? "tilted" : "radius not above 0");
    return {};
  }
  if (reaches_too_far(centre.at, radius.value)) {
    return refuse_entity(fmt::format("reaches beyond {:g} mm", kLargestMillimetres));
  }
  double sweep = std::fmod(end.value - begin.value, 360);
  if (sweep <= 0) sweep += 360;
  const BoundedPoint from = end_of_arc(centre, radius, begin), last = end_of_arc(centre, radius, end);
  const Point to = sweep == 360 ? from.at : last.at;
  const geom::Edge edge{geom::EdgeKind::arc_ccw, from.at, to, centre.at};
  return add(into, *world,
             circle_arc(edge, sweep * kDegree, std::max({from.error, last.error, centre.error})));
}

Result<void> DxfEntities::read_ellipse(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {{10, true, true},  {20, true, true},   {30, true, false},
                                       {11, true, true},  {21, true, true},   {31, true, false},
                                       {40, false, true}, {41, false, false}, {42, false, false}};
  Numbers numbers;
  LEKALO_CHECK(read_numbers(kWanted, numbers));
  if (!at_.ok() || is_out_of_sight(into)) return {};
  const BoundedPoint centre = numbers.point(10, 20), axis = numbers.point(11, 21);
  const Millimetres ratio = numbers.get(40), low = numbers.get(41), high = numbers.get(42, {kTurn, 1e-15});
  const double length = geom::norm(axis.at), height = std::abs(numbers.get(31).value);
  // Centre and axis are points of the drawing; the extrusion direction says which way round it runs.
  const auto world = plane(0);
  const double longest = length * std::max(1.0, std::abs(ratio.value));
  if (!world || height > 1e-9 * length || ratio.value == 0) {
    count_unread(into, length == 0 && height == 0 ? "of no length"
                       : !world || height > 0     ? "tilted"
                                                  : "flat");
    return {};
  }
  if (length == 0) {
    count_unread(into, "of no length");
    return {};
  }
  if (reaches_too_far(centre.at, length + longest)) {
    return refuse_entity(fmt::format("reaches beyond {:g} mm", kLargestMillimetres));
  }
  EllipseArc arc;
  arc.centre = centre.at;
  arc.u = axis.at;
  arc.v = (world->xx < 0 ? -ratio.value : ratio.value) * geom::perpendicular(axis.at);
  if (geom::cross(arc.u, arc.v) == 0) {
    count_unread(into, "flat");
    return {};
  }
  const double turned = high.value - low.value;
  const bool whole = turned == 0 || std::abs(std::abs(turned) - kTurn) <= kTurnSlack;
  arc.begin = std::fmod(low.value, kTurn);
  double sweep = whole ? kTurn : std::fmod(turned, kTurn);
  if (sweep <= 0) sweep += kTurn;
  arc.end = std::max(arc.begin + sweep, std::nextafter(arc.begin, 10.0));
  arc.from = point_at(arc, arc.begin);
  arc.to = whole ? arc.from : point_at(arc, arc.end);
  // Parameters are off by their reading, by the slack of a whole turn, and by the digits that angles whole
  // turns away from 0 to 2 pi lose.
  const double slack = whole && turned != 0 ? std::abs(std::abs(turned) - kTurn) : 0;
  const double angles = low.error + high.error + slack +
                        8 * kUnitRoundoff * (std::abs(low.value) + std::abs(high.value) + kTurn);
  const double leaning = world->linear_error + 4e-18 * (height > 0 ? 1 : 0);
  const double error = centre.error + axis.error * (1 + std::abs(ratio.value)) +
                       length * (ratio.error + 4 * kUnitRoundoff * std::abs(ratio.value)) +
                       leaning * longest + angles * longest;
  // The exact arc may be a whole turn where these ends are not, and the reverse: conic() knows by the sweep.
  return add(into, {}, conic(arc, error * (1 + 0x1p-40)));
}

}  // namespace lekalo::io
