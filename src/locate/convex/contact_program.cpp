#include "contact_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/assert.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

/// A blank of up to this many edges has all of them in the program from the beginning, because looking at
/// every edge costs less than finding out which of them matter.
constexpr std::size_t kSmall = 96;
/// A larger blank gives its first rows in this many directions.
constexpr int kFirstDirections = 16;
/// The walk along the part's outline gives way to a search after this many steps.
constexpr std::uint32_t kWalk = 6;
/// Far above the pivots that any program needs (about n in theory, 1 to 4 in practice), this ends a cycle
/// that rounding could cause. The basis at which it ends is still a valid bound.
constexpr int kMostPivots = 2000;

/// Returns the same direction in [0, 2 pi).
double wrap(double direction) {
  direction -= kTurn * static_cast<double>(static_cast<int>(direction * (1 / kTurn)));
  if (direction < 0) direction += kTurn;
  return direction >= kTurn ? 0.0 : direction;
}

}  // namespace

ContactProgram::ContactProgram(const geom::Ring& part, const geom::Ring& blank) {
  for (const geom::Ring* ring : {&part, &blank})
    for (const Point& p : *ring) scale_ = std::max({scale_, std::abs(p.x), std::abs(p.y)});
  tolerance_ = 0x1p-50 * scale_;
  collect_sides(part);
  collect_edges(blank);
  choose_first_rows();
}

void ContactProgram::collect_sides(const geom::Ring& part) {
  const std::size_t m = part.size();
  vertex_x_.reserve(m), vertex_y_.reserve(m), side_x_.reserve(m), side_y_.reserve(m);
  direction_of_side_.reserve(m);
  for (std::size_t i = 0; i < m; ++i) {
    const Point side = part[i + 1 == m ? 0 : i + 1] - part[i];
    vertex_x_.push_back(part[i].x), vertex_y_.push_back(part[i].y);
    side_x_.push_back(side.x), side_y_.push_back(side.y);
    direction_of_side_.push_back(wrap(geom::direction_angle(side.x, side.y)));
  }
  // The sides of a convex outline already run in order of direction, and only the beginning has to be found.
  const auto first = static_cast<std::size_t>(
      std::min_element(direction_of_side_.begin(), direction_of_side_.end()) - direction_of_side_.begin());
  for (std::size_t j = 0; j < m; ++j) {
    const std::size_t i = (first + j) % m;
    side_by_direction_.push_back(static_cast<std::uint32_t>(i));
    side_direction_.push_back(direction_of_side_[i]);
  }
}

void ContactProgram::collect_edges(const geom::Ring& blank) {
  const std::size_t n = blank.size();
  blank_ = blank;
  normal_x_.reserve(n), normal_y_.reserve(n), offset_.reserve(n), normal_direction_.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Point edge = blank[k + 1 == n ? 0 : k + 1] - blank[k];
    const double length = norm(edge);
    const Point normal{-edge.y / length, edge.x / length};
    normal_x_.push_back(normal.x), normal_y_.push_back(normal.y);
    offset_.push_back(dot(normal, blank[k]));
    normal_direction_.push_back(wrap(geom::direction_angle(normal.x, normal.y)));
  }
  lowest_direction_ = static_cast<std::size_t>(
      std::min_element(normal_direction_.begin(), normal_direction_.end()) - normal_direction_.begin());
  row_of_edge_.assign(n, kNoRow);
}

