#pragma once

#include <string>
#include <vector>

#include "earlier_programs.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/ramps.hpp"
#include "lekalo/verify/simulate.hpp"
#include "options/options.hpp"
#include "pocket_input.hpp"

namespace lekalo::cli {

/// What other tools have cut before, for the path and for the checker.
struct CutBefore {
  EarlierPrograms programs;
  std::vector<mill::EarlierCut> cuts;
};

struct JudgedProgram {
  std::string text;
  verify::SimulateReport report;  ///< of this text
  std::vector<mill::Ramp> ramps;
};

/// Of progress lines: what Ctrl-C does.
inline constexpr const char* kOnCtrlC = "Ctrl-C ends it, nothing is written";

/// A path as a program, made better by what the checker finds along it: links that cut run at the cut's feed,
/// shallower passes go ahead of what meets too much of the rim, what they do not help is cut in ramps, feeds
/// follow the engagement if wanted.
/// ErrorCode::refuted where the program leaves the pocket or crosses material in rapid motion.
[[nodiscard]] Result<JudgedProgram> judged_program(mill::PocketPath path, const PocketInput& input,
                                                   const CutBefore& before, const PocketOptions& options);

}  // namespace lekalo::cli
