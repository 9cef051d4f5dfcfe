#pragma once

// Castings of real size and the parts that are cut from them, as functions of a seed and a number: the
// figures of placements in docs/measurements/solid.md are theirs. A blank has stock of its own on every side,
// thin or thick, which waves smoothly, cores that lie a little off those of the part, and other triangles.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lekalo/solid/triangle_tree.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::cases {

/// Cuts edges in half until none of a triangle that is to be `fine`, as all are without flags, is longer than
/// `most`; the surface stays as it is.
inline solid::Mesh refined(solid::Mesh mesh, double most, std::vector<bool> fine = {}) {
  if (fine.empty()) fine.assign(mesh.triangles.size(), true);
  constexpr std::uint32_t kWhole = 0xffffffff;
  for (;;) {
    // The middle of each edge that is cut, by its ends.
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto key = [](std::uint32_t a, std::uint32_t b) {
      return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3 && fine[t]; ++k) {
        const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        if (norm(mesh.vertices[b] - mesh.vertices[a]) <= most) continue;
        if (!middles.try_emplace(key(a, b), static_cast<std::uint32_t>(mesh.vertices.size())).second)
          continue;
        mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      }
    if (middles.empty()) return mesh;
    std::vector<solid::Triangle> triangles;
    std::vector<bool> flags;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const solid::Triangle v = mesh.triangles[t];
      solid::Triangle cut{};
      std::size_t cuts = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto middle = middles.find(key(v[k], v[(k + 1) % 3]));
        cut[k] = middle == middles.end() ? kWhole : middle->second;
        if (cut[k] != kWhole) ++cuts;
      }
      const std::size_t before = triangles.size();
      if (cuts == 3) {
        triangles.insert(triangles.end(), {{v[0], cut[0], cut[2]},
                                           {v[1], cut[1], cut[0]},
                                           {v[2], cut[2], cut[1]},
                                           {cut[0], cut[1], cut[2]}});
      } else {
        // Turned so that the first edge is cut and the last one is not.
        std::size_t k = 0;
        while (cuts > 0 && (cut[k] == kWhole || cut[(k + 2) % 3] != kWhole)) ++k;
        const std::uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], ab = cut[k],
                            bc = cut[(k + 1) % 3];
        if (cuts == 0) triangles.push_back(v);
        if (cuts == 1) triangles.insert(triangles.end(), {{a, ab, c}, {ab, b, c}});
        if (cuts == 2) {
          triangles.push_back({ab, b, bc});
          const auto& p = mesh.vertices;
          if (norm(p[ab] - p[c]) < norm(p[a] - p[bc]))
            triangles.insert(triangles.end(), {{a, ab, c}, {ab, bc, c}});
          else
            triangles.insert(triangles.end(), {{a, ab, bc}, {a, bc, c}});
        }
      }
      flags.insert(flags.end(), triangles.size() - before, fine[t]);
    }
    mesh.triangles = std::move(triangles);
    fine = std::move(flags);
  }
}

inline double area_of(const solid::Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return area;
}

/// With about so many triangles more.
inline solid::Mesh refined_by(solid::Mesh mesh, double triangles) {
  const double most = 2.2 * std::sqrt(area_of(mesh) / triangles);
  return refined(std::move(mesh), most);
}

/// Moves every point by up to `most`, in waves of 60 mm and more.
inline solid::Mesh warped(solid::Mesh mesh, double most, Random& random) {
  struct Wave {
    solid::Vector way, along;
    double phase = 0;
  };
  std::array<Wave, 3> waves;
  for (Wave& wave : waves) {
    wave.way = most / 3 * direction(random);
    wave.along = 2 * std::numbers::pi * direction(random);
    wave.along = 1 / random.uniform(60, 200) * wave.along;
    wave.phase = random.uniform(0, 6);
  }
  for (solid::Vector& p : mesh.vertices) {
    const solid::Vector at = p;
    for (const Wave& wave : waves) p = p + std::sin(dot(wave.along, at) + wave.phase) * wave.way;
  }
  return mesh;
}

/// The stock of a casting: of every second kind it is thin.
struct Stock {
  double least = 0;
  explicit Stock(Random& random)
      : least(random.below(2) == 0 ? random.uniform(0.4, 0.9) : random.uniform(1, 3)) {}
  [[nodiscard]] double some(Random& random) const { return least * random.uniform(1, 1.6); }
  /// A core lies off its place by up to this along each axis.
  [[nodiscard]] double shifted(Random& random) const { return random.uniform(-0.25, 0.25) * least; }
  [[nodiscard]] double wave() const { return 0.15 * least; }
};

