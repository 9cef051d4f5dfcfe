#include "lekalo/nc/profile.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "lekalo/nc/rewrite.hpp"
#include "support/cases.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::nc_profile_test {
namespace {

using cases::Real;

/// The motions of one cut, from its pierce, and the travel before it.
struct ReadCut {
  std::uint64_t placement = 0;
  bool outline = false;
  std::vector<rs274::Step> steps;
};

/// Cut by the comments, moves by the test's own reader; every motion with the beam on belongs to a cut.
std::vector<ReadCut> read_cuts(const std::string& program) {
  std::map<std::size_t, ReadCut> by_line;
  std::istringstream lines(program);
  std::string line;
  bool on = false;
  std::size_t number = 0, current = 0;
  std::map<std::size_t, std::size_t> cut_of_line;
  while (std::getline(lines, line)) {
    ++number;
    unsigned long long id = 0;
    char what[16] = {};
    if (std::sscanf(line.c_str(), "(PLACEMENT %llu %15[A-Z]", &id, what) == 2) {
      current = number;
      by_line[current] = {id, std::string(what) == "OUTLINE", {}};
    }
    if (line.rfind("M3", 0) == 0 || line.rfind("M4", 0) == 0) on = true;
    if (line == "M5") on = false;
    if (on) cut_of_line[number] = current;
  }
  for (const rs274::Step& step : rs274::Reader().read(program))
    if (const auto found = cut_of_line.find(step.line); found != cut_of_line.end()) {
      EXPECT_GE(step.code, 1) << "a rapid with the beam on, line " << step.line;
      by_line[found->second].steps.push_back(step);
    }
  std::vector<ReadCut> cuts;
  for (auto& [begin, cut] : by_line) cuts.push_back(std::move(cut));
  return cuts;
}

ProfileOptions random_options(Random& random) {
  ProfileOptions o;
  o.post = posts()[random.below(3)];
  o.process = random.below(2) == 0 ? Process::laser : Process::plasma;
  o.unit = random.below(3) == 0 ? LengthUnit::inch : LengthUnit::millimetre;
  o.kerf_mm = random.uniform(0.1, 1.5);
  o.tolerance_mm = std::min(0.02, 0.2 * o.kerf_mm);
  o.lead = random.below(2) == 0 ? LeadShape::arc : LeadShape::line;
  o.lead_in_mm = random.below(4) == 0 ? 0 : random.uniform(0.3, 12);
  o.feed_mm_per_min = 1000;
  o.speed = 500;
  if (random.below(2) == 0) o.corners = {random.uniform(0.1, 0.9), random.uniform(0.2, 8)};
  // Leads of the holes' own, which may be too long for them as well.
  for (double up_to = random.uniform(2, 6); up_to < 40; up_to *= random.uniform(1.5, 4)) {
    const bool has_lead = random.below(4) != 0;
    o.holes.push_back(
        {up_to, has_lead ? std::optional(random.uniform(0, 8)) : std::nullopt, random.uniform(0.05, 1)});
  }
  return o;
}

TEST(NcProfile, TheKerfOfThePrintedProgramStaysOutOfEveryPart) {
  const std::size_t count = cases::case_count(25);
  std::size_t leads = 0, bare = 0, by_rule = 0, looked_at = 0;
  for (std::size_t index = 0; index < count; ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 88000 + index);
    const ProfileOptions options = random_options(random);
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->deepest_mm, options.tolerance_mm);
    const std::vector<ReadCut> cuts = read_cuts(made->text);
    std::size_t contours = 0;
    for (const ProfilePart& part : parts) contours += 1 + part.region.holes.size();
    ASSERT_EQ(cuts.size(), contours);
    ASSERT_EQ(made->cuts, contours);
    for (const ReadCut& cut : cuts) {
      ASSERT_FALSE(cut.steps.empty());
      for (std::size_t k = 0; k + 1 < cut.steps.size(); ++k)
        EXPECT_LT(rs274::distance(cut.steps[k].to, cut.steps[k + 1].from), 1e-12L);
      for (const rs274::Step& step : cut.steps)
        for (int k = 0; k <= 12; ++k)
          for (const ProfilePart& part : parts) {
            ++looked_at;
            ASSERT_LE(cases::depth_of_kerf(step.at(Real(k) / 12), part.region, options.kerf_mm),
                      Real(made->deepest_mm) + 1e-12L)
                << "line " << step.line << ", placement " << part.id << "\n"
                << made->text;
          }
    }
    bare += made->bare_starts, leads += options.lead_in_mm > 0 ? cuts.size() - made->bare_starts : 0;
    for (const std::size_t ruled : made->cuts_by_hole) by_rule += ruled;
  }
  EXPECT_GT(looked_at, 100 * count);
  EXPECT_GT(leads, count);
  EXPECT_GT(by_rule, count);
  EXPECT_GT(bare, 0U);  // leads of 12 mm in holes of 2 mm
}

