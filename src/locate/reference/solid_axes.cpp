#include <array>
#include <optional>
#include <vector>

#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/solid/principal_axes.hpp"
#include "locate/solid/solid_climb.hpp"
#include "locate/solid/solid_placement.hpp"

namespace lekalo::locate {
namespace {

using solid::PrincipalAxes;
using solid::Vector;

/// The axes of the part, as the start has them, are turned onto those of the blank, the first and second or
/// their opposites; the place of the pivot follows from the centres. No window has half a turn, which is no
/// Cayley vector.
std::optional<FramedPose> aligned(const SolidFrame& frame, const PrincipalAxes& part,
                                  const PrincipalAxes& blank, double first, double second) {
  const solid::Motion start = motion_of({frame.start, {}});
  const std::array<double, 3> sides{first, second, first * second};
  solid::Motion turn;
  turn.rotation = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector from = start.turned(part.axes[k]), to = sides[k] * blank.axes[k];
    turn.rotation[0] = turn.rotation[0] + to.x * from;
    turn.rotation[1] = turn.rotation[1] + to.y * from;
    turn.rotation[2] = turn.rotation[2] + to.z * from;
  }
  const auto& [x, y, z] = turn.rotation;
  constexpr double kHalfTurn = 1e-6;
  const double square = 1 + x.x + y.y + z.z;
  if (!(square > kHalfTurn)) return std::nullopt;
  const Vector lever = turn.turned(start.turned(frame.pivot - part.centre));
  return FramedPose{1 / square * Vector{z.y - y.z, x.z - z.x, y.x - x.y}, blank.centre + lever};
}

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
      const auto pose = aligned(meter.frame(), part, blank, first, second);
      if (!pose) continue;
      std::vector<SolidContact> contacts;
      const MeasuredSolid there = meter.measure(meter.frame().window.held(*pose), kInfinity, 1, contacts);
      ++tried;
      if (!best || there.value > best->value) best = there;
    }
  SolidPlacement made = placement(meter, best->pose);
  made.contacts = holding_contacts(meter, *best, options.gap);
  made.work = tried;
  return made;
}

}  // namespace lekalo::locate