/// The part is moved off the place where it fits, by less than the window of 5 degrees and 5 mm.
inline solid::Motion casting_motion(Random& random) {
  const solid::Vector axis = direction(random);
  solid::Motion there = turn(axis, random.uniform(-0.06, 0.06));
  there.shift = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
  return there;
}

inline SolidCase finished(const char* kind, solid::Mesh part, solid::Mesh blank, const Stock& stock,
                          Random& random) {
  SolidCase made{kind, {}, warped(std::move(blank), stock.wave(), random), casting_motion(random), 0};
  made.part = closed_mesh(moved_back(std::move(part), made.there)).value().mesh;
  made.blank = closed_mesh(std::move(made.blank)).value().mesh;
  return made;
}

/// A block with two tilted cores.
inline SolidCase casting_with_cores(Random& random) {
  const Stock stock(random);
  const solid::Vector high{random.uniform(55, 90), random.uniform(35, 55), random.uniform(20, 40)};
  std::array<Hole, 2> part;
  for (Hole& hole : part) {
    const double x = (&hole == part.data() ? -0.47 : 0.47) * high.x;
    hole = {x, random.uniform(-5, 5), x + random.uniform(-4, 4), random.uniform(-5, 5),
            random.uniform(8, 14)};
  }
  std::array<Hole, 2> blank = part;
  for (Hole& hole : blank) {
    hole.radius -= stock.some(random);
    for (double* at : {&hole.x_bottom, &hole.y_bottom, &hole.x_top, &hole.y_top})
      *at += stock.shifted(random);
  }
  const auto grown = [&] {
    return high + solid::Vector{stock.some(random), stock.some(random), stock.some(random)};
  };
  const solid::Vector low = -grown(), top = grown();
  // The cores of the blank are longer, and keep their axes.
  for (Hole& hole : blank) {
    const double below = (high.z + low.z) / (2 * high.z), above = (top.z - high.z) / (2 * high.z);
    const double x = hole.x_top - hole.x_bottom, y = hole.y_top - hole.y_bottom;
    hole.x_bottom += below * x, hole.y_bottom += below * y;
    hole.x_top += above * x, hole.y_top += above * y;
  }
  const double size = random.uniform(2'000, 18'000);
  const auto sides = 8 + static_cast<std::uint32_t>(random.below(17));
  return finished("two cores", refined_by(block_with_holes(-high, high, part, sides), size),
                  refined_by(block_with_holes(low, top, blank, sides + 3), 0.7 * size), stock, random);
}

/// A closed outline of radius and height that does not meet the axis, turned about the z axis.
inline solid::Mesh turned_ring(const std::vector<std::array<double, 2>>& outline, std::uint32_t around,
                               double phase) {
  solid::Mesh mesh;
  const auto rings = static_cast<std::uint32_t>(outline.size());
  for (const auto& [r, z] : outline)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = 2 * std::numbers::pi * k / around + phase;
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around, a = i * around, b = (i + 1) % rings * around;
      mesh.triangles.push_back({a + k, a + next, b + k});
      mesh.triangles.push_back({a + next, b + next, b + k});
    }
  return mesh;
}

/// A shaft with a flange, maybe with a bore.
struct FlangedShaft {
  double flange = 0, shaft = 0, end = 0, bore = 0;     ///< radii
  double bottom = 0, shoulder = 0, step = 0, top = 0;  ///< heights

  /// \param along  how many rings of triangles there are, about
  [[nodiscard]] solid::Mesh mesh(std::uint32_t along, std::uint32_t around, double phase) const {
    const std::vector<std::array<double, 2>> corners{{bore, bottom},    {flange, bottom}, {flange, shoulder},
                                                     {shaft, shoulder}, {shaft, step},    {end, step},
                                                     {end, top},        {bore, top}};
    const double length = 2 * (top - bottom) + 2 * (flange - bore);
    std::vector<std::array<double, 2>> outline;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [r, z] = corners[k];
      const auto [to_r, to_z] = corners[(k + 1) % corners.size()];
      outline.push_back(corners[k]);
      if (bore == 0 && k + 1 == corners.size()) break;
      const int pieces = 1 + static_cast<int>(std::hypot(to_r - r, to_z - z) / length * along);
      for (int i = 1; i < pieces; ++i) {
        const double share = static_cast<double>(i) / pieces;
        outline.push_back({std::lerp(r, to_r, share), std::lerp(z, to_z, share)});
      }
    }
    return bore > 0 ? turned_ring(outline, around, phase) : turned(outline, around, phase);
  }
};

