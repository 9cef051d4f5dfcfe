// The certificate of solids, held against its own words (docs/formats.md) in long double: balls are where
// they should be, leaves fill the window, and their terms are never above 0 all together.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "support/cases.hpp"
#include "support/solid_brute_force.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::locate_solid_proof_test {
namespace {

using brute::cross;
using brute::dot;
using brute::length;
using brute::minus;
using brute::Real;
using brute::wide;
using brute::Wide;
using locate::SolidFreedom;
using locate::SolidProblem;
using locate::SolidProof;
using locate::SolidTerm;
using locate::SolidTree;
using solid::Vector;
using Axis = SolidTree::Axis;

Wide plus(const Wide& a, const Wide& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Wide times(Real k, const Wide& a) { return {k * a[0], k * a[1], k * a[2]}; }

/// A rotation by a quaternion of any length, and back.
Wide rotated(const std::array<Real, 4>& q, const Wide& p) {
  const Wide v{q[1], q[2], q[3]}, across = cross(v, p);
  const Real square = q[0] * q[0] + dot(v, v);
  return plus(p, times(2 / square, plus(times(q[0], across), cross(v, across))));
}
Wide rotated_back(const std::array<Real, 4>& q, const Wide& p) {
  return rotated({q[0], -q[1], -q[2], -q[3]}, p);
}

std::array<Wide, 3> corners(const solid::Mesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {wide(mesh.vertices[t[0]]), wide(mesh.vertices[t[1]]), wide(mesh.vertices[t[2]])};
}

/// The distance of a point from a surface, and how often the surface goes round it.
struct Place {
  Real distance = std::numeric_limits<Real>::infinity(), winding = 0;
};
Place place_in(const solid::Mesh& mesh, const Wide& p) {
  Place place;
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto t = corners(mesh, k);
    brute::look_at_face(place.distance, p, t);
    for (std::size_t i = 0; i < 3; ++i) brute::look_at_edge(place.distance, p, t[i], t[(i + 1) % 3]);
    const Wide a = minus(t[0], p), b = minus(t[1], p), c = minus(t[2], p);
    const Real la = length(a), lb = length(b), lc = length(c);
    place.winding +=
        std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) /
        (2 * std::numbers::pi_v<Real>);
  }
  return place;
}

/// The pose that a box has between its low and its high corner.
struct Pose {
  Wide t, x;
};

struct Check {
  const SolidProblem& problem;
  const SolidProof& proof;
  Real beta;
  const SolidTree& tree;
  std::array<Real, 4> start{tree.quaternion[0], tree.quaternion[1], tree.quaternion[2], tree.quaternion[3]};

  [[nodiscard]] Wide from_pivot(const Wide& p) const { return rotated(start, minus(p, wide(proof.pivot))); }
  [[nodiscard]] static std::array<Real, 4> turn(const Pose& pose) {
    return {1, pose.x[0], pose.x[1], pose.x[2]};
  }
  [[nodiscard]] Wide placed(const Wide& p, const Pose& pose) const {
    return plus(rotated(turn(pose), from_pivot(p)), pose.t);
  }
  /// The blank's point as the part sees it, from the pivot and turned as at the start.
  [[nodiscard]] static Wide seen(const Wide& c, const Pose& pose) {
    return rotated_back(turn(pose), minus(c, pose.t));
  }

