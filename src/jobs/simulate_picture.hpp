#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/draw/pocket_picture.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// Returns what a picture of a judged program shows. Its name is the last part of the pocket's path.
[[nodiscard]] draw::PocketPicture cut_picture_of(const std::string& pocket_path,
                                                 const std::vector<geom::Region>& pockets,
                                                 double tool_diameter, double stock_to_leave,
                                                 const verify::SimulateReport& report);

/// Returns the picture's bytes in a form, and no bytes where no form is asked for.
[[nodiscard]] Result<std::string> drawn(const draw::PocketPicture& picture, std::optional<PictureForm> form);

}  // namespace lekalo::jobs
