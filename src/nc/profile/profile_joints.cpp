#include "profile_joints.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/trig.hpp"
#include "profile_options.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

constexpr std::size_t kMostJointsOfPart = 20, kMostPartsNamed = 20;

/// A closed path by the distance along it.
class AlongPath {
 public:
  struct Spot {
    std::size_t edge = 0;
    Point at, way;        ///< the unit direction of the path
    double from_end = 0;  ///< the way to the nearer end of the edge
  };

  AlongPath(const std::vector<WrittenEdge>& path, const Resolution& resolution) {
    for (const WrittenEdge& edge : path) {
      edges_.push_back(edge_mm(edge, resolution));
      const geom::Edge& e = edges_.back();
      ends_.push_back(length() + (e.kind == geom::EdgeKind::line ? geom::norm(e.to - e.from)
                                                                 : geom::arc_radius(e) * geom::arc_sweep(e)));
    }
  }

  [[nodiscard]] double length() const { return ends_.empty() ? 0 : ends_.back(); }
  [[nodiscard]] double begin_of(std::size_t edge) const { return edge == 0 ? 0 : ends_[edge - 1]; }
  [[nodiscard]] double end_of(std::size_t edge) const { return ends_[edge]; }
  [[nodiscard]] std::size_t size() const { return edges_.size(); }
  [[nodiscard]] bool is_line(std::size_t edge) const { return edges_[edge].kind == geom::EdgeKind::line; }
  [[nodiscard]] double in_turn(double s) const {
    s = std::fmod(s, length());
    return s < 0 ? s + length() : s;
  }

  [[nodiscard]] Spot spot(double s) const {
    s = in_turn(s);
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), s);
    Spot spot;
    spot.edge = std::min(static_cast<std::size_t>(found - ends_.begin()), edges_.size() - 1);
    const geom::Edge& edge = edges_[spot.edge];
    const double on = s - begin_of(spot.edge), whole = ends_[spot.edge] - begin_of(spot.edge);
    spot.from_end = std::min(on, whole - on);
    if (edge.kind == geom::EdgeKind::line) {
      spot.way = (1 / geom::norm(edge.to - edge.from)) * (edge.to - edge.from);
      spot.at = edge.from + on * spot.way;
      return spot;
    }
    const double hand = edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1;
    const auto [sine, cosine] = geom::sincos(hand * on / geom::arc_radius(edge));
    const Point out = edge.from - edge.centre, turned = cosine * out + sine * geom::perpendicular(out);
    spot.at = edge.centre + turned;
    spot.way = (hand / geom::norm(turned)) * geom::perpendicular(turned);
    return spot;
  }

 private:
  std::vector<geom::Edge> edges_;
  std::vector<double> ends_;
};

/// A joint that a path could have.
struct JointPlace {
  double from = 0, to = 0;  ///< along the path: the kerf ends and goes on
  JointGround ground;
  Point middle;   ///< between both ends of the kerf
  Point held[2];  ///< where the part is held: on its edge, as far apart as the joint is wide
  Start start;    ///< behind the joint; its edge is not known before the path is divided
};

geom::Edge line_between(Point a, Point b) { return {geom::EdgeKind::line, a, b, {}}; }

std::vector<geom::Edge> sides_of(const JointGround& ground) {
  std::vector<geom::Edge> sides;
  for (std::size_t i = 0; i < 4; ++i)
    sides.push_back(line_between(ground.corners[i], ground.corners[(i + 1) % 4]));
  return sides;
}

/// The least distance of an edge from the sides of a ground, rounded down.
double distance_of(const JointGround& ground, const geom::Edge& edge) {
  const geom::Curve curve = geom::make_curve(edge);
  double least = std::numeric_limits<double>::infinity();
  for (const geom::Edge& side : sides_of(ground))
    least = std::min(least, distance_at_least(geom::make_curve(side), curve));
  return least;
}

/// Ends of kerfs lie half a kerf from the ground of their own joint, but for the rounding of words.
double rounding_of_words(const Resolution& resolution) { return 3 * resolution.step_mm(); }