/// The feeds in force at the lines of a program.
std::map<std::size_t, double> feeds(const std::string& program) {
  std::map<std::size_t, double> at_line;
  std::istringstream lines(program);
  std::string line;
  double feed = 0;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (const std::size_t f = line.find(" F"); line[0] == 'G' && f != std::string::npos)
      feed = std::stod(line.substr(f + 2));
    at_line[number] = feed;
  }
  return at_line;
}

/// The direction of a step at its beginning (0) or its end (1).
rs274::Point way_of(const rs274::Step& step, Real part) {
  const Real part_before = part > 0.5L ? part - 1e-3L : part;
  const rs274::Point a = step.at(part_before), b = step.at(part_before + 1e-3L);
  const Real size = rs274::distance(a, b);
  return {(b.x - a.x) / size, (b.y - a.y) / size};
}

TEST(NcProfile, CutsAreSlowNearTheirCornersAndNowhereElse) {
  std::size_t slow = 0, quick = 0;
  for (std::size_t index = 0; index < cases::case_count(25); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 91000 + index);
    ProfileOptions options;
    options.kerf_mm = random.uniform(0.1, 1.5), options.tolerance_mm = std::min(0.02, 0.2 * options.kerf_mm);
    options.feed_mm_per_min = 1000, options.corners = {0.25, random.uniform(0.2, 8)};
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    const std::map<std::size_t, double> feed_at = feeds(made->text);
    for (const ReadCut& cut : read_cuts(made->text)) {
      // Bare starts, so that a cut is its closed path. Corners are places along it.
      std::vector<Real> corners, perhaps, begins{0};
      for (std::size_t k = 0; k < cut.steps.size(); ++k) {
        const rs274::Step &step = cut.steps[k],
                          &before = cut.steps[(k + cut.steps.size() - 1) % cut.steps.size()];
        const Real length =
            step.arc ? std::abs(step.sweep) * step.start_radius : rs274::distance(step.from, step.to);
        const rs274::Point in = way_of(before, 1), out = way_of(step, 0);
        const Real cosine = in.x * out.x + in.y * out.y;
        if (cosine < 0.84L) (cosine < 0.837L ? corners : perhaps).push_back(begins.back());
        begins.push_back(begins.back() + length);
        if (step.arc && step.start_radius < 0.75L * options.kerf_mm && std::abs(step.sweep) > 0.576L)
          corners.push_back(begins[k]), corners.push_back(begins[k + 1]);
      }
      const Real whole = begins.back(), near = options.corners.distance_mm;
      for (std::size_t k = 0; k < cut.steps.size(); ++k)
        for (int i = 1; i < 8; ++i) {
          const Real along = begins[k] + (begins[k + 1] - begins[k]) * i / 8;
          const auto nearest = [&](const std::vector<Real>& places) {
            Real least = 1e9L;
            for (const Real place : places)
              for (const Real turn : {-whole, Real(0), whole})
                least = std::min(least, std::abs(along - place - turn));
            return least;
          };
          const Real least = nearest(corners);
          // Motions of a feed are no shorter than ten steps.
          if (std::abs(least - near) < 0.02L || nearest(perhaps) < near + 0.02L) continue;
          const bool in_corner = cut.steps[k].arc && cut.steps[k].start_radius < 0.75L * options.kerf_mm;
          const bool is_slow = feed_at.at(cut.steps[k].line) == 250;
          if (!in_corner) {
            ASSERT_EQ(is_slow, least < near) << "line " << cut.steps[k].line << " " << double(least);
          }
          (is_slow ? slow : quick) += 1;
        }
    }
  }
  EXPECT_GT(slow, 1000U);
  EXPECT_GT(quick, 1000U);
}

