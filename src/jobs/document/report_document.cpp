#include "report_document.hpp"

#include "lekalo/io/text/sha256.hpp"

namespace lekalo::jobs {

using io::JsonWriter;

namespace {

JsonWriter& begin_file(JsonWriter& json, const char* role, const File& file) {
  return json.begin_object().fields(
      {{"role", role}, {"path", file.name}, {"sha256", io::sha256(file.bytes)}});
}

}  // namespace

JsonWriter begin_document(const char* format) {
  JsonWriter json(io::JsonLayout::indented);
  json.begin_object().key("format").object({{"name", format}, {"version", 1}});
  return json;
}

std::string end_document(JsonWriter& json) {
  json.end();
  return json.take() + "\n";
}

void write_file(JsonWriter& json, const char* role, const File& file) { begin_file(json, role, file).end(); }

void write_earlier(JsonWriter& json, const std::vector<EarlierProgram>& earlier) {
  for (const EarlierProgram& before : earlier)
    begin_file(json, "after", before.program).field("tool_mm", before.tool_diameter).end();
}

void write_machining(JsonWriter& json, const verify::SimulateOptions& machining) {
  json.fields({{"tool_mm", machining.tool_diameter},
               {"stock_to_leave_mm", machining.stock_to_leave},
               {"step_over", machining.step_over},
               {"top_mm", machining.top},
               {"acceleration_mm_per_s2", machining.acceleration},
               {"rapid_mm_per_min", machining.rapid_feed},
               {"control", words::word_of(machining.control)}});
}

void write_report(JsonWriter& json, const verify::SimulateReport& r) {
  json.fields({{"coverage_percent", r.coverage_percent},
               {"coverage_low_percent", r.coverage_low_percent},
               {"uncut_width_mm", r.uncut_width_mm},
               {"gouge_mm", r.gouge_mm},
               {"engagement_max_deg", r.engagement_max_deg},
               {"engagement_peak_deg", r.engagement_peak_deg},
               {"engagement_p95_deg", r.engagement_p95_deg},
               {"air_percent", r.air_percent},
               {"entry_mm", r.entry_mm},
               {"entry_layer_mm", r.entry_layer_mm},
               {"rapid_cut_mm", r.rapid_cut_mm},
               {"length_mm", r.length_mm},
               {"turning_rad", r.turning_rad},
               {"retracts", r.retracts},
               {"seconds", r.seconds},
               {"lower_bound_seconds", r.lower_bound_seconds},
               {"reachable_mm2", r.reachable_mm2},
               {"uncut_mm2", r.uncut_mm2},
               {"left_before_mm2", r.left_before_mm2}});
  json.key("uncut").list(r.uncut, [&](const verify::UncutSpot& spot) {
    json.object({{"x", spot.x}, {"y", spot.y}, {"width_mm", spot.width_mm}});
  });
  json.key("unreachable").list(r.unreachable, [&](const verify::UnreachableSpot& spot) {
    json.object(
        {{"x", spot.x}, {"y", spot.y}, {"distance_mm", spot.distance_mm}, {"area_mm2", spot.area_mm2}});
  });
}

}  // namespace lekalo::jobs
