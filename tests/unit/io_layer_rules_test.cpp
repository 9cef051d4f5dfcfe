#include "lekalo/io/formats/layer_rules.hpp"

#include <gtest/gtest.h>

namespace lekalo::io::io_layer_rules_test {
namespace {

LayerRules rules(const std::string& rows) {
  auto read = read_layer_rules(R"({"format": "lekalo-layers/1", "layers": [)" + rows + "]}", "shop.json");
  EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().message);
  return read ? *std::move(read) : LayerRules{};
}
std::string refusal(const std::string& text) {
  const auto read = read_layer_rules(text, "shop.json");
  return read ? "taken" : read.error().message;
}
std::string row_refusal(const std::string& rows) {
  return refusal(R"({"format": "lekalo-layers/1", "layers": [)" + rows + "]}");
}

TEST(LayerRules, TheFirstRowThatFitsCounts) {
  const LayerRules table = rules(R"({"name": "Engrave", "colour": "#FF0000", "role": "cut"},
    {"name": "ENGRAVE", "role": "engrave"}, {"line_type": "dashed", "role": "bend"},
    {"colour": "#00ff00", "role": "mark"}, {"role": "ignore"})");
  EXPECT_EQ(role_of(table, {"engrave", false, "#ff0000", ""}), LayerRole::cut);
  EXPECT_EQ(role_of(table, {"engrave", false, "#0000ff", "DASHED"}), LayerRole::engrave);
  EXPECT_EQ(role_of(table, {"x", false, "#0000ff", "DASHED"}), LayerRole::bend);
  EXPECT_EQ(role_of(table, {"x", false, "#00FF00", ""}), LayerRole::mark);
  EXPECT_EQ(role_of(table, {"x", false, "", ""}), LayerRole::ignore);
  EXPECT_EQ(role_of(LayerRules{}, {"x", false, "", ""}), std::nullopt);
}

TEST(LayerRules, EveryFaultIsToldWithItsRow) {
  EXPECT_EQ(refusal("[]"), "shop.json: a table of layers is an object, not a list");
  EXPECT_EQ(refusal(R"({"format": "lekalo-process/1"})"),
            "shop.json: this is no table of layers: \"format\" has to be \"lekalo-layers/1\"");
  EXPECT_EQ(refusal(R"({"format": "lekalo-layers/1", "rows": 1})"),
            "shop.json: there is no key 'rows' beside \"format\" and \"layers\"; \"layers\" has to be a list "
            "of 1 to 10000 rows");
  EXPECT_EQ(
      row_refusal(R"(7, {"name": "A"}, {"name": "", "role": "cut"}, {"name": "A", "role": "drill"},
                           {"colour": "red", "role": "cut"}, {"color": "#ff0000", "role": "cut"})"),
      "shop.json: row 1: an object is needed, not a number; row 2: role is missing: what the layer is, one "
      "of cut, mark, engrave, bend and ignore; row 3: name has to be a text of 1 to 1000 bytes without "
      "control characters; leave it out to fit any; row 4: role 'drill' has to be one of cut, mark, "
      "engrave, bend and ignore; row 5: colour 'red' has to be written as in \"#0000ff\"; row 6: there is "
      "no key 'color'; known are name, colour, line_type and role");
  EXPECT_EQ(row_refusal(R"({"name": "A", "role": "cut"}, {"name": "a", "role": "mark"})"),
            "shop.json: row 2: row 1 fits the same layers already; leave one of them out");
  EXPECT_EQ(
      row_refusal(R"({"role": "cut"}, {"name": "a", "role": "mark"})"),
      "shop.json: row 2: row 1 names no layer and so fits all, so this row never counts; put it before");
}

}  // namespace
}  // namespace lekalo::io::io_layer_rules_test
