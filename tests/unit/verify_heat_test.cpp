// The checker and results of `lekalo heat`: honest ones hold, and lies about every figure that it can make
// anew are refuted.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/json.hpp"
#include "support/json_paths.hpp"
#include "support/prepared.hpp"

namespace lekalo::verify_heat_test {
namespace {

using cases::each_path;
using cases::is_number;
using cases::Json;
using cases::one_of;
using heat::Property;

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[20,0]}},{"line":{"from":[20,0],"to":[20,16]}},)"
    R"({"line":{"from":[20,16],"to":[0,16]}},{"line":{"from":[0,16],"to":[0,0]}}]})";
/// A ring whose contours turn the other way round, and whose outer circle is one edge.
const std::string kRing =
    R"({"units":"mm","outer":[{"arc":{"from":[15,0],"to":[15,0],"centre":[0,0],"ccw":false}}],)"
    R"("islands":[[{"arc":{"from":[7,0],"to":[-7,0],"centre":[0,0],"ccw":true}},)"
    R"({"arc":{"from":[-7,0],"to":[7,0],"centre":[0,0],"ccw":true}}]]})";

const std::string kProgram =
    "G21 G90 G17\nG0 X3.2 Y3.2 Z5\nG1 Z-4 F200\nG1 X16.8 F600\nG1 Y12.8\nG1 X3.2\nG1 Y3.2\nG1 Y8\nG1 X16.8\n"
    "G1 X17 Y8\nG1 Y13\nG1 X3\nG1 Y3\nG1 X17\nG1 Y8\nG0 Z5\n";

jobs::HeatResultJob job_of(double share_least, double share_greatest) {
  jobs::HeatResultJob job;
  jobs::HeatSourceJob& source = job.heat.source;
  source.program = {"part.ngc", kProgram};
  source.pocket = {"pocket.json", kPocket};
  source.machining.tool_diameter = 6;
  source.cutting.teeth = 3, source.cutting.spindle_rpm = 8000;
  source.stock.block = heat::read_stock("40x36x10");
  heat::MaterialWords words{"6061-T6", {}};
  words.stated[static_cast<std::size_t>(Property::share)] = heat::Interval{share_least, share_greatest};
  job.heat.material = *heat::material_of(words);
  job.heat.film = {5, 50};
  job.heat.pitch = 5;
  return job;
}

std::vector<verify::Document> files_of(const jobs::HeatResultJob& job) {
  const jobs::HeatSourceJob& source = job.heat.source;
  std::vector<verify::Document> files{{source.program.name, source.program.bytes},
                                      {source.pocket.name, source.pocket.bytes}};
  for (const jobs::EarlierProgram& before : source.after)
    files.push_back({before.program.name, before.program.bytes});
  if (source.stock.outline)
    files.insert(files.begin() + 2, {source.stock.outline->name, source.stock.outline->bytes});
  return files;
}

/// With a temperature of the model itself, which narrows the heat.
jobs::HeatResultJob measured_job() {
  jobs::HeatResultJob job = job_of(0.05, 0.2);
  job.heat.measured = {{20, {10, 8, -7}, 12, 1000}};
  const auto rises = jobs::heat_result(job).value().found.middle().rises_k;
  job.heat.measured[0].celsius += 0.1 * rises[0];
  job.heat.measured[0].uncertainty_k = 0.02 * rises[0];
  return job;
}

/// A result with three films.
const cases::Prepared<Json> kHonest([] {
  return Json::parse(jobs::heat_result(measured_job()).value().json);
});

Result<verify::ClaimReport> judged(const Json& document, const jobs::HeatResultJob& job) {
  return verify::verify_heat_report({"r.json", document.dump()}, files_of(job));
}

bool refuted(const std::function<void(Json&)>& change) {
  Json document = *kHonest;
  change(document);
  const auto report = judged(document, job_of(0.05, 0.2));
  return !report || !report->findings.empty();
}

