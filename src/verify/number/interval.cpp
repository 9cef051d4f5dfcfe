#include "interval.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

Precision common_precision(const Interval& a, const Interval& b) {
  ask();
  return std::max(a.precision(), b.precision());
}

std::string decimal_text(mpfr_srcptr value, const char* format) {
  std::array<char, 64> buffer{};
  mpfr_snprintf(buffer.data(), buffer.size(), format, value);
  return mpfr_zero_p(value) != 0 ? "0" : buffer.data();  // not "-0"
}

/// MPFR keeps pi, and numbers for its series, in every thread that turns something, and does not see the
/// thread end: each thread of a server would leave them behind.
void free_caches_with_the_thread() {
  struct Caches {
    ~Caches() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  };
  thread_local const Caches caches;
  (void)caches;
}

}  // namespace

Interval::Interval(Precision precision) {
  mpfr_init2(low_, precision);
  mpfr_init2(high_, precision);
  mpfr_set_ui(low_, 0, MPFR_RNDD);
  mpfr_set_ui(high_, 0, MPFR_RNDU);
}

Interval::Interval(const Integer& value, Precision precision) : Interval(precision) {
  mpfr_set_z(low_, value.get_mpz_t(), MPFR_RNDD);
  mpfr_set_z(high_, value.get_mpz_t(), MPFR_RNDU);
}

Interval Interval::exactly(double value, Precision precision) {
  Interval interval(precision);
  mpfr_set_d(interval.low_, value, MPFR_RNDD);
  mpfr_set_d(interval.high_, value, MPFR_RNDU);
  return interval;
}

Interval::Interval(const Decimal& value, Precision precision) : Interval(precision) {
  const Fraction exact = to_fraction(value);
  *this = Interval(exact.get_num(), precision) / Interval(exact.get_den(), precision);
}

Interval::Interval(const Interval& other) : Interval(other.precision()) {
  mpfr_set(low_, other.low_, MPFR_RNDD);
  mpfr_set(high_, other.high_, MPFR_RNDU);
}

// The other interval keeps no digits: numbers of its own would need memory, and nothing may fail here.
Interval::Interval(Interval&& other) noexcept {
  *low_ = std::exchange(*other.low_, {});
  *high_ = std::exchange(*other.high_, {});
}

Interval& Interval::operator=(Interval other) noexcept {
  mpfr_swap(low_, other.low_);
  mpfr_swap(high_, other.high_);
  return *this;
}

Interval::~Interval() {
  if (low_->_mpfr_d == nullptr) return;
  mpfr_clear(low_);
  mpfr_clear(high_);
}

Interval Interval::pi(Precision precision) {
  Interval result(precision);
  free_caches_with_the_thread();
  mpfr_const_pi(result.low_, MPFR_RNDD);
  mpfr_const_pi(result.high_, MPFR_RNDU);
  return result;
}

