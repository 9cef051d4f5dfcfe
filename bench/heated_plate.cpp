#include "heated_plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/field/level_lines.hpp"

namespace lekalo::heated_plate {
namespace {

using geom::Point;

constexpr double kPi = 3.141592653589793;

Cell cut_cell(const Plate& plate, std::size_t n) {
  constexpr std::array<Point, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const std::array<std::size_t, 4> at = plate.corners(n);
  Cell cell;
  std::vector<Point> wall;
  std::array<double, 4> open{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Point corner = kCorners[k], next = kCorners[(k + 1) % 4];
    const double u = plate.model[at[k]], v = plate.model[at[(k + 1) % 4]];
    if (u < 0) cell.material.push_back(corner);
    open[k] = u < 0 ? 1 : 0;
    if ((u < 0) == (v < 0)) continue;
    const double part = u / (u - v);
    open[k] = u < 0 ? part : 1 - part;
    wall.push_back(corner + part * (next - corner));
    cell.material.push_back(wall.back());
  }
  cell.whole = wall.empty() && !cell.material.empty();
  cell.right = open[1], cell.top = open[2];
  if (wall.size() == 2) {
    cell.wall = kPitch * geom::norm(wall[1] - wall[0]);
    cell.at = plate.node(at[0]) + 0.5 * kPitch * (wall[0] + wall[1]);
  }
  return cell;
}

using Product = std::function<void(const Numbers&, Numbers&)>;
/// Conjugate gradients, each unknown scaled by the inverse of its diagonal; where that is 0 it stays 0.
Result<Numbers> solved(const Product& times, const Numbers& inverse, Numbers rest) {
  Numbers x(rest.size(), 0), scaled(rest.size()), way(rest.size(), 0), image(rest.size());
  double before = 0, first = 0;
  for (int step = 0; step < 20'000; ++step) {
    for (std::size_t n = 0; n < rest.size(); ++n) scaled[n] = inverse[n] * rest[n];
    const double now = std::inner_product(rest.begin(), rest.end(), scaled.begin(), 0.0);
    if (step == 0) first = now;
    if (now <= 1e-18 * first) return x;
    for (std::size_t n = 0; n < way.size(); ++n) way[n] = scaled[n] + (step == 0 ? 0 : now / before) * way[n];
    times(way, image);
    const double length = now / std::inner_product(way.begin(), way.end(), image.begin(), 0.0);
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += length * way[n], rest[n] -= length * image[n];
    before = now;
  }
  return failure(ErrorCode::refuted, "conjugate gradients do not converge");
}

Result<Numbers> temperature(const Plate& plate, const std::function<double(Point)>& density) {
  const std::size_t size = plate.cells.size(), up = plate.cells.columns;
  Numbers to_right(size, 0), to_top(size, 0), diagonal(size, 0), inverse(size, 0), heat(size, 0);
  const auto join = [&](std::size_t n, std::size_t m, double open) {
    const double a = plate.within(plate.cell(n)), b = plate.within(plate.cell(m));
    if (!(open > 0) || (a <= 0 && b <= 0)) return 0.0;
    const double part = a > 0 && b > 0 ? 1 : std::max(a, b) / std::abs(a - b);  // of the way, to the border
    diagonal[n] += kConduction * open / part, diagonal[m] += kConduction * open / part;
    return kConduction * open / part;
  };
  for (std::size_t n = 0; n + up < size; ++n) {
    if (n % up + 1 < up) to_right[n] = join(n, n + 1, plate.cut[n].right);
    to_top[n] = join(n, n + up, plate.cut[n].top);
    if (plate.cut[n].wall > 0) heat[n] = plate.cut[n].wall * density(plate.cut[n].at);
  }
  for (std::size_t n = 0; n < size; ++n)
    if (diagonal[n] > 0 && plate.within(plate.cell(n)) > 0) inverse[n] = 1 / diagonal[n];
  const Product flows = [&](const Numbers& t, Numbers& flow) {
    std::fill(flow.begin(), flow.end(), 0);
    for (std::size_t n = 0; n + up < size; ++n) {
      const double right = to_right[n] * (t[n] - t[n + 1]), top = to_top[n] * (t[n] - t[n + up]);
      flow[n] += right + top, flow[n + 1] -= right, flow[n + up] -= top;
    }
  };
  auto t = solved(flows, inverse, heat);
  if (!t) return t;
  Numbers flow(size);
  flows(*t, flow);
  double in = std::accumulate(heat.begin(), heat.end(), 0.0), out = 0;
  for (std::size_t n = 0; n < size; ++n)
    if (plate.within(plate.cell(n)) <= 0) out -= flow[n];
  fmt::print("heat in {:.4f}, out {:.4f} W/mm\n", in, out);
  if (std::max(std::abs(in - kHeat), std::abs(out - kHeat)) > 0.01 * kHeat)
    return failure(ErrorCode::refuted,
                   fmt::format("{:.4f} W/mm go in and {:.4f} out instead of {:g}; the place "
                               "of the heat is on the outline of paper-pocket.json",
                               in, out, kHeat));
  return t;
}

using Strain = std::array<std::array<double, 8>, 3>;
/// Strains xx, yy, xy at p, of the unit square, by the displacements of a cell's corners.
Strain strain_at(Point p) {
  Strain b{};
  for (std::size_t k = 0; k < 4; ++k) {
    const bool right = k == 1 || k == 2, top = k >= 2;
    b[0][2 * k] = b[2][2 * k + 1] = (right ? 1 : -1) * (top ? p.y : 1 - p.y) / kPitch;
    b[1][2 * k + 1] = b[2][2 * k] = (top ? 1 : -1) * (right ? p.x : 1 - p.x) / kPitch;
  }
  return b;
}
std::array<double, 3> stress_of(const std::array<double, 3>& e) {
  const double scale = kYoung / (1 - kNu * kNu);
  return {scale * (e[0] + kNu * e[1]), scale * (e[1] + kNu * e[0]), scale * (1 - kNu) / 2 * e[2]};
}

/// Forces at a cell's corners by their displacements, and by 1 K.
struct Element {
  std::array<std::array<double, 8>, 8> stiffness{};
  std::array<double, 8> push{};
};
/// Integrated over the material alone, exactly: the middles of a triangle's sides serve any quadratic.
Element element_of(const std::vector<Point>& material) {
  Element element;
  for (std::size_t k = 1; k + 1 < material.size(); ++k) {
    const std::array<Point, 3> p{material[0], material[k], material[k + 1]};
    const double weight = geom::cross(p[1] - p[0], p[2] - p[0]) * kPitch * kPitch / 6;
    for (std::size_t side = 0; side < 3; ++side) {
      const Strain b = strain_at(0.5 * (p[side] + p[(side + 1) % 3]));
      for (std::size_t i = 0; i < 8; ++i) {
        const std::array<double, 3> by = stress_of({b[0][i], b[1][i], b[2][i]});
        element.push[i] += weight * kExpansion * (by[0] + by[1]);
        for (std::size_t j = 0; j < 8; ++j)
          for (std::size_t row = 0; row < 3; ++row) element.stiffness[i][j] += weight * by[row] * b[row][j];
      }
    }
  }
  return element;
}

/// The closed form of a round plate with a round hole, heat even over the hole, the rim cold and held.
struct RoundHole {
  static constexpr double r = 20, R = 60;
  static constexpr double kTurn = (1 + kNu) / (1 - kNu) * r * r;
  /// K: Q ln(R / s) / (2 pi k).
  static double heat(double s) { return kHeat * std::log(R / s) / (2 * kPi * kConduction); }
  /// The integral of heat(x) x from r to s.
  static double sum(double s) {
    const auto of = [](double x) { return x * x * (std::log(R / x) / 2 + 0.25); };
    return kHeat / (2 * kPi * kConduction) * (of(s) - of(r));
  }
  /// u = (1 + nu) alpha sum / s + a s + b / s, with b = kTurn a: no stress on the hole, no u on the rim.
  static double a() { return -(1 + kNu) * kExpansion * sum(R) / (R * R + kTurn); }
  static double moved(double s) { return (1 + kNu) * kExpansion * sum(s) / s + a() * (s + kTurn / s); }
  static double stress(double s) {
    const double even = kYoung * a() / (1 - kNu), odd = kYoung / (1 + kNu) * kTurn * a() / (s * s);
    const double radial = -kYoung * kExpansion * sum(s) / (s * s) + even - odd;
    const double hoop = kYoung * kExpansion * (sum(s) / (s * s) - heat(s)) + even + odd;
    return std::sqrt(radial * radial - radial * hoop + hoop * hoop);
  }
};

}  // namespace

Result<Plate> plate_with(const std::vector<geom::Region>& pockets, geom::Box border,
                         std::function<double(Point)> within) {
  LEKALO_TRY(const auto model, field::ContourModel::make(pockets, {kSampling, field::Logic::quadratic,
                                                                   field::FlozForm::normalised}));
  Plate plate;
  // Nodes off the round numbers of drawings: a node on the outline has no sign.
  const auto count = [](double length) { return static_cast<std::size_t>(length / kPitch) + 5; };
  const Point origin = border.low - Point{1.6 * kPitch, 1.6 * kPitch}, size = border.high - border.low;
  plate.nodes = {origin, kPitch, count(size.x), count(size.y)};
  plate.cells = {origin + Point{kPitch / 2, kPitch / 2}, kPitch, plate.nodes.columns - 1,
                 plate.nodes.rows - 1};
  const field::FieldGrid grid = field::sample(model, plate.nodes);
  plate.model.assign(grid.value.begin(), grid.value.end());
  plate.within = std::move(within);
  for (std::size_t n = 0; n < plate.cells.size(); ++n) plate.cut.push_back(cut_cell(plate, n));
  return plate;
}

Result<State> heated(const Plate& plate, const std::function<double(Point)>& density) {
  LEKALO_TRY(const auto heat, temperature(plate, density));
  State state{heat, Numbers(plate.cells.size(), 0), {}};
  std::vector<Element> elements{element_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}})};  // the first: whole cells
  std::vector<std::size_t> kind(plate.cells.size(), 0);
  const auto each_cell = [&](auto&& act) {
    for (std::size_t n = 0; n < plate.cells.size(); ++n)
      if (plate.cut[n].material.size() > 2) act(n, plate.corners(n));
  };
  Numbers load(2 * plate.nodes.size(), 0), diagonal(load.size(), 0);
  each_cell([&](std::size_t n, const std::array<std::size_t, 4>& at) {
    if (!plate.cut[n].whole) kind[n] = elements.size(), elements.push_back(element_of(plate.cut[n].material));
    const Element& element = elements[kind[n]];
    for (std::size_t i = 0; i < 8; ++i) {
      load[2 * at[i / 2] + i % 2] += state.temperature[n] * element.push[i];
      diagonal[2 * at[i / 2] + i % 2] += element.stiffness[i][i];
    }
  });
  Numbers inverse(load.size(), 0);
  for (std::size_t i = 0; i < load.size(); ++i)
    if (diagonal[i] > 0 && plate.within(plate.node(i / 2)) > 0) inverse[i] = 1 / diagonal[i];
  const Product forces = [&](const Numbers& u, Numbers& force) {
    std::fill(force.begin(), force.end(), 0);
    each_cell([&](std::size_t n, const std::array<std::size_t, 4>& at) {
      std::array<double, 8> by{};
      for (std::size_t j = 0; j < 8; ++j)
        for (std::size_t i = 0; i < 8; ++i)
          by[i] += elements[kind[n]].stiffness[j][i] * u[2 * at[j / 2] + j % 2];
      for (std::size_t i = 0; i < 8; ++i) force[2 * at[i / 2] + i % 2] += by[i];
    });
  };
  LEKALO_TRY(state.moved, solved(forces, inverse, load));
  const Strain b = strain_at({0.5, 0.5});
  each_cell([&](std::size_t n, const std::array<std::size_t, 4>& at) {
    std::array<double, 3> e{-kExpansion * state.temperature[n], -kExpansion * state.temperature[n], 0};
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < 3; ++k) e[k] += b[k][i] * state.moved[2 * at[i / 2] + i % 2];
    const auto [x, y, xy] = stress_of(e);
    state.stress[n] = std::sqrt(x * x - x * y + y * y + 3 * xy * xy);
  });
  return state;
}

