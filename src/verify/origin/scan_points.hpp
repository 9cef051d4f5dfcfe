#pragma once

#include <optional>
#include <vector>

#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// A slice of a scan in space: the points with |z - height| <= thickness / 2, mm.
struct Slice {
  Decimal height, thickness;
};

/// The measured points that count, mm, each as its decimals say.
struct MeasuredPoints {
  std::vector<Vec> at;
  /// The first point of each contour; text without a slice alone has contours.
  std::vector<std::size_t> contour_starts;
};

/// Reads a scan as docs/formats.md says: text, or PLY in any of its encodings. bad_input names the place.
[[nodiscard]] Result<MeasuredPoints> read_scan_points(const Document& document, LengthUnit unit,
                                                      const std::optional<Slice>& slice);

}  // namespace lekalo::verify
