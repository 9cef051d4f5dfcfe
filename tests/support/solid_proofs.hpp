#pragma once

// Random parts in blanks with a certificate that is made by argument: of two convex bodies whose faces are
// the same distance apart, the sum of the areas times the distances from the blank's faces is the same for
// all shifts, and turns change it little.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/solid_cases.hpp"
#include "support/solid_results.hpp"

namespace lekalo::cases {

/// What terms of a certificate are made of; any of those before.
enum class TermKind : std::uint8_t { plane, ball, face, part_face, any, edges };

struct SolidProof {
  SolidResultFiles files;
  double bound = 0;
};

namespace solid_proof_detail {

inline Json row(solid::Vector p) { return Json{p.x, p.y, p.z}; }
inline Json row(solid::Vector p, double more) { return Json{p.x, p.y, p.z, more}; }

inline solid::Mesh in_single_precision(solid::Mesh mesh) {
  for (solid::Vector& p : mesh.vertices)
    p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  return mesh;
}

/// The largest triangle of each face, its middle and the face's area.
struct Face {
  std::uint32_t triangle = 0;
  solid::Vector middle;
  double area = 0;
};
inline Face face_of(const solid::Mesh& mesh, solid::Vector n) {
  Face face;
  double largest = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const solid::Vector p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
    const solid::Vector twice = cross(q - p, r - p);
    if (!(dot(twice, n) > 0.999999 * norm(twice))) continue;
    face.area += norm(twice) / 2;
    if (norm(twice) <= largest) continue;
    largest = norm(twice), face.triangle = t, face.middle = 1.0 / 3 * (p + q + r);
  }
  return face;
}

/// How far within a triangle's edges a place of its plane lies, negative beside it.
inline double within(const solid::Mesh& mesh, std::uint32_t triangle, solid::Vector place) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const std::array<solid::Vector, 3> at{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
  const solid::Vector normal = cross(at[1] - at[0], at[2] - at[0]);
  double least = 1e9;
  for (std::size_t k = 0; k < 3; ++k) {
    const solid::Vector inwards = cross(normal, at[(k + 1) % 3] - at[k]);
    least = std::min(least, dot(inwards, place - at[k]) / norm(inwards));
  }
  return least;
}

/// Splits along the axes in turn, halves each, and puts the leaf below all.
inline void divide(Json& nodes, const Json& leaf, std::array<std::array<double, 2>, 6> box,
                   const std::vector<std::size_t>& axes, std::size_t depth) {
  constexpr std::array kAxes{"x", "y", "z", "turn_x", "turn_y", "turn_z"};
  if (depth == 0) return nodes.push_back(leaf);
  const std::size_t axis = axes[depth % axes.size()];
  const double at = (box[axis][0] + box[axis][1]) / 2;
  nodes.push_back(Json::array({kAxes[axis], at}));
  auto half = box;
  half[axis][1] = at;
  divide(nodes, leaf, half, axes, depth - 1);
  half = box, half[axis][0] = at;
  divide(nodes, leaf, half, axes, depth - 1);
}

}  // namespace solid_proof_detail

/// The quaternion as a motion.
inline solid::Motion turn_of(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  const double all = w * w + x * x + y * y + z * z;
  solid::Motion made;
  made.rotation = {
      {{(w * w + x * x - y * y - z * z) / all, 2 * (x * y - w * z) / all, 2 * (x * z + w * y) / all},
       {2 * (x * y + w * z) / all, (w * w - x * x + y * y - z * z) / all, 2 * (y * z - w * x) / all},
       {2 * (x * z - w * y) / all, 2 * (y * z + w * x) / all, (w * w - x * x - y * y + z * z) / all}}};
  return made;
}

