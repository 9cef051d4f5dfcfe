#include "lekalo/io/layout/rates_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/geom/grid.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

namespace lekalo::io::io_rates_file_test {
namespace {

using cases::Json;

Json example() {
  return Json::parse(disk::read_file(cases::source_dir() + "/examples/rates/shop.json").value());
}
/// The example with another value at a place, "/rates/per_hour".
Json changed(const std::string& place, const Json& value) {
  Json json = example();
  const std::size_t last = place.rfind('/');
  Json& object = last == 0 ? json : json.at(place.substr(0, last));
  object[place.substr(last + 1)] = value;
  return json;
}
Json without(const std::string& place) {
  Json json = example();
  const std::size_t last = place.rfind('/');
  Json& object = last == 0 ? json : json.at(place.substr(0, last));
  object.erase(place.substr(last + 1));
  return json;
}
std::string trouble(const Json& json) {
  const auto read = read_rates(json.dump(), "rates.json");
  if (!read) {
    EXPECT_EQ(read.error().code, ErrorCode::bad_input);
    return read.error().message;
  }
  return "none";
}
layout::Material material(const char* name, double mm) { return {name, geom::grid_from_mm(mm)}; }

TEST(RatesFile, TheExampleIsReadAsExactDecimals) {
  const auto rates = read_rates(example().dump(), "rates.json");
  ASSERT_TRUE(rates) << rates.error().message;
  EXPECT_EQ(rates->currency, "EUR");
  EXPECT_EQ(rates->decimals, 2);
  EXPECT_EQ(rates->per_hour, 85'000'000);
  EXPECT_EQ(rates->per_pierce, 20'000);
  EXPECT_EQ(rates->margin_percent, 12'500'000);
  EXPECT_EQ(rates->setup_once_ms, 900'000);
  EXPECT_EQ(rates->machine.acceleration_mm_per_s2[1], 2500);
  EXPECT_EQ(rates->machine.junctions, nc::JunctionRule::exact_path);
  ASSERT_EQ(rates->materials.size(), 4U);
  EXPECT_EQ(rates->materials[0].price, 41'500'000);
  EXPECT_EQ(rates->issuer.size(), 3U);
}

TEST(RatesFile, WhatMayBeLeftOutHasItsUsualValue) {
  Json json = example();
  for (const char* const key : {"decimals", "issuer", "terms", "margin_percent", "tax_percent"})
    json.erase(key);
  json["rates"] = {{"per_hour", 60.25}};
  json["machine"] = {
      {"rapid_mm_per_min", 9000}, {"acceleration_mm_per_s2", 800}, {"junctions", "exact stop"}};
  const auto rates = read_rates(json.dump(), "rates.json");
  ASSERT_TRUE(rates) << rates.error().message;
  EXPECT_EQ(rates->decimals, 2);
  EXPECT_EQ(rates->setup_per_hour, 60'250'000);
  EXPECT_EQ(rates->per_m_cut, 0);
  EXPECT_EQ(rates->setup_once_ms, 0);
  EXPECT_EQ(rates->machine.rapid_mm_per_min[2], 9000);
}

TEST(RatesFile, EveryFaultHasItsSentence) {
  const std::string name = "rates.json: ";
  EXPECT_EQ(trouble(Json::array()), name + "a file of rates is an object, not a list");
  EXPECT_EQ(trouble(changed("/format", "lekalo-rates/2")),
            name + "this is no file of rates: \"format\" has to be \"lekalo-rates/1\"");
  EXPECT_EQ(trouble(without("/currency")), name + "currency is missing: three capitals, for example \"EUR\"");
  EXPECT_EQ(trouble(changed("/currency", "euro")),
            name + "currency has to be three capitals, for example \"EUR\"");
  EXPECT_EQ(trouble(changed("/decimals", 2.5)), name + "decimals 2.5: has to be a whole number");
  EXPECT_EQ(trouble(changed("/decimals", 5)), name + "decimals 5: has to be a number from 0 to 4");
  EXPECT_EQ(trouble(changed("/discount", 1)),
            name +
                "there is no key 'discount'; known are format, currency, decimals, issuer, terms, machine, "
                "rates, margin_percent, tax_percent, materials");
  EXPECT_EQ(trouble(changed("/tax_percent", -1)), name + "tax_percent -1: has to be a number from 0 to 1000");
  EXPECT_EQ(trouble(changed("/margin_percent", 0.1234567)),
            name + "margin_percent 0.1234567: has to have at most six decimals");
  EXPECT_EQ(
      trouble(changed("/terms", Json::array({"a\nb"}))),
      name + "terms has to be a list of at most 12 texts of 1 to 1000 bytes without control characters");
  EXPECT_EQ(trouble(without("/rates")), name + "rates is missing: what an hour, a pierce and a metre cost");
  EXPECT_EQ(trouble(without("/rates/per_hour")), name + "rates: per_hour is missing");
  EXPECT_EQ(trouble(changed("/rates/per_hour", -85)),
            name + "rates: per_hour -85: has to be a number from 0 to 1e+09");
  EXPECT_EQ(trouble(changed("/rates/per_hour", "85")),
            name + "rates: per_hour has to be a number from 0 to 1e+09");
  EXPECT_EQ(trouble(changed("/rates/gas", 1)),
            name + "rates: there is no key 'gas'; known are per_hour, setup_per_hour, per_pierce, per_m_cut");
  EXPECT_EQ(trouble(without("/machine")), name + "machine is missing: how fast it moves");
  EXPECT_EQ(trouble(without("/machine/rapid_mm_per_min")),
            name + "machine: rapid_mm_per_min is missing: a number, or a list of X, Y and Z");
  EXPECT_EQ(trouble(changed("/machine/acceleration_mm_per_s2", Json::array({1, 2}))),
            name + "machine: acceleration_mm_per_s2 has to be a number, or a list of three: X, Y and Z");
  EXPECT_EQ(trouble(changed("/machine/acceleration_mm_per_s2", 0)),
            name + "machine: acceleration_mm_per_s2 0: has to be a number from 1 to 1e+06");
  EXPECT_EQ(
      trouble(changed("/machine/junctions", "fast")),
      name + "machine: junctions has to be one of \"exact stop\", \"exact path\", \"junction deviation\"");
  EXPECT_EQ(trouble(changed("/machine/junctions", "junction deviation")),
            name + "machine: junction_deviation_mm is missing");
  EXPECT_EQ(
      trouble(changed("/machine/junction_deviation_mm", 0.01)),
      name + "machine: junction_deviation_mm has a meaning for the junctions \"junction deviation\" alone");
  EXPECT_EQ(trouble(changed("/materials", Json::array())),
            name + "materials has to be a list of 1 to 10000 entries");
  EXPECT_EQ(trouble(without("/materials/2/per_m2")),
            name + "material 3: either per_m2 or per_sheet is needed, and not both");
  EXPECT_EQ(trouble(without("/materials/0/sheet_mm")),
            name + "material 1: sheet_mm is needed beside per_sheet: the two sides of the sheet in mm");
  EXPECT_EQ(
      trouble(without("/materials/0/least_remnant_mm")),
      name +
          "material 1: remnant_percent needs least_remnant_mm: from which shorter side on a remnant is kept");
  EXPECT_EQ(trouble(changed("/materials/1/remnant_percent", 10)),
            name + "material 2: remnant_percent has a meaning beside per_sheet alone");
  EXPECT_EQ(trouble(changed("/materials/2/thickness_mm", 2)),
            name + "material 3: steel, 2 mm is material 2 already");
}

TEST(RatesFile, AllFaultsAreToldAtOnce) {
  Json json = example();
  json.erase("currency");
  json["rates"]["per_hour"] = -1;
  json["materials"][1]["per_m2"] = "dear";
  EXPECT_EQ(trouble(json),
            "rates.json: currency is missing: three capitals, for example \"EUR\"; rates: per_hour -1: "
            "has to be a number from 0 to 1e+09; material 2: per_m2 has to be a number from 0 to 1e+09");
}

TEST(RatesFile, ASheetOfItsSizeComesBeforeTheSquareMetre) {
  const auto rates = read_rates(example().dump(), "rates.json");
  ASSERT_TRUE(rates);
  const auto price = [&](const layout::Material& of, const std::optional<PlaneSize>& size) {
    const auto found = find_rate(*rates, of, size);
    return found ? std::to_string((*found)->price) : found.error().message;
  };
  EXPECT_EQ(price(material("steel", 2), PlaneSize{1250, 1250}), "41500000");
  EXPECT_EQ(price(material("steel", 2), PlaneSize{3000, 1500}), "29800000");
  EXPECT_EQ(price(material("steel", 2), std::nullopt), "29800000");
  EXPECT_EQ(price(material("brass", 2), PlaneSize{3000, 1500}),
            "rates.json: there is no rate for brass, 2 mm, sheets of 3000 x 1500 mm; there are: steel, 2 mm, "
            "sheets of "
            "1250 x 1250 mm; steel, 2 mm; steel, 6 mm; birch plywood, 9 mm");
  EXPECT_EQ(price(material("steel", 3), std::nullopt).substr(0, 73),
            "rates.json: there is no rate for steel, 3 mm by the square metre; there a");
}

}  // namespace
}  // namespace lekalo::io::io_rates_file_test
