// The limits of numbers (lekalo/base/limits.hpp) are one set: readers and checker take a number at its limit
// and refuse the next, with file, place and limit; the schema and docs/limits.md state the same.

#include "lekalo/base/archive_limits.hpp"
#include "lekalo/base/limits.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/text/decimal.hpp"
#include "jobs/pocket_ground.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/locate/feature_file.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/verify/layout.hpp"
#include "support/json.hpp"
#include "support/places.hpp"
#include "verify/number/exact.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::base_limits_test {
namespace {

using cases::Json;

std::string source_file(const std::string& name) {
  return disk::read_file(cases::source_dir() + "/" + name).value();
}

// ---- written numbers --------------------------------------------------------------------------------------

TEST(Limits, NumbersAreReadUpToTheLimitsByReadersAndChecker) {
  const std::string digits(limits::kMostDigits - 1, '3');
  for (const std::string& text : {"0." + digits + "1", "0.000" + digits + "1", std::string("1e-400"),
                                  std::string("0e-999999"), std::string("-1e-400")}) {
    EXPECT_TRUE(io::read_millimetres(text, LengthUnit::millimetre)) << text;
    EXPECT_FALSE(io::beyond_limits(text)) << text;
    EXPECT_TRUE(verify::parse_decimal(text)) << text;
  }
  for (const auto& [text, fault] : {std::pair{"0." + digits + "11", io::NumberFault::too_long},
                                    {std::string("9.9e-401"), io::NumberFault::too_small},
                                    {std::string("1e-500"), io::NumberFault::too_small},
                                    {std::string("-1e-999999"), io::NumberFault::too_small}}) {
    const auto read = io::read_millimetres(text, LengthUnit::inch);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error(), fault) << text;
    EXPECT_EQ(io::beyond_limits(text), fault) << text;
    EXPECT_FALSE(verify::parse_decimal(text)) << text;
  }
}

TEST(Limits, JsonNumbersBeyondThemAreNamedWithTheirPlace) {
  const auto read = io::read_layout(
      R"({"format": "lekalo-layout/1", "units": "mm", "stocks": [], "rules": {"gap": 1e-500}})", "a.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message,
            "a.json: rules.gap: '1e-500' is out of range: a number is 0 or at least 1e-400");
  const auto points =
      io::parse_regions(R"({"outer": [{"line": {"from": [0, 1e-500], "to": [1, 0]}}]})", "b.json", {});
  ASSERT_FALSE(points);
  EXPECT_NE(points.error().message.find("b.json: outer[0].line.from[1]: '1e-500'"), std::string::npos)
      << points.error().message;
}

// ---- layouts ----------------------------------------------------------------------------------------------

const std::string kLayout = R"({"format": "lekalo-layout/1", "units": "mm",
 "rules": {"gap": 0, "border_gap": 0, "defect_gap": 0},
 "stocks": [{"id": "r", "kind": "strip", "height": 50, "length": 90},
            {"id": "s", "thickness": 1, "kind": "sheet", "count": 1, "cost": 1, "grain_deg": 0,
             "outline": {"polygon": {"outer": [[0, 0], [90, 0], [90, 90], [0, 90]]}},
             "defects": [{"id": "d", "severity": 1,
                          "outline": {"polygon": {"outer": [[0, 0], [9, 0], [9, 9], [0, 9]]}}}],
             "zones": [{"id": "z", "quality": 1,
                        "outline": {"polygon": {"outer": [[0, 0], [9, 0], [9, 9], [0, 9]]}}}]}],
 "parts": [{"id": "p", "outline": {"polygon": {"outer": [[0, 0], [1, 0], [1, 1], [0, 1]]}},
            "texts": [{"text": "t", "at": [0, 0], "height": 1, "deg": 0, "width_factor": 1}],
            "quality": 0, "rotations": [0], "grain": {"deg": 0, "tolerance_deg": 0},
            "tolerated_severity": 0, "priority": 0, "demand": 1, "gap": 0}],
 "kits": [{"id": "k", "demand": 1, "value": 1, "pieces": [{"part": "p", "count": 1}]}],
 "placements": [{"id": 1, "part": "p", "stock": "s", "copy": 0, "c": 1, "s": 0, "x": 20, "y": 20}],
 "next_id": 9007199254740992})";

