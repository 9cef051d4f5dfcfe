#include "lekalo/verify/verify.hpp"

#include <array>

#include "angle_check.hpp"
#include "pose_check.hpp"

namespace lekalo::verify {
namespace {

/// Only a proof by boxes of poses needs the regions that were placed, so its result holds them.
bool has_regions(Json result) {
  std::array<Json, 1> found;
  constexpr std::array<std::string_view, 1> kKeys{"regions"};
  return result.is_object() && find_members(result, kKeys, found) && found[0].is_object();
}

}  // namespace

Result<LocateReport> verify_locate(const LocateInputs& inputs) {
  LEKALO_TRY(const Json written, parse_json(inputs.result.bytes, inputs.result.name));
  return has_regions(written) ? check_poses(inputs, written) : check_angles(inputs, written);
}

}  // namespace lekalo::verify