/// Divides the path at both ends of joints, and marks what lies between.
/// \param joints  disjoint stretches, by `from`, which may run over the end of the path
std::vector<WrittenEdge> divided(const std::vector<WrittenEdge>& path, const AlongPath& along,
                                 const std::vector<const JointPlace*>& joints, const Resolution& resolution) {
  struct Division {
    double at;
    WrittenPoint point;
  };
  std::vector<Division> divisions;
  for (const JointPlace* joint : joints)
    for (const double s : {joint->from, joint->to})
      divisions.push_back({along.in_turn(s), resolution.rounded(along.spot(s).at)});
  std::sort(divisions.begin(), divisions.end(),
            [](const Division& a, const Division& b) { return a.at < b.at; });
  const auto is_joint = [&](double s) {
    return std::any_of(joints.begin(), joints.end(), [&](const JointPlace* joint) {
      return along.in_turn(s - joint->from) < joint->to - joint->from;
    });
  };
  std::vector<WrittenEdge> made;
  auto next = divisions.begin();
  for (std::size_t e = 0; e < path.size(); ++e) {
    WrittenEdge rest = path[e];
    double begin = along.begin_of(e);
    for (; next != divisions.end() && next->at < along.end_of(e); ++next) {
      WrittenEdge first = rest;
      first.to = rest.from = next->point;
      first.joint = is_joint(0.5 * (begin + next->at));
      if (!(first.from == first.to)) made.push_back(first);
      begin = next->at;
    }
    rest.joint = is_joint(0.5 * (begin + along.end_of(e)));
    if (!(rest.from == rest.to)) made.push_back(rest);
  }
  return made;
}

/// Finds places for the joints of one cut.
class JointFinder {
 public:
  JointFinder(const ProfilePart& part, const Cut& cut, std::size_t number, const Surroundings& around,
              const ProfileOptions& options, const std::vector<JointGround>& grounds,
              const std::vector<Start>& leads)
      : part_(part),
        cut_(cut),
        number_(number),
        around_(around),
        options_(options),
        grounds_(grounds),
        leads_(leads),
        resolution_(resolution_of(options)),
        along_(cut.path, resolution_),
        gap_(options.joints.width_mm + options.kerf_mm),
        margin_(std::max(options.joints.width_mm, options.kerf_mm)) {}

  /// So many joints, as evenly spread as there is room; fewer where there is too little.
  [[nodiscard]] std::vector<JointPlace> spread(std::size_t count) const {
    std::vector<JointPlace> best;
    for (const bool straight : {true, false}) {
      std::vector<JointPlace> found = spread_of(places(straight, 3 * count), count);
      if (found.size() > best.size() || best.empty()) best = std::move(found);
      if (best.size() == count) break;
    }
    return best;
  }

  /// The fewest joints with which the part does not tip; none where no three places hold it.
  [[nodiscard]] std::vector<JointPlace> against_tipping() const {
    for (const bool straight : {true, false}) {
      const std::vector<JointPlace> all = places(straight, 0);
      std::vector<JointPlace> found = one_of(all);
      if (found.empty()) found = two_of(all, straight);
      if (found.empty()) found = three_of(all);
      if (!found.empty()) return found;
    }
    return {};
  }

  [[nodiscard]] const AlongPath& along() const { return along_; }

 private:
  static constexpr std::size_t kMostPlaces = 24;
  /// The direction of a path turns by less than this, as a cosine, over a joint that is not on a line.
  static constexpr double kLeastCosine = 0.64;
  static constexpr double kNearEnd = 0.05;  // mm

