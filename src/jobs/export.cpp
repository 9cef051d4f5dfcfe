#include "lekalo/jobs/export.hpp"

#include <fmt/core.h>

#include <utility>

#include "lekalo/draw/label/layout_labels.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/show.hpp"
#include "lekalo/layout/completeness.hpp"

namespace lekalo::jobs {
namespace {

std::string title_of(const Layout& layout, const ExportOptions& options) {
  if (!options.title.empty()) return options.title;
  return layout.document.name.empty() ? io::stem_of(layout.name) : layout.document.name;
}

/// Adds the name of the file to a fault that lacks it.
tl::unexpected<Error> fault_of(const Layout& layout, const Error& error) {
  if (layout.name.empty()) return tl::unexpected(error);
  return failure(error.code, fmt::format("{}: {}", io::as_utf8(layout.name), error.message));
}

Result<std::string> placements_of(const Layout& layout, const std::string& instance_name) {
  const Result<std::size_t> stock = io::strip_in_use(layout.document);
  if (!stock) return fault_of(layout, stock.error());
  return io::write_placements(layout.document, *stock,
                              instance_name.empty() ? layout.instance_name : instance_name);
}

Result<std::string> drawn(const Layout& layout, const ExportOptions& options) {
  return layout_picture(layout.document, title_of(layout, options), layout::check(layout.document),
                        options.form == LayoutForm::pdf ? PictureForm::pdf : PictureForm::png);
}

/// Begins what the QR codes of the layout's labels say (docs/formats.md): whoever has the file can tell
/// whether a label is of it, and a layout that was changed since has other labels.
std::string label_code(const Layout& layout) {
  std::string digits = io::sha256(layout_bytes(layout)).substr(0, 10);
  for (char& c : digits)
    if (c >= 'a') c = static_cast<char>(c - 'a' + 'A');
  return "LK/" + digits;
}

Result<std::string> labels_of(const Layout& layout, const ExportOptions& options) {
  const layout::Completeness completeness = layout::completeness(layout.document);
  Result<std::string> made =
      draw::labels_pdf({io::as_utf8(title_of(layout, options)), layout.document, completeness,
                        label_code(layout), options.labels.least_remnant_mm},
                       options.labels.paper);
  if (!made) return fault_of(layout, made.error());
  return made;
}

}  // namespace

Result<io::Exported> export_layout(const Layout& layout, const ExportOptions& options) {
  const auto alone = [](std::string&& bytes) { return io::Exported{{{"", std::move(bytes)}}, {}}; };
  switch (options.form) {
    case LayoutForm::layout:
      break;
    case LayoutForm::placements:
      return placements_of(layout, options.instance_name).map(alone);
    case LayoutForm::pdf:
    case LayoutForm::png:
      return drawn(layout, options).map(alone);
    case LayoutForm::labels:
      return labels_of(layout, options).map(alone);
    case LayoutForm::machine:
      Result<io::Exported> made =
          io::export_layout(layout.document, title_of(layout, options), options.machine);
      if (!made) return fault_of(layout, made.error());
      return made;
  }
  return alone(layout_bytes(layout));
}

}  // namespace lekalo::jobs
