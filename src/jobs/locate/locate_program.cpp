#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/nc/allow_list.hpp"
#include "lekalo/nc/header.hpp"
#include "locate_documents.hpp"
#include "solid_documents.hpp"

namespace lekalo::jobs {
namespace {

/// A program, and the placement that it is rewritten for.
struct ProgramOrder {
  const File& program;
  const std::optional<File>& allow;
  const std::string& output;  ///< the new program's name
  nc::RewriteOptions how;
  double x = 0, y = 0, theta = 0;
  /// The places of the program may be off by this, mm, because theta is the nearest double.
  double angle_lost = 0;
  double clearance = 0, min_allowance = 0;
  double spare = std::numeric_limits<double>::infinity();  ///< see spare_of_demands
};

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
std::vector<std::string> header_of(const ProgramOrder& order, const nc::Rewritten& program) {
  const std::string height = order.how.z ? fmt::format(" Z {:.5f}", *order.how.z) : "";
  std::vector<std::string> sentences{
      fmt::format("LEKALO {} FROM {}", kVersion, order.program.name),
      fmt::format("SHA-256 OF IT BEGINS {}", io::sha256(order.program.bytes).substr(0, 16)),
      fmt::format("THE PART LIES AT X {:.5f} Y {:.5f}{} MM", order.x, order.y, height),
      fmt::format("TURNED BY {:.5f} DEGREES", order.theta * kDegreesPerRadian)};
  sentences.insert(sentences.end(), program.notes.begin(), program.notes.end());
  return sentences;
}

/// `made` is the result of a placement in the plane, or of solids.
template <class Made>
void withhold(Made& made, const std::string& why) {
  made.program_withheld = true;
  made.document.warnings.push_back("no NC program was written, because " + why);
}

template <class Made>
Result<void> add_rewritten(ProgramOrder order, Made& made) {
  if (order.allow) {
    LEKALO_TRY(order.how.allowed_m, nc::parse_allow_list(order.allow->bytes, order.allow->name));
  }
  LEKALO_TRY(nc::Rewritten program, nc::rewrite_program(order.program.bytes, order.program.name, order.x,
                                                        order.y, order.theta, order.how));
  program.rounding_mm += order.angle_lost;
  const double clearance = difference_rounded_down(order.clearance, program.rounding_mm);
  if (!(clearance >= order.min_allowance && order.spare >= program.rounding_mm)) {
    withhold(made, fmt::format("its rounding to the written decimals, up to {} mm, would leave {} mm",
                               program.rounding_mm, clearance));
    return {};
  }
  made.program = nc::with_header(program.program, header_of(order, program), program.control);
  made.document.nc = io::NcRecord{io::name_of(order.how.mode),
                                  io::name_of(order.how.scan_frame),
                                  std::string(words::word_of(program.control)),
                                  order.how.work_offset,
                                  program.rounding_mm,
                                  clearance,
                                  program.motions,
                                  std::move(program.notes),
                                  {order.output, io::sha256(made.program)}};
  return {};
}

/// Why this placement of solids is none for a program of three axes; empty: it is one.
std::string hindrance(const SolidLocateJob& job, const io::SolidDocument& d) {
  if (!d.inside()) return "the part is not inside the blank";
  if (d.scan && !d.scan->proved()) return "parts of the blank are unknown";
  if (d.pose.quaternion[1] != 0 || d.pose.quaternion[2] != 0)
    return "the part lies tilted, which three axes cannot follow; place it with --freedom c-xyz or xyz, and "
           "from a start that is not tilted";
  return *d.clearance < job.options.min_allowance ? "the allowance is not met" : "";
}

}  // namespace

Result<void> add_program(const LocateJob& job, Located& made) {
  if (!job.program) return {};
  io::LocateDocument& d = made.document;
  if (const std::string why = hindrance(d); !why.empty()) return withhold(made, why), Result<void>{};
  const locate::Placement& p = d.placement;
  return add_rewritten({.program = *job.program,
                        .allow = job.allow,
                        .output = job.outputs.program,
                        .how = job.options.rewrite,
                        .x = p.x,
                        .y = p.y,
                        .theta = p.theta,
                        .clearance = p.clearance,
                        .min_allowance = job.options.min_allowance,
                        .spare = spare_of_demands(d)},
                       made);
}

Result<void> add_program(const SolidLocateJob& job, LocatedSolid& made) {
  if (!job.program) return {};
  io::SolidDocument& d = made.document;
  if (const std::string why = hindrance(job, d); !why.empty()) return withhold(made, why), Result<void>{};
  /// The rewriter takes no coordinate beyond a million inches, and twice the angle of a direction is within
  /// 2.1e-15 of the turn.
  constexpr double kAngleLost = 2.1e-15 * 1.5 * 25.4e6;
  const auto [w, qx, qy, z] = d.pose.quaternion;
  const double theta = 2 * geom::direction_angle(w, z);
  nc::RewriteOptions how = job.options.rewrite;
  how.z = d.pose.shift.z;
  return add_rewritten({.program = *job.program,
                        .allow = job.allow,
                        .output = job.outputs.program,
                        .how = std::move(how),
                        .x = d.pose.shift.x,
                        .y = d.pose.shift.y,
                        .theta = theta,
                        .angle_lost = theta == 0 ? 0 : kAngleLost,
                        .clearance = *d.clearance,
                        .min_allowance = job.options.min_allowance},
                       made);
}

}  // namespace lekalo::jobs