struct Limit {
  const char *place, *path;  ///< for the test's JSON, and as the reader says it
  std::string last, next;    ///< the last number that is taken, and one beyond
};

std::string text_of(double value) { return fmt::format("{:.17g}", value); }
Limit most(const char* place, const char* path, double value) {
  return {place, path, text_of(value), text_of(std::nextafter(value, INFINITY))};
}
Limit least(const char* place, const char* path, double value) {
  return {place, path, text_of(value), text_of(std::nextafter(value, -INFINITY))};
}
Limit most_whole(const char* place, const char* path, std::int64_t value) {
  return {place, path, fmt::format("{}", value), fmt::format("{}", value + 1)};
}
Limit least_whole(const char* place, const char* path, std::int64_t value) {
  return {place, path, fmt::format("{}", value), fmt::format("{}", value - 1)};
}

std::vector<Limit> limits_of_layouts() {
  using namespace limits;
  return {
      most("/rules/gap", "rules.gap", kLargestOutline),
      least("/rules/border_gap", "rules.border_gap", 0),
      most("/stocks/0/height", "stocks[0].height", kLargestOutline),
      least("/stocks/0/length", "stocks[0].length", kShortestSide),
      most("/stocks/1/thickness", "stocks[1].thickness", kLargestOutline),
      least("/stocks/1/thickness", "stocks[1].thickness", kShortestSide),
      most_whole("/stocks/1/count", "stocks[1].count", kMostCount),
      least_whole("/stocks/1/count", "stocks[1].count", 1),
      most("/stocks/1/cost", "stocks[1].cost", kMostMoney),
      most("/stocks/1/grain_deg", "stocks[1].grain_deg", kMostDegrees),
      most("/stocks/1/outline/polygon/outer/1/0", "stocks[1].outline.polygon.outer[1]", kLargestOutline),
      most_whole("/stocks/1/defects/0/severity", "stocks[1].defects[0].severity", kMostSeverity),
      least_whole("/stocks/1/defects/0/severity", "stocks[1].defects[0].severity", 1),
      most_whole("/stocks/1/zones/0/quality", "stocks[1].zones[0].quality", kMostLevel),
      most_whole("/parts/0/quality", "parts[0].quality", kMostLevel),
      least("/parts/0/rotations/0", "parts[0].rotations[0]", -kMostDegrees),
      most("/parts/0/grain/deg", "parts[0].grain.deg", kMostDegrees),
      most("/parts/0/texts/0/height", "parts[0].texts[0].height", kHighestText),
      least("/parts/0/texts/0/height", "parts[0].texts[0].height", kLowestText),
      most("/parts/0/texts/0/deg", "parts[0].texts[0].deg", kMostDegrees),
      most("/parts/0/texts/0/width_factor", "parts[0].texts[0].width_factor", kWidestText),
      least("/parts/0/texts/0/width_factor", "parts[0].texts[0].width_factor", kNarrowestText),
      most("/parts/0/texts/0/at/0", "parts[0].texts[0].at[0]", kLargestCoordinate),
      most("/parts/0/grain/tolerance_deg", "parts[0].grain.tolerance_deg", 90),
      most_whole("/parts/0/tolerated_severity", "parts[0].tolerated_severity", kMostLevel),
      least_whole("/parts/0/priority", "parts[0].priority", -kMostLevel),
      most_whole("/parts/0/demand", "parts[0].demand", kMostCount),
      most("/parts/0/gap", "parts[0].gap", kLargestOutline),
      most_whole("/kits/0/demand", "kits[0].demand", kMostKits),
      most("/kits/0/value", "kits[0].value", kMostMoney),
      most_whole("/kits/0/pieces/0/count", "kits[0].pieces[0].count", kMostKits),
      most_whole("/placements/0/id", "placements[0].id", kMostId),
      most_whole("/placements/0/copy", "placements[0].copy", kMostCount),
      least_whole("/placements/0/copy", "placements[0].copy", 0),
      most("/placements/0/x", "placements[0].x", kLargestPlacement),
      least("/placements/0/y", "placements[0].y", -kLargestPlacement),
      most_whole("/next_id", "next_id", kMostId + 1),
  };
}

