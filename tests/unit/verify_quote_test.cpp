#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/jobs/quote.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/json.hpp"

namespace lekalo::verify::verify_quote_test {
namespace {

using cases::Json;

std::string box(double width, double height, const std::string& holes = "") {
  return fmt::format(
      R"({{"polygon": {{"outer": [[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]], "holes": [{2}]}}}})", width,
      height, holes);
}

std::string placed(int id, const char* part, const char* stock, int copy, int x) {
  return fmt::format(R"({{"id": {}, "part": "{}", "stock": "{}", "copy": {}, "c": 1, "s": 0, "x": {}, "y": 5,
                          "mirrored": false, "locked": false}})",
                     id, part, stock, copy, x);
}

std::string layout(const std::string& stocks, const std::string& parts, const std::string& placements) {
  return fmt::format(R"({{"format": "lekalo-layout/1", "units": "mm", "name": "n", "rules": {{"gap": 3,
      "border_gap": 2, "defect_gap": 1, "kerf": 0.2}}, "stocks": [{}], "parts": [{}], "kits": [],
      "placements": [{}], "next_id": 99}})",
                     stocks, parts, placements);
}

/// Sheets whose area is above 2^62 half square steps, a strip that says no material, and four parts, one of
/// which is not placed and one of which has a hole.
std::string steel() {
  const std::string purpose = R"("customer": "Orlova", "due": "2026-12-01", "label": "7")";
  return layout(
      fmt::format(R"({{"id": "steel", "kind": "sheet", "count": 3, "material": "steel", "thickness": 2,
                       "cost": 1, "outline": {}}},
                     {{"id": "roll", "kind": "strip", "height": 50, "length": 200, "cost": 1}})",
                  box(2000, 1500)),
      fmt::format(R"({{"id": "plate", "name": "Plate", {0}, "outline": {1}, "demand": 2}},
                     {{"id": "lid", "customer": "Petrov", "outline": {2}, "demand": 3}},
                     {{"id": "spare", "customer": "Nobody", "outline": {2}, "demand": 0}},
                     {{"id": "cap", {0}, "outline": {3}, "demand": 1}})",
                  purpose, box(20, 20, "[[6, 6], [13, 6], [13, 13], [6, 13]]"), box(10, 10), box(12, 10)),
      placed(1, "plate", "steel", 0, 5) + "," + placed(2, "lid", "steel", 0, 30) + "," +
          placed(3, "lid", "steel", 0, 45) + "," + placed(4, "cap", "steel", 1, 5) + "," +
          placed(5, "plate", "roll", 0, 5) + "," + placed(6, "lid", "roll", 0, 60));
}

/// A sheet that is paid by the sheet, and a hide that is paid by its area.
std::string birch() {
  return layout(
      fmt::format(R"({{"id": "board", "kind": "sheet", "count": 1, "material": "birch", "thickness": 9,
                       "cost": 1, "outline": {}}},
                     {{"id": "hide", "kind": "hide", "count": 1, "material": "birch", "thickness": 9, "cost": 1,
                       "outline": {{"polygon": {{"outer": [[0, 0], [90, 0], [90, 30], [40, 30], [40, 70],
                                                           [0, 70]], "holes": []}}}}}})",
                  box(60, 40)),
      fmt::format(R"({{"id": "tag", "customer": "Petrov", "outline": {}, "demand": 2}})", box(10, 10)),
      placed(1, "tag", "board", 0, 5) + "," + placed(2, "tag", "hide", 0, 5));
}

/// Sides of the board are those of the third price for it, to the half millimetre that they may be off; the
/// strip has the sides of the first price, and is paid by its area.
constexpr const char* kRates = R"({"format": "lekalo-rates/1", "currency": "EUR", "decimals": 2,
  "machine": {"rapid_mm_per_min": [30000, 30000, 6000], "acceleration_mm_per_s2": [3000, 2500, 500],
              "junctions": "exact path", "settle_s": 0.01, "setup_s_once": 900, "setup_s_per_sheet": 240},
  "rates": {"per_hour": 85, "setup_per_hour": 48, "per_pierce": 0.02, "per_m_cut": 0.14},
  "margin_percent": 12.5, "tax_percent": 19,
  "materials": [
    {"material": "steel", "thickness_mm": 2, "per_m2": 29.8, "least_remnant_mm": 20},
    {"material": "steel", "thickness_mm": 2, "per_sheet": 3, "sheet_mm": [200, 50]},
    {"material": "birch", "thickness_mm": 9, "per_sheet": 7, "sheet_mm": [40, 100]},
    {"material": "birch", "thickness_mm": 9, "per_sheet": 8, "sheet_mm": [10, 60]},
    {"material": "birch", "thickness_mm": 9, "per_sheet": 41.5, "sheet_mm": [60.5, 39.5],
     "remnant_percent": 60, "least_remnant_mm": 20},
    {"material": "birch", "thickness_mm": 9, "per_m2": 19.9}]})";

/// Another value at a place in one of the files: `quote`, `steel`, `birch`, `rates`, or `program/3` for the
/// text of a program. A place that ends in + is behind a list's last item; without a value it is taken away.
struct Edit {
  std::string place;
  std::string value;
};
using Edits = std::vector<Edit>;

