// The checker and corrected programs of `lekalo heat`: it rebuilds from their bytes what they leave, and
// finds lies about them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/json.hpp"
#include "support/json_paths.hpp"
#include "support/prepared.hpp"

namespace lekalo::verify_heat_correction_test {
namespace {

using cases::each_path;
using cases::is_number;
using cases::Json;
using heat::Property;

/// A pocket of 24 x 18 mm. Lanes and a round leave 0.3 mm on its walls, and then one pass goes along them.
const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[24,0]}},{"line":{"from":[24,0],"to":[24,18]}},)"
    R"({"line":{"from":[24,18],"to":[0,18]}},{"line":{"from":[0,18],"to":[0,0]}}]})";
const std::string kProgram =
    "G21 G90 G17 G54 G94\nM3 S8000\nG0 X6 Y6 Z5\nG1 Z-8 F200\nG1 X3.3 Y6 F900\nG1 X20.7\nG1 Y8\nG1 X3.3 Y10 "
    "F900\n"
    "G1 X20.7\nG1 Y12\nG1 X3.3 Y3.3\nG1 X20.7\nG1 Y14.7\nG1 X3.3\nG1 Y3.3\nG1 X8 Y10\nG1 X12 Y4\nG3 X13 Y3 "
    "I1 J0\n"
    "G1 X21 Y3\nG1 Y15\nG1 X3\nG1 Y3\nG1 X13\nG3 X14 Y4 I0 J1\nG0 Z5\nM5\nM2\n";

jobs::HeatResultJob job_of(double share_least, double share_greatest, heat::Interval film) {
  jobs::HeatResultJob job;
  jobs::HeatSourceJob& source = job.heat.source;
  source.program = {"part.ngc", kProgram};
  source.pocket = {"pocket.json", kPocket};
  source.machining.tool_diameter = 6;
  source.cutting.teeth = 3, source.cutting.spindle_rpm = 8000;
  source.stock.block = heat::read_stock("44x38x16");
  heat::MaterialWords words{"6061-T6", {}};
  const auto state = [&](Property p, heat::Interval value) {
    words.stated[static_cast<std::size_t>(p)] = value;
  };
  state(Property::share, {share_least, share_greatest});
  state(Property::cutting_force, {700, 700});
  state(Property::force_exponent, {0.25, 0.25});
  job.heat.material = *heat::material_of(words);
  job.heat.film = film;
  job.heat.pitch = 4;
  job.correction = jobs::CorrectionWish{}, job.corrected_as = "corrected.ngc";
  return job;
}

struct Honest {
  Json document;
  std::string program, corrected;
};
Honest made_of(const jobs::HeatResultJob& job) {
  const auto made = jobs::heat_result(job);
  if (!made || !made->correction || !made->correction->why_not.empty()) {
    ADD_FAILURE() << (made ? made->correction->why_not : made.error().message);
    return {};
  }
  return {Json::parse(made->json), job.heat.source.program.bytes, made->correction->program};
}

/// With three films and an interval of the share, so that there are nine corners.
const cases::Prepared<Honest> kHonest([] { return made_of(job_of(0.44, 0.46, {18, 22})); });
const cases::Prepared<Honest> kCold([] { return made_of(job_of(0, 0, {20, 20})); });

/// All that the checker says of a document and a corrected program.
std::string said_of(const Honest& honest, const Json& document, const std::string& corrected) {
  const auto report = verify::verify_heat_report(
      {"r.json", document.dump()},
      {{"part.ngc", honest.program}, {"pocket.json", kPocket}, {"corrected.ngc", corrected}});
  if (!report) return report.error().message;
  std::string all;
  for (const std::string& finding : report->findings) all += finding + "; ";
  return all;
}
std::string said(const std::function<void(Json&)>& change) {
  Json document = kHonest->document;
  change(document);
  return said_of(*kHonest, document, kHonest->corrected);
}
std::string said_of_program(const std::string& corrected) {
  return said_of(*kHonest, kHonest->document, corrected);
}

bool says(const std::string& sentences, const std::string& words) {
  return sentences.find(words) != sentences.npos;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

/// The program with each word of the letter from `low` to `high` moved by as much, mm, or to where `to` says.
std::string moved(const std::string& program, char letter, double low, double high, double by,
                  const std::string& to = {}) {
  std::string text;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find_first_of(" \n", at), program.size() - 1) + 1;
    const std::string word = program.substr(at, end - at);
    double value = low - 1;
    if (word[0] == letter && word.size() > 2) value = std::stod(word.substr(1));
    const std::string place = to.empty() ? fmt::format("{:.4f}", value + by) : to;
    text += value >= low && value <= high ? fmt::format("{}{}{}", letter, place, word.back()) : word;
    at = end;
  }
  return text;
}

