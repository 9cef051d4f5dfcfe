#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/nc/knife.hpp"
#include "lekalo/nc/profile.hpp"

namespace lekalo::io {

/// A layout for machines and for other programs. docs/design/export.md says what is written and how far it is
/// from the outlines that were checked; docs/formats.md has the forms.

enum class ExportForm { dxf, svg, hpgl, gcode };
[[nodiscard]] std::optional<ExportForm> export_form(std::string_view word) noexcept;

/// The layers of the written drawings. HPGL has none; its pens 1 to 7 stand for them in this order.
inline constexpr const char* kExportLayers[] = {"CUT", "MARK", "LABEL", "SHEET", "DEFECT", "ZONE", "AREA"};

struct ExportRequest {
  ExportForm form = ExportForm::dxf;
  /// The sheet as STOCK or STOCK#COPY, with copies from 1; empty for all in use.
  std::string sheet;
  /// The layers to write, from kExportLayers; empty for all. G-code has none.
  std::vector<std::string> only;
  LengthUnit unit = LengthUnit::millimetre;  ///< DXF and G-code only
  double chord_tolerance_mm = 0.02;          ///< HPGL only
  nc::ProfileOptions profile;                ///< G-code only
  std::optional<nc::KnifeOptions> knife{};   ///< HPGL only: what the pen of CUT is, if it is no pen
};

/// A word of a command line or of a request, as its name and its value: ("kerf", "0.2").
using ExportWord = std::pair<std::string, std::string>;
/// A word that some form takes, with what stands for its value and what it means. A word without a type is a
/// flag on a command line, where it stands for the value "yes".
struct ExportWordHelp {
  std::string name, type, help;
};
[[nodiscard]] const std::vector<ExportWordHelp>& export_words();

/// Reads the words of a request. Fails with ErrorCode::usage and one sentence for words that the form does
/// not take, for words that are missing, and for values that cannot be read or are out of range.
/// \param prefix  before names in messages: "--" or ""
[[nodiscard]] Result<ExportRequest> read_export_words(ExportForm form, const std::vector<ExportWord>& words,
                                                      const std::string& prefix);

struct ExportedFile {
  /// Like `ExportRequest::sheet`; empty if the file holds all sheets.
  std::string sheet;
  std::string bytes;
  std::vector<nc::CutLines> cuts;  ///< of G-code: which lines cut which placement
};
struct Exported {
  /// DXF and SVG give one file, HPGL and G-code one for each sheet.
  std::vector<ExportedFile> files;
  std::vector<std::string> notes;  ///< one sentence each
};

/// Returns the layout in the requested form.
/// \param name  of the layout, for titles and comments
///
/// Fails with ErrorCode::bad_input where there is nothing to write or the parts cannot be cut
/// (nc/profile.hpp), with ErrorCode::usage for a sheet that is not there.
[[nodiscard]] Result<Exported> export_layout(const layout::Document& document, const std::string& name,
                                             const ExportRequest& request);

}  // namespace lekalo::io