  /// Places on lines away from their ends, or all round the path.
  [[nodiscard]] std::vector<JointPlace> places(bool straight, std::size_t least_number) const {
    std::vector<double> begins;
    if (straight) {
      for (std::size_t e = 0; e < along_.size(); ++e) {
        const double room = along_.end_of(e) - along_.begin_of(e) - gap_ - 2 * margin_;
        if (!along_.is_line(e) || !(room >= 0)) continue;
        const auto count = 1 + static_cast<std::size_t>(std::min(6.0, room / (4 * gap_)));
        for (std::size_t k = 0; k < count; ++k)
          begins.push_back(along_.begin_of(e) + margin_ +
                           room * (static_cast<double>(k) + 0.5) / static_cast<double>(count));
      }
    } else {
      for (std::size_t k = 0; k < 2 * kMostPlaces; ++k)
        begins.push_back(along_.length() * static_cast<double>(k) / (2 * kMostPlaces));
    }
    const std::size_t most = std::max(kMostPlaces, least_number), count = std::min(most, begins.size());
    std::vector<JointPlace> made;
    for (std::size_t k = 0; k < count; ++k)
      if (auto place = place_at(begins[k * begins.size() / count], straight))
        made.push_back(*std::move(place));
    std::stable_sort(made.begin(), made.end(), [](const JointPlace& a, const JointPlace& b) {
      return a.start.met.empty() > b.start.met.empty();
    });
    return made;
  }

  /// The joint behind this place of the path, if there is room for it, for its lead, and for the sheet that
  /// it holds on to.
  [[nodiscard]] std::optional<JointPlace> place_at(double from, bool straight) const {
    ask();
    JointPlace place;
    place.from = along_.in_turn(from);
    const std::optional<double> to = end_behind(place.from);
    if (!to) return std::nullopt;
    place.to = *to;
    const AlongPath::Spot end = along_.spot(place.from), start = along_.spot(place.to);
    const AlongPath::Spot before = along_.spot(place.from - margin_), after = along_.spot(place.to + margin_);
    if (straight && !(before.edge == after.edge && along_.is_line(before.edge))) return std::nullopt;
    if (geom::dot(before.way, after.way) < kLeastCosine || geom::dot(end.way, start.way) < kLeastCosine ||
        end.from_end < kNearEnd || start.from_end < kNearEnd)
      return std::nullopt;
    put_ground(place, resolution_.mm(resolution_.rounded(end.at)),
               resolution_.mm(resolution_.rounded(start.at)));
    if (!is_free(place) || !has_start(place, resolution_.rounded(start.at), start.way)) return std::nullopt;
    return place;
  }

