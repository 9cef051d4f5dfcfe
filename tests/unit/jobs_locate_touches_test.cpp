// Blanks that were touched, from bytes to a checked document.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lekalo/jobs/locate_solid.hpp"
#include "lekalo/jobs/verify.hpp"
#include "lekalo/locate/touched_solid.hpp"
#include "support/json.hpp"
#include "support/solid_files.hpp"
#include "support/touched_castings.hpp"

namespace lekalo::jobs::jobs_locate_touches_test {
namespace {

using cases::Json;
using solid::Vector;

/// A block in the casting of a metre's tenth, which lies a little off and is touched at 60 places with a
/// ball.
struct Touched {
  SolidLocateJob job;
  cases::TouchedCasting casting;
  std::vector<Vector> touches;
};

Touched touched(double ball = 2) {
  Random random(5);
  solid::Mesh nominal = cases::block({-50, -40, -30}, {50, 40, 30});
  cases::TouchedCasting casting(std::move(nominal), cases::small_motion(random, 0.01, 1), 0.09, random);
  std::vector<Vector> touches = cases::touches_of(casting, 60, 0.5 * ball, 0.02, random);
  SolidLocateJob job;
  job.part = {"part.stl", solid_files::stl_text(cases::block({-45, -35, -25}, {45, 35, 25}))};
  job.blank = {"touches.xyz", solid_files::points(touches)};
  job.nominal = File{"rough.obj", solid_files::obj(casting.nominal())};
  job.options.method = SolidMethod::climb;
  job.options.scan = SolidScanOptions{0.01, 2, {}, {}, {}, {}, {}};
  job.options.touch = SolidTouchOptions{ball, 0.1, 5, 2};
  job.outputs.mesh = "here.ply";
  return {std::move(job), std::move(casting), std::move(touches)};
}

LocatedSolid made(const SolidLocateJob& job) {
  Result<LocatedSolid> result = locate_solid(job);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  return result ? std::move(*result) : LocatedSolid{};
}
std::string refusal(const SolidLocateJob& job) {
  const Result<LocatedSolid> result = locate_solid(job);
  EXPECT_FALSE(result.has_value());
  return result ? "" : result.error().message;
}
bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }
std::string warnings(const LocatedSolid& located) {
  std::string all;
  for (const std::string& one : located.document.warnings) all += one + "\n";
  return all;
}

verify::Verdict verdict(const SolidLocateJob& job, const std::string& result, const std::string& mesh) {
  const Result<Verified> done =
      verify({"result.json", result},
             [&](const std::string& role, const std::string&) -> Result<std::optional<File>> {
               if (role == "part") return job.part;
               if (role == "points") return job.blank;
               if (role == "nominal") return job.nominal;
               return File{job.outputs.mesh, mesh};
             });
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
  return done ? done->report.verdict : verify::Verdict::refuted;
}

TEST(JobsLocateTouches, TheNominalMeshIsMovedAndThePlacementHoldsInTheTrueCasting) {
  for (const double ball : {0.0, 2.0}) {
    Touched t = touched(ball);
    const LocatedSolid located = made(t.job);
    ASSERT_TRUE(located.holds());
    EXPECT_GT(*located.document.clearance, 4.2);
    const solid::Motion motion = motion_of(located.document.pose);
    for (const Vector p : cases::block({-45, -35, -25}, {45, 35, 25}).vertices)
      EXPECT_TRUE(t.casting.is_material(motion(p)));
    const Json json = Json::parse(located.result);
    EXPECT_EQ(json["inputs"][1]["path"], "here.ply");
    EXPECT_EQ(json["inputs"][2]["role"], "points");
    EXPECT_EQ(json["inputs"][2]["points"], 60);
    EXPECT_EQ(json["inputs"][3]["role"], "nominal");
    EXPECT_EQ(json["inputs"][3]["triangles"], 12);
    EXPECT_EQ(json["scan"]["assumptions"].size(), 3U);
    EXPECT_EQ(json["scan"]["touches"]["form"], 0.1);
    EXPECT_EQ(verdict(t.job, located.result, located.mesh), verify::Verdict::unproved);
    t.job.options.method = SolidMethod::certified, t.job.options.shift = 0.05, t.job.options.tilt_deg = 0.05;
    const LocatedSolid proved = made(t.job);
    EXPECT_EQ(verdict(t.job, proved.result, proved.mesh), verify::Verdict::confirmed);
  }
}

TEST(JobsLocateTouches, InchesAreMillimetresInside) {
  Touched t = touched();
  for (Vector& p : t.touches) p = 1 / 25.4 * p;
  const auto inches = [](Vector low, Vector high) {
    return solid_files::stl_text(cases::block(1 / 25.4 * low, 1 / 25.4 * high));
  };
  t.job.blank.bytes = solid_files::points(t.touches);
  t.job.part.bytes = inches({-45, -35, -25}, {45, 35, 25});
  t.job.nominal = File{"rough.stl", inches({-50, -40, -30}, {50, 40, 30})};
  t.job.options.units = io::SolidUnit::inch;
  const LocatedSolid located = made(t.job);
  EXPECT_TRUE(located.holds());
  EXPECT_EQ(verdict(t.job, located.result, located.mesh), verify::Verdict::unproved);
}

TEST(JobsLocateTouches, WhatTheFilesOrTheStatementsAreChangedToIsRefuted) {
  const Touched t = touched();
  const LocatedSolid located = made(t.job);
  const auto after = [&](const std::function<void(Json&)>& change) {
    Json json = Json::parse(located.result);
    change(json);
    return verdict(t.job, json.dump(), located.mesh);
  };
  EXPECT_EQ(after([](Json&) {}), verify::Verdict::unproved);
  for (const char* key : {"form", "ball"})
    EXPECT_EQ(
        after([&](Json& r) { r["scan"]["touches"][key] = 0.9 * r["scan"]["touches"][key].get<double>(); }),
        verify::Verdict::refuted)
        << key;
  EXPECT_EQ(after([](Json& r) { r["scan"]["guard"] = 0.05; }), verify::Verdict::refuted);
  EXPECT_EQ(after([](Json& r) { r["scan"]["touches"]["cuts"] = Json::array(); }), verify::Verdict::refuted);
  SolidLocateJob other = t.job;
  other.blank.bytes = solid_files::points({t.touches.rbegin(), t.touches.rend()});
  EXPECT_EQ(verdict(other, located.result, located.mesh), verify::Verdict::refuted);
}

/// Touches with the directions in which the ball left the casting.
std::string with_directions(const std::vector<Vector>& touches, const std::vector<Vector>& directions) {
  std::string text;
  for (std::size_t k = 0; k < touches.size(); ++k) {
    std::string line = solid_files::points({touches[k], directions[k]});
    line[line.find('\n')] = ' ';
    text += line;
  }
  return text;
}

TEST(JobsLocateTouches, DirectionsSayWhereTheBallMetTheCasting) {
  Random random(6);
  Touched t = touched();
  std::vector<Vector> directions;
  const std::vector<Vector> touches = cases::touches_of(t.casting, 60, 1, 0.02, random, &directions);
  t.job.blank.bytes = with_directions(touches, directions);
  const LocatedSolid located = made(t.job);
  ASSERT_TRUE(located.holds());
  EXPECT_GT(*located.document.clearance, 4.2);
  EXPECT_FALSE(says(warnings(located), "direction")) << warnings(located);
  const Json json = Json::parse(located.result);
  EXPECT_EQ(json["scan"]["touches"]["directions"], true);
  EXPECT_EQ(json["scan"]["touches"]["ball"], 2);
  EXPECT_EQ(json["scan"]["assumptions"][2],
            "each touch is the centre of a ball of 2 mm that met the blank, to within 0.02 mm, against the "
            "direction beside it");
  EXPECT_EQ(verdict(t.job, located.result, located.mesh), verify::Verdict::unproved);
  // The directions are among what is checked: the ball met the casting elsewhere, or they are not said.
  Json other = json;
  other["scan"]["touches"]["directions"] = false;
  EXPECT_EQ(verdict(t.job, other.dump(), located.mesh), verify::Verdict::refuted);
  SolidLocateJob asked = t.job;
  asked.blank.bytes = solid_files::points(touches);
  EXPECT_EQ(verdict(asked, located.result, located.mesh), verify::Verdict::refuted);
  for (Vector& n : directions) n = -n;
  asked.blank.bytes = with_directions(touches, directions);
  EXPECT_EQ(verdict(asked, located.result, located.mesh), verify::Verdict::refuted);
  EXPECT_TRUE(says(refusal(asked),
                   "touches.xyz: 60 of 60 directions lead into the nominal mesh where it fits "
                   "the touches best; a direction has to lead out of the blank"));
  // A single one is told, and where it contradicts the others nothing is given.
  for (Vector& n : directions) n = -n;
  directions[7] = -directions[7];
  asked.blank.bytes = with_directions(touches, directions);
  EXPECT_TRUE(says(refusal(asked), "the worst, touch 8 at ("));
  asked.options.touch->ball = 0, asked.options.touch->form = 1.3;
  const LocatedSolid of_points = made(asked);
  EXPECT_TRUE(says(warnings(of_points), "the directions say nothing of points of the surface"));
  EXPECT_TRUE(says(warnings(of_points),
                   "1 directions lie more than 45 degrees off that of the nominal surface, the first that of "
                   "touch 8"))
      << warnings(of_points);
}

TEST(JobsLocateTouches, ATouchThatNoMotionAllowsRefutesTheForm) {
  Touched t = touched();
  t.touches[9] = t.touches[9] + Vector{1, 1, 1};
  t.job.blank.bytes = solid_files::points(t.touches);
  const std::string message = refusal(t.job);
  EXPECT_TRUE(
      says(message, "touches.xyz: no place of the nominal mesh, within 5 mm and 2 degrees of the best fit"))
      << message;
  EXPECT_TRUE(says(message, "1 of 60 are not, the worst, touch 10 at (")) << message;
  t.job.options.scan->drop_outliers = 0.3;
  const LocatedSolid located = made(t.job);
  EXPECT_TRUE(located.holds());
  EXPECT_TRUE(says(warnings(located), "1 touches lie more than 0.3 mm off and are left out"))
      << warnings(located);
  const Json json = Json::parse(located.result);
  EXPECT_EQ(json["scan"]["left_out"], Json{9});
  EXPECT_EQ(json["scan"]["assumptions"].back(), "the 1 touches that are left out are none of the surface");
  EXPECT_EQ(verdict(t.job, located.result, located.mesh), verify::Verdict::unproved);
  // The table of deviations has the others, by their numbers in the file.
  t.job.outputs.deviations = SolidPointsForm::csv;
  const std::string table = made(t.job).deviations;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 60);
  EXPECT_TRUE(says(table, "\n8,") && says(table, "\n10,")) << table;
  EXPECT_FALSE(says(table, "\n9,")) << table;
  t.job.outputs.deviations.reset();
  t.job.options.scan->drop_outliers = 1e-9;
  EXPECT_TRUE(says(refusal(t.job), "touches.xyz: all touches are left out"));
}