  [[nodiscard]] static bool is_of_point(const SolidTerm& term) {
    return term.kind == SolidTerm::Kind::point || term.kind == SolidTerm::Kind::point_plane ||
           term.kind == SolidTerm::Kind::point_face;
  }
  /// The point or the ball of the part that a term has.
  [[nodiscard]] Wide of_part(const SolidTerm& term) const {
    if (!is_of_point(term)) return wide(proof.part_balls[term.part].centre);
    const auto& point = proof.part_points[term.part];
    EXPECT_GE(point.u, 0);
    EXPECT_GE(point.v, 0);
    EXPECT_LE(std::round(1e9 * point.u) + std::round(1e9 * point.v), 1e9);
    const auto t = corners(problem.part, point.triangle);
    return plus(t[0], plus(times(point.u, minus(t[1], t[0])), times(point.v, minus(t[2], t[0]))));
  }
  [[nodiscard]] Real radius(const SolidTerm& term) const {
    return is_of_point(term) ? 0 : proof.part_balls[term.part].radius;
  }
  /// The allowance that a term's place has more than, where the margin is above beta.
  [[nodiscard]] Real demanded(const SolidTerm& term) const {
    if (problem.demands.empty()) return beta;
    const auto at = [&](const auto& demand) {
      EXPECT_TRUE(demand.has_value());
      return demand->minimum + demand->scale * beta;
    };
    if (is_of_point(term)) return at(problem.demands[proof.part_points[term.part].triangle]);
    if (term.kind == SolidTerm::Kind::part_face) return at(problem.demands[term.part]);
    if (term.kind == SolidTerm::Kind::edges) return at(problem.demands[term.part / 3]);
    Real least = std::numeric_limits<Real>::infinity();
    for (const auto& demand : problem.demands) least = std::min(least, at(demand));
    return least;
  }

  /// The triangle of a term, and the point over it.
  struct Over {
    std::array<Wide, 3> corner;
    Wide normal, point;
  };
  [[nodiscard]] Over over(const SolidTerm& term, const Pose& middle, const Pose& pose) const {
    const bool of_part_face = term.kind == SolidTerm::Kind::part_face;
    Over made{
        corners(of_part_face ? problem.part : problem.blank, of_part_face ? term.part : term.blank), {}, {}};
    const auto point = [&](const Pose& at) {
      return of_part_face ? seen(wide(proof.blank_balls[term.blank].centre), at) : placed(of_part(term), at);
    };
    if (of_part_face)
      for (Wide& corner : made.corner) corner = from_pivot(corner);
    made.normal = cross(minus(made.corner[1], made.corner[0]), minus(made.corner[2], made.corner[0]));
    made.normal = times(1 / length(made.normal), made.normal);
    if (dot(made.normal, minus(point(middle), made.corner[0])) < 0) made.normal = times(-1, made.normal);
    made.point = point(pose);
    return made;
  }

  /// The edges of a term at a pose: how far they pass, times n . u, and n . u.
  struct Passing {
    Wide p, d, q, g, u;
    Real passes = 0, seen = 0;
  };
  [[nodiscard]] Passing passing(const SolidTerm& term, const Pose& middle, const Pose& pose) const {
    const auto end = [](const solid::Mesh& mesh, std::uint32_t edge, std::uint32_t k) {
      return corners(mesh, edge / 3)[(edge + k) % 3];
    };
    const Wide a = end(problem.part, term.part, 0), b = end(problem.part, term.part, 1);
    Wide q = end(problem.blank, term.blank, 0), r = end(problem.blank, term.blank, 1);
    const auto along = [&](const Pose& at) { return minus(placed(b, at), placed(a, at)); };
    if (dot(cross(along(middle), minus(r, q)), minus(placed(a, middle), q)) < 0) std::swap(q, r);
    Passing made{placed(a, pose), along(pose), q, minus(r, q), cross(along(middle), minus(r, q))};
    const Real angle = length(made.u);
    made.u = times(1 / angle, made.u);
    const Wide n = times(1 / angle, cross(made.d, made.g));
    made.passes = dot(n, minus(made.p, q));
    made.seen = dot(n, made.u);
    return made;
  }

