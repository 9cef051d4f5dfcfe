#pragma once

#include <span>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::draw {

/// One page (297 x 210 mm) with every sheet in use: stock, holes, defects and zones, parts by colour with
/// their names, what breaks a rule in red and hatched with a numbered mark and an arrow the way out, and
/// tables of sheets, parts and kits. Same input, same bytes (PNG and PDF: on a machine with the same
/// libraries and fonts).
struct LayoutPicture {
  std::string name;  ///< UTF-8
  const layout::Document& document;
  const layout::Completeness& completeness;
  const std::vector<layout::Violation>& violations;
  /// In a picture of stock: a line about each part of the document, in its order. Nothing is said of density,
  /// demands and violations then.
  std::span<const std::string> pieces = {};
};

[[nodiscard]] std::string layout_svg(const LayoutPicture& picture);
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
[[nodiscard]] Result<std::string> layout_png(const LayoutPicture& picture, int width_px = 2400);
/// The page, and behind it pages of tables with every part, kit and sheet in use.
[[nodiscard]] Result<std::string> layout_pdf(const LayoutPicture& picture);

}  // namespace lekalo::draw