inline SolidCase turned_casting(Random& random) {
  const Stock stock(random);
  const bool bored = random.below(2) == 0;
  FlangedShaft part{random.uniform(30, 60), random.uniform(14, 24)};
  part.end = 0.8 * part.shaft, part.bore = bored ? 0.45 * part.shaft : 0;
  part.bottom = -50, part.shoulder = random.uniform(-38, -25), part.step = random.uniform(-5, 15),
  part.top = 60;
  FlangedShaft blank = part;
  for (double* at : {&blank.flange, &blank.shaft, &blank.end, &blank.shoulder, &blank.step, &blank.top})
    *at += stock.some(random);
  blank.bottom -= stock.some(random);
  if (bored) blank.bore -= std::min(stock.some(random), 0.6 * part.bore);
  const auto along = 40 + static_cast<std::uint32_t>(random.below(120)),
             around = 60 + static_cast<std::uint32_t>(random.below(181));
  solid::Mesh outside = blank.mesh(along - 9, around - 13, random.uniform(0, 0.2));
  const solid::Vector off{stock.shifted(random), stock.shifted(random), 0};
  for (solid::Vector& p : outside.vertices)
    if (bored && std::hypot(p.x, p.y) < 0.5 * (part.bore + part.end)) p = p + off;
  return finished(bored ? "turned with a bore" : "turned", part.mesh(along, around, 0), std::move(outside),
                  stock, random);
}

/// A twisted blade without a root: sections of an arched chord, one above the other.
struct Blade {
  double chord = 0, thickness = 0, arch = 0, twist = 0, taper = 0, length = 0;

  /// \param grown  how far the surface lies outside, about
  [[nodiscard]] solid::Mesh mesh(double grown, std::uint32_t sections, std::uint32_t half) const {
    solid::Mesh made;
    const std::uint32_t around = 2 * half;
    for (std::uint32_t i = 0; i <= sections; ++i) {
      const double z = (length / 2 + grown) * (2.0 * i / sections - 1), up = z / length,
                   size = 1 - taper * up, turn = twist * up;
      for (std::uint32_t k = 0; k < around; ++k) {
        const bool upper = k <= half;
        const double along = 0.5 * (1 - std::cos(std::numbers::pi * (upper ? k : around - k) / half));
        const double thick = std::sqrt(4 * along * (1 - along)) * (1 - 0.3 * along);
        const double x = (along - 0.5) * (size * chord + 2 * grown),
                     y = size * arch * (1 - 4 * (along - 0.5) * (along - 0.5)) +
                         (upper ? 0.5 : -0.5) * thick * (size * thickness + 2.6 * grown);
        made.vertices.push_back(
            {x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), z});
      }
    }
    const std::uint32_t last = sections * around;
    for (std::uint32_t i = 0; i < sections; ++i)
      for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t a = i * around, b = a + around, next = (k + 1) % around;
        made.triangles.push_back({a + k, b + k, a + next});
        made.triangles.push_back({a + next, b + k, b + next});
      }
    for (std::uint32_t k = 0; k < half; ++k) {
      const std::uint32_t over = k, next = k + 1, under = (around - k) % around, beside = around - k - 1;
      if (k > 0) {
        made.triangles.push_back({over, next, under});
        made.triangles.push_back({last + over, last + under, last + next});
      }
      if (k + 1 < half) {
        made.triangles.push_back({next, beside, under});
        made.triangles.push_back({last + next, last + under, last + beside});
      }
    }
    return made;
  }
};

inline SolidCase blade_casting(Random& random) {
  const Stock stock(random);
  const Blade blade{random.uniform(60, 110),   random.uniform(7, 13),  random.uniform(3, 9),
                    random.uniform(-0.6, 0.6), random.uniform(0, 0.5), random.uniform(90, 180)};
  const auto sections = 40 + static_cast<std::uint32_t>(random.below(100)),
             half = 30 + static_cast<std::uint32_t>(random.below(60));
  return finished("blade", blade.mesh(0, sections, half), blade.mesh(stock.least, sections - 7, half - 5),
                  stock, random);
}