TEST(JobsLocateTouches, WaysThatNothingHoldsAreTold) {
  Touched t = touched();
  std::erase_if(t.touches, [](Vector p) { return p.z < 25; });
  t.job.options.touch->shift = 1, t.job.options.touch->turn_deg = 1;
  t.job.blank.bytes = solid_files::points(t.touches);
  const LocatedSolid located = made(t.job);
  for (const char* words :
       {"hold the blank along x to better than 2 mm: touch more of the sides that look along x",
        "along y to better than 2 mm", "about z to better than 2 degrees"})
    EXPECT_TRUE(says(warnings(located), words)) << words << " is not in " << warnings(located);
  EXPECT_FALSE(says(warnings(located), "along z")) << warnings(located);
  EXPECT_LT(*located.document.clearance, 4);
}

TEST(JobsLocateTouches, FilesThatAreNoneAreRefused) {
  SolidLocateJob job = touched().job;
  std::swap(job.blank, *job.nominal);
  EXPECT_TRUE(
      says(refusal(job), "rough.obj: this is a mesh, and --nominal-blank goes with a file of touches"));
  job.blank = *job.nominal;
  EXPECT_TRUE(says(refusal(job), "touches.xyz: these are points; --nominal-blank is the mesh"));
  job = touched().job;
  job.options.scan->uncertainty = 0.5;
  EXPECT_TRUE(says(refusal(job), "a ball of 2 mm must have a radius above 1"));
  solid::Mesh open = cases::block({-50, -40, -30}, {50, 40, 30});
  open.triangles.pop_back();
  job = touched().job;
  job.nominal->bytes = solid_files::obj(open);
  EXPECT_TRUE(says(refusal(job), "rough.obj: "));
}

