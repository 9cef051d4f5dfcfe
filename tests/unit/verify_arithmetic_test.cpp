// The parts of the checker that its statements rest on: exact decimals, enclosures, the hull and what lies
// outside.

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <thread>

#include "support/verify_cases.hpp"
#include "verify/locate/edge_triple.hpp"
#include "verify/locate/outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/surely.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify_arithmetic_test {
namespace {

using namespace verify;
using lekalo::verify_cases::Random;

TEST(VerifyArithmetic, DecimalsAreReadExactly) {
  const auto expect = [](const char* text, const char* digits, long exponent) {
    const auto value = parse_decimal(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(value->digits.get_str(), digits) << text;
    EXPECT_EQ(value->exponent, exponent) << text;
  };
  expect("0", "0", 0);
  expect("-0.000e99999999999", "0", 0);
  expect("12.50", "125", -1);
  expect("-12.50e3", "-125", 2);
  expect("+.5", "5", -1);
  expect("5.", "5", 0);
  expect("00120E-2", "12", -1);
  expect("1e399", "1", 399);
  for (const char* text : {"", "-", ".", "e5", "1e", "1e+", "1.2.3", "1 ", " 1", "0x10", "nan", "inf",
                           "1e400", "1e-402", "1,5", "--1", "+-1", "1e1.5"}) {
    EXPECT_FALSE(parse_decimal(text)) << text;
  }
}

TEST(VerifyArithmetic, DecimalsCompareAndSubtractExactly) {
  const auto d = [](const char* text) { return *parse_decimal(text); };
  EXPECT_EQ(compare(d("0.1"), d("0.10000000000000000000000000001")), -1);
  EXPECT_EQ(compare(d("1e300"), d("-1e-300")), 1);
  EXPECT_EQ(compare(d("100"), d("1e2")), 0);
  EXPECT_EQ(compare(d("0"), d("0e5")), 0);
  const Decimal difference = d("1e20") - d("1e-20");
  EXPECT_EQ(difference.digits.get_str(), "9999999999999999999999999999999999999999");
  EXPECT_EQ(difference.exponent, -20);
}

/// a / 2^50 as both kinds of enclosure, and exactly.
struct Sample {
  Integer exact;
  Interval wide;
  Span flat;
};

Sample sample(Random& random) {
  const auto value =
      static_cast<long>(random.bits() >> (1 + random.below(60))) * (random.below(2) == 0 ? 1 : -1);
  return {Integer(value), Interval(Integer(value), 24),
          to_span(Integer(value), 0)};  // 24 bits: rounding matters
}

bool holds(const Interval& interval, const Integer& exact) {
  const Interval point(exact, bits_of(exact) + 1);
  return !certainly_above(interval, point) && !certainly_above(point, interval);
}
bool holds(const Span& span, const Integer& exact) {
  return mpz_cmp_d(exact.get_mpz_t(), span.low) >= 0 && mpz_cmp_d(exact.get_mpz_t(), span.high) <= 0;
}

TEST(VerifyArithmetic, EveryOperationEnclosesTheExactResult) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Sample a = sample(random), b = sample(random);
    EXPECT_TRUE(holds(a.wide + b.wide, a.exact + b.exact));
    EXPECT_TRUE(holds(a.wide - b.wide, a.exact - b.exact));
    EXPECT_TRUE(holds(a.wide * b.wide, a.exact * b.exact));
    EXPECT_TRUE(holds(square(a.wide), a.exact * a.exact));
    EXPECT_TRUE(holds(square_root(square(a.wide)), abs(a.exact)));
    EXPECT_TRUE(holds(a.flat + b.flat, a.exact + b.exact));
    EXPECT_TRUE(holds(a.flat - b.flat, a.exact - b.exact));
    EXPECT_TRUE(holds(a.flat * b.flat, a.exact * b.exact));
    EXPECT_TRUE(holds(square_root(a.flat * a.flat), abs(a.exact)));
    if (b.exact > 0) {
      EXPECT_TRUE(holds((a.wide * b.wide) / b.wide, a.exact));
      EXPECT_TRUE(holds((a.flat * b.flat) / b.flat, a.exact));
    }
  }
}

