#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/draw/label/label_paper.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::jobs {

/// The paper of labels, and which remnants have one.
struct LabelOptions {
  draw::LabelPaper paper;
  double least_remnant_mm = 100;  ///< of a remnant's shorter side
};

/// The words that labels take, as the options of `lekalo export` have them.
[[nodiscard]] const std::vector<io::ExportWordHelp>& label_words();

/// Reads words as io::read_export_words does, with its sentences. Lengths may have units (io::length_of).
/// Fails with ErrorCode::usage for words that labels do not take, that contradict each other or cannot be
/// read, and for margins and gaps that leave no room on the paper. \param prefix  before names in messages:
/// "--" or ""
[[nodiscard]] Result<LabelOptions> read_label_words(const std::vector<io::ExportWord>& words,
                                                    const std::string& prefix);

}  // namespace lekalo::jobs
