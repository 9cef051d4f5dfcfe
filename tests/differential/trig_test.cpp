// Our sine, cosine and direction angle against MPFR.

#include "lekalo/geom/trig.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <cstdint>

#include "lekalo/geom/double_double.hpp"

namespace lekalo::geom::trig_test {
namespace {

class Real {
 public:
  explicit Real(double value) { mpfr_init2(value_, 300), mpfr_set_d(value_, value, MPFR_RNDN); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  mpfr_ptr get() { return value_; }
  /// |this - pair|
  double distance_to(DoubleDouble pair) {
    Real difference(0);
    mpfr_sub_d(difference.get(), value_, pair.hi, MPFR_RNDN);
    mpfr_sub_d(difference.get(), difference.get(), pair.lo, MPFR_RNDN);
    return std::abs(mpfr_get_d(difference.get(), MPFR_RNDN));
  }

 private:
  mpfr_t value_;
};

/// Angles that matter: small, ordinary, near multiples of pi/4, near the limit.
template <class Check>
void for_many_angles(Check check) {
  std::uint64_t state = 7;
  const auto uniform = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 40000; ++i) {
    const double u = uniform();
    check((u - 0.5) * 14.0);
    check((u - 0.5) * 2 * kMaxAngle);
    check(std::ldexp(u, -static_cast<int>(uniform() * 60)));
    const double eighth = std::floor((uniform() - 0.5) * 200) * 0.78539816339744830962;
    check(eighth + std::ldexp(u - 0.5, -static_cast<int>(uniform() * 55)));
  }
  check(0.0), check(kMaxAngle), check(-kMaxAngle);
}

TEST(Trig, SineAndCosineAreWithinTheStatedError) {
  double worst = 0, worst_pair = 0;
  for_many_angles([&](double theta) {
    Real angle(theta), sine(0), cosine(0);
    mpfr_sin_cos(sine.get(), cosine.get(), angle.get(), MPFR_RNDN);
    const SinCos sc = sincos(theta);
    worst = std::max({worst, sine.distance_to({sc.sine, 0}), cosine.distance_to({sc.cosine, 0})});
    const SinCosPair pair = sincos_double_double(theta);
    worst_pair = std::max({worst_pair, sine.distance_to(pair.sine), cosine.distance_to(pair.cosine)});
  });
  EXPECT_LE(worst, kSinCosError);
  EXPECT_LE(worst_pair, kSinCosPairError);
  RecordProperty("worst", std::to_string(worst * 1e16));
  RecordProperty("worst_pair", std::to_string(worst_pair * 1e32));
}

TEST(Trig, DirectionAngleIsWithinTheStatedError) {
  double worst = 0;
  for_many_angles([&](double theta) {
    if (std::abs(theta) > 100) return;
    const double x = std::cos(theta) * (1 + std::abs(theta)), y = std::sin(theta) * (1 + std::abs(theta));
    Real mx(x), my(y), angle(0);
    mpfr_atan2(angle.get(), my.get(), mx.get(), MPFR_RNDN);
    worst = std::max(worst, angle.distance_to({direction_angle(x, y), 0}));
  });
  EXPECT_LE(worst, 1e-15);
  EXPECT_EQ(direction_angle(0, 0), 0);
  EXPECT_EQ(direction_angle(1, 0), 0);
  EXPECT_EQ(direction_angle(-1, 0), 3.141592653589793);
  EXPECT_EQ(direction_angle(0, -2), -1.5707963267948966);
}

}  // namespace
}  // namespace lekalo::geom::trig_test