/// kLayout with another number in one place, digit for digit.
std::string layout_with(const Limit& limit, const std::string& number) {
  Json changed = Json::parse(kLayout);
  changed.at(std::string(limit.place)) = Json("NUMBER");
  std::string text = changed.dump();
  return text.replace(text.find("\"NUMBER\""), 8, number);
}

TEST(Limits, ReaderAndCheckerTakeTheLastNumberOfALayoutAndRefuseTheNext) {
  for (const Limit& limit : limits_of_layouts()) {
    const std::string last = layout_with(limit, limit.last), next = layout_with(limit, limit.next);
    const auto read = io::read_layout(last, "a.json");
    EXPECT_TRUE(read) << limit.place << ": " << read.error().message;
    const auto checked = verify::verify_layout({"a.json", last});
    EXPECT_TRUE(checked) << limit.place << ": " << checked.error().message;
    const auto refused = io::read_layout(next, "a.json");
    ASSERT_FALSE(refused) << limit.place << " " << limit.next;
    EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
    EXPECT_EQ(refused.error().message.rfind(fmt::format("a.json: {}: ", limit.path), 0), 0U)
        << refused.error().message;
    EXPECT_FALSE(verify::verify_layout({"a.json", next})) << limit.place << " " << limit.next;
  }
}

TEST(Limits, ANumberNextToAWholeOneIsThatForReaderAndChecker) {
  const Limit copy{"/placements/0/copy", "", "", ""};
  for (const char* text : {"2.0", "2e0", "2.0000000000000000000001"}) {
    const std::string bytes = layout_with(copy, text);
    const auto read = io::read_layout(bytes, "a.json");
    ASSERT_TRUE(read) << text << ": " << read.error().message;
    EXPECT_EQ(read->document.placements[0].copy, 2);
    EXPECT_TRUE(verify::verify_layout({"a.json", bytes})) << text;
  }
  EXPECT_FALSE(io::read_layout(layout_with(copy, "2.1"), "a.json"));
  EXPECT_FALSE(verify::verify_layout({"a.json", layout_with(copy, "2.1")}));
}

TEST(Limits, TheSchemaStatesThem) {
  using namespace limits;
  const Json schema = Json::parse(source_file("docs/schema/lekalo-layout-1.schema.json"));
  const auto states = [&](const std::string& place, double low, double high) {
    const Json& number = schema.at("/definitions/" + place);
    EXPECT_EQ(number.at("/minimum").get<double>(), low) << place;
    EXPECT_EQ(number.at("/maximum").get<double>(), high) << place;
  };
  const auto level = static_cast<double>(kMostLevel), count = static_cast<double>(kMostCount);
  states("gap", 0, kLargestOutline);
  states("degrees", -kMostDegrees, kMostDegrees);
  states("level", 0, level);
  states("money", 0, kMostMoney);
  states("thickness", kShortestSide, kLargestOutline);
  states("point/items", -kLargestOutline, kLargestOutline);
  states("outline/properties/chord_tolerance", kLeastChordTolerance, kMostChordTolerance);
  states("part/properties/texts/items/properties/height", kLowestText, kHighestText);
  states("part/properties/texts/items/properties/width_factor", kNarrowestText, kWidestText);
  states("stock/properties/count", 1, count);
  states("stock/properties/height", kShortestSide, kLargestOutline);
  states("stock/properties/length", kShortestSide, kLargestOutline);
  states("stock/properties/defects/items/properties/severity", 1, static_cast<double>(kMostSeverity));
  states("part/properties/priority", -level, level);
  states("part/properties/demand", 0, count);
  states("kit/properties/pieces/items/properties/count", 1, static_cast<double>(kMostKits));
  states("placement/properties/id", 1, static_cast<double>(kMostId));
  states("placement/properties/copy", 0, count);
  states("placement/properties/c", -kLargestSine, kLargestSine);
  states("placement/properties/x", -kLargestPlacement, kLargestPlacement);
  states("placement/properties/y", -kLargestPlacement, kLargestPlacement);
}

