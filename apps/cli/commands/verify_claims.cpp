#include "verify_claims.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "earlier_programs.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/verify_claims.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using verify::Kind;

/// The options for files and numbers, whether one was given, and the kinds that take it.
struct Given {
  const char* option;
  bool given;
  std::initializer_list<Kind> kinds;
};

Result<void> check_words(const VerifyOptions& o, Kind kind) {
  const std::initializer_list<Given> options = {
      {"--part", !o.part.empty(), {}},
      {"--blank", !o.blank.empty(), {}},
      {"--features", !o.features.empty(), {}},
      {"--nc", !o.program.empty(), {}},
      {"--compare", !o.earlier.empty(), {}},
      {"--start", !o.start.empty(), {}},
      {"--certificate", !o.certificate.empty(), {}},
      {"--layout",
       !o.layout.empty(),
       {Kind::layout, Kind::nest_report, Kind::check_report, Kind::show_report, Kind::program, Kind::dxf,
        Kind::svg, Kind::hpgl}},
      {"--kerf", o.kerf.has_value(), {Kind::program}},
      {"--pierce-diameter", o.pierce_diameter.has_value(), {Kind::program}},
      {"--joint-width", o.joint_width.has_value(), {Kind::program}},
      {"--common-line", o.common_line, {Kind::program}},
      {"--tolerance", o.tolerance.has_value(), {Kind::program, Kind::hpgl}},
      {"--blade-offset", o.blade_offset.has_value(), {Kind::hpgl}},
      {"--turn-above", o.turn_above.has_value(), {Kind::hpgl}},
      {"--knife-tolerance", o.knife_tolerance.has_value(), {Kind::hpgl}},
      {"--sheet", !o.export_words.sheet.empty(), {Kind::program, Kind::dxf, Kind::svg, Kind::hpgl}},
      {"--only", !o.export_words.only.empty(), {Kind::dxf, Kind::svg, Kind::hpgl}},
      {"--pocket", !o.pocket.empty(), {Kind::program, Kind::pocket_report, Kind::simulate_report}},
      {"--program", !o.cut_program.empty(), {Kind::pocket_report, Kind::simulate_report}},
      {"--tool", o.tool_diameter.has_value(), {Kind::program}},
      {"--stock-to-leave", o.machining.stock_to_leave != 0, {Kind::program}},
      {"--top", o.machining.top != 0, {Kind::program}},
      {"--control", o.machining.control != verify::SimulateOptions().control, {Kind::program}},
      {"--after", !o.after.empty(), {Kind::program}},
  };
  // A file of no kind is bad input, whatever is said beside it.
  for (const Given& option : options)
    if (kind != Kind::unknown && option.given &&
        std::find(option.kinds.begin(), option.kinds.end(), kind) == option.kinds.end())
      return failure(ErrorCode::usage, fmt::format("{}: {} is {}, which has no use for it", option.option,
                                                   o.result, name_of(kind)));
  return {};
}

Result<std::optional<jobs::File>> read(const std::string& path) {
  if (path.empty()) return std::nullopt;
  LEKALO_TRY(std::string bytes, disk::read_file(path));
  return jobs::File{path, std::move(bytes)};
}

std::string words(const jobs::VerifiedClaims& verified, Kind kind) {
  const verify::ClaimReport& report = verified.report;
  std::string text;
  if (verified.status == "confirmed")
    text = fmt::format("Confirmed: {}, and everything that it claims holds.\n", name_of(kind));
  else if (verified.status == "refuted")
    text = fmt::format("Refuted: {}, and something in it is not true.\n", name_of(kind));
  else if (report.stated_regions)
    text = "Confirmed for the stated regions: whether they are those of the input was not rechecked.\n";
  else
    text = "Incomplete: what was rechecked holds, but not everything was.\n";
  for (const std::string& finding : report.findings) text += "  not true           " + finding + "\n";
  for (const std::string& claim : report.unchecked) text += "  not rechecked      " + claim + "\n";
  for (const std::string& note : report.notes) text += "  note               " + note + "\n";
  return text;
}

}  // namespace

Result<int> verify_other(const VerifyOptions& o, const std::string& bytes, Kind kind,
                         const jobs::FileFinder& find) {
  LEKALO_CHECK(check_words(o, kind));
  jobs::Beside beside;
  LEKALO_TRY(beside.layout, read(o.layout));
  LEKALO_TRY(beside.pocket, read(o.pocket));
  beside.tool_diameter = o.tool_diameter;
  beside.machining = o.machining;
  LEKALO_TRY(beside.after, read_earlier(o.after));
  beside.export_words = o.export_words;
  if (o.kerf)
    beside.profile = {o.export_words.sheet,
                      *o.kerf,
                      o.tolerance.value_or(0.01),
                      o.machining.control,
                      o.pierce_diameter.value_or(0),
                      o.joint_width.value_or(0),
                      o.common_line};
  beside.export_words.chord_tolerance = o.tolerance.value_or(0.02);
  if (o.blade_offset || o.turn_above)
    beside.export_words.knife = {o.blade_offset.value_or(0), kDegree * o.turn_above.value_or(0),
                                 o.knife_tolerance.value_or(verify::KnifeWords().tolerance)};
  LEKALO_TRY(const jobs::VerifiedClaims verified, jobs::verify_claims({o.result, bytes}, beside, find));
  if (o.json) LEKALO_CHECK(print(verified.json));
  tell(words(verified, kind));
  if (verified.status == "confirmed") return 0;
  return verified.status == "refuted" ? 4 : 1;
}

}  // namespace lekalo::cli
