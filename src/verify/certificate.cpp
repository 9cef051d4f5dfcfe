#include "certificate.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace lekalo::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Sentences about single intervals; a certificate may hold a million of them.
constexpr std::size_t kMostComplaints = 20;
/// Doubles hold products and squares of numbers with so many bits without overflow.
constexpr std::size_t kFlatBits = 400;

/// NaN when the double nearest to the number is not finite or the number is too small for one.
double nearest_double(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value
                                                                  : std::numeric_limits<double>::quiet_NaN();
}

/// Sign of a - b for two number texts. Rounding to the nearest double keeps order, so only equal doubles need
/// more.
int compare_texts(std::string_view a, std::string_view b) {
  if (a == b) return 0;
  const double x = nearest_double(a), y = nearest_double(b);
  if (x < y) return -1;
  if (x > y) return 1;
  return compare(*parse_decimal(a), *parse_decimal(b));
}

bool small_enough(const Integer& value) { return mpz_sizeinbase(value.get_mpz_t(), 2) <= kFlatBits; }

}  // namespace

CertificateCheck::CertificateCheck(const Outline& part, EdgeLines& edges, mpfr_prec_t precision,
                                   std::vector<std::string>& findings)
    : part_(part), edges_(edges), precision_(precision), findings_(findings) {}

void CertificateCheck::say(const std::string& sentence) {
  if (++complaints_ <= kMostComplaints) {
    findings_.push_back(fmt::format("certificate interval {}: {}", count_, sentence));
  }
}

void CertificateCheck::add(const WrittenInterval& interval) {
  check_order(interval);
  if (const std::optional<Sinusoid> s = sinusoid(interval)) {
    check_multipliers(interval, *s);
    if (!bound_ || !(flat_bound(interval, *s) <= bound_->low_double())) {
      const Interval exact = exact_bound(interval, *s);
      if (!bound_ || !certainly_not_above(exact, *bound_)) worst_ = count_;
      bound_ = bound_ ? maximum(*bound_, exact) : exact;
    }
  }
  ++count_;
}

void CertificateCheck::check_order(const WrittenInterval& interval) {
  if (compare_texts(interval.from, interval.to) > 0) {
    say(fmt::format("it runs backwards, from {} to {}", excerpt(interval.from), excerpt(interval.to)));
  }
  if (count_ == 0) {
    first_from_ = interval.from;
  } else {
    if (compare_texts(interval.from, last_from_) < 0) {
      say(fmt::format("it begins at {}, before the one in front of it at {}", excerpt(interval.from),
                      excerpt(last_from_)));
    }
    if (compare_texts(interval.from, reach_) > 0) {
      say(fmt::format("nothing covers the angles from {} to {}", excerpt(reach_), excerpt(interval.from)));
    }
  }
  last_from_ = interval.from;
  if (count_ == 0 || compare_texts(interval.to, reach_) > 0) reach_ = interval.to;
}

bool CertificateCheck::weigh(Sinusoid& s) {
  bool positive = false, negative = false;
  for (std::size_t j = 0; j < 3; ++j) {
    s.weights[j] = cross(s.edges[(j + 1) % 3]->direction, s.edges[(j + 2) % 3]->direction);
    positive = positive || sgn(s.weights[j]) > 0;
    negative = negative || sgn(s.weights[j]) < 0;
  }
  return !(positive && negative);
}

/// Weighs the three edges. Two that are opposite but for the last digits of the file leave the third next to
/// no weight, and on which side of zero is beyond what its writer could know. A bound may be made of any
/// edges, so an edge across the blank takes that place.
bool CertificateCheck::balance(const WrittenInterval& interval, Sinusoid& s) {
  if (weigh(s)) return true;
  for (std::size_t j = 0; j < 3; ++j) {
    if (!(interval.contacts[j].multiplier <= kMultiplierTolerance)) continue;
    const EdgeLine* const written = s.edges[j];
    const std::size_t count = edges_.outline().hull.size();
    const std::size_t across =
        lowest_corner(edges_.outline(), {-written->direction.x, -written->direction.y}, 0);
    // The two hull edges at that corner, and one further on each side: the nearest may be a scrap of the pair
    // itself.
    for (const std::size_t corner : {across, across + count - 1, across + 1, across + count - 2}) {
      s.edges[j] = &edges_.along_hull(corner);
      if (weigh(s)) return true;
    }
    s.edges[j] = written;
  }
  return false;
}