  /// The sum of the terms at a pose. With `chord` the distance |w| of balls is replaced by its bound that
  /// touches it at the middle of the box.
  [[nodiscard]] Real sum(const std::vector<SolidTerm>& terms, const Pose& middle, const Pose& pose,
                         bool chord) const {
    Real sum = 0;
    for (const SolidTerm& term : terms) {
      Real value = 0;
      const Real allowed = demanded(term);
      if (term.kind == SolidTerm::Kind::edges) {
        const Passing at = passing(term, middle, pose);
        EXPECT_GE(allowed, 0);
        sum += term.multiplier * (at.passes - allowed * at.seen);
        continue;
      }
      if (term.kind == SolidTerm::Kind::ball || term.kind == SolidTerm::Kind::point) {
        const auto& blank = proof.blank_balls[term.blank];
        const auto apart = [&](const Pose& at) {
          return length(minus(placed(of_part(term), at), wide(blank.centre)));
        };
        const Real w = apart(pose), l = apart(middle);
        value = (chord ? (w * w + l * l) / (2 * l) : w) - radius(term) - blank.radius;
        if (!is_of_point(term)) {
          EXPECT_GE(allowed, -blank.radius);
        }
      } else if (term.kind == SolidTerm::Kind::plane || term.kind == SolidTerm::Kind::point_plane) {
        const auto& plane = proof.planes[term.blank];
        const Wide n = wide(plane.normal);
        value = (dot(n, placed(of_part(term), pose)) - plane.least) / length(n) - radius(term);
      } else {
        const Over at = over(term, middle, pose);
        value =
            dot(at.normal, minus(at.point, at.corner[0])) -
            (term.kind == SolidTerm::Kind::part_face ? proof.blank_balls[term.blank].radius : radius(term));
        EXPECT_GE(allowed, 0);
      }
      sum += term.multiplier * (value - allowed);
    }
    return sum;
  }

  /// Every triangle has its point over it, and edges pass each other.
  void expect_over(const std::vector<SolidTerm>& terms, const Pose& middle, const Pose& pose) const {
    for (const SolidTerm& term : terms) {
      if (term.kind == SolidTerm::Kind::ball || term.kind == SolidTerm::Kind::plane ||
          term.kind == SolidTerm::Kind::point || term.kind == SolidTerm::Kind::point_plane)
        continue;
      if (term.kind == SolidTerm::Kind::edges) {
        const auto [p, d, q, g, u, passes, seen] = passing(term, middle, pose);
        const Wide w = minus(p, q), beside = cross(g, u), across = cross(d, u);
        EXPECT_GT(passes, 0);
        EXPECT_LT(dot(beside, w), 0);
        EXPECT_GT(dot(beside, plus(w, d)), 0);
        EXPECT_LT(dot(across, w), 0);
        EXPECT_GT(dot(across, minus(w, g)), 0);
        continue;
      }
      const Over at = over(term, middle, pose);
      EXPECT_GE(dot(at.normal, minus(at.point, at.corner[0])), 0);
      const Wide n = cross(minus(at.corner[1], at.corner[0]), minus(at.corner[2], at.corner[0]));
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_GE(dot(cross(n, minus(at.corner[(k + 1) % 3], at.corner[k])), minus(at.point, at.corner[k])),
                  0);
    }
  }
};

/// The 27 Bernstein coefficients of what is quadratic along each of three axes, from its values at the ends
/// and the middles; for one shift.
template <class Value>
Real most_coefficient(const Wide& low, const Wide& high, const Value& value) {
  std::array<std::array<std::array<Real, 3>, 3>, 3> b;
  const auto at = [](Real from, Real to, std::size_t k) {
    return k == 0 ? from : k == 1 ? (from + to) / 2 : to;
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        b[i][j][k] = value(Wide{at(low[0], high[0], i), at(low[1], high[1], j), at(low[2], high[2], k)});
  const auto middle = [](Real from, Real& of, Real to) { of = 2 * of - (from + to) / 2; };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) middle(b[i][j][0], b[i][j][1], b[i][j][2]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) middle(b[i][0][k], b[i][1][k], b[i][2][k]);
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k < 3; ++k) middle(b[0][j][k], b[1][j][k], b[2][j][k]);
  Real most = -std::numeric_limits<Real>::infinity();
  for (const auto& plane : b)
    for (const auto& row : plane)
      for (const Real one : row) most = std::max(most, one);
  return most;
}

/// Of many leaves, balls and planes of one certificate about so many are checked.
constexpr std::size_t kChecked = 40;
std::size_t one_in(std::size_t count) { return 1 + count / kChecked; }

