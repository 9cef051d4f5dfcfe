#include "interval.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lekalo/base/assert.hpp"

namespace lekalo::verify {
namespace {

mpfr_prec_t common_precision(const Interval& a, const Interval& b) {
  return std::max(a.precision(), b.precision());
}

std::string decimal_text(mpfr_srcptr value, const char* format) {
  std::array<char, 64> buffer{};
  mpfr_snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

Interval::Interval(mpfr_prec_t precision) {
  mpfr_init2(low_, precision);
  mpfr_init2(high_, precision);
  mpfr_set_zero(low_, 1);
  mpfr_set_zero(high_, 1);
}

Interval::Interval(const Integer& value, mpfr_prec_t precision) : Interval(precision) {
  mpfr_set_z(low_, value.get_mpz_t(), MPFR_RNDD);
  mpfr_set_z(high_, value.get_mpz_t(), MPFR_RNDU);
}

Interval::Interval(const Decimal& value, mpfr_prec_t precision) : Interval(value.digits, precision) {
  const Interval power(power_of_ten(static_cast<unsigned long>(std::abs(value.exponent))), precision);
  *this = value.exponent < 0 ? *this / power : *this * power;
}

Interval::Interval(const Interval& other) : Interval(other.precision()) {
  mpfr_set(low_, other.low_, MPFR_RNDD);
  mpfr_set(high_, other.high_, MPFR_RNDU);
}

Interval::Interval(Interval&& other) noexcept : Interval(mpfr_prec_t{MPFR_PREC_MIN}) {
  mpfr_swap(low_, other.low_);
  mpfr_swap(high_, other.high_);
}

Interval& Interval::operator=(Interval other) noexcept {
  mpfr_swap(low_, other.low_);
  mpfr_swap(high_, other.high_);
  return *this;
}

Interval::~Interval() {
  mpfr_clear(low_);
  mpfr_clear(high_);
}

Interval Interval::pi(mpfr_prec_t precision) {
  Interval result(precision);
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
  mpfr_div(result.low_, a.low_, mpfr_sgn(a.low_) < 0 ? b.low_ : b.high_, MPFR_RNDD);
  mpfr_div(result.high_, a.high_, mpfr_sgn(a.high_) < 0 ? b.high_ : b.low_, MPFR_RNDU);
  return result;
}

Interval square_root(const Interval& a) {
  Interval result(a.precision());
  if (mpfr_sgn(a.low_) > 0) mpfr_sqrt(result.low_, a.low_, MPFR_RNDD);
  if (mpfr_sgn(a.high_) > 0) mpfr_sqrt(result.high_, a.high_, MPFR_RNDU);
  return result;
}

Interval square(const Interval& a) {
  Interval result(a.precision());
  const bool low_is_smaller = mpfr_cmpabs(a.low_, a.high_) <= 0;
  const bool crosses_zero = mpfr_sgn(a.low_) < 0 && mpfr_sgn(a.high_) > 0;
  if (!crosses_zero) mpfr_sqr(result.low_, low_is_smaller ? a.low_ : a.high_, MPFR_RNDD);
  mpfr_sqr(result.high_, low_is_smaller ? a.high_ : a.low_, MPFR_RNDU);
  return result;
}

namespace {

/// f over a, for an f that changes by at most as much as its argument: f(low) and the width on both sides.
template <class Function>
void widened(Function f, const Interval& a, mpfr_ptr low, mpfr_ptr high) {
  f(low, a.low(), MPFR_RNDD);
  f(high, a.low(), MPFR_RNDU);
  mpfr_t width;
  mpfr_init2(width, a.precision());
  mpfr_sub(width, a.high(), a.low(), MPFR_RNDU);
  mpfr_sub(low, low, width, MPFR_RNDD);
  mpfr_add(high, high, width, MPFR_RNDU);
  mpfr_clear(width);
}

}  // namespace

Interval sine(const Interval& a) {
  Interval result(a.precision());
  widened(mpfr_sin, a, result.low_, result.high_);
  return result;
}

Interval cosine(const Interval& a) {
  Interval result(a.precision());
  widened(mpfr_cos, a, result.low_, result.high_);
  return result;
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

std::string Interval::low_text() const { return decimal_text(low_, "%.30RDg"); }
std::string Interval::high_text() const { return decimal_text(high_, "%.30RUg"); }

}  // namespace lekalo::verify
