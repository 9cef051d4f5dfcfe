#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/jobs/label_words.hpp"
#include "lekalo/jobs/layout.hpp"

namespace lekalo::jobs {

enum class LayoutForm {
  layout,      ///< "lekalo-layout/1"
  placements,  ///< of the first strip in use, as other nesting programs read them
  pdf,         ///< the picture and its tables
  png,         ///< the picture
  labels,      ///< a PDF with a label for each piece and remnant
  machine      ///< DXF, SVG, HPGL or G-code, as ExportOptions::machine says
};

struct ExportOptions {
  LayoutForm form = LayoutForm::layout;
  /// The title of pictures and machine files; when it is empty, the document's name or that of its file.
  std::string title;
  /// The name that placements give the file of their items; when it is empty, the layout's.
  std::string instance_name;
  io::ExportRequest machine;  ///< for LayoutForm::machine
  LabelOptions labels{};      ///< for LayoutForm::labels
};

/// The layout in another form, whatever rules it breaks: one file, but for HPGL and G-code one for each
/// sheet. Cost: that of the form's writer; pictures are drawn with what the engine's check finds.
///
/// Fails as io::write_placements, io::export_layout, layout_picture and draw::labels_pdf do; sentences begin
/// with the name of the layout's file where it has one.
[[nodiscard]] Result<io::Exported> export_layout(const Layout& layout, const ExportOptions& options);

}  // namespace lekalo::jobs
