#include "lekalo/jobs/locate_solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string_view>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/verify.hpp"
#include "support/json.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"

namespace lekalo::jobs::jobs_locate_solid_test {
namespace {

using locate::SolidFreedom;

/// A block of 40 x 30 x 20 in one with 3 mm more at both ends of x and 2 mm elsewhere, as text.
SolidLocateJob block_job() {
  SolidLocateJob job;
  job.part = {"folder/part.stl", solid_files::stl_text(cases::block({-20, -15, -10}, {20, 15, 10}))};
  job.blank = {"casting.obj", solid_files::obj(cases::block({-22, -17, -13}, {24, 17, 11}))};
  job.options.method = SolidMethod::climb;
  return job;
}

/// Bodies of 20 faces, the blank's 2 mm farther out; the part is turned by up to 3 degrees.
SolidLocateJob convex_job(std::uint64_t seed = 3) {
  Random random(seed);
  const cases::SolidCase made = cases::convex_in_convex(random, 20, 2);
  SolidLocateJob job;
  job.part = {"part.stl", solid_files::stl_text(made.part)};
  job.blank = {"casting.ply", solid_files::ply<double>(made.blank, solid_files::PlyForm::little)};
  return job;
}

LocatedSolid made(const SolidLocateJob& job) {
  Result<LocatedSolid> result = locate_solid(job);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  return result ? std::move(*result) : LocatedSolid{};
}

Error refusal(const SolidLocateJob& job) {
  const Result<LocatedSolid> result = locate_solid(job);
  EXPECT_FALSE(result.has_value());
  return result ? Error{} : result.error();
}

bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

bool warns(const LocatedSolid& located, const std::string& what) {
  const auto& warnings = located.document.warnings;
  return std::any_of(warnings.begin(), warnings.end(), [&](const auto& one) { return says(one, what); });
}

/// The verdict of `lekalo verify` on the result, from the files of the job.
verify::Verdict verdict(const SolidLocateJob& job, const LocatedSolid& located) {
  const Result<Verified> done =
      verify({"result.json", located.result},
             [&](const std::string& role, const std::string&) -> Result<std::optional<File>> {
               if (role == "certificate") return File{"c.json", located.certificate};
               if (role == "part") return job.part;
               if (role == "start") return job.start;
               if (role == "points") return job.blank;
               if (role == "blank" && !located.mesh.empty()) return File{job.outputs.mesh, located.mesh};
               if (role == "nc") return job.program;
               if (role == "NC program") return File{"o.nc", located.program};
               if (role == "features") return job.features;
               if (role == "work offset") return File{"lines", located.offset};
               return role == "blank" ? std::optional(job.blank) : std::nullopt;
             });
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
  return done ? done->report.verdict : verify::Verdict::refuted;
}

/// A job about z whose program drills and mills the block.
SolidLocateJob program_job() {
  SolidLocateJob job = block_job();
  job.options.freedom = SolidFreedom::c_xyz;
  job.program =
      File{"p.nc",
           "G21 G90 G17 G54\nT1 M6\nG0 X-20. Y-15.\nG43 H1 Z30.\nG1 Z9. F200.\nG2 X0. Y-15. I10. Z8.\n"
           "G98 G81 X1. Y2. Z-3. R12.\nG80\nG0 Z30.\nM30\n"};
  job.outputs.program = "o.nc";
  return job;
}

/// The angle of a rotation in degrees.
double angle(const locate::SolidPose& pose) {
  const auto [w, x, y, z] = pose.quaternion;
  return 2 * std::atan2(std::hypot(x, y, z), std::abs(w)) * kDegreesPerRadian;
}

TEST(JobsLocateSolid, BytesGoInAndACheckedDocumentComesOut) {
  const SolidLocateJob job = block_job();
  const LocatedSolid located = made(job);
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(located.result, io::result_json(located.document));
  EXPECT_EQ(json["status"], "unproved");
  EXPECT_EQ(json["method"], "climb");
  EXPECT_EQ(json["freedom"], "six");
  EXPECT_EQ(json["inside"], true);
  EXPECT_TRUE(json["upper_bound"].is_null());
  EXPECT_TRUE(json["certificate"].is_null());
  EXPECT_NEAR(json["clearance"], 2, 1e-3);
  EXPECT_LE(json["clearance"], 2.0);
  EXPECT_EQ(json["inputs"][0]["path"], "folder/part.stl");
  EXPECT_EQ(json["inputs"][0]["triangles"], 12);
  EXPECT_EQ(json["inputs"][1]["sha256"], io::sha256(job.blank.bytes));
  EXPECT_EQ(json["inputs"][1]["units"], "mm");
  EXPECT_TRUE(located.holds());
  EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
}

TEST(JobsLocateSolid, MethodsKeptForComparisonStayInTheWindowAndProveNothing) {
  SolidLocateJob job = convex_job();
  for (const SolidFreedom freedom : {SolidFreedom::xyz, SolidFreedom::c_xyz, SolidFreedom::six})
    for (const SolidMethod method : {SolidMethod::icp, SolidMethod::axes}) {
      job.options.freedom = freedom, job.options.method = method;
      job.options.shift = 0.5, job.options.tilt_deg = 1;
      const LocatedSolid located = made(job);
      const auto json = cases::Json::parse(located.result);
      EXPECT_EQ(json["method"], name_of(method));
      EXPECT_EQ(json["status"], "unproved");
      EXPECT_TRUE(json["upper_bound"].is_null());
      EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
    }
}

TEST(JobsLocateSolid, TheFieldsOfTheResultStandInTheirOrder) {
  const auto json = cases::Json::parse(made(block_job()).result);
  EXPECT_EQ(json.keys(), (std::vector<std::string>{"format",
                                                   "status",
                                                   "units",
                                                   "inputs",
                                                   "warnings",
                                                   "seed",
                                                   "work",
                                                   "version",
                                                   "method",
                                                   "freedom",
                                                   "start",
                                                   "window",
                                                   "symmetry",
                                                   "quaternion",
                                                   "x",
                                                   "y",
                                                   "z",
                                                   "inside",
                                                   "clearance",
                                                   "upper_bound",
                                                   "gap",
                                                   "min_allowance",
                                                   "shortfall",
                                                   "demands",
                                                   "contacts",
                                                   "scan",
                                                   "unknown_area_mm2",
                                                   "certificate",
                                                   "certificate_file",
                                                   "nc",
                                                   "offset",
                                                   "run"}));
}

TEST(JobsLocateSolid, AProgramOfThreeAxesIsMovedAndChecked) {
  SolidLocateJob job = program_job();
  for (const nc::RewriteMode mode : {nc::RewriteMode::coordinates, nc::RewriteMode::offset}) {
    job.options.rewrite.mode = mode;
    const LocatedSolid located = made(job);
    ASSERT_TRUE(located.document.nc) << located.result;
    EXPECT_TRUE(located.holds());
    EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
    EXPECT_LE(located.document.nc->clearance, *located.document.clearance - located.document.nc->rounding_mm);
    EXPECT_TRUE(says(located.program, "THE PART LIES AT X ")) << located.program;
    LocatedSolid other = located;
    other.program.replace(other.program.find("Z", other.program.find("G43")), 1, "Z1");
    EXPECT_EQ(verdict(job, other), verify::Verdict::refuted);
  }
}

TEST(JobsLocateSolid, AProgramIsWithheldWhereThreeAxesCannotFollow) {
  SolidLocateJob job = program_job();
  job.options.min_allowance = 3;
  EXPECT_TRUE(warns(made(job), "no NC program was written, because the allowance is not met"));
  job.options.min_allowance = 0, job.options.freedom = SolidFreedom::six;
  // A blank that is a bit turned about x has the part tilted.
  solid::Mesh turned = cases::block({-22, -17, -13}, {24, 17, 11});
  for (solid::Vector& v : turned.vertices) v = {v.x, 0.9998 * v.y - 0.02 * v.z, 0.02 * v.y + 0.9998 * v.z};
  job.blank.bytes = solid_files::obj(turned);
  const LocatedSolid tilted = made(job);
  EXPECT_TRUE(tilted.program_withheld);
  EXPECT_FALSE(tilted.holds());
  EXPECT_TRUE(tilted.program.empty());
  EXPECT_TRUE(
      warns(tilted, "the part lies tilted, which three axes cannot follow; place it with --freedom c-xyz"));
}

/// The pose of the result is what the lines say, whatever the control, and its clearance is measured there.
TEST(JobsLocateSolid, AWorkOffsetIsWrittenForThePoseThatItCanSay) {
  for (const auto control :
       {nc::OffsetControl::linuxcnc, nc::OffsetControl::fanuc, nc::OffsetControl::siemens})
    for (const bool tilts : {false, true}) {
      if (tilts && control == nc::OffsetControl::linuxcnc) continue;
      SolidLocateJob job = convex_job();
      job.options.method = SolidMethod::climb;
      if (!tilts) job.options.freedom = SolidFreedom::c_xyz;
      const LocatedSolid free = made(job);
      job.options.offset =
          SolidOffsetOptions{{.control = control, .angle_decimals = 2, .length_decimals = 2}, tilts ? 5 : 3};
      job.outputs.offset = "lines";
      const LocatedSolid located = made(job);
      ASSERT_TRUE(located.document.offset) << located.result;
      EXPECT_TRUE(located.holds());
      EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
      const solid::Vector at = located.document.pose.shift;
      for (const double length : {at.x, at.y, at.z}) EXPECT_EQ(length, std::round(length * 100) / 100);
      EXPECT_GT(*located.document.clearance, *free.document.clearance - 0.1);
      for (const char* const other : {"X", "Y", "Z", "R", "I"}) {
        LocatedSolid changed = located;
        const std::size_t place = changed.offset.rfind(std::string(" ") + other);
        if (place == std::string::npos || changed.offset[place + 2] > '9') continue;
        const std::size_t digit = changed.offset.find_first_of("0123456789", place);
        changed.offset[digit] = changed.offset[digit] == '7' ? '6' : '7';
        EXPECT_EQ(verdict(job, changed), verify::Verdict::refuted) << changed.offset;
      }
    }
}

TEST(JobsLocateSolid, AProvedPlacementIsRoundedWithinItsWindow) {
  SolidLocateJob job = convex_job();
  job.options.gap = 0.05, job.options.freedom = SolidFreedom::c_xyz;
  job.options.offset = SolidOffsetOptions{};
  job.outputs.offset = "lines";
  const LocatedSolid located = made(job);
  ASSERT_TRUE(located.document.offset) << located.result;
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

TEST(JobsLocateSolid, AWorkOffsetIsWithheldWhereItsWordsCannotSayThePose) {
  SolidLocateJob job = convex_job();
  job.options.method = SolidMethod::climb;
  job.options.offset = SolidOffsetOptions{};
  job.outputs.offset = "lines";
  const LocatedSolid tilted = made(job);
  EXPECT_TRUE(tilted.offset_withheld);
  EXPECT_FALSE(tilted.holds());
  EXPECT_TRUE(warns(tilted, "no work offset was written, because the part lies tilted, which G10 L2"));
  job.options.offset->form.control = nc::OffsetControl::siemens;
  EXPECT_TRUE(warns(made(job), "a machine of three axes cannot follow; place it with --freedom c-xyz"));
  // A start of many digits without room about it has no pose that the words can say.
  job = block_job();
  job.options.freedom = SolidFreedom::xyz, job.options.shift = 0;
  job.start = File{"s.json", made(job).result};
  job.start->bytes.replace(job.start->bytes.find("\"x\": ", job.start->bytes.find("\n  \"x\"")) + 5, 1,
                           "0.00012345");
  job.options.offset = SolidOffsetOptions{};
  job.outputs.offset = "lines";
  EXPECT_TRUE(warns(made(job), "no pose beside it that its words can say is in the window"));
}

TEST(JobsLocateSolid, ThePartIsFoundWhereItWasTurnedAway) {
  const SolidLocateJob job = convex_job();
  const LocatedSolid located = made(job);
  ASSERT_TRUE(located.document.inside());
  EXPECT_EQ(located.document.status, "optimal");
  EXPECT_LE(*located.document.clearance, 2.0);
  EXPECT_GE(*located.document.upper_bound, 2.0);
  EXPECT_LE(*located.document.upper_bound - *located.document.clearance, 0.01);
  EXPECT_GT(located.document.certificate_boxes, 0U);
  EXPECT_TRUE(cases::Json::parse(located.result)["certificate"].is_object());
  EXPECT_TRUE(located.certificate.empty());
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

/// The part of a convex job, turned far away and moved.
SolidLocateJob far_job() {
  Random random(4);
  cases::SolidCase made = cases::convex_in_convex(random, 20, 2);
  solid::Motion away = cases::turn({3, -1, 2}, 2.9);
  away.shift = {300, -200, 100};
  for (solid::Vector& p : made.part.vertices) p = away(p);
  SolidLocateJob job = convex_job();
  job.part.bytes = solid_files::stl_text(made.part);
  job.blank.bytes = solid_files::ply<double>(made.blank, solid_files::PlyForm::little);
  return job;
}

TEST(JobsLocateSolid, AllRotationsAreProvedWhereverThePartLies) {
  SolidLocateJob job = far_job();
  job.options.tilt_deg = 180, job.options.gap = 0.1;
  const LocatedSolid located = made(job);
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["start"], "drawn");
  EXPECT_EQ(json["window"]["turn_deg"], 180);
  EXPECT_EQ(json["certificate"]["trees"].size(), 4U);
  EXPECT_LE(*located.document.clearance, 2.0);
  EXPECT_GE(*located.document.upper_bound, 2.0);
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
  // The middle of the part may be anywhere in the blank, and little farther off.
  const solid::Vector at = motion_of(located.document.window.start)(located.document.window.pivot);
  const double shift = located.document.window.shift;
  EXPECT_GT(shift, norm(at) / std::sqrt(3));
  EXPECT_LT(shift, norm(at) + 200);
  job.options.shift = 1;
  EXPECT_EQ(made(job).document.window.shift, 1);
}

TEST(JobsLocateSolid, AStartIsFoundFromAllOver) {
  SolidLocateJob job = far_job();
  job.options.find_start = true;
  const LocatedSolid located = made(job);
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(json["start"], "found");
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["window"]["turn_deg"], 5);
  EXPECT_EQ(json["window"]["shift"], 5);
  EXPECT_NEAR(*located.document.clearance, 2, 0.01);
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
  EXPECT_EQ(made(job).result, located.result);
}

TEST(JobsLocateSolid, TheClimbsThatFindAStartAreWork) {
  SolidLocateJob job = far_job();
  job.options.method = SolidMethod::climb;
  const std::uint64_t climb = made(job).document.work;
  job.options.find_start = true;
  const std::uint64_t whole = made(job).document.work;
  // Some 280 rotations are compared before anything climbs.
  EXPECT_GT(whole, climb + 280);
  RunControl run;
  run.work_limit = 100;
  const auto soon = locate_solid(job, run);
  ASSERT_TRUE(soon.has_value()) << soon.error().message;
  EXPECT_GE(soon->document.work, run.work_limit);
  EXPECT_LT(soon->document.work, whole);
}

TEST(JobsLocateSolid, AllTurnsAboutZAreLookedAt) {
  SolidLocateJob job = convex_job();
  Random random(6);
  const cases::SolidCase pair = cases::convex_in_convex(random, 20, 2);
  solid::Mesh part = pair.part;
  solid::Motion away = cases::turn({0, 0, 1}, 2);
  away.shift = {50, 0, 0};
  for (solid::Vector& p : part.vertices) p = away(pair.there(p));
  job.part.bytes = solid_files::stl_text(part);
  job.blank.bytes = solid_files::ply<double>(pair.blank, solid_files::PlyForm::little);
  job.options.freedom = SolidFreedom::c_xyz;
  job.options.window_from_deg = -180, job.options.window_to_deg = 180;
  for (const bool find : {false, true}) {
    job.options.find_start = find;
    const LocatedSolid located = made(job);
    EXPECT_EQ(located.document.status, "optimal");
    EXPECT_EQ(located.document.window.turn_deg, 180);
    EXPECT_EQ(cases::Json::parse(located.result)["certificate"]["trees"].size(), 2U);
    EXPECT_NEAR(*located.document.clearance, 2, 0.01);
    EXPECT_EQ(located.document.pose.quaternion[1], 0);
    EXPECT_EQ(located.document.pose.quaternion[2], 0);
    EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
  }
  // A shift alone may be found, too.
  job.options.freedom = SolidFreedom::xyz;
  job.options.method = SolidMethod::climb;
  const LocatedSolid shifted = made(job);
  EXPECT_EQ(shifted.document.window.start.quaternion, (std::array<double, 4>{1, 0, 0, 0}));
  EXPECT_EQ(verdict(job, shifted), verify::Verdict::unproved);
}

TEST(JobsLocateSolid, ThePartsSymmetryIsTold) {
  const LocatedSolid block = made(block_job());
  const auto json = cases::Json::parse(block.result);
  EXPECT_EQ(json["symmetry"]["rotations"], 4);
  EXPECT_EQ(json["symmetry"]["tolerance"], 0.01);
  EXPECT_EQ(json["symmetry"]["centre"], (cases::Json{0, 0, 0}));
  ASSERT_EQ(json["symmetry"]["axes"].size(), 3U);
  EXPECT_EQ(json["symmetry"]["axes"][0]["turns"], 2);
  SolidLocateJob round = block_job();
  round.part.bytes =
      solid_files::stl_text(cases::turned({{0, -8}, {12, -8}, {12, -4}, {8, -4}, {8, 8}, {0, 8}}, 200, 0));
  const auto of_round = cases::Json::parse(made(round).result);
  EXPECT_TRUE(of_round["symmetry"]["rotations"].is_null());
  EXPECT_TRUE(of_round["symmetry"]["axes"][0]["turns"].is_null());
  SolidLocateJob uneven = convex_job();
  uneven.options.method = SolidMethod::climb;
  EXPECT_TRUE(cases::Json::parse(made(uneven).result)["symmetry"].is_null());
}

TEST(JobsLocateSolid, TheCertificateMayBeAFileOfItsOwn) {
  SolidLocateJob job = convex_job();
  job.options.gap = 0.1;
  job.outputs.certificate = "c.json";
  const LocatedSolid located = made(job);
  const auto json = cases::Json::parse(located.result);
  EXPECT_TRUE(json["certificate"].is_null());
  EXPECT_EQ(json["certificate_file"]["path"], "c.json");
  EXPECT_EQ(json["certificate_file"]["sha256"], io::sha256(located.certificate));
  EXPECT_EQ(json["certificate_file"]["boxes"], located.document.certificate_boxes);
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

/// Corners at low x, where the part has 2 mm at the sides, demand more than others; the top is as cast.
File features_of_block(double at_low_x, const std::string& more = "") {
  return {"features.json",
          R"({"units": "mm", "minimum": 0.5, "features": [
            {"name": "end", "plane": {"normal": [1, 0, 0], "at": -20, "within": 0.01}, "minimum": )" +
              std::to_string(at_low_x) + R"(},
            {"name": "top", "box": [[-20, -15, 10], [20, 15, 10]], "as_cast": true})" +
              more + "]}"};
}

TEST(JobsLocateSolid, FacesHaveTheirOwnDemands) {
  SolidLocateJob job = block_job();
  job.options.method = SolidMethod::certified;
  job.features = features_of_block(1);
  job.outputs.picture = SolidPictureForm::html;
  const LocatedSolid located = made(job);
  for (const char* words : {"left over the demands, mm", "proven: no more than", "no allowance demanded"})
    EXPECT_TRUE(says(located.picture, words)) << words;
  EXPECT_FALSE(says(located.picture, "not proved"));
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["inputs"][2]["role"], "features");
  EXPECT_TRUE(json["symmetry"].is_null());
  EXPECT_TRUE(json["upper_bound"].is_null());
  EXPECT_TRUE(json["gap"].is_null());
  const auto& demands = json["demands"];
  EXPECT_EQ(demands["minimum"], 0.5);
  EXPECT_EQ(demands["features"][0]["triangles"], 2);
  EXPECT_EQ(demands["features"][0]["minimum"], 1);
  EXPECT_EQ(demands["features"][1]["as_cast"], true);
  EXPECT_TRUE(demands["features"][1]["scale"].is_null());
  // The corners at the end have 2 mm to the sides at best, and 4 mm less the bottom's to the top.
  EXPECT_NEAR(demands["margin"], 1, 0.01);
  EXPECT_GE(demands["margin_bound"], 1.0);
  EXPECT_LE(demands["margin_gap"], 0.01);
  EXPECT_EQ(json["shortfall"], 0);
  EXPECT_TRUE(located.holds());
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

TEST(JobsLocateSolid, WhatIsOfNoFeatureMayBeAsCast) {
  SolidLocateJob job = block_job();
  job.options.method = SolidMethod::certified;
  job.features = File{"features.json", R"({"as_cast": true, "features": [
      {"name": "end", "plane": {"normal": [1, 0, 0], "at": -20, "within": 0.01}}]})"};
  const LocatedSolid located = made(job);
  EXPECT_TRUE(cases::Json::parse(located.result)["demands"]["minimum"].is_null());
  EXPECT_TRUE(located.holds());
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

TEST(JobsLocateSolid, DemandsThatCannotBeMetAreProvedToBe) {
  SolidLocateJob job = block_job();
  job.options.method = SolidMethod::certified;
  job.features = features_of_block(2.5);
  const LocatedSolid located = made(job);
  EXPECT_EQ(located.document.status, "infeasible");
  EXPECT_TRUE(located.document.inside());
  EXPECT_NEAR(*located.document.shortfall(), 0.5, 0.05);
  EXPECT_LT(*located.document.demands->margin_bound, 0);
  EXPECT_FALSE(located.holds());
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
  job.options.method = SolidMethod::climb;
  const LocatedSolid climbed = made(job);
  EXPECT_EQ(climbed.document.status, "unproved");
  EXPECT_FALSE(climbed.document.demands->margin_bound);
  EXPECT_EQ(verdict(job, climbed), verify::Verdict::unproved);
}

TEST(JobsLocateSolid, FilesOfFeaturesThatMakeNoSenseAreRefused) {
  SolidLocateJob job = block_job();
  job.features = features_of_block(1, R"(, {"name": "all", "box": [[-99, -99, -99], [99, 99, 99]]})");
  EXPECT_TRUE(says(refusal(job).message, "is also of the feature \"top\"; it can be of one"));
  job.features = File{"features.json", R"({"features": [{"name": "all", "as_cast": true,
    "box": [[-99, -99, -99], [99, 99, 99]]}]})"};
  EXPECT_EQ(
      refusal(job).message,
      "features.json: all of the part is as cast or finished, so no placement is better than another; leave "
      "triangles that demand an allowance");
}

