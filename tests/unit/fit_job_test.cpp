// The job of `lekalo fit`: its cases, and one sentence for what is none.

#include "lekalo/jobs/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/json.hpp"

namespace lekalo::fit_job_test {
namespace {

using cases::Json;

jobs::FitJob article() {
  jobs::FitJob job;
  job.fit = "18H8/z8";
  job.hub_outer = 36, job.length = 18, job.shaft_length = 54;
  job.material.name = "C45";
  return job;
}

TEST(FitJob, CasesAreTheEndsAndTheMiddleOfTheFit) {
  const jobs::Fitted made = jobs::fit(article()).value();
  ASSERT_EQ(made.cases.size(), 3U);
  EXPECT_EQ(made.cases[0].interference, 0.033);
  EXPECT_EQ(made.cases[1].interference, 0.060);
  EXPECT_EQ(made.cases[2].interference, 0.087);
  EXPECT_EQ(made.cases[2].pressed.state, fit::State::plastic);
  EXPECT_EQ(made.assembly.rings[0].material.yield_mpa, 305) << "a solid section of 18 mm";
  EXPECT_EQ(made.assembly.rings[1].material.yield_mpa, 340) << "a wall of 9 mm";
}

// The window of the source: 40 to 121 um at 18 mm, C45 with 340 MPa.
TEST(FitJob, TheWindowOfTheSourceIsElasticPlastic) {
  jobs::FitJob job = article();
  job.fit.clear();
  job.diameter = 18;
  job.material.yield_mpa = 340;
  for (const auto& [um, pressure, growth] : {std::tuple{40.0, 174.4, 20.12}, {121.0, 262.5, 62.53}}) {
    job.interference = um / 1000;
    const jobs::Fitted made = jobs::fit(job).value();
    ASSERT_EQ(made.cases.size(), 1U);
    const fit::Pressed& p = made.cases[0].pressed;
    EXPECT_EQ(p.state, fit::State::plastic);
    EXPECT_NEAR(p.seats[0].pressure_mpa, pressure, 0.1);
    EXPECT_NEAR(1000 * p.rings[1].outer[0].diameter, growth, 0.1);
    EXPECT_NEAR(p.seats[0].pressure_mpa, made.cases[0].din->pressure_mpa, 0.05 * pressure);
  }
}

TEST(FitJob, SmoothingTakesAnInterval) {
  jobs::FitJob job = article();
  job.roughness_um = {4, 6};
  const jobs::Fitted made = jobs::fit(job).value();
  EXPECT_NEAR(made.cases[0].interference, 0.033 - 0.008, 1e-12);
  EXPECT_NEAR(made.cases[2].interference, 0.087 - 0.004, 1e-12);
}

TEST(FitJob, TheDocumentHasTheFieldsThatAreAskedFor) {
  const Json d = Json::parse(jobs::fit(article()).value().json);
  EXPECT_EQ(d["format"]["name"], "lekalo-fit");
  const Json& one = d["cases"][2];
  for (const char* key :
       {"interference_um", "state", "pressure_mpa", "hub_outer_growth_um", "shaft_bore_closure_um"})
    EXPECT_TRUE(one.contains(key)) << key;
  EXPECT_TRUE(one["shaft_bore_closure_um"].is_null()) << "a solid shaft";
  EXPECT_GT(one["profile"].size(), 20U);
  for (const char* key : {"z_mm", "shaft_um", "hub_um"}) EXPECT_TRUE(one["profile"][0].contains(key)) << key;
  EXPECT_NEAR(one["hub_outer_growth_um"].get<double>(), 44.05, 0.05);
}

TEST(FitJob, WhatIsNoneIsRefusedInOneSentence) {
  const auto says = [](const std::function<void(jobs::FitJob&)>& change) {
    jobs::FitJob job = article();
    change(job);
    const auto made = jobs::fit(job);
    if (made) return std::string("made");
    EXPECT_EQ(made.error().code, ErrorCode::bad_input);
    return made.error().message;
  };
  const auto stated = [](double mm) {
    return [mm](jobs::FitJob& j) { j.fit.clear(), j.diameter = 18, j.interference = mm; };
  };
  EXPECT_NE(says(stated(0)).find("is 0 um, and has to be above 0"), std::string::npos);
  EXPECT_NE(says(stated(-0.01)).find("is -10 um, and has to be above 0"), std::string::npos);
  EXPECT_NE(says(stated(0.2)).find("does not harden"), std::string::npos) << says(stated(0.2));
  EXPECT_NE(says([](auto& j) { j.fit = "18H7/h6"; }).find("choose a tighter fit"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.roughness_um = {30, 30}; }).find("smoothing"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.bore = 18; }).find("not below its diameter of 18 mm"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.hub_outer = 18; }).find("not above its bore of 18 mm"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.shaft_length = 10; }).find("has to be as long"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.material.name = "C46"; }).find("there are C45, 6061-T6"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.material.name = ""; }).find("needs --youngs"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.hub_outer = 700; }).find("no yield stress is known"), std::string::npos);
  EXPECT_NE(says([](auto& j) { j.more = {{50, 0}}; }).find("ring of 50 mm"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::fit_job_test