/// A bent pipe whose inner and outer walls swell and shrink as they like.
struct Elbow {
  double bend = 0, angle = 0, outer = 0, inner = 0, oval = 0, phase = 0, swell = 0;

  /// \param grown  how far the outer wall and the ends lie outside
  /// \param filled  how far the inner wall lies within the part's
  /// \param off  the inner wall's shift
  [[nodiscard]] solid::Mesh mesh(double grown, double filled, solid::Vector off, std::uint32_t along,
                                 std::uint32_t around) const {
    solid::Mesh made;
    for (const bool inside : {false, true})
      for (std::uint32_t i = 0; i <= along; ++i) {
        const double u = (2.0 * i / along - 1) * (angle / 2 + grown / (bend - outer));
        for (std::uint32_t k = 0; k < around; ++k) {
          const double v = 2 * std::numbers::pi * k / around,
                       shape = 1 + oval * std::sin(2 * v + phase + u) + swell * std::cos(3 * u + phase);
          const double r = inside ? inner * (1 + 0.7 * oval * std::cos(2 * v + u)) - filled
                                  : outer * shape + grown,
                       out = bend + r * std::cos(v);
          const solid::Vector p{out * std::cos(u) - bend, out * std::sin(u), r * std::sin(v)};
          made.vertices.push_back(inside ? p + off : p);
        }
      }
    const std::uint32_t wall = (along + 1) * around;
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around;
      for (std::uint32_t i = 0; i < along; ++i) {
        const std::uint32_t a = i * around, b = a + around;
        made.triangles.push_back({a + k, b + k, a + next});
        made.triangles.push_back({a + next, b + k, b + next});
        made.triangles.push_back({wall + a + k, wall + a + next, wall + b + k});
        made.triangles.push_back({wall + a + next, wall + b + next, wall + b + k});
      }
      const std::uint32_t end = along * around;
      made.triangles.push_back({k, next, wall + k});
      made.triangles.push_back({next, wall + next, wall + k});
      made.triangles.push_back({end + k, end + wall + k, end + next});
      made.triangles.push_back({end + next, end + wall + k, end + wall + next});
    }
    return made;
  }
};

inline SolidCase housing_casting(Random& random) {
  const Stock stock(random);
  Elbow elbow{random.uniform(80, 120),    random.uniform(0.8, 1.5), random.uniform(25, 40), 0,
              random.uniform(0.02, 0.08), random.uniform(0, 6),     random.uniform(0, 0.08)};
  elbow.inner = elbow.outer * random.uniform(0.55, 0.65);
  const auto along = 40 + static_cast<std::uint32_t>(random.below(80)),
             around = 50 + static_cast<std::uint32_t>(random.below(90));
  const solid::Vector off{stock.shifted(random), stock.shifted(random), stock.shifted(random)};
  const double grown = stock.some(random), filled = stock.some(random);
  return finished("housing", elbow.mesh(0, 0, {}, along, around),
                  elbow.mesh(grown, filled, off, along - 7, around - 5), stock, random);
}

/// A wavy ball around a void that was a core.
inline SolidCase hollow_casting(Random& random) {
  const Stock stock(random);
  const double phase = random.uniform(0, 6), core = random.uniform(0.3, 0.5);
  const auto rows = 35 + static_cast<std::uint32_t>(random.below(70));
  const auto body = [&](std::uint32_t count, double grown, double filled, solid::Vector off) {
    solid::Mesh mesh = wavy_ball(count, phase, [&](double, double) { return 1.5 * grown; });
    solid::Mesh hollow =
        wavy_ball(count / 2, phase + 1, [&](double, double) { return -1.5 * filled / core; });
    for (solid::Vector& p : hollow.vertices) p = core * p + off;
    for (auto& [a, b, c] : hollow.triangles) std::swap(b, c);
    append(mesh, hollow);
    return mesh;
  };
  const solid::Vector off{stock.shifted(random), stock.shifted(random), stock.shifted(random)};
  const double grown = stock.some(random), filled = stock.some(random);
  return finished("ball with a core", body(rows, 0, 0, {}), body(rows - 4, grown, filled, off), stock,
                  random);
}