// The time of `--time` may be up while the result is checked.
TEST(JobsLocateSolid, AStopWhileTheResultIsCheckedLosesNothing) {
  const SolidLocateJob job = convex_job();
  std::atomic<bool> stop = false;
  RunControl run;
  run.stop = &stop;
  const auto located = stoppable(run, [&] {
    return locate_solid(job, run, {}, [&](const char* phase) {
      if (std::string_view(phase) == "checking what was found") stop = true;
      return ProgressListener();
    });
  });
  ASSERT_TRUE(located.has_value()) << located.error().what();
  ASSERT_TRUE(located->has_value());
  EXPECT_TRUE(stop);
  EXPECT_EQ((*located)->result, made(job).result);
}

TEST(JobsLocateSolid, ASearchThatIsStoppedHasItsBoundProved) {
  SolidLocateJob job = convex_job();
  job.options.gap = 1e-6;
  RunControl run;
  run.work_limit = 30;
  const Result<LocatedSolid> located = locate_solid(job, run);
  ASSERT_TRUE(located.has_value());
  EXPECT_EQ(located->document.status, "stopped");
  EXPECT_GE(*located->document.upper_bound, 2.0);
  EXPECT_EQ(verdict(job, *located), verify::Verdict::confirmed);
}

TEST(JobsLocateSolid, OnlyTheFreedomsAskedForAreUsed) {
  SolidLocateJob job = block_job();
  job.options.freedom = SolidFreedom::xyz;
  EXPECT_EQ(made(job).document.pose.quaternion, (std::array<double, 4>{1, 0, 0, 0}));
  job.options.freedom = SolidFreedom::c_xyz;
  const auto turned = made(job).document.pose.quaternion;
  EXPECT_EQ(turned[1], 0);
  EXPECT_EQ(turned[2], 0);
}

