#include "solid_bound.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::TriangleTree;
using solid::Vector;

/// The balls of a contact are so many times smaller than part and blank together, and each one larger than
/// the one before by this.
constexpr double kSmallestBall = 1.0 / 1024, kLadder = 3;
/// A ball that stays away from the contact by more than this part of its way to the middle says little.
constexpr double kMostLoss = 0.5;
/// Edges at a smaller angle than this are taken for points.
constexpr double kLeastSine = 0.02;

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

/// n . R p exceeds n . p + 2 (p x n) . y by no more than this, for a rotation R with y in the cell:
/// docs/design/ locate-solid.md has the two bounds of the second order.
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

/// The edge of a triangle within which a point lies, farther than `off` from both ends.
std::optional<SolidEdge> edge_at(const solid::Mesh& mesh, std::uint32_t triangle, Vector place, double off) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& t = mesh.triangles[triangle];
    const Vector from = mesh.vertices[t[k]], to = mesh.vertices[t[(k + 1) % 3]];
    const double length = norm(to - from), along = dot(to - from, place - from) / length;
    if (along > off && along < length - off && norm(place - from - along / length * (to - from)) < off)
      return SolidEdge{from, to};
  }
  return std::nullopt;
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
      of_part_(meter.part()),
      of_blank_(meter.blank()),
      scale_(std::max(norm(meter.clearance().blank().box().high - meter.clearance().blank().box().low),
                      2 * meter.frame().reach)),
      rounding_(0x1p-40 * (meter.far() + 8 * scale_)) {}