  /// Finds where the kerf goes on, so that the ends of its middle lie a joint and a kerf apart.
  [[nodiscard]] std::optional<double> end_behind(double from) const {
    if (!(along_.length() > 4 * gap_)) return std::nullopt;
    const Point at = along_.spot(from).at;
    double low = from + 0.9 * gap_, high = from + 1.5 * gap_;
    if (!(geom::norm(along_.spot(high).at - at) >= gap_)) return std::nullopt;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (geom::norm(along_.spot(middle).at - at) < gap_ ? low : high) = middle;
    }
    return high;
  }

  void put_ground(JointPlace& place, Point end, Point start) const {
    const Point way = (1 / geom::norm(start - end)) * (start - end), waste = geom::perpendicular(way);
    const double half = 0.5 * options_.kerf_mm, width = options_.joints.width_mm, out = half + width;
    const Point a = end + half * way, b = start - half * way;
    place.ground = {{a, b, b + out * waste, a + out * waste}};
    place.middle = 0.5 * (a + b);
    const Point on_part = place.middle - half * waste;
    place.held[0] = on_part - 0.5 * width * way;
    place.held[1] = on_part + 0.5 * width * way;
  }

  [[nodiscard]] bool is_free(const JointPlace& place) const {
    const double half = 0.5 * options_.kerf_mm, apart = 3 * gap_;
    for (const geom::Edge& side : sides_of(place.ground))
      if (!around_.kerfs.keeps_apart(number_, side, half)) return false;
    for (const WrittenEdge& edge : divided(cut_.path, along_, {&place}, resolution_))
      if (!edge.joint &&
          !(distance_of(place.ground, edge_mm(edge, resolution_)) >= half - rounding_of_words(resolution_)))
        return false;
    for (const JointGround& other : grounds_) {
      const Point middle = 0.5 * (other.corners[0] + other.corners[1]);
      if (geom::norm(middle - place.middle) < apart) return false;
    }
    return std::all_of(leads_.begin(), leads_.end(), [&](const Start& lead) {
      return keeps_off({place.ground}, lead.lead, lead.pierce, options_);
    });
  }

  /// The longest lead behind the joint, like that of other cuts, but always a line: an arc would come out of
  /// the joint.
  [[nodiscard]] bool has_start(JointPlace& place, WrittenPoint at, Point way) const {
    std::optional<Start> crossing;
    for (const double length : lead_lengths(options_.lead_in_mm, options_)) {
      auto lead = lead_to(at, way, length, LeadShape::line, resolution_);
      if (lead.size() != 1 || !around_.proof.stays_out(lead)) continue;
      const WrittenPoint pierce = lead.front().from;
      if (!is_clear(place, lead, pierce)) continue;
      auto met = around_.kerfs.met(number_, lead, pierce);
      const bool is_free = met.empty();
      Start start{std::move(lead), 0, pierce, at, std::move(met), length};
      if (is_free) {
        place.start = std::move(start);
        return true;
      }
      if (!crossing) crossing = std::move(start);
    }
    // All leads behind joints are there in the end, so that order alone cannot keep pierces clear.
    if (crossing && options_.pierce_diameter_mm == 0) {
      place.start = *std::move(crossing);
      return true;
    }
    place.start = {{}, 0, at, at, around_.kerfs.met(number_, {}, at)};
    return !(least_lead_mm(options_) > 0) && is_clear(place, {}, at) &&
           (options_.pierce_diameter_mm == 0 || place.start.met.empty());
  }
  [[nodiscard]] bool is_clear(const JointPlace& place, const std::vector<WrittenEdge>& lead,
                              WrittenPoint pierce) const {
    if (options_.pierce_diameter_mm > 0 &&
        !around_.proof.disc_stays_out(pierce, 0.5 * options_.pierce_diameter_mm))
      return false;
    return keeps_off({place.ground}, lead, pierce, options_) && keeps_off(grounds_, lead, pierce, options_);
  }

  /// Two joints of one part leave a stretch between them, and neither's lead comes into the other.
  [[nodiscard]] bool go_together(const JointPlace& a, const JointPlace& b) const {
    return geom::norm(a.middle - b.middle) >= 3 * gap_ &&
           keeps_off({a.ground}, b.start.lead, b.start.pierce, options_) &&
           keeps_off({b.ground}, a.start.lead, a.start.pierce, options_);
  }

  [[nodiscard]] std::vector<JointPlace> spread_of(const std::vector<JointPlace>& all,
                                                  std::size_t count) const {
    std::vector<JointPlace> chosen;
    while (chosen.size() < count && !all.empty()) {
      const JointPlace* best = nullptr;
      double most = -1;
      for (const JointPlace& place : all) {
        double least = along_.length();
        bool fits = true;
        for (const JointPlace& other : chosen) {
          const double way = along_.in_turn(place.from - other.from);
          least = std::min({least, way, along_.length() - way});
          fits = fits && go_together(place, other);
        }
        if (fits && least > most) most = least, best = &place;
      }
      if (best == nullptr) break;
      chosen.push_back(*best);
    }
    return chosen;
  }

  [[nodiscard]] bool holds(const std::vector<const JointPlace*>& joints) const {
    std::vector<Point> held;
    for (const JointPlace* joint : joints)
      held.insert(held.end(), std::begin(joint->held), std::end(joint->held));
    return !tips(part_.region, options_.joints.slats, held);
  }

  [[nodiscard]] std::vector<JointPlace> one_of(const std::vector<JointPlace>& all) const {
    for (const JointPlace& place : all)
      if (holds({&place})) return {place};
    return {};
  }

  /// Two joints on a line through the centre of mass hold a part by themselves: it hangs on them, and their
  /// width keeps it from turning about that line.
  [[nodiscard]] std::vector<JointPlace> two_of(const std::vector<JointPlace>& all, bool straight) const {
    const Point centre = centre_of_mass(part_.region);
    for (const JointPlace& place : all) {
      const Point from = 0.5 * (place.held[0] + place.held[1]);
      const auto other = across(from, centre);
      if (!other) continue;
      const auto opposite = place_at(*other - 0.5 * gap_, straight);
      if (opposite && go_together(place, *opposite) && holds({&place, &*opposite})) return {place, *opposite};
    }
    return {};
  }

  /// Finds where the way from a place through the centre leaves the part.
  [[nodiscard]] std::optional<double> across(Point from, Point centre) const {
    constexpr int kPieces = 512;
    const Point way = centre - from;
    const auto off = [&](double s) { return geom::cross(way, along_.spot(s).at - from); };
    std::optional<double> found;
    double farthest = 0;
    for (int k = 0; k < kPieces; ++k) {
      double low = along_.length() * k / kPieces, high = along_.length() * (k + 1) / kPieces;
      const double at_low = off(low);
      if ((at_low < 0) == (off(high) < 0)) continue;
      for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (low + high);
        ((off(middle) < 0) == (at_low < 0) ? low : high) = middle;
      }
      const double reach = geom::dot(along_.spot(low).at - centre, way);
      if (reach > farthest) farthest = reach, found = low;
    }
    return found;
  }

  [[nodiscard]] std::vector<JointPlace> three_of(const std::vector<JointPlace>& all) const {
    const Point centre = centre_of_mass(part_.region);
    const auto is_left = [&](const JointPlace& a, const JointPlace& b) {
      const Point side = b.middle - a.middle;
      return geom::cross(side, centre - a.middle) > kTippingMargin * geom::norm(side);
    };
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size(); ++j)
        for (std::size_t k = j + 1; k < all.size(); ++k) {
          // Outlines are followed clockwise, so that three places in their order turn to the right.
          if (!is_left(all[i], all[k]) || !is_left(all[k], all[j]) || !is_left(all[j], all[i])) continue;
          if (go_together(all[i], all[j]) && go_together(all[j], all[k]) && go_together(all[i], all[k]) &&
              holds({&all[i], &all[j], &all[k]}))
            return {all[i], all[j], all[k]};
        }
    return {};
  }

  const ProfilePart& part_;
  const Cut& cut_;
  std::size_t number_;
  const Surroundings& around_;
  const ProfileOptions& options_;
  const std::vector<JointGround>& grounds_;
  const std::vector<Start>& leads_;
  Resolution resolution_;
  AlongPath along_;
  double gap_, margin_;
};

