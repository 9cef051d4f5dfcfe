#include "region_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "lekalo/verify/verify.hpp"
#include "same_outline.hpp"
#include "shape_distance.hpp"
#include "shape_inside.hpp"
#include "sticking_out.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

Result<Shape> shape_of(const Document& document) {
  LEKALO_TRY(const auto root, parse_json(document.bytes, document.name));
  std::string complaint;
  Shape shape = read_shape(root, "the region", complaint);
  if (complaint.empty()) complaint = fault_of(shape).value_or("");
  if (complaint.empty()) return shape;
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, complaint));
}

/// The width, mm, to which sticking out is enclosed, and the share of the coordinates that is more than their
/// rounding.
constexpr double kSticksOutTolerance = 1e-9, kSticksOutShare = 0x1p-46;

double largest_coordinate(const Shape& shape) {
  return std::max({-shape.low_x, -shape.low_y, shape.high_x, shape.high_y});
}

}  // namespace

Motion motion_of(const Interval& theta, Span x, Span y, bool mirrored) {
  const Turn turn = turn_by(theta);
  return {{turn.cosine.low_double(), turn.cosine.high_double()},
          {turn.sine.low_double(), turn.sine.high_double()},
          mirrored,
          {x, y}};
}

Span clearance(const Shape& part, const Shape& placed_part, const Shape& blank,
               const std::optional<ExactShift>& shift, double claimed) {
  // A part in a blank of its own outline, as it is drawn, touches it everywhere.
  if (shift && sgn(shift->x.digits) == 0 && sgn(shift->y.digits) == 0 && !shift->mirrored &&
      same_outline(part, blank))
    return {0, 0};
  const Span apart = distance(placed_part, blank);
  const std::optional<bool> inside = is_positive(apart) ? lies_within(placed_part, blank) : std::nullopt;
  if (inside && *inside) return apart;
  if (!inside && shift) {
    const Touch touch = touches_from_inside(part, blank, *shift);
    if (touch.inside) return {0, touch.touches ? 0 : apart.high};
  }
  // Some point of the part is within apart.high of the boundary, and more is known where the part sticks out.
  const double width = std::max(kSticksOutTolerance, kSticksOutShare * largest_coordinate(placed_part));
  const Span out = sticking_out(placed_part, blank, width, -claimed);
  return {-out.high, is_positive(out) ? -out.low : apart.high};
}

Result<Enclosure> verify_clearance(const Document& part, const Document& blank, const Placement& at) {
  if (!(std::abs(at.x) <= limits::kLargestDerived && std::abs(at.y) <= limits::kLargestDerived &&
        std::abs(at.theta) <= limits::kLargestDerived))
    return failure(ErrorCode::bad_input,
                   fmt::format("a placement has coordinates up to {} only", limits::kLargestDerived));
  LEKALO_TRY(const Shape of_part, shape_of(part));
  LEKALO_TRY(const Shape of_blank, shape_of(blank));
  const Motion motion = motion_of(Interval::exactly(at.theta, 128), just(at.x), just(at.y), at.mirrored);
  std::optional<ExactShift> shift;
  if (at.theta == 0) shift = ExactShift{exactly(at.x), exactly(at.y), at.mirrored};
  const Span value = clearance(of_part, placed(of_part, motion), of_blank, shift);
  return Enclosure{value.low, value.high};
}

}  // namespace lekalo::verify