TEST(VerifyArithmetic, ANumberIsSurelyAboveWhatItsSpanDoesNotTouch) {
  EXPECT_FALSE(surely_above({1, 2}, {0, 1}));
  EXPECT_TRUE(surely_above({1, 2}, {0, step_down(1)}));
  EXPECT_FALSE(is_positive({0, 1}));
  EXPECT_TRUE(is_positive({step_up(0), 1}));
  EXPECT_FALSE(is_positive({std::nan(""), 1}));
}

TEST(VerifyArithmetic, IntervalsAcrossZeroMultiplyAndSquareToTheirExtremes) {
  const Interval across = hull(Interval(Integer(-3), 64), Interval(Integer(2), 64));
  const Interval product = across * across, squared = square(across);
  EXPECT_EQ(product.low_double(), -6);
  EXPECT_EQ(product.high_double(), 9);
  EXPECT_EQ(squared.low_double(), 0);
  EXPECT_EQ(squared.high_double(), 9);
  EXPECT_EQ((across / Interval(Integer(2), 64)).low_double(), -1.5);
}

/// value 2^1000, which is whole for every sine or cosine here.
Integer scaled(mpfr_ptr value) {
  Integer whole;
  mpfr_mul_2si(value, value, 1000, MPFR_RNDN);
  mpfr_get_z(whole.get_mpz_t(), value, MPFR_RNDN);
  return whole;
}

TEST(VerifyArithmetic, TurnsEncloseSineAndCosineOfEveryAngleInTheInterval) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double low = random.uniform(-10, 10), high = low + random.uniform(0, 1e-3);
    const auto interval_of = [](double value) {
      return Interval(*parse_decimal(fmt::format("{:.30f}", value)), 40);
    };
    const Turn turn = turn_by(hull(interval_of(low), interval_of(high)));
    const Interval unit(Integer(Integer(1) << 1000), 40);
    for (const double t : {0.0, 0.3, 1.0}) {
      mpfr_t angle, sine, cosine;
      mpfr_inits2(200, angle, sine, cosine, static_cast<mpfr_ptr>(nullptr));
      mpfr_set_d(angle, low + t * (high - low), MPFR_RNDN);
      mpfr_sin_cos(sine, cosine, angle, MPFR_RNDN);
      EXPECT_TRUE(holds(turn.sine * unit, scaled(sine)));
      EXPECT_TRUE(holds(turn.cosine * unit, scaled(cosine)));
      mpfr_clears(angle, sine, cosine, static_cast<mpfr_ptr>(nullptr));
    }
  }
  const Turn none = turn_by(Interval(64));
  EXPECT_EQ(none.cosine.low_double(), 1);
  EXPECT_EQ(none.cosine.high_double(), 1);
  EXPECT_TRUE(certainly_zero(none.sine));
}

/// What GMP and MPFR hold, in blocks.
std::atomic<int> blocks_held{0};

TEST(VerifyArithmetic, AThreadThatEndsLeavesNothingBehind) {
  const auto make = [](std::size_t size) { return ++blocks_held, std::malloc(size); };
  const auto resize = [](void* block, std::size_t, std::size_t size) { return std::realloc(block, size); };
  const auto release = [](void* block, std::size_t) { --blocks_held, std::free(block); };
  void* (*make_before)(std::size_t) = nullptr;
  void* (*resize_before)(void*, std::size_t, std::size_t) = nullptr;
  void (*release_before)(void*, std::size_t) = nullptr;
  mp_get_memory_functions(&make_before, &resize_before, &release_before);
  mp_set_memory_functions(make, resize, release);
  int held_most = 0;
  for (int i = 0; i < 3; ++i) {
    std::thread([&] {
      (void)turn_by(Interval::pi(200) * Interval::exactly(0.3, 200));
      (void)rounded_turn(0.1);
      held_most = std::max(held_most, blocks_held.load());
    }).join();
    EXPECT_EQ(blocks_held, 0) << i;
  }
  EXPECT_GT(held_most, 0) << "MPFR keeps nothing, and nothing was shown";
  mp_set_memory_functions(make_before, resize_before, release_before);
}

