#pragma once

#include <array>
#include <string>
#include <vector>

#include "solid_document.hpp"
#include "solid_mesh.hpp"

namespace lekalo::verify {

/// Says what is not so: every corner of the mesh, but for those of the underside, is one of the points but
/// for the rounding of inches, and no point but those left out lies deeper in what counts as material than
/// points are uncertain by. \pre the blank has its widths
[[nodiscard]] std::vector<std::string> faults_of_points(const std::vector<std::array<double, 3>>& points,
                                                        const SolidMesh& blank, const WrittenSolidScan& scan);

}  // namespace lekalo::verify
