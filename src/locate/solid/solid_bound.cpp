#include "solid_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
/// A point of contact is a ball as far inside as this part of part and blank together, and as so many times
/// what the surface may be off: farther in by far than the rounding of distances beside a corner.
constexpr double kPoint = 0x1p-25, kErrors = 4;
/// Triangles this near to a point, as a part of part and blank together, have it; normals are the same if
/// their product is this.
constexpr double kAtPlace = 0x1p-36, kSameNormal = 0.999;
/// No face is used that is so many times longer than wide.
constexpr double kMostSlender = 4096;
/// No edges are used the sine of whose angle is below this; nor in a box where it may become, as seen along
/// the normal of both at the middle, less than so much of what it is there.
constexpr double kLeastAngle = 1.0 / 64, kLeastShare = 0.25;
/// Coordinates and lengths are rounded to 2^-53 of themselves, a few times.
constexpr double kRounding = 0x1p-50;

/// The least of n . p over the triangles of a mesh, each with its width, if they have some, none of which is
/// below `narrowest`.
double least_along(const TriangleTree& tree, Vector n, const std::vector<double>& widths, double narrowest) {
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
    if (lowest(node.box) + narrowest >= least) continue;
    if (node.right == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        const double width = widths.empty() ? 0 : widths[tree.triangle(k)];
        for (const Vector p : tree.corners(k)) least = std::min(least, dot(n, p) + width);
      }
      continue;
    }
    std::uint32_t one = at + 1, other = node.right;
    if (lowest(tree.nodes()[other].box) < lowest(tree.nodes()[one].box)) std::swap(one, other);
    open.push_back(other);
    open.push_back(one);
  }
  return least;
}

/// The normal of a triangle, and none if it has no area.
Vector normal_of(const solid::Corners& t) {
  const Vector across = cross(t[1] - t[0], t[2] - t[0]);
  const double length = norm(across);
  return length > 0 ? 1 / length * across : Vector{};
}

bool has(const solid::Corners& t, Vector normal, Vector place, double within) {
  if (!(std::abs(dot(normal, place - t[0])) <= within)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector along = t[(k + 1) % 3] - t[k];
    if (!(dot(cross(normal, along), place - t[k]) >= -within * norm(along))) return false;
  }
  return true;
}

/// The middle of the directions that the triangles at a place look in: where several meet, as on an edge, a
/// ball off along it can be larger than one off along the direction of a contact.
Vector middle_normal(const TriangleTree& tree, Vector place, double within) {
  std::vector<Vector> normals;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const TriangleTree::Node& node = tree.nodes()[at];
    const Vector low = node.box.low, high = node.box.high;
    if (place.x < low.x - within || place.y < low.y - within || place.z < low.z - within ||
        place.x > high.x + within || place.y > high.y + within || place.z > high.z + within)
      continue;
    if (node.right != 0) {
      open.push_back(node.right);
      open.push_back(at + 1);
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      const Vector n = normal_of(tree.corners(k));
      if (has(tree.corners(k), n, place, within) &&
          std::none_of(normals.begin(), normals.end(), [&](Vector m) { return dot(m, n) > kSameNormal; }))
        normals.push_back(n);
    }
  }
  Vector sum;
  for (const Vector n : normals) sum = sum + n;
  const double length = norm(sum);
  return length > 0.01 ? 1 / length * sum : Vector{};
}

