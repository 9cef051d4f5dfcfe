#pragma once

#include <string>
#include <vector>

#include "lekalo/draw/heat_picture.hpp"
#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {

/// Places of one station follow one another, from above downwards. \param errors_um  of each place
[[nodiscard]] std::vector<draw::HeatColumn> heat_columns(const std::vector<WallPoint>& walls,
                                                         const std::vector<double>& errors_um);
/// The distance between the heights of places, or a voxel's where there is one height alone, mm.
[[nodiscard]] double height_of(const std::vector<draw::HeatColumn>& columns, double pitch);

/// Returns the picture that the job asks for; empty where it asks for none.
[[nodiscard]] Result<std::string> drawn_heat(const HeatResultJob& job, const HeatFound& found);

}  // namespace lekalo::jobs
