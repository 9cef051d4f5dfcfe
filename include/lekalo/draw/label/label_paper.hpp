#pragma once

namespace lekalo::draw {

/// Paper of labels, mm. A roll is a page with one label of its whole size; a sheet has them in columns and
/// rows with equal gaps, and as much margin on the right and below as on the left and above.
struct LabelPaper {
  double page_width = 62, page_height = 29;
  int columns = 1, rows = 1;          ///< >= 1
  double margin_x = 0, margin_y = 0;  ///< from the page's edges to the labels next to them
  double gap_x = 0, gap_y = 0;        ///< between labels

  [[nodiscard]] double label_width() const {
    return (page_width - 2 * margin_x - (columns - 1) * gap_x) / columns;
  }
  [[nodiscard]] double label_height() const {
    return (page_height - 2 * margin_y - (rows - 1) * gap_y) / rows;
  }
};

}  // namespace lekalo::draw
