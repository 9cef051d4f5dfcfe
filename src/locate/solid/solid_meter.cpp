#include "solid_meter.hpp"

#include <map>
#include <set>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/geom/trig.hpp"
#include "spread.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::NearPair;
using solid::Vector;

/// So many vertices of each mesh are looked at where they cross.
constexpr std::size_t kSamples = 96;
/// And at most so many of them for a quick word.
constexpr std::size_t kFewSamples = 32;
/// A glance looks at a vertex of so many patches of each mesh, and of so many neighbours goes on with the one
/// that comes nearest: with so many pairs of nodes.
constexpr std::size_t kPatches = 128, kNeighbours = 2, kSteps = 300;
/// A probe takes so many for each piece at most, so that nobody has to stop it.
constexpr std::size_t kProbed = 400;
/// The deepest crossings of one pose are used, at most this many.
constexpr std::size_t kMostCrossings = 16;
/// Points nearer to each other than this part of the coordinates give no direction.
constexpr double kNoDirection = 0x1p-40;
/// So many points of a datum are looked at beside the one that is farthest off, and on an axis in so many
/// directions.
constexpr std::size_t kDatumPoints = 8, kDirections = 16;
/// A datum is aimed at within this part of its tolerance, so that steps along it do not leave it.
constexpr double kAimed = 1 - 1.0 / 1024;
/// So many points of a face are looked at to see if it is near enough; and to say how near it is where a pose
/// was chosen.
constexpr std::size_t kLooked = 20'000, kLookedAtLast = 2'000'000;
/// So many of them are contacts, none of which is nearer to the blank's surface than this part of what is
/// allowed.
constexpr std::size_t kNearPoints = 6;
constexpr double kFarEnough = 0.5;
/// They are chosen of so many.
constexpr std::size_t kMostNearPlaces = 512;
/// Distances of datums are rounded by less than this part of the coordinates.
constexpr double kDatumRounding = 0x1p-44;
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kDiagonal = 1.7321;

/// The triangles with these numbers, and the vertices that they have.
solid::Mesh part_of(const solid::Mesh& mesh, const std::vector<std::uint32_t>& numbers) {
  std::vector<std::uint32_t> becomes(mesh.vertices.size(), kNoTriangle);
  solid::Mesh made;
  for (const std::uint32_t number : numbers) {
    solid::Triangle t = mesh.triangles[number];
    for (std::uint32_t& v : t) {
      if (becomes[v] == kNoTriangle) {
        becomes[v] = static_cast<std::uint32_t>(made.vertices.size());
        made.vertices.push_back(mesh.vertices[v]);
      }
      v = becomes[v];
    }
    made.triangles.push_back(t);
  }
  return made;
}

/// The vertices of each surface that hangs together by its vertices.
std::vector<std::vector<Vector>> surfaces(const solid::Mesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  for (const solid::Triangle& t : mesh.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
  std::map<std::uint32_t, std::vector<Vector>> made;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) made[sets.of(v)].push_back(mesh.vertices[v]);
  std::vector<std::vector<Vector>> all;
  for (auto& [first, vertices] : made) all.push_back(std::move(vertices));
  return all;
}

/// How a place is off a datum: the shortest way to it from the datum.
Vector way_off(const SolidDatum& datum, Vector place) {
  const Vector w = place - datum.at, along = dot(w, datum.direction) * datum.direction;
  switch (datum.on) {
    case SolidDatum::On::plane:
      return along;
    case SolidDatum::On::axis:
      return w - along;
    case SolidDatum::On::point:
      break;
  }
  return w;
}

/// A direction of length 1 across another one.
Vector across(Vector n) {
  const Vector axis = std::abs(n.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0}, w = cross(n, axis);
  return 1 / norm(w) * w;
}

