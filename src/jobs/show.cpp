#include "lekalo/jobs/show.hpp"

#include "jobs/document/picture_bytes.hpp"
#include "jobs/document/report_document.hpp"
#include "layout_json.hpp"
#include "lekalo/draw/layout_picture.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::jobs {

Shown show(const layout::Document& document) {
  return {layout::completeness(document), layout::check(document)};
}

std::string show_json(const Layout& layout, const Shown& shown) {
  io::JsonWriter json =
      begin_layout_json("lekalo-show", "shown", layout, 0, layout.document.placements.size());
  io::write_completeness(json, layout.document, shown.completeness);
  json.field("violations", shown.violations.size()).key("run").object({});
  return end_document(json);
}

Result<std::string> layout_picture(const layout::Document& document, std::string_view title,
                                   const std::vector<layout::Violation>& violations, PictureForm form) {
  const layout::Completeness completeness = layout::completeness(document);
  return picture_bytes({io::as_utf8(title), document, completeness, violations}, form);
}

}  // namespace lekalo::jobs