/// A convex body of many faces, with more stock on some than on others.
inline SolidCase forged_casting(Random& random) {
  const Stock stock(random);
  std::vector<HalfSpace> planes;
  for (const double side : {-1.0, 1.0})
    for (const solid::Vector n : {solid::Vector{side, 0.01, 0.02}, {-0.02, side, 0.01}, {0.01, -0.02, side}})
      planes.push_back({1 / norm(n) * n, random.uniform(45, 75)});
  const std::size_t faces = 20 + random.below(30);
  while (planes.size() < faces) planes.push_back({direction(random), random.uniform(50, 70)});
  const double size = random.uniform(3'000, 30'000);
  solid::Mesh part = refined_by(polytope(planes), size);
  for (HalfSpace& h : planes) h.most += stock.some(random);
  return finished("forging", std::move(part), refined_by(polytope(planes), 0.7 * size), stock, random);
}

struct CastingKind {
  std::uint64_t count;
  SolidCase (*draw)(Random&);
};
/// The hundred castings of a seed. Any of them can be drawn alone.
inline constexpr std::array<CastingKind, 6> kCastingKinds{{{34, casting_with_cores},
                                                           {24, turned_casting},
                                                           {12, blade_casting},
                                                           {14, housing_casting},
                                                           {8, hollow_casting},
                                                           {8, forged_casting}}};
inline constexpr std::uint64_t kCastings = 100;
/// The seed of the figures.
inline constexpr std::uint64_t kCastingSeed = 2711;

/// The kinds take turns, so that the first few castings are of all of them.
inline SolidCase casting(std::uint64_t number, std::uint64_t seed = kCastingSeed) {
  Random random(seed, 1 + number);
  std::uint64_t place = number % kCastings * 37 % kCastings;
  for (const CastingKind& kind : kCastingKinds) {
    if (place < kind.count) return kind.draw(random);
    place -= kind.count;
  }
  return {};
}

/// The mesh that a scanner makes of a casting.
struct CastingScan {
  solid::Mesh mesh;
  double guard = 0;  ///< no vertex is farther off the surface outwards, mm
  double loss = 0;   ///< no place of the mesh is farther inside it, mm
  double seen = 0;   ///< the share of the surface that some direction sees
};

/// Looks from six directions. Where a ray to one of them passes by everything else, points lie as dense as
/// `points` of them would on the whole surface; elsewhere there are the few corners of the triangles, as if
/// somebody had touched them. The points are off by up to `noise`, and one of two thousand is as far inside
/// again three times. Between true points the surface is flat, so that no dip has to be stated.
inline CastingScan scan_of(const solid::Mesh& blank, std::uint64_t points, double noise, Random& random) {
  std::vector<bool> seen(blank.triangles.size(), false);
  std::vector<solid::Vector> normals;
  double area_seen = 0;
  for (const auto& [a, b, c] : blank.triangles)
    normals.push_back(0.5 *
                      cross(blank.vertices[b] - blank.vertices[a], blank.vertices[c] - blank.vertices[a]));
  for (int view = 0; view < 6; ++view) {
    const solid::Vector up = direction(random), beside = cross(up, {up.y, up.z, up.x}),
                        x = 1 / norm(beside) * beside;
    const solid::Motion upright{{{x, cross(up, x), up}}, {}};
    solid::Mesh turned_up = blank;
    for (solid::Vector& p : turned_up.vertices) p = upright(p);
    const solid::TriangleTree tree(turned_up);
    std::vector<std::uint32_t> crossed;
    for (std::size_t t = 0; t < seen.size(); ++t) {
      const double size = norm(normals[t]);
      if (seen[t] || !(dot(normals[t], up) > 0.2 * size)) continue;
      const auto& [a, b, c] = blank.triangles[t];
      const solid::Vector p = 1.0 / 3 * (blank.vertices[a] + blank.vertices[b] + blank.vertices[c]);
      crossed.clear();
      tree.crossed_above(upright(p + 1e-3 / size * normals[t]), crossed);
      if (!crossed.empty()) continue;
      seen[t] = true;
      area_seen += size;
    }
  }
  const double area = area_of(blank);
  // Halved edges are three quarters of the longest one on average, and two triangles belong to a point.
  const double spacing = 1.55 * std::sqrt(area / static_cast<double>(points));
  // Rounding moves the middles of edges, too.
  CastingScan scan{refined(blank, spacing, seen), noise + 1e-9, 4 * noise + 1e-9, area_seen / area};
  std::vector<solid::Vector> inwards(scan.mesh.vertices.size());
  for (const auto& t : scan.mesh.triangles) {
    const solid::Vector a = scan.mesh.vertices[t[0]],
                        n = cross(scan.mesh.vertices[t[1]] - a, scan.mesh.vertices[t[2]] - a);
    for (const std::uint32_t v : t) inwards[v] = inwards[v] - n;
  }
  for (std::size_t v = 0; v < inwards.size(); ++v) {
    solid::Vector& p = scan.mesh.vertices[v];
    const solid::Vector way = direction(random);
    p = p + random.uniform(0, noise) * way;
    if (random.below(2000) != 0 || !(norm(inwards[v]) > 0)) continue;
    p = p + 3 * noise / norm(inwards[v]) * inwards[v];
  }
  return scan;
}