/// The directions in which a place may not go away from a datum farther than its tolerance, that in which it
/// is off among them.
std::vector<Vector> directions(const SolidDatum& datum, Vector off) {
  const double far = norm(off);
  if (datum.on == SolidDatum::On::plane) return {datum.direction, -datum.direction};
  std::vector<Vector> made;
  if (datum.on == SolidDatum::On::point) {
    const Vector first = far > 0 ? 1 / far * off : Vector{1, 0, 0}, second = across(first),
                 third = cross(first, second);
    for (const double i : {0.0, 1.0, -1.0})
      for (const double j : {0.0, 1.0, -1.0})
        for (const double k : {0.0, 1.0, -1.0})
          if (const Vector w = i * first + j * second + k * third; norm(w) > 0)
            made.push_back(1 / norm(w) * w);
    return made;
  }
  const Vector first = far > 0 ? 1 / far * off : across(datum.direction),
               second = cross(datum.direction, first);
  for (std::size_t k = 0; k < kDirections; ++k) {
    const geom::SinCos turn = geom::sincos(static_cast<double>(k) * (2 * kPi / kDirections));
    made.push_back(turn.cosine * first + turn.sine * second);
  }
  return made;
}

SolidDemand demand_in(const std::vector<std::optional<SolidDemand>>& demands, std::uint32_t triangle) {
  return demands.empty() ? SolidDemand{} : *demands[triangle];
}

}  // namespace

SolidMeter::SolidMeter(const SolidProblem& problem, const SolidFrame& frame, unsigned threads)
    : frame_(frame),
      threads_(threads),
      cut_(CutPart::of(problem)),
      part_(cut_ ? cut_->mesh() : problem.part),
      blank_(problem.blank),
      widths_(problem.blank_widths),
      clearance_(part_, problem.blank, problem.blank_widths, threads),
      demand_of_(cut_ ? cut_->demands() : problem.demands),
      datums_(problem.datums),
      part_error_(kDiagonal * problem.part_coordinate_error + (cut_ ? cut_->error() : 0)),
      blank_error_(kDiagonal * problem.blank_coordinate_error),
      width_error_(problem.blank_width_error) {
  if (problem.blank_widths.empty() && problem.demands.empty() && problem.datums.empty() &&
      problem.nears.empty())
    convex_ = ConvexBlank::of(problem.blank, clearance_.blank());
  sort_by_demand();
  of_part_ = samples_of_part();
  for (const std::size_t v : spread(blank_.vertices, kSamples)) of_blank_.push_back(blank_.vertices[v]);
  cut_in_patches();
  if (!widths_.empty()) {
    const auto [low, high] = std::minmax_element(widths_.begin(), widths_.end());
    narrowest_ = *low, widest_ = *high;
  }
  far_ = 2 * (clearance_.part().largest() + clearance_.blank().largest()) + norm(frame.window.middle().at) +
         norm(frame.window.half().at);
  for (const SolidNear& near : cut_ ? cut_->nears() : problem.nears) nears_.emplace_back(near, part_);
  prepare_datums();
}

void SolidMeter::prepare_datums() {
  double far = far_, least_scale = 1;
  for (const SolidDatum& datum : datums_) {
    std::vector<Vector> places;
    for (const SolidDatum::Point& point : datum.points) places.push_back(point.place);
    of_datum_.push_back(spread(places, kDatumPoints));
    for (const Vector p : places) far = std::max(far, norm(p));
    far = std::max({far, norm(datum.at), datum.within});
  }
  for (const SolidDemand& demand : demands_) least_scale = std::min(least_scale, demand.scale);
  if (!nears_.empty() && !widths_.empty()) bare_.emplace(part_, blank_);
  if (!nears_.empty()) blank_points_ = solid::surface_points(blank_);
  datum_loss_ = part_error_ + kDatumRounding * far;
  beyond_margins_ = far_ / least_scale;
}

double SolidMeter::off(const SolidDatum& datum, const Motion& motion) const {
  double most = 0;
  for (const SolidDatum::Point& point : datum.points)
    most = std::max(most, norm(way_off(datum, motion(point.place))));
  return most + datum_loss_;
}

