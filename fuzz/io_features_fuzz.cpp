// Any bytes as a file of features. Whoever reads it says one sentence or gives demands that can be kept; what
// the product takes the checker takes too, and reads the same numbers in it.

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/io/locate/feature_file.hpp"
#include "require.hpp"
#include "verify/locate/feature_file.hpp"

namespace {

using namespace lekalo;

void check_sentence(const Error& error) {
  require(error.code == ErrorCode::bad_input && !error.message.empty());
}

void check_spec(const io::FeatureSpec& spec) {
  const locate::Feature& demand = spec.demand;
  require(std::isfinite(demand.minimum) && std::isfinite(demand.scale) && demand.scale > 0);
  const int said = (spec.edges.empty() ? 0 : 1) + (spec.contour ? 1 : 0) + (spec.label.empty() ? 0 : 1);
  require(said <= 1);
}

/// A plate with a hole: eight edges, two contours.
const std::vector<geom::Region>& plate() {
  static const std::vector<geom::Region> regions = [] {
    const std::string text =
        R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [80, 0]}}, {"line": {"from": [80, 0], "to": [80, 60]}},
        {"line": {"from": [80, 60], "to": [0, 60]}}, {"line": {"from": [0, 60], "to": [0, 0]}}],
        "holes": [[{"line": {"from": [20, 20], "to": [20, 40]}}, {"line": {"from": [20, 40], "to": [40, 40]}},
        {"line": {"from": [40, 40], "to": [40, 20]}}, {"line": {"from": [40, 20], "to": [20, 20]}}]]})";
    auto file = io::OutlineFile(text, "plate.json", {}).as_regions();
    require(file.has_value());
    return file->outline.regions;
  }();
  return regions;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = io::parse_features(bytes, "f.json", LengthUnit::millimetre);
  if (!file) {
    check_sentence(file.error());
    return 0;
  }
  for (const io::FeatureSpec& spec : file->features) check_spec(spec);
  const auto found = io::find_features(*file, plate(), std::vector<std::string>(8));
  if (!found) check_sentence(found.error());
  if (found) {
    require(found->size() == file->features.size());
    for (const locate::Feature& one : *found)
      for (const std::uint32_t edge : one.edges) require(edge < 8);
  }
  const auto rest = io::without_ignored(*file, plate());
  if (!rest) check_sentence(rest.error());
  if (rest) require(!rest->regions.empty() && rest->tolerance >= 0);

  const auto json = verify::parse_json(bytes, "f.json");
  require(json.has_value());
  std::string complaint;
  const auto stated = verify::read_features(*json, LengthUnit::millimetre, complaint);
  require(complaint.empty());
  require(stated.features.size() == file->features.size() && stated.ignored.empty() == file->ignored.empty());
  require(stated.minimum == file->minimum.value_or(0));
  for (std::size_t i = 0; i < stated.features.size(); ++i) {
    const verify::StatedFeature& theirs = stated.features[i];
    const locate::Feature& ours = file->features[i].demand;
    require(theirs.name == ours.name && theirs.numbers.minimum == ours.minimum &&
            theirs.numbers.scale == ours.scale);
  }
  return 0;
}