TEST(JobsLocateSolid, TheWindowOfTurnsIsAboutItsMiddle) {
  SolidLocateJob job = block_job();
  job.options.freedom = SolidFreedom::c_xyz;
  job.options.window_from_deg = 178, job.options.window_to_deg = 184;
  const LocatedSolid located = made(job);
  EXPECT_NEAR(angle(located.document.window.start), 179, 1e-9);
  EXPECT_EQ(located.document.window.turn_deg, 3);
  ASSERT_TRUE(located.document.inside());
  EXPECT_NEAR(*located.document.clearance, 2, 1e-3);
  EXPECT_NEAR(angle(located.document.pose), 180, 0.01);
  EXPECT_NE(verdict(job, located), verify::Verdict::refuted);
}

TEST(JobsLocateSolid, AnEarlierResultIsAStart) {
  SolidLocateJob job = block_job();
  job.blank.bytes = solid_files::obj(cases::block({78, -17, -13}, {124, 17, 11}));
  const LocatedSolid far = made(job);
  EXPECT_FALSE(far.document.inside());
  EXPECT_FALSE(far.holds());
  EXPECT_TRUE(warns(far, "reaches out of the box around the blank by 98 mm along x, farther")) << far.result;
  job.options.shift = 120;
  const LocatedSolid found = made(job);
  ASSERT_TRUE(found.document.inside());
  job.options.shift = 1;
  job.start = File{"found.json", found.result};
  const LocatedSolid again = made(job);
  ASSERT_TRUE(again.document.inside());
  EXPECT_EQ(again.document.window.start.quaternion, found.document.pose.quaternion);
  EXPECT_EQ(again.document.window.start.shift, found.document.pose.shift);
  ASSERT_EQ(again.document.inputs.size(), 3U);
  EXPECT_EQ(again.document.inputs[2].role, "start");
  EXPECT_EQ(again.document.inputs[2].file.sha256, io::sha256(found.result));
  EXPECT_NE(verdict(job, again), verify::Verdict::refuted);
}

