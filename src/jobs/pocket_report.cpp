#include "pocket_report.hpp"

#include <algorithm>
#include <cmath>

#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/mill/straight_pass.hpp"
#include "pocket_judge.hpp"

namespace lekalo::jobs {
namespace {

constexpr double kLasting = 0.2;  // mm, as the checker has it for its largest engagement

double rounded(double value) { return std::round(value * 1000) / 1000; }

ReportedStretch reported(geom::Point from, geom::Point to, double z, double length, double degrees) {
  return {{rounded(from.x), rounded(from.y)},
          {rounded(to.x), rounded(to.y)},
          rounded(z),
          rounded(length),
          rounded(degrees)};
}

void write(io::JsonWriter& json, const std::vector<ReportedStretch>& stretches) {
  json.list(stretches, [&](const ReportedStretch& s) {
    json.begin_object().key("from").list({s.from.x, s.from.y}).key("to").list({s.to.x, s.to.y});
    json.fields({{"z", s.z}, {"length_mm", s.length_mm}, {"engagement_deg", s.engagement_deg}}).end();
  });
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

std::string pocket_json(const PocketJob& job, const Pocketed& made, const io::ReadOutline& outline,
                        const std::string& regions, const std::string& supposed) {
  const PocketOptions& o = job.options;
  io::JsonWriter json = begin_document("lekalo-pocket");
  json.field("units", "mm").key("inputs").begin_list();
  write_file(json, "pocket", job.pocket);
  write_earlier(json, job.after);
  json.end().key("outputs").begin_list();
  write_file(json, "program", {job.written_as, made.program});
  write_machining(json.end(), machining_of(o));
  json.fields({{"depth_mm", o.path.depth}, {"floor_stock_mm", o.path.floor_stock}});
  if (o.rest_of > 0) json.fields({{"rest_of_mm", o.rest_of}, {"supposed_program", supposed}});
  write_report(json, made.report);
  write(json.key("hot_cuts"), made.hot_cuts);
  write(json.key("ramps"), made.ramps);
  json.key("regions").raw() += regions;
  json.field("tolerance_mm", outline.outline.tolerance).key("open_layers").list(o.open_layers);
  io::write_record(json.key("drawing"), outline.drawing);
  io::write_record(json.key("scan"), outline.scan);
  json.field("version", kVersion);
  return end_document(json);
}

}  // namespace lekalo::jobs
