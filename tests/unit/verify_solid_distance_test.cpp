// Distances of two triangles, enclosed and exactly, where they are known.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "verify/solid/triangle_distance.hpp"

namespace lekalo::verify::verify_solid_distance_test {
namespace {

using Corners = std::array<Near3, 3>;

ExactTriangle exact(const Corners& t) {
  ExactTriangle made;
  for (std::size_t k = 0; k < 3; ++k) made[k] = {Fraction(t[k][0]), Fraction(t[k][1]), Fraction(t[k][2])};
  return made;
}
Triangle3 enclosed(const Corners& t) {
  Triangle3 made{};
  for (std::size_t k = 0; k < 3; ++k) made[k] = {just(t[k][0]), just(t[k][1]), just(t[k][2])};
  return made;
}

const Corners kFlat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

struct Pair {
  std::string name;
  Corners a, b;
  double squared = 0;
  bool pierces = false;
};

const std::vector<Pair> kPairs{
    {"a corner over the inside", kFlat, {{{1, 1, 2}, {1, 1, 5}, {2, 2, 5}}}, 4},
    {"a corner over an edge", kFlat, {{{2, 2, 2}, {2, 2, 5}, {3, 3, 5}}}, 4},
    {"a corner over a corner", kFlat, {{{0, 0, 3}, {0, 0, 5}, {1, 1, 5}}}, 9},
    {"a corner beside the inside", kFlat, {{{5, 5, 2}, {5, 5, 5}, {9, 9, 5}}}, 22},
    {"a corner beyond a corner", kFlat, {{{7, -4, 12}, {8, -4, 12}, {7, -5, 12}}}, 169},
    {"flat over each other", kFlat, {{{-9, -9, 3}, {9, -9, 3}, {0, 20, 3}}}, 9},
    {"flat beside each other", kFlat, {{{7, 0, 0}, {9, 0, 0}, {9, 4, 0}}}, 9},
    {"edges across each other", kFlat, {{{2, -3, 2}, {2, 1, -2}, {2, -9, -9}}}, 0.5},
    {"edges across, upright", kFlat, {{{2, -1, -3}, {2, -1, 3}, {2, -5, 0}}}, 1},
    {"edges in parallel", kFlat, {{{1, -2, 0}, {3, -2, 0}, {2, -5, 1}}}, 4},
    {"edges in parallel, one beyond the other", kFlat, {{{8, -3, 0}, {6, -3, 0}, {7, -9, 1}}}, 13},
    {"an edge through the inside", kFlat, {{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}, 0, true},
    {"two edges through the inside", kFlat, {{{1, 1, -1}, {1, 1.5, 1}, {1.5, 1, 1}}}, 0, true},
    {"edges that meet", kFlat, {{{2, 0, -1}, {2, 0, 1}, {2, -5, 0}}}, 0},
    {"an edge through a corner", kFlat, {{{0, 0, -1}, {0, 0, 1}, {-5, -5, 0}}}, 0},
    {"a corner on the inside", kFlat, {{{1, 1, 0}, {1, 1, 5}, {2, 1, 5}}}, 0},
    {"an edge on the inside", kFlat, {{{1, 1, 0}, {2, 1, 0}, {2, 1, 5}}}, 0},
    {"a corner on a corner", kFlat, {{{0, 0, 0}, {-1, 0, 5}, {0, -1, 5}}}, 0},
    {"flat on each other", kFlat, {{{1, 1, 0}, {9, 1, 0}, {9, 9, 0}}}, 0},
    {"the same", kFlat, kFlat, 0},
    {"two points", {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, {{{4, 5, 1}, {4, 5, 1}, {4, 5, 1}}}, 25},
    {"a point over the inside", kFlat, {{{1, 1, 2}, {1, 1, 2}, {1, 1, 2}}}, 4},
    {"a point beside an edge", kFlat, {{{1, -2, 0}, {1, -2, 0}, {1, -2, 0}}}, 4},
    {"a line through the inside", kFlat, {{{1, 1, -1}, {1, 1, 1}, {1, 1, 0.5}}}, 0, true},
    {"a line over the inside", kFlat, {{{1, 1, 2}, {1, 1, 5}, {1, 1, 4}}}, 4},
    {"two lines across", {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}, {{{1, -1, 3}, {1, 1, 3}, {1, 0, 3}}}, 9},
    {"two lines in parallel", {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}, {{{9, 0, 0}, {7, 0, 0}, {8, 0, 0}}}, 9},
    {"two lines in parallel beside each other",
     {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}},
     {{{3, 2, 0}, {7, 2, 0}, {8, 2, 0}}},
     4}};

/// Calls with each order of the corners of both, and of the two.
template <class Call>
void in_all_orders(const Pair& pair, const Call& call) {
  for (int order = 0; order < 72; ++order) {
    const auto turned = [](const Corners& t, int k) {
      const auto first = static_cast<std::size_t>(k % 3);
      Corners made{t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
      if (k >= 3) std::swap(made[0], made[1]);
      return made;
    };
    const Corners a = turned(pair.a, order % 6), b = turned(pair.b, order / 6 % 6);
    order < 36 ? call(a, b) : call(b, a);
  }
}

TEST(TriangleDistance, IsExactWhereItIsKnown) {
  for (const Pair& pair : kPairs)
    in_all_orders(pair, [&](const Corners& a, const Corners& b) {
      const ExactDistance found = exact_distance(exact(a), exact(b));
      EXPECT_TRUE(found.squared == Fraction(pair.squared)) << pair.name << ": " << found.squared.get_str();
      EXPECT_EQ(found.pierces, pair.pierces) << pair.name;
    });
}

TEST(TriangleDistance, IsEnclosedClosely) {
  for (const Pair& pair : kPairs)
    in_all_orders(pair, [&](const Corners& a, const Corners& b) {
      const Span apart = distance(enclosed(a), enclosed(b));
      const double real = std::sqrt(pair.squared);
      EXPECT_LE(apart.low, real) << pair.name;
      EXPECT_GE(apart.high, real) << pair.name;
      EXPECT_LT(apart.high - apart.low, 1e-13) << pair.name;
      // At the limit it is worth something as well, and above it only the low end is.
      EXPECT_EQ(distance(enclosed(a), enclosed(b), apart.low).high, apart.high) << pair.name;
      EXPECT_EQ(distance(enclosed(a), enclosed(b), apart.low - 1e-9).high, kInfinity) << pair.name;
      EXPECT_LE(distance(enclosed(a), enclosed(b), apart.low - 1e-9).low, real) << pair.name;
    });
}

TEST(TriangleDistance, OfAPointIsExact) {
  for (const auto& [p, squared] : {std::pair(Near3{1, 1, 2}, 4.0),
                                   {{2, 2, 2}, 4},
                                   {{0, 0, 3}, 9},
                                   {{5, 5, 2}, 22},
                                   {{7, -4, 0}, 25},
                                   {{1, -2, 0}, 4},
                                   {{-3, 1, 4}, 25},
                                   {{1, 1, 0}, 0},
                                   {{4, 0, 0}, 0},
                                   {{-3, 8, 0}, 25},
                                   {{2, 0, 0}, 0}})
    for (const Corners& t :
         {kFlat, Corners{kFlat[1], kFlat[2], kFlat[0]}, Corners{kFlat[1], kFlat[0], kFlat[2]}})
      EXPECT_TRUE(exact_squared_distance({Fraction(p[0]), Fraction(p[1]), Fraction(p[2])}, exact(t)) ==
                  Fraction(squared))
          << p[0] << " " << p[1] << " " << p[2];
  const Corners third{{{1, 0, 0}, {1, 0, 0}, {1, 3, 0}}};
  EXPECT_TRUE(exact_squared_distance({Fraction(4, 3), Fraction(1, 7), 0}, exact(third)) == Fraction(1, 9));
}

/// Where doubles overflow nothing is known, and what is said is not wrong.
TEST(TriangleDistance, BeyondDoublesNothingIsSaid) {
  const Corners far{{{1e308, 0, 0}, {1e308, 1e308, 0}, {1e308, 0, 1e308}}};
  Corners other = far;
  for (Near3& p : other) p[0] = -1e308;
  const Span apart = distance(enclosed(far), enclosed(other));
  EXPECT_GE(apart.low, 0);
  EXPECT_EQ(apart.high, kInfinity);
  EXPECT_EQ(distance(enclosed(far), enclosed(kFlat)).high, kInfinity);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_distance_test