/// The term of two edges, or none where they are not seen to cross all over the box along the direction in
/// which they pass each other at its middle.
std::optional<SolidForm> form_of(const SolidEdges& e, const CellView& cell) {
  const Vector d = cell.turned.turned(e.d), passes = cross(d, e.g);
  const double angle = norm(passes), of_d = norm(e.d), of_g = norm(e.g);
  if (!(angle > kLeastAngle * of_d * of_g)) return std::nullopt;
  const double side = dot(passes, cell.turned.turned(e.p) + cell.middle.at - e.q) < 0 ? -1 : 1;
  const Vector u = side / angle * passes, g = side / angle * e.g, beside = cross(1 / of_g * e.g, side * u);
  const Vector p1 = e.p + e.d, q1 = e.q + e.g, d1 = side / of_d * e.d;
  // A corner that is off turns its edge, and moves the other one's foot far away by so much.
  const double loss = e.off * (2 + 8 * cell.far * (of_d + of_g) / angle), foot = dot(beside, e.q);
  PoseForm form = passing(e.p, e.d, e.q, g, loss, cell);
  const Vector turn = cross(g, u);
  form.whole_turned = {turn.x * e.d, turn.y * e.d, turn.z * e.d};
  PoseForm seen = form;
  seen.constant = -kLeastShare, seen.across = {}, seen.turned = form.whole_turned;
  for (const PoseForm& condition :
       {form, seen, height(-beside, e.p, loss - foot, cell), height(beside, p1, foot + loss, cell),
        passing(e.p, -d1, e.q, u, loss, cell), passing(e.p, d1, q1, u, loss, cell)})
    if (!condition.never_negative(cell)) return std::nullopt;
  form.constant += 2 * loss;
  form.size += of_d * of_g / angle * cell.far / kLeastShare;
  for (std::size_t i = 0; i < 3; ++i) form.turned[i] = form.turned[i] - e.width * form.whole_turned[i];
  return SolidForm{form, 0};
}

}  // namespace

SolidBounds::SolidBounds(const SolidMeter& meter)
    : meter_(meter),
      scale_(std::max(norm(meter.clearance().blank().box().high - meter.clearance().blank().box().low),
                      2 * meter.frame().reach)),
      part_{meter.part(), meter.clearance().part(), true, meter.part_error(), none_},
      blank_{meter.blank(), meter.clearance().blank(), false, meter.blank_error() + meter.width_error(),
             meter.widths()} {}

/// A distance from the surface may be off by this, mm.
double SolidBounds::off(const Side& side, Vector centre) const {
  return side.error + kRounding * (side.tree.largest() + norm(centre));
}

/// The largest ball about a centre that lies on the right side of the surface of the file.
std::optional<SolidBall> SolidBounds::ball(const Side& side, Vector centre, std::uint32_t near) const {
  if (side.tree.holds(centre) != side.material) return std::nullopt;
  std::optional<std::uint32_t> hint;
  if (near != kNoTriangle) hint = near;
  const double far = side.widths.empty() ? side.tree.nearest(centre, kInfinity, hint)->low
                                         : side.tree.least_sum(centre, side.widths, 1, meter_.narrowest());
  const double radius = far - off(side, centre);
  if (!(radius > 0)) return std::nullopt;
  return SolidBall{centre, radius};
}

/// Balls about places farther and farther from a contact, each as large as the surface leaves it: along its
/// direction, and along the middle of the directions of the surface there.
std::vector<SolidBall> SolidBounds::balls(const Side& side, std::uint32_t triangle, Vector from,
                                          Vector direction, double farthest) const {
  const Vector middle = middle_normal(side.tree, from, kAtPlace * scale_);
  std::vector<SolidBall> made;
  std::vector<Vector> ways{direction};
  for (const Vector way : {-middle, middle})
    if (dot(way, direction) < kSameNormal && dot(way, way) > 0) ways.push_back(way);
  SolidBall point;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const auto beside = ball(side, from + (kPoint * scale_ + kErrors * side.error) * ways[k], triangle);
    if (!beside) continue;
    if (beside->radius > point.radius) point = *beside;
    for (double way = kSmallestBall * scale_; way <= farthest; way *= kLadder) {
      const auto next = ball(side, from + way * ways[k], triangle);
      if (!next || !(next->radius > (1 - kMostLoss) * way)) break;
      made.push_back(*next);
    }
  }
  if (point.radius > 0) made.insert(made.begin(), point);
  return made;
}

std::optional<SolidFace> SolidBounds::face(const Side& side, std::uint32_t triangle) const {
  if (triangle == kNoTriangle) return std::nullopt;
  const auto& t = side.mesh.triangles[triangle];
  SolidFace made;
  made.triangle = triangle;
  for (std::size_t k = 0; k < 3; ++k) made.corner[k] = side.mesh.vertices[t[k]];
  const Vector across = cross(made.corner[1] - made.corner[0], made.corner[2] - made.corner[0]);
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(made.corner[(k + 1) % 3] - made.corner[k]));
  const double area = norm(across), altitude = area / longest;
  if (!(altitude * kMostSlender > longest)) return std::nullopt;
  made.normal = 1 / area * across;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector along = made.corner[(k + 1) % 3] - made.corner[k];
    made.inward[k] = 1 / norm(along) * cross(made.normal, along);
  }
  // A corner that is off by d turns the plane by 2 d / altitude at most, and a height far away by so much.
  const double off = side.error + kRounding * (side.tree.largest() + longest);
  made.loss = off * (2 + 8 * meter_.far() / altitude);
  return made;
}

