#include <array>
#include <optional>
#include <vector>

#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/solid/principal_axes.hpp"
#include "locate/solid/solid_climb.hpp"
#include "locate/solid/solid_placement.hpp"
#include "locate/solid/solid_start.hpp"

namespace lekalo::locate {
namespace {

using solid::PrincipalAxes;
using solid::Vector;

/// No window of one chart has half a turn: there x = tan(angle / 2) is beyond this.
constexpr double kHalfTurn = 2000;

}  // namespace

Result<SolidPlacement> place_solid_axes(const SolidProblem& problem, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  const PrincipalAxes part = principal_axes(problem.part), blank = principal_axes(problem.blank);
  if (!(part.volume > 0) || !(blank.volume > 0))
    return failure(ErrorCode::bad_input,
                   "principal axes need a part and a blank with a volume, whose triangles look away from the "
                   "material; take another method");
  const SolidMeter meter(problem, frame_of(problem));
  std::optional<MeasuredSolid> best;
  std::uint64_t tried = 0;
  for (const double first : {1.0, -1.0})
    for (const double second : {1.0, -1.0}) {
      const Vector a = first * blank.axes[0], b = second * blank.axes[1];
      const FramedPose pose = aligned(meter.frame(), part, {a, b, cross(a, b)}, blank.centre);
      if (!(norm(pose.x) < kHalfTurn)) continue;
      std::vector<SolidContact> contacts;
      const MeasuredSolid there = meter.measure(meter.frame().window.held(pose), kInfinity, 1, contacts);
      ++tried;
      if (!best || there.value > best->value) best = there;
    }
  SolidPlacement made = placement(meter, best->pose);
  made.contacts = holding_contacts(meter, *best, options.gap);
  made.work = tried;
  return made;
}

}  // namespace lekalo::locate