/// A result for a part that was moved back by `there`, the rotation of `start` and a shift, with this leaf
/// all over a window of shifts of 0.5 mm and turns of a tenth of a degree, which is divided `depth` times.
struct Proved {
  solid::Mesh part, blank;
  std::array<double, 4> start;
  solid::Motion there;
  Json part_balls = Json::array(), blank_balls = Json::array(), planes = Json::array(), leaf = Json::array();
  double stock = 0;  ///< the clearance at `there`
};
inline SolidProof windowed(const Proved& what, const std::string& freedom, std::size_t depth, double spare) {
  using namespace solid_proof_detail;
  const auto& [part, blank, start, there, part_balls, blank_balls, half_spaces, leaf, stock] = what;
  const double shift = 0.5, degrees = freedom == "xyz" ? 0 : 0.1,
               most = std::tan(degrees * std::numbers::pi / 360) * (1 + 1e-14);
  const solid::Vector pivot = there.back({1, -2, 3});
  const solid::Vector place = there(pivot);
  std::array<std::array<double, 2>, 6> box{};
  const double places[]{place.x, place.y, place.z};
  std::vector<std::size_t> axes{0, 1, 2};
  for (std::size_t k = 0; k < 3; ++k) box[k] = {places[k] - shift - 1e-9, places[k] + shift + 1e-9};
  for (std::size_t k = 3; k < 6; ++k)
    if (freedom == "six" || (freedom == "c-xyz" && k == 5)) box[k] = {-most, most}, axes.push_back(k);
  Json nodes = Json::array();
  divide(nodes, leaf, box, axes, depth);
  const auto range = [&](std::size_t k) { return Json{box[k][0], box[k][1]}; };
  const Json quaternion{start[0], start[1], start[2], start[3]};
  Json certificate{{"pivot", row(pivot)},
                   {"part_balls", part_balls},
                   {"blank_balls", blank_balls},
                   {"planes", half_spaces},
                   {"trees", Json::array({Json{{"quaternion", quaternion},
                                               {"x", range(0)},
                                               {"y", range(1)},
                                               {"z", range(2)},
                                               {"turn_x", range(3)},
                                               {"turn_y", range(4)},
                                               {"turn_z", range(5)},
                                               {"nodes", nodes}}})}};
  SolidProof made{cube_in_cube(certificate, stock + spare, freedom, shift, degrees), stock + spare};
  Json& result = made.files.result;
  made.files.part = solid_files::stl_binary(part);
  made.files.blank = solid_files::stl_binary(blank);
  result["inputs"][0]["triangles"] = part.triangles.size();
  result["inputs"][1]["triangles"] = blank.triangles.size();
  for (Json* pose : {&result, &result["window"]}) {
    (*pose)["quaternion"] = quaternion;
    (*pose)["x"] = there.shift.x, (*pose)["y"] = there.shift.y, (*pose)["z"] = there.shift.z;
  }
  result["window"]["pivot"] = row(pivot);
  result["clearance"] = stock - 1e-3;
  result["gap"] = made.bound - (stock - 1e-3);
  result["contacts"] = Json::array();
  return made;
}