/// The files of a quote.
struct Shop {
  std::map<std::string, Json> files{
      {"steel", Json::parse(steel())}, {"birch", Json::parse(birch())}, {"rates", Json::parse(kRates)}};
  std::map<std::string, std::string> bytes{
      {"none.json", "{}"}, {"broken.json", "{"}, {"drawing.dxf", "0\nSECTION\n"}};

  void change(const Edits& edits) {
    std::set<std::string> changed;
    for (const auto& [place, value] : edits) {
      const std::size_t first = place.find('/'), last = place.rfind('/');
      const std::string file = place.substr(0, first), key = place.substr(last + 1);
      if (file == "program") {
        bytes.at("cut-" + key + ".nc") = value;
        continue;
      }
      Json& of = files.at(file);
      changed.insert(file);
      Json& parent = last == first ? of : of.at(place.substr(first, last - first));
      if (key == "+")
        parent.push_back(Json::parse(value));
      else if (parent.is_array() && value.empty())
        parent.erase(std::stoul(key));
      else if (parent.is_array())
        parent[std::stoul(key)] = Json::parse(value);
      else if (value.empty())
        parent.erase(key);
      else
        parent[key] = Json::parse(value);
    }
    for (const std::string& file : changed) bytes[file + ".json"] = files.at(file).dump();
  }

  /// Makes the quote of the layouts by the rates.
  void quote(bool is_router, bool with_programs) {
    jobs::QuoteOptions options;
    options.rates = {"rates.json", files.at("rates").dump()};
    options.material = "steel", options.thickness_mm = 2;
    options.words = {{"kerf", "0.2"}, {"feed", "3000"}, {"pierce", "0.3"}};
    if (is_router)
      options.words = {{"kerf", "2"}, {"feed", "3000"},  {"process", "router"}, {"depth", "4"},
                       {"pass", "3"}, {"plunge", "200"}, {"speed", "9000"}};
    std::vector<jobs::Layout> layouts;
    for (const char* const name : {"steel", "birch"})
      layouts.push_back(jobs::open_layout({std::string(name) + ".json", files.at(name).dump()}).value());
    const auto made = jobs::quote(layouts, options);
    if (!made) throw std::logic_error("test input: " + made.error().message);
    std::vector<std::string> names;
    for (const jobs::QuoteSheet& sheet : made->sheets) {
      if (!with_programs) break;
      names.push_back(fmt::format("cut-{}.nc", names.size()));
      bytes[names.back()] = sheet.program;
    }
    files["quote"] = Json::parse(jobs::quote_json(*made, layouts, options, names));
    for (const auto& [name, json] : files) bytes[name + ".json"] = json.dump();
  }

  [[nodiscard]] Result<ClaimReport> verified() const {
    const Document report{"quote.json", bytes.at("quote.json")};
    LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
    std::vector<Document> documents;
    for (const NamedFile& file : names) documents.push_back({file.path, bytes.at(file.path)});
    return verify_quote_report(report, documents);
  }
  /// The findings of the checker, or its error; a line each.
  [[nodiscard]] std::string told() const {
    const auto report = verified();
    if (!report) return "error: " + report.error().message + "\n";
    std::string all;
    for (const std::string& finding : report->findings) all += finding + "\n";
    for (const std::string& open : report->unchecked)
      if (open.find("all of the quote") == 0) all += open + "\n";
    return all;
  }
};

Shop honest(const Edits& before = {}, bool is_router = false, bool with_programs = true) {
  Shop shop;
  shop.change(before);
  shop.quote(is_router, with_programs);
  return shop;
}

TEST(VerifyQuote, HonestQuotesOfAllKindsHaveNoFindings) {
  const std::vector<Edits> kinds{
      {},
      {{"rates/decimals", "0"}},
      {{"rates/decimals", "4"}},
      {{"rates/decimals", ""}, {"rates/margin_percent", ""}, {"rates/tax_percent", ""}},
      {{"rates/rates/setup_per_hour", ""}, {"rates/rates/per_pierce", ""}},
      {{"rates/rates/per_m_cut", ""}},
      {{"rates/rates/per_hour", "0"}, {"rates/machine/setup_s_once", ""}},
      {{"rates/machine/setup_s_per_sheet", ""}},
      {{"rates/materials/0/per_m2", "0"}},
      {{"rates/materials/4/remnant_percent", ""}},
      {{"rates/materials/4/least_remnant_mm", ""}, {"rates/materials/4/remnant_percent", ""}},
      // The strip keeps what is left beside its parts, and nothing of what lies behind them.
      {{"rates/materials/0/least_remnant_mm", "8"}},
      {{"rates/materials/0/least_remnant_mm", ""}},
      {{"steel/stocks/1/length", ""}},
      {{"steel/stocks/0/thickness", ""}}};
  for (std::size_t i = 0; i < kinds.size(); ++i)
    for (const bool is_router : {false, true}) {
      if (is_router && i > 0) continue;
      EXPECT_EQ(honest(kinds[i], is_router, i % 2 == 0).told(), "") << i << is_router;
    }
  Shop shop = honest();
  shop.change({{"quote/inputs/+", R"({"role": "processes", "path": "none.json", "sha256": ""})"}});
  EXPECT_EQ(shop.told(), "");
}