/// A place on a triangle of the part, as a certificate can name it.
SolidPoint SolidBounds::point_of(std::uint32_t triangle, Vector place) const {
  // Places on a triangle are whole numbers of this part of its sides, which decimals hold.
  constexpr double kSteps = 1e9;
  const solid::Mesh& mesh = meter_.cut() != nullptr ? meter_.cut()->part() : part_.mesh;
  const std::uint32_t number = meter_.number(triangle);
  const auto& t = mesh.triangles[number];
  const Vector from = mesh.vertices[t[0]], a = mesh.vertices[t[1]] - from, b = mesh.vertices[t[2]] - from,
               w = place - from;
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), whole = aa * bb - ab * ab;
  const auto share = [&](double of) { return whole > 0 ? std::clamp(of / whole, 0.0, 1.0) : 0; };
  const double u = std::round(kSteps * share(bb * dot(a, w) - ab * dot(b, w))),
               v = std::min(std::round(kSteps * share(aa * dot(b, w) - ab * dot(a, w))), kSteps - u);
  return {number, u / kSteps, v / kSteps};
}

Vector SolidBounds::place_of(const SolidPoint& point) const {
  const solid::Mesh& mesh = meter_.cut() != nullptr ? meter_.cut()->part() : part_.mesh;
  const auto& t = mesh.triangles[point.triangle];
  const Vector from = mesh.vertices[t[0]];
  return from + point.u * (mesh.vertices[t[1]] - from) + point.v * (mesh.vertices[t[2]] - from);
}

/// The point of a contact, or one beside it that lies in no rim.
std::optional<SolidPoint> SolidBounds::demanded_point(const SolidContact& contact) const {
  const std::uint32_t triangle = contact.demanded_triangle;
  SolidPoint found = point_of(triangle, contact.part);
  const CutPart* const cut = meter_.cut();
  if (cut == nullptr || cut->is_clear(place_of(found))) return found;
  // The nearest ones that are clear are looked for on the ways to the corners of the piece.
  std::array<Vector, 3> ways{};
  for (std::size_t k = 0; k < 3; ++k)
    ways[k] = part_.mesh.vertices[part_.mesh.triangles[triangle][k]] - contact.part;
  for (double share = 0x1p-24; share <= 1; share *= 2)
    for (const Vector way : ways) {
      found = point_of(triangle, contact.part + share * way);
      if (cut->is_clear(place_of(found))) return found;
    }
  return std::nullopt;
}

/// Makes a point of the part known.
void SolidBounds::set_point(const SolidContact& contact, SolidPoint on_part, const Motion& start,
                            KnownSolid& made) const {
  made.on_part = on_part;
  made.demand = contact.demand;
  const Vector place = place_of(on_part);
  made.point = {{place, 0}, start.turned(place - meter_.frame().pivot), off(part_, place)};
}

/// No bound of the margin is below this where a term holds only if the allowance is not below another.
/// Without a demand it is that of any.
double SolidBounds::least_margin(double allowance, const SolidDemand* demand) const {
  const auto of = [allowance](const SolidDemand& d) {
    // The rounding of the demand counts.
    return (allowance - d.minimum + kRounding * d.minimum) / d.scale;
  };
  if (demand != nullptr) return of(*demand);
  double least = -kInfinity;
  for (const SolidDemand& one : meter_.demands()) least = std::max(least, of(one));
  return least;
}

double SolidBounds::most(const PoseForm& sum, const PoseForm& open, const CellView& cell) const {
  if (!(open.size > 0)) return sum.most(cell);
  // The least demand asks for less than a straight line would, so each step is below the bound, or there.
  SolidDemand least = meter_.least_demand(0);
  double most = -kInfinity;
  for (std::size_t step = 0; step <= meter_.demands().size(); ++step) {
    PoseForm all = open;
    all.take_off(least);
    all.add(1, sum);
    most = std::max(most, all.most(cell));
    const SolidDemand& next = meter_.least_demand(most);
    if (next == least) break;
    least = next;
  }
  return most;
}