Point moved_at(const Plate& plate, const State& state, Point p) {
  return between(
      plate.nodes,
      [&](std::size_t n) {
        return Point{state.moved[2 * n], state.moved[2 * n + 1]};
      },
      p);
}

std::vector<std::vector<Point>> outlines_of(const Plate& plate) {
  Numbers outside = plate.model;
  for (double& v : outside) v = -v;
  std::vector<std::vector<Point>> lines;
  for (const auto& line : field::LevelLines(plate.nodes, outside).at(0)) {
    lines.emplace_back();
    for (const auto& place : line) lines.back().push_back(place.at);
  }
  return lines;
}

Result<void> check_round_hole() {
  using Hole = RoundHole;
  LEKALO_TRY(const auto disc,
             geom::make_region({{geom::EdgeKind::arc_ccw, {Hole::r, 0}, {Hole::r, 0}, {0, 0}}}));
  LEKALO_TRY(const auto plate, plate_with({disc}, {{-Hole::R, -Hole::R}, {Hole::R, Hole::R}},
                                          [](Point p) { return Hole::R - geom::norm(p); }));
  LEKALO_TRY(const auto found, heated(plate, [](Point) { return kHeat / (2 * kPi * Hole::r); }));
  double off_heat = 0, off_stress = 0, off_moved = 0;
  for (std::size_t n = 0; n < plate.cells.size(); ++n) {
    const double s = geom::norm(plate.cell(n));
    // Not beside the rim: nodes are held there, a staircase; a block's border is straight.
    if (!plate.cut[n].whole || s > Hole::R - 4 * kPitch) continue;
    off_heat = std::max(off_heat, std::abs(found.temperature[n] - Hole::heat(s)) / Hole::heat(Hole::r));
    off_stress = std::max(off_stress, std::abs(found.stress[n] - Hole::stress(s)) / Hole::stress(Hole::r));
  }
  for (const auto& line : outlines_of(plate))
    for (const Point p : line) {
      const Point off = moved_at(plate, found, p) - (Hole::moved(geom::norm(p)) / geom::norm(p)) * p;
      off_moved = std::max(off_moved, geom::norm(off) / std::abs(Hole::moved(Hole::r)));
    }
  const std::string sentence = fmt::format(
      "a round hole in a round plate is off its closed form by {:.2f} % of the hole's temperature, {:.2f} % "
      "of its displacement, {:.2f} % of its stress",
      100 * off_heat, 100 * off_moved, 100 * off_stress);
  if (off_heat > 0.01 || off_moved > 0.02 || off_stress > 0.04) return failure(ErrorCode::refuted, sentence);
  fmt::print("{}\n", sentence);
  return {};
}

}  // namespace lekalo::heated_plate
