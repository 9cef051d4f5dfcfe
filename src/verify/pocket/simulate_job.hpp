#pragma once

#include <vector>

#include "cut_path.hpp"
#include "lekalo/verify/simulate.hpp"
#include "pocket_reach.hpp"

namespace lekalo::verify {

/// The subject of a judgement: the program's moves, the pocket, and the path in the stock with what ran
/// before.
struct SimulateJob {
  std::vector<Move> moves;
  PocketReach reach;
  CutPath path;
};

/// Steps 1, 4, 6 and 9 of docs/design/simulate.md: the strokes of the program and of those before it, the
/// open edges, and where the tool's middle may be. Errors as of simulate().
[[nodiscard]] Result<SimulateJob> read_simulate_job(const Document& program, const Document& pocket,
                                                    const SimulateOptions& options,
                                                    const std::vector<EarlierProgram>& earlier);

}  // namespace lekalo::verify
