#include "solid_bound.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::TriangleTree;
using solid::Vector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The balls of a contact are so many times smaller than part and blank together, and each one larger than
/// the one before by this.
constexpr double kSmallestBall = 1.0 / 1024, kLadder = 3;
/// A ball that stays away from the contact by more than this part of its way to the middle says little.
constexpr double kMostLoss = 0.5;

Vector absolute(Vector p) { return {std::abs(p.x), std::abs(p.y), std::abs(p.z)}; }

/// Balls about places farther and farther along a direction, each as large as the surface leaves it, while
/// they lie on the side that is wanted.
std::vector<SolidBall> ladder(const TriangleTree& tree, Vector from, Vector direction, bool inside,
                              double size) {
  std::vector<SolidBall> balls{{from, 0}};
  for (double way = kSmallestBall * size; way <= 2 * size; way *= kLadder) {
    const Vector centre = from + way * direction;
    if (tree.holds(centre) != inside) break;
    const double radius = tree.nearest(centre)->low;
    if (!(radius > (1 - kMostLoss) * way)) break;
    balls.push_back({centre, radius});
  }
  return balls;
}

/// The least of n . p over all of a mesh.
double least_along(const TriangleTree& tree, Vector n) {
  const auto lowest = [&](const solid::Box& box) {
    return n.x * (n.x > 0 ? box.low.x : box.high.x) + n.y * (n.y > 0 ? box.low.y : box.high.y) +
           n.z * (n.z > 0 ? box.low.z : box.high.z);
  };
  double least = kInfinity;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const TriangleTree::Node& node = tree.nodes()[at];
    if (lowest(node.box) >= least) continue;
    if (node.right == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k)
        for (const Vector p : tree.corners(k)) least = std::min(least, dot(n, p));
      continue;
    }
    std::uint32_t one = at + 1, other = node.right;
    if (lowest(tree.nodes()[other].box) < lowest(tree.nodes()[one].box)) std::swap(one, other);
    open.push_back(other);
    open.push_back(one);
  }
  return least;
}

/// What n . R p may exceed n . p + 2 (p x n) . y by, for a rotation R with y in the cell: docs/design/
/// locate-solid.md has the two bounds of the second order.
double bend(Vector n, Vector p, Vector lever, const CellView& cell) {
  const double y = cell.turn_norm, np = dot(n, p);
  const double all_round = y * y * std::max(0.0, norm(p) - np);
  const Vector t = cell.turn;
  const double squares = std::max(0.0, n.x * p.x - np) * t.x * t.x +
                         std::max(0.0, n.y * p.y - np) * t.y * t.y +
                         std::max(0.0, n.z * p.z - np) * t.z * t.z;
  const double products = std::abs(n.x * p.y + n.y * p.x) * t.x * t.y +
                          std::abs(n.y * p.z + n.z * p.y) * t.y * t.z +
                          std::abs(n.z * p.x + n.x * p.z) * t.z * t.x;
  return std::min(all_round, 2 * (squares + products)) + 2 * y * y * y * norm(lever);
}

Vector any_across(Vector u) {
  const Vector a = absolute(u);
  const Vector axis = a.x <= a.y && a.x <= a.z ? Vector{1, 0, 0}
                      : a.y <= a.z             ? Vector{0, 1, 0}
                                               : Vector{0, 0, 1};
  const Vector across = cross(u, axis);
  return 1 / norm(across) * across;
}

}  // namespace

CellView::CellView(const SolidFrame& frame, const SolidCell& cell)
    : motion(frame.motion(cell.middle)), at(cell.middle.at), slide(cell.half.at) {
  const Vector x = absolute(cell.middle.x), h = cell.half.x;
  // y = (d + x cross d) / (1 + x . x + x . d) for the step d from the middle x; a little more for rounding.
  const double least = 1 + dot(x, x) - dot(x, h);
  turn = (1 + 0x1p-40) / least *
         (h + Vector{x.y * h.z + x.z * h.y, x.z * h.x + x.x * h.z, x.x * h.y + x.y * h.x});
  slide_norm = norm(slide);
  turn_norm = norm(turn);
  const double reach = 2 * frame.reach;
  half = {slide.x, slide.y, slide.z, reach * turn.x, reach * turn.y, reach * turn.z};
}

