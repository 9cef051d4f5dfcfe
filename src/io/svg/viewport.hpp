#pragma once

#include <optional>
#include <string>

#include "document.hpp"
#include "lekalo/base/error.hpp"
#include "scanner.hpp"

namespace lekalo::io::detail {

struct ViewBox {
  Bounded x, y, width, height;
};
/// Reads a view box whose width and height are above 0; nullopt where there is none.
[[nodiscard]] Read<std::optional<ViewBox>> read_view_box(const SvgElement& element);

/// Step 3 of docs/design/svg.md: returns the map from the user units of a view box to the frame of a viewport
/// of this size with its corner at (0, 0), as preserveAspectRatio of the element says.
[[nodiscard]] Read<Affine> fit(const SvgElement& element, const ViewBox& box, const Bounded& width,
                               const Bounded& height);

/// The page: how its user units become millimetres.
struct Page {
  Affine millimetres_from_user;  ///< y up
  Viewport viewport;             ///< of the root's children, in user units
  std::string unit;
  double millimetres_per_unit = 1;
  std::string notice;  ///< a sentence, or ""
};
[[nodiscard]] Read<Page> page_of(const SvgElement& root, std::optional<LengthUnit> said);

}  // namespace lekalo::io::detail