TEST(NcProfile, WhatIsCutGoesRoundItsPartAtHalfTheKerf) {
  for (std::size_t index = 0; index < cases::case_count(40); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    ProfileOptions options;
    options.kerf_mm = 0.4, options.feed_mm_per_min = 500, options.lead_in_mm = 1;
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    const std::vector<ReadCut> cuts = read_cuts(made->text);
    std::map<std::uint64_t, std::size_t> outline_at;
    for (std::size_t k = 0; k < cuts.size(); ++k)
      if (cuts[k].outline) outline_at[cuts[k].placement] = k;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const ReadCut& cut = cuts[k];
      // Inner before outer, and what lies in a hole before the hole's part.
      if (!cut.outline) {
        EXPECT_LT(k, outline_at.at(cut.placement));
      }
      if (cut.outline)
        for (const ProfilePart& around : parts)
          for (const geom::Contour& hole : around.region.holes)
            if (cases::is_in(cut.steps.back().to, hole, 0.05L)) {
              for (std::size_t later = 0; later < k; ++later)
                EXPECT_FALSE(cuts[later].placement == around.id && cuts[later].outline);
            }
      // Behind its lead (none here is longer than its cut) the path closes, clockwise about an outline.
      const rs274::Point end = cut.steps.back().to;
      Real area = 0;
      std::size_t begin = cut.steps.size();
      for (std::size_t s = 0; s < cut.steps.size() && begin == cut.steps.size(); ++s)
        if (rs274::distance(cut.steps[s].from, end) < 1e-12L) begin = s;
      ASSERT_LT(begin, cut.steps.size()) << "the contour does not close";
      ASSERT_LE(begin, 1U);
      for (std::size_t s = begin; s < cut.steps.size(); ++s) {
        constexpr int kPieces = 32;
        for (int i = 0; i < kPieces; ++i) {
          const rs274::Point a = cut.steps[s].at(Real(i) / kPieces),
                             b = cut.steps[s].at(Real(i + 1) / kPieces);
          area += ((a.x - end.x) * (b.y - end.y) - (a.y - end.y) * (b.x - end.x)) / 2;
        }
      }
      EXPECT_EQ(area < 0, cut.outline);
    }
    for (const ProfilePart& part : parts)
      cases::each_contour(part.region, [&](const geom::Contour& contour) {
        for (const geom::Edge& edge : contour) {
          const rs274::Point corner{edge.from.x, edge.from.y};
          Real least = 1e9L;
          for (const ReadCut& cut : cuts) {
            if (cut.placement != part.id) continue;
            for (const rs274::Step& step : cut.steps)
              least = std::min(least, cases::distance_to_step(corner, step));
          }
          EXPECT_LE(least, 0.2L + Real(made->left_over_mm) + 1e-9L)
              << "a corner of " << part.id << " is not cut";
        }
      });
  }
}

TEST(NcProfile, TwoPartsAKerfApartAreCutAndNearerOnesRefusedWithBothNames) {
  const double kerf = 0.3;
  for (std::size_t index = 0; index < cases::case_count(200); ++index) {
    Random random(cases::seed(), 99000 + index);
    const double gap = kerf + random.uniform(-0.1, 0.1);
    const bool round = random.below(2) == 0;
    const std::vector<ProfilePart> parts{
        {7, cases::region_of_contours(round ? cases::circle_contour({20, 20}, 10)
                                            : cases::box_contour(10, 10, 20, 20))},
        {3, cases::region_of_contours(cases::box_contour(30 + gap, 5, 20, 30))}};
    ProfileOptions options;
    options.kerf_mm = kerf, options.feed_mm_per_min = 500, options.lead_in_mm = 2,
    options.tolerance_mm = 0.01;
    const auto made = profile_program(parts, "two", options);
    if (gap >= kerf - options.tolerance_mm + 0.001) {
      ASSERT_TRUE(made) << gap << ": " << made.error().message;
    } else if (gap < kerf - options.tolerance_mm - 0.001) {
      ASSERT_FALSE(made) << gap;
      EXPECT_EQ(made.error().code, ErrorCode::bad_input);
      EXPECT_NE(made.error().message.find("placements 3 and 7 are too near for the kerf of 0.3 mm"),
                std::string::npos)
          << made.error().message;
    }
  }
}

TEST(NcProfile, OurOwnReaderPassesEveryProgramUnchanged) {
  for (std::size_t index = 0; index < cases::case_count(30); ++index) {
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), index);
    Random random(cases::seed(), 66000 + index);
    ProfileOptions options = random_options(random);
    if (random.below(3) == 0) {
      options.process = Process::router;
      options.depth_mm = 6, options.pass_mm = 2.5, options.plunge_mm_per_min = 200;
    }
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    const auto again = rewrite_program(made->text, "profile", 0, 0, 0, {.scan_frame = ScanFrame::wcs});
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->program, made->text);
    const auto twice = profile_program(parts, "random", options);
    EXPECT_EQ(twice->text, made->text);
  }
}

}  // namespace
}  // namespace lekalo::nc::nc_profile_test