/// The sentence of what is refused, or all findings.
std::string said(const std::function<void(Json&)>& change) {
  Json document = *kHonest;
  change(document);
  const auto report = judged(document, job_of(0.05, 0.2));
  if (!report) return report.error().message;
  std::string all;
  for (const std::string& finding : report->findings) all += finding + "; ";
  return all;
}

/// A triangle with a hole, about the pocket.
const std::string kBlank =
    R"({"units":"mm","outer":[{"line":{"from":[-20,-10],"to":[50,-10]}},{"line":{"from":[50,-10],"to":[10,50]}},)"
    R"({"line":{"from":[10,50],"to":[-20,-10]}}],)"
    R"("holes":[[{"arc":{"from":[34,0],"to":[30,0],"centre":[32,0],"ccw":false}},)"
    R"({"arc":{"from":[30,0],"to":[34,0],"centre":[32,0],"ccw":false}}]]})";
const std::string kDrawn =
    "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n-10\n20\n-10\n10\n35\n20\n-"
    "10\n10\n30\n20\n"
    "30\n10\n-10\n20\n26\n0\nENDSEC\n0\nEOF\n";

jobs::HeatResultJob outline_job() {
  jobs::HeatResultJob job = job_of(0.1, 0.2);
  job.heat.source.stock = {};
  job.heat.source.stock.outline = jobs::File{"blank.json", kBlank};
  job.heat.source.stock.thickness = 9;
  return job;
}

TEST(VerifyHeat, AnOutlineIsThatOfItsFile) {
  const jobs::HeatResultJob job = outline_job();
  const Json honest = Json::parse(jobs::heat_result(job).value().json);
  const auto said_of = [&](const std::function<void(Json&)>& change) {
    Json document = honest;
    change(document);
    const auto report = judged(document, job);
    if (!report) return report.error().message;
    return report->findings.empty() ? std::string() : report->findings[0];
  };
  EXPECT_EQ(said_of([](Json&) {}), "");
  EXPECT_NE(said_of([](Json& d) { d["stock"]["outline"] = Json(); }).find("go together"), std::string::npos);
  EXPECT_NE(said_of([](Json& d) {
              d["stock"]["outline"]["regions"]["holes"] = Json::array();
            }).find("is not what blank.json means"),
            std::string::npos);
  EXPECT_NE(said_of([](Json& d) { d["stock"]["high_mm"][1] = 51; }).find("stock.high_mm[1]"),
            std::string::npos);
  EXPECT_NE(said_of([](Json& d) { d["stock"]["outline"]["regions"]["units"] = "inch"; }).find("units"),
            std::string::npos);
  for (const char* key : {"regions", "tolerance_mm", "drawing", "scan"})
    EXPECT_NE(said_of([&](Json& d) { d["stock"]["outline"].erase(key); }), "") << key;
}

TEST(VerifyHeat, WhatWasMeasuredIsHeldAgainstTheProgram) {
  EXPECT_NE(said([](Json& d) {
              d["measured"][0]["at_mm"][2] = -2;
              d["measured"][0]["at_mm"][1] = 3.2;
            }).find("measured[0] is in the air"),
            std::string::npos);
  EXPECT_NE(
      said([](Json& d) { d["measured"][0]["at_mm"][0] = 70; }).find("measured[0] is outside of the stock"),
      std::string::npos);
  EXPECT_NE(said([](Json& d) { d["measured"][0]["seconds"] = 1e4; }).find("outside of the program's time"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) {
              d["calibrated"]["share"] = {0.05, 0.06};
            }).find("calibrated.share"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) { d["measured"] = Json::array(); }).find("calibrated"), std::string::npos);
}