/// The joints that a part should have.
struct JointWish {
  bool against_tipping = false;
  std::size_t count = 0;
};

JointWish wish_of(const ProfilePart& part, const JointOptions& joints) {
  const auto own = std::find_if(joints.of.begin(), joints.of.end(),
                                [&](const auto& exception) { return exception.first == part.id; });
  if (own != joints.of.end()) return {false, own->second};
  if (joints.rule == JointRule::none || (joints.up_to_mm > 0 && size_of(part.region) > joints.up_to_mm))
    return {};
  if (joints.rule == JointRule::count) return {false, joints.count};
  return {tips(part.region, joints.slats), 0};
}

}  // namespace

Result<void> check_joints(const ProfileOptions& options) {
  const JointOptions& joints = options.joints;
  if (!joints.wanted()) return {};
  LEKALO_CHECK(check_range("width of joints in mm", joints.width_mm, 0.05, 50));
  if (joints.rule == JointRule::count)
    LEKALO_CHECK(check_range("number of joints", static_cast<double>(joints.count), 1, kMostJointsOfPart));
  for (const auto& [id, count] : joints.of)
    LEKALO_CHECK(check_range(fmt::format("number of joints of placement {}", id), static_cast<double>(count),
                             0, kMostJointsOfPart));
  if (joints.up_to_mm != 0)
    LEKALO_CHECK(check_range("size of parts with joints in mm", joints.up_to_mm, 0.1, 1e4));
  if (joints.rule == JointRule::tipping)
    LEKALO_CHECK(check_range("pitch of slats in mm", joints.slats.pitch_mm, 1, 1000));
  if (options.process == Process::router)
    LEKALO_CHECK(check_range("height of tabs in mm (less than the depth)", joints.tab_height_mm, 0.01,
                             std::nextafter(options.depth_mm, 0)));
  return {};
}

