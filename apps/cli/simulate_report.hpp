#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// The checker's figures under their names in docs/formats.md.
[[nodiscard]] nlohmann::ordered_json report_fields(const verify::SimulateReport& report);
/// The same for people, a line a figure.
[[nodiscard]] std::string report_rows(const verify::SimulateReport& report);

/// Pictures of what a program cuts; an empty name: not asked for.
struct CutPictures {
  std::string picture, animation;
  std::vector<geom::Region> fragments;  ///< drawn as outlines
};
/// Adds them to `files`.
[[nodiscard]] Result<void> add_cut_pictures(const CutPictures& names, const std::string& title,
                                            const std::vector<geom::Region>& pockets, double tool_diameter,
                                            double stock_to_leave, const verify::SimulateReport& report,
                                            disk::AtomicFiles& files);

}  // namespace lekalo::cli
