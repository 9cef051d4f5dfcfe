// The published schema of rates accepts the example, and refuses what the reader refuses.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/rates_file.hpp"
#include "support/json.hpp"
#include "support/places.hpp"
#include "support/schemas.hpp"

namespace lekalo::io::io_rates_test {
namespace {

using cases::Json;

Json example() {
  return Json::parse(disk::read_file(cases::source_dir() + "/examples/rates/shop.json").value());
}
struct Change {
  const char *place, *value;  ///< without a value the field is taken away
};
std::string text_of(const Change& change) {
  Json json = example();
  const std::string place = change.place;
  const std::size_t last = place.rfind('/');
  Json& object = last == 0 ? json : json.at(place.substr(0, last));
  if (change.value == nullptr)
    object.erase(place.substr(last + 1));
  else
    object[place.substr(last + 1)] = Json::parse(change.value);
  return json.dump();
}

void expect_both(const std::vector<Change>& changes, bool fine) {
  ASSERT_NE(cases::python_with_jsonschema(), "")
      << "python3-jsonschema is not installed (tools/setup.sh installs it)";
  std::vector<std::string> texts;
  for (const Change& change : changes) texts.push_back(text_of(change));
  const auto said = cases::schema_verdicts("lekalo-rates-1.schema.json", texts);
  ASSERT_EQ(said.size(), texts.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(read_rates(texts[i], "r.json").has_value(), fine) << texts[i];
    EXPECT_EQ(said[i] == "ok", fine) << said[i] << texts[i];
  }
}

TEST(RatesSchema, AcceptsTheExampleAndWhatMayBeLeftOut) {
  expect_both({{"/decimals", "2"},
               {"/decimals", nullptr},
               {"/issuer", nullptr},
               {"/machine/settle_s", nullptr},
               {"/machine/junctions", "\"exact stop\""},
               {"/machine/rapid_mm_per_min", "5000"},
               {"/rates/per_pierce", nullptr},
               {"/tax_percent", nullptr},
               {"/materials/0/remnant_percent", nullptr},
               {"/materials/1/least_remnant_mm", nullptr}},
              true);
}

TEST(RatesSchema, RefusesWhatTheReaderRefuses) {
  expect_both({{"/format", "\"lekalo-rates/2\""},
               {"/currency", nullptr},
               {"/currency", "\"eur\""},
               {"/decimals", "5"},
               {"/decimals", "1.5"},
               {"/discount", "3"},
               {"/issuer", "[\"\"]"},
               {"/terms", "\"cash\""},
               {"/machine", nullptr},
               {"/machine/rapid_mm_per_min", nullptr},
               {"/machine/rapid_mm_per_min", "0"},
               {"/machine/acceleration_mm_per_s2", "[1, 2]"},
               {"/machine/junctions", "\"smooth\""},
               {"/machine/junctions", "\"junction deviation\""},
               {"/machine/junction_deviation_mm", "0.01"},
               {"/machine/settle_s", "-1"},
               {"/machine/jerk", "5"},
               {"/rates/per_hour", nullptr},
               {"/rates/per_hour", "-1"},
               {"/rates/per_m_cut", "\"0.1\""},
               {"/rates/per_kg", "1"},
               {"/margin_percent", "-5"},
               {"/tax_percent", "1001"},
               {"/materials", "[]"},
               {"/materials/0/sheet_mm", nullptr},
               {"/materials/0/sheet_mm", "[1250]"},
               {"/materials/0/least_remnant_mm", nullptr},
               {"/materials/0/per_m2", "1"},
               {"/materials/1/per_m2", nullptr},
               {"/materials/1/sheet_mm", "[1, 2]"},
               {"/materials/1/remnant_percent", "5"},
               {"/materials/1/material", "\"\""},
               {"/materials/1/thickness_mm", nullptr}},
              false);
}

}  // namespace
}  // namespace lekalo::io::io_rates_test