// ---- outlines and demands ---------------------------------------------------------------------------------

std::string line_json(const std::string& from, const std::string& to) {
  return fmt::format(R"({{"line": {{"from": [{}], "to": [{}]}}}})", from, to);
}

/// A rectangle 5 mm high, its points counter-clockwise from the lower left one.
std::string rectangle_json(const std::string& low, const std::string& high) {
  const std::string a = low + ", 0", b = high + ", 0", c = high + ", 5", d = low + ", 5";
  return fmt::format(R"({{"outer": [{}, {}, {}, {}]}})", line_json(a, b), line_json(b, c), line_json(c, d),
                     line_json(d, a));
}

std::string complaint_of_checker(const std::string& region) {
  std::string complaint;
  const auto root = verify::parse_json(region, "a.json");
  (void)verify::read_shape(*root, "a.json", complaint);
  return complaint;
}

TEST(Limits, CoordinatesOfRegionsAreReadUpToTheLimitByReaderAndChecker) {
  const std::string last = rectangle_json("0", "1000000000"),
                    next = rectangle_json("0", "1000000000.0000002");
  EXPECT_TRUE(io::parse_regions(last, "a.json", {}));
  EXPECT_EQ(complaint_of_checker(last), "");
  const auto refused = io::parse_regions(next, "a.json", {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("a.json, outer contour, edge 0: \"to\" is (1000000000, 0) mm"),
            std::string::npos)
      << refused.error().message;
  EXPECT_NE(complaint_of_checker(next), "");
}

TEST(Limits, EndsThatAreOneDoubleAreOnePointForReaderAndChecker) {
  std::string text = rectangle_json("0.1", "9");
  text.replace(text.rfind("0.1"), 3, "0.1000000000000000055");
  EXPECT_TRUE(io::parse_regions(text, "a.json", {}));
  EXPECT_EQ(complaint_of_checker(text), "");
  text.replace(text.rfind("0.1000000000000000055"), 21, "0.10000000000000003");
  EXPECT_FALSE(io::parse_regions(text, "a.json", {}));
  EXPECT_NE(complaint_of_checker(text), "");
}

/// A lens of two arcs about centres below and above it; flat ones have them far out.
std::string lens_json(double centre) {
  return fmt::format(
      R"({{"outer": [{{"arc": {{"from": [-9, 0], "to": [9, 0], "centre": [0, {0}], "ccw": true}}}},)"
      R"( {{"arc": {{"from": [9, 0], "to": [-9, 0], "centre": [0, -5], "ccw": true}}}}]}})",
      centre);
}

TEST(Limits, CentresOfArcsAreCoordinates) {
  EXPECT_TRUE(io::parse_regions(lens_json(1e9), "a.json", {}));
  const auto refused = io::parse_regions(lens_json(1e15), "a.json", {});
  ASSERT_FALSE(refused);
  EXPECT_NE(
      refused.error().message.find("edge 0: \"centre\" is (0, 1e+15) mm; coordinates go up to 1e+09 mm"),
      std::string::npos)
      << refused.error().message;
}

TEST(Limits, DemandsAreReadUpToTheLimit) {
  const auto read = [](const std::string& fields) {
    return io::parse_features(R"({"features": [{"name": "a", "edges": [0], )" + fields + "}]}", "f.json", {});
  };
  for (const char* key : {"minimum", "target", "maximum", "finished"}) {
    EXPECT_TRUE(read(fmt::format("\"{}\": 1e9", key))) << key;
    const auto refused = read(fmt::format("\"{}\": 1000000000.0000002", key));
    ASSERT_FALSE(refused) << key;
    EXPECT_NE(refused.error().message.find(fmt::format("f.json, feature \"a\": \"{}\" is ", key)),
              std::string::npos)
        << refused.error().message;
  }
  EXPECT_FALSE(io::parse_features(R"({"minimum": 1e10})", "f.json", {}));
  EXPECT_FALSE(io::parse_features(R"({"minimum": 39370079})", "f.json", LengthUnit::inch));
  for (const char* scale : {"1e-6", "1e6"}) EXPECT_TRUE(read(fmt::format("\"scale\": {}", scale))) << scale;
  for (const char* scale : {"9.9e-7", "1000000.1", "0", "-1", "1e308"})
    EXPECT_FALSE(read(fmt::format("\"scale\": {}", scale))) << scale;
}

TEST(Limits, PocketsLieWherePrograms) {
  const auto ground = [](const std::string& low, const std::string& high) {
    const auto outline = io::read_outline(rectangle_json(low, high), "a.json", {});
    EXPECT_TRUE(outline);
    return jobs::pocket_ground("a.json", *outline, {});
  };
  EXPECT_TRUE(ground("999990", "1000000"));
  const auto refused = ground("999990", "1000000.01");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
  EXPECT_EQ(refused.error().message,
            "a.json: the pocket reaches to (1000000.01, 5) mm; programs go up to 1e+06 mm");
}

// ---- the page ---------------------------------------------------------------------------------------------

std::string with_commas(std::int64_t value) {
  std::string text = fmt::format("{}", value);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), ",");
  return text;
}

