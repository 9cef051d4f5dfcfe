#include "report_document.hpp"

#include <utility>

#include "lekalo/io/text/sha256.hpp"

namespace lekalo::jobs {

using Json = nlohmann::ordered_json;

Json file_record(const char* role, const File& file) {
  return {{"role", role}, {"path", file.name}, {"sha256", io::sha256(file.bytes)}};
}

Json records_with_earlier(Json first, const std::vector<EarlierProgram>& earlier) {
  for (const EarlierProgram& before : earlier) {
    first.push_back(file_record("after", before.program));
    first.back()["tool_mm"] = before.tool_diameter;
  }
  return first;
}

Json report_fields(const verify::SimulateReport& r) {
  Json unreachable = Json::array(), uncut = Json::array();
  for (const verify::UnreachableSpot& spot : r.unreachable)
    unreachable.push_back(
        {{"x", spot.x}, {"y", spot.y}, {"distance_mm", spot.distance_mm}, {"area_mm2", spot.area_mm2}});
  for (const verify::UncutSpot& spot : r.uncut)
    uncut.push_back({{"x", spot.x}, {"y", spot.y}, {"width_mm", spot.width_mm}});
  return {{"coverage_percent", r.coverage_percent},
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
          {"left_before_mm2", r.left_before_mm2},
          {"uncut", std::move(uncut)},
          {"unreachable", std::move(unreachable)}};
}

std::string document_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lekalo::jobs
