// The bounds of boxes by contacts: at no pose of a box is there more clearance than a single contact allows.

#include "locate/solid/solid_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "locate/solid/solid_placement.hpp"
#include "support/cases.hpp"
#include "support/castings.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate::locate_solid_bound_test {
namespace {

using solid::Motion;
using solid::Vector;

Vector within(Vector middle, Vector half, Random& random) {
  // Ends and corners of the box as often as its inside.
  const auto one = [&](double m, double h) {
    return m + h * (random.below(2) == 0 ? (random.below(2) == 0 ? -1 : 1) : random.uniform(-1, 1));
  };
  return {one(middle.x, half.x), one(middle.y, half.y), one(middle.z, half.z)};
}

SolidCell about(const FramedPose& middle, const FramedPose& half) {
  return {{middle.x - half.x, middle.at - half.at}, {middle.x + half.x, middle.at + half.at}};
}

FramedPose within(const SolidCell& cell, Random& random) {
  const FramedPose middle = cell.middle(), half = cell.half();
  return {within(middle.x, half.x, random), within(middle.at, half.at, random)};
}

/// What terms say about a box with these multipliers.
double bound_of(const std::vector<SolidForm>& terms, const CellView& view, Random& random) {
  PoseForm sum;
  double least = -kInfinity;
  for (const SolidForm& term : terms) {
    sum.add(random.uniform(0, 1), term.form);
    least = std::max(least, term.least);
  }
  return std::max(least, sum.most(view));
}

cases::SolidCase one_of_three(std::uint64_t i, Random& random) {
  return i % 3 == 0   ? cases::cored_block(random, 4)
         : i % 3 == 1 ? cases::turned_part(random, 12)
                      : cases::wavy_part(random, 8);
}

/// The part begins where it fits.
SolidProblem lying_there(const cases::SolidCase& pair) {
  SolidProblem problem{pair.part, pair.blank, {}};
  for (Vector& p : problem.part.vertices) p = pair.there(p);
  return problem;
}

TEST(SolidMeter, PlanesOfAConvexBlankSayWhatPairsOfTrianglesDo) {
  Random random(cases::seed(), 81);
  std::size_t inside = 0, outside = 0;
  for (std::uint64_t i = 0; i < cases::case_count(8); ++i) {
    cases::SolidCase pair = cases::convex_in_convex(random, 16, random.uniform(0.5, 2), i % 2 == 1);
    // Of many vertices the tree finds the foremost ones.
    if (i % 4 == 3) pair.part = cases::refined(std::move(pair.part), 4);
    SolidProblem problem = lying_there(pair);
    problem.shift = 2, problem.turn = 0.1;
    const SolidMeter meter(problem, frame_of(problem));
    ASSERT_TRUE(meter.convex());
    for (int k = 0; k < 20; ++k) {
      const FramedPose middle = meter.frame().window.middle(), half = meter.frame().window.half();
      const FramedPose pose =
          within(about(middle, {k * k / 400.0 * half.x, k * k / 400.0 * half.at}), random);
      std::vector<SolidContact> contacts;
      const MeasuredSolid exact = meter.measure_pairs(pose, kInfinity, 64, contacts),
                          by_planes = meter.measure(pose, kInfinity, 64, contacts);
      ASSERT_EQ(by_planes.inside, exact.inside);
      ++(exact.inside ? inside : outside);
      for (const SolidContact& contact : contacts)
        EXPECT_EQ(SolidMeter::over_plane(meter.frame().motion(pose), contact).distance, contact.distance);
      if (!exact.inside) continue;
      EXPECT_NEAR(by_planes.value, exact.value, 1e-9);
      EXPECT_EQ(meter.measure(pose, 0.5 * exact.value, 64, contacts).value, 0.5 * exact.value);
      EXPECT_TRUE(contacts.empty());
    }
  }
  EXPECT_GT(inside, 20u);
  EXPECT_GT(outside, 20u);
}

TEST(SolidMeter, ABlankWithADentOrACoreOrWidthsIsNotConvex) {
  Random random(cases::seed(), 83);
  const cases::SolidCase pair = cases::convex_in_convex(random, 16, 1), cored = cases::cored_block(random, 4);
  const auto convex = [](const SolidProblem& problem) {
    return SolidMeter(problem, frame_of(problem)).convex();
  };
  EXPECT_TRUE(convex({pair.part, pair.blank, {}}));
  EXPECT_FALSE(convex({cored.part, cored.blank, {}}));
  SolidProblem problem{pair.part, pair.blank, {}};
  problem.blank_widths.assign(pair.blank.triangles.size(), 0.1);
  EXPECT_FALSE(convex(problem));
  problem.blank_widths.clear();
  const solid::Box box = box_of(pair.blank.vertices);
  problem.blank.vertices.front() = 0.3 * problem.blank.vertices.front() + 0.35 * (box.low + box.high);
  EXPECT_FALSE(convex(problem));
  // A void, and a body beside it.
  for (const double at : {0.0, 100.0}) {
    problem.blank = pair.blank;
    const auto first = static_cast<std::uint32_t>(problem.blank.vertices.size());
    for (const solid::Vector v : pair.blank.vertices)
      problem.blank.vertices.push_back(0.1 * v + solid::Vector{at, 0, 0});
    for (const auto& [a, b, c] : pair.blank.triangles)
      problem.blank.triangles.push_back({first + a, first + c, first + b});
    EXPECT_FALSE(convex(problem));
  }
}

TEST(SolidMeter, AGlanceMeetsNothingNearerThanAMeasurement) {
  Random random(cases::seed(), 82);
  std::size_t inside = 0, crossing = 0;
  for (std::uint64_t i = 0; i < cases::case_count(9); ++i) {
    const cases::SolidCase pair = one_of_three(i, random);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem = lying_there(pair);
    problem.shift = 1, problem.turn = 0.02;
    const SolidMeter meter(problem, frame_of(problem));
    for (int k = 0; k < 4; ++k) {
      const FramedPose middle = meter.frame().window.middle(), half = meter.frame().window.half();
      const FramedPose pose = within(about(middle, {k * k / 9.0 * half.x, k * k / 9.0 * half.at}), random);
      std::vector<SolidContact> contacts;
      const MeasuredSolid measured = meter.measure(pose, kInfinity, 64, contacts);
      const double least = meter.glance(pose, kInfinity, 12, contacts);
      ASSERT_FALSE(contacts.empty());
      double lowest = kInfinity;
      for (const SolidContact& contact : contacts) {
        lowest = std::min(lowest, contact.margin());
        EXPECT_NEAR(norm(meter.frame().motion(pose)(contact.part) - contact.blank),
                    std::abs(contact.distance), 1e-9);
      }
      EXPECT_EQ(least, lowest);
      if (measured.inside) {
        ++inside;
        EXPECT_GE(least, measured.value);
        EXPECT_LT(least, measured.value + 1);
        EXPECT_EQ(meter.glance(pose, measured.value - 1e-6, 12, contacts), measured.value - 1e-6);
        EXPECT_TRUE(contacts.empty());
      } else if (least < 0) {
        ++crossing;
      }
    }
  }
  EXPECT_GT(inside, 3u);
  EXPECT_GT(crossing, 3u);
}

TEST(SolidMeter, AProbeMeetsContactsBelowABoundAndNothingNearerThanAMeasurement) {
  Random random(cases::seed(), 83);
  std::size_t met = 0, nearest = 0, of_demands = 0;
  for (std::uint64_t i = 0; i < cases::case_count(9); ++i) {
    const cases::SolidCase pair = one_of_three(i, random);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem = lying_there(pair);
    problem.shift = 0.3, problem.turn = 0.005;
    for (std::size_t t = 0; t < problem.blank.triangles.size(); ++t)
      problem.blank_widths.push_back(random.uniform(0.01, 0.05));
    const bool demands = i % 3 == 1;
    if (demands)
      for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
        problem.demands.push_back(SolidDemand{t % 2 == 0 ? 0.1 : 0.2, 1});
    const SolidMeter meter(problem, frame_of(problem));
    for (int k = 0; k < 4; ++k) {
      const FramedPose pose = within(meter.frame().window, random);
      std::vector<SolidContact> contacts;
      const MeasuredSolid measured = meter.measure(pose, kInfinity, 64, contacts);
      if (!measured.inside) continue;
      const double most = measured.value + random.uniform(0.01, 0.5);
      const double least = meter.probe(pose, most, contacts);
      double lowest = most;
      for (const SolidContact& contact : contacts) {
        lowest = std::min(lowest, contact.margin());
        EXPECT_LT(contact.margin(), most + 1e-9);
        EXPECT_NEAR(norm(meter.frame().motion(pose)(contact.part) - contact.blank) -
                        meter.width(contact.blank_triangle),
                    contact.distance, 1e-9);
      }
      EXPECT_EQ(least, lowest);
      EXPECT_GE(least, measured.value - 1e-9);
      met += contacts.empty() ? 0 : 1;
      nearest += least < measured.value + 1e-6 ? 1 : 0;
      of_demands += demands && !contacts.empty() ? 1 : 0;
      EXPECT_EQ(meter.probe(pose, measured.value - 1e-6, contacts), measured.value - 1e-6);
      EXPECT_TRUE(contacts.empty());
    }
  }
  EXPECT_GT(met, 9u);
  EXPECT_GT(nearest, met / 2);
  EXPECT_GT(of_demands, 0u);
}

TEST(SolidBounds, NoContactAllowsLessThanAPoseOfTheBoxHas) {
  Random random(cases::seed(), 81);
  std::size_t inside = 0, tight = 0;
  for (std::uint64_t i = 0; i < cases::case_count(12); ++i) {
    const cases::SolidCase pair = one_of_three(i, random);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem = lying_there(pair);
    SolidFrame frame;
    frame.start = {1, 0, 0, 0};
    const solid::Box box = box_of(problem.part.vertices);
    frame.pivot = 0.5 * (box.low + box.high);
    for (const Vector p : problem.part.vertices) frame.reach = std::max(frame.reach, norm(p - frame.pivot));
    frame.window = about({{}, frame.pivot}, {{0.3, 0.3, 0.3}, {9, 9, 9}});
    const SolidMeter meter(problem, frame);
    const SolidBounds bounds(meter);
    // Contacts of poses about the right one, some of them crossing.
    std::vector<KnownSolid> known;
    std::vector<SolidContact> contacts;
    for (const double size : {0.0, 0.3, 3.0}) {
      const double turn = size / 100;
      const FramedPose pose{within({}, {turn, turn, turn}, random),
                            within(frame.pivot, {size, size, size}, random)};
      (void)meter.measure(pose, 4, 64, contacts);
      for (std::size_t k = 0; k < contacts.size(); k += 1 + contacts.size() / 12)
        if (auto made = bounds.known(contacts[k], pose)) known.push_back(std::move(*made));
    }
    for (int cell_number = 0; cell_number < 24; ++cell_number) {
      const double size = 2 * std::pow(0.4, cell_number % 8), turn = size / 100 * random.uniform(0, 2);
      FramedPose half{{turn, random.uniform(0, 1) * turn, turn}, {size, size, random.uniform(0, 1) * size}};
      if (cell_number % 4 == 0) half.x = {0, 0, turn};
      const SolidCell cell = about(
          {within({}, {0.004, 0.004, 0.004}, random), within(frame.pivot, {0.3, 0.3, 0.3}, random)}, half);
      const CellView view(meter, cell);
      std::vector<SolidForm> terms;
      for (const KnownSolid& one : known)
        if (const auto row = bounds.row(one, view)) terms.push_back(*bounds.form(one, row->choice, view));
      ASSERT_FALSE(terms.empty());
      std::vector<double> most;
      for (const SolidForm& term : terms) most.push_back(bound_of({term}, view, random));
      for (std::size_t k = 0; k + 3 < terms.size(); k += 2)
        most.push_back(bound_of({terms[k], terms[k + 1], terms[k + 3]}, view, random));
      for (int k = 0; k < 12; ++k) {
        const FramedPose pose = within(cell, random);
        const MeasuredSolid here = meter.measure(pose, std::numeric_limits<double>::infinity(), 64, contacts);
        if (!here.inside) continue;
        ++inside;
        for (const double bound : most) {
          EXPECT_GE(bound, here.value);
          if (bound < here.value + 0.02) ++tight;
        }
      }
    }
  }
  EXPECT_GT(inside, 300u);
  EXPECT_GT(tight, 100u);
}

/// A small block as it lies anywhere.
solid::Mesh thrown(Vector half, Vector middle, Random& random) {
  solid::Mesh mesh = cases::block(-half, half);
  Motion motion = cases::turn(cases::direction(random), random.uniform(0, 3));
  motion.shift = middle;
  for (Vector& p : mesh.vertices) p = motion(p);
  return mesh;
}

/// A part near a small void far inside a blank: one contact of a vertex and a face, or of two edges, is all
/// that counts, and it soon leaves the face or the edge.
TEST(SolidBounds, ALoneContactAllowsWhatThePosesOfTheBoxHave) {
  Random random(cases::seed(), 82);
  std::size_t inside = 0, tight = 0;
  std::map<SolidTerm::Kind, std::size_t> kinds;
  for (std::uint64_t i = 0; i < cases::case_count(400); ++i) {
    Vector large{6, 5, 4}, small{1.5, 2, 2.5};
    if (i % 2 == 0) std::swap(large, small);
    SolidProblem problem{thrown(large, {}, random), cases::block({-60, -60, -60}, {60, 60, 60}), {}};
    const Vector way = cases::direction(random);
    cases::append(problem.blank, thrown(small, random.uniform(9, 12) * way, random));
    SolidFrame frame;
    frame.start = {1, 0, 0, 0};
    for (const Vector p : problem.part.vertices) frame.reach = std::max(frame.reach, norm(p));
    frame.window = about({}, {{0.3, 0.3, 0.3}, {9, 9, 9}});
    const SolidMeter meter(problem, frame);
    const SolidBounds bounds(meter);
    std::vector<SolidContact> contacts;
    const MeasuredSolid start = meter.measure({}, 20, 1, contacts);
    if (!start.inside || contacts.empty()) continue;
    const auto known = bounds.known(contacts.front(), {});
    ASSERT_TRUE(known);
    for (int cell_number = 0; cell_number < 4; ++cell_number) {
      const double size = random.uniform(0.02, 1) * start.value, turn = size / 10 * random.uniform(0, 1);
      const SolidCell cell =
          about({within({}, {0.01, 0.01, 0.01}, random), within({}, {0.1, 0.1, 0.1}, random)},
                {{turn, turn, turn}, {size, size, size}});
      const CellView view(meter, cell);
      const SolidRow row = *bounds.row(*known, view);
      ++kinds[row.choice.kind];
      const double bound = bound_of({*bounds.form(*known, row.choice, view)}, view, random);
      for (int k = 0; k < 12; ++k) {
        const FramedPose pose = within(cell, random);
        const MeasuredSolid here = meter.measure(pose, std::numeric_limits<double>::infinity(), 1, contacts);
        if (!here.inside) continue;
        ++inside;
        EXPECT_GE(bound, here.value);
        // The tangent is near what the term says at its pose.
        const Steps z{pose.at.x - view.middle.at.x,
                      pose.at.y - view.middle.at.y,
                      pose.at.z - view.middle.at.z,
                      2 * frame.reach * (pose.x.x - view.middle.x.x),
                      2 * frame.reach * (pose.x.y - view.middle.x.y),
                      2 * frame.reach * (pose.x.z - view.middle.x.z)};
        double value = row.bound.level;
        for (std::size_t n = 0; n < 6; ++n) value += row.bound.slope[n] * z[n];
        if (std::abs(value - here.value) < 0.02) ++tight;
      }
    }
  }
  EXPECT_GT(inside, 3000u);
  EXPECT_GT(tight, 300u);
  EXPECT_GT(kinds[SolidTerm::Kind::ball], 30u);
  EXPECT_GT(kinds[SolidTerm::Kind::face], 30u);
  EXPECT_GT(kinds[SolidTerm::Kind::part_face], 30u);
  EXPECT_GT(kinds[SolidTerm::Kind::edges], 30u);
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_bound_test