/// Walks the tree, and checks leaves. Returns the share of the root that all of them fill.
Real check_leaves(const Check& check, Random& random) {
  struct Box {
    std::array<Real, 6> low, high;
  };
  std::vector<Box> open(1);
  for (std::size_t k = 0; k < 6; ++k)
    open[0].low[k] = check.tree.low[k], open[0].high[k] = check.tree.high[k];
  const Box root = open[0];
  Real filled = 0;
  for (const SolidTree::Node& node : check.tree.nodes) {
    if (open.empty()) return -1;
    const Box box = open.back();
    open.pop_back();
    if (node.axis != Axis::leaf) {
      const auto k = static_cast<std::size_t>(node.axis);
      EXPECT_GT(node.at, box.low[k]);
      EXPECT_LT(node.at, box.high[k]);
      Box low = box, high = box;
      low.high[k] = high.low[k] = node.at;
      open.push_back(high);
      open.push_back(low);
      continue;
    }
    Real share = 1;
    for (std::size_t k = 0; k < 6; ++k)
      if (root.low[k] < root.high[k]) share *= (box.high[k] - box.low[k]) / (root.high[k] - root.low[k]);
    filled += share;
    const std::vector<SolidTerm> terms(check.tree.terms.begin() + node.first,
                                       check.tree.terms.begin() + node.first + node.count);
    EXPECT_GT(terms.size(), 0u);
    if (random.below(one_in(check.tree.nodes.size() / 2)) != 0) continue;
    const auto pose = [&](const auto& part_of) {
      Pose made;
      for (std::size_t k = 0; k < 3; ++k) {
        made.t[k] = box.low[k] + part_of() * (box.high[k] - box.low[k]);
        made.x[k] = box.low[3 + k] + part_of() * (box.high[3 + k] - box.low[3 + k]);
      }
      return made;
    };
    const Pose middle = pose([] { return Real{0.5}; });
    for (int k = 0; k < 4; ++k) {
      const Pose here = pose([&]() -> Real { return random.uniform(0, 1); }),
                 corner = pose([&]() -> Real { return static_cast<Real>(random.below(2)); });
      EXPECT_LE(check.sum(terms, middle, here, false), 0);
      EXPECT_LE(check.sum(terms, middle, corner, true), 0);
      check.expect_over(terms, middle, here);
      check.expect_over(terms, middle, corner);
    }
    for (std::size_t k = 0; k < 8; ++k) {
      const Wide t{(k & 1) != 0 ? box.high[0] : box.low[0], (k & 2) != 0 ? box.high[1] : box.low[1],
                   (k & 4) != 0 ? box.high[2] : box.low[2]};
      const Real most = most_coefficient({box.low[3], box.low[4], box.low[5]},
                                         {box.high[3], box.high[4], box.high[5]}, [&](const Wide& x) {
                                           return (1 + dot(x, x)) * check.sum(terms, middle, {t, x}, true);
                                         });
      EXPECT_LE(most, 0);
    }
  }
  return open.empty() ? filled : -1;
}