TEST(JobsLocateSolid, APartThatDoesNotFitHasNoClearance) {
  SolidLocateJob job = block_job();
  job.blank.bytes = solid_files::obj(cases::block({-19, -17, -13}, {19, 17, 11}));
  const LocatedSolid located = made(job);
  EXPECT_FALSE(located.holds());
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(json["inside"], false);
  for (const char* field : {"clearance", "gap", "shortfall"}) EXPECT_TRUE(json[field].is_null()) << field;
  EXPECT_FALSE(warns(located, "out of the box"));
  EXPECT_NE(verdict(job, located), verify::Verdict::refuted);
}

TEST(JobsLocateSolid, ADemandThatIsMissedIsNoYes) {
  SolidLocateJob job = block_job();
  job.options.min_allowance = 1.9;
  EXPECT_TRUE(made(job).holds());
  job.options.min_allowance = 2.5;
  const LocatedSolid located = made(job);
  EXPECT_FALSE(located.holds());
  EXPECT_NEAR(*located.document.shortfall(), 0.5, 1e-3);
  EXPECT_GE(*located.document.shortfall(), 0.5);
}

TEST(JobsLocateSolid, WhatAMeshDeviatesIsTakenOffAndAddedOn) {
  SolidLocateJob job = convex_job();
  const auto with = [](std::string bytes, const std::string& deviation) {
    const std::string was = "comment made by a test\n";
    return bytes.replace(bytes.find(was), was.size(),
                         "comment lekalo-step 1\ncomment deviation " + deviation + "\n");
  };
  Random random(3);
  const solid::Mesh part = cases::convex_in_convex(random, 20, 2).part;
  const std::string ply = solid_files::ply<double>(part, solid_files::PlyForm::little);
  job.part = {"part.ply", ply};
  const LocatedSolid plain = made(job);
  job.part.bytes = with(ply, "0.125");
  job.blank.bytes = with(job.blank.bytes, "0.0625");
  const LocatedSolid off = made(job);
  EXPECT_NEAR(*off.document.clearance, *plain.document.clearance - 0.1875, 1e-9);
  EXPECT_NEAR(*off.document.upper_bound, *plain.document.upper_bound + 0.1875, 1e-9);
  EXPECT_TRUE(says(off.result, "\"deviation\": 0.125"));
  EXPECT_EQ(verdict(job, off), verify::Verdict::confirmed);
  // A demand between what is proved for the triangles and for the bodies is missed, not out of reach.
  job.options.min_allowance = *plain.document.clearance;
  EXPECT_GT(*made(job).document.shortfall(), 0.18);
  // Another deviation in the file is another claim.
  SolidLocateJob other = job;
  other.part.bytes = with(ply, "0.126");
  EXPECT_EQ(verdict(other, off), verify::Verdict::refuted);
  // More than there is room for: nothing says that the body is inside.
  job.options.min_allowance = 0;
  job.part.bytes = with(ply, "5");
  const LocatedSolid beyond = made(job);
  EXPECT_FALSE(beyond.document.inside());
  EXPECT_EQ(beyond.document.status, "stopped");
}

