#include "certificate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

/// At most this many findings are about single intervals, because a certificate may hold a million of them.
constexpr std::size_t kMostComplaints = 20;

/// Returns the double nearest to the number, or NaN when that is not finite or the number is too small for
/// one.
double nearest_double(std::string_view text) {
  // A number out of range leaves the value as it is.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Returns the sign of a - b for the texts of two numbers. Rounding to the nearest double keeps order, so
/// only numbers with equal doubles need the exact comparison. Step 6 of docs/design/verify.md.
int compare_texts(std::string_view a, std::string_view b) {
  if (a == b) return 0;
  const double x = nearest_double(a), y = nearest_double(b);
  if (x < y) return -1;
  if (x > y) return 1;
  return compare(*parse_decimal(a), *parse_decimal(b));
}

/// Returns a few units in the last place that doubles have at the largest coordinate.
Interval coordinate_roundoff(const Ring& points) {
  return Interval(largest_coordinate(points), kRough) / Interval(Integer(1) << 50, kRough);
}

}  // namespace

CertificateCheck::CertificateCheck(const Outline& part, EdgeLines& edges, Precision precision,
                                   std::vector<std::string>& findings)
    : part_(part),
      edges_(edges),
      precision_(precision),
      findings_(findings),
      roundoff_(coordinate_roundoff(edges.outline().points)) {}

void CertificateCheck::say(const std::string& sentence) {
  if (++complaints_ <= kMostComplaints) {
    findings_.push_back(fmt::format("certificate interval {}: {}", count_, sentence));
  }
}

void CertificateCheck::add(const WrittenInterval& interval) {
  check_order(interval);
  if (const std::optional<Sinusoid> s = sinusoid(interval)) {
    if (may_raise_bound(interval, *s)) {
      const Interval exact = bound_over(interval, *s, precision_);
      if (!bound_ || !certainly_not_above(exact, *bound_)) worst_ = count_;
      bound_ = bound_ ? maximum(*bound_, exact) : exact;
      flat_bound_ = bound_->low_double(edges_.flat_scale());
    }
  }
  ++count_;
}

