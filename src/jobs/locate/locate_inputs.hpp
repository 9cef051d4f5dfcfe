#pragma once

#include <optional>

#include "lekalo/jobs/locate.hpp"
#include "lekalo/locate/locate.hpp"

namespace lekalo::jobs {

/// The files of a job, read.
struct LocateInputs {
  locate::Problem problem;
  io::ReadOutline part, blank;  ///< what was read with the outlines, which have moved into the problem
  bool part_cut = false;        ///< what the file of features says to ignore is taken off the part
  std::optional<io::WrittenResult> earlier;
};

/// Reads each file once, and chooses how the outlines are taken: as convex ones where both are and nothing is
/// asked for that needs regions. Outlines that are not convex keep to the reader of convex outlines, and its
/// words, where something is asked for that only those can have.
[[nodiscard]] Result<LocateInputs> read_inputs(const LocateJob& job);

}  // namespace lekalo::jobs
