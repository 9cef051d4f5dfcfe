#pragma once

#include <cstddef>
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

}  // namespace lekalo::verify