/// A result whose bound is `spare` above the distance of the faces. The window has shifts of 0.5 mm and turns
/// of a tenth of a degree.
inline SolidProof solid_proof(Random& random, TermKind kinds, const std::string& freedom, std::size_t depth,
                              double spare = 0.5) {
  using namespace solid_proof_detail;
  std::vector<HalfSpace> planes;
  for (const double side : {-1.0, 1.0})
    for (const solid::Vector n : {solid::Vector{side, 0.01, 0.02}, {-0.02, side, 0.01}, {0.01, -0.02, side}})
      planes.push_back({1 / norm(n) * n, random.uniform(60, 75)});
  while (planes.size() < 8) planes.push_back({direction(random), random.uniform(62, 70)});
  const double stock = random.uniform(0.5, 3);
  const std::array<double, 4> start{1, random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  solid::Motion there = turn_of(start);
  there.shift = {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50)};
  Proved made;
  made.start = start, made.there = there, made.stock = stock;
  const solid::Mesh at_place = polytope(planes);
  made.part = in_single_precision(moved_back(at_place, there));
  std::vector<HalfSpace> outer = planes;
  for (HalfSpace& h : outer) h.most += stock;
  const solid::Mesh& blank = made.blank = in_single_precision(polytope(outer));

  Json &part_balls = made.part_balls, &blank_balls = made.blank_balls, &half_spaces = made.planes,
       &leaf = made.leaf;
  for (const HalfSpace& h : planes) {
    const Face inner = face_of(at_place, h.n), wall = face_of(blank, h.n);
    if (inner.area < 1) continue;
    TermKind kind = kinds == TermKind::any ? static_cast<TermKind>(random.below(4)) : kinds;
    // No foot leaves a triangle that it lies so far within, and no ball of the part comes through a wall so
    // far away. A foot of a wall has to lie in the part's face, too.
    constexpr double kMoves = 1.2;
    solid::Vector foot = kind == TermKind::face ? wall.middle - stock * h.n : inner.middle;
    const bool in_part = std::ranges::all_of(
        planes, [&](const HalfSpace& p) { return &p == &h || dot(p.n, foot) < p.most - 0.1; });
    if ((kind == TermKind::face &&
         !(stock > kMoves && in_part && within(blank, wall.triangle, wall.middle) > kMoves)) ||
        (kind == TermKind::part_face && !(within(at_place, inner.triangle, inner.middle) > kMoves)))
      kind = TermKind::plane, foot = inner.middle;
    // A little inside of the part, and beside the blank.
    const double off = 1e-3, far = kind == TermKind::ball ? 500 : 3;
    const auto share = inner.area / 1000;
    if (kind != TermKind::part_face)
      part_balls.push_back(row(there.back(foot - off * h.n), random.below(2) == 0 ? 0 : 0.5 * off));
    if (kind == TermKind::ball || kind == TermKind::part_face)
      blank_balls.push_back(row(inner.middle + (stock + far + off) * h.n, far));
    const auto of_part = static_cast<int>(part_balls.size()) - 1,
               of_blank = static_cast<int>(blank_balls.size()) - 1;
    switch (kind) {
      case TermKind::ball:
        leaf.push_back({"ball", of_part, of_blank, share});
        break;
      case TermKind::face:
        leaf.push_back({"face", of_part, wall.triangle, share});
        break;
      case TermKind::part_face:
        leaf.push_back({"part_face", inner.triangle, of_blank, share});
        break;
      default:
        half_spaces.push_back(row(-2 * h.n, -2 * (h.most + stock + 1e-4)));
        leaf.push_back({"plane", of_part, static_cast<int>(half_spaces.size()) - 1, share});
    }
  }
  return windowed(made, freedom, depth, spare);
}

/// A result for a block in a larger one with two cores, one `stock` below the block and one above it: an edge
/// of each passes one of the block.
inline SolidProof edges_proof(Random& random, const std::string& freedom, std::size_t depth,
                              double spare = 0.05) {
  using namespace solid_proof_detail;
  Proved made;
  // Edges that could pass through each other in the window would prove nothing.
  made.stock = random.uniform(1, 2);
  made.start = {1, random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  made.there = turn_of(made.start);
  made.there.shift = {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50)};
  // All of it lies askew in the blank's frame.
  solid::Motion askew = turn(direction(random), random.uniform(0, 3));
  askew.shift = {1, -2, 3};
  const auto placed = [&](solid::Vector low, solid::Vector high) {
    solid::Mesh mesh = block(low, high);
    for (solid::Vector& p : mesh.vertices) p = askew(p);
    return mesh;
  };
  const double over = 5 + made.stock;
  made.part = in_single_precision(moved_back(placed({-5, -5, -5}, {5, 5, 5}), made.there));
  made.blank = placed({-20, -20, -20}, {20, 20, 20});
  append(made.blank, placed({-9, -8, -over - 1}, {random.uniform(-3, 3), 8, -over}));
  append(made.blank, placed({-9, -8, over}, {random.uniform(-3, 3), 8, over + 1}));
  made.blank = in_single_precision(made.blank);
  made.leaf = Json::array({{"edges", 2, 45, 1}, {"edges", 6, 77, 1}});
  return windowed(made, freedom, depth, spare);
}

}  // namespace lekalo::cases