/// The two edges on which the points of a contact lie.
std::optional<SolidEdges> SolidBounds::edges(const SolidContact& contact, const Motion& start) const {
  if (contact.part_triangle == kNoTriangle) return std::nullopt;
  struct Edge {
    std::uint32_t number = 0;
    Vector from, along;
  };
  const auto edge_at = [&](const solid::Mesh& mesh, std::uint32_t triangle,
                           Vector place) -> std::optional<Edge> {
    const auto& t = mesh.triangles[triangle];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vector from = mesh.vertices[t[k]], along = mesh.vertices[t[(k + 1) % 3]] - from;
      if (norm(cross(along, place - from)) <= kAtPlace * scale_ * norm(along))
        return Edge{3 * triangle + k, from, along};
    }
    return std::nullopt;
  };
  const auto of_part = edge_at(part_.mesh, contact.part_triangle, contact.part),
             of_blank = edge_at(blank_.mesh, contact.blank_triangle, contact.blank);
  if (!of_part || !of_blank) return std::nullopt;
  return SolidEdges{3 * meter_.number(of_part->number / 3) + of_part->number % 3,
                    of_blank->number,
                    start.turned(of_part->from - meter_.frame().pivot),
                    start.turned(of_part->along),
                    of_blank->from,
                    of_blank->along,
                    part_.error + blank_.error + kRounding * (part_.tree.largest() + blank_.tree.largest()),
                    std::max(0.0, meter_.width(contact.blank_triangle) - meter_.width_error())};
}

/// A point of a datum that is held.
KnownSolid SolidBounds::held(const SolidContact& contact, const Motion& start) const {
  const Vector seen = start.turned(contact.part - meter_.frame().pivot);
  KnownSolid made;
  made.held = SolidHeld{{contact.datum, contact.datum_point}, seen, -1 / kDatumWeight * contact.normal};
  return made;
}

/// The rest that is left of the tolerance of a datum in a direction. The bound of margins has no part in it.
PoseForm SolidBounds::form_of(const SolidHeld& held, const CellView& cell) const {
  const SolidDatum& datum = meter_.datums()[held.point.datum];
  const Vector u = held.direction;
  PoseForm form = height(-u, held.seen, -(datum.within + meter_.datum_loss() + dot(u, datum.at)), cell);
  form.size += norm(datum.at);
  form.whole = 0;
  return form;
}

void SolidBounds::set_plane(Vector normal, KnownSolid& made) const {
  const double least = least_along(blank_.tree, normal, blank_.widths, meter_.narrowest());
  made.plane = {normal, least - blank_.error - 4 * kRounding * (blank_.tree.largest() + std::abs(least))};
}

/// A point that is to be near the blank's surface, and a body in which it is not.
std::optional<KnownSolid> SolidBounds::away(const SolidContact& contact, const Motion& start,
                                            const Motion& motion) const {
  const FarPoint point =
      NearFace::point_at(meter_.clearance().blank(), motion, contact.part, contact.demanded_triangle);
  const double error = meter_.blank_error() + kRounding * (meter_.far() + scale_);
  // The distance of the body is written as a decimal, which may be a little less.
  const double apart = meter_.nears()[contact.near].demand().within * (1 + 0x1p-50);
  const auto body = body_beside(meter_.bare_clearance(), meter_.blank_points(), point, apart, error, scale_);
  if (!body) return std::nullopt;
  KnownSolid made;
  set_point(contact, point_of(contact.demanded_triangle, contact.part), start, made);
  made.away = SolidAway{made.point->seen, made.point->loss, *body, sides_of(*body)};
  made.point.reset();
  return made;
}

/// The side of the body on which the point may be outside of it somewhere in the box: the only one, or that
/// on which it is the least inside. None where there are several.
std::optional<std::uint16_t> SolidBounds::side_in_doubt(const SolidAway& away, const CellView& cell) const {
  std::optional<std::uint16_t> doubtful;
  std::uint16_t lowest = 0;
  double least = kInfinity;
  const Vector there = cell.turned.turned(away.seen) + cell.middle.at;
  for (std::uint16_t s = 0; s < away.sides.size(); ++s) {
    const auto& [normal, from] = away.sides[s];
    if (const double above = dot(normal, there) - from; above < least) least = above, lowest = s;
    if (height(normal, away.seen, from + away.loss, cell).never_negative(cell)) continue;
    if (doubtful) return std::nullopt;
    doubtful = s;
  }
  return doubtful.value_or(lowest);
}