/// By how much tolerances are exceeded, altogether.
double SolidMeter::beyond_datums(const Motion& motion) const {
  double beyond = 0;
  for (const SolidDatum& datum : datums_) beyond += std::max(0.0, off(datum, motion) - datum.within);
  return beyond;
}

void SolidMeter::add_datums(const Motion& motion, std::vector<SolidContact>& contacts) const {
  // A row that is lifted above all margins is lower than these only so far beyond its tolerance.
  const double unnoticed = beyond_margins_ / kDatumWeight;
  for (std::uint32_t d = 0; d < datums_.size(); ++d) {
    const SolidDatum& datum = datums_[d];
    const double aim = kAimed * datum.within - datum_loss_ - unnoticed;
    const auto far = [&](std::size_t k) { return norm(way_off(datum, motion(datum.points[k].place))); };
    std::size_t farthest = 0;
    for (std::size_t k = 1; k < datum.points.size(); ++k)
      if (far(k) > far(farthest)) farthest = k;
    const auto add = [&](std::size_t k) {
      const Vector place = datum.points[k].place, off = way_off(datum, motion(place));
      for (const Vector u : directions(datum, off)) {
        SolidContact made{place, datum.at, -kDatumWeight * u, 0, kNoTriangle, kNoTriangle};
        made.distance = beyond_margins_ + kDatumWeight * (aim - dot(u, off));
        made.datum = d, made.datum_point = static_cast<std::uint32_t>(k);
        contacts.push_back(made);
      }
    };
    add(farthest);
    for (const std::size_t k : of_datum_[d])
      if (k != farthest) add(k);
  }
}

double SolidMeter::far(const NearFace& face, const Motion& motion) const {
  return face.at(clearance_.blank(), motion, 0, kLookedAtLast).high + datum_loss_ + blank_error_;
}

std::optional<SolidContact> SolidMeter::contact_of(std::uint32_t near, const FarPoint& point) const {
  const SolidNear& demand = nears_[near].demand();
  const Vector way = point.placed - point.blank;
  const double length = norm(way);
  if (!(length > kFarEnough * demand.within) || !(length > kNoDirection * far_)) return std::nullopt;
  const double aim =
      demand.within - 4 * demand.slack() - datum_loss_ - blank_error_ - beyond_margins_ / kDatumWeight;
  SolidContact made{point.part, point.blank, -kDatumWeight / length * way, 0, kNoTriangle, kNoTriangle};
  made.distance = beyond_margins_ + kDatumWeight * (aim - point.far);
  made.demanded_triangle = point.triangle;
  made.near = near;
  return made;
}

std::optional<SolidContact> SolidMeter::near_contact(const Motion& motion, std::uint32_t near, Vector part,
                                                     std::uint32_t triangle) const {
  return contact_of(near, NearFace::point_at(clearance_.blank(), motion, part, triangle));
}

/// Adds the contacts of those points that are to be near the blank's surface and are the farthest from it.
/// Returns by how much they are too far, altogether.
double SolidMeter::add_nears(const Motion& motion, std::vector<SolidContact>& contacts) const {
  double beyond = 0;
  for (std::uint32_t k = 0; k < nears_.size(); ++k) {
    const double within = nears_[k].demand().within, lost = datum_loss_ + blank_error_;
    Farthest found = nears_[k].at(clearance_.blank(), motion, within - lost, kLooked);
    // Once a point is known to be too far, the bound of the others is worth nothing.
    const bool too_far = found.low + lost > within;
    beyond += std::max(0.0, (too_far ? found.low : found.high) + lost - within);
    auto& points = found.points;
    std::stable_sort(points.begin(), points.end(),
                     [](const FarPoint& a, const FarPoint& b) { return a.far > b.far; });
    // The farthest, and of those that are about as far some that lie apart from each other.
    const double least = std::min(within, points.front().far) - 0.25 * within;
    std::vector<Vector> places;
    for (const FarPoint& point : points)
      if (point.far > least && places.size() < kMostNearPlaces) places.push_back(point.part);
    for (const std::size_t at : spread(places, kNearPoints))
      if (const auto made = contact_of(k, points[at])) contacts.push_back(*made);
  }
  return beyond;
}

