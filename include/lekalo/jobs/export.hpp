#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/jobs/file.hpp"
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

/// A process of a file by which a layout is to be cut, and words that stand beside it.
struct ProcessChoice {
  File file;  ///< io::read_processes
  std::string material;
  double thickness_mm = 0;
  /// They replace what the process says. `process` among them chooses between several of one material.
  std::vector<io::ExportWord> words;
  std::string prefix;                           ///< before the names of words in sentences: "--" or ""
  io::ExportForm form = io::ExportForm::gcode;  ///< HPGL asks for a knife
};

struct ExportOptions {
  LayoutForm form = LayoutForm::layout;
  /// The title of pictures and machine files; when it is empty, the document's name or that of its file.
  std::string title;
  /// The name that placements give the file of their items; when it is empty, the layout's.
  std::string instance_name;
  io::ExportRequest machine;  ///< for LayoutForm::machine
  /// G-code or HPGL by this process, in place of `machine`. A note names its entry, and another each stock in
  /// use that is of another material by the layout.
  std::optional<ProcessChoice> process{};
  LabelOptions labels{};  ///< for LayoutForm::labels
};

/// The layout in another form, whatever rules it breaks: one file, but for HPGL and G-code one for each
/// sheet. Cost: that of the form's writer; pictures are drawn with what the engine's check finds.
///
/// Fails as io::write_placements, io::export_layout, layout_picture and draw::labels_pdf do, with sentences
/// that begin with the name of the layout's file where it has one; and as io::read_processes,
/// io::find_process and io::process_request.
[[nodiscard]] Result<io::Exported> export_layout(const Layout& layout, const ExportOptions& options);

/// The request of LayoutForm::machine to io::export_layout: that of the options, or that of their process
/// with the notes on it. Fails as io::read_processes, io::find_process and io::process_request do.
struct MachineRequest {
  io::ExportRequest request;
  std::vector<std::string> notes;
};
[[nodiscard]] Result<MachineRequest> machine_request(const Layout& layout, const ExportOptions& options);
/// The files of such a request, without its notes.
[[nodiscard]] Result<io::Exported> export_machine(const Layout& layout, const ExportOptions& options,
                                                  const io::ExportRequest& request);

}  // namespace lekalo::jobs