/// Checks all that a certificate says of meshes of which each coordinate may be off.
void expect_proof(const SolidProblem& problem, const locate::SolidResult& found, Random& random) {
  const SolidProof& proof = found.proof;
  ASSERT_TRUE(std::isfinite(found.upper_bound));
  solid::Mesh part = problem.part, blank = problem.blank;
  const auto shake = [&](solid::Mesh& mesh, double by) {
    if (by > 0)
      for (Vector& p : mesh.vertices)
        p = p + Vector{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
  };
  shake(part, problem.part_coordinate_error);
  shake(blank, problem.blank_coordinate_error);
  for (const auto& ball : proof.part_balls) {
    if (random.below(one_in(proof.part_balls.size())) != 0) continue;
    const Place place = place_in(part, wide(ball.centre));
    EXPECT_GE(place.distance, ball.radius);
    EXPECT_GT(std::abs(place.winding), 0.5);
  }
  for (const auto& ball : proof.blank_balls) {
    if (random.below(one_in(proof.blank_balls.size())) != 0) continue;
    const Place place = place_in(blank, wide(ball.centre));
    EXPECT_GE(place.distance, ball.radius);
    EXPECT_LT(std::abs(place.winding), 0.5);
  }
  for (const auto& plane : proof.planes)
    for (const Vector v : blank.vertices) EXPECT_GE(dot(wide(plane.normal), wide(v)), Real{plane.least});
  // Each pose of the window is in a root.
  const auto& q = problem.start.quaternion;
  const bool all = problem.turn == SolidProblem::kAllTurns;
  std::vector<std::array<double, 4>> charts{q};
  if (all && problem.freedom == SolidFreedom::six)
    charts.insert(charts.end(), {{-q[1], q[0], -q[3], q[2]}, {-q[2], q[3], q[0], -q[1]}});
  if (all && problem.freedom != SolidFreedom::xyz) charts.push_back({-q[3], -q[2], q[1], q[0]});
  ASSERT_EQ(proof.trees.size(), charts.size());
  const Wide at = plus(rotated({q[0], q[1], q[2], q[3]}, wide(proof.pivot)), wide(problem.start.shift));
  SolidProblem shaken = problem;
  shaken.part = part;
  shaken.blank = blank;
  for (std::size_t n = 0; n < charts.size(); ++n) {
    const SolidTree& tree = proof.trees[n];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(tree.low[k], at[k] - problem.shift);
      EXPECT_GE(tree.high[k], at[k] + problem.shift);
      const bool turns =
          problem.freedom == SolidFreedom::six || (problem.freedom == SolidFreedom::c_xyz && k == 2);
      const Real most = !turns ? 0 : all ? 1 : std::tan(Real{problem.turn} / 2);
      EXPECT_LE(tree.low[3 + k], -most);
      EXPECT_GE(tree.high[3 + k], most);
    }
    EXPECT_EQ(tree.quaternion, charts[n]);
    EXPECT_NEAR(static_cast<double>(check_leaves({shaken, proof, found.upper_bound, tree}, random)), 1,
                1e-12);
  }
}

TEST(SolidProof, HoldsByItsOwnWords) {
  Random random(cases::seed(), 91);
  for (std::uint64_t k = 0; k < cases::case_count(5); ++k) {
    const cases::SolidCase pair = k % 5 == 0   ? cases::convex_in_convex(random, 16, 1.5)
                                  : k % 5 == 1 ? cases::convex_in_convex(random, 16, 1, true)
                                  : k % 5 == 2 ? cases::cored_block(random, 3)
                                  : k % 5 == 3 ? cases::turned_part(random, 10)
                                               : cases::wavy_part(random, 6);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem{pair.part, pair.blank, {}};
    for (const SolidFreedom freedom : {SolidFreedom::six, SolidFreedom::c_xyz, SolidFreedom::xyz}) {
      problem.freedom = freedom;
      const auto found = locate::locate_solid(problem, {.gap = 0.05, .run = {}});
      ASSERT_TRUE(found) << found.error().message;
      expect_proof(problem, *found, random);
      // The first box that is bounded has a reason for its bound, and so have those that a stop leaves open.
      for (const std::uint64_t work : {1, 25}) {
        locate::SolidOptions options{.gap = 0.05, .run = {}};
        options.run.work_limit = work;
        const auto stopped = locate::locate_solid(problem, options);
        ASSERT_TRUE(stopped) << stopped.error().message;
        if (found->best.inside) {
          EXPECT_GE(stopped->upper_bound, found->best.clearance);
        }
        expect_proof(problem, *stopped, random);
      }
    }
  }
}

