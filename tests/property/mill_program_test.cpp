#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lekalo/mill/program.hpp"
#include "mill/path/arc_fit.hpp"
#include "support/cases.hpp"
#include "verify/pocket/nc_moves.hpp"

// What is written is read back by the checker's own reader and lies on the path that was meant, for every
// post and unit; and fewer motions are the same path.

namespace lekalo::mill::mill_program_test {
namespace {

using geom::EdgeKind;
using geom::Point;

struct Spot {
  Point at;
  double z = 0;
};

/// Places along a move, ends included.
void add_spots(Point from, double from_z, const PathMove& move, std::vector<Spot>& spots) {
  constexpr int kPieces = 12;
  const bool arc = move.shape != EdgeKind::line;
  double begin = 0, sweep = 0, radius = 0;
  if (arc) {
    const geom::Edge edge = arc_of(move, from);
    radius = geom::arc_radius(edge);
    sweep = geom::arc_sweep(edge) * (move.shape == EdgeKind::arc_ccw ? 1 : -1);
    begin = std::atan2(from.y - move.centre.y, from.x - move.centre.x);
  }
  for (int k = 0; k <= kPieces; ++k) {
    const double t = static_cast<double>(k) / kPieces, angle = begin + t * sweep;
    const Point p =
        arc ? move.centre + radius * Point{std::cos(angle), std::sin(angle)} : from + t * (move.to - from);
    spots.push_back({p, from_z + t * (move.z - from_z)});
  }
}

std::vector<Spot> spots_of(const PocketPath& path) {
  std::vector<Spot> spots;
  for (std::size_t i = 1; i < path.moves.size(); ++i)
    add_spots(path.moves[i - 1].to, path.moves[i - 1].z, path.moves[i], spots);
  return spots;
}

/// The moves a reader found, as a path.
PocketPath path_of(const std::vector<verify::Move>& moves) {
  PocketPath path;
  const auto point = [](verify::Place p) { return Point{p.x, p.y}; };
  path.moves.push_back({PathMove::Kind::rapid, point(moves.front().from), moves.front().from_z});
  for (const verify::Move& m : moves)
    path.moves.push_back({m.rapid ? PathMove::Kind::rapid : PathMove::Kind::cut, point(m.to), m.to_z,
                          !m.arc  ? EdgeKind::line
                          : m.ccw ? EdgeKind::arc_ccw
                                  : EdgeKind::arc_cw,
                          point(m.centre), m.feed});
  return path;
}

double distance_to_segment(Spot p, Spot a, Spot b) {
  const Point way = b.at - a.at;
  const double dz = b.z - a.z, square = dot(way, way) + dz * dz;
  const double t = square > 0 ? std::clamp((dot(p.at - a.at, way) + (p.z - a.z) * dz) / square, 0.0, 1.0) : 0;
  const Point off = p.at - (a.at + t * way);
  const double up = p.z - (a.z + t * dz);
  return std::sqrt(dot(off, off) + up * up);
}

/// How far a place of one path lies from the other. Between the spots of an arc the chord is off by its
/// sagitta: 1/24 of half a turn, 0.002 of the radius; the other path is therefore sampled finely.
double farthest(const std::vector<Spot>& spots, const PocketPath& other) {
  double most = 0;
  for (const Spot& p : spots) {
    double least = 1e300;
    for (std::size_t i = 1; i < other.moves.size(); ++i) {
      const PathMove& move = other.moves[i];
      const Spot from{other.moves[i - 1].to, other.moves[i - 1].z};
      if (move.shape == EdgeKind::line) {
        least = std::min(least, distance_to_segment(p, from, {move.to, move.z}));
        continue;
      }
      const geom::Edge edge = arc_of(move, from.at);
      const double radius = geom::arc_radius(edge), sweep = geom::arc_sweep(edge);
      const double turn = move.shape == EdgeKind::arc_ccw ? 1 : -1;
      const Point out = p.at - move.centre, begin = from.at - move.centre;
      double angle = turn * std::atan2(cross(begin, out), dot(begin, out));
      if (angle < 0) angle += 2 * M_PI;
      const auto spot_at = [&](double at) {
        const double direction = std::atan2(begin.y, begin.x) + turn * at;
        return Spot{move.centre + radius * Point{std::cos(direction), std::sin(direction)},
                    from.z + at / sweep * (move.z - from.z)};
      };
      // On a steep helix the nearest spot has another angle: it is looked for along the tangent.
      const double rise = (move.z - from.z) / sweep;
      for (double at : {std::clamp(angle, 0.0, sweep), 0.0, sweep})
        for (int step = 0; step < 3; ++step) {
          const Spot q = spot_at(at);
          const Point off = p.at - q.at;
          const double up = p.z - q.z;
          least = std::min(least, std::sqrt(dot(off, off) + up * up));
          const double along = turn * cross(q.at - move.centre, off) + up * rise;
          at = std::clamp(at + along / (radius * radius + rise * rise), 0.0, sweep);
        }
    }
    most = std::max(most, least);
  }
  return most;
}

PocketPath random_path(Random& random) {
  const auto number = [&](double low, double high) { return random.uniform(low, high); };
  PocketPath path;
  path.moves.push_back({PathMove::Kind::rapid, {number(-50, 50), number(-50, 50)}, 5});
  path.moves.push_back({PathMove::Kind::plunge, path.moves.back().to, 0});
  for (int i = 0; i < 30; ++i) {
    const Point from = path.moves.back().to;
    const double size = std::pow(10.0, number(-2.5, 1.5));
    // No steep helix of a hundredth of a millimetre: its height is not told by its place.
    const double z =
        i % 2 == 0 && size > 1 ? path.moves.back().z + number(-0.5, 0.3) * size : path.moves.back().z;
    const double direction = number(-3.2, 3.2);
    const Point off = size * Point{std::cos(direction), std::sin(direction)};
    if (i % 3 == 0) {
      path.moves.push_back({PathMove::Kind::cut, from + off, z});
      continue;
    }
    const bool ccw = i % 2 == 0;
    const double turn = i % 9 == 1 ? 2 * M_PI : number(0.01, 6.2), angle = ccw ? turn : -turn;
    PathMove move{i % 5 == 0 ? PathMove::Kind::link : PathMove::Kind::cut, from, z,
                  ccw ? EdgeKind::arc_ccw : EdgeKind::arc_cw, from + off};
    const Point out = from - move.centre;
    if (i % 9 != 1)
      move.to = move.centre + std::cos(angle) * out + std::sin(angle) * geom::perpendicular(out);
    path.moves.push_back(move);
  }
  path.moves.push_back({PathMove::Kind::rapid, path.moves.back().to, 50});
  return path;
}

TEST(MillProgram, EveryPostReadBackIsThePathThatWasMeant) {
  double most = 0;
  for (std::size_t index = 0; index < cases::case_count(8); ++index) {
    Random random(cases::seed(), 91000 + index);
    const PocketPath path = random_path(random);
    for (const nc::Dialect& post : nc::posts())
      for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::inch}) {
        SCOPED_TRACE(fmt::format("seed {} case {} post {} unit {}", cases::seed(), index, post.name,
                                 static_cast<int>(unit)));
        ProgramOptions options;
        options.post = post, options.unit = unit;
        const std::string program = program_of(path, options);
        const auto moves = verify::read_moves({"p.ngc", program}, 0);
        ASSERT_TRUE(moves) << moves.error().message;
        const PocketPath read = path_of(*moves);
        const double there = farthest(spots_of(path), read), back = farthest(spots_of(read), path);
        EXPECT_LE(there, kWritingError);
        EXPECT_LE(back, kWritingError);
        most = std::max({most, there, back});
        double length = 0, written = 0;
        for (const auto& [whole, sum] : {std::pair(&path, &length), std::pair(&read, &written)})
          for (std::size_t i = 1; i < whole->moves.size(); ++i) {
            const PathMove& m = whole->moves[i];
            const Point from = whole->moves[i - 1].to;
            *sum += m.shape == EdgeKind::line
                        ? norm(m.to - from)
                        : geom::arc_sweep(arc_of(m, from)) * geom::arc_radius(arc_of(m, from));
          }
        EXPECT_NEAR(length, written, 0.05);  // no circle too many, none too few
      }
  }
  EXPECT_GT(most, 1e-5);
}