void SolidMeter::sort_by_demand() {
  if (!has_demands()) {
    demands_.emplace_back();
    return;
  }
  std::map<std::pair<double, double>, std::vector<std::uint32_t>> numbers;
  for (std::uint32_t t = 0; t < demand_of_.size(); ++t) {
    if (demand_of_[t])
      numbers[{demand_of_[t]->minimum, demand_of_[t]->scale}].push_back(t);
    else
      whole_ = false;
  }
  floor_ = kInfinity;
  demanded_at_.assign(part_.vertices.size(), kNoTriangle);
  for (auto& [key, of_demand] : numbers) {
    const SolidDemand demand{key.first, key.second};
    demands_.push_back(demand);
    floor_ = std::min(floor_, -demand.minimum / demand.scale);
    for (const std::uint32_t t : of_demand)
      for (const std::uint32_t v : part_.triangles[t]) demanded_at_[v] = t;
    solid::MeshClearance clearance(part_of(part_, of_demand), clearance_);
    demanded_.push_back({demand, std::move(of_demand), std::move(clearance)});
  }
  blank_surfaces_ = surfaces(blank_);
}

std::vector<SolidMeter::Sample> SolidMeter::samples_of_part() const {
  std::vector<Sample> all;
  for (std::uint32_t v = 0; v < part_.vertices.size(); ++v) {
    const std::uint32_t triangle = has_demands() ? demanded_at_[v] : kNoTriangle;
    if (!has_demands() || triangle != kNoTriangle) all.push_back({part_.vertices[v], triangle});
  }
  std::vector<Vector> places;
  for (const Sample& sample : all) places.push_back(sample.place);
  std::vector<Sample> chosen;
  for (const std::size_t k : spread(places, kSamples)) chosen.push_back(all[k]);
  return chosen;
}

void SolidMeter::cut_in_patches() {
  const auto cut = [](const solid::MeshClearance& clearance, const solid::TriangleTree& tree,
                      std::size_t count, const std::vector<std::uint32_t>* numbers,
                      std::vector<Patch>& patches) {
    for (const std::uint32_t node : tree.patches(count)) {
      const std::uint32_t first = tree.nodes()[node].begin, triangle = tree.triangle(first);
      patches.push_back({tree.corners(first)[0], numbers == nullptr ? triangle : (*numbers)[triangle], node,
                         &clearance, numbers});
    }
  };
  cut(clearance_, clearance_.blank(), kPatches, nullptr, patches_of_blank_);
  if (convex()) return;
  if (!has_demands()) cut(clearance_, clearance_.part(), kPatches, nullptr, patches_of_part_);
  for (const Demanded& one : demanded_)
    cut(one.clearance, one.clearance.part(), 1 + kPatches / demanded_.size(), &one.numbers, patches_of_part_);
}

const SolidDemand& SolidMeter::least_demand(double margin) const {
  const auto asks_less = [margin](const SolidDemand& a, const SolidDemand& b) {
    return a.minimum + a.scale * margin < b.minimum + b.scale * margin;
  };
  return demands_.size() == 1 ? demands_.front()
                              : *std::min_element(demands_.begin(), demands_.end(), asks_less);
}

SolidContact SolidMeter::contact(const Motion& motion, const NearPair& pair) const {
  const Vector out = pair.part - pair.blank;
  const double distance = norm(out);
  SolidContact made{motion.back(pair.part), pair.blank, {}, 0, pair.part_triangle, pair.blank_triangle};
  if (has_demands())
    made.demanded_triangle = pair.part_triangle, made.demand = *demand_of_[pair.part_triangle];
  if (distance > kNoDirection * far_) made.normal = 1 / distance * out;
  made.distance = distance - width(pair.blank_triangle);
  return made;
}

