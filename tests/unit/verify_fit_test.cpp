// The checker and results of `lekalo fit`: those of many fits hold, and lies about every figure that it can
// make anew are refuted.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lekalo/jobs/fit.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"
#include "support/json_paths.hpp"
#include "support/prepared.hpp"
#include "verify/fit/rings.hpp"

namespace lekalo::verify_fit_test {
namespace {

using cases::each_path;
using cases::is_number;
using cases::Json;
using cases::one_of;

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

/// An elastic fit: its finite elements are quick, and nearly all of its figures are rechecked.
const cases::Prepared<Json> kElastic([] {
  jobs::FitJob job = article();
  job.material.yield_mpa = 2000;
  return Json::parse(jobs::fit(job).value().json);
});

/// A hub that yields and hardens, and a second one about it.
const cases::Prepared<Json> kHardening([] {
  jobs::FitJob job;
  job.diameter = 18, job.interference = 0.04, job.hub_outer = 30, job.length = 9, job.shaft_length = 18;
  job.material.name = "C45", job.material.yield_mpa = 300, job.material.hardening_mpa = 2000;
  job.shaft_material = job.material;
  job.shaft_material->yield_mpa = 900;
  job.more = {{40, 0.01}};
  return Json::parse(jobs::fit(job).value().json);
});

bool refuted(const Json& honest, const std::function<void(Json&)>& change) {
  Json document = honest;
  change(document);
  const auto report = verify::verify_fit_report({"r.json", document.dump()}, {});
  return !report || !report->findings.empty();
}

/// The sentence of what is refused, or the first finding.
std::string said(const Json& honest, const std::function<void(Json&)>& change) {
  Json document = honest;
  change(document);
  const auto report = verify::verify_fit_report({"r.json", document.dump()}, {});
  if (!report) return report.error().message;
  return report->findings.empty() ? "" : report->findings[0];
}

// Provenance and information, and what docs/formats.md says is not rechecked.
bool is_free(const std::string& path) {
  return one_of(path, {"/inputs", "/outputs", "/warnings", "/seed", "/work", "/version", "/run", "/units",
                       "/material", "middle_pressure_mpa", "/released/"});
}

/// Fields whose path begins with `of` (or, where that is empty, those outside of cases) cannot be absent, be
/// more or be another; returns how many there are.
std::size_t no_field_can_be_another(const Json& honest, const std::string& of) {
  std::size_t count = 0;
  each_path(honest, "", [&](const std::string& path) {
    if (one_of(path, {"/inputs", "/outputs", "/warnings", "/seed", "/work", "/run", "/version", "/units"}))
      return;
    if (of.empty() ? path.starts_with("/cases") : !path.starts_with(of)) return;
    const std::size_t slash = path.rfind('/');
    const std::string key = path.substr(slash + 1);
    const bool item = key.find_first_not_of("0123456789") == key.npos;
    const auto parent = [&](Json& d) -> Json& { return slash == 0 ? d : d.at(path.substr(0, slash)); };
    ++count;
    if (!item) {
      EXPECT_TRUE(refuted(honest, [&](Json& d) { parent(d).erase(key); })) << "without " << path;
      EXPECT_TRUE(refuted(honest, [&](Json& d) { parent(d)[key + "_"] = 0; })) << "more beside " << path;
    }
    const bool was_null = honest.at(path).is_null();
    for (const Json& other : {Json(), Json("x"), Json(true), Json(std::vector<Json>{})}) {
      if (is_free(path) && other.dump() == "\"x\"") continue;
      if (was_null && other.is_null()) continue;
      if (path == "/fit" && other.is_null()) continue;  // interferences that are stated
      if (one_of(path, {"/yields"}) && other.dump() == "true") continue;
      EXPECT_TRUE(refuted(honest, [&](Json& d) { d.at(path) = other; })) << path << " " << other.dump();
    }
  });
  return count;
}

TEST(VerifyFit, NoFieldCanBeAbsentOrAnother) {
  for (const Json* each : {&*kElastic, &*kHardening}) {
    EXPECT_FALSE(refuted(*each, [](Json&) {}));
    EXPECT_GT(no_field_can_be_another(*each, ""), 25U);
  }
}

TEST(VerifyFit, NoFieldOfTheFirstCaseCanBeAbsentOrAnother) {
  EXPECT_GT(no_field_can_be_another(*kElastic, "/cases/0/"), 50U);
}

TEST(VerifyFit, NoFieldOfTheLastCaseCanBeAbsentOrAnother) {
  EXPECT_GT(no_field_can_be_another(*kElastic, "/cases/2/"), 50U);
}

TEST(VerifyFit, NoFieldOfAHardeningCaseCanBeAbsentOrAnother) {
  EXPECT_GT(no_field_can_be_another(*kHardening, "/cases/"), 50U);
}

TEST(VerifyFit, NoFigureCanBeAnother) {
  for (const Json* each : {&*kElastic, &*kHardening}) {
    const Json& honest = *each;
    const bool all = each == &*kElastic;
    std::size_t count = 0;
    each_path(honest, "", [&](const std::string& path) {
      if (!is_number(honest.at(path)) || is_free(path)) return;
      // Of single rows what touches is held, and the means of what does not yield.
      const bool of_row = path.find("/profile/") != path.npos;
      if (path.find("/stresses/") != path.npos || path.find("yield_mpa") != path.npos) return;
      if (one_of(path, {"hardening_mpa", "/rings/0/expansion", "/44/bore", "/44/shaft"})) return;
      if (!all && (of_row || one_of(path, {"growth_um", "/poisson", "/expansion", "/youngs", "/length_mm",
                                           "/seats/1/interference"})))
        return;
      ++count;
      for (const double factor : {0.98, 1.02}) {
        if (of_row && factor > 1 && path.find("hub_bore_um") != path.npos && path.find("/44/") == path.npos)
          continue;
        EXPECT_TRUE(refuted(honest,
                            [&](Json& d) {
                              Json& value = d.at(path);
                              value = value.get<double>() * factor + (factor > 1 ? 0.01 : -0.01);
                            }))
            << path << " times " << factor;
      }
      if (!of_row) {
        EXPECT_TRUE(refuted(honest, [&](Json& d) { d.at(path) = -1; })) << path;
      }
    });
    EXPECT_GT(count, all ? 60U : 12U);
  }
}

TEST(VerifyFit, LiesAreRefuted) {
  for (const auto& lie :
       std::initializer_list<std::pair<const char*, Json>>{{"/fit/hole", "H7"},
                                                           {"/fit/hole", "h8"},
                                                           {"/fit/shaft", "za8"},
                                                           {"/fit/shaft", "Z8"},
                                                           {"/fit/shaft", "x"},
                                                           {"/status", "proved"},
                                                           {"/cases/2/state", "plastic"},
                                                           {"/cases/2/state", "full"},
                                                           {"/cases/2/state", "stiff"},
                                                           {"/cases/0/stresses/1/yields", true},
                                                           {"/cases/0/stresses/1/plastic_part", 0.5},
                                                           {"/cases/0/stresses/1/plastic_part", 2},
                                                           {"/cases/0/stresses/1/largest_mises_mpa", 2000.1},
                                                           {"/cases/0/stresses/1/middle_mises_mpa", 1999},
                                                           {"/roughness_um", {1, 2}},
                                                           {"/rings/0/name", "the hub"},
                                                           {"/rings/1/name", "hub"},
                                                           {"/format/name", "lekalo-fat"}})
    EXPECT_TRUE(refuted(*kElastic, [&](Json& d) { d.at(lie.first) = lie.second; })) << lie.first;
  EXPECT_TRUE(refuted(*kElastic, [](Json& d) { d["cases"].erase(1); }));
  EXPECT_TRUE(refuted(*kElastic, [](Json& d) {
    d["fit"] = nullptr;
    d["cases"][1] = d["cases"][2];
  })) << "the case between two stated interferences is their mean";
  EXPECT_TRUE(refuted(*kElastic, [](Json& d) {
    d["fit"] = nullptr;
    d["cases"][0] = d["cases"][2], d["cases"][1] = d["cases"][2];
  })) << "the first is the least";
  EXPECT_TRUE(refuted(*kElastic, [](Json& d) { d["cases"].push_back(d["cases"][2]); }));
  EXPECT_TRUE(refuted(*kHardening, [](Json& d) { d["cases"].push_back(d["cases"][0]); }));
  EXPECT_TRUE(refuted(*kHardening, [](Json& d) { d["cases"] = Json(std::vector<Json>{}); }));
  EXPECT_TRUE(
      refuted(*kElastic, [](Json& d) { d["cases"][0]["seats"].push_back(d["cases"][0]["seats"][0]); }));
  EXPECT_TRUE(
      refuted(*kElastic, [](Json& d) { d["cases"][0]["stresses"].push_back(d["cases"][0]["stresses"][1]); }));
  EXPECT_TRUE(refuted(*kElastic, [](Json& d) { d["friction"].push_back(1); }));
  for (const std::size_t row : {0U, 1U, 5U, 44U})
    EXPECT_TRUE(refuted(*kElastic, [&](Json& d) { d["cases"][0]["profile"].erase(row); })) << row;
}

TEST(VerifyFit, WhatYieldsGoesWithTheState) {
  EXPECT_EQ(kHardening->at("/cases/0/state").get<std::string>(), "plastic");
  const char* const state = "/cases/0/state";
  EXPECT_TRUE(refuted(*kHardening, [&](Json& d) { d.at(state) = "elastic"; }));
  EXPECT_FALSE(refuted(*kHardening, [&](Json& d) { d.at(state) = "full"; })) << "it hardens";
  // Stresses above the yield stress are there where the metal yields and hardens alone.
  EXPECT_FALSE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/1/largest_mises_mpa") = 1000; }));
  EXPECT_TRUE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/0/largest_mises_mpa") = 1000; }));
  EXPECT_FALSE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/0/largest_mises_mpa") = 900; }));
  EXPECT_TRUE(
      refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/0/largest_mises_mpa") = 900.00001; }));
  EXPECT_TRUE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/0/plastic_part") = 0.1; }));
  for (const double part : {0.0, 1.0})
    EXPECT_FALSE(refuted(*kHardening, [&](Json& d) { d.at("/cases/0/stresses/1/plastic_part") = part; }))
        << part;
  for (const double part : {-0.001, 1.001})
    EXPECT_TRUE(refuted(*kHardening, [&](Json& d) { d.at("/cases/0/stresses/1/plastic_part") = part; }))
        << part;
  EXPECT_TRUE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/1/middle_mises_mpa") = -1; }));
  EXPECT_FALSE(refuted(*kHardening, [](Json& d) { d.at("/cases/0/stresses/1/middle_mises_mpa") = 0; }));
}

TEST(VerifyFit, RingsAreThoseOfAFit) {
  for (const auto& [path, value] :
       std::initializer_list<std::pair<const char*, double>>{{"/rings/0/inner_diameter_mm", -1},
                                                             {"/rings/0/inner_diameter_mm", 18},
                                                             {"/rings/1/outer_diameter_mm", 18},
                                                             {"/rings/1/length_mm", 0},
                                                             {"/rings/1/youngs_mpa", 0},
                                                             {"/rings/1/poisson", -0.1},
                                                             {"/rings/1/poisson", 0.5},
                                                             {"/rings/1/yield_mpa", 0},
                                                             {"/rings/1/hardening_mpa", -1},
                                                             {"/rings/1/expansion_per_k", -1}})
    EXPECT_NE(
        said(*kElastic, [&, at = path, to = value](Json& d) { d.at(at) = to; }).find("is no ring of a fit"),
        std::string::npos)
        << path;
  EXPECT_NE(said(*kElastic, [](Json& d) { d["rings"].erase(1); }).find("fewer than two"), std::string::npos);
  EXPECT_NE(said(*kElastic, [](Json& d) { d.at("/rings/1/length_mm") = 54.1; }).find("longer than the shaft"),
            std::string::npos);
  EXPECT_NE(said(*kHardening, [](Json& d) { d.at("/rings/2/length_mm") = 8; }).find("as long as the hub"),
            std::string::npos);
  EXPECT_NE(said(*kElastic, [](Json& d) { d.at("/diameter_mm") = 18.001; }).find("not that of the shaft"),
            std::string::npos);
  EXPECT_NE(said(*kHardening, [](Json& d) { d.at("/rings/2/name") = "the hub"; }).find("ring 2"),
            std::string::npos);
  for (const char* path : {"/rings/1/poisson", "/rings/1/hardening_mpa", "/rings/1/expansion_per_k"})
    EXPECT_EQ(said(*kElastic, [&](Json& d) { d.at(path) = 0; }).find("is no ring of a fit"),
              std::string::npos)
        << path;
}

// A hub from 1 mm beside the left end of its shaft on.
const cases::Prepared<Json> kBesideAnEnd([] {
  jobs::FitJob job = article();
  job.fit.clear(), job.diameter = 18, job.interference = 0.03, job.from_end = 1;
  job.material.yield_mpa = 2000;
  return Json::parse(jobs::fit(job).value().json);
});

TEST(VerifyFit, NoHubHangsOverAnEnd) {
  ASSERT_FALSE(refuted(*kBesideAnEnd, [](Json&) {}));
  const double middle = kBesideAnEnd->at("/rings/0/middle_mm").get<double>();
  const auto hangs = [&](double by) {
    return said(*kBesideAnEnd, [&](Json& d) {
             d.at("/rings/0/middle_mm") = middle * (1 + by / std::abs(middle));
           }).find("hangs over an end") != std::string::npos;
  };
  EXPECT_TRUE(hangs(1.001));
  EXPECT_FALSE(hangs(0.999));
}

// A hub that ends within an element bears no mean there, and nothing is read beyond it.
TEST(VerifyFit, MeansAreOfWholeElements) {
  const auto without = [](const Json& honest) {
    return said(honest, [&](Json& d) {
      d.at("/rings/1/length_mm") = 17.9;
      for (std::size_t i = 0; i < d["cases"].size(); ++i)
        for (std::size_t row = 0; row < d["cases"][i]["profile"].size(); ++row) {
          Json& r = d["cases"][i]["profile"][row];
          if (std::abs(std::abs(r["z_mm"].get<double>()) - 9) < 1e-5)
            r["hub_um"] = nullptr, r["hub_bore_um"] = nullptr;
        }
    });
  };
  EXPECT_NE(without(*kElastic), "");
  EXPECT_NE(without(*kBesideAnEnd), "");
}

// The sentence says why, so that no condition stands for another.
TEST(VerifyFit, EveryReasonIsSaid) {
  const auto says = [](const Json& honest, const std::string& path, const Json& value, const char* wanted) {
    const std::string sentence = said(honest, [&](Json& d) { d.at(path) = value; });
    return sentence.find(wanted) != std::string::npos ? "" : path + ": " + sentence;
  };
  for (const char* hole : {"x8", "h8", "a11", "H30", ""})
    EXPECT_EQ(says(*kElastic, "/fit/hole", hole, "has no limits"), "");
  for (const char* shaft : {"x", "H7", "Z8", "z30", ""})
    EXPECT_EQ(says(*kElastic, "/fit/shaft", shaft, "has no limits"), "");
  EXPECT_EQ(says(*kElastic, "/fit/shaft", "a11", "the limits of"), "");
  EXPECT_EQ(says(*kElastic, "/cases/0/interference_um", 0, "interference_um is not above 0"), "");
  EXPECT_EQ(says(*kHardening, "/cases/0/seats/1/interference_um", 0, "interference_um is not above 0"), "");
  EXPECT_EQ(says(*kElastic, "/fit/hole_limits_um", nullptr, "the limits of"), "");
  EXPECT_EQ(says(*kElastic, "/fit/shaft_limits_um", nullptr, "the limits of"), "");
}

// A ring that yields and does not harden stays below its yield stress; no ring that does not harden is
// plastic all through in equilibrium with more.
TEST(VerifyFit, YieldAndHardeningGoTogether) {
  const auto soft = [](std::size_t hardens, double largest, const char* state) {
    return said(*kHardening, [&](Json& d) {
      for (std::size_t i = 0; i < 3; ++i)
        if (i != hardens) d["rings"][i]["hardening_mpa"] = 0;
      Json& stress = d.at("/cases/0/stresses/1");
      stress["largest_mises_mpa"] = largest, stress["middle_mises_mpa"] = 100;
      d.at("/cases/0/state") = state;
    });
  };
  const char *const above = "above the yield stress", *const goes =
                                                          "does not go with what yields and hardens";
  EXPECT_NE(soft(3, 300.001, "plastic").find(above), std::string::npos);
  EXPECT_EQ(soft(3, 300, "plastic").find(above), std::string::npos);
  EXPECT_EQ(soft(1, 300.001, "plastic").find(above), std::string::npos);
  EXPECT_NE(soft(3, 300, "full").find(goes), std::string::npos);
  for (const std::size_t ring : {0U, 1U, 2U})
    EXPECT_EQ(soft(ring, 300, "full").find(goes), std::string::npos);
  EXPECT_NE(soft(3, 300, "elastic").find(goes), std::string::npos);
}

// A hub that does not expand cannot be shrunk on, whatever clearance is wished.
TEST(VerifyFit, ShrinkingTakesAHubThatExpands) {
  const auto shrunk = [](double expansion, bool known, double off) {
    return said(*kElastic, [&](Json& d) {
             d.at("/rings/1/expansion_per_k") = expansion;
             for (std::size_t i = 0; i < 3; ++i) {
               Json& value = d["cases"][i]["shrink_difference_k"];
               if (known)
                 value = value.get<double>() + off;
               else
                 value = nullptr;
             }
           }).find("shrink_difference_k") != std::string::npos;
  };
  const double expands = kElastic->at("/rings/1/expansion_per_k").get<double>();
  EXPECT_FALSE(shrunk(expands, true, 0));
  EXPECT_TRUE(shrunk(expands, true, 1.5e-5));
  EXPECT_TRUE(shrunk(expands, false, 0));
  EXPECT_FALSE(shrunk(0, false, 0));
  EXPECT_TRUE(shrunk(0, true, 0));
}

TEST(VerifyFit, ProfilesHaveRowsOfWholeElements) {
  const auto of_rows = [](std::size_t count) {
    return said(*kElastic, [&](Json& d) {
             Json& rows = d.at("/cases/0/profile");
             while (rows.size() > count) rows.erase(rows.size() - 1);
           }).find("has not rows of whole elements") != std::string::npos;
  };
  for (const std::size_t count : {0U, 1U, 2U, 4U}) EXPECT_TRUE(of_rows(count)) << count;
  for (const std::size_t count : {3U, 5U}) EXPECT_FALSE(of_rows(count)) << count;
}

TEST(VerifyFit, EveryRuleOfRowsIsSaid) {
  const auto says = [](const Json& honest, const char* wanted, const std::function<void(Json&)>& change) {
    const std::string sentence = said(honest, [&](Json& d) { change(d.at("/cases/0/profile")); });
    EXPECT_NE(sentence.find(wanted), std::string::npos) << sentence;
  };
  for (const Json* each : {&*kElastic, &*kBesideAnEnd})
    says(*each, "does not go from the middle", [](Json& rows) { rows.erase(1), rows.erase(0); });
  says(*kElastic, "to the right end of the shaft",
       [](Json& rows) { rows.erase(rows.size() - 1), rows.erase(rows.size() - 1); });
  says(*kBesideAnEnd, "has no row in the middle of the hub", [](Json& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i]["z_mm"].get<double>() == 0) rows[i]["z_mm"] = 1e-9;
  });
  says(*kElastic, "is not in order",
       [](Json& rows) { rows[1]["z_mm"] = rows[0]["z_mm"], rows[2]["z_mm"] = rows[0]["z_mm"]; });
  says(*kElastic, "not in the middle of its neighbours",
       [](Json& rows) { rows[1]["z_mm"] = rows[1]["z_mm"].get<double>() + 1e-5; });
  for (const char* key : {"shaft_um", "hub_um", "hub_bore_um", "bore_um"})
    says(*kElastic, "a row of other surfaces than there are", [&](Json& rows) { rows[2][key] = nullptr; });
}

// An element touches where its three rows do.
TEST(VerifyFit, TouchingLengthsAreOfWholeElements) {
  const auto opened = [](double z, std::size_t more) {
    return said(*kElastic, [&](Json& d) {
             Json& rows = d.at("/cases/0/profile");
             for (std::size_t i = 0; i + more < rows.size(); ++i)
               if (rows[i]["z_mm"].get<double>() == z) {
                 Json& bore = rows[i + more]["hub_bore_um"];
                 bore = bore.get<double>() + 1;
                 return;
               }
             ADD_FAILURE() << "no row at " << z;
           }).find("touching_mm") != std::string::npos;
  };
  EXPECT_TRUE(opened(0, 0)) << "the first row";
  EXPECT_TRUE(opened(0, 1)) << "between two elements' ends";
  EXPECT_TRUE(opened(9, 0)) << "the last row of the hub";
}

struct Turned {
  fit::Surface surface = fit::Surface::outside;
  jobs::Fitted made;
};

Turned turned(jobs::FitJob job, fit::Surface surface, bool files = true) {
  job.cylindrical = surface;
  if (files) job.table_as = "p.csv", job.drawing_as = "p.dxf", job.program_as = "p.ngc";
  return {surface, jobs::fit(job).value()};
}

jobs::FitJob stated(double interference) {
  jobs::FitJob job = article();
  job.fit.clear(), job.diameter = 18, job.interference = interference;
  return job;
}

const cases::Prepared<std::vector<Turned>> kTurned([] {
  std::vector<Turned> all;
  for (const fit::Surface surface : {fit::Surface::outside, fit::Surface::bore, fit::Surface::seat})
    all.push_back(turned(stated(0.04), surface));
  return all;
});
const cases::Prepared<std::vector<Turned>> kTurnedBesideAnEnd([] {
  jobs::FitJob job = stated(0.03);
  job.from_end = 1;
  return std::vector{turned(job, fit::Surface::bore), turned(job, fit::Surface::seat)};
});
const cases::Prepared<Turned> kSeatOfANamedFit([] {
  jobs::FitJob job = article();
  job.bore = 0;
  return turned(job, fit::Surface::seat);
});
const cases::Prepared<Turned> kRoughSeat([] {
  jobs::FitJob job = stated(0.05);
  job.bore = 0, job.roughness_um = {3, 4};
  return turned(job, fit::Surface::seat);
});

const cases::Prepared<Turned> kFanuc([] {
  jobs::FitJob job = stated(0.04);
  job.turning.control = fit::Lathe::fanuc, job.turning.radius = true;
  return turned(job, fit::Surface::outside);
});
// The shaft ends so little beyond the hub that rows there have one written place.
const cases::Prepared<Turned> kHardlyLonger([] {
  jobs::FitJob job = stated(0.04);
  job.shaft_length = job.length + 0.0004;
  return turned(job, fit::Surface::bore);
});
/// Corrections without files: nothing else says what the profile is.
const cases::Prepared<std::vector<Turned>> kTurnedAlone([] {
  std::vector<Turned> all;
  for (const fit::Surface surface : {fit::Surface::outside, fit::Surface::bore, fit::Surface::seat})
    all.push_back(turned(stated(0.04), surface, false));
  return all;
});

/// What is said of a changed result with the files it has.
std::string said_of(const Turned& turned, const std::function<void(Json&)>& change) {
  Json document = Json::parse(turned.made.json);
  change(document);
  std::vector<verify::Document> files;
  if (!turned.made.table.empty())
    files = {{"p.csv", turned.made.table}, {"p.dxf", turned.made.drawing}, {"p.ngc", turned.made.program}};
  const auto report = verify::verify_fit_report({"r.json", document.dump()}, files);
  if (!report) return report.error().message;
  std::string all;
  for (const std::string& finding : report->findings) all += finding + "\n";
  return all;
}

TEST(VerifyFit, ProfilesWithoutFilesAreHeldAgainstTheGrowths) {
  for (const Turned& each : *kTurnedAlone) {
    EXPECT_EQ(said_of(each, [](Json&) {}), "");
    for (const char* key : {"diameter_mm", "z_mm"})
      for (const double by : {-0.01, 0.01}) {
        const std::string sentence = said_of(each, [&](Json& d) {
          Json& value = d["correction"]["profile"][3][key];
          value = value.get<double>() + by;
        });
        EXPECT_NE(sentence.find("does not take off what the surface grows"), std::string::npos) << sentence;
      }
  }
}

TEST(VerifyFit, WhatRemainsIsACylinderAtTheMeanInterference) {
  const auto no_cylinder = [](const Turned& turned, std::size_t of, double after) {
    return said_of(turned, [&](Json& d) {
             d["correction"]["remains"][of]["before_um"] = 2,
             d["correction"]["remains"][of]["after_um"] = after;
           }).find("after_um is no cylinder") != std::string::npos;
  };
  for (const double after : {-0.1, 1.01, 1.5}) EXPECT_TRUE(no_cylinder(kTurned->front(), 0, after)) << after;
  for (const double after : {0.0, 0.99}) EXPECT_FALSE(no_cylinder(kTurned->front(), 0, after)) << after;
  EXPECT_TRUE(no_cylinder(*kSeatOfANamedFit, 1, 5));
  for (const std::size_t end : {0U, 2U}) EXPECT_FALSE(no_cylinder(*kSeatOfANamedFit, end, 5));
}

TEST(VerifyFit, EveryRuleOfCorrectionsIsSaid) {
  const auto says = [](const Turned& turned, const char* wanted, const std::function<void(Json&)>& change) {
    const std::string sentence = said_of(turned, change);
    EXPECT_NE(sentence.find(wanted), std::string::npos) << sentence;
  };
  says(*kSeatOfANamedFit, "of a bore that is not there",
       [](Json& d) { d["correction"]["surface"] = "bore"; });
  says(*kSeatOfANamedFit, "of another case", [](Json& d) { d["correction"]["case"] = 0; });
  says(*kSeatOfANamedFit, "has not one of each case",
       [](Json& d) { d["correction"]["remains"].push_back(d["correction"]["remains"][0]); });
  says(*kSeatOfANamedFit, "has not one of each case", [](Json& d) { d["correction"]["remains"].erase(2); });
  EXPECT_EQ(said_of(*kFanuc, [](Json&) {}), "");
  EXPECT_EQ(said_of(*kHardlyLonger, [](Json&) {}), "");
  const Json longer = Json::parse(kHardlyLonger->made.json);
  EXPECT_LT(longer.at("/correction/profile").size(), longer.at("/cases/0/profile").size());
  jobs::FitJob job = stated(0.04);
  job.shaft_length = job.length + 0.0006;
  EXPECT_EQ(said_of(turned(job, fit::Surface::bore), [](Json&) {}), "")
      << "it varies where it is not written";
  for (const Turned* each : {&*kFanuc, &kTurned->front()})
    for (const char* key : {"control", "x"})
      says(*each, "is of no such control, or X", [&](Json& d) { d["correction"]["turning"][key] = "haas"; });
  says(*kFanuc, "no such file is one of a correction", [](Json& d) { d["outputs"][1]["role"] = "sketch"; });
}

void expect_held(const Turned& turned) {
  const jobs::Fitted& made = turned.made;
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
        other != turned.surface);
}

