#include "program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::cli {
namespace {

/// How far the program may be off before a minimum that a feature demands is missed, mm.
double spare_of_demands(const io::LocateDocument& d) {
  if (!d.regions || !d.regions->demands) return std::numeric_limits<double>::infinity();
  double least_scale = 1;
  for (const locate::Feature& f : d.regions->demands->features) least_scale = std::min(least_scale, f.scale);
  return d.regions->demands->margin * least_scale;
}

}  // namespace

Result<RewrittenProgram> rewrite_for(const LocateOptions& o, const std::string& nc_bytes,
                                     io::LocateDocument& d) {
  if (d.shortfall > 0) {
    d.warnings.push_back("no NC program was written, because the allowance is not met");
    return RewrittenProgram{"", true};
  }
  const locate::Placement& p = d.placement;
  Result<nc::Rewritten> rewritten = nc::rewrite_program(nc_bytes, o.nc, p.x, p.y, p.theta, o.rewrite);
  if (!rewritten) return tl::unexpected(rewritten.error());
  const double clearance = difference_rounded_down(p.clearance, rewritten->rounding_mm);
  if (!(clearance >= o.min_allowance && spare_of_demands(d) >= rewritten->rounding_mm)) {
    d.warnings.push_back(
        fmt::format("no NC program was written, because its rounding to the written decimals, up to {} mm, "
                    "would leave {} mm",
                    rewritten->rounding_mm, clearance));
    return RewrittenProgram{"", true};
  }
  RewrittenProgram program{std::move(rewritten->program), false};
  d.nc = io::NcRecord{name_of(o.rewrite.mode),
                      name_of(o.rewrite.scan_frame),
                      o.rewrite.work_offset,
                      rewritten->rounding_mm,
                      clearance,
                      rewritten->motions,
                      std::move(rewritten->notes),
                      {o.nc_out, io::sha256(program.text)}};
  return program;
}

}  // namespace lekalo::cli
