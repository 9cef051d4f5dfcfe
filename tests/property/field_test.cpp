#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "lekalo/field/grid.hpp"
#include "lekalo/field/voxel_model.hpp"
#include "support/cases.hpp"
#include "support/voxel_reader.hpp"

namespace lekalo::field::field_test {
namespace {

constexpr FlozForm kForms[] = {FlozForm::normalised, FlozForm::algebraic};

geom::Point somewhere(Random& random, double reach = 10) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// A star of lines with a round hole: concave corners, an arc, an island.
std::vector<geom::Region> star(Random& random, std::size_t points) {
  geom::Ring ring;
  for (std::size_t i = 0; i < points; ++i) {
    const double radius = random.uniform(8, 20);
    const auto [sine, cosine] =
        geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(points));
    ring.push_back({radius * cosine, radius * sine});
  }
  geom::Contour outer;
  for (std::size_t i = 0; i < ring.size(); ++i)
    outer.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
  const geom::Contour hole{{geom::EdgeKind::arc_ccw, {3, 1}, {3, 1}, {1, 1}}};
  auto region = geom::make_region(outer, {hole});
  if (!region) throw std::logic_error(region.error().message);
  return {*region};
}

ContourModel model_of(const std::vector<geom::Region>& regions, Logic logic, FlozForm form, double step = 2) {
  auto model = ContourModel::make(regions, {step, logic, form});
  if (!model) throw std::logic_error(model.error().message);
  return *std::move(model);
}

TEST(Floz, IsZeroOnItsSegmentAndPositiveElsewhere) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    Random random(cases::seed(), i + 1);
    const geom::Point a = somewhere(random), b = somewhere(random);
    const FlozSegment s = floz_segment(a, b), turned = floz_segment(b, a);
    const double t = random.uniform();
    const geom::Point on = a + t * (b - a), off = somewhere(random);
    for (const FlozForm form : kForms) {
      EXPECT_NEAR(floz(s, on, form).value, 0, 1e-13 * s.length * (1 + 10 / s.length));
      EXPECT_GT(floz(s, off, form).value, 0);
      EXPECT_EQ(floz(s, off, form), floz(turned, off, form));
    }
  }
}

TEST(Floz, NormalisedIsTheDistanceNearTheSegment) {
  const FlozSegment s = floz_segment({-3, 0}, {3, 0});
  for (const double d : {1e-2, 1e-4, 1e-6})
    EXPECT_NEAR(floz(s, {1, d}, FlozForm::normalised).value / d, 1, d);
}

TEST(Floz, GradientsAreDerivatives) {
  for (std::size_t i = 0; i < cases::case_count(100); ++i) {
    Random random(cases::seed(), i + 1);
    const FlozSegment s = floz_segment(somewhere(random), somewhere(random));
    const geom::Point x = somewhere(random);
    for (const FlozForm form : kForms) {
      const Jet jet = floz(s, x, form);
      if (jet.value < 0.05) continue;
      constexpr double h = 1e-5;
      const auto slope = [&](geom::Point d) {
        return (floz(s, x + d, form).value - floz(s, x - d, form).value) / (2 * h);
      };
      const double size = 1 + norm(jet.gradient) + jet.value / s.length;
      EXPECT_NEAR(jet.gradient.x, slope({h, 0}), 1e-4 * size);
      EXPECT_NEAR(jet.gradient.y, slope({0, h}), 1e-4 * size);
    }
  }
}

TEST(Floz, BoundsHoldOverTheDisc) {
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    Random random(cases::seed(), i + 1);
    const FlozSegment s = floz_segment(somewhere(random), somewhere(random));
    const geom::Point middle = somewhere(random);
    const double radius = random.uniform(0, 4);
    for (const FlozForm form : kForms) {
      const FlozBounds bounds = floz_bounds(s, middle, radius, form);
      for (int k = 0; k < 20; ++k) {
        geom::Point off = somewhere(random, 1);
        if (norm(off) > 1) off = (1 / norm(off)) * off;
        const double value = floz(s, middle + radius * off, form).value;
        EXPECT_GE(value, bounds.low);
        EXPECT_LE(value, bounds.high);
      }
    }
  }
}

TEST(ContourModel, TheOrderOfSegmentsChangesNoBit) {
  Random random(cases::seed(), 1);
  const auto regions = star(random, 9);
  auto turned = regions;
  std::rotate(turned[0].outer.begin(), turned[0].outer.begin() + 4, turned[0].outer.end());
  for (const Logic logic : {Logic::linear, Logic::quadratic}) {
    const ContourModel a = model_of(regions, logic, FlozForm::normalised),
                       b = model_of(turned, logic, FlozForm::normalised);
    for (int k = 0; k < 50; ++k) {
      const geom::Point x = somewhere(random, 25);
      EXPECT_EQ(a(x), b(x));
    }
  }
}

