#include "show_command.hpp"

#include <fmt/core.h>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/show.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_show(const ShowOptions& o) {
  LEKALO_TRY(const jobs::Layout input, read_layout_input(o.source, {{"--picture", o.picture}}));
  const layout::Document& document = input.document;
  const jobs::Shown shown = jobs::show(document);
  disk::AtomicFiles files;
  if (!o.picture.empty()) {
    LEKALO_TRY(const std::string picture,
               picture_bytes(o.picture, o.source.path, document, shown.violations));
    LEKALO_CHECK(files.add(o.picture, picture));
  }
  if (o.json) LEKALO_CHECK(print(jobs::show_json(input, shown)));
  LEKALO_CHECK(files.commit());
  std::string text = notes(input.notices);
  text += fmt::format("{}: {} placed, {}, {}\n", document.name.empty() ? o.source.path : document.name,
                      document.placements.size(), counted(document.parts.size(), "part"),
                      counted(document.stocks.size(), "stock"));
  text += completeness_text(document, shown.completeness);
  if (!shown.violations.empty())
    text += counted(shown.violations.size(), "violation") + "; lekalo check says which and where\n";
  if (!o.picture.empty()) text += fmt::format("Written: {}\n", o.picture);
  tell(text);
  return 0;
}

}  // namespace lekalo::cli
