#include "edit_command.hpp"

#include <fmt/format.h>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/session.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_edit(const EditOptions& o) {
  Result<LayoutInput> input =
      read_layout_input(o.source, {{"--output", o.output}}, {{"--commands", o.commands}});
  if (!input) return tl::unexpected(input.error());
  const Result<std::string> log = disk::read_file(o.commands);
  if (!log) return tl::unexpected(log.error());
  const Result<layout::Session> session = layout::replay(std::move(input->document), *log);
  if (!session)
    return failure(session.error().code, fmt::format("{}, {}", o.commands, session.error().message));
  const std::string text = io::write_layout(session->document());
  if (Result<void> done = deliver(o.output, text); !done) return tl::unexpected(done.error());
  std::string said = notes(input->notices);
  const std::size_t broken = layout::check(session->document()).size();
  said += fmt::format("{} placed, {}\n", session->document().placements.size(),
                      broken == 0 ? "no rule is broken"
                                  : counted(broken, "violation") + "; lekalo check says which and where");
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return broken == 0 ? 0 : 1;
}

}  // namespace lekalo::cli