/// What lies behind the last part of a strip is not charged. It was taken off all the same, so that amounts
/// were below 0; and where it was small the checker believed in it.
TEST(VerifyQuote, NothingIsPaidBackForWhatLiesBehindTheLengthUsedOfAStrip) {
  const Edits is_open{{"steel/stocks/1/length", ""}};
  const Json with_length = honest().files.at("quote"), open = honest(is_open).files.at("quote");
  EXPECT_EQ(with_length["lines"], open["lines"]);
  EXPECT_EQ(with_length["sheets"][2]["remnant"], open["sheets"][2]["remnant"]);
  EXPECT_EQ(open["sheets"][2]["remnant"][2], 60);
  EXPECT_EQ(honest().told(), "");
}

/// What is said beside findings.
TEST(VerifyQuote, SaysWhatWasNotRechecked) {
  const auto with = honest().verified(), without = honest({}, false, false).verified();
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->notes, std::vector<std::string>{"35 lines of 4 parts on 5 sheets were reckoned again"});
  EXPECT_EQ(with->unchecked.size(), 2U);
  EXPECT_EQ(with->unchecked[0], "travel_mm, and cut_mm by part: only cut_mm of sheets is rechecked");
  EXPECT_EQ(without->unchecked[0],
            "cut_mm, travel_mm, pierces beyond the contours: the programs were not written (--gcode)");
}

/// Calls see(path, value) for every value that is no object or list.
void walk(const Json& json, const std::string& path,
          const std::function<void(const std::string&, const Json&)>& see) {
  if (!json.is_object() && !json.is_array()) return see(path, json);
  for (std::size_t i = 0; i < json.size(); ++i)
    walk(json.is_object() ? json[json.keys()[i]] : json[i],
         path + "/" + (json.is_object() ? json.keys()[i] : std::to_string(i)), see);
}

TEST(VerifyQuote, EveryValueIsAClaimOrSaidNotToBe) {
  const Shop shop = honest();
  const Json& quote = shop.files.at("quote");
  std::set<std::string> free;
  walk(quote, "", [&](const std::string& path, const Json& value) {
    const std::string last = path.substr(path.rfind('/') + 1);
    // The first of each kind stands for all.
    for (const char* const list : {"/sheets/", "/parts/", "/orders/"})
      if (path.find(list) == 0 && path.find(std::string(list) + "0/") != 0) return;
    if (path.find("/lines/") == 0 && path.rfind('/') != std::string("/lines/0").size()) return;
    if (path.find("/lines/") == 0 && path[7] > '4') return;
    if (path.find("/inputs") == 0 || path.find("/outputs") == 0 || path.find("/warnings") == 0) return;
    const std::string text = value.dump();
    // Another first digit of a number, or a letter more.
    std::string other = "1";
    if (text.size() > 2 && text[0] == '"' && text.find_first_not_of("\"0123456789.") == std::string::npos) {
      other = text;
      char& digit = other[1];
      digit = digit == '9' ? '8' : static_cast<char>(digit + 1);
    } else if (text[0] == '"') {
      other = text.substr(0, text.size() - 1) + "x\"";
    } else if (!value.is_null()) {
      other = Json(value.get<double>() + 1).dump();
    }
    Shop lie = shop;
    lie.change({{"quote" + path, other}});
    if (lie.told().empty()) free.insert(last);
    lie.change({{"quote" + path, ""}});
    EXPECT_NE(lie.told(), "") << path << " is missing";
  });
  EXPECT_EQ(free, (std::set<std::string>{"name", "seed", "travel_mm", "version", "work"}));
}

