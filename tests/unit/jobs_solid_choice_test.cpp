// Placements of solids that a criterion chooses, and how faces with demands are shown.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "lekalo/jobs/locate_solid.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"

namespace lekalo::jobs::jobs_solid_choice_test {
namespace {

/// A block of 40 x 30 x 20 in one that has 6 mm more along x and 4 along y and z. With 2 mm left all around
/// it may lie anywhere along 2 mm of x.
SolidLocateJob block_job() {
  SolidLocateJob job;
  job.part = {"part.obj", solid_files::obj(cases::block({-20, -15, -10}, {20, 15, 10}))};
  job.blank = {"casting.obj", solid_files::obj(cases::block({-22, -17, -13}, {24, 17, 11}))};
  job.options.method = SolidMethod::climb;
  job.options.criterion = SolidCriterion::largest;
  job.options.give_up = 0.1;
  return job;
}

TEST(JobsSolidChoice, TheDeepestPlaceLiesLessDeep) {
  SolidLocateJob job = block_job();
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  const io::SolidDocument& d = located->document;
  ASSERT_TRUE(d.choice && d.choice->largest && d.choice->margin_found);
  EXPECT_EQ(d.choice->criterion, "largest");
  EXPECT_EQ(d.choice->give_up, 0.1);
  EXPECT_GE(*d.choice->largest, 3);
  EXPECT_LE(*d.choice->largest, 3.02);
  EXPECT_GE(*d.clearance, *d.choice->margin_found - 0.1);
  EXPECT_NEAR(*d.choice->margin_found, 2, 1e-3);
  EXPECT_EQ(d.status, "unproved");
  // What is demanded is not given up.
  job.options.give_up = 1, job.options.min_allowance = 1.99;
  const auto held = locate_solid(job);
  ASSERT_TRUE(held) << held.error().message;
  EXPECT_EQ(held->document.shortfall(), 0);
}

TEST(JobsSolidChoice, TargetsAreCloserAfterTheCriterionEven) {
  SolidLocateJob job = block_job();
  job.blank.bytes = solid_files::obj(cases::block({-22, -20, -16}, {24, 20, 16}));
  job.options.criterion = SolidCriterion::even, job.options.give_up = 0.6;
  job.features = {"f.json", R"({"as_cast": true, "features": [
      {"name": "left", "plane": {"normal": [1, 0, 0], "at": -20, "within": 0.001}, "target": 2.5},
      {"name": "right", "plane": {"normal": [1, 0, 0], "at": 20, "within": 0.001}, "target": 3.5}]})"};
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  const io::SolidDocument& d = located->document;
  ASSERT_TRUE(d.choice && d.choice->deviation && d.choice->largest_found);
  EXPECT_EQ(d.choice->criterion, "even");
  EXPECT_LE(*d.choice->largest, *d.choice->largest_found + 0.6);
  EXPECT_EQ(d.demands->features[0].target, 2.5);
  EXPECT_NEAR(d.pose.shift.x, 0.5, 0.01);
  EXPECT_LE(*d.choice->deviation, 0.01);
  // Without, either side has 3.
  job.options.criterion = SolidCriterion::largest;
  const auto shallow = locate_solid(job);
  ASSERT_TRUE(shallow) << shallow.error().message;
  EXPECT_FALSE(shallow->document.choice->deviation || shallow->document.choice->largest_found);
  EXPECT_NEAR(shallow->document.pose.shift.x, 1, 0.02);
}

TEST(JobsSolidChoice, NothingIsGivenUpWhereTheDemandIsNotMet) {
  SolidLocateJob job = block_job();
  job.options.min_allowance = 2.5;
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  EXPECT_EQ(located->document.choice->margin_found, located->document.clearance);
  job.options.criterion = SolidCriterion::smallest;
  const auto best = locate_solid(job);
  ASSERT_TRUE(best) << best.error().message;
  EXPECT_FALSE(best->document.choice);
  EXPECT_EQ(best->document.pose.shift, located->document.pose.shift);
}