Interval operator+(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  mpfr_add(result.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_add(result.high_, a.high_, b.high_, MPFR_RNDU);
  return result;
}

Interval operator-(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  mpfr_sub(result.low_, a.low_, b.high_, MPFR_RNDD);
  mpfr_sub(result.high_, a.high_, b.low_, MPFR_RNDU);
  return result;
}

Interval operator*(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  Interval product(result.precision());
  mpfr_mul(result.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_mul(result.high_, a.low_, b.low_, MPFR_RNDU);
  const std::array<std::pair<mpfr_srcptr, mpfr_srcptr>, 3> others{
      {{a.low_, b.high_}, {a.high_, b.low_}, {a.high_, b.high_}}};
  for (const auto& [x, y] : others) {
    mpfr_mul(product.low_, x, y, MPFR_RNDD);
    mpfr_mul(product.high_, x, y, MPFR_RNDU);
    mpfr_min(result.low_, result.low_, product.low_, MPFR_RNDD);
    mpfr_max(result.high_, result.high_, product.high_, MPFR_RNDU);
  }
  return result;
}

Interval operator/(const Interval& a, const Interval& b) {
  LEKALO_ASSERT(certainly_positive(b));
  Interval result(common_precision(a, b));
  mpfr_div(result.low_, a.low_, mpfr_signbit(a.low_) != 0 ? b.low_ : b.high_, MPFR_RNDD);
  mpfr_div(result.high_, a.high_, mpfr_signbit(a.high_) != 0 ? b.high_ : b.low_, MPFR_RNDU);
  return result;
}

Interval square_root(const Interval& a) {
  Interval result = maximum(a, Interval(a.precision()));
  mpfr_sqrt(result.low_, result.low_, MPFR_RNDD);
  mpfr_sqrt(result.high_, result.high_, MPFR_RNDU);
  return result;
}

Interval square(const Interval& a) {
  Interval result(a.precision());
  const bool low_is_smaller = mpfr_cmpabs(a.low_, a.high_) <= 0;
  const bool crosses_zero = mpfr_sgn(a.low_) != mpfr_sgn(a.high_);
  if (!crosses_zero) mpfr_sqr(result.low_, low_is_smaller ? a.low_ : a.high_, MPFR_RNDD);
  mpfr_sqr(result.high_, low_is_smaller ? a.high_ : a.low_, MPFR_RNDU);
  return result;
}

Turn turn_by(const Interval& angle) {
  Turn turn{Interval(angle.precision()), Interval(angle.precision())};
  Interval &c = turn.cosine, &s = turn.sine;
  free_caches_with_the_thread();
  mpfr_sin_cos(s.low_, c.low_, angle.low_, MPFR_RNDN);
  mpfr_set(s.high_, s.low_, MPFR_RNDN);
  mpfr_set(c.high_, c.low_, MPFR_RNDN);
  if (mpfr_zero_p(angle.low_) != 0 && mpfr_zero_p(angle.high_) != 0) return turn;
  // Cosine and sine are each off by one step for the rounding, and change by no more than the angle does.
  Interval width(angle.precision());
  mpfr_sub(width.high_, angle.high_, angle.low_, MPFR_RNDU);
  for (Interval* value : {&c, &s}) {
    mpfr_nextbelow(value->low_);
    mpfr_nextabove(value->high_);
    mpfr_sub(value->low_, value->low_, width.high_, MPFR_RNDD);
    mpfr_add(value->high_, value->high_, width.high_, MPFR_RNDU);
  }
  return turn;
}

Turn turn_by_degrees(const Fraction& degrees) {
  constexpr Precision kEnough = 160;
  const Fraction quarters = degrees / 90;
  if (quarters.get_den() == 1) {
    const Integer turns = ((quarters.get_num() % 4) + 4) % 4;
    constexpr std::array<int, 5> kSines{0, 1, 0, -1, 0};
    const auto k = static_cast<std::size_t>(to_long(turns));
    return {Interval(Integer(kSines[k + 1]), kEnough), Interval(Integer(kSines[k]), kEnough)};
  }
  const Precision precision = kEnough + std::max(0L, bits_of(degrees.get_num()) - bits_of(degrees.get_den()));
  return turn_by(Interval(degrees.get_num(), precision) * Interval::pi(precision) /
                 (Interval(degrees.get_den(), precision) * Interval(Integer(180), precision)));
}

RoundedTurn rounded_turn(double angle) {
  constexpr mpfr_prec_t kDoubleBits = 53;
  mpfr_t theta, sine, cosine;
  mpfr_inits2(kDoubleBits, theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  mpfr_set_d(theta, angle, MPFR_RNDN);
  free_caches_with_the_thread();
  mpfr_sin_cos(sine, cosine, theta, MPFR_RNDN);
  const RoundedTurn turn{mpfr_get_d(cosine, MPFR_RNDN), mpfr_get_d(sine, MPFR_RNDN)};
  mpfr_clears(theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  return turn;
}

Interval minimum(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  mpfr_min(result.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_min(result.high_, a.high_, b.high_, MPFR_RNDU);
  return result;
}

Interval maximum(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  mpfr_max(result.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_max(result.high_, a.high_, b.high_, MPFR_RNDU);
  return result;
}

Interval hull(const Interval& a, const Interval& b) {
  Interval result(common_precision(a, b));
  mpfr_min(result.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_max(result.high_, a.high_, b.high_, MPFR_RNDU);
  return result;
}

long bits_of(const Interval& a) {
  const auto bits = [](mpfr_srcptr value) {
    return mpfr_zero_p(value) != 0 ? 0L : long{mpfr_get_exp(value)};
  };
  return std::max(bits(a.low_), bits(a.high_));
}

std::optional<std::int64_t> nearest_multiple(const Interval& a, int bits) {
  Interval whole(a.precision());
  mpfr_mul_2si(whole.low_, a.low_, bits, MPFR_RNDN);  // exact
  mpfr_mul_2si(whole.high_, a.high_, bits, MPFR_RNDN);
  mpfr_rint(whole.low_, whole.low_, MPFR_RNDN);  // ties to even
  mpfr_rint(whole.high_, whole.high_, MPFR_RNDN);
  if (mpfr_equal_p(whole.low_, whole.high_) == 0) return std::nullopt;
  return mpfr_get_sj(whole.low_, MPFR_RNDN);
}

double Interval::nearly_low(long scale) const {
  if (mpfr_zero_p(low_) != 0) return 0;
  long exponent = 0;
  const double digits = mpfr_get_d_2exp(&exponent, low_, MPFR_RNDN);
  return std::scalbln(digits, exponent - scale);
}

double Interval::high_double(long scale) const {
  Interval scaled = *this;
  mpfr_div_2si(scaled.high_, scaled.high_, scale, MPFR_RNDU);
  return mpfr_get_d(scaled.high_, MPFR_RNDU);
}

double Interval::low_double(long scale) const {
  Interval scaled = *this;
  mpfr_div_2si(scaled.low_, scaled.low_, scale, MPFR_RNDD);
  return mpfr_get_d(scaled.low_, MPFR_RNDD);
}

std::string Interval::low_text() const { return decimal_text(low_, "%.30RDg"); }
std::string Interval::high_text() const { return decimal_text(high_, "%.30RUg"); }

}  // namespace lekalo::verify