/// A plate in a blank that two tips from above and below leave no more stock than `optimum` at one place, and
/// much elsewhere. A pose with more has the tips on both sides of the plate, farther apart than they are.
struct PinchedPlate : SolidCase {
  solid::Vector above, below;  ///< the tips, in the blank's frame
};

/// A plate of six corners, of as few triangles as a drawing has: a large one between three of the corners,
/// and one at each of the others.
inline solid::Mesh plate(const std::array<std::array<double, 2>, 6>& outline, double thick) {
  solid::Mesh mesh;
  for (const double z : {-0.5 * thick, 0.5 * thick})
    for (const auto& [x, y] : outline) mesh.vertices.push_back({x, y, z});
  for (const auto& [a, b, c] : {solid::Triangle{0, 2, 4}, {0, 1, 2}, {2, 3, 4}, {4, 5, 0}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  return mesh;
}

/// The part is less than 0.6 degrees and 0.3 mm along each axis off where it fits.
/// \param across  how many quads the blank has each way
inline PinchedPlate pinched_plate(Random& random, std::uint32_t across) {
  const double thick = random.uniform(8, 25), wave = random.uniform(20, 40), phase = random.uniform(0, 6);
  std::array<std::array<double, 2>, 6> outline;
  for (std::uint32_t k = 0; k < 6; ++k) {
    const double turned = std::numbers::pi / 3 * (k + random.uniform(0, 0.25)),
                 out = random.uniform(110, 130);
    outline[k] = {out * std::cos(turned), out * std::sin(turned)};
  }
  PinchedPlate made;
  made.kind = "pinched plate", made.optimum = random.uniform(0.9, 1.6);
  // The blank is a block with a grid above and below, whose heights wave.
  const double most = 134, least = 0.5 * thick + made.optimum;
  const auto middle = [&] {
    return across * 9 / 20 + static_cast<std::uint32_t>(random.below(1 + across / 10));
  };
  const std::uint32_t at_x = middle(), at_y = middle(), row = across + 1, over = row * row;
  const auto along = [&](std::uint32_t i) { return 2.0 * i / across - 1; };
  const double x = along(at_x) * most, y = along(at_y) * most;
  made.above = {x, y, least}, made.below = {x, y, -least};
  for (const double side : {-1.0, 1.0})
    for (std::uint32_t j = 0; j <= across; ++j)
      for (std::uint32_t i = 0; i <= across; ++i) {
        const solid::Vector p{along(i) * most, along(j) * most, 0};
        const double high = 0.5 * thick + 4 + 0.4 * std::sin(p.x / wave + phase) * std::cos(p.y / wave),
                     dent = std::max(0.0, 1 - std::hypot(p.x - x, p.y - y) / 12);
        made.blank.vertices.push_back({p.x, p.y, side * std::lerp(high, least, dent)});
      }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    made.blank.triangles.push_back({a, b, c});
    made.blank.triangles.push_back({a, c, d});
  };
  for (std::uint32_t j = 0; j < across; ++j)
    for (std::uint32_t i = 0; i < across; ++i) {
      const std::uint32_t a = j * row + i;
      quad(a, a + row, a + row + 1, a + 1);
      quad(over + a, over + a + 1, over + a + row + 1, over + a + row);
    }
  for (std::uint32_t k = 0; k < across; ++k) {
    const std::uint32_t south = k, north = across * row + k, west = k * row, east = west + across;
    quad(south, south + 1, over + south + 1, over + south);
    quad(north + 1, north, over + north, over + north + 1);
    quad(west + row, west, over + west, over + west + row);
    quad(east, east + row, over + east + row, over + east);
  }
  const solid::Vector axis = direction(random);
  made.there = turn(axis, random.uniform(-0.01, 0.01));
  made.there.shift = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
  made.part = closed_mesh(moved_back(plate(outline, thick), made.there)).value().mesh;
  made.blank = closed_mesh(std::move(made.blank)).value().mesh;
  return made;
}

}  // namespace lekalo::cases