TEST(JobsLocateTouches, NumbersOutOfRangeAreRefused) {
  const Touched t = touched();
  const auto told = [&](const std::function<void(locate::TouchStatement&)>& change, std::size_t count = 60) {
    locate::TouchStatement stated;
    stated.form = 0.1, stated.guard = 0.02, stated.ball = 2;
    change(stated);
    std::vector<Vector> touches = t.touches;
    touches.resize(count, touches.front());
    const auto made = locate::touched_solid(t.casting.nominal(), touches, stated);
    return made ? std::string() : made.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(told([](auto&) {}), "");
  EXPECT_EQ(told([](auto& s) { s.turn = 0.25 * 3.1415926; }), "");
  for (const double wrong : {0.0, -1.0, nan, 2e9})
    EXPECT_TRUE(says(told([&](auto& s) { s.form = wrong; }), "the form deviation, ")) << wrong;
  for (const double wrong : {-1.0, nan, 2e9}) {
    EXPECT_TRUE(says(told([&](auto& s) { s.ball = wrong; }), "the diameter of the probe's ball, ")) << wrong;
    EXPECT_TRUE(says(told([&](auto& s) { s.guard = wrong; }), "the uncertainty of the touches, ")) << wrong;
    EXPECT_TRUE(says(told([&](auto& s) { s.shift = wrong; }), "the window of the nominal mesh, ")) << wrong;
    EXPECT_TRUE(says(told([&](auto& s) { s.turn = wrong; }), "an eighth of a turn")) << wrong;
  }
  EXPECT_TRUE(says(told([](auto& s) { s.turn = 0.786; }), "an eighth of a turn"));
  EXPECT_TRUE(says(told([](auto& s) { s.directions.resize(59); }), "there are 59 directions for 60 touches"));
  EXPECT_TRUE(says(told([](auto& s) { s.directions.resize(60); }), "(0, 0, 0) is no direction"));
  EXPECT_TRUE(says(told([](auto& s) { s.ball = 0.04; }), "must have a radius above 0.02 mm"));
  EXPECT_EQ(told([](auto&) {}, 0), "there are no touches");
  EXPECT_TRUE(says(told([](auto&) {}, 5001), "these are 5001 touches, and 5000 are the most"));
}

}  // namespace
}  // namespace lekalo::jobs::jobs_locate_touches_test
