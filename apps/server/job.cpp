#include "job.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "lekalo/layout/workspace.hpp"

namespace lekalo::server {
namespace {

using layout::Placement;
using layout::Sheet;
using layout::Workspace;

/// Compacts sheet by sheet, as the command does. Each sheet makes the layout better than it was, so the job
/// tells of the layout after each.
Result<layout::Change> compact_all(const layout::Document& document, const JobContext& context,
                                   layout::CompactCommand command, layout::Mode mode) {
  std::map<Sheet, double> sheets;  // each with its number of parts
  double all = 0, done = 0;
  for (const Placement& placement : document.placements)
    if (placement.copy >= 0 && placement.copy < document.stocks[placement.stock].count)
      sheets[{placement.stock, placement.copy}] += 1, all += 1;
  Workspace work(document);
  double parts = 0;
  RunControl run = context.run;
  run.progress = [&](const Progress& progress) {
    if (context.run.progress)
      context.run.progress({progress.work, std::min(1.0, (done + parts * progress.fraction) / all)});
  };
  for (const auto& [sheet, count] : sheets) {
    command.sheet = sheet;
    parts = count;
    LEKALO_TRY(const layout::Change change, plan(work, command, mode, run));
    carry_out(work, change);
    done += count;
    if (context.run.stop_requested()) break;
    if (context.improved && !change.is_nothing())
      context.improved(layout::difference(document, work.document()));
  }
  return layout::difference(document, work.document());
}

}  // namespace

std::optional<Job> job_of(const layout::Command& command, layout::Mode mode) {
  if (const auto* compact = std::get_if<layout::CompactCommand>(&command); compact && !compact->sheet)
    return [compact = *compact, mode](const layout::Document& document, const JobContext& context) {
      return compact_all(document, context, compact, mode);
    };
  const bool is_long = std::holds_alternative<layout::CompactCommand>(command) ||
                       std::holds_alternative<layout::FitCommand>(command);
  if (!is_long) return std::nullopt;
  return [command, mode](const layout::Document& document, const JobContext& context) {
    return plan(Workspace(document), command, mode, context.run);
  };
}

}  // namespace lekalo::server
