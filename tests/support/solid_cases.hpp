#pragma once

// Pairs of a part and a blank that may hold it, as functions of a seed: what placements in space are tested
// and measured with. The blank is drawn about the origin, and the part is moved away from where it fits.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "lekalo/solid/motion.hpp"
#include "support/solids.hpp"

namespace lekalo::cases {

struct SolidCase {
  std::string kind;
  solid::Mesh part, blank;
  /// Where the generator had the part.
  solid::Motion there;
  /// No pose has more clearance than `there`, which has this one; 0 where that is not known.
  double optimum = 0;
};

/// A turn by `angle` about an axis of any length.
inline solid::Motion turn(solid::Vector axis, double angle) {
  const solid::Vector n = (1 / norm(axis)) * axis;
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {{{{c + n.x * n.x * d, n.x * n.y * d - n.z * s, n.x * n.z * d + n.y * s},
            {n.x * n.y * d + n.z * s, c + n.y * n.y * d, n.y * n.z * d - n.x * s},
            {n.x * n.z * d - n.y * s, n.y * n.z * d + n.x * s, c + n.z * n.z * d}}},
          {}};
}

inline solid::Vector direction(Random& random) {
  for (;;) {
    const solid::Vector v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (norm(v) > 0.1 && norm(v) <= 1) return (1 / norm(v)) * v;
  }
}

inline solid::Motion small_motion(Random& random, double angle, double shift) {
  solid::Motion motion = turn(direction(random), random.uniform(-angle, angle));
  motion.shift = {random.uniform(-shift, shift), random.uniform(-shift, shift),
                  random.uniform(-shift, shift)};
  return motion;
}

/// A pose that is off another by a small motion.
inline solid::Motion near(const solid::Motion& there, Random& random, double angle, double shift) {
  const solid::Motion off = small_motion(random, angle, shift);
  solid::Motion both;
  for (std::size_t k = 0; k < 3; ++k) {
    const solid::Vector row = off.rotation[k];
    both.rotation[k] = row.x * there.rotation[0] + (row.y * there.rotation[1] + row.z * there.rotation[2]);
  }
  both.shift = off(there.shift);
  return both;
}

/// A half-space n . p <= most, n a unit vector.
struct HalfSpace {
  solid::Vector n;
  double most = 0;
};

/// The body that half-spaces bound. \pre it is bounded, and no four of their planes meet in a point of it
inline solid::Mesh polytope(const std::vector<HalfSpace>& planes) {
  solid::Mesh mesh;
  std::vector<std::vector<std::uint32_t>> of(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const solid::Vector jk = cross(planes[j].n, planes[k].n), ki = cross(planes[k].n, planes[i].n),
                            ij = cross(planes[i].n, planes[j].n);
        const double determinant = dot(planes[i].n, jk);
        if (std::abs(determinant) < 1e-9) continue;
        const solid::Vector p =
            1 / determinant * (planes[i].most * jk + planes[j].most * ki + planes[k].most * ij);
        const bool holds = std::all_of(planes.begin(), planes.end(),
                                       [&](const HalfSpace& h) { return dot(h.n, p) <= h.most + 1e-9; });
        if (!holds) continue;
        for (const std::size_t at : {i, j, k})
          of[at].push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back(p);
      }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (of[i].size() < 3) continue;
    const solid::Vector first = mesh.vertices[of[i][0]];
    solid::Vector middle;
    for (const std::uint32_t v : of[i])
      middle = middle + 1 / static_cast<double>(of[i].size()) * mesh.vertices[v];
    const solid::Vector x = first - middle, y = cross(planes[i].n, x);
    std::sort(of[i].begin(), of[i].end(), [&](std::uint32_t a, std::uint32_t b) {
      const solid::Vector u = mesh.vertices[a] - middle, v = mesh.vertices[b] - middle;
      return std::atan2(dot(u, y), dot(u, x)) < std::atan2(dot(v, y), dot(v, x));
    });
    for (std::size_t k = 1; k + 1 < of[i].size(); ++k)
      mesh.triangles.push_back({of[i][0], of[i][k], of[i][k + 1]});
  }
  return mesh;
}

/// The same body where the motion does not have it yet.
inline solid::Mesh moved_back(solid::Mesh mesh, const solid::Motion& motion) {
  for (solid::Vector& p : mesh.vertices) p = motion.back(p);
  return mesh;
}

/// The faces of the blank are those of the part, all moved out by the same distance. No rigid motion leaves
/// more: with areas A, places b of the part's faces and h those of a moved part, sum A h >= sum A b = 3 V by
/// Minkowski's inequality for the mixed volume, so some h is at least b. If `uneven`, other faces are moved
/// out by more, and the optimum is not known.
inline SolidCase convex_in_convex(Random& random, std::size_t faces, double stock, bool uneven = false) {
  std::vector<HalfSpace> planes;
  for (const double side : {-1.0, 1.0})
    for (const solid::Vector n : {solid::Vector{side, 0.01, 0.02}, {-0.02, side, 0.01}, {0.01, -0.02, side}})
      planes.push_back({1 / norm(n) * n, random.uniform(60, 75)});
  while (planes.size() < faces) planes.push_back({direction(random), random.uniform(50, 70)});
  SolidCase made{uneven ? "uneven" : "convex", polytope(planes), {}, small_motion(random, 0.05, 3), stock};
  for (HalfSpace& h : planes) h.most += stock + (uneven ? random.uniform(0, 2) : 0);
  if (uneven) made.optimum = 0;
  made.blank = polytope(planes);
  made.part = moved_back(std::move(made.part), made.there);
  return made;
}