TEST(VerifyHeat, HonestResultsHoldAndWhatIsComputedIsNamed) {
  std::vector<jobs::HeatResultJob> jobs{job_of(0.05, 0.2), job_of(0, 0), job_of(0.1, 0.1)};
  jobs[2].heat.film = {200, 200};
  jobs.push_back(job_of(0, 0.2));
  jobs.back().heat.holding.held[of(heat::Side::x_low)] =
      jobs.back().heat.holding.held[of(heat::Side::x_high)] = true;
  jobs.back().heat.source.stock.block = heat::read_stock("50x40x6@-20,-9");
  jobs.back().heat.source.cutting.wear = {1, 1.5};
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.source.pocket = {"ring.json", kRing};
  jobs.back().heat.source.program.bytes =
      "G21 G90 G17\nG0 X11 Y0 Z5\nG1 Z-2 F200\nG2 X11 Y0 I-11 J0 F600\nG1 X12\nG2 X12 Y0 I-12 J0\nG1 X10\nG2 "
      "X10 Y0 "
      "I-10 J0\nG0 Z5\n";
  jobs.back().heat.holding.datum = heat::Place{0, 0, 0};
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.source.after = {{{"before.ngc", kProgram.substr(0, 70) + "\nG0 Z5\n"}, 5}};
  jobs.push_back(outline_job());
  jobs.push_back(outline_job());
  jobs.back().heat.source.stock.outline = jobs::File{"blank.dxf", kDrawn};
  for (const jobs::HeatResultJob& job : jobs) {
    const auto made = jobs::heat_result(job);
    ASSERT_TRUE(made) << made.error().message;
    const auto report = judged(Json::parse(made->json), job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->findings.empty()) << report->findings[0];
    EXPECT_GE(report->unchecked.size(), 4U);
  }
}

TEST(VerifyHeat, ThePlacesOfARingAreThoseOfBothCircles) {
  jobs::HeatResultJob job = job_of(0.1, 0.1);
  job.heat.source.pocket = {"ring.json", kRing};
  job.heat.source.program.bytes =
      "G21 G90 G17\nG0 X11 Y0 Z5\nG1 Z-2 F200\nG2 X11 Y0 I-11 J0 F600\nG1 X12\nG2 X12 Y0 I-12 J0\nG0 Z5\n";
  const Json result = Json::parse(jobs::heat_result(job).value().json);
  // The outer circle is 94.2 mm round, 19 places; each half of the island 22 mm, 5 places, and stays 1 mm
  // off.
  EXPECT_EQ(result["walls"].size(), 19U);
  EXPECT_EQ(result["uncut_places"], 10);
}

// Provenance and information.
bool is_free(const std::string& path) {
  return one_of(path, {"/inputs", "/warnings", "/seed", "/work", "/version", "/run"}) &&
         !one_of(path, {"/work_j"});
}

// A result of a kilobyte may not ask for a million places.
TEST(VerifyHeat, VoxelsTooSmallForTheWallsAreRefusedAtOnce) {
  for (const double voxel : {1e-12, 1e-6, 0.01}) {
    const std::string sentence = said([&](Json& d) { d["voxel_mm"] = voxel; });
    EXPECT_NE(sentence.find("the walls of pocket.json have more than 1000000 places"), std::string::npos)
        << sentence.substr(0, 200);
  }
  // Of many places that are not there some are named.
  const std::string sentence = said([](Json& d) { d["voxel_mm"] = 0.05; });
  EXPECT_NE(sentence.find("walls has no place at"), std::string::npos) << sentence.substr(0, 200);
  EXPECT_LT(std::count(sentence.begin(), sentence.end(), ';'), 400);
}

TEST(VerifyHeat, NoFieldCanBeAbsentOrAnother) {
  EXPECT_FALSE(refuted([](Json&) {}));
  std::size_t count = 0;
  each_path(*kHonest, "", [&](const std::string& path) {
    // One wall and one case stand for all.
    if (is_free(path) ||
        one_of(path, {"/walls/1", "/walls/2", "/walls/3", "/cases/1", "/cases/2", "/errors_um/"}))
      return;
    const std::size_t slash = path.rfind('/');
    const std::string key = path.substr(slash + 1);
    const auto parent = [&](Json& d) -> Json& { return slash == 0 ? d : d.at(path.substr(0, slash)); };
    ++count;
    if (key.find_first_not_of("0123456789") != key.npos) {
      EXPECT_TRUE(refuted([&](Json& d) { parent(d).erase(key); })) << "without " << path;
      EXPECT_TRUE(refuted([&](Json& d) { parent(d)[key + "_"] = 0; })) << "more beside " << path;
    }
    const bool may_be_null = one_of(path, {"glass_c", "datum_mm", "outline"});
    if (!may_be_null) {
      EXPECT_TRUE(refuted([&](Json& d) { d.at(path) = Json(); })) << path << " null";
    }
    if (path != "/material/name") {
      EXPECT_TRUE(refuted([&](Json& d) { d.at(path) = "x"; })) << path << " x";
    }
  });
  EXPECT_GT(count, 100U);
}