TEST(JobsLocateSolid, FacesOfAStepFileHaveDemands) {
  SolidLocateJob job = block_job();
  job.options.method = SolidMethod::certified;
  const auto features = [](const char* end, const char* top) {
    return File{"features.json", fmt::format(R"({{"minimum": 0.5, "features": [
      {{"name": "end", {}, "minimum": 1, "scale": 0.5}}, {{"name": "top", {}, "as_cast": true}}]}})",
                                             end, top)};
  };
  // Triangles 2 and 3 of the block look up, 8 and 9 to low x.
  const solid::Mesh block = cases::block({-20, -15, -10}, {20, 15, 10});
  const std::vector<std::uint32_t> face_of{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
  const std::vector<std::string> names{"", "roof", "", "", "end", ""};
  job.part = {"part.stl", solid_files::stl_text(block)};
  job.features = features(R"("triangles": [8, 9])", R"("triangles": [2, 3])");
  const LocatedSolid plain = made(job);
  job.part = {"part.ply", solid_files::step_mesh(block, "0.125", face_of, names)};
  job.features = features(R"("faces": [4])", R"("label": "roof")");
  const LocatedSolid off = made(job);
  EXPECT_TRUE(off.document.inside());
  EXPECT_EQ(off.document.demands->features[0].triangles, (std::vector<std::uint32_t>{8, 9}));
  EXPECT_EQ(off.document.demands->features[1].triangles, (std::vector<std::uint32_t>{2, 3}));
  // The smallest scale makes the deviation twice as much of margin.
  EXPECT_NEAR(*off.document.demands->margin, *plain.document.demands->margin - 0.25, 1e-9);
  EXPECT_NEAR(*off.document.demands->margin_bound, *plain.document.demands->margin_bound + 0.25, 1e-9);
  EXPECT_NEAR(*off.document.clearance, *plain.document.clearance - 0.125, 1e-9);
  EXPECT_EQ(verdict(job, plain), verify::Verdict::refuted);
  EXPECT_EQ(verdict(job, off), verify::Verdict::confirmed);
  // The same by the colours that these faces have.
  constexpr std::uint32_t kNone = io::SolidFile::kNoColour;
  job.part = {"part.ply", solid_files::step_mesh(block, "0.125", face_of, names,
                                                 {kNone, 0xff8000, 0, kNone, 0x00ff0a, 0})};
  job.features = features(R"("colour": "#00FF0A")", R"("colour": "#ff8000")");
  const LocatedSolid coloured = made(job);
  EXPECT_EQ(coloured.document.demands->margin, off.document.demands->margin);
  EXPECT_EQ(coloured.document.demands->features[0].triangles, (std::vector<std::uint32_t>{8, 9}));
  EXPECT_EQ(coloured.document.demands->features[1].triangles, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(verdict(job, coloured), verify::Verdict::confirmed);
  job.features = features(R"("colour": "#00ff0b")", R"("label": "roof")");
  EXPECT_EQ(
      refusal(job).message,
      "features.json, feature \"end\": no face of the part has the colour \"#00ff0b\"; there is: #000000, "
      "#00ff0a, #ff8000");
  job.part.bytes =
      solid_files::step_mesh(block, "0.125", face_of, names, std::vector<std::uint32_t>(6, kNone));
  EXPECT_EQ(
      refusal(job).message,
      "features.json, feature \"end\": the part has no colours, which meshes by lekalo-step have where the "
      "faces of the STEP file do; make the mesh again, or name the triangles by \"faces\" or \"patch\"");
  job.part.bytes =
      solid_files::step_mesh(block, "0.125", face_of, names, {0, 0, 0, 0, 0, io::SolidFile::kNoColour + 1});
  EXPECT_EQ(refusal(job).message.find("part.ply: line "), 0U) << refusal(job).message;
  EXPECT_TRUE(says(refusal(job).message, "its colour is not a whole number from 0 to 16777216"))
      << refusal(job).message;
  job.part.bytes = solid_files::step_mesh(block, "0.125", face_of, names);
  job.features = features(R"("faces": [6])", R"("label": "roof")");
  EXPECT_EQ(refusal(job).message, "features.json, feature \"end\": face 6 is none of the part's 6");
  job.part = {"part.stl", solid_files::stl_text(block)};
  EXPECT_EQ(refusal(job).message,
            "features.json, feature \"end\": the part has no faces by number, which meshes by lekalo-step "
            "have; name "
            "the triangles by \"patch\", \"box\" or \"plane\"");
}

TEST(JobsLocateSolid, InchesAreMillimetresInside) {
  SolidLocateJob job = block_job();
  job.part.bytes = solid_files::stl_text(cases::block({-0.75, -0.5, -0.25}, {0.75, 0.5, 0.25}));
  job.blank.bytes = solid_files::obj(cases::block({-0.875, -0.625, -0.375}, {0.875, 0.625, 0.375}));
  EXPECT_TRUE(warns(made(job), "suggest inches"));
  job.options.units = io::SolidUnit::inch;
  const LocatedSolid located = made(job);
  EXPECT_FALSE(warns(located, "suggest inches"));
  EXPECT_EQ(cases::Json::parse(located.result)["inputs"][0]["units"], "inch");
  EXPECT_NEAR(*located.document.clearance, 3.175, 1e-3);
  EXPECT_NE(verdict(job, located), verify::Verdict::refuted);
}

TEST(JobsLocateSolid, MendsAreToldWithTheNameOfTheFile) {
  SolidLocateJob job = block_job();
  solid::Mesh blank = cases::block({-22, -17, -13}, {24, 17, 11});
  std::swap(blank.triangles[3][0], blank.triangles[3][1]);
  blank.triangles.push_back({0, 0, 1});
  cases::append(blank, cases::block({21.5, 14, 8}, {22.5, 15, 9}));
  job.blank.bytes = solid_files::stl_text(blank);
  const LocatedSolid located = made(job);
  EXPECT_TRUE(warns(located, "casting.obj: 1 of 24 triangles looked into the material"));
  EXPECT_TRUE(warns(located, "casting.obj: 1 triangle has no area"));
  EXPECT_TRUE(warns(located, "casting.obj: 1 shell lies within another")) << located.result;
  EXPECT_TRUE(warns(located, "casting.obj: the file does not say its unit"));
}

/// The checker reads triangles alone. What it leaves open was taken for a mistake of a method without a
/// bound.
TEST(JobsLocateSolid, AFormThatTheCheckerDoesNotReadIsTold) {
  SolidLocateJob job = block_job();
  job.blank.bytes =
      "v -22 -17 -13\nv 24 -17 -13\nv 24 17 -13\nv -22 17 -13\nv -22 -17 11\nv 24 -17 11\nv 24 17 11\n"
      "v -22 17 11\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  for (const SolidMethod method : {SolidMethod::climb, SolidMethod::certified}) {
    job.options.method = method;
    job.options.gap = 0.1;
    const LocatedSolid located = made(job);
    EXPECT_TRUE(located.holds());
    EXPECT_TRUE(warns(located, "was not rechecked")) << located.result;
    EXPECT_EQ(verdict(job, located), verify::Verdict::incomplete);
  }
}

TEST(JobsLocateSolid, ASolidInItselfIsNotCalledInside) {
  SolidLocateJob job = block_job();
  job.blank = {"part.stl", job.part.bytes};
  for (const SolidMethod method : {SolidMethod::climb, SolidMethod::certified}) {
    job.options.method = method;
    const LocatedSolid located = made(job);
    EXPECT_FALSE(located.holds());
    EXPECT_NE(located.document.status, "infeasible");
  }
}

TEST(JobsLocateSolid, TrianglesHaveTheNumbersOfTheirFile) {
  SolidLocateJob job = block_job();
  solid::Mesh blank = cases::block({-22, -17, -13}, {24, 17, 11});
  blank.triangles.insert(blank.triangles.begin(), 5, {0, 0, 1});
  job.blank.bytes = solid_files::stl_text(blank);
  const LocatedSolid located = made(job);
  EXPECT_EQ(located.document.inputs[1].triangles, 17U);
  ASSERT_FALSE(located.document.contacts.empty());
  for (const locate::SolidTouch& touch : located.document.contacts) EXPECT_GE(touch.blank_triangle, 5U);
  EXPECT_NE(verdict(job, located), verify::Verdict::refuted);
}

TEST(JobsLocateSolid, AnyNumberOfThreadsGivesTheSameBytes) {
  SolidLocateJob job = convex_job(8);
  job.options.gap = 0.1;
  std::vector<std::string> results;
  for (const unsigned threads : {1U, 2U, 3U}) {
    job.options.threads = threads;
    LocatedSolid located = made(job);
    located.document.threads = 1;
    results.push_back(io::result_json(located.document));
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(JobsLocateSolid, TheSurfaceInColoursIsAMeshThatOthersRead) {
  SolidLocateJob job = block_job();
  job.options.freedom = SolidFreedom::xyz;
  job.options.shift = 0;
  job.outputs.picture = SolidPictureForm::ply;
  const std::string ply = made(job).picture;
  EXPECT_TRUE(says(ply, "property double quality\nproperty uchar red\n"));
  const auto read = io::parse_solid(ply, "where.ply", {io::SolidUnit::millimetre});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(solid::closed_mesh(read->mesh));
  const solid::Box box = solid::box_of(read->mesh.vertices);
  EXPECT_EQ(box.low, (solid::Vector{-20, -15, -10}));
  EXPECT_EQ(box.high, (solid::Vector{20, 15, 10}));
  // The first vertex is a corner of the part, 1 mm below the blank's top or 2 mm beside its sides.
  const std::size_t at = ply.find("end_header\n") + 11;
  double allowance = 0;
  std::memcpy(&allowance, ply.data() + at + 24, 8);
  EXPECT_NEAR(allowance, 2, 1);
  // Red is where less than demanded is left.
  job.options.min_allowance = 1.5;
  const std::string missing = made(job).picture;
  EXPECT_TRUE(says(missing, std::string("\xd0\x00\x1b", 3)));
}

TEST(JobsLocateSolid, TheAllowanceOfEveryCornerIsATable) {
  SolidLocateJob job = block_job();
  EXPECT_EQ(made(job).allowances, "");
  job.options.freedom = SolidFreedom::xyz;
  job.options.shift = 0;
  job.outputs.allowances = true;
  const std::string table = made(job).allowances;
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "index,x_part,y_part,z_part,x_blank,y_blank,z_blank,allowance_mm,blank_triangle");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 9);
  // The first corner of the first triangle has 1 mm above and 2 beside it, others 3 below.
  EXPECT_TRUE(says(table, "\n0,-20,-15,-10,-20,-15,-10,")) << table;
}

TEST(JobsLocateSolid, BadFilesAreRefusedWithPlaceAndWayOut) {
  SolidLocateJob job = block_job();
  const auto refuses = [&](const std::string& bytes, const std::vector<std::string>& words) {
    job.blank.bytes = bytes;
    const Error error = refusal(job);
    EXPECT_EQ(error.code, ErrorCode::bad_input);
    EXPECT_EQ(error.message.rfind("casting.obj: ", 0), 0U) << error.message;
    for (const std::string& word : words) EXPECT_TRUE(says(error.message, word)) << error.message;
  };
  solid::Mesh open = cases::block({-22, -17, -13}, {24, 17, 11});
  open.triangles.pop_back();
  refuses(solid_files::obj(open), {"open", "triangle", "close it"});
  refuses(solid_files::points(open.vertices), {"points are not a closed surface", "--mesh FILE.ply"});
  refuses("", {});
  refuses("v 0 0 nan\n", {});
}

/// What an overlap of two bodies holds counted as air, and nothing but a note said so.
TEST(JobsLocateSolid, AMeshThatCrossesItselfIsRefusedWithPlaceAndWayOut) {
  solid::Mesh crossing = cases::block({-22, -17, -13}, {24, 17, 11});
  cases::append(crossing, cases::block({23, -5, -5}, {40, 5, 6}));
  SolidLocateJob job = block_job();
  job.blank.bytes = solid_files::obj(crossing);
  const Error of_blank = refusal(job);
  EXPECT_EQ(of_blank.code, ErrorCode::bad_input);
  for (const char* words : {"casting.obj: the surface crosses itself at (2", ", on triangle ",
                            "; unite bodies that overlap, or mend the mesh"})
    EXPECT_TRUE(says(of_blank.message, words)) << of_blank.message;
  job = block_job();
  job.part.bytes = solid_files::stl_text(crossing);
  EXPECT_TRUE(says(refusal(job).message, "folder/part.stl: the surface crosses itself at (2"))
      << refusal(job).message;
}

TEST(JobsLocateSolid, ACrossingThatIsThinIsToldAndKept) {
  solid::Mesh beside = cases::block({-22, -17, -13}, {24, 17, 11});
  cases::append(beside, cases::block({23.999, -5, -5}, {40, 5, 6}));
  SolidLocateJob job = block_job();
  job.blank.bytes = solid_files::obj(beside);
  const LocatedSolid located = made(job);
  EXPECT_TRUE(located.holds());
  EXPECT_TRUE(warns(located, " edges go through other triangles or end on them, the first at ("))
      << located.result;
  EXPECT_TRUE(warns(located, "what lies between is nowhere 0.01 mm thick")) << located.result;
}

TEST(JobsLocateSolid, ARepeatedTriangleIsToldAndConfirmed) {
  SolidLocateJob job = block_job();
  solid::Mesh blank = cases::block({-22, -17, -13}, {24, 17, 11});
  blank.triangles.insert(blank.triangles.begin() + 4, blank.triangles[1]);
  job.blank.bytes = solid_files::obj(blank);
  job.options.method = SolidMethod::certified, job.options.gap = 0.1;
  const LocatedSolid located = made(job);
  EXPECT_TRUE(warns(located,
                    "casting.obj: 1 triangle repeats one with the same corners and is left out, the "
                    "first of them triangle 5, which repeats triangle 2"))
      << located.result;
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

TEST(JobsLocateSolid, APartThatIsLargerThanItsBlankIsToldToBeExchanged) {
  SolidLocateJob job = block_job();
  std::swap(job.part, job.blank);
  EXPECT_TRUE(warns(made(job),
                    "casting.obj has a volume of 3.754e+04 mm3 and folder/part.stl only 2.4e+04, so "
                    "it fits nowhere; is --part the blank, and --blank the part?"));
  EXPECT_FALSE(warns(made(block_job()), "has a volume of"));
}

TEST(JobsLocateSolid, AStartThatIsFarOffIsToldInOneSentence) {
  SolidLocateJob job = block_job();
  job.part.bytes = solid_files::stl_text(cases::block({80, 85, 90}, {120, 115, 110}));
  EXPECT_TRUE(warns(made(job),
                    "at the start the part reaches out of the box around the blank by 96 mm along x, "
                    "98 mm along y, 99 mm along z, farther than it may be shifted (5 mm); let it"));
}

TEST(JobsLocateSolid, PartAndBlankInDifferentUnitsAreToldByTheirSizes) {
  SolidLocateJob job = block_job();
  const auto scaled = [](double by) {
    solid::Mesh mesh = cases::block({-22, -17, -13}, {24, 17, 11});
    for (solid::Vector& p : mesh.vertices) p = by * p;
    return solid_files::obj(mesh);
  };
  job.blank.bytes = scaled(1 / 25.4);
  EXPECT_TRUE(
      warns(made(job),
            "folder/part.stl measures 40 x 30 x 20 mm and casting.obj 1.811 x 1.339 x 0.9449 mm, so "
            "casting.obj seems to be in inches; --units is said of both files: convert one of them, or "
            "give it as 3MF, which says its own unit"));
  job.blank.bytes = scaled(25.4);
  EXPECT_TRUE(warns(made(job), "so folder/part.stl seems to be in inches; --units"));
  job.blank.bytes = scaled(0.001);
  EXPECT_TRUE(warns(made(job), "so casting.obj seems to be in metres; --units"));
  for (const double by : {1.0, 3.0, 10.0}) {
    job.blank.bytes = scaled(by);
    EXPECT_FALSE(warns(made(job), "seems to be in")) << by;
  }
}

TEST(JobsLocateSolid, AStartIsAResultForSolids) {
  SolidLocateJob job = block_job();
  const auto refuses = [&](const std::string& bytes, const std::string& word) {
    job.start = File{"start.json", bytes};
    const Error error = refusal(job);
    EXPECT_EQ(error.code, ErrorCode::bad_input);
    EXPECT_TRUE(says(error.message, "start.json") && says(error.message, word)) << error.message;
  };
  const std::string good = made(job).result;
  refuses("v 0 0 0", "JSON");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    const std::size_t at = bytes.find(from, bytes.find("\n  \"quaternion\""));
    return bytes.replace(at, from.size(), to);
  };
  refuses(with("\"quaternion\": [", "\"quaternion\": [2, "), "quaternion");
  refuses(with("\"quaternion\": [", "\"quaternion\": [1"), "out of all measure");
  refuses(with("\"x\": ", "\"x\": 1e300, \"was\": "), "out of all measure");
  refuses(with("\"quaternion\": [", "\"theta\": ["), "theta");
}

/// A casting as it stands on a table, as points that a scanner measured about a millimetre apart.
SolidLocateJob points_job(std::vector<solid::Vector>& points) {
  Random random(7);
  const cases::Casting casting(random);
  points = casting.scanned(0.018, random).vertices;
  points.pop_back();  // the middle of the underside, which nobody saw
  SolidLocateJob job;
  job.part = {"part.stl", solid_files::stl_binary(cases::Casting::part())};
  job.blank = {"scan.xyz", solid_files::points(points)};
  job.options.method = SolidMethod::climb;
  job.options.scan = SolidScanOptions{0.01, 2, 5, {}, locate::SolidUnderside{0, 0.1}, {}, {}};
  job.outputs.mesh = "mesh.ply";
  return job;
}

TEST(JobsLocateSolid, PointsAreMeshedAndThePlacementHoldsInTheTrueBlank) {
  std::vector<solid::Vector> points;
  const SolidLocateJob job = points_job(points);
  const LocatedSolid located = made(job);
  ASSERT_TRUE(located.holds());
  Random random(7);
  const cases::Casting casting(random);
  const solid::Motion motion = motion_of(located.document.pose);
  EXPECT_GT(*located.document.clearance, 0.7);
  for (const solid::Vector p : cases::Casting::part().vertices)
    EXPECT_GE(casting.depth(motion(p)), *located.document.clearance - 1e-5);
  const auto json = cases::Json::parse(located.result);
  EXPECT_EQ(json["inputs"][1]["path"], "mesh.ply");
  EXPECT_EQ(json["inputs"][1]["sha256"], io::sha256(located.mesh));
  EXPECT_EQ(json["inputs"][2]["role"], "points");
  EXPECT_EQ(json["inputs"][2]["sha256"], io::sha256(job.blank.bytes));
  EXPECT_EQ(json["inputs"][2]["points"], points.size());
  EXPECT_EQ(json["scan"]["left_out"].size(), 0U);
  EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
}

/// The page that is filed away did not say what its figures rest on.
TEST(JobsLocateSolid, TheReportOfAScanSaysWhatIsAssumed) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  job.outputs.report = PictureForm::svg;
  const LocatedSolid located = made(job);
  ASSERT_TRUE(located.document.scan);
  EXPECT_GE(located.document.scan->assumptions.size(), 3U);
  for (const char* words : {">Every corner of the scan", ">A ball of 5 mm radius comes from outside",
                            ">The blank has no closed voids.", ">The underside at z = "})
    EXPECT_TRUE(says(located.report, words)) << words;
  EXPECT_TRUE(says(located.report, fmt::format("{} points, mm", points.size())));
  job.options.scan->underside.reset();
  const LocatedSolid open = made(job);
  ASSERT_GT(open.document.scan->unknown_triangles, 0U);
  EXPECT_TRUE(says(open.report, "triangles of the scan are unknown, so nothing is proved of the blank."));
}

TEST(JobsLocateSolid, EveryMeasuredPointHasItsDistanceFromThePlacedPart) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  job.blank.bytes = "900 0 20\n" + job.blank.bytes;  // is left out
  job.options.scan->drop_outliers = 50;
  job.outputs.deviations = SolidPointsForm::csv;
  const LocatedSolid located = made(job);
  ASSERT_TRUE(located.holds());
  ASSERT_EQ(located.document.scan->left_out, std::vector<std::uint32_t>{0});
  std::istringstream table(located.deviations);
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "index,x,y,z,deviation");
  std::size_t index = 0;
  double least = 1e9;
  while (std::getline(table, line)) {
    std::array<double, 5> row{};
    char comma = 0;
    std::istringstream numbers(line);
    for (double& number : row) numbers >> number >> comma;
    EXPECT_EQ(row[0], static_cast<double>(index + 1)) << line;
    EXPECT_EQ((solid::Vector{row[1], row[2], row[3]}), points[index]);
    least = std::min(least, row[4]);
    ++index;
  }
  EXPECT_EQ(index, points.size());
  // Each point is of the blank's surface, but for its noise.
  EXPECT_GE(least, *located.document.clearance - 0.1);
  job.outputs.deviations = SolidPointsForm::ply;
  const auto read = io::parse_solid(made(job).deviations, "d.ply");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->mesh.vertices.size(), points.size());
  EXPECT_TRUE(read->mesh.triangles.empty());
}