/// How far the point is outside of the body on one side. The bound of margins has no part in it.
PoseForm SolidBounds::form_of(const SolidAway& away, std::uint16_t side, const CellView& cell) const {
  const auto& [normal, least] = away.sides[side];
  PoseForm form = height(-normal, away.seen, -least - away.loss, cell);
  form.whole = 0;
  return form;
}

std::optional<KnownSolid> SolidBounds::known(const SolidContact& contact, const FramedPose& pose) const {
  const SolidFrame& frame = meter_.frame();
  const Motion start = motion_of({frame.start_of(pose.chart), {}}), motion = frame.motion(pose);
  if (contact.datum != kNoTriangle) return held(contact, start);
  if (contact.near != kNoTriangle) return away(contact, start, motion);
  const Vector n = contact.normal;
  KnownSolid made;
  const auto seen = [&](Vector p) { return start.turned(p - frame.pivot); };
  if (meter_.has_demands())
    if (const auto point = demanded_point(contact)) set_point(contact, *point, start, made);
  // Balls in the part count with the least demand, so where more is asked for they say little.
  const auto make_part = [&](double largest) {
    for (const SolidBall& one :
         balls(part_, contact.part_triangle, contact.part, motion.turned_back(n), largest))
      made.part.push_back({one, seen(one.centre)});
  };
  if (contact.of_plane) {
    make_part(0);
    if (made.part.empty()) return std::nullopt;
    set_plane(n, made);
    return made;
  }
  if (meter_.whole() && made.demand == meter_.least_demand(0)) make_part(2 * scale_);
  made.blank = balls(blank_, contact.blank_triangle, contact.blank, -n, 2 * scale_);
  if (contact.blank_triangle != kNoTriangle) {
    // The largest width of neighbours counts here, and beside the surface the smallest.
    const double within = meter_.width(contact.blank_triangle) - 4 * off(blank_, contact.blank);
    if (within > 0) made.blank.insert(made.blank.begin(), {contact.blank, within});
  }
  if ((made.part.empty() && !made.point) || made.blank.empty()) return std::nullopt;
  made.blank_face = face(blank_, contact.blank_triangle);
  // No certificate names pieces of triangles.
  if (meter_.cut() == nullptr || contact.part_triangle == kNoTriangle ||
      meter_.cut()->is_clear(contact.part_triangle)) {
    made.part_face = face(part_, contact.part_triangle);
    made.edges = edges(contact, start);
  }
  if (made.blank_face)
    made.blank_face->width = std::max(0.0, meter_.width(contact.blank_triangle) - meter_.width_error());
  Vector across = n;
  if (made.blank_face) {
    // Contacts of one face have one plane.
    const Vector of_face = made.blank_face->normal;
    if (std::abs(dot(of_face, n)) > 1 - 0x1p-30) across = dot(of_face, n) < 0 ? -of_face : of_face;
  }
  set_plane(across, made);
  if (made.part_face) {
    SolidFace& f = *made.part_face;
    f.triangle = meter_.number(f.triangle);
    f.normal = start.turned(f.normal);
    for (std::size_t k = 0; k < 3; ++k) {
      f.corner[k] = seen(f.corner[k]);
      f.inward[k] = start.turned(f.inward[k]);
    }
  }
  return made;
}

std::optional<SolidForm> SolidBounds::form(const KnownSolid& known, SolidChoice choice,
                                           const CellView& cell) const {
  if (known.held) return SolidForm{form_of(*known.held, cell), -kInfinity};
  if (known.away) {
    for (std::size_t s = 0; s < known.away->sides.size(); ++s) {
      const auto& [normal, least] = known.away->sides[s];
      if (s != choice.part &&
          !height(normal, known.away->seen, least + known.away->loss, cell).never_negative(cell))
        return std::nullopt;
    }
    return SolidForm{form_of(*known.away, choice.part, cell), -kInfinity};
  }
  auto made = form_of_allowance(known, choice, cell);
  if (!made) return std::nullopt;
  const bool of_ball = choice.kind == SolidTerm::Kind::ball || choice.kind == SolidTerm::Kind::plane ||
                       choice.kind == SolidTerm::Kind::face;
  const SolidDemand* const demand = !of_ball                      ? &known.demand
                                    : meter_.demands().size() > 1 ? nullptr
                                                                  : &meter_.demands().front();
  if (made->least > -kInfinity) made->least = least_margin(made->least, demand);
  made->open = demand == nullptr;
  if (demand != nullptr) made->form.take_off(*demand), made->scale = demand->scale;
  return made;
}