void ContactProgram::choose_first_rows() {
  const std::size_t n = normal_x_.size();
  std::vector<std::uint32_t> chosen;
  if (n <= kSmall) {
    chosen.resize(n);
    std::iota(chosen.begin(), chosen.end(), 0u);
  } else {
    // The rows are the first edge beyond each of some directions, and the edge before it. No gap between
    // neighbouring normals is then larger than in the whole blank, so the chosen ones span the plane
    // positively too.
    for (int d = 0; d < kFirstDirections; ++d) {
      const std::size_t beyond = edge_beyond(d * kTurn / kFirstDirections);
      chosen.push_back(static_cast<std::uint32_t>(beyond));
      chosen.push_back(static_cast<std::uint32_t>((beyond + n - 1) % n));
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  }
  first_edges_ = chosen;
  for (const std::uint32_t k : chosen) add_row(k);
  place(Angle::of(0));

  // The first basis is edge e0, the last edge turned by less than a half turn from it, and the next one.
  const std::size_t count = chosen.size();
  const auto turned = [&](std::size_t j) {
    return normal_x_[chosen[0]] * normal_y_[chosen[j]] - normal_y_[chosen[0]] * normal_x_[chosen[j]] > 0;
  };
  std::size_t last = 1;
  while (last + 2 < count && turned(last + 1)) ++last;
  const std::array<std::uint32_t, 3> edges = {chosen[0], chosen[last], chosen[last + 1]};
  Tableau tableau;
  for (std::size_t j = 0; j < 3; ++j) tableau.row[j] = row_of_edge_[edges[j]];
  meet(tableau);
  first_basis_ = basis_of(tableau);
}

std::size_t ContactProgram::edge_beyond(double direction) const {
  const std::size_t n = normal_direction_.size();
  // The positions are counted from lowest_direction_.
  std::size_t low = 0, high = n;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (normal_direction_[(lowest_direction_ + middle) % n] < direction) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return (lowest_direction_ + low) % n;
}

std::uint32_t ContactProgram::add_row(std::uint32_t edge) {
  const auto row = static_cast<std::uint32_t>(row_edge_.size());
  row_of_edge_[edge] = row;
  row_edge_.push_back(edge);
  row_vertex_.push_back(0);
  row_nx_.push_back(normal_x_[edge]), row_ny_.push_back(normal_y_[edge]);
  row_offset_.push_back(offset_[edge]);
  // The empty range says that the vertex is known for no angle yet.
  row_from_.push_back(1), row_to_.push_back(-1);
  row_cosine_.push_back(0), row_sine_.push_back(0), row_open_.push_back(0);
  return row;
}

std::uint32_t ContactProgram::outermost_by_search(double direction) const {
  // Along the outline n . v falls while the side points away from n, and rises afterwards. It is least where
  // the sides' direction passes that of n less a quarter turn.
  const double target = wrap(direction - 0.25 * kTurn);
  const auto found = std::lower_bound(side_direction_.begin(), side_direction_.end(), target);
  return side_by_direction_[found == side_direction_.end()
                                ? 0u
                                : static_cast<std::size_t>(found - side_direction_.begin())];
}

/// Walks along the part's outline to the vertex with the least q . v. Returns false when `limit` steps do not
/// reach it.
bool ContactProgram::walk_outwards(double qx, double qy, std::uint32_t& vertex, std::uint32_t limit) const {
  const auto m = static_cast<std::uint32_t>(side_x_.size());
  const auto rises = [&](std::uint32_t side) { return qx * side_x_[side] + qy * side_y_[side]; };
  std::uint32_t steps = 0;
  while (rises(vertex) < 0) {
    if (steps++ == limit) return false;
    vertex = vertex + 1 == m ? 0 : vertex + 1;
  }
  for (;;) {
    const std::uint32_t before = vertex == 0 ? m - 1 : vertex - 1;
    if (!(rises(before) > 0)) return true;
    if (steps++ == limit) return false;
    vertex = before;
  }
}

std::uint32_t ContactProgram::outermost_vertex(double qx, double qy, std::size_t edge, double theta,
                                               std::uint32_t hint) const {
  if (walk_outwards(qx, qy, hint, kWalk)) return hint;
  std::uint32_t vertex = outermost_by_search(normal_direction_[edge] - theta);
  // Angles are rounded, and the walk puts the last step right. Should rounding make it run on, any vertex is
  // valid.
  walk_outwards(qx, qy, vertex, static_cast<std::uint32_t>(side_x_.size()));
  return vertex;
}

void ContactProgram::change_vertex(std::size_t row, const Angle& angle, std::uint32_t hint) {
  const double c = angle.direction.cosine, s = angle.direction.sine;
  const double nx = row_nx_[row], ny = row_ny_[row];
  const std::uint32_t edge = row_edge_[row];
  const std::uint32_t vertex = outermost_vertex(c * nx + s * ny, c * ny - s * nx, edge, angle.theta, hint);
  row_vertex_[row] = vertex;
  row_cosine_[row] = nx * vertex_x_[vertex] + ny * vertex_y_[vertex];
  row_sine_[row] = ny * vertex_x_[vertex] - nx * vertex_y_[vertex];
  // The vertex stays outermost while the normal, in the part's frame, stands between a quarter turn beyond
  // the side before it and a quarter turn beyond the side after it.
  const std::size_t m = side_x_.size();
  const double now = normal_direction_[edge] - angle.theta - 0.25 * kTurn;
  const double ahead = wrap(direction_of_side_[vertex] - now);
  const double behind = wrap(now - direction_of_side_[vertex == 0 ? m - 1 : vertex - 1]);
  // Rounding may put the vertex a hair beyond its range. Then the difference wraps to a full turn, and the
  // vertex serves for this angle only.
  row_from_[row] = angle.theta - (ahead < 0.5 * kTurn ? ahead : 0.0);
  row_to_[row] = angle.theta + (behind < 0.5 * kTurn ? behind : 0.0);
}

void ContactProgram::place(const Angle& angle, std::size_t first) {
  const double c = angle.direction.cosine, s = angle.direction.sine, theta = angle.theta;
  const std::size_t count = row_edge_.size();
  // The rows of all edges stand in order, so the vertex of one is at most a few steps from that of the one
  // before.
  const bool in_order = count == normal_x_.size() && count == first_edges_.size();
  for (std::size_t row = first; row < count; ++row)
    if (!(row_from_[row] <= theta && theta <= row_to_[row]))
      change_vertex(row, angle, row_vertex_[in_order && row > 0 ? row - 1 : row]);
  for (std::size_t row = first; row < count; ++row)
    row_open_[row] = row_cosine_[row] * c + row_sine_[row] * s - row_offset_[row];
}

ContactProgram::LeastOpen ContactProgram::least_open(Point shift) const {
  // The processor can work on four running minima side by side. Ties go to the lowest row.
  constexpr std::size_t kLanes = 4;
  const std::size_t count = row_open_.size();
  const auto open_at = [&](std::size_t row) {
    return row_open_[row] + (row_nx_[row] * shift.x + row_ny_[row] * shift.y);
  };
  std::array<double, kLanes> lane;
  lane.fill(std::numeric_limits<double>::infinity());
  std::size_t row = 0;
  for (; row + kLanes <= count; row += kLanes)
    for (std::size_t j = 0; j < kLanes; ++j) {
      const double open = open_at(row + j);
      lane[j] = open < lane[j] ? open : lane[j];
    }
  double least = std::min(std::min(lane[0], lane[1]), std::min(lane[2], lane[3]));
  for (; row < count; ++row) least = std::min(least, open_at(row));
  for (row = 0; row + 1 < count && open_at(row) != least;) ++row;
  return {static_cast<std::uint32_t>(row), least};
}

void ContactProgram::meet(Tableau& tableau) const {
  std::array<Point, 3> n;
  std::array<double, 3> open{};
  for (std::size_t j = 0; j < 3; ++j) {
    n[j] = {row_nx_[tableau.row[j]], row_ny_[tableau.row[j]]};
    open[j] = row_open_[tableau.row[j]];
  }
  const std::array<double, 3> weight = {cross(n[1], n[2]), cross(n[2], n[0]), cross(n[0], n[1])};
  const double sum = weight[0] + weight[1] + weight[2];
  tableau.value = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    tableau.lambda[j] = weight[j] / sum;
    tableau.value += tableau.lambda[j] * open[j];
  }
  // The shift follows from the two normals that stand furthest from parallel.
  const std::size_t odd = std::abs(weight[0]) >= std::abs(weight[1])
                              ? (std::abs(weight[0]) >= std::abs(weight[2]) ? 0u : 2u)
                              : (std::abs(weight[1]) >= std::abs(weight[2]) ? 1u : 2u);
  const std::size_t p = (odd + 1) % 3, q = (odd + 2) % 3;
  const double rp = tableau.value - open[p], rq = tableau.value - open[q];
  tableau.shift = {(rp * n[q].y - rq * n[p].y) / weight[odd], (rq * n[p].x - rp * n[q].x) / weight[odd]};
}