TEST(VerifyHeat, NoFigureCanBeAnother) {
  std::size_t count = 0;
  each_path(*kHonest, "", [&](const std::string& path) {
    if (!is_number(kHonest->at(path)) || is_free(path)) return;
    // These were stated, or are computed in voxels and held by nothing else; a little more of the stock, or
    // left on walls, changes no cut.
    if (one_of(path, {"/conductivity",  "/density",     "/heat_capacity",    "/expansion_per_k",
                      "/youngs",        "/poisson",     "/ambient_c",        "/step_over",
                      "/rapid",         "stress_at_mm", "stress_seconds",    "/stock/",
                      "stock_to_leave", "/voxel_mm",    "/cases/1/half_s",   "/cases/1/tenth_s",
                      "/yield_mpa/1",   "/melting_c/1", "/measured/0/at_mm", "/measured/0/seconds"}))
      return;
    ++count;
    for (const double factor : {0.98, 1.02})
      EXPECT_TRUE(refuted([&](Json& d) {
        Json& value = d.at(path);
        value = value.get<double>() * factor + (factor > 1 ? 0.01 : -0.01);
      })) << path
          << " times " << factor;
  });
  EXPECT_GT(count, 90U);
}

TEST(VerifyHeat, LiesThatGoTogetherWithMostOfTheRestAreFound) {
  // The worst place is left out, with its errors.
  EXPECT_NE(said([](Json& d) {
              d["walls"].erase(0);
              for (std::size_t i = 0; i < 3; ++i) d["cases"][i]["errors_um"].erase(0);
            }).find("which the program cuts"),
            std::string::npos);
  // A place is there twice, and another is not.
  EXPECT_TRUE(refuted([](Json& d) { d["walls"][1] = d["walls"][0]; }));
  // Another moment.
  EXPECT_NE(said([](Json& d) { d["walls"][0]["seconds"] = 1; }).find("does not cut the place then"),
            std::string::npos);
  // Heat is not all somewhere, the same in all places where it is said.
  EXPECT_NE(said([](Json& d) {
              for (Json* at : {&d, &d["cases"][1]}) {
                Json& stored = (*at)["heat_balance"]["stored_j"];
                stored = 0.9 * stored.get<double>();
              }
            }).find("is not what is stored, lost and removed"),
            std::string::npos);
  // A scaling that leaves less than it does, and one that is not the best.
  EXPECT_TRUE(refuted([](Json& d) { d["uniform_scaling"]["left_um"]["most"] = 0; }));
  EXPECT_NE(said([](Json& d) {
              for (Json* at : {&d["uniform_scaling"], &d["cases"][1]["uniform_scaling"]})
                (*at)["factor"] = 1.001;
            }).find("least squares"),
            std::string::npos);
  // A larger block, in which the same is cut, holds as much; one that the program leaves does not.
  EXPECT_NE(said([](Json& d) { d["stock"]["low_mm"][0] = 4; }).find("beyond the stock"), std::string::npos);
  // A material that does not hold what the workpiece gets.
  EXPECT_NE(said([](Json& d) { d["ambient_c"] = 900; }).find("beyond limit_c throughout"), std::string::npos);
  // More of the power.
  EXPECT_NE(said([](Json& d) { d["material"]["share"][1] = 0.1; }).find("into_workpiece_j"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) { d["status"] = "proved"; }).find("status"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify_heat_test