TEST(MillProgram, AFlatArcBetweenEndsThatAreRoundedKeepsToTheBound) {
  // Both ends are rounded to one side by 0.7 um, and the arc rises 0.49 um to the other: no line will do.
  const Point from{0.0004999, 0.0004999}, along{0.014, -0.014};
  const double chord = norm(along), height = 0.00049, radius = chord * chord / (8 * height) + height / 2;
  const Point middle = from + 0.5 * along, out = (1 / chord) * geom::perpendicular(along);
  PocketPath path;
  path.moves.push_back({PathMove::Kind::rapid, from, 5});
  path.moves.push_back({PathMove::Kind::plunge, from, 0});
  path.moves.push_back(
      {PathMove::Kind::cut, from + along, 0, EdgeKind::arc_cw, middle - (radius - height) * out});
  for (const nc::Dialect& post : nc::posts()) {
    ProgramOptions options;
    options.post = post;
    const auto moves = verify::read_moves({"p.ngc", program_of(path, options)}, 0);
    ASSERT_TRUE(moves) << moves.error().message;
    EXPECT_LE(farthest(spots_of(path), path_of(*moves)), kWritingError) << post.name;
  }
}

TEST(MillProgram, FewerMotionsAreTheSamePath) {
  std::size_t before = 0, after = 0;
  for (std::size_t index = 0; index < cases::case_count(8); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 92000 + index);
    // Tangent arcs and lines as a designer draws them, in points 0.1 mm apart.
    PocketPath path;
    Point at{0, 0};
    double direction = 0;
    path.moves.push_back({PathMove::Kind::rapid, at, 5});
    path.moves.push_back({PathMove::Kind::plunge, at, -1});
    for (int i = 0; i < 8; ++i) {
      const double length = random.uniform(0.5, 12), curvature = i % 2 == 0 ? 0 : random.uniform(-0.5, 0.5);
      const auto pieces = static_cast<int>(std::ceil(length / 0.1));
      for (int k = 0; k < pieces; ++k) {
        const double step = length / pieces, turn = curvature * step;
        const double chord = curvature != 0 ? 2 * std::sin(turn / 2) / curvature : step;
        at = at + chord * Point{std::cos(direction + turn / 2), std::sin(direction + turn / 2)};
        direction += turn;
        path.moves.push_back({PathMove::Kind::cut, at, -1});
      }
    }
    const double tolerance = index % 2 == 0 ? 2e-3 : 0.02;
    const PocketPath fewer = fitted(path, tolerance);
    EXPECT_LE(farthest(spots_of(path), fewer), tolerance);
    EXPECT_LE(farthest(spots_of(fewer), path), tolerance);
    EXPECT_EQ(fewer.moves.back().to, path.moves.back().to);
    before += path.moves.size(), after += fewer.moves.size();
    const PocketPath again = fitted(fewer, tolerance);
    EXPECT_LE(again.moves.size(), fewer.moves.size());
  }
  EXPECT_LT(20 * after, before);
}

TEST(MillProgram, ACornerStaysWhereItIs) {
  PocketPath path;
  for (const Point p : {Point{0, 0}, Point{10, 0}, Point{10, 10}, Point{0, 10}})
    path.moves.push_back({path.moves.empty() ? PathMove::Kind::rapid : PathMove::Kind::cut, p, -1});
  EXPECT_EQ(fitted(path, 0.01).moves.size(), 4U);
}

}  // namespace
}  // namespace lekalo::mill::mill_program_test
