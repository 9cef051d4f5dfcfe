#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "e2e/cli_run.hpp"
#include "support/layout_texts.hpp"

namespace lekalo::test::cli_quote_test {
namespace {

std::string drawing(int side, const std::string& more = "") {
  const std::string s = std::to_string(side);
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + s + "mm' height='" + s + "mm' viewBox='0 0 " +
         s + " " + s + "'><rect width='" + s + "' height='" + s + "'/>" + more + "</svg>";
}

const Words kCut{"--kerf", "0.2", "--feed", "3000", "--lead-in", "2", "--pierce", "0.3"};

/// A layout of two parts on a sheet of steel, and the rates of the examples.
struct QuoteShop : TemporaryFolder {
  QuoteShop() {
    write_bytes(*this / "plate.svg", drawing(60, "<circle cx='30' cy='30' r='10'/>"));
    write_bytes(*this / "lid.svg", drawing(25));
    write_bytes(
        *this / "order.csv",
        "file,quantity,material,thickness,customer,due,label\nplate.svg,3,steel,2,Orlova,2026-12-01,7\n"
        "lid.svg,4,steel,2,=Petrov,,\n");
    fs::copy(cases::source_dir() + "/examples/rates/shop.json", *this / "rates.json");
    const Ran nested = (*this)({"nest", "--order", "order.csv", "--sheet", "400x300@steel:2", "--gap", "4",
                                "--work", "2000", "-o", "layout.json"});
    EXPECT_EQ(nested.status, 0) << nested.err;
  }
  [[nodiscard]] Ran operator()(const Words& words) const { return run(path(), words); }
  [[nodiscard]] Ran quote(const Words& more = {}) const {
    return (*this)(Words{"quote", "layout.json", "--rates", "rates.json"} + kCut + more);
  }
  /// The answer to rates with another value at a place; "null" takes it away.
  [[nodiscard]] Ran with_rates(const std::string& place, const std::string& value) const {
    Json json = Json::parse(read_bytes(*this / "rates.json"));
    const std::size_t last = place.rfind('/');
    Json& object = last == 0 ? json : json.at(place.substr(0, last));
    if (value == "null")
      object.erase(place.substr(last + 1));
    else
      object[place.substr(last + 1)] = Json::parse(value);
    write_bytes(*this / "other.json", json.dump());
    return (*this)(Words{"quote", "layout.json", "--rates", "other.json", "-o", "q.csv"} + kCut);
  }
  [[nodiscard]] Ran reckoned(const std::string& csv, const std::string& decimals) const {
    const std::string command = "/usr/bin/python3 -B '" + cases::source_dir() +
                                "/tests/support/quote_sums.py' '" + (*this / csv).string() + "' " + decimals +
                                " > '" + (*this / "said.txt").string() + "'";
    return {std::system(command.c_str()), read_bytes(*this / "said.txt"), ""};
  }
};

TEST(CliQuote, TheTableIsWhatASpreadsheetMakesOfItsFactorsToTheCent) {
  const QuoteShop shop;
  ASSERT_EQ(shop.quote({"-o", "q.csv", "-o", "q.pdf"}).status, 0);
  const Ran sums = shop.reckoned("q.csv", "2");
  EXPECT_EQ(sums.status, 0) << sums.out;
  EXPECT_NE(sums.out.find("10 lines"), std::string::npos) << sums.out;
  EXPECT_EQ(read_bytes(shop / "q.pdf").substr(0, 4), "%PDF");
  // Without a file the table goes to standard output, in the same bytes.
  EXPECT_EQ(shop.quote().out, read_bytes(shop / "q.csv"));
  // Whatever the decimals of the currency are.
  for (const char* const decimals : {"0", "1", "3", "4"}) {
    const Ran ran = shop.with_rates("/decimals", decimals);
    ASSERT_EQ(ran.status, 0);
    EXPECT_EQ(ran.err.find("rounding line by line makes the sum") != std::string::npos, *decimals == '0')
        << ran.err;
    const Ran again = shop.reckoned("q.csv", decimals);
    EXPECT_EQ(again.status, 0) << decimals << ": " << again.out;
  }
  EXPECT_NE(read_bytes(shop / "q.csv").find(",'=Petrov,"), std::string::npos);
}

TEST(CliQuote, FiguresAreThoseOfTheProgramsAndVerifyReckonsThemAgain) {
  const QuoteShop shop;
  const Ran quoted = shop.quote({"--json", "--gcode", "cut.nc"});
  ASSERT_EQ(quoted.status, 0) << quoted.err;
  const Json json = quoted.json();
  ASSERT_EQ(json["sheets"].size(), 1u);
  const Json& sheet = json["sheets"][0];
  EXPECT_EQ(sheet["pieces"], 7);
  EXPECT_EQ(sheet["pierces"], 10);  // three plates with a hole, four lids
  EXPECT_EQ(sheet["pierce_s"], "3.000");
  EXPECT_EQ(sheet["setup_s"], "1140.000");
  ASSERT_EQ(json["parts"].size(), 2u);
  EXPECT_EQ(json["parts"][0]["pierces"], 6);
  EXPECT_EQ(json["parts"][0]["customer"], "Orlova");
  EXPECT_EQ(json["orders"].size(), 2u);
  // The program is the one that an export writes.
  ASSERT_EQ(shop(Words{"export", "layout.json", "--format", "gcode", "-o", "other.nc"} + kCut).status, 0);
  EXPECT_EQ(read_bytes(shop / "cut.nc"), read_bytes(shop / "other.nc"));
  // A plate is cut along 4 x 60 mm and a circle of 20, with leads of 2; corners add a little.
  const double plate = std::stod(json["parts"][0]["cut_mm"].get<std::string>()) / 3;
  EXPECT_NEAR(plate, 240 + 20 * 3.14159 + 4, 1);

  write_bytes(shop / "q.json", quoted.out);
  const Ran verified = shop({"verify", "q.json"});
  EXPECT_EQ(verified.status, 1) << verified.err;
  EXPECT_NE(verified.err.find("seconds: they are those of a model"), std::string::npos) << verified.err;
  std::string lie = quoted.out;
  const std::string total = json["total"].get<std::string>();
  lie.replace(lie.find(total, lie.find("\"total\"")), total.size(), "1.00");
  write_bytes(shop / "q.json", lie);
  const Ran refuted = shop({"verify", "q.json"});
  EXPECT_EQ(refuted.status, 4);
  EXPECT_NE(refuted.err.find("total is not what follows from the lines"), std::string::npos) << refuted.err;
}

TEST(CliQuote, ACutThatPlacementsHaveInCommonIsSharedOut) {
  const QuoteShop shop;
  Json layout = cases::empty_layout();
  for (const char* part : {"a", "b"})
    cases::add_part(layout, part, cases::outline_json(cases::rectangle(0, 0, 30, 20)));
  cases::place(layout, "a", 10, 10);
  cases::place(layout, "b", 40.2, 10);
  write_bytes(shop / "pair.json", layout.dump());
  const auto quoted = [&](const Words& more) {
    const Ran ran = shop(Words{"quote", "pair.json", "--rates", "rates.json", "--material", "steel",
                               "--thickness", "2", "--json"} +
                         kCut + more);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran;
  };
  const Ran shared = quoted({"--common-line"});
  write_bytes(shop / "q.json", shared.out);
  const Json apart = quoted({}).json(), json = shared.json();
  const auto cut = [](const Json& quote, int part) {
    return std::stod(quote["parts"][part]["cut_mm"].get<std::string>());
  };
  EXPECT_NEAR(cut(json, 0), cut(json, 1), 1e-3);
  EXPECT_NEAR(cut(json, 0) + cut(json, 1), cut(apart, 0) + cut(apart, 1) - 20, 2);
  EXPECT_EQ(json["sheets"][0]["pierces"], 2);
  EXPECT_EQ(shop({"verify", "q.json"}).status, 1) << "seconds are those of a model";
}

TEST(CliQuote, AnOrderIsQuotedWithAllItsLayoutsEachByTheProcessOfItsMaterial) {
  const QuoteShop shop;
  write_bytes(shop / "order.csv",
              "file,quantity,material,thickness\nplate.svg,3,steel,2\nlid.svg,4,plywood,12\n");
  const Ran nested = shop({"nest", "--order", "order.csv", "--sheet", "400x300@steel:2", "--sheet",
                           "300x200@plywood:12", "--gap", "8", "--work", "2000", "-o", "out.json", "--json"});
  ASSERT_EQ(nested.status, 0) << nested.err;
  write_bytes(shop / "order.json", nested.out);
  Json rates = Json::parse(read_bytes(shop / "rates.json"));
  rates["materials"] = Json::parse(R"([{"material": "steel", "thickness_mm": 2, "per_m2": 30},
      {"material": "plywood", "thickness_mm": 12, "per_sheet": 9.99, "sheet_mm": [300, 200]}])");
  write_bytes(shop / "rates.json", rates.dump());
  const Ran quoted = shop({"quote", "order.json", "--rates", "rates.json", "--processes",
                           cases::source_dir() + "/examples/processes/shop.json", "--json"});
  ASSERT_EQ(quoted.status, 0) << quoted.err;
  const Json json = quoted.json();
  ASSERT_EQ(json["sheets"].size(), 2u);
  EXPECT_EQ(json["sheets"][1]["material"], "plywood");
  EXPECT_EQ(json["sheets"][1]["pierces"], 4);
  EXPECT_NE(quoted.err.find("plywood, 12 mm (router)"), std::string::npos) << quoted.err;
  EXPECT_NE(quoted.err.find("steel, 2 mm (laser)"), std::string::npos) << quoted.err;
  write_bytes(shop / "q.json", quoted.out);
  EXPECT_EQ(shop({"verify", "q.json"}).status, 1);
}

TEST(CliQuote, OneSentenceSaysWhatIsWrongAndNothingIsWritten) {
  const QuoteShop shop;
  const auto expect = [&](const Ran& ran, int status, const std::string& says) {
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_FALSE(fs::exists(shop / "q.csv"));
  };
  expect(shop.with_rates("/currency", "null"), 3, "other.json: currency is missing");
  expect(shop.with_rates("/rates", "null"), 3, "other.json: rates is missing");
  expect(shop.with_rates("/rates/per_hour", "-3"), 3, "rates: per_hour -3: has to be a number from 0");
  expect(shop.with_rates("/rates/per_gas", "3"), 3, "rates: there is no key 'per_gas'; known are");
  expect(shop.with_rates("/machine/junctions", "\"fast\""), 3, "machine: junctions has to be one of");
  expect(shop.with_rates("/materials/1/material", "\"brass\""), 3,
         "there is no rate for steel, 2 mm, sheets of 400 x 300 mm; there are: ");
  expect(shop.with_rates("/tax_percent", "19.1234567"), 3,
         "tax_percent 19.1234567: has to have at most six decimals");
  const Words out{"-o", "q.csv"};
  expect(shop(Words{"quote", "layout.json", "--rates", "none.json"} + kCut + out), 3, "none.json");
  expect(shop(Words{"quote", "layout.json", "--rates", "layout.json"} + kCut + out), 3,
         "this is no file of rates");
  expect(shop(Words{"quote", "layout.json"} + kCut + out), 2, "--rates is required");
  expect(shop({"quote", "layout.json", "--rates", "rates.json", "-o", "q.csv"}), 2, "--kerf is missing");
  expect(shop.quote({"-o", "q.txt"}), 2, "the name has to end in .pdf or .csv");
  expect(shop.quote({"-o", "q.csv", "-o", "r.csv"}), 2, "one csv is written");
  expect(shop.quote({"-o", "q.csv", "--thickness", "thick"}), 2, "--thickness");
  expect(shop.quote({"-o", "q.csv", "--sheet", "x"}), 2, "--sheet");
  expect(shop(Words{"quote", "plate.svg", "--rates", "rates.json"} + kCut + out), 3,
         "nothing is placed, so there is nothing to quote");
  // A layout that does not say its material.
  ASSERT_EQ(shop({"nest", "plate.svg", "--sheet", "400x300", "--work", "100", "-o", "bare.json"}).status, 0);
  const Words bare = Words{"quote", "bare.json", "--rates", "rates.json"} + kCut;
  expect(shop(bare + out), 2,
         "says neither material nor thickness, so nobody knows its rate: say --material NAME and --thickness "
         "MM");
  expect(shop(bare + Words{"--material", "steel"} + out), 2,
         "says no thickness, so nobody knows its rate: say --thickness MM");
  EXPECT_EQ(shop(bare + Words{"--material", "steel", "--thickness", "2"}).status, 0);
}

}  // namespace
}  // namespace lekalo::test::cli_quote_test
