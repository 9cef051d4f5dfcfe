// The bounds of boxes by contacts: at no pose of a box is there more clearance than a single contact allows.

#include "locate/solid/solid_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "support/cases.hpp"
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

/// The steps of the program that lead from the middle of a cell to a pose.
Steps steps(const SolidFrame& frame, const FramedPose& middle, const FramedPose& pose) {
  const Vector d = pose.x - middle.x, at = pose.at - middle.at;
  const Vector y =
      2 * frame.reach / (1 + dot(middle.x, middle.x) + dot(middle.x, d)) * (d + cross(middle.x, d));
  return {at.x, at.y, at.z, y.x, y.y, y.z};
}

TEST(SolidBounds, NoContactAllowsLessThanAPoseOfTheBoxHas) {
  Random random(cases::seed(), 81);
  std::size_t inside = 0, tight = 0;
  for (std::uint64_t i = 0; i < cases::case_count(12); ++i) {
    const cases::SolidCase pair = i % 3 == 0   ? cases::cored_block(random, 4)
                                  : i % 3 == 1 ? cases::turned_part(random, 12)
                                               : cases::wavy_part(random, 8);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem{pair.part, pair.blank, {}};
    for (Vector& p : problem.part.vertices) p = pair.there(p);
    SolidFrame frame;
    frame.start = {1, 0, 0, 0};
    const solid::Box box = box_of(problem.part.vertices);
    frame.pivot = 0.5 * (box.low + box.high);
    for (const Vector p : problem.part.vertices) frame.reach = std::max(frame.reach, norm(p - frame.pivot));
    frame.window = {{{}, frame.pivot}, {{0.3, 0.3, 0.3}, {9, 9, 9}}};
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
        known.push_back(bounds.known(contacts[k], frame.motion(pose)));
    }
    for (int cell_number = 0; cell_number < 24; ++cell_number) {
      const double size = 2 * std::pow(0.4, cell_number % 8), turn = size / 100 * random.uniform(0, 2);
      SolidCell cell{
          {within({}, {0.004, 0.004, 0.004}, random), within(frame.pivot, {0.3, 0.3, 0.3}, random)},
          {{turn, random.uniform(0, 1) * turn, turn}, {size, size, random.uniform(0, 1) * size}}};
      if (cell_number % 4 == 0) cell.half.x = {0, 0, turn};
      const CellView view(frame, cell);
      std::vector<SolidRow> rows;
      for (const KnownSolid& one : known) rows.push_back(bounds.row(one, view));
      for (int k = 0; k < 12; ++k) {
        const FramedPose pose{within(cell.middle.x, cell.half.x, random),
                              within(cell.middle.at, cell.half.at, random)};
        const Steps z = steps(frame, cell.middle, pose);
        for (std::size_t n = 0; n < 6; ++n) EXPECT_LE(std::abs(z[n]), view.half[n] * (1 + 1e-12) + 1e-12);
        const MeasuredSolid here = meter.measure(pose, std::numeric_limits<double>::infinity(), 64, contacts);
        if (!here.inside) continue;
        ++inside;
        for (const SolidRow& row : rows) {
          double value = row.bound.level;
          for (std::size_t n = 0; n < 6; ++n) value += row.bound.slope[n] * z[n];
          EXPECT_GE(std::max(value, -row.radius) + bounds.rounding(), here.value);
          if (value < here.value + 0.02) ++tight;
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
  std::size_t inside = 0, tight = 0, edges = 0, of_part = 0, of_blank = 0;
  for (std::uint64_t i = 0; i < cases::case_count(400); ++i) {
    Vector large{6, 5, 4}, small{1.5, 2, 2.5};
    if (i % 2 == 0) std::swap(large, small);
    SolidProblem problem{thrown(large, {}, random), cases::block({-60, -60, -60}, {60, 60, 60}), {}};
    const Vector way = cases::direction(random);
    cases::append(problem.blank, thrown(small, random.uniform(9, 12) * way, random));
    SolidFrame frame;
    frame.start = {1, 0, 0, 0};
    for (const Vector p : problem.part.vertices) frame.reach = std::max(frame.reach, norm(p));
    frame.window = {{}, {{0.3, 0.3, 0.3}, {9, 9, 9}}};
    const SolidMeter meter(problem, frame);
    const SolidBounds bounds(meter);
    std::vector<SolidContact> contacts;
    const MeasuredSolid start = meter.measure({}, 20, 1, contacts);
    if (!start.inside || contacts.empty()) continue;
    const KnownSolid known = bounds.known(contacts.front(), frame.motion({}));
    edges += known.edges.has_value();
    of_part += known.part_disc.radius > 0.3;
    of_blank += known.blank_disc.radius > 0.3;
    for (int cell_number = 0; cell_number < 4; ++cell_number) {
      const double size = random.uniform(0.02, 1) * start.value, turn = size / 10 * random.uniform(0, 1);
      const SolidCell cell{{within({}, {0.01, 0.01, 0.01}, random), within({}, {0.1, 0.1, 0.1}, random)},
                           {{turn, turn, turn}, {size, size, size}}};
      const CellView view(frame, cell);
      const SolidRow row = bounds.row(known, view);
      for (int k = 0; k < 12; ++k) {
        const FramedPose pose{within(cell.middle.x, cell.half.x, random),
                              within(cell.middle.at, cell.half.at, random)};
        const MeasuredSolid here = meter.measure(pose, std::numeric_limits<double>::infinity(), 1, contacts);
        if (!here.inside) continue;
        ++inside;
        const Steps z = steps(frame, cell.middle, pose);
        double value = row.bound.level;
        for (std::size_t n = 0; n < 6; ++n) value += row.bound.slope[n] * z[n];
        EXPECT_GE(std::max(value, -row.radius) + bounds.rounding(), here.value);
        if (value < here.value + 0.02) ++tight;
      }
    }
  }
  EXPECT_GT(inside, 3000u);
  EXPECT_GT(tight, 300u);
  EXPECT_GT(edges, 30u);
  EXPECT_GT(of_part, 30u);
  EXPECT_GT(of_blank, 30u);
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_bound_test