void ContactProgram::pivot(Tableau& tableau, std::uint32_t entering) const {
  // The entering row's column in terms of the basis is made of the barycentric coordinates of its normal in
  // the triangle of theirs.
  const Point e{row_nx_[entering], row_ny_[entering]};
  std::array<Point, 3> n;
  for (std::size_t j = 0; j < 3; ++j) n[j] = {row_nx_[tableau.row[j]], row_ny_[tableau.row[j]]};
  std::size_t leaving = 3;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < 3; ++j) {
    const double y = cross(n[(j + 1) % 3] - e, n[(j + 2) % 3] - e);
    if (!(y > 1e-15)) continue;
    // `lambda` is weight / sum and y carries the same factor, so the ratio test may leave it out.
    const double ratio = std::max(tableau.lambda[j], 0.0) / y;
    if (ratio < least) least = ratio, leaving = j;
  }
  if (leaving < 3) tableau.row[leaving] = entering;
}

double ContactProgram::optimise(Tableau& tableau, double enough) const {
  meet(tableau);
  LeastOpen least = least_open(tableau.shift);
  for (int n = 0; n < kMostPivots && tableau.value > enough && least.open < tableau.value - tolerance_; ++n) {
    const Tableau before = tableau;
    pivot(tableau, least.row);
    if (tableau.row == before.row) break;
    meet(tableau);
    // Only rounding can raise the value, so the better bound is kept.
    if (tableau.value > before.value + tolerance_) {
      tableau = before;
      break;
    }
    least = least_open(tableau.shift);
  }
  return least.open;
}

