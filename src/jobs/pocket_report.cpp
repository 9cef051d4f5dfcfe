#include "pocket_report.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/version.hpp"
#include "lekalo/mill/straight_pass.hpp"
#include "report_document.hpp"

namespace lekalo::jobs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLasting = 0.2;  // mm, as the checker has it for its largest engagement

double rounded(double value) { return std::round(value * 1000) / 1000; }

ReportedStretch reported(geom::Point from, geom::Point to, double z, double length, double degrees) {
  return {{rounded(from.x), rounded(from.y)},
          {rounded(to.x), rounded(to.y)},
          rounded(z),
          rounded(length),
          rounded(degrees)};
}

Json json_of(const std::vector<ReportedStretch>& stretches) {
  Json list = Json::array();
  for (const ReportedStretch& s : stretches)
    list.push_back({{"from", {s.from.x, s.from.y}},
                    {"to", {s.to.x, s.to.y}},
                    {"z", s.z},
                    {"length_mm", s.length_mm},
                    {"engagement_deg", s.engagement_deg}});
  return list;
}

}  // namespace

std::vector<ReportedStretch> hot_cuts(const verify::SimulateReport& report, double step_over) {
  const double held = mill::most_held_degrees(step_over);
  struct Stretch {
    const verify::EngagementSample *first, *last;
    double length, largest;
  };
  std::vector<Stretch> stretches;
  bool goes_on = false;
  for (const verify::EngagementSample& sample : report.samples) {
    const bool hot = !sample.entry && sample.engagement > held;
    if (hot && !goes_on) stretches.push_back({&sample, &sample, 0, 0});
    goes_on = hot;
    if (!hot) continue;
    Stretch& last = stretches.back();
    last.last = &sample;
    last.length += sample.length;
    last.largest = std::max(last.largest, sample.engagement);
  }
  std::vector<ReportedStretch> cuts;
  for (const Stretch& s : stretches)
    if (s.length >= kLasting - 1e-9)
      cuts.push_back(
          reported({s.first->x, s.first->y}, {s.last->x, s.last->y}, s.last->z, s.length, s.largest));
  return cuts;
}

std::vector<ReportedStretch> reported_ramps(const std::vector<mill::Ramp>& ramps) {
  std::vector<ReportedStretch> list;
  for (const mill::Ramp& r : ramps) list.push_back(reported(r.from, r.to, r.z, r.length, r.engagement_deg));
  return list;
}

std::string pocket_json(const PocketJob& job, const Pocketed& made) {
  const PocketOptions& o = job.options;
  Json json{
      {"format", {{"name", "lekalo-pocket"}, {"version", 1}}},
      {"units", "mm"},
      {"inputs", records_with_earlier(Json::array({file_record("pocket", job.outline.file)}), job.after)},
      {"outputs", Json::array({file_record("program", {job.written_as, made.program})})},
      {"tool_mm", o.path.tool_diameter},
      {"step_over", o.path.step_over},
      {"depth_mm", o.path.depth},
      {"stock_to_leave_mm", o.path.stock_to_leave}};
  if (o.rest_of > 0) json["rest_of_mm"] = o.rest_of;
  json.update(report_fields(made.report));
  json["hot_cuts"] = json_of(made.hot_cuts);
  json["ramps"] = json_of(made.ramps);
  json["version"] = kVersion;
  return document_text(json);
}

}  // namespace lekalo::jobs
