// What a certificate for solids proves is true of random poses.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/cases.hpp"
#include "support/solid_proofs.hpp"
#include "support/verify_solids.hpp"
#include "verify/solid/certificate_leaf.hpp"

namespace lekalo::verify::verify_solid_certificate_test {
namespace {

using cases::Json;
using cases::TermKind;

Decimal decimal(double value) { return exactly(value); }
Both number(double value) { return both(decimal(value)); }
SolidPose pose_of(const std::array<double, 4>& q, const std::array<double, 3>& shift) {
  SolidPose pose;
  for (std::size_t k = 0; k < 4; ++k) pose.quaternion[k] = decimal(q[k]);
  for (std::size_t k = 0; k < 3; ++k) pose.shift[k] = decimal(shift[k]);
  return pose;
}

/// Returns q of u q, a point turned first by the rotation of q and then by that of u.
std::array<double, 4> product(const std::array<double, 4>& u, const std::array<double, 4>& q) {
  return {u[0] * q[0] - u[1] * q[1] - u[2] * q[2] - u[3] * q[3],
          u[0] * q[1] + u[1] * q[0] + u[2] * q[3] - u[3] * q[2],
          u[0] * q[2] - u[1] * q[3] + u[2] * q[0] + u[3] * q[1],
          u[0] * q[3] + u[1] * q[2] - u[2] * q[1] + u[3] * q[0]};
}

/// A tetrahedron as a mesh, some ten wide.
solid::Mesh tetrahedron(Random& random) {
  solid::Mesh mesh;
  for (int k = 0; k < 4; ++k)
    mesh.vertices.push_back({random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  return mesh;
}

struct Setting {
  SolidMesh part, blank;
  std::array<double, 4> start;
  std::array<double, 3> pivot;
  std::array<double, 6> middle, half;

  [[nodiscard]] LeafFrame frame(double bound) const {
    return {part,
            blank,
            SolidMotion(pose_of(start, {0, 0, 0})),
            {number(pivot[0]), number(pivot[1]), number(pivot[2])},
            number(bound)};
  }
  [[nodiscard]] PoseBox box() const {
    PoseBox box;
    for (std::size_t k = 0; k < 6; ++k)
      box.low[k] = number(middle[k] - half[k]), box.high[k] = number(middle[k] + half[k]);
    return box;
  }
  /// The motion of a pose of the box.
  [[nodiscard]] solid::Motion motion(const std::array<double, 6>& at) const {
    solid::Motion made = cases::turn_of(product({1, at[3], at[4], at[5]}, start));
    made.shift = solid::Vector{at[0], at[1], at[2]} - made.turned({pivot[0], pivot[1], pivot[2]});
    return made;
  }
};

Setting setting(Random& random, double half_place, double half_turn) {
  Setting s{cases::checked(tetrahedron(random)), cases::checked(tetrahedron(random)), {}, {}, {}, {}};
  if (random.below(2) == 0)
    for (int k = 0; k < 4; ++k) s.blank.widths.push_back(just(random.uniform(0, 1)));
  for (double& q : s.start) q = random.uniform(-1, 1);
  for (double& p : s.pivot) p = random.uniform(-5, 5);
  for (std::size_t k = 0; k < 6; ++k) {
    s.middle[k] = k < 3 ? random.uniform(-20, 20) : random.uniform(-1, 1);
    s.half[k] = k < 3 ? half_place : half_turn;
  }
  return s;
}

Ball ball(Random& random, double radius) {
  return {{number(random.uniform(-20, 20)), number(random.uniform(-20, 20)), number(random.uniform(-20, 20))},
          number(radius)};
}

solid::Vector vector(const Both3& p) { return {p[0].near.low, p[1].near.low, p[2].near.low}; }

std::array<solid::Vector, 3> face(const SolidMesh& mesh, std::uint32_t triangle) {
  std::array<solid::Vector, 3> at;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& p = mesh.near[mesh.triangles[triangle][k]];
    at[k] = {p[0], p[1], p[2]};
  }
  return at;
}
std::array<solid::Vector, 2> edge(const SolidMesh& mesh, std::uint32_t number) {
  const auto at = face(mesh, number / 3);
  return {at[number % 3], at[(number + 1) % 3]};
}

/// What a term says of the clearance at a pose, as it is defined.
double value(const LeafTerm& term, const Setting& s, const solid::Motion& motion) {
  const auto height = [](const std::array<solid::Vector, 3>& t, solid::Vector p) {
    const solid::Vector n = cross(t[1] - t[0], t[2] - t[0]);
    return std::abs(dot(n, p - t[0])) / norm(n);
  };
  if (term.kind == LeafTerm::Kind::edges) {
    const auto [a, b] = edge(s.part, term.part);
    const auto [q, r] = edge(s.blank, term.blank);
    const solid::Vector n = cross(motion.turned(b - a), r - q);
    return std::abs(dot(n, motion(a) - q)) / norm(n) - s.blank.width(term.blank / 3).low;
  }
  if (term.kind == LeafTerm::Kind::part_face)
    return height(face(s.part, term.part), motion.back(vector(term.blank_ball->centre))) -
           term.blank_ball->radius.near.low;
  const solid::Vector a = motion(vector(term.part_ball->centre));
  const double r = term.part_ball->radius.near.low;
  if (term.kind == LeafTerm::Kind::plane) {
    const solid::Vector n = vector(term.plane->normal);
    return (dot(n, a) - term.plane->level.near.low) / norm(n) - r;
  }
  if (term.kind == LeafTerm::Kind::ball)
    return norm(a - vector(term.blank_ball->centre)) - r - term.blank_ball->radius.near.low;
  return height(face(s.blank, term.blank), a) - r - s.blank.width(term.blank).low;
}

/// What the bound is taken times in a term.
double weight(const LeafTerm& term, const Setting& s, const solid::Motion& motion) {
  if (term.kind != LeafTerm::Kind::edges) return 1;
  const auto [a, b] = edge(s.part, term.part);
  const auto [q, r] = edge(s.blank, term.blank);
  const solid::Vector at_middle = cross(s.motion(s.middle).turned(b - a), r - q);
  return dot(cross(motion.turned(b - a), r - q), at_middle) / dot(at_middle, at_middle);
}

/// Terms of any kind; `kept` keeps what they look at.
struct Kept {
  std::vector<Ball> balls;
  std::vector<HalfSpace> planes;
};
std::vector<LeafTerm> some_terms(Random& random, Setting& s, Kept& kept, bool faces) {
  kept.balls.reserve(20), kept.planes.reserve(20);
  std::vector<LeafTerm> terms;
  for (std::size_t count = 1 + random.below(4); terms.size() < count;) {
    LeafTerm term;
    term.multiplier = number(random.uniform(0.1, 3));
    const auto add_ball = [&] {
      kept.balls.push_back(ball(random, random.below(3) == 0 ? 0 : random.uniform(0, 2)));
      return &kept.balls.back();
    };
    term.kind = static_cast<LeafTerm::Kind>(random.below(faces ? 5 : 2));
    if (term.kind == LeafTerm::Kind::edges) {
      // Edges that cross at the middle of the box, as seen along what they have in common.
      term.part = static_cast<std::uint32_t>(random.below(12));
      term.blank = static_cast<std::uint32_t>(random.below(12));
      const solid::Motion middle = s.motion(s.middle);
      const auto [a, b] = edge(s.part, term.part);
      const auto [q, r] = edge(s.blank, term.blank);
      const solid::Vector d = middle.turned(b - a), n = cross(d, r - q), w = middle(a) - q;
      const double along = -dot(w, cross(r - q, n)) / dot(n, n), across = -dot(w, cross(d, n)) / dot(n, n);
      if (std::abs(along - 0.5) > 0.4 || std::abs(across - 0.5) > 0.4) continue;
      terms.push_back(term);
      continue;
    }
    term.part = term.blank = static_cast<std::uint32_t>(random.below(4));
    if (term.kind != LeafTerm::Kind::part_face) term.part_ball = add_ball();
    if (term.kind == LeafTerm::Kind::ball || term.kind == LeafTerm::Kind::part_face)
      term.blank_ball = add_ball();
    if (term.kind == LeafTerm::Kind::plane) {
      const Ball plane = ball(random, random.uniform(-5, 5));
      kept.planes.push_back({plane.centre, plane.radius});
      term.plane = &kept.planes.back();
    }
    // The ball comes to lie over the middle of the face at the middle of the box.
    const auto over = [&](const SolidMesh& mesh) {
      const auto at = face(mesh, term.part);
      const solid::Vector n = cross(at[1] - at[0], at[2] - at[0]);
      return 1.0 / 3 * (at[0] + at[1] + at[2]) +
             random.uniform(2, 5) * (random.below(2) == 0 ? 1 : -1) / norm(n) * n;
    };
    const auto put = [&](Both3& centre, solid::Vector p) {
      centre = {number(p.x), number(p.y), number(p.z)};
    };
    const solid::Motion middle = s.motion(s.middle);
    if (term.kind == LeafTerm::Kind::face) put(kept.balls.back().centre, middle.back(over(s.blank)));
    if (term.kind == LeafTerm::Kind::part_face) put(kept.balls.back().centre, middle(over(s.part)));
    terms.push_back(term);
  }
  return terms;
}

double mean(const std::vector<LeafTerm>& terms, const Setting& s, const solid::Motion& motion) {
  double sum = 0, all = 0;
  for (const LeafTerm& term : terms) {
    const double share = term.multiplier.near.low * weight(term, s, motion);
    sum += share * value(term, s, motion);
    all += share;
  }
  return sum / all;
}

TEST(SolidLeaf, AtOnePoseItProvesTheMeanOfItsTermsAndNoLess) {
  Random random(3);
  int proved = 0;
  for (std::uint64_t k = 0; k < cases::case_count(300); ++k) {
    Setting s = setting(random, 0, 0);
    Kept kept;
    const std::vector<LeafTerm> terms = some_terms(random, s, kept, true);
    const double is = mean(terms, s, s.motion(s.middle));
    EXPECT_FALSE(proves(terms, s.box(), s.frame(is - 1e-9))) << k;
    // What needs a bound not below 0, or not below the depth of a ball, is left out.
    if (is < 0) continue;
    ++proved;
    EXPECT_TRUE(proves(terms, s.box(), s.frame(is + 1e-9))) << k;
  }
  EXPECT_GT(proved, 100);
}

TEST(SolidLeaf, OverABoxItProvesNothingBelowAnyPose) {
  Random random(4);
  int proved = 0;
  for (std::uint64_t k = 0; k < cases::case_count(300); ++k) {
    Setting s = setting(random, random.uniform(0, 1), random.uniform(0, 0.1));
    Kept kept;
    const std::vector<LeafTerm> terms = some_terms(random, s, kept, true);
    double most = -1e9;
    for (int n = 0; n < 200; ++n) {
      std::array<double, 6> at = s.middle;
      for (std::size_t axis = 0; axis < 6; ++axis)
        at[axis] += s.half[axis] * (n % 2 == 0 ? random.uniform(-1, 1) : (random.below(2) == 0 ? -1 : 1));
      most = std::max(most, mean(terms, s, s.motion(at)));
    }
    EXPECT_FALSE(proves(terms, s.box(), s.frame(most - 1e-9))) << k;
    if (most >= 0 && proves(terms, s.box(), s.frame(most * 1.5 + 3))) ++proved;
  }
  EXPECT_GT(proved, 50);
}

TEST(SolidCertificate, NoPoseOfItsWindowHasMoreClearance) {
  Random random(5);
  for (const char* freedom : {"xyz", "c-xyz", "six"})
    for (std::uint64_t k = 0; k < cases::case_count(4); ++k) {
      const cases::SolidProof proof = k % 4 == 3 ? cases::edges_proof(random, freedom, 1)
                                                 : cases::solid_proof(random, TermKind::any, freedom, k % 4);
      EXPECT_EQ(proof.files.told(), "confirmed") << freedom << k;
      const Json& window = proof.files.result["window"];
      const auto mesh = [](const std::string& bytes) {
        return *closed(read_solid({"mesh", bytes})->mesh, "mesh");
      };
      const SolidMesh part = mesh(proof.files.part), blank = mesh(proof.files.blank);
      std::array<double, 4> start{};
      std::array<double, 3> pivot{};
      for (std::size_t i = 0; i < 4; ++i) start[i] = window["quaternion"][i];
      for (std::size_t i = 0; i < 3; ++i) pivot[i] = window["pivot"][i];
      Setting s{part, blank, start, pivot, {}, {}};
      solid::Motion there = cases::turn_of(start);
      there.shift = {window["x"], window["y"], window["z"]};
      const solid::Vector place = there({pivot[0], pivot[1], pivot[2]});
      const double turn = std::tan(double(window["turn_deg"]) * std::numbers::pi / 360);
      for (int n = 0; n < 40; ++n) {
        const double share = random.uniform(0, 1);
        const auto up_to = [&](double most) { return share * random.uniform(-most, most); };
        const std::array<double, 3> x{std::string(freedom) == "six" ? up_to(turn) : 0,
                                      std::string(freedom) == "six" ? up_to(turn) : 0, up_to(turn)};
        const std::array<double, 6> at{
            place.x + up_to(0.5), place.y + up_to(0.5), place.z + up_to(0.5), x[0], x[1], x[2]};
        const solid::Vector shift = s.motion(at).shift;
        const auto pair = SolidPair::make(
            part, blank, pose_of(product({1, x[0], x[1], x[2]}, start), {shift.x, shift.y, shift.z}));
        ASSERT_TRUE(pair);
        EXPECT_TRUE(pair->check(decimal(proof.bound + 1e-9)).fault) << freedom << k;
      }
      // A bound below the clearance of the pose that the result has is not proved.
      cases::SolidResultFiles lower = proof.files;
      const double clearance = lower.result["clearance"];
      lower.result["upper_bound"] = clearance, lower.result["gap"] = 0;
      EXPECT_NE(lower.told().find("do not prove"), std::string::npos) << freedom << k;
    }
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_certificate_test