TEST(JobsLocateSolid, PointsInInchesAreTheSamePoints) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  solid::Mesh part = cases::Casting::part();
  for (solid::Vector& p : part.vertices) p = (1 / 25.4) * p;
  for (solid::Vector& p : points) p = (1 / 25.4) * p;
  job.part.bytes = solid_files::stl_binary(part);
  job.options.units = io::SolidUnit::inch;
  const std::string text = solid_files::points(points);
  for (const std::string& bytes : {text, solid_files::ply<double>({points, {}}, solid_files::PlyForm::little),
                                   solid_files::ply<float>({points, {}}, solid_files::PlyForm::big)}) {
    job.blank.bytes = bytes;
    const LocatedSolid located = made(job);
    EXPECT_TRUE(located.holds());
    EXPECT_EQ(cases::Json::parse(located.result)["inputs"][2]["units"], "inch");
    EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
  }
}

TEST(JobsLocateSolid, AMeshThatDoesNotCloseIsMeshedAnewFromItsCorners) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  Random random(7);
  solid::Mesh open = cases::Casting(random).scanned(0.018, random);
  std::erase_if(open.triangles, [&](const auto& t) { return t[0] == open.vertices.size() - 1; });
  open.vertices.pop_back();
  job.blank = {"scan.obj", solid_files::obj(open)};
  const LocatedSolid located = made(job);
  EXPECT_TRUE(located.holds());
  EXPECT_TRUE(warns(located, "it is meshed anew from its corners"));
  EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
  job.blank.bytes = solid_files::obj(cases::Casting(random).scanned(0.018, random));
  const LocatedSolid closed = made(job);
  EXPECT_EQ(closed.mesh, "");
  EXPECT_TRUE(warns(closed, "scan.obj closes as it is, so mesh.ply is not written"));
}