SolidContact SolidMeter::contact(const Motion& motion, std::uint32_t part_triangle,
                                 std::uint32_t blank_triangle) const {
  return contact(motion, clearance_.pair(motion, part_triangle, blank_triangle));
}

SolidContact SolidMeter::over_plane(const Motion& motion, SolidContact contact) {
  contact.distance = dot(contact.normal, motion(contact.part) - contact.blank);
  return contact;
}

void SolidMeter::measure_planes(const Motion& motion, double most, std::size_t count,
                                std::vector<SolidContact>& contacts) const {
  std::vector<ConvexBlank::Foremost> found;
  convex_->foremost(part_, clearance_.part(), motion, most, count, found);
  contacts.clear();
  for (const auto& [plane, part, height] : found) {
    SolidContact made{part, plane->place, plane->normal, height};
    made.of_plane = true;
    contacts.push_back(made);
  }
}

MeasuredSolid SolidMeter::measure(const FramedPose& pose, double most, std::size_t count,
                                  std::vector<SolidContact>& contacts) const {
  if (!convex()) return measure_pairs(pose, most, count, contacts);
  const double error = part_error_ + blank_error_;
  measure_planes(frame_.motion(pose), most + error, count, contacts);
  const double least = contacts.empty() ? most : contacts.front().distance - error;
  return {pose, std::min(most, least), least > 0};
}

MeasuredSolid SolidMeter::measure_pairs(const FramedPose& pose, double most, std::size_t count,
                                        std::vector<SolidContact>& contacts) const {
  const Motion motion = frame_.motion(pose);
  std::vector<NearPair> pairs = nearest(motion, most, count);
  const double error = part_error_ + blank_error_;
  contacts.clear();
  MeasuredSolid measured{pose, most, true};
  double apart = kInfinity;
  for (const NearPair& pair : pairs) {
    const auto& [minimum, scale] = demand_in(demand_of_, pair.part_triangle);
    apart = std::min(apart, pair.low - error);
    measured.value = std::min(measured.value, (pair.low - error - minimum) / scale);
  }
  for (const NearPair& pair : pairs) {
    const SolidContact made = contact(motion, pair);
    if (made.directed()) contacts.push_back(made);
  }
  std::vector<SolidContact> of_nears;
  const double too_far = add_nears(motion, of_nears);
  measured.inside = apart > 0 && !(too_far > 0) && inside(motion);
  if (!measured.inside) {
    std::vector<SolidContact> crossing;
    for (const Sample& sample : of_part_)
      if (const auto made = sticks_out(motion, sample.place, sample.triangle)) crossing.push_back(*made);
    for (const Vector b : of_blank_)
      if (const auto made = sticks_in(motion, b)) crossing.push_back(*made);
    add_crossings(motion, pairs, std::move(crossing), contacts);
    measured.value = -kNoDirection * far_;
    for (const SolidContact& made : contacts) measured.value = std::min(measured.value, made.margin());
    measured.value -= beyond_datums(motion) + too_far;
  }
  contacts.insert(contacts.end(), of_nears.begin(), of_nears.end());
  add_datums(motion, contacts);
  return measured;
}