TEST(VerifyHeatCorrection, HonestOnesHoldAndWithoutHeatTheProgramIsItsOwn) {
  EXPECT_EQ(said([](Json&) {}), "");
  EXPECT_EQ(said([](Json& d) { d["correction"]["finish_mm"] = 0.5; }), "");
  EXPECT_EQ(said_of(*kCold, kCold->document, kCold->program), "");
  EXPECT_TRUE(says(said_of(*kCold, kCold->document, replaced(kCold->program, "M5\n", "M5 (same)\n")),
                   "without heat the corrected program has to be the program"));
}

/// Walks the fields of a part of the document; one wall stands for all.
void each_field(const std::string& within, const std::function<void(const std::string& path)>& visit) {
  std::size_t count = 0;
  each_path(kHonest->document, "", [&](const std::string& path) {
    if (path.rfind(within, 0) != 0 || says(path, "/walls/1") || says(path, "/walls/2") ||
        says(path, "/walls/3"))
      return;
    ++count, visit(path);
  });
  EXPECT_GT(count, 3U);
}

void expect_none_absent(const std::string& within) {
  each_field(within, [&](const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string key = path.substr(slash + 1);
    if (key.find_first_not_of("0123456789") == key.npos) return;
    EXPECT_NE(said([&](Json& d) { (slash == 0 ? d : d.at(path.substr(0, slash))).erase(key); }), "")
        << "without " << path;
  });
}

TEST(VerifyHeatCorrection, NoFieldOfTheCorrectionCanBeAbsent) { expect_none_absent("/correction"); }
TEST(VerifyHeatCorrection, NoFieldOfWhatIsLeftCanBeAbsent) { expect_none_absent("/after_correction_um"); }

void expect_none_another(const std::string& within) {
  each_field(within, [&](const std::string& path) {
    // The finishing stock and the rounds are told, and held by nothing else; of displacements those count
    // that decide an error.
    if (!is_number(kHonest->document.at(path)) || says(path, "finish_mm") || says(path, "rounds") ||
        says(path, "moved_um"))
      return;
    EXPECT_NE(said([&](Json& d) {
                Json& value = d.at(path);
                value = value.get<double>() * 1.02 + 0.01;
              }),
              "")
        << path;
  });
}

TEST(VerifyHeatCorrection, NoFigureOfTheWorkCanBeAnother) { expect_none_another("/correction/booked"); }
TEST(VerifyHeatCorrection, NoFigureOfAWallCanBeAnother) { expect_none_another("/correction/walls"); }
TEST(VerifyHeatCorrection, NoFigureOfWhatIsLeftCanBeAnother) { expect_none_another("/after_correction_um"); }

TEST(VerifyHeatCorrection, NothingElseCanBeSaid) {
  for (const char* path : {"/correction", "/correction/booked", "/correction/walls/0",
                           "/correction/walls/0/visits/0", "/after_correction_um"})
    EXPECT_NE(said([&](Json& d) { d.at(path)["more"] = 0; }), "") << path;
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NE(said([&](Json& d) {
                for (Json& wall : d["correction"]["walls"])
                  for (Json& visit : wall["visits"])
                    visit["moved_um"][i] = visit["moved_um"][i].get<double>() * 1.1;
              }),
              "")
        << i;
  EXPECT_TRUE(says(said([](Json& d) { d["correction"]["finish_mm"] = 0; }),
                   "field correction.finish_mm is not above 0"));
  EXPECT_TRUE(
      says(said([](Json& d) { d["correction"]["walls"] = Json::array(); }), "correction.walls is empty"));
}

TEST(VerifyHeatCorrection, DocumentSummaryAndFileAreThereTogether) {
  const std::string apart = "not all there or all absent";
  EXPECT_TRUE(says(said([](Json& d) { d["correction"] = Json(); }), apart));
  EXPECT_TRUE(says(said([](Json& d) { d["after_correction_um"] = Json(); }), apart));
  EXPECT_TRUE(says(said([](Json& d) { d["correction"] = d["after_correction_um"] = Json(); }), apart));
}

TEST(VerifyHeatCorrection, EveryPlaceIsThereOnceWithEveryVisit) {
  const auto wall = [](Json& d, std::size_t i) -> Json& { return d["correction"]["walls"][i]; };
  EXPECT_TRUE(
      says(said([](Json& d) { d["correction"]["walls"].erase(0); }), "correction.walls has no place at X "));
  EXPECT_TRUE(says(said([&](Json& d) { wall(d, 0)["at_mm"][0] = 11.3; }),
                   "correction.walls[0].at_mm is no place of a wall"));
  EXPECT_TRUE(says(said([&](Json& d) { d["correction"]["walls"].push_back(wall(d, 0)); }), "is there twice"));
  // A place in a corner, to which the tool does not come.
  EXPECT_TRUE(says(said([&](Json& d) {
                     Json place = wall(d, 0);
                     place["at_mm"][0] = 2;
                     d["correction"]["walls"].push_back(place);
                   }),
                   "which the corrected program does not cut"));
}