TEST(VerifyFit, ProfilesAndTheirFilesAreHeldAgainstTheGrowths) {
  for (const Turned& each : *kTurned) expect_held(each);
}

TEST(VerifyFit, HubsBesideAnEndAreRecheckedLikeOthers) {
  for (const Turned& each : *kTurnedBesideAnEnd) {
    expect_held(each);
    for (const char* path : {"/rings/0/middle_mm", "/rings/1/middle_mm", "/cases/0/touching_mm",
                             "/cases/0/profile/0/bore_um", "/cases/0/hub_outer_growth_um"}) {
      Json d = Json::parse(each.made.json);
      d.at(path) = d.at(path).get<double>() + 1;
      const auto report = verify::verify_fit_report(
          {"r.json", d.dump()},
          {{"p.csv", each.made.table}, {"p.dxf", each.made.drawing}, {"p.ngc", each.made.program}});
      EXPECT_TRUE(!report || !report->findings.empty()) << path;
    }
  }
}

// The shaft of a named fit is turned from the middle of its limits, and smoothing takes nothing off that.
TEST(VerifyFit, SeatsAreTurnedFromTheShaftsOwnDiameter) {
  EXPECT_NEAR(kSeatOfANamedFit->made.corrected->nominal, 18.0735, 1e-9);
  expect_held(*kSeatOfANamedFit);
}