TEST(JobsLocateSolid, APointInTheMaterialContradictsWhatIsSaid) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  points.insert(points.begin() + 9, {0, 0, 7});
  job.blank.bytes = solid_files::points(points);
  const Error error = refusal(job);
  EXPECT_EQ(error.code, ErrorCode::bad_input);
  EXPECT_TRUE(
      says(error.message, "scan.xyz: 1 of its points lie inside the material that --min-radius 5 promises"))
      << error.message;
  EXPECT_TRUE(says(error.message, "at (0, 0, 7)") && says(error.message, "--drop-outliers")) << error.message;
  job.options.scan->drop_outliers = 2.5;
  const LocatedSolid located = made(job);
  EXPECT_TRUE(located.holds());
  EXPECT_EQ(cases::Json::parse(located.result)["scan"]["left_out"], cases::Json{9});
  EXPECT_EQ(cases::Json::parse(located.result)["scan"]["assumptions"].back(),
            "the 1 points that are left out are none of the surface");
  EXPECT_TRUE(warns(located, "scan.xyz: 1 points have no other within 2.5 mm and are left out"));
  EXPECT_EQ(verdict(job, located), verify::Verdict::unproved);
}

TEST(JobsLocateSolid, UnknownPartsOfTheBlankAreDrawn) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  Random random(7);
  job.blank = {"scan.obj", solid_files::obj(cases::Casting(random).scanned(0.018, random))};
  job.outputs.mesh.clear();
  job.outputs.picture = SolidPictureForm::html;
  EXPECT_FALSE(says(made(job).picture, "blank, not measured"));
  job.options.scan->underside.reset();
  const LocatedSolid located = made(job);
  EXPECT_FALSE(located.holds());
  EXPECT_TRUE(says(located.picture, "blank, not measured"));
}

