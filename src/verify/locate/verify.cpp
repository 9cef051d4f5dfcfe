#include "lekalo/verify/verify.hpp"

#include "angle_check.hpp"
#include "pose_check.hpp"
#include "verify/read/fields.hpp"
#include "verify/solid/solid_check.hpp"

namespace lekalo::verify {
namespace {

/// Only a result for solids has a quaternion. Only a proof by boxes of poses needs the regions that were
/// placed, so its result holds them.
Result<LocateReport> check(const LocateInputs& inputs, Json result) {
  std::string ignored;
  const Fields fields(result, "", ignored);
  if (!fields.get("quaternion").text.empty()) return check_solids(inputs, result);
  return fields.get("regions").is_object() ? check_poses(inputs, result) : check_angles(inputs, result);
}

}  // namespace

Result<LocateReport> verify_locate(const LocateInputs& inputs) {
  LEKALO_TRY(const Json written, parse_json(inputs.result.bytes, inputs.result.name));
  return check(inputs, written);
}

}  // namespace lekalo::verify