std::vector<NearPair> SolidMeter::nearest(const Motion& motion, double most, std::size_t count) const {
  std::vector<NearPair> pairs;
  const double error = part_error_ + blank_error_;
  if (!has_demands()) {
    clearance_.nearest_by_piece(motion, most + error, count, pairs, threads_);
    return pairs;
  }
  std::vector<NearPair> of_demand;
  for (const Demanded& one : demanded_) {
    // Even where no margin is asked for, all has to be apart.
    const double far = std::max(one.demand.minimum + one.demand.scale * most, 0.0);
    one.clearance.nearest_by_piece(motion, far + error, count, of_demand);
    for (NearPair& pair : of_demand) {
      pair.part_triangle = one.numbers[pair.part_triangle];
      pairs.push_back(pair);
    }
  }
  const auto margin = [&](const NearPair& pair) {
    const auto& [minimum, scale] = *demand_of_[pair.part_triangle];
    return (pair.high - minimum) / scale;
  };
  // Pairs that cross come first, for which nothing makes up.
  std::stable_sort(pairs.begin(), pairs.end(), [&](const NearPair& a, const NearPair& b) {
    const bool crosses = a.low <= error, other = b.low <= error;
    return crosses != other ? crosses : margin(a) < margin(b);
  });
  if (pairs.size() > count) pairs.resize(count);
  return pairs;
}

MeasuredPose SolidMeter::measure(const Motion& motion) const {
  const double error = part_error_ + blank_error_;
  MeasuredPose made;
  if (!has_demands()) {
    made.clearance = made.margin = clearance_.nearest(motion)->low - error;
  } else {
    made.clearance = made.margin = kInfinity;
    for (const Demanded& one : demanded_) {
      const double least = one.clearance.nearest(motion)->low - error;
      const double margin = (least - one.demand.minimum) / one.demand.scale;
      made.clearance = std::min(made.clearance, least);
      // A quotient, a difference and two decimals are rounded.
      made.margin = std::min(
          made.margin,
          margin - 0x1p-50 * (std::abs(margin) + (std::abs(least) + one.demand.minimum) / one.demand.scale));
    }
  }
  made.inside = made.clearance > 0 && inside(motion);
  return made;
}

/// Says where the surfaces of what has a demand are apart from the blank's if it lies in the blank, and no
/// surface of the blank in the part; and if datums are kept.
bool SolidMeter::inside(const Motion& motion) const {
  if (!keeps_datums(motion)) return false;
  if (!has_demands()) return clearance_.inside(motion);
  const auto lies_outside = [&](Vector q) { return !clearance_.part().holds(motion.back(q)); };
  return std::all_of(demanded_.begin(), demanded_.end(),
                     [&](const Demanded& one) { return one.clearance.part_in_blank(motion); }) &&
         std::all_of(blank_surfaces_.begin(), blank_surfaces_.end(), [&](const auto& vertices) {
           return std::any_of(vertices.begin(), vertices.end(), lies_outside);
         });
}

double SolidMeter::misfit(const Motion& motion) const {
  double sum = 0;
  for (std::size_t k = 0; k < std::min(kFewSamples, of_part_.size()); ++k) {
    const Vector q = motion(of_part_[k].place);
    if (!clearance_.blank().holds(q)) sum += clearance_.blank().nearest(q)->high;
  }
  for (std::size_t k = 0; k < std::min(kFewSamples, of_blank_.size()); ++k) {
    const Vector p = motion.back(of_blank_[k]);
    if (clearance_.part().holds(p)) sum += clearance_.part().nearest(p)->high;
  }
  return sum;
}

SolidContact SolidMeter::foremost(const Motion& motion, Vector normal) const {
  SolidContact made;
  made.normal = normal;
  if (!has_demands()) {
    made.part = *std::min_element(part_.vertices.begin(), part_.vertices.end(), [&](Vector a, Vector b) {
      return dot(normal, motion(a)) < dot(normal, motion(b));
    });
    return made;
  }
  double least = kInfinity;
  for (std::uint32_t v = 0; v < part_.vertices.size(); ++v) {
    if (demanded_at_[v] == kNoTriangle) continue;
    const SolidDemand demand = *demand_of_[demanded_at_[v]];
    const double margin = (dot(normal, motion(part_.vertices[v])) - demand.minimum) / demand.scale;
    if (margin >= least) continue;
    least = margin;
    made.part = part_.vertices[v], made.demanded_triangle = demanded_at_[v], made.demand = demand;
  }
  return made;
}

