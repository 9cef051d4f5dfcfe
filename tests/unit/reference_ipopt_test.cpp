#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "lekalo/locate/convex.hpp"
#include "lekalo/locate/reference.hpp"
#include "lekalo/phi/convex.hpp"
#include "locate/reference/ipopt_model.hpp"
#include "support/cases.hpp"

namespace lekalo::locate::reference_ipopt_test {
namespace {

using Stage = NonlinearModel::Stage;
using Variables = NonlinearModel::Variables;

Variables shifted(Variables z, std::size_t variable, double by) {
  z[variable] += by;
  return z;
}

class NonlinearModelDerivatives : public testing::TestWithParam<Stage> {
 protected:
  static constexpr double kStep = 1e-5;  // central differences: error about kStep^2
  const cases::LocateCase case_ = cases::random_case(1, 0, cases::Kind::plain);
  const NonlinearModel model_{case_.part, case_.blank};
  const Variables z_{0.11, -0.07, 0.83, 0.6};
};

TEST_P(NonlinearModelDerivatives, JacobianAgreesWithFiniteDifferences) {
  std::vector<double> jacobian(4 * model_.rows()), above(model_.rows()), below(model_.rows());
  model_.jacobian(GetParam(), z_, jacobian.data());
  for (std::size_t variable = 0; variable < 4; ++variable) {
    model_.constraints(GetParam(), shifted(z_, variable, kStep), above.data());
    model_.constraints(GetParam(), shifted(z_, variable, -kStep), below.data());
    for (std::size_t row = 0; row < model_.rows(); ++row) {
      ASSERT_NEAR(jacobian[4 * row + variable], (above[row] - below[row]) / (2 * kStep), 1e-9)
          << "row " << row << " variable " << variable;
    }
  }
}

TEST_P(NonlinearModelDerivatives, HessianAgreesWithFiniteDifferencesOfTheJacobian) {
  Random random(2);
  std::vector<double> multipliers;
  for (std::size_t row = 0; row < model_.rows(); ++row) multipliers.push_back(random.uniform(-1, 1));
  double hessian[NonlinearModel::kHessianEntries];
  model_.hessian(GetParam(), z_, multipliers.data(), hessian);
  std::vector<double> above(4 * model_.rows()), below(4 * model_.rows());
  for (std::size_t i = 0; i < 4; ++i) {
    model_.jacobian(GetParam(), shifted(z_, i, kStep), above.data());
    model_.jacobian(GetParam(), shifted(z_, i, -kStep), below.data());
    for (std::size_t j = 0; j < 4; ++j) {
      double difference = 0;
      for (std::size_t row = 0; row < model_.rows(); ++row) {
        difference += multipliers[row] * (above[4 * row + j] - below[4 * row + j]) / (2 * kStep);
      }
      const double expected = i == 2 && j == 2 ? hessian[0] : i + j == 5 ? hessian[1] : 0.0;
      ASSERT_NEAR(expected, difference, 1e-7) << i << ", " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothStages, NonlinearModelDerivatives,
                         testing::Values(Stage::homothety, Stage::clearance));

TEST(NonlinearModel, HoldsThePhiFunctionInItsOwnUnits) {
  const auto c = cases::random_case(cases::seed(), 3, cases::Kind::far);
  const NonlinearModel model(c.part, c.blank);
  const geom::Box box = geom::bounds(c.blank.vertices());
  const double scale = 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const Variables z = model.variables({{c.x, c.y}, c.theta}, 0);
  std::vector<double> values(model.rows());
  model.constraints(Stage::clearance, z, values.data());
  const double least = *std::min_element(values.begin(), values.end());
  const auto exact = phi::clearance_enclosure(c.part, c.blank, c.x, c.y, c.theta);
  EXPECT_NEAR(scale * least, exact.low, 1e-14 * c.largest_coordinate);

  const auto back = model.placement(z);
  EXPECT_NEAR(back.translation.x, c.x, 1e-14 * c.largest_coordinate);
  EXPECT_NEAR(back.translation.y, c.y, 1e-14 * c.largest_coordinate);
}

#ifdef LEKALO_WITH_IPOPT

TEST(LocateIpopt, EndsOnALocalOptimumOfEveryPublishedExample) {
  // The certified search knows all local optima. On examples 2, 3 and 5 the starts that the homothety stage
  // gives all lead to the lower of two peaks (docs/design/reference-methods.md).
  for (const auto& example : cases::published_examples()) {
    ConvexOptions all;
    all.alternatives = 1.0;
    const auto certified = locate_convex({example.part(), example.blank(), {}, 0, 0}, all).value();
    ASSERT_TRUE(certified.alternatives_complete) << example.name;
    IpoptOptions options;
    options.starts = 3;
    options.seed = cases::seed();
    const auto result = locate_ipopt(example.part(), example.blank(), options);
    ASSERT_TRUE(result) << example.name;
    EXPECT_TRUE(result->found && result->converged) << example.name;
    EXPECT_EQ(result->starts_done, 3) << example.name;
    EXPECT_LE(result->best.clearance, certified.upper_bound) << example.name;
    double nearest = std::abs(result->best.clearance - certified.best.clearance);
    for (const Placement& other : certified.alternatives)
      nearest = std::min(nearest, std::abs(result->best.clearance - other.clearance));
    EXPECT_LE(nearest, 1e-6) << example.name << " seed " << options.seed;
  }
}

TEST(LocateIpopt, GivesTheSameBytesForTheSameSeedAndOtherStartsForAnother) {
  const auto example = cases::published_examples()[2];
  IpoptOptions options;
  options.starts = 2;
  const auto first = locate_ipopt(example.part(), example.blank(), options).value();
  const auto second = locate_ipopt(example.part(), example.blank(), options).value();
  options.seed = 1;
  const auto other = locate_ipopt(example.part(), example.blank(), options).value();
  EXPECT_EQ(first.best.x, second.best.x);
  EXPECT_EQ(first.best.y, second.best.y);
  EXPECT_EQ(first.best.theta, second.best.theta);
  EXPECT_EQ(first.best.clearance, second.best.clearance);
  EXPECT_EQ(first.iterations, second.iterations);
  EXPECT_NE(first.iterations, other.iterations);
}

TEST(LocateIpopt, KeepsTheAngleInTheWindow) {
  const auto example = cases::published_examples()[0];
  for (const AngleWindow window : {AngleWindow{0.02, 0.2}, AngleWindow{0.05, 0.05}}) {
    IpoptOptions options;
    options.starts = 2;
    options.window = window;
    const auto result = locate_ipopt(example.part(), example.blank(), options).value();
    EXPECT_GE(result.best.theta, window.from);
    EXPECT_LE(result.best.theta, window.to);
    EXPECT_LT(result.best.clearance, example.optimum - 1e-3)
        << "the optimum is at angle 0, outside the window";
  }
}

TEST(LocateIpopt, StartsFromAlignedOutlines) {
  const auto example = cases::published_examples()[0];
  IpoptOptions options;
  options.start_rule = StartRule::principal_axes;
  const auto axes = locate_ipopt(example.part(), example.blank(), options).value();
  EXPECT_LE(axes.starts_done + axes.starts_rejected, 2) << "there are two such angles";
  EXPECT_NEAR(axes.best.clearance, example.optimum, 1e-6);
  options.start_rule = StartRule::centroids;
  EXPECT_NEAR(locate_ipopt(example.part(), example.blank(), options).value().best.clearance, example.optimum,
              1e-6);
}

TEST(LocateIpopt, SaysThatNothingWasFoundWhenThePartIsTooLarge) {
  const auto part = cases::regular_ngon(5, 11), blank = cases::regular_ngon(4, 10);
  IpoptOptions options;
  options.starts = 2;
  const auto result = locate_ipopt(part, blank, options).value();
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.starts_done, 0);
  EXPECT_EQ(result.starts_rejected, 2 * kDrawsPerStart);
  EXPECT_LT(result.best.clearance, 0);
  EXPECT_GT(result.best.clearance, -11) << "the least bad pose seen, not any pose";
  const auto& best = result.best;
  EXPECT_EQ(best.clearance, phi::clearance_enclosure(part, blank, best.x, best.y, best.theta).low);
}

TEST(LocateIpopt, StopsWhenToldAndKeepsToItsBudget) {
  const auto example = cases::published_examples()[0];
  IpoptOptions options;
  const std::atomic<bool> stop{true};
  options.run.stop = &stop;
  auto result = locate_ipopt(example.part(), example.blank(), options).value();
  EXPECT_EQ(result.starts_done, 0);
  EXPECT_FALSE(result.found);

  options.run = {};
  options.run.work_limit = 0;
  result = locate_ipopt(example.part(), example.blank(), options).value();
  EXPECT_EQ(result.iterations, 0u);
  EXPECT_TRUE(std::isfinite(result.best.clearance));

  options.run.work_limit = 1;
  double fraction = 0;
  options.run.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.work, 1u);
    fraction = progress.fraction;
  };
  result = locate_ipopt(example.part(), example.blank(), options).value();
  EXPECT_EQ(result.starts_done + result.starts_rejected, 1);
  EXPECT_EQ(fraction, 1);
}

TEST(LocateIpopt, RefusesWhatItCannotDoInOneSentence) {
  const auto square = cases::regular_ngon(4, 10);
  IpoptOptions options;
  options.starts = 0;
  auto result = locate_ipopt(square, square, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::usage);

  const auto many = cases::regular_ngon(501, 10);
  result = locate_ipopt(many, many, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::usage);
  EXPECT_NE(result.error().message.find("501 x 501"), std::string::npos) << result.error().message;

  options = {};
  options.window = {1, 0};
  EXPECT_FALSE(locate_ipopt(square, square, options));
}

#endif

}  // namespace
}  // namespace lekalo::locate::reference_ipopt_test
