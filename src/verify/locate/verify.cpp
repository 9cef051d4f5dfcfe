#include "lekalo/verify/verify.hpp"

#include "angle_check.hpp"
#include "pose_check.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

/// Only a proof by boxes of poses needs the regions that were placed, so its result holds them.
bool has_regions(Json result) {
  std::string ignored;
  return Fields(result, "", ignored).get("regions").is_object();
}

}  // namespace

Result<LocateReport> verify_locate(const LocateInputs& inputs) {
  LEKALO_TRY(const Json written, parse_json(inputs.result.bytes, inputs.result.name));
  return has_regions(written) ? check_poses(inputs, written) : check_angles(inputs, written);
}

}  // namespace lekalo::verify
