// Surfaces that go through themselves, as the checker sees them and as `lekalo locate` does.

#include "verify/solid/self_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/crossing.hpp"
#include "support/crossing_solids.hpp"
#include "support/solid_results.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_self_crossing_test {
namespace {

using cases::block;
using cases::both;
using solid::Mesh;
using solid::Vector;

SelfCrossings crossings_of(const Mesh& mesh) {
  const SolidMesh read = cases::checked(mesh);
  return self_crossings(PlacedSolid(read));
}

TEST(SelfCrossings, InsideChangesSidesHoweverASurfaceGoesThroughItself) {
  for (const auto& [what, mesh] : cases::changing_meshes()) {
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_TRUE(found.changing) << what;
    EXPECT_TRUE(found.complete) << what;
  }
}

TEST(SelfCrossings, WhatTouchesNestsOrIsThinKeepsItsInside) {
  for (const auto& [what, mesh] :
       {cases::NamedMesh{"a block", block({0, 0, 0}, {20, 20, 20})},
        cases::NamedMesh{"a void", both(block({0, 0, 0}, {20, 20, 20}), block({5, 5, 5}, {9, 9, 9}))},
        cases::NamedMesh{"one face", both(block({0, 0, 0}, {20, 20, 20}), block({20, 0, 0}, {40, 20, 20}))},
        cases::NamedMesh{"one edge", both(block({0, 0, 0}, {20, 20, 20}), block({20, 20, 0}, {40, 40, 20}))},
        cases::NamedMesh{"parts of faces",
                         both(block({0, 0, 0}, {20, 20, 20}), block({20, 3, 4}, {40, 30, 30}))}}) {
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_FALSE(found.changing) << what;
    EXPECT_FALSE(found.first) << what;
  }
  const SelfCrossings thin =
      crossings_of(both(block({0, 0, 0}, {20, 20, 20}), block({19.999, 3, 4}, {39, 30, 30})));
  EXPECT_FALSE(thin.changing);
  ASSERT_TRUE(thin.first);
  EXPECT_NEAR(thin.first->place[0], 20, 2e-3);
  EXPECT_EQ(thin.depth, 0.02);
}

/// The point of a void touches a slanting face from inside, or goes through it by the last digit.
TEST(SelfCrossings, TheLastDigitDecides) {
  const auto tetrahedron = [](Vector a, Vector b, Vector c, Vector d) {
    return Mesh{{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  };
  const Mesh body = tetrahedron({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3});
  for (const auto& [beyond, goes_through] : {std::pair(0.0, false), {0x1p-52, true}, {-0x1p-52, false}}) {
    const SelfCrossings found = crossings_of(both(
        body, tetrahedron({0.25, 0.25, 0.25}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {1, 1, 1 + beyond})));
    EXPECT_EQ(found.first.has_value(), goes_through) << beyond;
    EXPECT_FALSE(found.changing) << beyond;
  }
}

/// Which way triangles are turned says nothing, as nothing else here asks for it.
TEST(SelfCrossings, TurnedTrianglesMeanTheSame) {
  Mesh body = block({-50, -5, -5}, {50, 5, 5}), other = block({-5, -50, -5}, {5, 50, 5});
  for (Mesh* const mesh : {&body, &other})
    for (const std::size_t t : {1U, 4U, 5U, 10U}) std::swap(mesh->triangles[t][0], mesh->triangles[t][2]);
  EXPECT_FALSE(crossings_of(body).changing);
  EXPECT_FALSE(crossings_of(both(body, block({60, 0, 0}, {70, 9, 9}))).changing);
  EXPECT_TRUE(crossings_of(both(body, other)).changing);
}

TEST(SelfCrossings, ALayerOfTwoRadiiIsEnoughAndOneOfLessIsNot) {
  for (const auto& [overlap, is_seen] : {std::pair(0.0401, true), {0.0399, false}})
    EXPECT_EQ(crossings_of(both(block({0, 0, 0}, {20, 20, 20}), block({20 - overlap, 3, 4}, {39, 30, 30})))
                  .changing.has_value(),
              is_seen)
        << overlap;
}

/// What `lekalo locate` takes is not refused here, and what it refuses by a wide margin is.
TEST(SelfCrossings, OfWavyRingsBothProgramsSayTheSame) {
  int crossing = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    Mesh mesh = cases::ring(random, 24, 12, 30, 8), other = cases::ring(random, 24, 12, 30, 8);
    const Vector shift{random.uniform(0, 90), random.uniform(-9, 9), random.uniform(-9, 9)};
    for (Vector& p : other.vertices) p = Vector{p.x, -p.z, p.y} + shift;  // as the links of a chain
    mesh = both(std::move(mesh), other);
    const solid::Crossings told = solid::crossings(mesh);
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_EQ(found.first.has_value(), told.first.has_value()) << seed;
    EXPECT_EQ(found.changing.has_value(), told.changing.has_value()) << seed;
    (found.changing ? crossing : apart) += 1;
  }
  EXPECT_GT(crossing, 2);
  EXPECT_GT(apart, 2);
}

// ---- a look at all pairs, in whole numbers ----------------------------------------------------------------

using Whole = std::array<long long, 3>;

Whole operator-(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// Six times the volume of four points.
long long volume(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  const Whole u = b - a, v = c - a, w = d - a;
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}
int sign(long long x) { return x > 0 ? 1 : (x < 0 ? -1 : 0); }

/// Triangles with the places of their corners, to be multiplied by a power of two.
using WholeMesh = std::vector<std::array<Whole, 3>>;

/// Turns some of the triangles and begins them at any corner.
WholeMesh shuffled(Random& random, const Mesh& mesh) {
  WholeMesh made;
  for (const auto& t : mesh.triangles) {
    std::array<Whole, 3> triangle;
    const std::size_t first = random.below(3), turned = random.below(2);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector p = mesh.vertices[t[(first + (turned == 1 ? 3 - k : k)) % 3]];
      triangle[k] = {std::llround(p.x), std::llround(p.y), std::llround(p.z)};
    }
    made.push_back(triangle);
  }
  for (std::size_t k = made.size(); k > 1; --k) std::swap(made[k - 1], made[random.below(k)]);
  return made;
}
Mesh scaled(const WholeMesh& mesh, double by) {
  Mesh made;
  for (const auto& t : mesh) {
    const auto first = static_cast<std::uint32_t>(made.vertices.size());
    for (const Whole& p : t)
      made.vertices.push_back(
          {by * static_cast<double>(p[0]), by * static_cast<double>(p[1]), by * static_cast<double>(p[2])});
    made.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

/// Returns the places where edges of triangle s run through the inside of triangle t.
std::vector<Near3> run_through(const std::array<Whole, 3>& s, const std::array<Whole, 3>& t) {
  std::vector<Near3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    const Whole &p = s[k], &q = s[(k + 1) % 3];
    const long long before = volume(t[0], t[1], t[2], p), after = volume(t[0], t[1], t[2], q);
    if (sign(before) * sign(after) != -1) continue;
    const int a = sign(volume(p, q, t[0], t[1])), b = sign(volume(p, q, t[1], t[2])),
              c = sign(volume(p, q, t[2], t[0]));
    if (a == 0 || a != b || b != c) continue;
    Near3 place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<double>(p[axis]) + static_cast<double>(q[axis] - p[axis]) *
                                                       static_cast<double>(before) /
                                                       static_cast<double>(before - after);
    places.push_back(place);
  }
  return places;
}
bool crosses(const WholeMesh& mesh) {
  return std::ranges::any_of(mesh, [&](const auto& s) {
    return std::ranges::any_of(mesh, [&](const auto& t) { return !run_through(s, t).empty(); });
  });
}

Whole some_place(Random& random, std::uint64_t size) {
  Whole p{};
  for (long long& x : p) x = static_cast<long long>(random.below(size));
  return p;
}
Vector vector_of(const Whole& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// A tetrahedron that is not flat, some corners of which may be those of another.
Mesh some_tetrahedron(Random& random, std::uint64_t size, const Mesh& other) {
  while (true) {
    std::array<Whole, 4> p;
    for (Whole& x : p) x = some_place(random, size);
    for (std::size_t k = random.below(4); k < 2 && !other.vertices.empty(); ++k) {
      const Vector v = other.vertices[k];
      p[k] = {std::llround(v.x), std::llround(v.y), std::llround(v.z)};
    }
    if (volume(p[0], p[1], p[2], p[3]) == 0) continue;
    return {{vector_of(p[0]), vector_of(p[1]), vector_of(p[2]), vector_of(p[3])},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  }
}

/// Powers of two leave all digits as they are, so that the answer is the same.
constexpr double kScales[] = {1, 0x1p-7, 0x1p6};

TEST(SelfCrossings, OfTetrahedraAnEdgeRunsThroughATriangleWhereOneDoes) {
  Random random(3);
  int with = 0, without = 0;
  for (int n = 0; n < 250; ++n) {
    const std::uint64_t size = 4 + random.below(9);
    const Mesh one = some_tetrahedron(random, size, {});
    const WholeMesh mesh = shuffled(random, both(one, some_tetrahedron(random, size, one)));
    const double scale = kScales[random.below(3)];
    const SelfCrossings found = crossings_of(scaled(mesh, scale));
    EXPECT_TRUE(found.complete);
    ASSERT_EQ(found.first.has_value(), crosses(mesh)) << n;
    (found.first ? with : without) += 1;
    if (!found.first) continue;
    const auto is_there = [&](const auto& t) {
      return std::ranges::any_of(run_through(mesh[found.first->triangle], t), [&](const Near3& p) {
        return std::abs(p[0] * scale - found.first->place[0]) < 1e-9 * scale &&
               std::abs(p[1] * scale - found.first->place[1]) < 1e-9 * scale &&
               std::abs(p[2] * scale - found.first->place[2]) < 1e-9 * scale;
      });
    };
    EXPECT_TRUE(std::ranges::any_of(mesh, is_there)) << n;
  }
  EXPECT_GT(with, 50);
  EXPECT_GT(without, 50);
}

/// Two boxes with corners of whole numbers.
struct Boxes {
  std::array<std::array<Whole, 2>, 2> corners;

  /// Whether inside is before a triangle that lies across an axis, at a place in parts of a whole: 1 before,
  /// -1 behind; 0 where it is on both sides or none, or where a face stands on the triangle.
  [[nodiscard]] int inside_at(const std::array<Whole, 3>& t, const Whole& place, long long parts) const {
    std::size_t across = 0;
    while (t[0][across] != t[1][across] || t[0][across] != t[2][across]) ++across;
    const std::size_t u = (across + 1) % 3, v = (across + 2) % 3;
    const Whole a = t[1] - t[0], b = t[2] - t[0];
    const int up = sign(a[u] * b[v] - a[v] * b[u]);
    std::array<bool, 2> odd{};
    for (const auto& [low, high] : corners) {
      const auto within = [&, &low = low, &high = high](std::size_t axis, long long by) {
        return 2 * parts * low[axis] <= 2 * place[axis] + by &&
               2 * place[axis] + by <= 2 * parts * high[axis];
      };
      for (const auto& [one, other] : {std::pair(u, v), {v, u}})
        if (within(across, 0) && within(other, 0) &&
            (place[one] == parts * low[one] || place[one] == parts * high[one]))
          return 0;
      for (std::size_t side : {0U, 1U})
        odd[side] = odd[side] != (within(u, 0) && within(v, 0) && within(across, side == 0 ? up : -up));
    }
    return odd[0] == odd[1] ? 0 : (odd[0] ? 1 : -1);
  }
};

/// Numbers the faces of triangles, 2 t before and 2 t + 1 behind: those of one side of a sheet alike.
std::vector<std::size_t> sides_of(const WholeMesh& mesh) {
  std::vector<std::size_t> side(2 * mesh.size());
  for (std::size_t k = 0; k < side.size(); ++k) side[k] = k;
  const auto unite = [&](std::size_t a, std::size_t b) {
    const std::size_t from = side[a], to = side[b];
    std::ranges::replace(side, from, to);
  };
  struct Edge {
    std::size_t triangle;
    bool turned;
  };
  std::map<std::pair<Whole, Whole>, std::vector<Edge>> edges;
  for (std::size_t t = 0; t < mesh.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Whole &p = mesh[t][k], &q = mesh[t][(k + 1) % 3];
      edges[{std::min(p, q), std::max(p, q)}].push_back({t, p < q});
    }
  for (const auto& [ends, at] : edges)
    if (at.size() == 2)
      for (const std::size_t face : {0U, 1U})
        unite(2 * at[0].triangle + face,
              2 * at[1].triangle + (at[0].turned == at[1].turned ? 1 - face : face));
  return side;
}

TEST(SelfCrossings, OfBoxesInsideChangesSidesWhereItDoes) {
  Random random(4);
  constexpr long long kParts = 19;
  std::array<int, 4> seen{};
  for (int n = 0; n < 300; ++n) {
    Boxes boxes{};
    Mesh solid;
    const std::uint64_t size = 3 + random.below(4);
    for (auto& [low, high] : boxes.corners) {
      do low = some_place(random, size), high = some_place(random, size);
      while (low[0] >= high[0] || low[1] >= high[1] || low[2] >= high[2]);
      // Of some axes the second has the planes of the first.
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!solid.vertices.empty() && random.below(3) == 0)
          for (const std::size_t end : {0U, 1U}) (end == 0 ? low : high)[axis] = boxes.corners[0][end][axis];
      cases::append(solid, block(vector_of(low), vector_of(high)));
    }
    const WholeMesh mesh = shuffled(random, solid);
    const std::vector<std::size_t> sides = sides_of(mesh);
    const double scale = kScales[random.below(3)];
    const SelfCrossings found = crossings_of(scaled(mesh, scale));
    // Of each side whether inside is on it somewhere, and at the middle of a triangle.
    std::vector<bool> anywhere(sides.size()), at_middles(sides.size());
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      const auto note = [&, &at = mesh[t]](std::vector<bool>& on, long long i, long long j, long long k) {
        Whole place{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          place[axis] = i * at[0][axis] + j * at[1][axis] + k * at[2][axis];
        if (const int inside = boxes.inside_at(mesh[t], place, i + j + k); inside != 0)
          on[sides[2 * t + (inside > 0 ? 0 : 1)]] = true;
      };
      note(at_middles, 1, 1, 1);
      for (long long i = 1; i < kParts; ++i)
        for (long long j = 1; i + j < kParts; ++j) note(anywhere, i, j, kParts - i - j);
    }
    const auto changes = [&](const std::vector<bool>& on) {
      for (std::size_t t = 0; t < mesh.size(); ++t)
        if (on[sides[2 * t]] && on[sides[2 * t + 1]]) return true;
      return false;
    };
    ASSERT_EQ(found.first.has_value(), crosses(mesh)) << n;
    if (changes(at_middles)) {
      EXPECT_TRUE(found.changing) << n;
    } else if (!found.first || !changes(anywhere)) {
      EXPECT_FALSE(found.changing) << n;
    }
    ++seen[(found.first ? 2U : 0U) + (found.changing ? 1U : 0U)];
    if (!found.changing || found.first) continue;
    const auto& [a, b, c] = mesh[found.changing->triangle];
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(3 * found.changing->place[axis], scale * static_cast<double>(a[axis] + b[axis] + c[axis]),
                  1e-12 * scale);
  }
  EXPECT_GT(seen[0], 30);
  EXPECT_GT(seen[1], 10);
  EXPECT_GT(seen[2] + seen[3], 30);
}

/// No edge runs through a triangle, and two triangles of either box are odd.
TEST(SelfCrossings, EndInEndHoweverTrianglesAreTurned) {
  Random random(5);
  for (int n = 0; n < 100; ++n) {
    const SelfCrossings found = crossings_of(
        scaled(shuffled(random, both(block({0, 0, 0}, {9, 2, 2}), block({7, 0, 0}, {17, 2, 2}))), 1));
    EXPECT_FALSE(found.first);
    ASSERT_TRUE(found.changing) << n;
    EXPECT_TRUE(found.changing->place[0] == 7 || found.changing->place[0] == 9) << n;
  }
}

TEST(SelfCrossings, APartOrABlankThatGoesThroughItselfIsNotChecked) {
  const Mesh blank = block({-6, -6, -6}, {6, 6, 6});
  for (const bool of_part : {false, true}) {
    cases::SolidResultFiles files = cases::cube_in_cube();
    const std::string before = files.told();
    std::string& bytes = of_part ? files.part : files.blank;
    const Mesh mesh = of_part ? block({-5, -5, -5}, {5, 5, 5}) : blank;
    const auto with = [&](double from) {
      bytes = solid_files::stl_binary(both(mesh, block({from, -2, -3}, {from + 9, 3, 2})));
      files.result["inputs"][of_part ? 0 : 1]["triangles"] = 24;
      return files.told();
    };
    const std::string told = with(of_part ? 4 : 5);
    EXPECT_EQ(told.find("bad input"), 0U) << told;
    EXPECT_NE(told.find("the surface crosses itself at ("), std::string::npos) << told;
    EXPECT_NE(told.find("so that nothing says where the material is"), std::string::npos) << told;
    EXPECT_EQ(before, "unproved");
  }
}

TEST(SelfCrossings, OneThatIsThinIsToldAndTheResultKept) {
  cases::SolidResultFiles files = cases::cube_in_cube();
  files.blank =
      solid_files::stl_binary(both(block({-6, -6, -6}, {6, 6, 6}), block({5.999, -2, -3}, {9, 3, 2})));
  files.result["inputs"][1]["triangles"] = 24;
  files.result["clearance"] = 0.998, files.result["contacts"] = cases::Json::array();
  EXPECT_EQ(files.told(), "unproved");
  const auto report = files.report();
  ASSERT_TRUE(report);
  EXPECT_TRUE(std::ranges::any_of(report->notes, [](const std::string& note) {
    return note.starts_with("blank.stl: the surface crosses itself at (") &&
           note.ends_with(
               "what lies between was not found to be 0.02 mm thick anywhere, and what is inside was "
               "told by an odd count");
  }));
}

}  // namespace
}  // namespace lekalo::verify::verify_self_crossing_test