TEST(VerifyArithmetic, PrintedEndsEnclose) {
  const Interval third = Interval(Integer(1), 300) / Interval(Integer(3), 300);
  EXPECT_EQ(third.low_text(), "0.333333333333333333333333333333");
  EXPECT_EQ(third.high_text(), "0.333333333333333333333333333334");
  const Interval minus = Interval(Integer(-2), 300) / Interval(Integer(3), 300);
  EXPECT_EQ(minus.low_text(), "-0.666666666666666666666666666667");
  EXPECT_EQ(minus.high_text(), "-0.666666666666666666666666666666");
}

Ring random_ring(Random& random, long size) {
  Ring ring;
  const std::size_t n = 3 + random.below(30);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n),
                 r = random.uniform(0.9, 1);
    ring.push_back({Integer(std::lround(static_cast<double>(size) * r * std::cos(t))),
                    Integer(std::lround(static_cast<double>(size) * r * std::sin(t)))});
  }
  if (random.below(2) == 1) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(VerifyArithmetic, HullDentsAndLowestCornerAgreeWithTheirDefinitions) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const auto made = make_outline(random_ring(random, i % 3 == 0 ? 12 : 1'000'000), "ring");
    if (!made) continue;  // a coarse ring may fold back
    const Outline& o = *made;
    for (std::size_t j = 0; j < o.hull.size(); ++j) {
      EXPECT_GT(sgn(Integer(cross(o.side(j), o.side(j + 1)))), 0);
      for (const Point& p : o.points) EXPECT_GE(sgn(Integer(cross(o.side(j), p - o.corner(j)))), 0);
      EXPECT_GE(sgn(o.dents[j]), 0);
    }
    // Every point lies under some hull edge within its dent.
    for (const Point& p : o.points) {
      bool under = false;
      for (std::size_t j = 0; j < o.hull.size(); ++j) {
        under = under || cross(o.side(j), p - o.corner(j)) <= o.dents[j];
      }
      EXPECT_TRUE(under);
    }
    const Point direction{Integer(std::lround(random.uniform(-9, 9))),
                          Integer(std::lround(random.uniform(-9, 9)))};
    if (direction == Point{0, 0}) continue;
    const std::size_t lowest = lowest_corner(o, direction, random.below(o.hull.size()));
    for (const Point& p : o.points) EXPECT_GE(sgn(Integer(cross(direction, p - o.corner(lowest)))), 0);
  }
}

TEST(VerifyArithmetic, AnEdgeLineMeasuresWhatLiesOutsideIt) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const auto made = make_outline(random_ring(random, 1000), "ring");
    if (!made) continue;
    EdgeLines lines(*made, {}, 300);
    for (std::size_t k = 0; k < made->points.size(); ++k) {
      std::string why;
      const EdgeLine* line = lines.find(k, why);
      if (line == nullptr) continue;
      Integer outside = 0;
      for (const Point& p : made->points)
        outside = std::max<Integer>(outside, -cross(line->direction, p - line->start));
      EXPECT_TRUE(line->outside == outside);
      EXPECT_GE(line->spread.high_double(), 1);
      EXPECT_TRUE(outside != 0 || line->spread.high_double() == 1);
      // Far away on the outer side: where all hull edges are r or more away, the line moved out is spread r
      // or more.
      const Point far{line->direction.y * 1000, -line->direction.x * 1000};
      Interval least = Interval(Integer(1), 300);
      for (std::size_t j = 0; j < made->hull.size(); ++j) {
        const Point side = made->side(j);
        least = minimum(least, Interval(cross(side, far - made->corner(j)), 300) /
                                   square_root(Interval(dot(side, side), 300)));
      }
      const Interval own =
          Interval(cross(line->direction, far - line->start) + line->outside, 300) / line->length;
      EXPECT_FALSE(certainly_above(line->spread * least, own));
    }
  }
}

struct Small {
  long x, y;
};
long turn(Small a, Small b, Small p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

/// Winding number of a ring about a point off it; 0 on it.
long winding(const std::vector<Small>& ring, Small p) {
  long count = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Small a = ring[k], b = ring[(k + 1) % ring.size()];
    const long side = turn(a, b, p);
    if (side == 0 && (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y) <= 0) return 0;
    if (a.y <= p.y && b.y > p.y && side > 0) ++count;
    if (a.y > p.y && b.y <= p.y && side < 0) --count;
  }
  return count;
}

