#include "simulate_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lekalo/base/version.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/result_json.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string report_json(const SimulateOptions& o, const std::string& program, const std::string& pocket,
                        const verify::SimulateReport& r) {
  Json unreachable = Json::array();
  for (const verify::UnreachableSpot& spot : r.unreachable)
    unreachable.push_back(
        {{"x", spot.x}, {"y", spot.y}, {"distance_mm", spot.distance_mm}, {"area_mm2", spot.area_mm2}});
  const Json json{{"format", {{"name", "lekalo-simulate"}, {"version", 1}}},
                  {"units", "mm"},
                  {"inputs",
                   {{{"role", "program"}, {"path", o.program}, {"sha256", io::sha256(program)}},
                    {{"role", "pocket"}, {"path", o.pocket}, {"sha256", io::sha256(pocket)}}}},
                  {"tool_mm", o.machining.tool_diameter},
                  {"stock_to_leave_mm", o.machining.stock_to_leave},
                  {"coverage_percent", r.coverage_percent},
                  {"coverage_low_percent", r.coverage_low_percent},
                  {"uncut_width_mm", r.uncut_width_mm},
                  {"gouge_mm", r.gouge_mm},
                  {"engagement_max_deg", r.engagement_max_deg},
                  {"engagement_peak_deg", r.engagement_peak_deg},
                  {"engagement_p95_deg", r.engagement_p95_deg},
                  {"air_percent", r.air_percent},
                  {"entry_mm", r.entry_mm},
                  {"rapid_cut_mm", r.rapid_cut_mm},
                  {"length_mm", r.length_mm},
                  {"turning_rad", r.turning_rad},
                  {"retracts", r.retracts},
                  {"seconds", r.seconds},
                  {"lower_bound_seconds", r.lower_bound_seconds},
                  {"reachable_mm2", r.reachable_mm2},
                  {"uncut_mm2", r.uncut_mm2},
                  {"unreachable", std::move(unreachable)},
                  {"version", kVersion}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_text(const verify::SimulateReport& r) {
  std::string text;
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<21}{}\n", name, value);
  };
  row("coverage", fmt::format("{:.4f} % of what the tool can reach (surely {:.4f} %)", r.coverage_percent,
                              r.coverage_low_percent));
  row("largest uncut spot", fmt::format("at most {:.3f} mm wide", r.uncut_width_mm));
  row("gouge", fmt::format("{:.4f} mm", r.gouge_mm));
  row("engagement",
      fmt::format("at most {:.1f} degrees, 95 % of what cuts below {:.1f}, outside {:.1f} mm of entry",
                  r.engagement_max_deg, r.engagement_p95_deg, r.entry_mm));
  row("air", fmt::format("{:.1f} % of {:.1f} mm of path", r.air_percent, r.length_mm));
  row("retracts", fmt::format("{}", r.retracts));
  row("turning", fmt::format("{:.1f} rad", r.turning_rad));
  row("time", fmt::format("{:.1f} s; no path of this step-over takes less than {:.1f} s", r.seconds,
                          r.lower_bound_seconds));
  if (r.rapid_cut_mm > 0) row("rapids in material", fmt::format("{:.2f} mm", r.rapid_cut_mm));
  for (const verify::UnreachableSpot& spot : r.unreachable)
    row("out of reach", fmt::format("{:.2f} mm2 about ({:.2f}, {:.2f}), up to {:.2f} mm from what can be cut",
                                    spot.area_mm2, spot.x, spot.y, spot.distance_mm));
  return text;
}

std::string samples_csv(const verify::SimulateReport& r) {
  std::string text = "x,y,z,length,engagement_deg,line,entry\n";
  for (const verify::EngagementSample& s : r.samples)
    text += fmt::format("{:.5f},{:.5f},{:.5f},{:.5f},{:.3f},{},{}\n", s.x, s.y, s.z, s.length, s.engagement,
                        s.line, s.entry ? 1 : 0);
  return text;
}

}  // namespace

Result<int> run_simulate(const SimulateOptions& o) {
  if (Result<void> good =
          check_outputs({{"--samples", o.samples}}, {{"program", o.program}, {"--pocket", o.pocket}});
      !good)
    return tl::unexpected(good.error());
  const Result<std::string> program = io::read_file(o.program);
  if (!program) return tl::unexpected(program.error());
  const Result<std::string> pocket = io::read_file(o.pocket);
  if (!pocket) return tl::unexpected(pocket.error());
  const Result<verify::SimulateReport> report =
      verify::simulate({o.program, *program}, {o.pocket, *pocket}, o.machining);
  if (!report) return tl::unexpected(report.error());
  if (!o.samples.empty()) {
    if (Result<void> done = deliver(o.samples, samples_csv(*report)); !done)
      return tl::unexpected(done.error());
  }
  if (o.json) {
    if (Result<void> done = print(report_json(o, *program, *pocket, *report)); !done)
      return tl::unexpected(done.error());
  }
  tell(report_text(*report));
  return 0;
}

}  // namespace lekalo::cli