bool CertificateCheck::may_raise_bound(const WrittenInterval& interval, const Sinusoid& s) {
  constexpr Precision kShort = 128;
  return !bound_ || (!(flat_bound(interval, s) <= flat_bound_) &&
                     !certainly_not_above(bound_over(interval, s, kShort), *bound_));
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

std::optional<CertificateCheck::Sinusoid> CertificateCheck::sinusoid(const WrittenInterval& interval) {
  std::array<const EdgeLine*, 3> written{};
  std::array<double, 3> multipliers{};
  for (std::size_t j = 0; j < 3; ++j) {
    const WrittenContact& contact = interval.contacts[j];
    std::string why;
    written[j] = edges_.find(contact.blank_edge, why);
    multipliers[j] = contact.multiplier;
    if (contact.part_vertex >= part_.points.size()) {
      why = fmt::format("part vertex {} does not exist, the part has {} points", contact.part_vertex,
                        part_.points.size());
    }
    if (!why.empty()) {
      say(why);
      return std::nullopt;
    }
  }
  Sinusoid s{intended_triple(written, multipliers, kMultiplierTolerance, edges_), 0, 0, 0};
  if (!check_triple(interval, s.triple)) return std::nullopt;
  for (std::size_t j = 0; j < 3; ++j) {
    const EdgeLine& edge = *s.triple.edges[j];
    const Integer& weight = s.triple.weights[j];
    const Point& v = part_.points[interval.contacts[j].part_vertex];
    s.constant += weight * (edge.outside - cross(edge.direction, edge.start));
    s.cosine += weight * cross(edge.direction, v);
    s.sine += weight * dot(edge.direction, v);
  }
  return s;
}

bool CertificateCheck::check_triple(const WrittenInterval& interval, const EdgeTriple& triple) {
  switch (triple.balance) {
    case EdgeTriple::Balance::parallel:
      say("its three blank edges are parallel, so they bound nothing");
      return false;
    case EdgeTriple::Balance::opposed:
      say("the inward normals of its blank edges do not balance, so they bound nothing");
      return false;
    case EdgeTriple::Balance::holds:
      break;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double written = interval.contacts[j].multiplier;
    const double difference = std::abs(written - triple.shares[j]);
    if (!(difference <= kMultiplierTolerance) &&
        !(difference <= kMultiplierTolerance + triple.sensitivity(roundoff_))) {
      say(fmt::format("multiplier {} is written as {}, but the edges give {}", j, written, triple.shares[j]));
    }
  }
  return true;
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
  const RoundedTurn rounded = rounded_turn(turn.nearest);
  // The rounded value and the angle are each off by half a step; the sum is doubled to be safe.
  const double error = step_up((1 + std::abs(turn.nearest)) * 0x1p-52);
  turn.cosine = outwards(rounded.cosine - error, rounded.cosine + error);
  turn.sine = outwards(rounded.sine - error, rounded.sine + error);
  return turn;
}

double CertificateCheck::flat_bound(const WrittenInterval& interval, const Sinusoid& s) {
  // Weights are products of two lengths, and K, A and B are of four.
  const long unit = edges_.flat_scale();
  Span divisor;
  double spread = 1;
  for (std::size_t e = 0; e < 3; ++e) {
    divisor = divisor + to_span(s.triple.weights[e], 2 * unit) * s.triple.edges[e]->flat_length;
    spread = std::max(spread, s.triple.edges[e]->spread.high_double());
  }
  const Span k = to_span(s.constant, 4 * unit), a = to_span(s.cosine, 4 * unit),
             b = to_span(s.sine, 4 * unit);
  const FlatTurn from = flat_turn(interval.from), to = flat_turn(interval.to);
  const Span slope_from = b * from.cosine - a * from.sine, slope_to = b * to.cosine - a * to.sine;
  const bool narrow = to.nearest - from.nearest < 3;
  const bool no_crest = narrow && (is_positive(-slope_from) || is_positive(slope_to));
  const Span at_from = a * from.cosine + b * from.sine, at_to = a * to.cosine + b * to.sine;
  const double top = no_crest ? std::max(at_from.high, at_to.high) : square_root(a * a + b * b).high;
  const double bound = (plus(k, top) / divisor).high;
  // The spread matters to a negative bound alone.
  return std::max(bound, step_up(bound / spread));
}

Turn CertificateCheck::turn_at(std::string_view angle, Precision precision) {
  if (last_angle_ == angle && last_turn_->sine.precision() >= precision) return *last_turn_;
  const Decimal exact = *parse_decimal(angle);
  last_turn_ = turn_by(Interval(exact, precision + angle_bits(exact)));
  last_angle_ = angle;
  return *last_turn_;
}

Interval CertificateCheck::bound_over(const WrittenInterval& interval, const Sinusoid& s,
                                      Precision precision) {
  const Interval a(s.cosine, precision), b(s.sine, precision);
  const Interval crest = square_root(square(a) + square(b));
  // In an interval narrower than pi the crest lies inside just when the curve rises at the start and falls at
  // the end.
  const auto narrow_top = [&](const Turn& from, const Turn& to) {
    const bool no_crest = certainly_negative(b * from.cosine - a * from.sine) ||
                          certainly_positive(b * to.cosine - a * to.sine);
    return no_crest ? maximum(a * from.cosine + b * from.sine, a * to.cosine + b * to.sine) : crest;
  };
  const Turn from = turn_at(interval.from, precision), to = turn_at(interval.to, precision);
  const Decimal begin = *parse_decimal(interval.from), width = *parse_decimal(interval.to) - begin;
  // An interval wider than a full turn surely holds the crest.
  Interval top = crest;
  if (compare(width, Decimal{3, 0}) < 0) {
    top = narrow_top(from, to);
  } else if (compare(width, Decimal{9, 0}) < 0) {
    const Precision wide = precision + angle_bits(begin) + angle_bits(width);
    const Interval start(begin, wide), third = Interval(width, wide) / Interval(Integer(3), wide);
    const Turn first = turn_by(start + third), second = turn_by(start + third + third);
    top = maximum(narrow_top(from, first), maximum(narrow_top(first, second), narrow_top(second, to)));
  }
  Interval divisor(precision), spread(Integer(1), precision);
  for (std::size_t j = 0; j < 3; ++j) {
    divisor = divisor + Interval(s.triple.weights[j], precision) * s.triple.edges[j]->length;
    spread = maximum(spread, s.triple.edges[j]->spread);
  }
  const Interval bound = (Interval(s.constant, precision) + top) / divisor;
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
  const Precision wide =
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