std::optional<CertificateCheck::Sinusoid> CertificateCheck::sinusoid(const WrittenInterval& interval) {
  Sinusoid s;
  for (std::size_t j = 0; j < 3; ++j) {
    const WrittenContact& contact = interval.contacts[j];
    std::string why;
    s.edges[j] = edges_.find(contact.blank_edge, why);
    if (contact.part_vertex >= part_.points.size()) {
      why = fmt::format("part vertex {} does not exist, the part has {} points", contact.part_vertex,
                        part_.points.size());
    }
    if (!why.empty()) {
      say(why);
      return std::nullopt;
    }
  }
  if (!balance(interval, s)) {
    say("the inward normals of its blank edges do not balance, so they bound nothing");
    return std::nullopt;
  }
  const int sign = sgn(s.weights[0]) + sgn(s.weights[1]) + sgn(s.weights[2]);
  if (sign == 0) {
    say("its three blank edges are parallel, so they bound nothing");
    return std::nullopt;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    if (sign < 0) s.weights[j] = -s.weights[j];
    const EdgeLine& edge = *s.edges[j];
    const Point& v = part_.points[interval.contacts[j].part_vertex];
    s.constant += s.weights[j] * (edge.outside - cross(edge.direction, edge.start));
    s.cosine += s.weights[j] * cross(edge.direction, v);
    s.sine += s.weights[j] * dot(edge.direction, v);
  }
  return s;
}

void CertificateCheck::check_multipliers(const WrittenInterval& interval, const Sinusoid& s) {
  constexpr mpfr_prec_t kEnough = 64;
  std::array<Interval, 3> shares{Interval(kEnough), Interval(kEnough), Interval(kEnough)};
  Interval sum(kEnough);
  for (std::size_t j = 0; j < 3; ++j) {
    shares[j] = Interval(s.weights[j], kEnough) * s.edges[j]->short_length;
    sum = sum + shares[j];
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double multiplier = (shares[j] / sum).low_double();
    const double written = interval.contacts[j].multiplier;
    if (!(std::abs(written - multiplier) <= kMultiplierTolerance)) {
      say(fmt::format("multiplier {} is written as {}, but the edges give {}", j, written, multiplier));
    }
  }
}