TEST(VerifyFit, SeatsOfAStatedInterferenceAreTurnedFromTheBore) {
  EXPECT_NEAR(kRoughSeat->made.corrected->nominal, 18.05, 1e-9);
  expect_held(*kRoughSeat);
}

/// A solid shaft in a hub of one metal.
std::vector<verify::CheckedRing> one_metal(double outer, double shaft_yield = 900) {
  return {{0, 20, 60, 200000, 0.3, shaft_yield, 0, 1e-5}, {20, outer, 20, 200000, 0.3, 300, 0, 1e-5}};
}

// The form of DIN 7190 holds for two rings; where the hub yields, for one metal without hardening and a solid
// shaft alone.
TEST(VerifyFit, TheClosedFormHoldsWhereItsConditionsDo) {
  using verify::checked_din;
  const double strength = 2 / std::sqrt(3.0) * 300, begins = 20 * strength / 200000;  // yielding, mm
  const auto elastic_fit = checked_din(one_metal(40), 0.99 * begins);
  ASSERT_TRUE(elastic_fit);
  EXPECT_FALSE(elastic_fit->yields);
  EXPECT_NEAR(elastic_fit->pressure, 0.99 * strength * 3 / 8, 1e-9);
  EXPECT_NEAR(elastic_fit->growth, 0.99 * begins / 2, 1e-12);
  const auto plastic = checked_din(one_metal(40), 2 * begins);
  ASSERT_TRUE(plastic);
  EXPECT_TRUE(plastic->yields);
  EXPECT_NEAR(plastic->pressure, strength / 2 * (1 + std::log(2.0) - 0.5), 1e-9);
  EXPECT_NEAR(plastic->growth, begins, 1e-12);
  // The hub is plastic all through at the square of its ratio.
  EXPECT_TRUE(checked_din(one_metal(40), 3.999 * begins));
  EXPECT_FALSE(checked_din(one_metal(40), 4.001 * begins));
  // A thick hub bears no more than its strength.
  EXPECT_NEAR(checked_din(one_metal(100), 10 * begins)->pressure, strength, 1e-9);
  EXPECT_LT(checked_din(one_metal(100), 2 * begins)->pressure, strength);
  const auto changed = [&](const std::function<void(std::vector<verify::CheckedRing>&)>& change,
                           double interference) {
    std::vector<verify::CheckedRing> rings = one_metal(40);
    change(rings);
    return checked_din(rings, interference);
  };
  for (const double interference : {0.5 * begins, 2 * begins}) {
    const bool is_elastic = interference < begins;
    EXPECT_EQ(changed([](auto& r) { r[0].youngs *= 1.5; }, interference).has_value(), is_elastic);
    EXPECT_EQ(changed([](auto& r) { r[0].poisson = 0.25; }, interference).has_value(), is_elastic);
    EXPECT_EQ(changed([](auto& r) { r[0].inner = 5; }, interference).has_value(), is_elastic);
    EXPECT_EQ(changed([](auto& r) { r[1].hardening = 100; }, interference).has_value(), is_elastic);
    EXPECT_FALSE(changed([](auto& r) { r.push_back(r[1]); }, interference));
    EXPECT_FALSE(changed([](auto& r) { r.pop_back(); }, interference));
  }
  // The shaft has to bear the pressure; one with a bore bears less.
  const double pressure = elastic_fit->pressure;
  EXPECT_TRUE(checked_din(one_metal(40, pressure + 0.001), 0.99 * begins));
  EXPECT_FALSE(checked_din(one_metal(40, pressure - 0.001), 0.99 * begins));
  const auto bored = [&](double yield) {
    return changed([&](auto& r) { r[0].inner = 10, r[0].yield = yield; }, 0.5 * begins);
  };
  const double of_bored = bored(900)->pressure, bears = of_bored * std::sqrt(3.0) / 0.75;
  EXPECT_TRUE(bored(bears * 1.0001));
  EXPECT_FALSE(bored(bears * 0.9999));
}

TEST(VerifyFit, ClosedFormIsTheCheckersOwn) {
  jobs::FitJob job = article();
  job.bore = 0, job.material.yield_mpa = 2000;
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
}  // namespace lekalo::verify_fit_test