ContactProgram::PlacedEdge ContactProgram::place_edge(std::uint32_t edge, const Angle& angle, Point shift,
                                                      std::uint32_t hint) const {
  const double c = angle.direction.cosine, s = angle.direction.sine;
  const Point n{normal_x_[edge], normal_y_[edge]};
  const std::uint32_t vertex =
      outermost_vertex(c * n.x + s * n.y, c * n.y - s * n.x, edge, angle.theta, hint);
  const Point v{vertex_x_[vertex], vertex_y_[vertex]};
  const Point corner = Point{c * v.x - s * v.y, s * v.x + c * v.y} + shift;
  return {edge, vertex, dot(n, corner) - offset_[edge], corner};
}

bool ContactProgram::all_open_between(const PlacedEdge& first, const PlacedEdge& last, double least) const {
  // The part stays behind its support lines at both ends. Between the two normals it therefore stays behind
  // the point q where these lines meet. An edge k with q - least n_k inside the blank is open by `least`. The
  // points q - least n_k lie in the triangle of the two for the ends and of the point where the ends'
  // tangents meet. A point inside both end edges, and inside the chord from the first edge's beginning to the
  // last one's end, is inside every edge between.
  const Point n1{normal_x_[first.edge], normal_y_[first.edge]},
      n2{normal_x_[last.edge], normal_y_[last.edge]};
  const double turn = cross(n1, n2), along = dot(n1, n2);
  if (!(along > 0.5) || !(turn > 1e-9)) return false;
  const double h1 = dot(n1, first.corner), h2 = dot(n2, last.corner);
  const Point q{(h1 * n2.y - h2 * n1.y) / turn, (h2 * n1.x - h1 * n2.x) / turn};
  const Point from = blank_[first.edge], to = blank_[last.edge + 1 == blank_.size() ? 0 : last.edge + 1];
  const Point chord = to - from;
  for (const Point& reach : {n1, n2, (1.0 / (1.0 + along)) * (n1 + n2)}) {
    const Point p = q - least * reach;
    if (!(dot(n1, p) >= offset_[first.edge]) || !(dot(n2, p) >= offset_[last.edge]) ||
        !(cross(chord, p - from) >= 0))
      return false;
  }
  return true;
}

void ContactProgram::find_least_open(const PlacedEdge& first, const PlacedEdge& last, const Angle& angle,
                                     Point shift, PlacedEdge& least) const {
  if (last.edge - first.edge < 2 || all_open_between(first, last, least.open)) return;
  const PlacedEdge middle = place_edge(first.edge + (last.edge - first.edge) / 2, angle, shift, first.vertex);
  if (middle.open < least.open) least = middle;
  // The more promising half comes first, because what it finds prunes the other.
  if (first.open <= last.open) {
    find_least_open(first, middle, angle, shift, least);
    find_least_open(middle, last, angle, shift, least);
  } else {
    find_least_open(middle, last, angle, shift, least);
    find_least_open(first, middle, angle, shift, least);
  }
}