TEST(JobsSolidChoice, APartThatIsNotInsideHasNoNumbers) {
  SolidLocateJob job = block_job();
  job.options.freedom = locate::SolidFreedom::xyz, job.options.shift = 0;
  job.part.bytes = solid_files::obj(cases::block({-30, -15, -10}, {30, 15, 10}));
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  EXPECT_FALSE(located->document.inside());
  ASSERT_TRUE(located->document.choice);
  EXPECT_FALSE(located->document.choice->margin_found || located->document.choice->largest);
}

TEST(JobsSolidChoice, AnOffsetIsOfTheChosenPose) {
  SolidLocateJob job = block_job();
  job.options.freedom = locate::SolidFreedom::c_xyz;
  job.options.give_up = 0;
  job.options.offset.emplace().form.control = nc::OffsetControl::siemens;
  job.outputs.offset = "offset.mpf";
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  EXPECT_FALSE(located->offset.empty());
  EXPECT_LE(*located->document.choice->largest, 3.02);
  EXPECT_GE(*located->document.clearance, *located->document.choice->margin_found);
}

TEST(JobsSolidChoice, ThreadsChangeNothing) {
  SolidLocateJob job = block_job();
  job.options.threads = 1;
  const auto one = locate_solid(job);
  job.options.threads = 3;
  const auto three = locate_solid(job);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->document.pose.shift, three->document.pose.shift);
  EXPECT_EQ(one->document.choice->largest, three->document.choice->largest);
  EXPECT_EQ(one->document.work, three->document.work);
}

/// The top is finished, 1 mm below the blank's, and has a rim.
SolidLocateJob finished_job(const std::string& rim) {
  SolidLocateJob job = block_job();
  job.options.freedom = locate::SolidFreedom::xyz;
  job.options.criterion = SolidCriterion::smallest;
  job.features = {"f.json", R"({"minimum": 0.5, "features": [{"name": "top", "plane":
      {"normal": [0, 0, 1], "at": 10, "within": 0.001}, "finished": 1.5, "rim": )" +
                                rim + "}]}"};
  return job;
}

TEST(JobsSolidChoice, RimsAreShownAsWhatDemandsNothing) {
  SolidLocateJob job = finished_job("6");
  job.outputs.picture = SolidPictureForm::ply;
  const auto located = locate_solid(job);
  ASSERT_TRUE(located) << located.error().message;
  // Vertices of three doubles and a number, and three bytes of colour.
  const std::string& ply = located->picture;
  const std::string count_word = "element vertex ";
  const std::size_t count = std::stoul(ply.substr(ply.find(count_word) + count_word.size()));
  const std::size_t body = ply.find("end_header\n") + 11;
  std::size_t plain = 0, coloured = 0;
  double highest = -1e9, lowest_plain = 1e9;
  for (std::size_t k = 0; k < count; ++k) {
    double z = 0, left = 0;
    std::memcpy(&z, ply.data() + body + 35 * k + 16, 8);
    std::memcpy(&left, ply.data() + body + 35 * k + 24, 8);
    const double in_part = z - located->document.pose.shift.z;
    if (std::isnan(left)) {
      ++plain;
      lowest_plain = std::min(lowest_plain, in_part);
    } else {
      ++coloured;
      highest = std::max(highest, in_part);
    }
  }
  EXPECT_GT(plain, 0U);
  EXPECT_GT(coloured, 0U);
  // Triangles are told apart by their middles, and are about a millimetre wide.
  EXPECT_NEAR(highest, 4, 1.5);
  EXPECT_NEAR(lowest_plain, 4, 1.5);
}

TEST(JobsSolidChoice, RimsThatLeaveNothingAreRefusedWithTheFile) {
  const auto located = locate_solid(finished_job("100"));
  ASSERT_FALSE(located);
  EXPECT_EQ(located.error().code, ErrorCode::bad_input);
  EXPECT_EQ(located.error().message,
            "f.json: nothing that demands an allowance is left beside the finished faces and their rims; "
            "make the rims narrower");
}

}  // namespace
}  // namespace lekalo::jobs::jobs_solid_choice_test
