#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// What `lekalo pocket` is to clear.
struct PocketInput {
  std::string bytes;                  ///< of the file
  std::vector<geom::Region> pockets;  ///< as drawn, mm
  std::vector<geom::Region>
      extended;          ///< and what the tool stands on beyond open edges; the same where there are none
  std::string document;  ///< region JSON of `pockets` with their open edges, for the checker
  std::vector<std::string> notices;
};

/// Reads the pockets. bad_input for what read_shape refuses, an island (a contour with edges on an island
/// layer) that lies in no pocket, and a layer with no edge on it.
[[nodiscard]] Result<PocketInput> read_pocket_input(const PocketOptions& options);

}  // namespace lekalo::cli