bool keeps_off(const std::vector<JointGround>& grounds, const std::vector<WrittenEdge>& lead,
               WrittenPoint pierce, const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  const double half = 0.5 * options.kerf_mm, disc = std::max(half, 0.5 * options.pierce_diameter_mm);
  const Point at = resolution.mm(pierce);
  double reach = 2 * disc + options.joints.width_mm + options.kerf_mm;
  for (const WrittenEdge& edge : lead)
    reach += 2 * geom::norm(resolution.mm(edge.from) - resolution.mm(edge.to));
  for (const JointGround& ground : grounds) {
    if (geom::norm(ground.corners[0] - at) > reach + 2 * options.joints.width_mm) continue;
    for (const WrittenEdge& edge : lead)
      if (!(distance_of(ground, edge_mm(edge, resolution)) >= half - rounding_of_words(resolution)))
        return false;
    for (const geom::Edge& side : sides_of(ground))
      if (!(distance_at_least(geom::make_curve(side), at) >= disc - rounding_of_words(resolution)))
        return false;
  }
  return true;
}

Result<JointedCuts> place_joints(const std::vector<ProfilePart>& parts, std::vector<Cut>& cuts,
                                 const std::vector<std::size_t>& enclosing, const Surroundings& around,
                                 const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  JointedCuts made;
  made.starts.resize(cuts.size());
  if (!options.joints.wanted()) return made;
  std::vector<Start> leads;
  std::string unplaced;
  std::size_t unplaced_count = 0;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    Cut& cut = cuts[c];
    const ProfilePart& part = parts[cut.part];
    if (!cut.outline) continue;
    const JointWish wish = wish_of(part, options.joints);
    if (!wish.against_tipping && wish.count == 0) continue;
    if (enclosing[c] != c) {
      made.unheld.push_back(part.id);
      continue;
    }
    const JointFinder finder(part, cut, c, around, options, made.grounds, leads);
    std::vector<JointPlace> places =
        wish.against_tipping ? finder.against_tipping() : finder.spread(wish.count);
    if (places.size() < std::max<std::size_t>(1, wish.count)) {
      if (unplaced_count++ < kMostPartsNamed)
        unplaced += (unplaced.empty() ? "" : ", ") + std::to_string(part.id) +
                    (wish.count > 0 ? fmt::format(" ({} of {})", places.size(), wish.count) : "");
      continue;
    }
    std::sort(places.begin(), places.end(),
              [](const JointPlace& a, const JointPlace& b) { return a.from < b.from; });
    std::vector<const JointPlace*> all;
    for (const JointPlace& place : places) all.push_back(&place);
    cut.path = divided(cut.path, finder.along(), all, resolution);
    for (JointPlace& place : places) {
      // The stretch behind the joint begins with the edge from its start on.
      const auto first = std::find_if(cut.path.begin(), cut.path.end(), [&](const WrittenEdge& edge) {
        return !edge.joint && edge.from == place.start.on_contour;
      });
      place.start.edge = static_cast<std::size_t>(first - cut.path.begin());
      place.start.behind_joint = true;
      made.grounds.push_back(place.ground);
      leads.push_back(place.start);
      made.starts[c].push_back(std::move(place.start));
    }
    ++made.parts;
  }
  if (unplaced_count > kMostPartsNamed)
    unplaced += fmt::format(" and {} more", unplaced_count - kMostPartsNamed);
  if (unplaced_count > 0)
    return failure(
        ErrorCode::bad_input,
        fmt::format("there is no room for joints of {:g} mm, with the sheet that they hold on to and "
                    "their leads, on {} {}; make them narrower, move parts apart, or say 0 for these",
                    options.joints.width_mm, unplaced_count == 1 ? "placement" : "placements", unplaced));
  return made;
}

}  // namespace lekalo::nc
