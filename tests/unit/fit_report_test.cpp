// The checker and results of `lekalo fit`: those of many fits hold, and lies about every figure that it can
// make anew are refuted.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "lekalo/jobs/fit.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"

namespace lekalo::fit_report_test {
namespace {

using cases::Json;

jobs::FitJob article() {
  jobs::FitJob job;
  job.fit = "18H8/z8";
  job.hub_outer = 36, job.length = 18, job.shaft_length = 54, job.bore = 6;
  job.material.name = "C45";
  job.friction = {0.08, 0.12};
  job.clearance_um = 18;
  return job;
}

verify::ClaimReport judged(const std::string& bytes) {
  return verify::verify_fit_report({"r.json", bytes}, {}).value();
}

TEST(VerifyFit, WhatManyFitsSayOfMeansHolds) {
  struct One {
    double bore, diameter, outer, length, shaft_length, interference, yield;
  };
  for (const One& f : {One{0, 18, 36, 18, 54, 0.02, 900},
                       {6, 18, 36, 18, 54, 0.02, 900},
                       {0, 18, 22, 40, 60, 0.01, 900},
                       {16, 18, 60, 5, 100, 0.01, 2000},
                       {0, 200, 260, 30, 30, 0.1, 900},
                       {90, 100, 110, 200, 300, 0.05, 900},
                       {0, 3, 9, 12, 12.5, 0.003, 900},
                       {17, 18, 19, 10, 30, 0.005, 900},
                       {0, 50, 500, 20, 60, 0.02, 900},
                       {10, 18, 36, 18, 54, 0.06, 340}}) {
    jobs::FitJob job;
    job.diameter = f.diameter, job.interference = f.interference, job.hub_outer = f.outer,
    job.length = f.length;
    job.shaft_length = f.shaft_length, job.bore = f.bore;
    job.material.name = "C45", job.material.yield_mpa = f.yield;
    const auto made = jobs::fit(job);
    ASSERT_TRUE(made) << f.diameter << ": " << made.error().message;
    const verify::ClaimReport report = judged(made->json);
    EXPECT_TRUE(report.findings.empty());
    EXPECT_FALSE(report.unchecked.empty()) << "what is computed is named";
  }
  jobs::FitJob rings = article();
  rings.fit.clear(), rings.diameter = 40, rings.interference = 0.02, rings.hub_outer = 60,
                     rings.more = {{80, 0.03}};
  ASSERT_TRUE(jobs::fit(rings)) << jobs::fit(rings).error().message;
}

TEST(VerifyFit, LiesAreRefuted) {
  const std::string honest = jobs::fit(article()).value().json;
  const auto found = [&](const std::function<void(Json&)>& change) {
    Json document = Json::parse(honest);
    change(document);
    const auto report = verify::verify_fit_report({"r.json", document.dump()}, {});
    return !report || !report->findings.empty();
  };
  EXPECT_FALSE(found([](Json&) {}));
  const auto scaled = [&](const char* path) {
    return found([&](Json& d) {
      Json& value = d.at(path);
      value = value.get<double>() * 1.01 + 0.001;
    });
  };
  for (const char* path : {"/diameter_mm",
                           "/fit/hole_limits_um/1",
                           "/fit/shaft_limits_um/0",
                           "/rings/0/outer_diameter_mm",
                           "/rings/1/outer_diameter_mm",
                           "/rings/1/length_mm",
                           "/rings/1/youngs_mpa",
                           "/cases/0/interference_um",
                           "/cases/1/interference_um",
                           "/cases/2/interference_um",
                           "/cases/0/pressure_mpa",
                           "/cases/0/hub_outer_growth_um",
                           "/cases/0/shaft_bore_closure_um",
                           "/cases/0/touching_mm",
                           "/cases/0/seats/0/force_n",
                           "/cases/0/seats/0/pressure_mpa",
                           "/cases/0/seats/0/interference_um",
                           "/cases/0/press_force_n/0",
                           "/cases/0/press_force_n/1",
                           "/cases/0/shrink_difference_k",
                           "/cases/0/profile/3/z_mm",
                           "/cases/0/profile/4/z_mm",
                           "/cases/0/profile/0/shaft_um",
                           "/cases/0/profile/2/hub_bore_um",
                           "/cases/0/profile/0/bore_um",
                           "/friction/0",
                           "/clearance_um",
                           "/cases/0/stresses/1/largest_mises_mpa"})
    EXPECT_TRUE(scaled(path)) << path;
  for (const auto& lie :
       std::initializer_list<std::pair<const char*, Json>>{{"/fit/hole", "H7"},
                                                           {"/fit/shaft", "za8"},
                                                           {"/status", "proved"},
                                                           {"/cases/2/state", "full"},
                                                           {"/cases/2/state", "elastic"},
                                                           {"/cases/0/stresses/1/plastic_part", 2},
                                                           {"/cases/0/din_7190", 1},
                                                           {"/roughness_um", {1, 2}},
                                                           {"/friction", nullptr},
                                                           {"/rings/1/name", "hub"},
                                                           {"/format/name", "lekalo-fat"}})
    EXPECT_TRUE(found([&](Json& d) { d.at(lie.first) = lie.second; })) << lie.first;
  EXPECT_TRUE(found([](Json& d) { d["more"] = 1; }));
  EXPECT_TRUE(found([](Json& d) { d["cases"].erase(1); }));
  EXPECT_TRUE(found([](Json& d) {
    d["fit"] = nullptr;
    d["cases"][1] = d["cases"][2];
  })) << "the case between two stated interferences is their mean";
  EXPECT_TRUE(found([](Json& d) { d["cases"][0].erase("state"); }));
  EXPECT_TRUE(found([](Json& d) { d["cases"][0]["profile"].erase(5); }));
}

/// Returns what was made.
jobs::Fitted profiles_are_held(jobs::FitJob job, fit::Surface surface) {
  job.cylindrical = surface;
  job.table_as = "p.csv", job.drawing_as = "p.dxf", job.program_as = "p.ngc";
  const jobs::Fitted made = jobs::fit(job).value();
  const auto found = [&](const std::function<void(Json&)>& change, const std::string& program) {
    Json document = Json::parse(made.json);
    change(document);
    const auto report = verify::verify_fit_report(
        {"r.json", document.dump()}, {{"p.csv", made.table}, {"p.dxf", made.drawing}, {"p.ngc", program}});
    return !report || !report->findings.empty();
  };
  const std::string after_path = fmt::format("/correction/remains/{}/after_um", made.cases.size() / 2);
  EXPECT_FALSE(found([](Json&) {}, made.program));
  EXPECT_TRUE(found([](Json&) {}, made.program + "G0 X0\n"));
  for (const char* path : {"/correction/nominal_mm", "/correction/profile/0/diameter_mm",
                           "/correction/profile/3/z_mm", "/correction/profile/0/pressed_um",
                           "/correction/remains/0/before_um", "/correction/remains/0/interference_um",
                           "/correction/turning/feed_mm_per_min", "/correction/turning/spindle_rpm"})
    EXPECT_TRUE(found([&](Json& d) { d.at(path) = d.at(path).get<double>() + 1; }, made.program)) << path;
  for (const auto& lie :
       std::initializer_list<std::pair<const char*, Json>>{{"/correction/surface", "all"},
                                                           {"/correction/case", 7},
                                                           {"/correction/turning/control", "fanuc"},
                                                           {"/correction/turning/x", "radius"},
                                                           {"/correction/turning", nullptr},
                                                           {"/correction", nullptr},
                                                           {after_path.c_str(), 2},
                                                           {"/outputs/0/role", "program"}})
    EXPECT_TRUE(found([&](Json& d) { d.at(lie.first) = lie.second; }, made.program)) << lie.first;
  for (const fit::Surface other : {fit::Surface::outside, fit::Surface::bore, fit::Surface::seat})
    EXPECT_EQ(
        found([&](Json& d) { d["correction"]["surface"] = std::string(fit::name_of(other)); }, made.program),
        other != surface);
  return made;
}

TEST(VerifyFit, ProfilesAndTheirFilesAreHeldAgainstTheGrowths) {
  jobs::FitJob job = article();
  job.fit.clear(), job.diameter = 18, job.interference = 0.04;
  for (const fit::Surface surface : {fit::Surface::outside, fit::Surface::bore, fit::Surface::seat})
    (void)profiles_are_held(job, surface);
}

// The shaft of a named fit is turned from the middle of its limits, and smoothing takes nothing off that.
TEST(VerifyFit, SeatsAreTurnedFromTheShaftsOwnDiameter) {
  jobs::FitJob job = article();
  job.bore = 0;
  EXPECT_NEAR(profiles_are_held(job, fit::Surface::seat).corrected->nominal, 18.0735, 1e-9);
  job.fit.clear(), job.diameter = 18, job.interference = 0.05, job.roughness_um = {3, 4};
  EXPECT_NEAR(profiles_are_held(job, fit::Surface::seat).corrected->nominal, 18.05, 1e-9);
}

TEST(VerifyFit, ClosedFormIsTheCheckersOwn) {
  jobs::FitJob job = article();
  job.bore = 0;
  const std::string honest = jobs::fit(job).value().json;
  for (const char* key : {"pressure_mpa", "hub_outer_growth_um"})
    for (const std::size_t i : {0U, 1U, 2U}) {
      Json d = Json::parse(honest);
      Json& value = d["cases"][i]["din_7190"][key];
      value = value.get<double>() + 0.01;
      EXPECT_FALSE(judged(d.dump()).findings.empty()) << key << i;
    }
}

}  // namespace
}  // namespace lekalo::fit_report_test
