// The published schema of features of solids accepts the examples, and refuses what the reader refuses.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/locate/solid_feature_file.hpp"
#include "support/places.hpp"
#include "support/schemas.hpp"

namespace lekalo::io::io_solid_features_test {
namespace {

const char* const kSchema = "lekalo-solid-features-1.schema.json";

bool is_read(const std::string& text) { return parse_solid_features(text, "f.json", {}).has_value(); }

TEST(SolidFeaturesSchema, AcceptsTheExamples) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts{
      "{}", R"({"as_cast": true, "features": [{"name": "a", "faces": [0, 3]}]})",
      R"({"features": [{"name": "a", "triangles": [0], "as_cast": false, "minimum": null, "scale": 2},
                       {"name": "b", "box": [[0, 0, 0], [1, 1, 1]], "as_cast": true},
                       {"name": "c", "label": "d"}, {"name": "f", "colour": "#FF80a0"}, {"name": "e", "patch": [0, 0, 0]}],
          "datums": [{"name": "a", "feature": "a", "point": [0, 0, 0], "within": 0.1},
                     {"name": "b", "points": [[0, 0, 0]], "axis": {"along": [0, 0, 1], "through": [0, 0, 0]},
                      "within": 0.1}]})"};
  for (const char* name : {"features", "datums", "maxima", "finished", "targets"})
    texts.push_back(disk::read_file(cases::source_dir() + "/examples/solid/" + name + ".json").value());
  for (const std::string& text : texts) EXPECT_TRUE(is_read(text)) << text;
  const auto said = cases::schema_verdicts(kSchema, texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(said[i], "ok") << texts[i];
}

TEST(SolidFeaturesSchema, RefusesWhatTheReaderRefuses) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts{R"({"units": "ft"})", R"({"minimum": -1})", R"({"criterion": "even"})",
                                 R"({"as_cast": true, "minimum": 1})", R"({"as_cast": 1})"};
  for (const char* feature :
       {R"("minimum": 1)", R"("triangles": [0], "label": "x")", R"("triangles": [-1])",
        R"("box": [[0, 0, 0]])", R"("plane": {"normal": [0, 0, 1], "at": 0})",
        R"("triangles": [0], "scale": 0)", R"("triangles": [0], "as_cast": true, "scale": 1)",
        R"("triangles": [0], "as_cast": 1)", R"("triangles": [0], "target": -1)", R"("colour": "red")",
        R"("colour": "#ff80a")", R"("triangles": [0], "finished": 1, "target": 1)",
        R"("triangles": [0], "as_cast": true, "target": 1)"})
    texts.push_back(std::string(R"({"features": [{"name": "a", )") + feature + "}]}");
  for (
      const char* datum :
      {R"("feature": "a", "point": [0, 0, 0])", R"("feature": "a", "point": [0, 0, 0], "within": 0)",
       R"("point": [0, 0, 0], "within": 1)", R"("feature": "a", "within": 1)",
       R"("feature": "a", "points": [[0, 0, 0]], "point": [0, 0, 0], "within": 1)",
       R"("points": [], "point": [0, 0, 0], "within": 1)",
       R"("points": [[0, 0]], "point": [0, 0, 0], "within": 1)",
       R"("feature": "a", "point": [0, 0, 0], "axis": {"along": [0, 0, 1], "through": [0, 0, 0]}, "within": 1)",
       R"("feature": "a", "plane": {"normal": [0, 0, 1], "at": 0}, "within": 1)",
       R"("feature": "a", "axis": {"along": [0, 0, 1]}, "within": 1)"})
    texts.push_back(std::string(R"({"datums": [{"name": "a", )") + datum + "}]}");
  for (const std::string& text : texts) EXPECT_FALSE(is_read(text)) << text;
  const auto said = cases::schema_verdicts(kSchema, texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_NE(said[i], "ok") << texts[i];
}

}  // namespace
}  // namespace lekalo::io::io_solid_features_test