struct QuoteCase {
  const char* name;
  Edits edits;
  std::string told;
};
const std::vector<QuoteCase>& quote_cases() {
  static const std::vector<QuoteCase> cases{
      {"currency", {{"quote/currency", R"("USD")"}}, "currency is USD and is to be EUR\n"},
      {"decimals", {{"quote/decimals", "3"}}, "decimals is 3 and is to be 2\n"},
      {"status", {{"quote/status", R"("open")"}}, "error: quote.json: field status is not \"quoted\"\n"},
      {"rates twice",
       {{"quote/inputs/+", R"({"role": "rates", "path": "rates.json", "sha256": ""})"}},
       "error: quote.json: it names two files with the role \"rates\"\n"},
      {"no rates", {{"quote/inputs/2", ""}}, "error: quote.json: it names no file with the role \"rates\"\n"},
      {"no layout",
       {{"quote/inputs/0", ""}, {"quote/inputs/0", ""}},
       "error: quote.json: it names no file with the role \"layout\"\n"},
      {"one layout",
       {{"quote/inputs/1", ""}},
       "sheets has 5 items and is to have 3\n"
       "parts has 4 items and is to have 3\n"
       "lines[25].what: there is no such thing to pay for\n"
       "lines[26].what: there is no such thing to pay for\n"
       "lines[27].what: there is no such thing to pay for\n"
       "lines[28].what: there is no such thing to pay for\n"
       "lines[29].what: there is no such thing to pay for\n"
       "lines[30].what: there is no such thing to pay for\n"
       "lines[31].what: there is no such thing to pay for\n"
       "lines[32].what: there is no such thing to pay for\n"
       "lines[33].what: there is no such thing to pay for\n"
       "lines[34].what: there is no such thing to pay for\n"
       "setup_s of all sheets is not that of the rates\n"
       "orders[1].pieces is 5 and is to be 3\n"
       "orders[1].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"
       "it names 5 programs for 3 sheets\n"},
      {"unknown role",
       {{"quote/inputs/+", R"({"role": "nc", "path": "none.json", "sha256": ""})"}},
       "error: quote.json: it names a file with the role \"nc\"\n"},
      {"a layout that is JSON of others",
       {{"quote/inputs/0/path", R"("none.json")"}},
       "all of the quote: none.json is in a form that the checker does not read\n"},
      {"a layout that is no JSON",
       {{"quote/inputs/1/path", R"("broken.json")"}},
       "all of the quote: broken.json is in a form that the checker does not read\n"},
      {"a layout that is a drawing",
       {{"quote/inputs/0/path", R"("drawing.dxf")"}},
       "all of the quote: drawing.dxf is in a form that the checker does not read\n"},
      {"a layout that is a quote",
       {{"quote/inputs/0/path", R"("quote.json")"}},
       "all of the quote: quote.json is in a form that the checker does not read\n"},
      {"rates of five decimals", {{"rates/decimals", "5"}}, "error: rates.json: field decimals is above 4\n"},
      {"three sides",
       {{"rates/materials/4/sheet_mm", "[60.5, 39.5, 1]"}},
       "error: rates.json: field materials[4].sheet_mm has not 2 numbers\n"},
      {"one side",
       {{"rates/materials/4/sheet_mm", "[60.5]"}},
       "error: rates.json: field materials[4].sheet_mm has not 2 numbers\n"},
      {"thick as nothing",
       {{"rates/materials/4/thickness_mm", "2e6"}},
       "error: rates.json: field materials[4].thickness_mm is above 1e6\n"},
      {"material of a sheet",
       {{"quote/sheets/0/material", R"("iron")"}},
       "sheets[0].material is not that of the stock\n"
       "sheets[0].material: there is no rate for it\n"
       "lines[4].rate is not that of the rates\n"
       "lines[9].rate is not that of the rates\n"},
      {"thickness of a sheet",
       {{"quote/sheets/0/thickness", "3"}},
       "sheets[0].thickness is not that of the stock\n"
       "sheets[0].material: there is no rate for it\n"
       "lines[4].rate is not that of the rates\n"
       "lines[9].rate is not that of the rates\n"},
      {"both of a sheet, with a rate",
       {{"quote/sheets/0/material", R"("birch")"}, {"quote/sheets/0/thickness", "9"}},
       "sheets[0].material is not that of the stock\n"
       "sheets[0].thickness is not that of the stock\n"
       "sheets[0].remnant is too small for a remnant by the rates\n"
       "lines[4].rate is not that of the rates\n"
       "lines[9].rate is not that of the rates\n"},
      {"material of a strip that says none",
       {{"quote/sheets/2/material", R"("iron")"}},
       "sheets[2].material: there is no rate for it\n"
       "lines[19].rate is not that of the rates\n"
       "lines[24].rate is not that of the rates\n"},
      {"thickness of a strip that says none",
       {{"quote/sheets/2/thickness", "3"}},
       "sheets[2].material: there is no rate for it\n"
       "lines[19].rate is not that of the rates\n"
       "lines[24].rate is not that of the rates\n"},
      {"no rate by area",
       {{"rates/materials/5", ""}},
       "sheets[4].material: there is no rate for it\n"
       "lines[34].rate is not that of the rates\n"},
      {"no rate of birch",
       {{"rates/materials/2", ""},
        {"rates/materials/2", ""},
        {"rates/materials/2", ""},
        {"rates/materials/2", ""}},
       "sheets[3].material: there is no rate for it\n"
       "sheets[4].material: there is no rate for it\n"
       "lines[29].unit is not its unit\n"
       "lines[29].rate is not that of the rates\n"
       "lines[34].rate is not that of the rates\n"},
      {"longer by more than half",
       {{"rates/materials/4/sheet_mm", "[60.5625, 39.5]"}},
       "sheets[3].remnant is too small for a remnant by the rates\n"
       "lines[29].unit is not its unit\n"
       "lines[29].rate is not that of the rates\n"
       "sheets[3]: its lines of material are not what is charged of it\n"
       "sheets[3]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"shorter by more than half",
       {{"rates/materials/4/sheet_mm", "[60.5, 39.4375]"}},
       "sheets[3].remnant is too small for a remnant by the rates\n"
       "lines[29].unit is not its unit\n"
       "lines[29].rate is not that of the rates\n"
       "sheets[3]: its lines of material are not what is charged of it\n"
       "sheets[3]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"remnant just wide enough",
       {{"quote/sheets/1/remnant", "[17, 0, 37, 1500]"}},
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant a step too narrow",
       {{"quote/sheets/1/remnant", "[17, 0, 36.99999904632568359375, 1500]"}},
       "sheets[1].remnant is too small for a remnant by the rates\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant just high enough",
       {{"quote/sheets/1/remnant", "[17, 0, 2000, 20]"}},
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant too flat",
       {{"quote/sheets/1/remnant", "[17, 0, 2000, 19.5]"}},
       "sheets[1].remnant is too small for a remnant by the rates\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant off the grid",
       {{"quote/sheets/1/remnant", "[17.0000001, 0, 2000, 1500]"}},
       "sheets[1].remnant is no free rectangle\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant far away",
       {{"quote/sheets/1/remnant", "[17, 0, 2e6, 1500]"}},
       "sheets[1].remnant is no free rectangle\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant of three numbers",
       {{"quote/sheets/1/remnant", "[17, 0, 2000]"}},
       "sheets[1].remnant is no free rectangle\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant of five numbers",
       {{"quote/sheets/1/remnant", "[17, 0, 2000, 1500, 1]"}},
       "sheets[1].remnant is no free rectangle\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant of a part",
       {{"quote/sheets/1/remnant", "[16.5, 0, 2000, 1500]"}},
       "sheets[1].remnant is no free rectangle\n"
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant none",
       {{"quote/sheets/1/remnant", "null"}},
       "sheets[1]: its lines of material are not what is charged of it\n"
       "sheets[1]: the share of the part \"cap\" in its material is not that of its area\n"},
      {"remnant where none is kept",
       {{"quote/sheets/4/remnant", "[15, 0, 90, 30]"}},
       "sheets[4].remnant is too small for a remnant by the rates\n"
       "sheets[4]: its lines of material are not what is charged of it\n"
       "sheets[4]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"remnant beyond a hide",
       {{"quote/sheets/4/remnant", "[40, 0, 90, 31]"}},
       "sheets[4].remnant is no free rectangle\n"},
      {"remnant in a strip",
       {{"quote/sheets/2/remnant", "[30, 15, 70, 50]"}},
       "sheets[2]: its lines of material are not what is charged of it\n"
       "sheets[2]: the share of the part \"plate\" in its material is not that of its area\n"
       "sheets[2]: the share of the part \"lid\" in its material is not that of its area\n"},
      {"remnant beyond the length used",
       {{"quote/sheets/2/remnant", "[30, 15, 70.5, 50]"}},
       "sheets[2].remnant is no free rectangle\n"
       "sheets[2]: its lines of material are not what is charged of it\n"
       "sheets[2]: the share of the part \"plate\" in its material is not that of its area\n"
       "sheets[2]: the share of the part \"lid\" in its material is not that of its area\n"},
      {"remnant behind the length used",
       {{"quote/sheets/2/remnant", "[70, 0, 110, 50]"}},
       "sheets[2].remnant is no free rectangle\n"
       "sheets[2]: its lines of material are not what is charged of it\n"
       "sheets[2]: the share of the part \"plate\" in its material is not that of its area\n"
       "sheets[2]: the share of the part \"lid\" in its material is not that of its area\n"},
      {"line of sheet 5",
       {{"quote/lines/0/sheet", "5"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of sheet 6",
       {{"quote/lines/0/sheet", "6"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of part 4",
       {{"quote/lines/0/part", "4"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of part 5",
       {{"quote/lines/0/part", "5"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of sheet 3",
       {{"quote/lines/0/sheet", "3"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of part 2",
       {{"quote/lines/0/part", "2"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of sheet 1",
       {{"quote/lines/0/sheet", "1"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of a part of the other layout",
       {{"quote/lines/29/part", "0"}},
       "lines[29].what: there is no such thing to pay for\n"
       "sheets[3].amount is not the sum of its lines\n"
       "parts[3].amount is not the sum of its lines\n"
       "sheets[3]: its lines of material are not what is charged of it\n"
       "orders[1].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of glue",
       {{"quote/lines/0/what", R"("glue")"}},
       "lines[0].what: there is no such thing to pay for\n"
       "sheets[0]: its lines of machine are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of machine are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line twice",
       {{"quote/lines/+",
         R"({"sheet": 0, "part": 0, "pieces": 1, "what": "pierces", "quantity": "2", "unit": "pierce", "rate": "0.02",
             "per": 1, "amount": "0.04"})"}},
       "lines[35].what is there twice\n"},
      {"line missing",
       {{"quote/lines/2", ""}},
       "sheets[0]: its lines of pierces are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of pierces are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"line of more pieces", {{"quote/lines/0/pieces", "2"}}, "lines[0].pieces is 2 and is to be 1\n"},
      {"unit of line 0", {{"quote/lines/0/unit", R"("kg")"}}, "lines[0].unit is not its unit\n"},
      {"unit of line 1", {{"quote/lines/1/unit", R"("kg")"}}, "lines[1].unit is not its unit\n"},
      {"unit of line 2", {{"quote/lines/2/unit", R"("kg")"}}, "lines[2].unit is not its unit\n"},
      {"unit of line 3", {{"quote/lines/3/unit", R"("kg")"}}, "lines[3].unit is not its unit\n"},
      {"unit of line 4", {{"quote/lines/4/unit", R"("kg")"}}, "lines[4].unit is not its unit\n"},
      {"unit of line 29", {{"quote/lines/29/unit", R"("kg")"}}, "lines[29].unit is not its unit\n"},
      {"unit m2 of a sheet", {{"quote/lines/29/unit", R"("m2")"}}, "lines[29].unit is not its unit\n"},
      {"unit sheet of an area", {{"quote/lines/4/unit", R"("sheet")"}}, "lines[4].unit is not its unit\n"},
      {"per of line 0", {{"quote/lines/0/per", "1"}}, "lines[0].per is 1 and is to be 3600\n"},
      {"per of line 1", {{"quote/lines/1/per", "1"}}, "lines[1].per is 1 and is to be 3600\n"},
      {"per of line 2", {{"quote/lines/2/per", "3600"}}, "lines[2].per is 3600 and is to be 1\n"},
      {"per of line 3", {{"quote/lines/3/per", "3600"}}, "lines[3].per is 3600 and is to be 1\n"},
      {"per of line 4", {{"quote/lines/4/per", "3600"}}, "lines[4].per is 3600 and is to be 1\n"},
      {"rate of line 0",
       {{"quote/lines/0/rate", R"("7")"}},
       "lines[0].rate is not that of the rates\n"
       "lines[0].amount is not quantity times rate, rounded half up\n"},
      {"rate of line 1",
       {{"quote/lines/1/rate", R"("7")"}},
       "lines[1].rate is not that of the rates\n"
       "lines[1].amount is not quantity times rate, rounded half up\n"},
      {"rate of line 2",
       {{"quote/lines/2/rate", R"("7")"}},
       "lines[2].rate is not that of the rates\n"
       "lines[2].amount is not quantity times rate, rounded half up\n"},
      {"rate of line 3",
       {{"quote/lines/3/rate", R"("7")"}},
       "lines[3].rate is not that of the rates\n"
       "lines[3].amount is not quantity times rate, rounded half up\n"},
      {"rate of line 4",
       {{"quote/lines/4/rate", R"("7")"}},
       "lines[4].rate is not that of the rates\n"
       "lines[4].amount is not quantity times rate, rounded half up\n"},
      {"rate of line 29",
       {{"quote/lines/29/rate", R"("7")"}},
       "lines[29].rate is not that of the rates\n"
       "lines[29].amount is not quantity times rate, rounded half up\n"},
      {"quantity of nothing",
       {{"quote/lines/3/quantity", R"("0")"}, {"quote/lines/3/amount", R"("0.00")"}},
       "lines[3].quantity is not above 0\n"
       "sheets[0]: its lines of cut are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of cut are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"quantity below nothing",
       {{"quote/lines/3/quantity", R"("-1")"}, {"quote/lines/3/amount", R"("-0.14")"}},
       "lines[3].quantity is not above 0\n"
       "sheets[0]: its lines of cut are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of cut are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"fewer pierces than contours",
       {{"quote/lines/2/quantity", R"("1")"}, {"quote/lines/2/amount", R"("0.02")"}},
       "lines[2].quantity: fewer pierces than contours\n"
       "sheets[0]: its lines of pierces are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of pierces are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"more pierces than contours",
       {{"quote/lines/2/quantity", R"("3")"}, {"quote/lines/2/amount", R"("0.06")"}},
       "sheets[0]: its lines of pierces are not all of it\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0]: its lines of pierces are not all of it\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "margin is not what follows from the lines\n"
       "tax is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"a cent more",
       {{"quote/lines/0/amount", R"("0.09")"}},
       "lines[0].amount is not quantity times rate, rounded half up\n"
       "sheets[0].amount is not the sum of its lines\n"
       "parts[0].amount is not the sum of its lines\n"
       "orders[0].amount is not what follows from the lines\n"
       "subtotal is not what follows from the lines\n"
       "total is not what follows from the lines\n"},
      {"fewer pierces of a part",
       {{"quote/parts/0/pierces", "3"}},
       "parts[0]: its lines of pierces are not all of it\n"
       "parts[0].pierces: fewer than contours\n"
       "pierces of sheets and of parts have not the same sum\n"},
      {"more pierces of a part",
       {{"quote/parts/0/pierces", "5"}},
       "parts[0]: its lines of pierces are not all of it\n"
       "pierces of sheets and of parts have not the same sum\n"},
      {"cut_s of sheets",
       {{"quote/sheets/0/cut_s", R"("7")"}},
       "sheets[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"cut_s of parts",
       {{"quote/parts/0/cut_s", R"("7")"}},
       "parts[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"pierce_s of sheets",
       {{"quote/sheets/0/pierce_s", R"("7")"}},
       "sheets[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"pierce_s of parts",
       {{"quote/parts/0/pierce_s", R"("7")"}},
       "parts[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"travel_s of sheets",
       {{"quote/sheets/0/travel_s", R"("7")"}},
       "sheets[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"travel_s of parts",
       {{"quote/parts/0/travel_s", R"("7")"}},
       "parts[0]: its lines of machine are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"setup_s of sheets",
       {{"quote/sheets/0/setup_s", R"("7")"}},
       "sheets[0]: its lines of set-up are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"
       "setup_s of all sheets is not that of the rates\n"},
      {"setup_s of parts",
       {{"quote/parts/0/setup_s", R"("7")"}},
       "parts[0]: its lines of set-up are not all of it\n"
       "the seconds of sheets and of parts have not the same sums\n"},
      {"cut_mm of sheets",
       {{"quote/sheets/0/cut_mm", R"("7")"}},
       "sheets[0]: its lines of cut are not all of it\n"
       "cut_mm of sheets and of parts have not the same sum\n"
       "sheets[0].cut_mm is 7 and its program cuts 189.085\n"},
      {"cut_mm of parts",
       {{"quote/parts/0/cut_mm", R"("7")"}},
       "parts[0]: its lines of cut are not all of it\n"
       "cut_mm of sheets and of parts have not the same sum\n"},
      {"amount of sheets",
       {{"quote/sheets/0/amount", R"("7")"}},
       "sheets[0].amount is not the sum of its lines\n"},
      {"amount of parts",
       {{"quote/parts/0/amount", R"("7")"}},
       "parts[0].amount is not the sum of its lines\n"},
      {"no number",
       {{"quote/sheets/0/cut_mm", R"("seven")"}},
       "error: quote.json: field sheets[0].cut_mm is no number in a text\n"},
      {"set-up of 899.993",
       {{"rates/machine/setup_s_once", "899.993"}},
       "setup_s of all sheets is not that of the rates\n"},
      {"set-up of 899.994", {{"rates/machine/setup_s_once", "899.994"}}, ""},
      {"set-up of 900.006", {{"rates/machine/setup_s_once", "900.006"}}, ""},
      {"set-up of 900.007",
       {{"rates/machine/setup_s_once", "900.007"}},
       "setup_s of all sheets is not that of the rates\n"},
      {"charge of line 34, -3",
       {{"quote/lines/34/quantity", R"("0.004297")"}},
       "sheets[4]: its lines of material are not what is charged of it\n"
       "sheets[4]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"charge of line 34, -2",
       {{"quote/lines/34/quantity", R"("0.004298")"}},
       "sheets[4]: its lines of material are not what is charged of it\n"},
      {"charge of line 34, -1", {{"quote/lines/34/quantity", R"("0.004299")"}}, ""},
      {"charge of line 34, +1", {{"quote/lines/34/quantity", R"("0.004301")"}}, ""},
      {"charge of line 34, +2",
       {{"quote/lines/34/quantity", R"("0.004302")"}},
       "sheets[4]: its lines of material are not what is charged of it\n"},
      {"charge of line 34, +3",
       {{"quote/lines/34/quantity", R"("0.004303")"}},
       "sheets[4]: its lines of material are not what is charged of it\n"
       "sheets[4]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"charge of line 29, -3",
       {{"quote/lines/29/quantity", R"("0.549999997")"}},
       "lines[29].amount is not quantity times rate, rounded half up\n"
       "sheets[3]: its lines of material are not what is charged of it\n"
       "sheets[3]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"charge of line 29, -2",
       {{"quote/lines/29/quantity", R"("0.549999998")"}},
       "lines[29].amount is not quantity times rate, rounded half up\n"
       "sheets[3]: its lines of material are not what is charged of it\n"},
      {"charge of line 29, -1",
       {{"quote/lines/29/quantity", R"("0.549999999")"}},
       "lines[29].amount is not quantity times rate, rounded half up\n"},
      {"charge of line 29, +1", {{"quote/lines/29/quantity", R"("0.550000001")"}}, ""},
      {"charge of line 29, +2",
       {{"quote/lines/29/quantity", R"("0.550000002")"}},
       "sheets[3]: its lines of material are not what is charged of it\n"},
      {"charge of line 29, +3",
       {{"quote/lines/29/quantity", R"("0.550000003")"}},
       "sheets[3]: its lines of material are not what is charged of it\n"
       "sheets[3]: the share of the part \"tag\" in its material is not that of its area\n"},
      {"shares of two parts, at the border",
       {{"quote/lines/4/quantity", R"("0.031853")"}, {"quote/lines/9/quantity", R"("0.018147")"}},
       ""},
      {"shares of two parts, beyond it",
       {{"quote/lines/4/quantity", R"("0.031854")"}, {"quote/lines/9/quantity", R"("0.018146")"}},
       "sheets[0]: the share of the part \"plate\" in its material is not that of its area\n"
       "sheets[0]: the share of the part \"lid\" in its material is not that of its area\n"},
      {"order of pieces", {{"quote/orders/0/pieces", "9"}}, "orders[0].pieces is 9 and is to be 3\n"},
      {"order of amount",
       {{"quote/orders/1/amount", R"("9")"}},
       "orders[1].amount is not what follows from the lines\n"},
      {"order of nobody",
       {{"quote/orders/0/customer", R"("Nobody")"}},
       "orders[0].customer is \"Nobody\" and is to be \"Orlova\"\n"},
      {"order missing", {{"quote/orders/1", ""}}, "orders has 1 items and is to have 2\n"},
      {"orders swapped",
       {{"quote/orders/0/label", R"("8")"}},
       "orders[0].label is \"8\" and is to be \"7\"\n"},
      {"subtotal", {{"quote/subtotal", R"("9")"}}, "subtotal is not what follows from the lines\n"},
      {"margin", {{"quote/margin", R"("9")"}}, "margin is not what follows from the lines\n"},
      {"tax", {{"quote/tax", R"("9")"}}, "tax is not what follows from the lines\n"},
      {"total", {{"quote/total", R"("9")"}}, "total is not what follows from the lines\n"},
      {"margin_percent", {{"quote/margin_percent", R"("9")"}}, "margin_percent is not that of the rates\n"},
      {"tax_percent", {{"quote/tax_percent", R"("9")"}}, "tax_percent is not that of the rates\n"},
      {"part area at the border", {{"quote/sheets/0/parts_area_mm2", "551.00000000050113"}}, ""},
      {"part area beyond the border",
       {{"quote/sheets/0/parts_area_mm2", "551.00000000050125"}},
       "sheets[0].parts_area_mm2 is 551.0000000005012 and is to be 551\n"},
      {"a part of an odd number of half square steps",
       {{"birch/parts/0/outline",
         R"({"polygon": {"outer": [[0, 0], [0.00095462799072265625, 0], [0, 0.00095462799072265625]], "holes": []}})"}},
       "sheets[3].parts_area_mm2 is 100 and is to be 4.5565730033558793e-07\n"
       "sheets[4].parts_area_mm2 is 100 and is to be 4.5565730033558793e-07\n"},
      {"a program less", {{"quote/outputs/4", ""}}, "it names 4 programs for 5 sheets\n"},
      {"the first program swapped",
       {{"quote/outputs/0/path", R"("cut-1.nc")"}},
       "sheets[0].cut_mm is 189.08499999999998 and its program cuts 44.628\n"
       "sheets[0].pierces is 4 and its program begins 1 cuts\n"},
      {"a program of nothing, at the border",
       {{"program/4", "G21 G17 G90\nG40 G49 G80 G54 G94 G91.1 G61\nM2\n"},
        {"quote/sheets/4/cut_mm", R"("0.00200000000000000005")"}},
       "sheets[4]: its lines of cut are not all of it\n"
       "cut_mm of sheets and of parts have not the same sum\n"
       "sheets[4].pierces is 1 and its program begins 0 cuts\n"},
      {"a program of nothing, beyond the border",
       {{"program/4", "G21 G17 G90\nG40 G49 G80 G54 G94 G91.1 G61\nM2\n"},
        {"quote/sheets/4/cut_mm", R"("0.0020000000000000006")"}},
       "sheets[4]: its lines of cut are not all of it\n"
       "cut_mm of sheets and of parts have not the same sum\n"
       "sheets[4].cut_mm is 0.0020000000000000005 and its program cuts 0.000\n"
       "sheets[4].pierces is 1 and its program begins 0 cuts\n"},
      {"cuts that begin beside others' ends",
       {{"program/4",
         "G21 G17 G90\nG40 G49 G80 G54 G94 G91.1 G61\nG0 X0 Y0\nM3\nG4 P0.3\nG1 X10 Y0 F3000\nM5\nG0 X10 "
         "Y5\nM3\nG4 P0.3\nG1 X20 Y5 F3000\nM5\nG0 X30 Y5\nM3\nG4 P0.3\nG1 X40 Y5 F3000\nM5\nG0 X40 "
         "Y5\nM3\nG4 P0.3\nG1 X40 Y6 F3000\nM5\nM2\n"}},
       "sheets[4].cut_mm is 40.62799999999999 and its program cuts 31.000\n"
       "sheets[4].pierces is 1 and its program begins 3 cuts\n"},
      {"a program of words of others",
       {{"program/4", "G41\n"}},
       "error: cut-4.nc:1: lekalo writes no G41 into a profile program\n"},
      {"a whole quote of one sheet less",
       {{"quote/sheets/4", ""}},
       "sheets has 4 items and is to have 5\n"
       "lines[34].rate is not that of the rates\n"
       "sheets[4]: its lines of machine are not all of it\n"
       "sheets[4]: its lines of set-up are not all of it\n"
       "sheets[4]: its lines of pierces are not all of it\n"
       "sheets[4]: its lines of cut are not all of it\n"
       "sheets[4].amount is not the sum of its lines\n"
       "the seconds of sheets and of parts have not the same sums\n"
       "cut_mm of sheets and of parts have not the same sum\n"
       "pierces of sheets and of parts have not the same sum\n"
       "setup_s of all sheets is not that of the rates\n"
       "sheets[4].cut_mm is 0 and its program cuts 40.628\n"
       "sheets[4].pierces is 0 and its program begins 1 cuts\n"},
      {"a sheet more", {{"quote/sheets/+", "{}"}}, "sheets has 6 items and is to have 5\n"},
      {"a field of others",
       {{"quote/discount", "1"}},
       "error: quote.json: field discount is not one of such a report\n"},
  };
  return cases;
}

/// Every finding of the checker is shown by a case, with one beside it that does not show it.
TEST(VerifyQuote, EachCaseIsToldInFull) {
  const Shop shop = honest();
  for (const QuoteCase& one : quote_cases()) {
    Shop lie = shop;
    lie.change(one.edits);
    EXPECT_EQ(lie.told(), one.told) << "case " << one.name;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_quote_test