/// A round hole through a block, from the bottom to the top, as a polygon that touches the circle inside.
struct Hole {
  double x_bottom = 0, y_bottom = 0, x_top = 0, y_top = 0, radius = 0;
};

/// A block with one hole in its left half and one in its right half.
inline solid::Mesh block_with_holes(solid::Vector low, solid::Vector high, const std::array<Hole, 2>& holes,
                                    std::uint32_t per_side) {
  solid::Mesh mesh;
  const double middle = 0.5 * (low.x + high.x);
  const std::uint32_t around = 4 * per_side;
  for (std::size_t half = 0; half < 2; ++half) {
    const double from = half == 0 ? low.x : middle, to = half == 0 ? middle : high.x;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    // Four rings: the rim and the hole of the bottom, then of the top.
    for (const bool top : {false, true}) {
      const double z = top ? high.z : low.z;
      for (std::uint32_t k = 0; k < around; ++k) {
        const double t = static_cast<double>(k % per_side) / per_side;
        // Where the halves meet, both have the same points.
        const double along =
            std::lerp(low.y, high.y, static_cast<double>(per_side - k % per_side) / per_side);
        switch (k / per_side) {
          case 0:
            mesh.vertices.push_back({std::lerp(from, to, t), low.y, z});
            break;
          case 1:
            mesh.vertices.push_back({to, std::lerp(low.y, high.y, t), z});
            break;
          case 2:
            mesh.vertices.push_back({std::lerp(to, from, t), high.y, z});
            break;
          default:
            mesh.vertices.push_back({from, along, z});
            break;
        }
      }
      const Hole& hole = holes[half];
      for (std::uint32_t k = 0; k < around; ++k) {
        const double a = 2 * std::numbers::pi * (k + 0.5) / around - 0.75 * std::numbers::pi;
        mesh.vertices.push_back({(top ? hole.x_top : hole.x_bottom) + hole.radius * std::cos(a),
                                 (top ? hole.y_top : hole.y_bottom) + hole.radius * std::sin(a), z});
      }
    }
    const auto strip = [&](std::uint32_t ring, std::uint32_t other, bool open) {
      for (std::uint32_t k = 0; k < around; ++k) {
        // Where the halves meet there is no wall.
        if (open && k / per_side == (half == 0 ? 1U : 3U)) continue;
        const std::uint32_t next = (k + 1) % around, a = first + ring * around, b = first + other * around;
        mesh.triangles.push_back({a + k, a + next, b + k});
        mesh.triangles.push_back({a + next, b + next, b + k});
      }
    };
    strip(0, 2, true);
    strip(1, 0, false);
    strip(2, 3, false);
    strip(3, 1, false);
  }
  return closed_mesh(std::move(mesh)).value().mesh;
}

inline SolidCase cored_block(Random& random, std::uint32_t per_side = 6) {
  const auto stock = [&] { return random.uniform(1, 3); };
  const solid::Vector high{75, 45, 25};
  const double r = random.uniform(10, 14);
  std::array<Hole, 2> part{
      {{-35, random.uniform(-5, 5), -35 + random.uniform(-4, 4), random.uniform(-5, 5), r},
       {35, random.uniform(-5, 5), 35 + random.uniform(-4, 4), random.uniform(-5, 5), r}}};
  std::array<Hole, 2> blank = part;
  for (Hole& hole : blank) {
    hole.radius -= random.uniform(1.8, 3);
    for (double* at : {&hole.x_bottom, &hole.y_bottom, &hole.x_top, &hole.y_top})
      *at += random.uniform(-0.6, 0.6);
    // The cores are longer than the part, so their ends lie where their axes go on.
    const double x = 0.1 * (hole.x_top - hole.x_bottom), y = 0.1 * (hole.y_top - hole.y_bottom);
    hole.x_top += x, hole.x_bottom -= x, hole.y_top += y, hole.y_bottom -= y;
  }
  SolidCase made{
      "cored", block_with_holes(-high, high, part, per_side), {}, small_motion(random, 0.04, 2), 0};
  made.blank = block_with_holes({-75 - stock(), -45 - stock(), -25 - stock()},
                                {75 + stock(), 45 + stock(), 25 + stock()}, blank, per_side);
  made.part = moved_back(std::move(made.part), made.there);
  return made;
}

