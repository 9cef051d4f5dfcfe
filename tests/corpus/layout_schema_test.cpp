// The published schema accepts what we write and the example file, and refuses what the reader refuses, as
// python3-jsonschema reads it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"
#include "support/layout_documents.hpp"
#include "support/places.hpp"
#include "support/schemas.hpp"

namespace lekalo::io::layout_schema_test {
namespace {

using cases::Json;

const std::string kExample = cases::source_dir() + "/tests/corpus/data/layouts/order.json";

std::vector<std::string> verdicts(const std::vector<std::string>& texts) {
  return cases::schema_verdicts("lekalo-layout-1.schema.json", texts);
}

TEST(LayoutSchema, AcceptsWhatIsWrittenAndTheExample) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts{disk::read_file(kExample).value()};
  const auto example = read_layout(texts[0], "order.json");
  ASSERT_TRUE(example.has_value()) << example.error().message;
  EXPECT_EQ(example->document.parts.size(), 2u);
  EXPECT_EQ(example->document.next_id, 9u);
  EXPECT_EQ(example->document.parts[0].outline.curves.size(), 1u);
  EXPECT_EQ(example->notices.size(), 2u);  // a field of its own, chords made
  texts.push_back(write_layout(example->document));
  for (std::uint64_t i = 0; i < 20; ++i)
    texts.push_back(write_layout(cases::random_document(cases::seed(), i)));
  const auto said = verdicts(texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(said[i], "ok") << texts[i];
}

TEST(LayoutSchema, RefusesWhatTheReaderRefuses) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  const Json example = Json::parse(disk::read_file(kExample).value());
  struct Wrong {
    const char *place, *value;
  };
  std::vector<std::string> texts;
  for (const Wrong& wrong : {Wrong{"/format", "\"lekalo-layout/2\""},
                             {"/units", "\"inch\""},
                             {"/colour", "1"},
                             {"/rules/gap", "-1"},
                             {"/stocks/0/kind", "\"roll\""},
                             {"/stocks/0/count", "2"},
                             {"/stocks/1/height", "5"},
                             {"/stocks/1/outline/polygon/outer/0", "[0, 300000]"},
                             {"/stocks/1/outline/chord_tolerance", "0.1"},
                             {"/stocks/2/defects/0/severity", "0"},
                             {"/parts/0/id", "\"\""},
                             {"/parts/0/rotations", "[]"},
                             {"/parts/0/thickness", "0"},
                             {"/parts/0/due", "\"2026-13-01\""},
                             {"/parts/0/label", "7"},
                             {"/parts/0/quality", "\"good\""},
                             {"/parts/0/grain/tolerance_deg", "91"},
                             {"/kits/0/pieces", "[]"},
                             {"/placements/0/rotation_deg", "0"},
                             {"/placements/0/x", "1e6"},
                             {"/placements/0/copy", "0.5"},
                             {"/placements/1/locked", "1"},
                             {"/next_id", "0"}}) {
    Json changed = example;
    changed.at(wrong.place) = Json::parse(wrong.value);
    texts.push_back(changed.dump());
    const auto read = read_layout(texts.back(), "wrong.json");
    EXPECT_FALSE(read.has_value()) << wrong.place;
  }
  const auto said = verdicts(texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_NE(said[i], "ok") << texts[i];
}

}  // namespace
}  // namespace lekalo::io::layout_schema_test
