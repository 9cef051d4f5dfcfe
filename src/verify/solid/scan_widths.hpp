#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "solid_document.hpp"
#include "solid_mesh.hpp"

namespace lekalo::verify {

/// The widths of a scanner's triangles, as its assumptions make them (docs/formats.md).
struct ScanWidths {
  std::vector<Span>
      of;  ///< each holds the exact one; that of an unknown triangle is what a corner may be off
  Span widest;
  std::size_t unknown = 0;  ///< triangles that no assumption covers
  Span unknown_area{};      ///< mm2
};

/// Cost: O(n); fractions decide only of triangles nearly as wide as the radius, and of small ones.
[[nodiscard]] ScanWidths scan_widths(const SolidMesh& mesh, const WrittenSolidScan& scan);

/// Says what is not so: every corner of the mesh, but for those of the underside, is one of the points but
/// for the rounding of inches, and no point but those left out lies deeper in what counts as material than
/// points are uncertain by. \pre the blank has its widths
[[nodiscard]] std::vector<std::string> faults_of_points(const std::vector<std::array<double, 3>>& points,
                                                        const SolidMesh& blank, const WrittenSolidScan& scan);

}  // namespace lekalo::verify