bool ContactProgram::add_violated(const Angle& angle, Point shift, double value) {
  const std::size_t before = row_edge_.size();
  PlacedEdge first = place_edge(first_edges_.back(), angle, shift, 0);
  const auto last_edge = static_cast<std::uint32_t>(normal_x_.size() - 1);
  const auto search = [&](const PlacedEdge& from, const PlacedEdge& to) {
    PlacedEdge least;
    least.open = value - tolerance_;
    const double limit = least.open;
    for (const PlacedEdge& end : {from, to})
      if (end.open < least.open) least = end;
    find_least_open(from, to, angle, shift, least);
    if (least.open < limit && row_of_edge_[least.edge] == kNoRow) add_row(least.edge);
  };
  // The stretch over the end of the numbering is searched in two parts.
  search(first, place_edge(last_edge, angle, shift, first.vertex));
  first = place_edge(0, angle, shift, first.vertex);
  for (const std::uint32_t edge : first_edges_) {
    const PlacedEdge next = place_edge(edge, angle, shift, first.vertex);
    search(first, next);
    first = next;
  }
  if (row_edge_.size() == before) return false;
  place(angle, before);
  return true;
}

void ContactProgram::add_contact(Basis& basis, std::size_t j, std::uint32_t edge, std::uint32_t vertex,
                                 double lambda) const {
  const double nx = normal_x_[edge], ny = normal_y_[edge], vx = vertex_x_[vertex], vy = vertex_y_[vertex];
  basis.edge[j] = edge, basis.vertex[j] = vertex, basis.lambda[j] = lambda;
  basis.bound.mean -= lambda * offset_[edge];
  basis.bound.a += lambda * (nx * vx + ny * vy);
  basis.bound.b += lambda * (ny * vx - nx * vy);
}

Basis ContactProgram::basis_of(const Tableau& tableau) const {
  Basis basis;
  basis.shift = tableau.shift;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::uint32_t row = tableau.row[j];
    add_contact(basis, j, row_edge_[row], row_vertex_[row], tableau.lambda[j]);
  }
  return basis;
}

Basis ContactProgram::braced(const Basis& basis, const Angle& angle) const {
  const auto normal = [&](std::size_t edge) { return Point{normal_x_[edge], normal_y_[edge]}; };
  const auto light = static_cast<std::size_t>(std::min_element(basis.lambda.begin(), basis.lambda.end()) -
                                              basis.lambda.begin());
  // The two others are p and q, with q counter-clockwise of p, and the new third one is the normal that
  // stands most across them.
  std::size_t p = (light + 1) % 3, q = (light + 2) % 3;
  if (cross(normal(basis.edge[p]), normal(basis.edge[q])) < 0) std::swap(p, q);
  const Point np = normal(basis.edge[p]), nq = normal(basis.edge[q]), across{np.y, -np.x};
  const std::size_t n = normal_x_.size();
  const std::size_t beyond = edge_beyond(wrap(geom::direction_angle(across.x, across.y)));
  const std::size_t before = (beyond + n - 1) % n;
  const bool nearer = dot(normal(beyond), across) >= dot(normal(before), across);
  const auto edge = static_cast<std::uint32_t>(nearer ? beyond : before);
  const Point nl = normal(edge);
  const double c = angle.direction.cosine, s = angle.direction.sine;
  const std::uint32_t vertex =
      outermost_vertex(c * nl.x + s * nl.y, c * nl.y - s * nl.x, edge, angle.theta, basis.vertex[light]);
  const std::array<double, 3> weight = {cross(nq, nl), cross(nl, np), cross(np, nq)};
  const double sum = weight[0] + weight[1] + weight[2];
  Basis braced;
  braced.shift = basis.shift;
  add_contact(braced, 0, basis.edge[p], basis.vertex[p], weight[0] / sum);
  add_contact(braced, 1, basis.edge[q], basis.vertex[q], weight[1] / sum);
  add_contact(braced, 2, edge, vertex, weight[2] / sum);
  return braced;
}

ContactProgram::Solution ContactProgram::solve(const Angle& angle, const Basis& warm, double of_interest,
                                               Effort effort) {
  place(angle);
  Tableau tableau;
  for (std::size_t j = 0; j < 3; ++j) tableau.row[j] = row_of_edge_[warm.edge[j]];
  const double enough = effort == Effort::bound ? of_interest : -std::numeric_limits<double>::infinity();
  double value = optimise(tableau, enough);
  if (row_edge_.size() < normal_x_.size()) {
    while (tableau.value > of_interest && add_violated(angle, tableau.shift, tableau.value))
      value = optimise(tableau, enough);
    // Edges outside the program may be violated by this much.
    value -= tolerance_;
  }
  if (!(tableau.value > of_interest)) value = -std::numeric_limits<double>::infinity();
  return {basis_of(tableau), tableau.shift, value};
}

}  // namespace lekalo::locate
