#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "lekalo/mill/path.hpp"
#include "lekalo/mill/ramps.hpp"
#include "lekalo/verify/simulate.hpp"
#include "pocket_ground.hpp"

namespace lekalo::jobs {

struct JudgedProgram {
  std::string text;
  verify::SimulateReport report;  ///< of this text
  std::vector<mill::Ramp> ramps;
};

/// Returns what programs of a job are judged with.
[[nodiscard]] verify::SimulateOptions machining_of(const PocketOptions& options);

/// A path as a program, made better by what the checker finds along it: links that cut run at the cut's feed,
/// shallower passes go ahead of what meets too much of the rim, what these do not help is cut in ramps, and
/// feeds follow the engagement if that is wanted.
/// ErrorCode::refuted where the program leaves the pocket or crosses material in rapid motion.
/// \param before  programs that ran before
[[nodiscard]] Result<JudgedProgram> judged_program(mill::PocketPath path, const PocketJob& job,
                                                   const PocketGround& ground,
                                                   const std::vector<verify::EarlierProgram>& before,
                                                   const PhaseListener& phases);

}  // namespace lekalo::jobs
