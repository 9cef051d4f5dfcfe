#include "pocket_command.hpp"

#include <fmt/format.h>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/region_json.hpp"
#include "lekalo/verify/simulate.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// What a machine's axes and a few decimals may take of a wall, mm.
constexpr double kMostGouge = 0.005;

/// The written program, as who does not know how it was made finds it; ErrorCode::refuted where it leaves the
/// pocket or crosses material in rapid motion.
Result<verify::SimulateReport> judgement_of(const std::string& program, const std::string& pocket,
                                            const PocketOptions& o) {
  verify::SimulateOptions machining;
  machining.tool_diameter = o.path.tool_diameter;
  machining.stock_to_leave = o.path.stock_to_leave;
  machining.step_over = o.path.step_over;
  machining.spacing = 5;  // coverage, gouge and time do not depend on it
  Result<verify::SimulateReport> report =
      verify::simulate({"the program", program}, {o.pocket, pocket}, machining);
  if (!report)
    return failure(ErrorCode::refuted,
                   "the independent checker cannot read this program; please report the pocket: " +
                       report.error().message);
  if (report->gouge_mm > kMostGouge || report->rapid_cut_mm > 0)
    return failure(
        ErrorCode::refuted,
        fmt::format("{}: the program found would cut {:.4f} mm into what stays, or {:.3f} mm in rapid "
                    "motion; nothing is written, please report the pocket",
                    o.pocket, report->gouge_mm, report->rapid_cut_mm));
  return report;
}

std::string summary_of(const verify::SimulateReport& r) {
  std::string text = fmt::format(
      "{:.4f} % of what the tool can reach is cut, nothing wider than {:.3f} mm is left; gouge {:.4f} mm\n"
      "{:.1f} mm of path, {} retracts, about {:.1f} s; lekalo simulate tells the engagement\n",
      r.coverage_percent, r.uncut_width_mm, r.gouge_mm, r.length_mm, r.retracts, r.seconds);
  for (const verify::UnreachableSpot& spot : r.unreachable)
    text +=
        fmt::format("out of reach: {:.2f} mm2 about ({:.2f}, {:.2f}), up to {:.2f} mm from what can be cut\n",
                    spot.area_mm2, spot.x, spot.y, spot.distance_mm);
  return text;
}

}  // namespace

Result<int> run_pocket(const PocketOptions& o) {
  if (Result<void> good = check_outputs({{"-o", o.output}}, {{"pocket", o.pocket}}); !good)
    return tl::unexpected(good.error());
  const Result<std::string> bytes = io::read_file(o.pocket);
  if (!bytes) return tl::unexpected(bytes.error());
  const Result<io::RegionFile> file = io::parse_regions(*bytes, o.pocket);
  if (!file) return tl::unexpected(file.error());
  if (const auto fault = geom::fault_of(file->regions))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", o.pocket, *fault));
  const Result<mill::PocketPath> path = mill::pocket_path(file->regions, o.path);
  if (!path) return failure(path.error().code, fmt::format("{}: {}", o.pocket, path.error().message));
  const std::string program = mill::program_of(*path, o.program);
  const Result<verify::SimulateReport> judged = judgement_of(program, *bytes, o);
  if (!judged) return tl::unexpected(judged.error());
  if (Result<void> done = deliver(o.output, program); !done) return tl::unexpected(done.error());
  tell(summary_of(*judged) + (o.output.empty() ? "" : fmt::format("Written: {}\n", o.output)));
  return 0;
}

}  // namespace lekalo::cli