TEST(Limits, ThePageStatesThem) {
  using namespace limits;
  const std::string page = source_file("docs/limits.md");
  for (const std::string& said :
       {fmt::format("{} digits", kMostDigits),
        fmt::format("1e-{}", kMostPlaces),
        with_commas(static_cast<std::int64_t>(kLargestCoordinate)) + " mm",
        fmt::format("{:g} mm", kSmallestCoordinate),
        fmt::format("{:g} mm", kLargestDerived),
        with_commas(static_cast<std::int64_t>(kLargestFactor)),
        with_commas(static_cast<std::int64_t>(kLargestProgramCoordinate)) + " mm",
        with_commas(static_cast<std::int64_t>(kLargestOutline)) + " mm",
        with_commas(static_cast<std::int64_t>(kLargestPlacement)) + " mm",
        fmt::format("{} mm", kShortestSide),
        with_commas(static_cast<std::int64_t>(kMostDegrees)) + " degrees",
        fmt::format("{}", kLargestSine),
        fmt::format("from {} to {} mm; from {} to {} |", kLowestText,
                    with_commas(static_cast<std::int64_t>(kHighestText)), kNarrowestText, kWidestText),
        fmt::format("{} mm", kMostChordTolerance),
        with_commas(kMostCount),
        with_commas(kMostKits),
        with_commas(kMostLevel),
        with_commas(kMostSeverity),
        with_commas(kMostId),
        fmt::format("{:g}", kMostMoney),
        with_commas(kMostSolidItems) + " each",
        fmt::format("| {} times as long as it is packed, or {} bytes |", kMostUnpackedTimes,
                    with_commas(kSmallUnpacked)),
        fmt::format("| {}; {} |", with_commas(kMostPlacedObjects), kMostObjectLevels),
        "| " + with_commas(kMostPlacedCopies) + " each |",
        with_commas(kMostCertificateRows) + " each",
        fmt::format("{}; {} |", with_commas(kMostCertificateNodes), kMostCertificateTerms),
        with_commas(most_meeting_boxes(0)) + " and 16 for each edge",
        with_commas(most_meeting_pieces(0)) + " and 64 for each edge",
        "| " + with_commas(kMostCrossings) + " |"})
    EXPECT_NE(page.find(said), std::string::npos) << said;
}

}  // namespace
}  // namespace lekalo::base_limits_test