std::optional<SolidContact> SolidMeter::sticks_out(const Motion& motion, Vector part,
                                                   std::uint32_t triangle) const {
  const Vector q = motion(part);
  if (clearance_.blank().holds(q)) return std::nullopt;
  const Vector place = clearance_.blank().nearest(q)->place;
  return crossing(part, place, norm(q - place), place - q, triangle);
}

std::optional<SolidContact> SolidMeter::sticks_in(const Motion& motion, Vector blank) const {
  const Vector p = motion.back(blank);
  if (!clearance_.part().holds(p)) return std::nullopt;
  const auto near = clearance_.part().nearest(p);
  // A triangle that is as cast may touch and cross.
  if (has_demands() && !demand_of_[near->triangle]) return std::nullopt;
  return crossing(near->place, blank, norm(p - near->place), blank - motion(near->place), near->triangle);
}

/// A contact where part and blank cross.
std::optional<SolidContact> SolidMeter::crossing(Vector part, Vector blank, double depth, Vector way,
                                                 std::uint32_t triangle) const {
  if (!(depth > kNoDirection * far_)) return std::nullopt;
  SolidContact made{part, blank, 1 / depth * way, -depth, kNoTriangle, kNoTriangle};
  if (has_demands()) made.demanded_triangle = triangle, made.demand = *demand_of_[triangle];
  return made;
}

double SolidMeter::glance(const FramedPose& pose, double most, std::size_t count,
                          std::vector<SolidContact>& contacts) const {
  const Motion motion = frame_.motion(pose);
  if (convex()) {
    measure_planes(motion, most, count, contacts);
    return contacts.empty() ? most : contacts.front().distance;
  }
  /// The patch of some neighbours that comes nearest, and what it is near to.
  struct Low {
    double margin = 0, apart = 0;
    const Patch* patch = nullptr;
    bool of_part = false;
    std::uint32_t part_triangle = 0, blank_triangle = 0;
  };
  std::vector<Low> lowest;
  std::vector<SolidContact> crossing;
  const auto reach = [&](const SolidDemand& demand, double margin) {
    return std::max(0.0, demand.minimum + demand.scale * margin) + widest_;
  };
  const auto look = [&](const std::vector<Patch>& patches, const auto& sticks, const auto& near) {
    for (std::size_t k = 0; k < patches.size(); k += kNeighbours) {
      Low low;
      low.margin = most;
      for (std::size_t i = k; i < std::min(k + kNeighbours, patches.size()); ++i) {
        const Patch& patch = patches[i];
        if (const auto made = sticks(patch)) {
          crossing.push_back(*made);
          continue;
        }
        const auto pair = near(patch, low.margin);
        if (!pair || (has_demands() && !demand_of_[pair->part_triangle])) continue;
        const auto& [minimum, scale] = demand_in(demand_of_, pair->part_triangle);
        const double apart = pair->high - width(pair->blank_triangle), margin = (apart - minimum) / scale;
        if (margin < low.margin)
          low = {margin,
                 apart,
                 &patch,
                 &patches == &patches_of_part_,
                 pair->part_triangle,
                 pair->blank_triangle};
      }
      if (low.patch != nullptr) lowest.push_back(low);
    }
  };
  const auto of_part = [&](const Patch& s, double margin) -> std::optional<NearPair> {
    const auto near =
        clearance_.blank().nearest(motion(s.place), reach(demand_in(demand_of_, s.triangle), margin));
    if (!near) return std::nullopt;
    return NearPair{s.triangle, near->triangle, {}, {}, near->low, near->high};
  };
  const auto of_blank = [&](const Patch& s, double margin) -> std::optional<NearPair> {
    const auto near = clearance_.part().nearest(motion.back(s.place), reach(least_demand(margin), margin));
    if (!near) return std::nullopt;
    return NearPair{near->triangle, s.triangle, {}, {}, near->low, near->high};
  };
  look(
      patches_of_part_, [&](const Patch& s) { return sticks_out(motion, s.place, s.triangle); }, of_part);
  look(
      patches_of_blank_, [&](const Patch& s) { return sticks_in(motion, s.place); }, of_blank);
  std::stable_sort(lowest.begin(), lowest.end(),
                   [](const Low& a, const Low& b) { return a.margin < b.margin; });
  if (lowest.size() > count) lowest.resize(count);
  contacts.clear();
  std::vector<NearPair> pairs;
  std::set<std::pair<std::uint32_t, std::uint32_t>> met;
  for (const Low& low : lowest) {
    const Patch& s = *low.patch;
    auto pair = s.clearance->near_below(motion, low.of_part ? s.node : 0, low.of_part ? 0 : s.node, low.apart,
                                        kSteps);
    if (!pair)
      pair = clearance_.pair(motion, low.part_triangle, low.blank_triangle);
    else if (s.numbers != nullptr)
      pair->part_triangle = (*s.numbers)[pair->part_triangle];
    if (has_demands() && !demand_of_[pair->part_triangle]) continue;
    if (!met.insert({pair->part_triangle, pair->blank_triangle}).second) continue;
    pairs.push_back(*pair);
    if (const SolidContact made = contact(motion, *pair); made.directed()) contacts.push_back(made);
  }
  add_crossings(motion, pairs, std::move(crossing), contacts);
  double least = most;
  for (const SolidContact& made : contacts) least = std::min(least, made.margin());
  return least;
}