/// The form bounds the allowance, unless that is below `least`.
std::optional<SolidForm> SolidBounds::form_of_allowance(const KnownSolid& known, SolidChoice choice,
                                                        const CellView& cell) const {
  const bool of_point = choice.kind == SolidTerm::Kind::point ||
                        choice.kind == SolidTerm::Kind::point_plane ||
                        choice.kind == SolidTerm::Kind::point_face;
  switch (choice.kind) {
    case SolidTerm::Kind::ball:
    case SolidTerm::Kind::point: {
      const KnownSolid::PartBall& part = of_point ? *known.point : known.part[choice.part];
      const SolidBall& blank = known.blank[choice.blank];
      const double l = norm(cell.turned.turned(part.seen) + cell.middle.at - blank.centre);
      if (!(l > kRounding * cell.far)) return std::nullopt;
      return SolidForm{distance(part.seen, blank.centre, l, part.radius() + blank.radius, cell),
                       of_point ? -kInfinity : -blank.radius};
    }
    case SolidTerm::Kind::plane:
    case SolidTerm::Kind::point_plane: {
      const KnownSolid::PartBall& part = of_point ? *known.point : known.part[choice.part];
      return SolidForm{height(known.plane.normal, part.seen, known.plane.least + part.radius(), cell),
                       -kInfinity};
    }
    case SolidTerm::Kind::face:
    case SolidTerm::Kind::point_face: {
      const KnownSolid::PartBall& part = of_point ? *known.point : known.part[choice.part];
      const SolidFace& f = *known.blank_face;
      const Vector p = part.seen, w = cell.turned.turned(p) + cell.middle.at - f.corner[0];
      const Vector n = dot(f.normal, w) < 0 ? -f.normal : f.normal;
      const double least = dot(n, f.corner[0]), loss = f.loss + part.loss;
      if (!height(n, p, least + loss, cell).never_negative(cell)) return std::nullopt;
      for (std::size_t k = 0; k < 3; ++k)
        if (!height(f.inward[k], p, dot(f.inward[k], f.corner[k]) + loss, cell).never_negative(cell))
          return std::nullopt;
      return SolidForm{height(n, p, least + part.radius() + f.width - f.loss, cell), 0};
    }
    case SolidTerm::Kind::edges:
      return lekalo::locate::form_of(*known.edges, cell);
    case SolidTerm::Kind::datum:
    case SolidTerm::Kind::near:
    case SolidTerm::Kind::part_face:
      break;
  }
  const SolidBall& blank = known.blank[choice.blank];
  const SolidFace& f = *known.part_face;
  const Vector c = blank.centre, w = c - cell.middle.at - cell.turned.turned(f.corner[0]);
  const Vector n = dot(cell.turned.turned(f.normal), w) < 0 ? -f.normal : f.normal;
  const double least = dot(n, f.corner[0]);
  if (!height_seen(n, c, least + f.loss, cell).never_negative(cell)) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k)
    if (!height_seen(f.inward[k], c, dot(f.inward[k], f.corner[k]) + f.loss, cell).never_negative(cell))
      return std::nullopt;
  return SolidForm{height_seen(n, c, least + blank.radius - f.loss, cell), 0};
}

double SolidBounds::level(const KnownSolid& known, SolidChoice choice, const CellView& cell) const {
  auto term = form(known, choice, cell);
  if (!term) return kInfinity;
  close(*term, cell);
  return term->form.tangent(cell).level;
}

/// Takes the least demand off an open form: that at what is left of the least at 0 is good enough for rows.
void SolidBounds::close(SolidForm& term, const CellView& cell) const {
  if (!term.open) return;
  PoseForm at_first = term.form;
  at_first.take_off(meter_.least_demand(0));
  const SolidDemand& demand = meter_.least_demand(at_first.tangent(cell).level);
  term.form.take_off(demand), term.scale = demand.scale;
}