/// A body turned about the z axis: radius and height along its outline, which begins and ends on the axis.
inline solid::Mesh turned(const std::vector<std::array<double, 2>>& outline, std::uint32_t around,
                          double phase) {
  solid::Mesh mesh;
  mesh.vertices.push_back({0, 0, outline.front()[1]});
  mesh.vertices.push_back({0, 0, outline.back()[1]});
  const auto rings = static_cast<std::uint32_t>(outline.size() - 2);
  for (std::uint32_t i = 1; i <= rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = 2 * std::numbers::pi * k / around + phase;
      mesh.vertices.push_back({outline[i][0] * std::cos(a), outline[i][0] * std::sin(a), outline[i][1]});
    }
  for (std::uint32_t k = 0; k < around; ++k) {
    const std::uint32_t next = (k + 1) % around;
    mesh.triangles.push_back({0, 2 + next, 2 + k});
    mesh.triangles.push_back({1, 2 + (rings - 1) * around + k, 2 + (rings - 1) * around + next});
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      const std::uint32_t a = 2 + i * around, b = a + around;
      mesh.triangles.push_back({a + k, a + next, b + k});
      mesh.triangles.push_back({a + next, b + next, b + k});
    }
  }
  return mesh;
}

inline SolidCase turned_part(Random& random, std::uint32_t around = 24) {
  const auto stock = [&] { return random.uniform(1, 2.5); };
  const double flange = random.uniform(30, 40), shaft = random.uniform(14, 20), step = random.uniform(-5, 15);
  const double a = stock(), b = stock();
  SolidCase made{"turned",
                 turned({{0, -50},
                         {flange, -50},
                         {flange, -50 + 0.5 * flange},
                         {shaft, -50 + 0.5 * flange},
                         {shaft, step},
                         {0.8 * shaft, step},
                         {0.8 * shaft, 60},
                         {0, 60}},
                        around, 0),
                 turned({{0, -50 - stock()},
                         {flange + a, -50 - stock() - 1},
                         {flange + a, -50 + 0.5 * flange + stock()},
                         {shaft + b, -50 + 0.5 * flange + stock() + 1},
                         {shaft + b, step + stock()},
                         {0.8 * shaft + stock(), step + stock() + 1},
                         {0.8 * shaft + stock(), 60 + stock()},
                         {0, 60 + stock()}},
                        around, random.uniform(0, 0.2)),
                 small_motion(random, 0.04, 2), 0};
  made.part = moved_back(std::move(made.part), made.there);
  return made;
}

/// A ball with waves on it, `rows` by 2 `rows` quads; `grow` is the stock on it.
template <class Grow>
solid::Mesh wavy_ball(std::uint32_t rows, double phase, const Grow& grow) {
  const auto place = [&](double polar, double about) {
    const double r = 50 + 4 * std::sin(3 * polar + phase) * std::sin(2 * about) * std::sin(polar) +
                     3 * std::cos(5 * about + phase) * std::sin(polar) + grow(polar, about);
    return solid::Vector{r * std::sin(polar) * std::cos(about), 0.7 * r * std::sin(polar) * std::sin(about),
                         1.2 * r * std::cos(polar)};
  };
  std::vector<solid::Vector> rings;
  const std::uint32_t across = 2 * rows;
  solid::Mesh mesh;
  mesh.vertices = {place(0, 0), place(std::numbers::pi, 0)};
  for (std::uint32_t i = 1; i <= rows; ++i)
    for (std::uint32_t k = 0; k < across; ++k)
      mesh.vertices.push_back(place(std::numbers::pi * i / (rows + 1), 2 * std::numbers::pi * k / across));
  for (std::uint32_t k = 0; k < across; ++k) {
    const std::uint32_t next = (k + 1) % across;
    mesh.triangles.push_back({0, 2 + k, 2 + next});
    mesh.triangles.push_back({1, 2 + (rows - 1) * across + next, 2 + (rows - 1) * across + k});
    for (std::uint32_t i = 0; i + 1 < rows; ++i) {
      const std::uint32_t a = 2 + i * across, b = a + across;
      mesh.triangles.push_back({a + k, b + k, a + next});
      mesh.triangles.push_back({a + next, b + k, b + next});
    }
  }
  return mesh;
}

inline SolidCase wavy_part(Random& random, std::uint32_t rows = 24) {
  const double phase = random.uniform(0, 6), waves = random.uniform(0.3, 0.8), turn = random.uniform(0, 6);
  SolidCase made{"wavy", wavy_ball(rows, phase, [](double, double) { return 0.0; }),
                 wavy_ball(rows + 3, phase,
                           [&](double polar, double about) {
                             return 2 +
                                    waves * std::sin(2 * about + turn) * std::sin(polar) * std::sin(polar) +
                                    waves * std::cos(3 * polar + turn) * std::sin(polar);
                           }),
                 small_motion(random, 0.04, 2), 0};
  made.part = moved_back(std::move(made.part), made.there);
  return made;
}

/// A place of a triangle.
inline solid::Vector of_triangle(const solid::Mesh& mesh, std::size_t k, Random& random) {
  const auto& t = mesh.triangles[k];
  const solid::Vector a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
  double u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return a + u * (b - a) + v * (c - a);
}

}  // namespace lekalo::cases