TEST(SolidProof, HoldsForDemandsByFace) {
  Random random(cases::seed(), 94);
  for (std::uint64_t k = 0; k < cases::case_count(4); ++k) {
    const cases::SolidCase pair = k % 4 == 0   ? cases::convex_in_convex(random, 16, 1.5)
                                  : k % 4 == 1 ? cases::cored_block(random, 3)
                                  : k % 4 == 2 ? cases::turned_part(random, 10)
                                               : cases::wavy_part(random, 6);
    SCOPED_TRACE(pair.kind);
    SolidProblem problem{pair.part, pair.blank, {}};
    // Some triangles are as cast in every other case; coordinates may be off.
    const double as_cast = random.below(2) == 0 ? 0.1 : 0;
    const std::array<locate::SolidDemand, 3> demands{
        {{0, 1}, {random.uniform(0, 1), 1}, {random.uniform(0, 0.2), random.uniform(0.5, 2)}}};
    for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
      problem.demands.push_back(random.uniform(0, 1) < as_cast ? std::nullopt
                                                               : std::optional(demands[random.below(3)]));
    problem.part_coordinate_error = 1e-6;
    for (const std::uint64_t work : {1, 25, 2000}) {
      locate::SolidOptions options{.gap = 0.05, .run = {}};
      options.run.work_limit = work;
      const auto found = locate::locate_solid(problem, options);
      ASSERT_TRUE(found) << found.error().message;
      if (found->best.inside) {
        EXPECT_GE(found->upper_bound, found->best.margin);
      }
      expect_proof(problem, *found, random);
    }
  }
}

TEST(SolidProof, HoldsForWideTurnsFromAnyStart) {
  Random random(cases::seed(), 92);
  for (std::uint64_t k = 0; k < cases::case_count(3); ++k) {
    const cases::SolidCase pair = cases::cored_block(random, 3);
    SolidProblem problem{pair.part, pair.blank, {}};
    problem.start = {{random.uniform(-1, 1), random.uniform(-1, 1), 1, random.uniform(-1, 1)}, {1, 2, 3}};
    problem.turn = 0.5 * std::numbers::pi;
    locate::SolidOptions options{.gap = 0.05, .run = {}};
    options.run.work_limit = 100;
    const auto found = locate::locate_solid(problem, options);
    ASSERT_TRUE(found) << found.error().message;
    expect_proof(problem, *found, random);
  }
}

TEST(SolidProof, HoldsForAllRotations) {
  Random random(cases::seed(), 94);
  const cases::SolidCase pair = cases::cored_block(random, 3);
  SolidProblem problem{pair.part, pair.blank, {}};
  problem.start = {{random.uniform(-1, 1), random.uniform(-1, 1), 1, random.uniform(-1, 1)}, {1, 2, 3}};
  problem.turn = SolidProblem::kAllTurns;
  for (const SolidFreedom freedom : {SolidFreedom::six, SolidFreedom::c_xyz}) {
    problem.freedom = freedom;
    locate::SolidOptions options{.gap = 0.05, .run = {}};
    options.run.work_limit = 300;
    const auto found = locate::locate_solid(problem, options);
    ASSERT_TRUE(found) << found.error().message;
    expect_proof(problem, *found, random);
  }
}

TEST(SolidProof, HoldsForWhatCoordinatesMayBeOff) {
  Random random(cases::seed(), 93);
  const cases::SolidCase pair = cases::cored_block(random, 3);
  SolidProblem problem{pair.part, pair.blank, {}};
  const auto exact = locate::locate_solid(problem, {.gap = 0.05, .run = {}});
  problem.part_coordinate_error = 2e-5;
  problem.blank_coordinate_error = 1e-5;
  const auto found = locate::locate_solid(problem, {.gap = 0.05, .run = {}});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(found->best.clearance, exact->best.clearance);
  EXPECT_EQ(found->status, locate::Status::optimal);
  expect_proof(problem, *found, random);
  SolidProblem shaken = problem;
  for (Vector& p : shaken.part.vertices) p = p + Vector{2e-5, -2e-5, 2e-5};
  for (Vector& p : shaken.blank.vertices) p.x += 1e-5;
  EXPECT_LE(found->best.clearance, static_cast<double>(brute::clearance(shaken.part, shaken.blank, {},
                                                                        motion_of(found->best.pose))));
}

}  // namespace
}  // namespace lekalo::locate_solid_proof_test