std::optional<SolidRow> SolidBounds::row(const KnownSolid& known, const CellView& cell) const {
  if (known.held || known.away) {
    SolidChoice choice{known.held ? SolidTerm::Kind::datum : SolidTerm::Kind::near, 0, 0};
    if (known.away) {
      const auto side = side_in_doubt(*known.away, cell);
      if (!side) return std::nullopt;
      choice.part = *side;
    }
    PoseForm above;
    above.add(kDatumWeight,
              known.held ? form_of(*known.held, cell) : form_of(*known.away, choice.part, cell));
    above.constant += meter_.beyond_margins();
    above.whole = 1;
    return SolidRow{above.tangent(cell), choice, 1 / kDatumWeight};
  }
  const double y = cell.turn, slide = norm(cell.slide);
  const Vector at = cell.middle.at;
  /// The best of each kind, by what it says at the middle and about what it loses beside it.
  struct Best {
    double level = kInfinity;
    SolidChoice choice;
  };
  Best plain, face, part_face, edges, point, point_face;
  using Kind = SolidTerm::Kind;
  const auto take = [](Best& best, double level, SolidChoice choice) {
    if (level < best.level) best = {level, choice};
  };
  const auto look = [&](const KnownSolid::PartBall& part, std::uint16_t i, std::array<Kind, 3> kinds,
                        Best& free, Best& over_face) {
    const double radius = part.radius();
    const Vector p = cell.turned.turned(part.seen), place = p + at;
    const double far = norm(p), moves = slide + 2 * y * far;
    const double along = dot(known.plane.normal, p);
    take(free, along + dot(known.plane.normal, at) - radius - known.plane.least + y * y * (far - along),
         {kinds[1], i, 0});
    for (std::uint16_t j = 0; j < known.blank.size(); ++j) {
      const Vector w = place - known.blank[j].centre;
      const double distance = norm(w), bent = y * y * (far - dot(w, p) / std::max(distance, 1e-300));
      take(free,
           distance - radius - known.blank[j].radius + std::min(moves, moves * moves / (2 * distance) + bent),
           {kinds[0], i, j});
    }
    if (!known.blank_face) return;
    const SolidFace& f = *known.blank_face;
    const auto over = [&](std::size_t k) { return dot(f.inward[k], place - f.corner[k]) > 0; };
    if (!over(0) || !over(1) || !over(2)) return;
    const double above = dot(f.normal, place - f.corner[0]);
    take(over_face,
         std::abs(above) - radius - f.width + y * y * (far - std::copysign(dot(f.normal, p), above)),
         {kinds[2], i, 0});
  };
  for (std::uint16_t i = 0; i < known.part.size(); ++i)
    look(known.part[i], i, {Kind::ball, Kind::plane, Kind::face}, plain, face);
  if (known.point)
    look(*known.point, 0, {Kind::point, Kind::point_plane, Kind::point_face}, point, point_face);
  if (known.part_face) {
    const SolidFace& f = *known.part_face;
    for (std::uint16_t j = 0; j < known.blank.size(); ++j) {
      const Vector off = known.blank[j].centre - at, q = cell.turned.turned_back(off);
      const auto over = [&](std::size_t k) { return dot(f.inward[k], q - f.corner[k]) > 0; };
      if (!over(0) || !over(1) || !over(2)) continue;
      const double above = dot(f.normal, q - f.corner[0]);
      take(part_face,
           std::abs(above) - known.blank[j].radius +
               y * y * (norm(off) - std::copysign(dot(f.normal, q), above)),
           {SolidTerm::Kind::part_face, 0, j});
    }
  }
  if (known.edges) edges = {0, {SolidTerm::Kind::edges, 0, 0}};
  std::optional<SolidRow> chosen;
  for (const Best& best : {plain, face, part_face, edges, point, point_face}) {
    if (!(best.level < kInfinity)) continue;
    auto term = form(known, best.choice, cell);
    if (!term) continue;
    close(*term, cell);
    const LinearBound<6> tangent = term->form.tangent(cell);
    if (!chosen || tangent.level < chosen->bound.level) chosen = {tangent, best.choice, term->scale};
  }
  return chosen;
}

}  // namespace lekalo::locate