const CertificateCheck::FlatTurn& CertificateCheck::flat_turn(std::string_view angle) {
  if (flat_turns_[1].angle == angle) return flat_turns_[1];
  std::swap(flat_turns_[0], flat_turns_[1]);
  FlatTurn& turn = flat_turns_[1];
  if (turn.angle == angle) return turn;
  turn.angle = angle;
  turn.nearest = nearest_double(angle);
  turn.cosine = turn.sine = {-1, 1};
  if (!std::isfinite(turn.nearest)) return turn;
  mpfr_t theta, sine, cosine;
  mpfr_inits2(53, theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  mpfr_set_d(theta, turn.nearest, MPFR_RNDN);
  mpfr_sin_cos(sine, cosine, theta, MPFR_RNDN);
  // Half a step each for the rounded value and for the angle, doubled.
  const double error = std::nextafter((1 + std::abs(turn.nearest)) * 0x1p-52, kInfinity);
  const double c = mpfr_get_d(cosine, MPFR_RNDN), n = mpfr_get_d(sine, MPFR_RNDN);
  turn.cosine = outwards(c - error, c + error);
  turn.sine = outwards(n - error, n + error);
  mpfr_clears(theta, sine, cosine, static_cast<mpfr_ptr>(nullptr));
  return turn;
}

double CertificateCheck::flat_bound(const WrittenInterval& interval, const Sinusoid& s) {
  for (const Integer* value : {&s.constant, &s.cosine, &s.sine}) {
    if (!small_enough(*value)) return kInfinity;
  }
  Span divisor;
  bool true_edges = true;
  for (std::size_t j = 0; j < 3; ++j) {
    const EdgeLine& edge = *s.edges[j];
    if (!small_enough(s.weights[j]) || !small_enough(edge.direction.x) || !small_enough(edge.direction.y)) {
      return kInfinity;
    }
    divisor = divisor + to_span(s.weights[j]) * edge.flat_length;
    true_edges = true_edges && edge.outside == 0;
  }
  if (!(divisor.low > 0)) return kInfinity;

  const Span k = to_span(s.constant), a = to_span(s.cosine), b = to_span(s.sine);
  const FlatTurn from = flat_turn(interval.from), to = flat_turn(interval.to);
  const Span slope_from = b * from.cosine - a * from.sine, slope_to = b * to.cosine - a * to.sine;
  const bool narrow = to.nearest - from.nearest < 3;
  const bool no_crest = narrow && (slope_from.high < 0 || slope_to.low > 0);
  const Span at_from = a * from.cosine + b * from.sine, at_to = a * to.cosine + b * to.sine;
  const Span crest = square_root(a * a + b * b);
  const Span top =
      no_crest ? Span{std::max(at_from.low, at_to.low), std::max(at_from.high, at_to.high)} : crest;
  const Span sum = k + top;
  if (sum.high < 0 && !true_edges) return kInfinity;  // the spread of the lines counts
  return (sum / divisor).high;
}

Interval CertificateCheck::exact_bound(const WrittenInterval& interval, const Sinusoid& s) const {
  const Decimal from = *parse_decimal(interval.from), to = *parse_decimal(interval.to);
  const Decimal width = to - from;
  const Interval a(s.cosine, precision_), b(s.sine, precision_);
  const Interval crest = square_root(square(a) + square(b));
  // Below pi wide, the crest is inside just when the curve rises at the start and falls at the end. So wide
  // intervals are looked at in thirds, and those beyond a full turn hold the crest.
  Interval top = crest;
  if (compare(width, Decimal{9, 0}) < 0) {
    const int pieces = compare(width, Decimal{3, 0}) < 0 ? 1 : 3;
    const mpfr_prec_t wide = precision_ + angle_bits(from) + angle_bits(to);
    const Interval start(from, wide), step = Interval(width, wide) / Interval(Integer(pieces), wide);
    for (int i = 0; i < pieces; ++i) {
      const Interval left = start + Interval(Integer(i), wide) * step;
      const Interval right =
          i + 1 == pieces ? Interval(to, wide) : start + Interval(Integer(i + 1), wide) * step;
      const Interval cos_left = cosine(left), sin_left = sine(left), cos_right = cosine(right),
                     sin_right = sine(right);
      const bool no_crest = certainly_negative(b * cos_left - a * sin_left) ||
                            certainly_positive(b * cos_right - a * sin_right);
      const Interval piece =
          no_crest ? maximum(a * cos_left + b * sin_left, a * cos_right + b * sin_right) : crest;
      top = i == 0 ? piece : maximum(top, piece);
    }
  }
  Interval divisor(precision_), spread(Integer(1), precision_);
  for (std::size_t j = 0; j < 3; ++j) {
    divisor = divisor + Interval(s.weights[j], precision_) * s.edges[j]->length;
    spread = maximum(spread, s.edges[j]->spread);
  }
  const Interval bound = (Interval(s.constant, precision_) + top) / divisor;
  return certainly_negative(bound) ? bound / spread : bound;
}

void CertificateCheck::finish(const Window& window) {
  if (complaints_ > kMostComplaints) {
    findings_.push_back(fmt::format("certificate: {} more such sentences about its intervals",
                                    complaints_ - kMostComplaints));
  }
  if (count_ == 0) {
    findings_.emplace_back("certificate: it has no intervals");
    return;
  }
  const Decimal from = *parse_decimal(first_from_), to = *parse_decimal(reach_);
  const mpfr_prec_t wide =
      256 + angle_bits(from) + angle_bits(to) + angle_bits(window.from_deg) + angle_bits(window.to_deg);
  const Interval pi = Interval::pi(wide);
  if (window.full_circle()) {
    if (!certainly_not_above(pi + pi, Interval(to - from, wide))) {
      findings_.push_back(
          fmt::format("certificate: it covers the angles from {} to {}, less than the full circle",
                      excerpt(first_from_), excerpt(reach_)));
    }
    return;
  }
  const Interval half_turn(Integer(180), wide);
  const Interval begin = Interval(window.from_deg, wide) * pi / half_turn;
  const Interval end = Interval(window.to_deg, wide) * pi / half_turn;
  if (!certainly_not_above(Interval(from, wide), begin) || !certainly_not_above(end, Interval(to, wide))) {
    findings_.push_back(
        fmt::format("certificate: it covers the angles from {} to {}, but the window runs from {} to {}",
                    excerpt(first_from_), excerpt(reach_), begin.low_double(), end.high_double()));
  }
}

}  // namespace lekalo::verify