TEST(VerifyArithmetic, ContainmentAgreesWithAGridOfPoints) {
  Random random(5);
  int inside = 0, outside = 0;
  // Coordinates times four: the grid also has points between the corners.
  const auto scaled = [](const Point& p) { return Small{p.x.get_si() * 4, p.y.get_si() * 4}; };
  for (int i = 0; i < 600; ++i) {
    const auto outer = make_outline(random_ring(random, 40), "outer");
    Ring small = random_ring(random, 10 + static_cast<long>(random.below(28)));
    const long dx = static_cast<long>(random.below(40)) - 20;
    for (Point& p : small) p.x += dx;
    const auto inner = make_outline(small, "inner");
    if (!outer || !inner) continue;
    std::size_t culprit = 0;
    const bool answer = lies_inside(*inner, *outer, culprit);
    (answer ? inside : outside) += 1;
    if (!answer) continue;  // a dent may be too small for the grid
    std::vector<Small> hull, ring;
    for (std::size_t j = 0; j < inner->hull.size(); ++j) hull.push_back(scaled(inner->corner(j)));
    for (const Point& p : outer->points) ring.push_back(scaled(p));
    // Every point strictly inside the inner hull must have the outer outline around it.
    for (long x = -240; x <= 240; x += 3) {
      for (long y = -160; y <= 160; ++y) {
        bool within = true;
        for (std::size_t j = 0; j < hull.size() && within; ++j)
          within = turn(hull[j], hull[(j + 1) % hull.size()], {x, y}) > 0;
        if (!within) continue;
        ASSERT_NE(winding(ring, {x, y}), 0) << i << ": " << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

TEST(VerifyArithmetic, JsonPiecesKeepTheirText) {
  const auto root =
      parse_json("\xEF\xBB\xBF { \"a\" : [ 1.50 , -0e0, true,null , \"x\\\"]\" ] , \"b\\n\" : {} } ", "j");
  ASSERT_TRUE(root) << root.error().message;
  JsonItems members(*root);
  const auto list = members.next();
  EXPECT_EQ(members.key(), "a");
  JsonItems items(*list);
  EXPECT_EQ(items.next()->text, "1.50");
  EXPECT_EQ(items.next()->text, "-0e0");
  EXPECT_TRUE(items.next()->is_true());
  EXPECT_TRUE(items.next()->is_null());
  EXPECT_EQ(json_text(*items.next()), "x\"]");
  EXPECT_FALSE(items.next());
  EXPECT_TRUE(members.next()->is_object());
  EXPECT_EQ(members.key(), "b\n");
  EXPECT_FALSE(members.next());
  for (const char* text : {"",   " ",           "{",       "[1,]", "[1 2]", "{\"a\"}", "{\"a\":}",    "{a:1}",
                           "01", "1.",          ".5",      "+1",   "-",     "1e",      "tru",         "nul",
                           "\"", "\"\\u12g4\"", "\"\\q\"", "[1]]", "[1] x", "'a'",     "[\t\"a\tb\"]"}) {
    EXPECT_FALSE(parse_json(text, "j")) << text;
  }
  // A document that ends in a backslash ends there: the byte behind it was once counted as one of its lines.
  const std::string_view more = "[\n\"\\\n";
  const auto cut = parse_json(more.substr(0, 4), "j");
  ASSERT_FALSE(cut);
  EXPECT_NE(cut.error().message.find("j:2: "), std::string::npos) << cut.error().message;
}

TEST(VerifyArithmetic, JsonNests64DeepAndNoDeeper) {
  EXPECT_TRUE(parse_json(std::string(64, '[') + std::string(64, ']'), "j"));
  EXPECT_TRUE(parse_json(std::string(64, '[') + "1" + std::string(64, ']'), "j"));
  EXPECT_FALSE(parse_json(std::string(66, '[') + std::string(66, ']'), "j"));
}

}  // namespace
}  // namespace lekalo::verify_arithmetic_test
