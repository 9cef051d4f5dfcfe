#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/jobs/pocket.hpp"

namespace lekalo::jobs {

/// The same pockets for the path maker and for the checker.
struct PocketGround {
  std::vector<geom::Region> pockets;  ///< as drawn
  /// The pockets, and what the tool stands on beyond their open edges.
  std::vector<geom::Region> extended;
  std::string document;  ///< region JSON of the pockets as drawn with their open edges, for the checker
};

/// Reads the outlines of the job's file, those on the layers of islands and open edges among them.
[[nodiscard]] Result<io::ReadOutline> pocket_outline(const PocketJob& job);

/// Finds islands and open edges by the layers of the outline's edges. bad_input for a layer with no edge on
/// it, and for an island that lies in no pocket.
/// \param name  of the file, for messages
[[nodiscard]] Result<PocketGround> pocket_ground(const std::string& name, const io::ReadOutline& outline,
                                                 const PocketOptions& options);

}  // namespace lekalo::jobs
