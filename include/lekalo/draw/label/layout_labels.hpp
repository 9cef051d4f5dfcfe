#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/draw/label/label_paper.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::draw {

/// A layout whose placed pieces get labels, and its remnants that are worth keeping.
struct LayoutLabels {
  std::string name;  ///< of the layout, UTF-8
  const layout::Document& document;
  const layout::Completeness& completeness;
  /// Begins what the QR codes say; a slash and the piece follow (docs/formats.md). Capitals, digits and
  /// slashes, at most 20.
  std::string code;
  /// A sheet's largest free rectangle has a label where no side of it is shorter, mm.
  double least_remnant_mm = 100;
};

/// The labels as PDF: sheets by stock and copy, the pieces of each by number, then its remnant. A label has
/// the number of the piece in pictures and exports (the placement's id), the sheet, the name, the size of the
/// part as drawn, material and purpose of the part where they are said, the outline as it lies on the sheet,
/// the layout's name, and the QR code. What does not fit is shortened with an ellipsis. Same input, same
/// bytes on a machine with the same libraries and fonts. Cost: O(points of all pieces), and some 2 ms a
/// label.
///
/// Fails with ErrorCode::bad_input where nothing is placed, with ErrorCode::usage where labels of this paper
/// are too small for what is printed on them, naming the least size; with ErrorCode::environment where the
/// drawing library fails or lekalo was built without QR codes.
[[nodiscard]] Result<std::string> labels_pdf(const LayoutLabels& labels, const LabelPaper& paper);

}  // namespace lekalo::draw
