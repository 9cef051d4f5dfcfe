#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "locate_documents.hpp"

namespace lekalo::jobs {
namespace {

/// How far the program may be off before a minimum that a feature demands is missed, mm.
double spare_of_demands(const io::LocateDocument& d) {
  if (!d.demands) return std::numeric_limits<double>::infinity();
  double least_scale = 1;
  for (const locate::Feature& f : d.demands->features) least_scale = std::min(least_scale, f.scale);
  return d.demands->margin * least_scale;
}

/// Why this placement is none for a program; empty: it is one.
std::string hindrance(const io::LocateDocument& d) {
  if (d.scan && !d.scan->proved) return "stretches of the blank are unknown";
  if (d.mirrored) return "the part lies mirrored and a program for it would have to be mirrored too";
  return d.shortfall > 0 ? "the allowance is not met" : "";
}

void withhold(Located& made, const std::string& why) {
  made.program_withheld = true;
  made.document.warnings.push_back("no NC program was written, because " + why);
}

}  // namespace

Result<void> add_program(const LocateJob& job, Located& made) {
  if (!job.program) return {};
  io::LocateDocument& d = made.document;
  if (const std::string why = hindrance(d); !why.empty()) return withhold(made, why), Result<void>{};
  const nc::RewriteOptions& how = job.options.rewrite;
  const locate::Placement& p = d.placement;
  LEKALO_TRY(nc::Rewritten program,
             nc::rewrite_program(job.program->bytes, job.program->name, p.x, p.y, p.theta, how));
  const double clearance = difference_rounded_down(p.clearance, program.rounding_mm);
  if (!(clearance >= job.options.min_allowance && spare_of_demands(d) >= program.rounding_mm)) {
    withhold(made, fmt::format("its rounding to the written decimals, up to {} mm, would leave {} mm",
                               program.rounding_mm, clearance));
    return {};
  }
  made.program = std::move(program.program);
  d.nc = io::NcRecord{io::name_of(how.mode),
                      io::name_of(how.scan_frame),
                      how.work_offset,
                      program.rounding_mm,
                      clearance,
                      program.motions,
                      std::move(program.notes),
                      {job.outputs.program, io::sha256(made.program)}};
  return {};
}

}  // namespace lekalo::jobs