TEST(ContourModel, IsPositiveInsideAndUnitesAsLogicSays) {
  Random random(cases::seed(), 2);
  const auto left = model_of(star(random, 7), Logic::quadratic, FlozForm::normalised);
  const auto right = model_of(star(random, 12), Logic::linear, FlozForm::algebraic);
  for (int k = 0; k < 400; ++k) {
    const geom::Point x = somewhere(random, 25);
    const bool in_left = left.inside(x), in_right = right.inside(x);
    EXPECT_EQ(left(x).value > 0, in_left);
    EXPECT_EQ(disjunction(left(x), right(x), Logic::quadratic).value > 0, in_left || in_right);
    EXPECT_EQ(difference(left(x), right(x), Logic::quadratic).value > 0, in_left && !in_right);
    EXPECT_FALSE(in_left && norm(x - geom::Point{1, 1}) < 1.7);  // the hole
  }
}

TEST(ContourModel, RefusesWhatMakesNoModel) {
  Random random(cases::seed(), 3);
  const auto regions = star(random, 5);
  EXPECT_FALSE(ContourModel::make({}, {}));
  EXPECT_FALSE(ContourModel::make(regions, {0, Logic::linear, FlozForm::normalised}));
  EXPECT_FALSE(ContourModel::make(regions, {std::nan(""), Logic::linear, FlozForm::normalised}));
  EXPECT_FALSE(ContourModel::make(regions, {1e-9, Logic::linear, FlozForm::normalised}));
}

TEST(FieldGrid, TilesGiveWhatEveryNodeByItselfGives) {
  for (std::size_t i = 0; i < cases::case_count(4); ++i) {
    Random random(cases::seed(), i + 1);
    const auto regions = star(random, 5 + 9 * i);
    const GridFrame frame{{-22, -21}, 0.31, 143, 139};
    for (const FlozForm form : kForms) {
      const ContourModel model = model_of(regions, Logic::linear, form);
      const FieldGrid grid = sample(model, frame, 2), distance = sample_distance(model, frame, 2);
      EXPECT_EQ(grid.value, sample(model, frame, 1).value);
      EXPECT_EQ(grid.dx, sample(model, frame, 1).dx);
      for (std::size_t j = 0; j < frame.rows; j += 3) {
        for (std::size_t c = 0; c < frame.columns; ++c) {
          const geom::Point x = frame.node(c, j);
          const double exact = model(x).value, found = static_cast<double>(grid.value[j * frame.columns + c]);
          const double allowed = kFieldGridError * std::max({std::abs(exact), frame.pitch, 2.0});
          ASSERT_NEAR(found, exact, allowed) << x.x << " " << x.y;
          // Where one segment has the least value by more than what a value may be off, the gradient is its.
          std::vector<double> values;
          for (const FlozSegment& segment : model.segments()) values.push_back(floz(segment, x, form).value);
          std::partial_sort(values.begin(), values.begin() + 2, values.end());
          if (values[1] - values[0] > 2 * allowed) {
            const std::size_t n = j * frame.columns + c;
            const geom::Point gradient{static_cast<double>(grid.dx[n]), static_cast<double>(grid.dy[n])};
            const Jet jet = model(x);
            ASSERT_LE(norm(gradient - jet.gradient),
                      kFieldGridGradientError * std::max(1.0, norm(jet.gradient)))
                << x.x << " " << x.y << " " << exact;
          }
          double nearest = 1e9;
          for (const auto& chord : model.chords()) {
            const geom::Point way = chord.b - chord.a;
            const double t = std::clamp(dot(x - chord.a, way) / dot(way, way), 0.0, 1.0);
            nearest = std::min(nearest, norm(x - (chord.a + t * way)));
          }
          if (!model.inside(x)) nearest = -nearest;
          ASSERT_NEAR(static_cast<double>(distance.value[j * frame.columns + c]), nearest,
                      kFieldGridError * std::max({std::abs(nearest), frame.pitch, 2.0}));
        }
      }
    }
  }
}

TEST(VoxelImages, ValueAndGradientAreReadBackWithinTheStatedError) {
  Random random(cases::seed(), 6);
  const ContourModel model = model_of(star(random, 8), Logic::quadratic, FlozForm::normalised);
  const GridFrame frame{{-20, -20}, 0.8, 51, 51};
  const FieldGrid grid = sample(model, frame);
  for (const std::uint16_t palette : {std::uint16_t{255}, std::uint16_t{65535}}) {
    const VoxelImages images = voxel_images(grid, palette);
    for (std::size_t n = 0; n < frame.size(); ++n) {
      const std::size_t i = n % frame.columns, j = n / frame.columns;
      const Jet node{static_cast<double>(grid.value[n]),
                     {static_cast<double>(grid.dx[n]), static_cast<double>(grid.dy[n])}};
      const Jet read = cases::read_node(images, i, j);
      const cases::ReadingError error = cases::reading_error(images, i, j, node);
      EXPECT_LE(std::abs(read.value - node.value), error.value);
      EXPECT_LE(norm(read.gradient - node.gradient), 1.5 * error.gradient);
      EXPECT_FALSE(palette == 65535 && node.value > 0 && error.value > 0.05);
    }
  }
}

}  // namespace
}  // namespace lekalo::field::field_test