SolidBounds::SolidBounds(const SolidMeter& meter)
    : meter_(meter),
      scale_(std::max(norm(meter.clearance().blank().box().high - meter.clearance().blank().box().low),
                      2 * meter.frame().reach)),
      rounding_(0x1p-40 * (meter.far() + 8 * scale_)) {}

KnownSolid SolidBounds::known(const SolidContact& contact, const Motion& motion) const {
  const Vector n = (1 - 0x1p-50) * contact.normal;
  return {ladder(meter_.clearance().part(), contact.part, motion.turned_back(contact.normal), true, scale_),
          ladder(meter_.clearance().blank(), contact.blank, -contact.normal, false, scale_), n,
          least_along(meter_.clearance().blank(), n)};
}

SolidRow SolidBounds::row(const SolidBall& part, Vector normal, double least, const CellView& cell) const {
  const SolidFrame& frame = meter_.frame();
  const Vector p = cell.motion.turned(part.centre - frame.pivot), lever = cross(p, normal);
  const Vector g = 1 / frame.reach * lever;
  return {{{normal.x, normal.y, normal.z, g.x, g.y, g.z},
           dot(normal, p) + dot(normal, cell.at) - part.radius - least + bend(normal, p, lever, cell)},
          kInfinity};
}

SolidRow SolidBounds::row(const SolidBall& part, const SolidBall& blank, const CellView& cell) const {
  const SolidFrame& frame = meter_.frame();
  const Vector p = cell.motion.turned(part.centre - frame.pivot), w = p + cell.at - blank.centre;
  const double distance = norm(w), far = norm(p), y = cell.turn_norm, radii = part.radius + blank.radius;
  // No pose of the cell moves the centre farther than this.
  const double anyway = cell.slide_norm + 2 * y * far;
  SolidRow row{{{}, distance - radii + anyway}, blank.radius};
  if (!(distance > 0)) return row;
  const Vector u = 1 / distance * w, lever = cross(p, u);
  const double rest = 2 * y * y * far * (1 + y);
  const auto along = [&](Vector e, Vector its_lever) {
    return dot(absolute(e), cell.slide) + 2 * dot(absolute(its_lever), cell.turn) + rest;
  };
  const double nearer = along(u, lever);
  if (!(distance > nearer)) return row;
  const Vector e = any_across(u), f = cross(u, e);
  const double across_e = along(e, cross(p, e)), across_f = along(f, cross(p, f));
  const double curved =
      (across_e * across_e + across_f * across_f) / (2 * (distance - nearer)) + bend(u, p, lever, cell);
  if (!(curved < anyway)) return row;
  const Vector g = 1 / frame.reach * lever;
  row.bound = {{u.x, u.y, u.z, g.x, g.y, g.z}, distance - radii + curved};
  return row;
}

SolidRow SolidBounds::row(const KnownSolid& known, const CellView& cell) const {
  const SolidFrame& frame = meter_.frame();
  const double y = cell.turn_norm;
  double best = kInfinity;
  std::size_t of_part = 0, of_blank = 0;
  for (std::size_t i = 0; i < known.part.size(); ++i) {
    const SolidBall& part = known.part[i];
    const Vector p = cell.motion.turned(part.centre - frame.pivot), place = p + cell.at;
    const double far = norm(p), moves = cell.slide_norm + 2 * y * far;
    for (std::size_t j = 0; j <= known.blank.size(); ++j) {
      double level;
      if (j == known.blank.size()) {
        const double along = dot(known.normal, p);
        level = along + dot(known.normal, cell.at) - part.radius - known.least + y * y * (far - along);
      } else {
        const Vector w = place - known.blank[j].centre;
        const double distance = norm(w), bent = y * y * (far - dot(w, p) / std::max(distance, 1e-300));
        level = distance - part.radius - known.blank[j].radius +
                std::min(moves, moves * moves / (2 * distance) + bent);
      }
      if (level < best) best = level, of_part = i, of_blank = j;
    }
  }
  const SolidBall& part = known.part[of_part];
  return of_blank == known.blank.size() ? row(part, known.normal, known.least, cell)
                                        : row(part, known.blank[of_blank], cell);
}

}  // namespace lekalo::locate
