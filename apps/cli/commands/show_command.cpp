#include "show_command.hpp"

#include <fmt/format.h>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_show(const ShowOptions& o) {
  const Result<LayoutInput> input = read_layout_input(o.source, {{"--picture", o.picture}});
  if (!input) return tl::unexpected(input.error());
  const std::vector<layout::Violation> violations = layout::check(input->document);
  const layout::Completeness completeness = layout::completeness(layout::Workspace(input->document));
  disk::AtomicFiles files;
  if (!o.picture.empty()) {
    const Result<std::string> picture =
        picture_bytes(o.picture, o.source.path, input->document, completeness, violations);
    if (!picture) return tl::unexpected(picture.error());
    if (Result<void> done = files.add(o.picture, *picture); !done) return tl::unexpected(done.error());
  }
  if (o.json) {
    nlohmann::ordered_json json = begin_layout_json("lekalo-show", "shown", *input);
    json.update(nlohmann::ordered_json::parse(io::completeness_json(input->document, completeness)));
    json["violations"] = violations.size();
    json["run"] = nlohmann::ordered_json::object();
    if (Result<void> done = print(dumped(json)); !done) return tl::unexpected(done.error());
  }
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());
  std::string text = notes(input->notices);
  text += fmt::format("{}: {} placed, {}, {}\n",
                      input->document.name.empty() ? o.source.path : input->document.name,
                      input->document.placements.size(), counted(input->document.parts.size(), "part"),
                      counted(input->document.stocks.size(), "stock"));
  text += completeness_text(input->document, completeness);
  if (!violations.empty())
    text += counted(violations.size(), "violation") + "; lekalo check says which and where\n";
  if (!o.picture.empty()) text += fmt::format("Written: {}\n", o.picture);
  tell(text);
  return 0;
}

}  // namespace lekalo::cli
