// Parts with minima larger than the walls beside them. A result is never refuted by the check before it is
// handed out, and means what dense samples of the outlines say.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/verify.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"

namespace lekalo::locate_walls_test {
namespace {

using cases::Json;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

Json line(double x0, double y0, double x1, double y1) {
  return Json{{"line", {{"from", {x0, y0}}, {"to", {x1, y1}}}}};
}
Json arc(double x0, double y0, double x1, double y1, double x, double y) {
  return Json{{"arc", {{"from", {x0, y0}}, {"to", {x1, y1}}, {"centre", {x, y}}, {"ccw", true}}}};
}
Json box(double x, double y, double to_x, double to_y) {
  return {line(x, y, to_x, y), line(to_x, y, to_x, to_y), line(to_x, to_y, x, to_y), line(x, to_y, x, y)};
}
Json bore(double x, double y, double r) { return Json::array({arc(x + r, y, x + r, y, x, y)}); }
Json slot(double x, double y, double length, double r) {
  return {line(x, y - r, x + length, y - r), arc(x + length, y - r, x + length, y + r, x + length, y),
          line(x + length, y + r, x, y + r), arc(x, y + r, x, y - r, x, y)};
}

/// Numbers of few digits, so that often two of them are equal or make up a third.
double round(double value) { return std::round(2 * value) / 2; }

/// A plate with a bore and a slot, the features of its file, and a blank that has a hole every other time.
struct Case {
  Json part, blank, features;
};
Case case_of(std::uint64_t index) {
  Random random(cases::seed(), 4000 + index);
  const auto number = [&](double from, double to) { return round(random.uniform(from, to)); };
  const double width = number(60, 120), height = number(30, 60);
  const double r = number(2, 6), wall = number(1, 8), half = number(1.5, 4), length = number(4, 15);
  const double x = width - r - number(1, 20);
  Case c;
  c.part = {{"units", "mm"}, {"outer", box(0, 0, width, height)}};
  c.part["holes"] = {bore(x, r + wall, r),
                     slot(half + number(1, 8), height - half - number(1, 6), length, half)};
  // A cut corner, or a notch.
  if (random.below(2) == 0) {
    c.part["outer"] = {line(0, 0, width, 0),
                       line(width, 0, width, height),
                       line(width, height, width / 2, height),
                       line(width / 2, height, width / 2 - 4, height - 6),
                       line(width / 2 - 4, height - 6, width / 2 - 8, height),
                       line(width / 2 - 8, height, 0, height),
                       line(0, height, 0, 0)};
  }
  const double more = number(0, 30);
  const double to_x = width + more + number(0, 15), to_y = height + more + number(0, 15);
  c.blank = {{"units", "mm"}, {"outer", box(0, 0, to_x, to_y)}};
  if (random.below(2) == 0) c.blank["holes"] = {bore(to_x - 6, to_y - 6, number(0.5, 5))};
  const auto minimum = [&] {
    switch (random.below(4)) {
      case 0:
        return 0.0;
      case 1:
        return number(0, 2);
      case 2:
        return number(0, 4 * wall);
      default:
        return number(0, 40);
    }
  };
  c.features = {{"units", "mm"}, {"minimum", random.below(2) == 0 ? 0.0 : number(0, 3)}};
  c.features["features"] = Json::array();
  const auto add = [&](const char* name, int contour) {
    Json f{{"name", name}, {"contour", contour}, {"minimum", minimum()}};
    if (random.below(4) == 0) f["scale"] = number(0.5, 3);
    if (random.below(12) == 0) f = Json{{"name", name}, {"contour", contour}, {"finished", number(0.5, 3)}};
    c.features["features"].push_back(f);
  };
  if (random.below(3) == 0) add("outline", 0);
  add("bore", 1);
  if (random.below(2) == 0) add("slot", 2);
  return c;
}

/// Dense points of an edge's contour and what is demanded there.
struct Sample {
  Point at;
  double minimum = 0, scale = 1;
};
constexpr double kSpacing = 0.25;

std::vector<Sample> samples_of(const std::vector<geom::Region>& part, const io::DemandRecord& demands) {
  std::vector<Edge> edges;
  for (const geom::Region& region : part) {
    edges.insert(edges.end(), region.outer.begin(), region.outer.end());
    for (const geom::Contour& hole : region.holes) edges.insert(edges.end(), hole.begin(), hole.end());
  }
  std::vector<Sample> samples;
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    Sample sample{{}, demands.minimum, 1};
    bool finished = false;
    for (const locate::Feature& f : demands.features)
      if (std::find(f.edges.begin(), f.edges.end(), k) != f.edges.end())
        sample.minimum = f.minimum, sample.scale = f.scale, finished = f.finished.has_value();
    if (finished) continue;
    const Edge& e = edges[k];
    const bool is_line = e.kind == EdgeKind::line;
    const double length = is_line ? norm(e.to - e.from) : geom::arc_radius(e) * geom::arc_sweep(e);
    const int pieces = 1 + static_cast<int>(length / kSpacing);
    for (int i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      sample.at = e.from + share * (e.to - e.from);
      if (!is_line) {
        const double turn = share * geom::arc_sweep(e) * (e.kind == EdgeKind::arc_ccw ? 1 : -1);
        sample.at = e.centre + geom::BlankFromPart::from_angle(turn, {})(e.from - e.centre);
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

/// The least margin of the samples; minus infinity where one lies outside the blank, or a hole of the blank
/// in the part's material.
double sampled_margin(const std::vector<Sample>& samples, const geom::RegionIndex& part,
                      const geom::RegionIndex& blank, const geom::BlankFromPart& pose) {
  for (std::size_t c = 1; c + 1 < blank.contour_starts().size(); ++c)
    if (part.contains(pose.inverse()(blank.curves()[blank.contour_starts()[c]].edge.centre))) return -1e300;
  double least = 1e300;
  for (const Sample& s : samples) {
    const Point p = pose(s.at);
    if (!blank.contains(p)) return -1e300;
    least = std::min(least, (blank.nearest(p).distance - s.minimum) / s.scale);
  }
  return least;
}

TEST(LocateWalls, EveryResultIsConfirmedAndSamplesSayTheSame) {
  std::size_t met = 0, missing = 0;
  for (std::uint64_t i = 0; i < cases::case_count(30); ++i) {
    const Case c = case_of(i);
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << cases::seed() << "\npart "
                                    << c.part.dump() << "\nblank " << c.blank.dump() << "\nfeatures "
                                    << c.features.dump());
    jobs::LocateJob job{.part = {"part.json", c.part.dump()}, .blank = {"blank.json", c.blank.dump()}};
    job.features = jobs::File{"features.json", c.features.dump()};
    Random random(cases::seed(), 5000 + i);
    job.options.window_from_deg = -3, job.options.window_to_deg = random.below(3) == 0 ? 90 : 3;
    job.options.gap = 0.01;
    RunControl run;
    run.work_limit = random.below(4) == 0 ? 10 : 3000;  // cells are large where it ends at once
    const auto made = jobs::locate(job, run);
    if (!made && made.error().code == ErrorCode::bad_input) continue;  // holes that meet
    ASSERT_TRUE(made) << made.error().message;
    const auto verified =
        jobs::verify({"r.json", made->result},
                     [&](const std::string& role, const std::string&) -> Result<std::optional<jobs::File>> {
                       if (role == "certificate") return jobs::File{"c.json", made->certificate};
                       return role == "part" ? job.part : (role == "blank" ? job.blank : *job.features);
                     });
    ASSERT_TRUE(verified) << verified.error().message;
    EXPECT_NE(verified->report.verdict, verify::Verdict::refuted);
    EXPECT_NE(verified->report.verdict, verify::Verdict::unproved);

    const io::LocateDocument& d = made->document;
    const geom::RegionIndex part(d.part), blank(d.blank);
    const std::vector<Sample> samples = samples_of(d.part, *d.demands);
    const auto at = [&](const locate::Placement& p) {
      return sampled_margin(samples, part, blank, geom::BlankFromPart::from_angle(p.theta, {p.x, p.y}));
    };
    const bool finished = std::any_of(d.demands->features.begin(), d.demands->features.end(),
                                      [](const locate::Feature& f) { return f.finished.has_value(); });
    double least_scale = 1e300;
    for (const Sample& s : samples) least_scale = std::min(least_scale, s.scale);
    const double off = 0.5 * kSpacing / least_scale;
    ++(d.demands->margin >= 0 ? met : missing);
    if (d.demands->margin >= 0) {
      EXPECT_GE(at(d.placement), d.demands->margin - 1e-9);
      const bool is_least = finished || at(d.placement) <= d.demands->margin + off + 1e-9;
      EXPECT_TRUE(is_least) << at(d.placement) << " " << d.demands->margin;
    }
    for (int k = 0; k < 300 && !finished; ++k) {
      const double far = k < 150 ? 2 : 20;
      const locate::Placement there{
          d.placement.x + random.uniform(-far, far), d.placement.y + random.uniform(-far, far),
          std::clamp(d.placement.theta + random.uniform(-0.05, 0.05), job.options.window_from_deg * kDegree,
                     job.options.window_to_deg * kDegree),
          0};
      const double margin = at(there);
      if (margin < off) continue;
      EXPECT_LE(margin - off, d.demands->margin_bound) << there.x << ' ' << there.y << ' ' << there.theta;
    }
  }
  EXPECT_GT(met, 0U);
  EXPECT_GT(missing, 0U);
}

}  // namespace
}  // namespace lekalo::locate_walls_test