KnownSolid SolidBounds::known(const SolidContact& contact, const Motion& motion) const {
  const Vector n = (1 - 0x1p-50) * contact.normal, in_part = motion.turned_back(contact.normal);
  KnownSolid made{ladder(meter_.clearance().part(), contact.part, in_part, true, scale_),
                  ladder(meter_.clearance().blank(), contact.blank, -contact.normal, false, scale_),
                  {},
                  {},
                  {},
                  n,
                  least_along(meter_.clearance().blank(), n)};
  if (contact.part_triangle == kNoTriangle) return made;
  // The plane of a disc is that of its triangle, in so far as rounding lets its normal be found.
  const auto disc = [&](const solid::FlatPatches& patches, const solid::Mesh& mesh, std::uint32_t triangle,
                        Vector place, Vector towards) {
    const double radius = patches.disc(triangle, place, 0.25 * rounding_) - rounding_;
    if (!(radius > 0)) return SolidDisc{};
    const auto& t = mesh.triangles[triangle];
    const Vector from = mesh.vertices[t[0]],
                 across = cross(mesh.vertices[t[1]] - from, mesh.vertices[t[2]] - from);
    const double side = dot(across, towards) < 0 ? -1 : 1;
    return SolidDisc{place, side / norm(across) * across, radius};
  };
  made.part_disc = disc(of_part_, meter_.part(), contact.part_triangle, contact.part, in_part);
  made.blank_disc = disc(of_blank_, meter_.blank(), contact.blank_triangle, contact.blank, contact.normal);
  const auto of_part = edge_at(meter_.part(), contact.part_triangle, contact.part, rounding_),
             of_blank = edge_at(meter_.blank(), contact.blank_triangle, contact.blank, rounding_);
  if (of_part && of_blank) made.edges = {*of_part, *of_blank};
  return made;
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

std::optional<SolidRow> SolidBounds::row(const SolidBall& part, const SolidDisc& blank,
                                         const CellView& cell) const {
  const SolidFrame& frame = meter_.frame();
  const double y = cell.turn_norm;
  const Vector n = blank.normal, p = cell.motion.turned(part.centre - frame.pivot),
               w = p + cell.at - blank.centre, lever = cross(p, n);
  const double height = dot(n, w), rest = 2 * y * y * norm(p) * (1 + y);
  const auto moves = [&](Vector e, Vector its_lever) {
    return dot(absolute(e), cell.slide) + 2 * dot(absolute(its_lever), cell.turn) + rest;
  };
  // The ball's lowest point stays above the disc.
  if (!(height - part.radius > moves(n, lever))) return std::nullopt;
  const Vector e = any_across(n), f = cross(n, e);
  const double off_e = std::abs(dot(e, w)) + moves(e, cross(p, e)),
               off_f = std::abs(dot(f, w)) + moves(f, cross(p, f));
  if (!(off_e * off_e + off_f * off_f < blank.radius * blank.radius)) return std::nullopt;
  const Vector g = 1 / frame.reach * lever;
  return SolidRow{
      {{n.x, n.y, n.z, g.x, g.y, g.z}, height - part.radius + bend(n, p, lever, cell) + rounding_}};
}

std::optional<SolidRow> SolidBounds::row(const SolidDisc& part, const SolidBall& blank,
                                         const CellView& cell) const {
  // As the part sees it: the ball is turned back by the rotation, and its height over the disc is n . (a -
  // c).
  const SolidFrame& frame = meter_.frame();
  const double y = cell.turn_norm;
  const Vector n = cell.motion.turned(part.normal), c = blank.centre - cell.at,
               w = cell.motion.turned(part.centre - frame.pivot) - c, lever = cross(c, n);
  // A shift that is turned back differs from itself by this.
  const double turned = 2 * y * cell.slide_norm, rest = 2 * y * y * norm(c) * (1 + y) + turned;
  const auto moves = [&](Vector e, Vector its_lever) {
    return dot(absolute(e), cell.slide) + 2 * dot(absolute(its_lever), cell.turn) + rest;
  };
  const double height = dot(n, w);
  if (!(height - blank.radius > moves(n, lever))) return std::nullopt;
  const Vector e = any_across(n), f = cross(n, e);
  const double off_e = std::abs(dot(e, w)) + moves(e, cross(c, e)),
               off_f = std::abs(dot(f, w)) + moves(f, cross(c, f));
  if (!(off_e * off_e + off_f * off_f < part.radius * part.radius)) return std::nullopt;
  const Vector g = 1 / frame.reach * lever;
  return SolidRow{{{n.x, n.y, n.z, g.x, g.y, g.z},
                   height - blank.radius + bend(-n, c, lever, cell) + turned + rounding_}};
}

std::optional<SolidRow> SolidBounds::row(const SolidEdge& part, const SolidEdge& blank,
                                         const CellView& cell) const {
  const SolidFrame& frame = meter_.frame();
  const Vector a = cell.motion.turned(part.from - frame.pivot), ab = cell.motion.turned(part.to - part.from),
               cd = blank.to - blank.from;
  const double ab_length = norm(ab), cd_length = norm(cd);
  const Vector e = 1 / ab_length * ab, f = 1 / cd_length * cd, across = cross(e, f);
  const double sine = norm(across);
  if (!(sine > kLeastSine)) return std::nullopt;
  const Vector w = a + cell.at - blank.from;
  const Vector n = (dot(across, w) < 0 ? -1 : 1) / sine * across;
  // The places on the edges that are nearest at the middle of the cell: w + s e - t f is along n.
  const Vector by_e = cross(n, e), by_f = cross(n, f);
  const double s = -dot(w, by_f) / dot(e, by_f), t = dot(w, by_e) / dot(f, by_e);
  const Vector p = a + s * e, lever = cross(p, n);
  const double y = cell.turn_norm, rest = 2 * y * y * norm(p) * (1 + y), height = dot(n, w);
  const auto moves = [&](Vector d, Vector its_lever) {
    return dot(absolute(d), cell.slide) + 2 * dot(absolute(its_lever), cell.turn) + rest;
  };
  // As the part moves, they move along the edges so that nothing goes across, by no more than this.
  const double of_part = moves(by_f, cross(p, by_f)) / sine, of_blank = moves(by_e, cross(p, by_e)) / sine;
  if (!(of_part < std::min(s, ab_length - s)) || !(of_blank < std::min(t, cd_length - t)))
    return std::nullopt;
  // The part's edge turns, too: what that lifts its place, and what it moves it across.
  const double lifts = of_part * (2 * dot(absolute(cross(e, n)), cell.turn) + 2 * y * y * (1 + y)),
               sideways = of_part * 2 * y, nearer = moves(n, lever) + lifts;
  if (!(height > nearer)) return std::nullopt;
  const Vector g = 1 / frame.reach * lever;
  return SolidRow{
      {{n.x, n.y, n.z, g.x, g.y, g.z},
       height + bend(n, p, lever, cell) + lifts + sideways * sideways / (2 * (height - nearer)) + rounding_}};
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
  SolidRow chosen = of_blank == known.blank.size() ? row(part, known.normal, known.least, cell)
                                                   : row(part, known.blank[of_blank], cell);
  const auto take = [&](const std::optional<SolidRow>& other) {
    if (other && other->bound.level < chosen.bound.level) chosen = *other;
  };
  if (known.blank_disc.radius > 0)
    for (const SolidBall& ball : known.part) take(row(ball, known.blank_disc, cell));
  if (known.part_disc.radius > 0)
    for (const SolidBall& ball : known.blank) take(row(known.part_disc, ball, cell));
  if (known.edges) take(row(known.edges->first, known.edges->second, cell));
  return chosen;
}

}  // namespace lekalo::locate