// A pass a tenth of a millimetre off the wall, but for a tenth of a nanometre, may cut it or not.
TEST(VerifyHeatCorrection, APlaceThatRoundingDecidesMayBeThereOrNot) {
  const auto right_wall_at = [](double x) {
    const std::string text = moved(kHonest->corrected, 'X', 20.9, 21.1, 0, fmt::format("{:.10f}", x));
    return says(said_of_program(text), "which the corrected program does not cut");
  };
  EXPECT_FALSE(right_wall_at(20.8999999999));
  EXPECT_TRUE(right_wall_at(20.8999999));
}

TEST(VerifyHeatCorrection, EveryVisitIsThereOnceAtItsTime) {
  const auto wall = [](Json& d, std::size_t i) -> Json& { return d["correction"]["walls"][i]; };
  EXPECT_TRUE(says(said([&](Json& d) { wall(d, 0)["visits"] = Json::array(); }), "visits is empty"));
  for (std::size_t k = 0; k < kHonest->document["correction"]["walls"][0]["visits"].size(); ++k)
    EXPECT_TRUE(says(said([&](Json& d) { wall(d, 0)["visits"].erase(k); }), "when the tool is there")) << k;
  for (const double by : {-2.0, 2.0})
    EXPECT_TRUE(says(said([&](Json& d) {
                       Json& seconds = wall(d, 0)["visits"][0]["seconds"];
                       seconds = seconds.get<double>() + by;
                     }),
                     "correction.walls[0].visits[0].seconds: the tool does not cut the place then"));
  EXPECT_TRUE(says(said([&](Json& d) { wall(d, 0)["visits"][0]["moved_um"].push_back(0); }),
                   "moved_um has 7 numbers, and is to have 6"));
}

/// What a program that is moved along its walls alone is never said to do.
void expect_no_other_fault(const std::string& all) {
  for (const char* words : {"leaves the pocket by", "rapids", "leaves a spot", "not as deep"})
    EXPECT_FALSE(says(all, words)) << words << ": " << all;
}

TEST(VerifyHeatCorrection, AProgramThatLeavesTooMuchIsTold) {
  const std::string itself = said_of_program(kHonest->program);
  EXPECT_TRUE(says(itself, "more than a fifth")) << itself;
  EXPECT_TRUE(says(itself, "and a scaling")) << itself;
  EXPECT_FALSE(says(itself, "cold workpiece")) << itself;
  EXPECT_FALSE(says(itself, "may leave")) << itself;
  expect_no_other_fault(itself);
  // Its right wall is cut 5 um further, and 60 um less far.
  const std::string deeper = said_of_program(moved(kHonest->corrected, 'X', 20.9, 21.1, 0.005));
  EXPECT_TRUE(says(deeper, "um into the cold workpiece, and 1 um are allowed")) << deeper;
  expect_no_other_fault(deeper);
  const std::string shallower = said_of_program(moved(kHonest->corrected, 'X', 20.9, 21.1, -0.06));
  EXPECT_TRUE(says(shallower, "may leave")) << shallower;
  EXPECT_FALSE(says(shallower, "cold workpiece")) << shallower;
  expect_no_other_fault(shallower);
}

TEST(VerifyHeatCorrection, AProgramThatClearsThePocketOtherwiseIsTold) {
  const std::string& corrected = kHonest->corrected;
  EXPECT_TRUE(
      says(said_of_program(replaced(corrected, "G1 Z-8 ", "G1 Z-3 ")), "is not as deep as the program"));
  const std::string spiked =
      said_of_program(replaced(corrected, "G1 X8 Y10\n", "G1 X8 Y10\nG1 Y2.9\nG1 Y10\n"));
  EXPECT_TRUE(says(spiked, "leaves the pocket by 0.")) << spiked;
  const std::string lane = "G1 X3.3 Y10 F900\nG1 X20.7\nG1 Y12\n";
  const std::string rapid =
      said_of_program(replaced(corrected, lane, "G1 X3.3 Y10 F900\nG0 X20.7\nG1 Y12\n"));
  EXPECT_TRUE(says(rapid, "rapids of the corrected program meet material")) << rapid;
  const auto with_rapid_to = [&](const char* x) {
    const std::string short_rapid = fmt::format("G1 X3.3 Y10 F900\nG1 X12\nG0 X{}\nG1 X20.7\nG1 Y12\n", x);
    return said_of_program(replaced(corrected, lane, short_rapid));
  };
  EXPECT_TRUE(says(with_rapid_to("12.15"), "rapids of the corrected program meet material"));
  EXPECT_FALSE(says(with_rapid_to("12.09"), "rapids")) << with_rapid_to("12.09");
  const std::string uncut = said_of_program(replaced(corrected, lane, ""));
  EXPECT_TRUE(says(uncut, "leaves a spot")) << uncut;
}

}  // namespace
}  // namespace lekalo::verify_heat_correction_test
