#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/nc/allow_list.hpp"
#include "lekalo/nc/header.hpp"
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

/// Returns the sentences that the operator reads at the top of the program.
std::vector<std::string> header_of(const LocateJob& job, const locate::Placement& p,
                                   const nc::Rewritten& program) {
  std::vector<std::string> sentences{
      fmt::format("LEKALO {} FROM {}", kVersion, job.program->name),
      fmt::format("SHA-256 OF IT BEGINS {}", io::sha256(job.program->bytes).substr(0, 16)),
      fmt::format("THE PART LIES AT X {:.5f} Y {:.5f} MM", p.x, p.y),
      fmt::format("TURNED BY {:.5f} DEGREES", p.theta * kDegreesPerRadian)};
  sentences.insert(sentences.end(), program.notes.begin(), program.notes.end());
  return sentences;
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
  nc::RewriteOptions how = job.options.rewrite;
  if (job.allow) {
    LEKALO_TRY(how.allowed_m, nc::parse_allow_list(job.allow->bytes, job.allow->name));
  }
  const locate::Placement& p = d.placement;
  LEKALO_TRY(nc::Rewritten program,
             nc::rewrite_program(job.program->bytes, job.program->name, p.x, p.y, p.theta, how));
  const double clearance = difference_rounded_down(p.clearance, program.rounding_mm);
  if (!(clearance >= job.options.min_allowance && spare_of_demands(d) >= program.rounding_mm)) {
    withhold(made, fmt::format("its rounding to the written decimals, up to {} mm, would leave {} mm",
                               program.rounding_mm, clearance));
    return {};
  }
  made.program = nc::with_header(program.program, header_of(job, p, program), program.control);
  d.nc = io::NcRecord{
      io::name_of(how.mode), io::name_of(how.scan_frame), std::string(words::word_of(program.control)),
      how.work_offset,       program.rounding_mm,         clearance,
      program.motions,       std::move(program.notes),    {job.outputs.program, io::sha256(made.program)}};
  return {};
}

}  // namespace lekalo::jobs