double SolidMeter::probe(const FramedPose& pose, double most, std::vector<SolidContact>& contacts) const {
  const Motion motion = frame_.motion(pose);
  contacts.clear();
  double least = most;
  std::vector<NearPair> pairs;
  const auto take = [&](const solid::MeshClearance& clearance, double far,
                        const std::vector<std::uint32_t>* numbers) {
    clearance.near_by_piece(motion, far, kProbed, pairs);
    for (NearPair& pair : pairs) {
      if (numbers != nullptr) pair.part_triangle = (*numbers)[pair.part_triangle];
      const SolidContact made = contact(motion, pair);
      if (!made.directed()) continue;
      least = std::min(least, made.margin());
      contacts.push_back(made);
    }
  };
  if (!has_demands()) {
    take(clearance_, most, nullptr);
  } else {
    for (const Demanded& one : demanded_)
      take(one.clearance, std::max(0.0, one.demand.minimum + one.demand.scale * most), &one.numbers);
  }
  return least;
}

void SolidMeter::add_crossings(const Motion& motion, const std::vector<NearPair>& pairs,
                               std::vector<SolidContact> crossing,
                               std::vector<SolidContact>& contacts) const {
  for (const NearPair& pair : pairs) {
    if (pair.low > 0) continue;
    for (const std::uint32_t k : part_.triangles[pair.part_triangle])
      if (const auto made = sticks_out(motion, part_.vertices[k], pair.part_triangle))
        crossing.push_back(*made);
    for (const std::uint32_t k : blank_.triangles[pair.blank_triangle])
      if (const auto made = sticks_in(motion, blank_.vertices[k])) crossing.push_back(*made);
  }
  const auto deeper = [](const SolidContact& a, const SolidContact& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.part.x != b.part.x ? a.part.x < b.part.x : a.part.y < b.part.y;
  };
  std::sort(crossing.begin(), crossing.end(), deeper);
  const auto same = [](const SolidContact& a, const SolidContact& b) {
    return a.part == b.part && a.blank == b.blank;
  };
  crossing.erase(std::unique(crossing.begin(), crossing.end(), same), crossing.end());
  if (crossing.size() > kMostCrossings) crossing.resize(kMostCrossings);
  contacts.insert(contacts.end(), crossing.begin(), crossing.end());
}

}  // namespace lekalo::locate
