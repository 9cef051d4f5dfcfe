#pragma once

#include <optional>
#include <string>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"
#include "moved_program.hpp"
#include "verify/number/exact.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// The claims of a result about the program that was written for its placement (docs/formats.md, `nc`).
struct WrittenNc {
  Decimal clearance, rounding_mm;
  std::string mode;
  std::size_t work_offset = {};
  /// Results of 0.1 name no control: LinuxCNC's words were all that it knew.
  words::Control control = words::Control::linuxcnc;
};
[[nodiscard]] WrittenNc read_written_nc(Json value, std::string& complaint);

/// The placement that a program was moved by: p -> R(theta) p + (x, y), or as ProgramClaim has it for solids.
struct ProgramPose {
  Decimal x, y, theta;
  std::optional<ProgramClaim::Solid> solid = {};
};

/// Holds the program against the original one, moved. Returns false where a note says that this was not
/// rechecked.
[[nodiscard]] bool check_program(const LocateInputs& inputs, const WrittenNc& nc, const ProgramPose& pose,
                                 LocateReport& report);

}  // namespace lekalo::verify
