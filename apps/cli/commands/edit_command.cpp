#include "edit_command.hpp"

#include <fmt/core.h>

#include <utility>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/edit.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {

Result<int> run_edit(const EditOptions& o) {
  LEKALO_TRY(jobs::Layout input,
             read_layout_input(o.source, {{"--output", o.output}}, {{"--commands", o.commands}}));
  LEKALO_TRY(std::string log, disk::read_file(o.commands));
  LEKALO_TRY(const jobs::Edited edited, jobs::edit(std::move(input.document), {o.commands, std::move(log)}));
  LEKALO_CHECK(deliver(o.output, edited.bytes));
  std::string said = notes(input.notices) + notes(edited.notices);
  const std::size_t broken = edited.violations.size();
  said += fmt::format("{} placed, {}\n", edited.document.placements.size(),
                      broken == 0 ? "no rule is broken"
                                  : counted(broken, "violation") + "; lekalo check says which and where");
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return broken == 0 ? 0 : 1;
}

}  // namespace lekalo::cli