TEST(JobsLocateSolid, PointsNeedAReach) {
  std::vector<solid::Vector> points;
  SolidLocateJob job = points_job(points);
  job.options.scan->min_radius.reset();
  job.options.scan->max_dip = 0.1;
  EXPECT_TRUE(says(refusal(job).message, "--min-radius MM and --mesh FILE.ply"));
  job = points_job(points);
  job.outputs.mesh.clear();
  EXPECT_TRUE(says(refusal(job).message, "--min-radius MM and --mesh FILE.ply"));
  // A dip is a statement about triangles, and these nobody has seen.
  job = points_job(points);
  job.options.scan->max_dip = 0.1;
  EXPECT_TRUE(
      says(refusal(job).message, "a dip is said of the triangles of a mesh, and points have none yet"));
  job = points_job(points);
  job.options.scan->uncertainty = 3;
  EXPECT_EQ(refusal(job).code, ErrorCode::usage);
  EXPECT_TRUE(says(refusal(job).message, "a smallest radius of 5 mm must be above 6 mm"));
  job = points_job(points);
  job.options.scan->underside.reset();
  // Nobody has measured the underside, so it is bridged and unknown.
  const LocatedSolid located = made(job);
  EXPECT_FALSE(located.holds());
  EXPECT_FALSE(located.document.scan->proved());
  EXPECT_TRUE(warns(located, "somewhere a ball of 3.984 mm falls in between the points"));
  EXPECT_EQ(verdict(job, located), verify::Verdict::incomplete);
}

TEST(SolidsAreTold, ByWhatIsInTheFiles) {
  const solid::Mesh block = cases::block({0, 0, 0}, {1, 2, 3});
  const File stl{"a.stl", solid_files::stl_binary(block)}, obj{"b", solid_files::obj(block)},
      ply{"c.ply", solid_files::ply<float>(block, solid_files::PlyForm::text)},
      points{"d.xyz", solid_files::points(block.vertices)}, outline{"e.csv", "0 0\n8 0\n8 8\n"},
      empty{"f.STL", ""}, step{"g.step", "ISO-10303-21;"}, drawing{"h.svg", "<?xml version=\"1.0\"?><svg/>"};
  const auto solids = [](const File& part, const File& blank) {
    const Result<bool> both = are_solids(part, blank);
    EXPECT_TRUE(both.has_value()) << (both ? "" : both.error().message);
    return both.value_or(false);
  };
  for (const File& part : {stl, obj, ply, empty, step})
    for (const File& blank : {stl, obj, ply, empty, step}) EXPECT_TRUE(solids(part, blank));
  for (const File& part : {outline, points, drawing})
    for (const File& blank : {outline, points, drawing, ply}) EXPECT_FALSE(solids(part, blank));
  const auto refused = [](const File& part, const File& blank) {
    const Result<bool> both = are_solids(part, blank);
    EXPECT_FALSE(both.has_value());
    if (both) return std::string();
    EXPECT_EQ(both.error().code, ErrorCode::bad_input);
    return both.error().message;
  };
  EXPECT_TRUE(says(refused(stl, outline), "a.stl is a solid and e.csv is none"));
  EXPECT_TRUE(says(refused(drawing, obj), "b is a solid and h.svg is none"));
  EXPECT_TRUE(solids(stl, points));
  EXPECT_TRUE(says(refused(points, stl), "d.xyz: points are not a closed surface"));
}

}  // namespace
}  // namespace lekalo::jobs::jobs_locate_solid_test
