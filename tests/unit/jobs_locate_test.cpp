#include "lekalo/jobs/locate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>

#include "jobs/locate/locate_checked.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/verify.hpp"
#include "support/io_contours.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

namespace lekalo::jobs::jobs_locate_test {
namespace {

const io_cases::GridRing kPart{{0, 0}, {80, 0}, {80, 40}, {0, 40}};
const io_cases::GridRing kBlank{{100, 100}, {190, 100}, {190, 150}, {100, 150}};
const std::string kProgram = "%\nG21 G90 G17\nG54\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F100\nG1 X70\nG0 Z5\nM2\n%\n";

/// A plate with 5 mm of material all round, as points.
LocateJob plate_job() {
  LocateJob job;
  job.part = {"folder/part.csv", io_cases::csv(kPart, 0)};
  job.blank = {"blank.csv", io_cases::csv(kBlank, 0)};
  return job;
}

/// The same as regions, in the angle that fits, and not to the last digit.
LocateJob region_job() {
  LocateJob job;
  job.part = {"folder/part.json", io_cases::region(kPart, 0)};
  job.blank = {"blank.csv", io_cases::csv(kBlank, 0)};
  job.options.window_to_deg = 0;
  job.options.locked.x = 105;
  job.options.gap = 0.05;
  return job;
}

Located made(const LocateJob& job) {
  Result<Located> result = locate(job);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  return result ? std::move(*result) : Located{};
}

Error refusal(const LocateJob& job) {
  const Result<Located> result = locate(job);
  EXPECT_FALSE(result.has_value());
  return result ? Error{} : result.error();
}

bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

/// The verdict of `lekalo verify` on the result, from the files of the job.
verify::Verdict verdict(const LocateJob& job, const Located& located) {
  const Result<Verified> done =
      verify({"result.json", located.result},
             [&](const std::string& role, const std::string&) -> Result<std::optional<File>> {
               if (role == "certificate") return File{"c.json", located.certificate};
               if (role == "part") return job.part;
               if (role == "nc") return job.program;
               if (role == "NC program") return File{"o.nc", located.program};
               if (role == "deviations") return File{"d.csv", located.deviations};
               if (role == "features") return job.features;
               if (role == "last-result") return job.earlier;
               return role == "blank" ? std::optional(job.blank) : std::nullopt;
             });
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
  return done ? done->report.verdict : verify::Verdict::refuted;
}

/// Points every millimetre along the blank, which is dented by one or the other of two hundredths.
std::string measured(double loop_at) {
  std::string points;
  for (int k = 0; k < 280; ++k) {
    const double dent = 0.01 * (k * 7 % 3), s = k;
    const auto [x, y] = s < 90    ? std::pair{100 + s, 100 + dent}
                        : s < 140 ? std::pair{190 - dent, s + 10}
                        : s < 230 ? std::pair{330 - s, 150 - dent}
                                  : std::pair{100 + dent, 380 - s};
    points += std::to_string(s == loop_at ? x - 1.5 : x) + "," + std::to_string(y) + "\n";
  }
  return points;
}

TEST(JobsLocate, AScanThatIsGivenAsAnOutlineIsRecognised) {
  LocateJob job = region_job();
  const auto hint = [](const std::string& text) {
    return says(text, "looks like a scan: --uncertainty MM") && says(text, "blank.csv");
  };
  const auto hints = [&](const Located& located) {
    const auto& warnings = located.document.warnings;
    return std::count_if(warnings.begin(), warnings.end(), hint);
  };
  EXPECT_EQ(hints(made(job)), 0);
  job.blank.bytes = measured(-1);
  EXPECT_EQ(hints(made(job)), 1);
  job.blank.bytes = measured(40);
  EXPECT_TRUE(hint(refusal(job).message)) << refusal(job).message;
}

TEST(JobsLocate, BytesGoInAndAProvedDocumentComesOut) {
  for (const LocateJob& job : {plate_job(), region_job()}) {
    const Located located = made(job);
    const auto json = cases::Json::parse(located.result);
    EXPECT_EQ(json["status"], "optimal");
    EXPECT_NEAR(located.document.placement.clearance, 5, 0.05);
    EXPECT_GE(located.document.upper_bound.value_or(0), 5);
    EXPECT_EQ(located.result, io::result_json(located.document));
    ASSERT_EQ(located.document.inputs.size(), 2U);
    EXPECT_EQ(located.document.inputs[0].role, "part");
    EXPECT_EQ(located.document.inputs[0].file.path, job.part.name);
    EXPECT_EQ(located.document.inputs[1].file.sha256, io::sha256(job.blank.bytes));
    EXPECT_TRUE(located.holds());
    EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
  }
}

/// Along a spike each box of placements was made as short as the part reaches before the part turned less in
/// it, so that the work was gone before anything was proved.
TEST(JobsLocate, OnePointOfTheBlankFarAwayDoesNotUseUpTheWork) {
  LocateJob job;
  job.part = {"part.json", io_cases::region(kPart, 0)};
  job.blank = {
      "blank.csv",
      io_cases::csv({{100, 100}, {190, 100}, {190, 110}, {1'000'000, 112}, {190, 150}, {100, 150}}, 0)};
  const Located located = made(job);
  EXPECT_EQ(located.document.status, "optimal");
  EXPECT_NEAR(located.document.placement.clearance, 5, 0.01);
  EXPECT_LT(located.document.work, 100'000U);
}

TEST(JobsLocate, ConvexPolygonsAreTakenAsSuchUnlessSomethingNeedsRegions) {
  LocateJob job = plate_job();
  EXPECT_TRUE(made(job).document.convex());
  job.part = {"part.json", io_cases::region(kPart, 0)};
  EXPECT_TRUE(made(job).document.convex());
  job.options = region_job().options;
  EXPECT_FALSE(made(job).document.convex());
  job.options.locked = {};
  job.options.mirror = locate::Mirror::yes;
  const Located mirrored = made(job);
  EXPECT_FALSE(mirrored.document.convex());
  EXPECT_TRUE(mirrored.document.mirrored);
}

TEST(JobsLocate, OnlyWhatIsAskedForIsMade) {
  LocateJob job = plate_job();
  const auto beside = [](const Located& l) {
    return std::vector<std::string>{l.certificate, l.deviations, l.program, l.picture,
                                    l.report,      l.allowances, l.drawing};
  };
  EXPECT_EQ(beside(made(job)), std::vector<std::string>(7));
  job.outputs.certificate = "c.json", job.outputs.deviations = "d.csv", job.outputs.program = "o.nc";
  job.outputs.picture = PictureForm::svg, job.outputs.report = PictureForm::pdf;
  job.outputs.drawing = DrawingFormat::dxf, job.outputs.allowances = true;
  job.program = File{"part.nc", kProgram};
  const Located located = made(job);
  const std::vector<std::string> documents = beside(located);
  const char* const begin_with[] = {"{", "index,x,y,deviation\n", "%\n", "<svg", "%PDF", "", "0\nSECTION\n"};
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_FALSE(documents[k].empty()) << k;
    EXPECT_TRUE(says(documents[k].substr(0, 300), begin_with[k])) << k << documents[k].substr(0, 300);
  }
  ASSERT_TRUE(located.document.certificate_file && located.document.deviations && located.document.nc);
  EXPECT_EQ(located.document.certificate_file->sha256, io::sha256(located.certificate));
  EXPECT_EQ(located.document.deviations->file.path, "d.csv");
  EXPECT_EQ(located.document.nc->output.sha256, io::sha256(located.program));
  EXPECT_EQ(verdict(job, located), verify::Verdict::confirmed);
}

/// What is handed out is what the checker confirms: of a search that is wrong in any way, nothing.
TEST(JobsLocate, AWrongFindingIsWithheld) {
  using Lie = std::function<void(locate::Found&)>;
  const std::vector<std::pair<const char*, Lie>> lies{
      {"more clearance than there is", [](locate::Found& f) { f.best.clearance += 0.1; }},
      {"a bound below the best", [](locate::Found& f) { *f.upper_bound -= 0.2; }},
      {"another place", [](locate::Found& f) { f.best.y += 0.5; }},
      {"another angle", [](locate::Found& f) { f.best.theta += 0.01; }},
      {"no proof",
       [](locate::Found& f) {
         if (auto* angles = std::get_if<locate::AngleProof>(&f.proof)) angles->intervals.clear();
         if (auto* poses = std::get_if<locate::PoseProof>(&f.proof)) poses->trees.clear();
       }},
      {"half a proof", [](locate::Found& f) {
         if (auto* angles = std::get_if<locate::AngleProof>(&f.proof))
           angles->intervals.resize(angles->intervals.size() / 2);
         if (auto* poses = std::get_if<locate::PoseProof>(&f.proof))
           poses->trees.front().box.low = poses->trees.front().box.high;
       }}};
  for (const LocateJob& job : {plate_job(), region_job()}) {
    const auto with = [&](const Lie& lie) {
      return locate_checked(
          [&](const locate::Problem& problem, const LocateOptions& options) {
            Result<Search> search = searched(problem, options, {}, {});
            if (search) lie(search->found);
            return search;
          },
          job);
    };
    EXPECT_TRUE(with([](locate::Found&) {}).has_value());
    for (const auto& [what, lie] : lies) {
      const Result<Located> result = with(lie);
      ASSERT_FALSE(result.has_value()) << what << " of " << job.part.name;
      EXPECT_EQ(result.error().code, ErrorCode::refuted) << what;
      EXPECT_TRUE(says(result.error().message, "self-check")) << what << ": " << result.error().message;
    }
  }
}

TEST(JobsLocate, AnAllowanceThatThePartJustHasIsClaimedAndNoMore) {
  LocateJob job = plate_job();
  job.options.min_allowance = 5;
  const Located just = made(job);
  EXPECT_EQ(just.document.placement.clearance, 5);
  EXPECT_EQ(just.document.shortfall, 0);
  EXPECT_TRUE(just.holds());
  job.options.min_allowance = 5 + 1e-12;
  const Located more = made(job);
  EXPECT_GT(more.document.shortfall, 0);
  EXPECT_FALSE(more.holds());
}

TEST(JobsLocate, AProgramThatItsRoundingSpoilsIsWithheld) {
  LocateJob job = plate_job();
  job.program = File{"part.nc", kProgram};
  job.outputs.program = "o.nc";
  job.options.min_allowance = 5;
  // The pose is a double, and needs more digits than the program has.
  job.blank.bytes = io_cases::csv(
      {{1000009765625, 0}, {1900009765625, 0}, {1900009765625, 500000000000}, {1000009765625, 500000000000}},
      10);
  const Located located = made(job);
  EXPECT_TRUE(located.program.empty());
  EXPECT_TRUE(located.program_withheld);
  EXPECT_FALSE(located.holds());
  ASSERT_FALSE(located.document.warnings.empty());
  EXPECT_TRUE(says(located.document.warnings.back(), "its rounding to the written decimals"))
      << located.document.warnings.back();
}

TEST(JobsLocate, OnlyTheSecondsComeFromTheStopwatch) {
  double now = 7;
  const Result<Located> timed = locate(plate_job(), {}, [&] { return now += 2.5; });
  ASSERT_TRUE(timed);
  EXPECT_EQ(timed->document.seconds, 2.5);
  io::LocateDocument same = timed->document;
  same.seconds = 0;
  EXPECT_EQ(io::result_json(same), made(plate_job()).result);
}

// The time of `--time` may be up while the result is checked. That Ctrl-C ends the check, e2e.stopped holds.
TEST(JobsLocate, AStopAtTheEndOfTheSearchLosesNothing) {
  const LocateJob job = region_job();
  std::atomic<bool> time_is_up = false, interrupt = false;
  const auto set_after_the_search = [&](std::atomic<bool>& flag) {
    RunControl run;
    run.stop = &flag;
    // It is read before and after the search.
    int reads = 0;
    const Stopwatch stopwatch = [&] {
      flag = ++reads == 2;
      return 0.0;
    };
    return stoppable(run, [&] { return locate(job, {}, stopwatch, &interrupt); });
  };
  for (std::atomic<bool>* flag : {&time_is_up, &interrupt}) {
    const auto in_time = set_after_the_search(*flag);
    EXPECT_TRUE(*flag);
    ASSERT_TRUE(in_time.has_value()) << in_time.error().what();
    ASSERT_TRUE(in_time->has_value());
    EXPECT_EQ((*in_time)->result, made(job).result);
    *flag = false;
  }
}

TEST(JobsLocate, TheRunCanBeStopped) {
  RunControl run;
  run.work_limit = 12;
  LocateJob convex;
  for (const auto& [file, name] : {std::pair{&convex.part, "part"}, {&convex.blank, "blank"}}) {
    file->name = std::string(name) + ".csv";
    file->bytes =
        disk::read_file(cases::source_dir() + "/examples/localisation/example-3-" + file->name).value();
  }
  LocateJob mirrored = convex, either = convex;
  mirrored.options.mirror = locate::Mirror::yes;
  either.options.mirror = locate::Mirror::either;  // nothing is left for the second of two searches
  for (const LocateJob& job : {convex, mirrored, either}) {
    const Result<Located> stopped = locate(job, run);
    ASSERT_TRUE(stopped) << stopped.error().message;
    EXPECT_EQ(stopped->document.status, "stopped");
    EXPECT_EQ(verdict(job, *stopped), verify::Verdict::confirmed);
  }
}

TEST(JobsLocate, ErrorsNameTheFileAndThePlace) {
  using Change = std::function<void(LocateJob&)>;
  const std::vector<std::tuple<Change, ErrorCode, std::vector<const char*>>> cases{
      {[](LocateJob& j) { j.blank.bytes += "100 oops\n"; },
       ErrorCode::bad_input,
       {"blank.csv: line 5", "oops"}},
      {[](LocateJob& j) { j.part.bytes = "0 0\n80 0\n40 0\n"; }, ErrorCode::bad_input, {"folder/part.csv"}},
      {[](LocateJob& j) {
         j.part = {"p.json", R"({"outer": [{"line": {"from": [0, 0]}}]})"};
       },
       ErrorCode::bad_input,
       {"p.json", "edge 0", "\"to\""}},
      {[](LocateJob& j) {
         j.part = region_job().part;
         j.part.bytes.replace(j.part.bytes.find("}}"), 2, R"(}, "open": true})");
         j.options = region_job().options;
       },
       ErrorCode::bad_input,
       {"folder/part.json", "(0, 0)", "only pockets have open edges"}},
      {[](LocateJob& j) {
         j.options.trim = 1;
         j.options.mirror = locate::Mirror::yes;
       },
       ErrorCode::usage,
       {"--trim is for convex contours"}},
      {[](LocateJob& j) { j.outputs.picture = PictureForm::pdf; }, ErrorCode::usage, {"SVG or PNG"}},
      {[](LocateJob& j) {
         j.earlier = File{"old.json", "{}"};
       },
       ErrorCode::bad_input,
       {"old.json"}},
      {[](LocateJob& j) {
         j.features = File{"f.json", R"({"features": [{"minimum": 1}]})"};
       },
       ErrorCode::bad_input,
       {"f.json"}},
      {[](LocateJob& j) {
         j.program = File{"part.nc", "G21 G90 G17\nG54\nG0 X0 Y0\nM101\nM2\n"};
         j.outputs.program = "o.nc";
       },
       ErrorCode::program_refused,
       {"part.nc", "4"}}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& [change, code, words] = cases[k];
    LocateJob job = plate_job();
    change(job);
    const Error error = refusal(job);
    EXPECT_EQ(error.code, code) << k;
    for (const char* word : words) EXPECT_TRUE(says(error.message, word)) << k << ": " << error.message;
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_locate_test
