#include "demand_check.hpp"

#include <algorithm>

#include "document.hpp"
#include "grown_ball.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/surely.hpp"
#include "verify/shape/edge_of_side.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// A claim counts as not confirmed when it takes more pieces of outlines, or squares, than this.
constexpr std::size_t kMostPieces = 200'000;

bool above(const Decimal& a, const Decimal& b) { return compare(a, b) > 0; }

bool differ(const Decimal& written, const Decimal& derived, const Decimal& from) {
  const double size = std::abs(approximate(from)) + std::abs(approximate(derived));
  return !(std::abs(approximate(written - derived)) <= kDerivedTolerance * size);
}

std::optional<WrittenSecond> read_second(Json value, std::string& complaint) {
  if (value.is_null()) return std::nullopt;
  WrittenSecond second;
  Fields fields(value, "demands.smallest_largest", complaint);
  for (auto [key, to] : {std::pair{"margin", &second.margin},
                         {"found", &second.found},
                         {"bound", &second.bound},
                         {"gap", &second.gap},
                         {"kept", &second.kept}})
    *to = fields.number(key);
  if (fields.get("proof").is_null()) return second;
  Fields proof(fields.get("proof"), fields.name("proof"), complaint);
  WrittenSecond::Proof& p = second.proof.emplace();
  p.grown_for = proof.number("grown_for");
  for (auto [key, to] : {std::pair{"most", &p.most}, {"shift", &p.shift}, {"bound", &p.bound}})
    *to = enclosed(proof.number(key));
  if (sgn(p.grown_for.digits) < 0) proof.complain(fmt::format("{} is negative", proof.name("grown_for")));
  return second;
}

}  // namespace

bool knows_criterion(std::string_view name) noexcept {
  return name == "smallest" || name == "largest" || name == "even";
}

WrittenDemands read_demands(Json value, std::string& complaint) {
  WrittenDemands d;
  Fields fields(value, "demands", complaint);
  for (auto [key, to] : {std::pair{"minimum", &d.minimum},
                         {"margin", &d.margin},
                         {"margin_bound", &d.margin_bound},
                         {"largest", &d.largest},
                         {"grown_for", &d.grown_for},
                         {"shift", &d.shift},
                         {"bound", &d.bound}})
    *to = enclosed(fields.number(key));
  for (auto [key, to] : {std::pair{"minimum", &d.minimum_as_written},
                         {"give_up", &d.give_up},
                         {"margin", &d.margin_as_written},
                         {"margin_bound", &d.margin_bound_as_written},
                         {"margin_found", &d.margin_found},
                         {"margin_gap", &d.margin_gap},
                         {"largest", &d.largest_as_written}})
    *to = fields.number(key);
  d.criterion = fields.text("criterion");
  d.second = read_second(fields.get("smallest_largest"), complaint);
  fields.each("trade_off", [&](Json item, const std::string& path) {
    Fields point(item, path, complaint);
    WrittenTradeOff t;
    t.x = point.number("x"), t.y = point.number("y");
    t.theta = point.number("theta"), t.theta_deg = point.number("theta_deg");
    t.clearance = enclosed(point.number("clearance"));
    t.margin = enclosed(point.number("margin")), t.largest = enclosed(point.number("largest"));
    if (!point.get("mirrored").is_bool()) point.complain(fmt::format("{}.mirrored is no truth value", path));
    t.mirrored = point.get("mirrored").is_true();
    if (t.margin.low < 0) point.complain(fmt::format("{}.margin is negative", path));
    d.curve.push_back(t);
  });
  if (sgn(d.give_up.digits) < 0) fields.complain("demands.give_up is negative");
  if (d.grown_for.low < 0) fields.complain("demands.grown_for is negative");
  if (d.minimum.low < 0) fields.complain("demands.minimum is negative");
  fields.each("features", [&](Json item, const std::string& path) {
    Fields feature(item, path, complaint);
    WrittenFeature f;
    f.name = feature.text("name");
    feature.each("edges",
                 [&](Json edge, const std::string& at) { f.edges.push_back(feature.index_of(edge, at)); });
    const Decimal minimum = feature.number("minimum"), scale = feature.number("scale");
    f.minimum = enclosed(minimum), f.scale = enclosed(scale);
    f.numbers.minimum = approximate(minimum), f.numbers.scale = approximate(scale);
    if (const auto most = feature.number_or_null("maximum"))
      f.maximum = enclosed(*most), f.numbers.maximum = approximate(*most);
    if (const auto off = feature.number_or_null("finished"))
      f.finished = enclosed(*off), f.numbers.finished = approximate(*off);
    if (const auto aim = feature.number_or_null("target")) f.numbers.target = approximate(*aim);
    if (f.minimum.low < 0 || !is_positive(f.scale) || (f.maximum && f.maximum->low < 0) ||
        (f.finished && !is_positive(*f.finished)))
      feature.complain(fmt::format("{} has a number out of range", path));
    d.features.push_back(std::move(f));
  });
  return d;
}

DemandCheck::DemandCheck(const WrittenDemands& demands, const Shape& part, const Shape& placed_part,
                         const Shape& blank, Span off, std::vector<std::string>& findings)
    : d_(demands), part_(part), placed_(placed_part), blank_(blank), off_(off), findings_(findings) {
  const std::vector<std::size_t> edges = edge_of_side(part);
  sides_of_edge_.resize(edges.empty() ? 0 : edges.back() + 1);
  for (std::size_t k = 0; k < edges.size(); ++k) sides_of_edge_[edges[k]].push_back(k);
  feature_of_edge_.assign(sides_of_edge_.size(), nullptr);
  for (const WrittenFeature& f : d_.features)
    for (const std::size_t edge : f.edges) {
      if (edge >= feature_of_edge_.size()) {
        find("feature \"{}\" has edge {}, which the part has not", f.name, edge);
      } else if (feature_of_edge_[edge] != nullptr) {
        find("edge {} belongs to two features", edge);
      } else {
        feature_of_edge_[edge] = &f;
      }
    }
}

std::vector<DemandCheck::Rim> DemandCheck::rims() const {
  std::vector<Rim> rims;
  for (const WrittenFeature& f : d_.features)
    if (f.finished)
      for (const std::size_t k : sides_of(f)) rims.push_back({k, f.finished->low});
  return rims;
}

std::vector<std::size_t> DemandCheck::sides_of(const WrittenFeature& feature) const {
  std::vector<std::size_t> sides;
  for (const std::size_t edge : feature.edges)
    if (edge < sides_of_edge_.size())
      sides.insert(sides.end(), sides_of_edge_[edge].begin(), sides_of_edge_[edge].end());
  return sides;
}

bool DemandCheck::any_cap() const {
  return std::any_of(d_.features.begin(), d_.features.end(),
                     [](const WrittenFeature& f) { return f.most().has_value(); });
}

double DemandCheck::least_scale() const {
  double least = kInfinity;
  for (const WrittenFeature* const f : feature_of_edge_)
    if (f == nullptr || !f->finished) least = std::min(least, f == nullptr ? 1 : f->scale.low);
  return least == kInfinity ? 1 : least;
}

std::vector<std::size_t> DemandCheck::unfinished_sides() const {
  std::vector<std::size_t> sides;
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge)
    if (feature_of_edge_[edge] == nullptr || !feature_of_edge_[edge]->finished)
      sides.insert(sides.end(), sides_of_edge_[edge].begin(), sides_of_edge_[edge].end());
  return sides;
}

void DemandCheck::check_placement() {
  if (d_.margin.high < 0) return;
  check_minima();
  check_material();
  check_depth(unfinished_sides(), (d_.largest - off_).low, "the part");
  for (const WrittenFeature& f : d_.features) {
    if (f.most()) check_depth(sides_of(f), (*f.most() - off_).low, "feature \"" + f.name + "\"");
  }
}

void DemandCheck::check_minima() {
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge) {
    const WrittenFeature* const f = feature_of_edge_[edge];
    if (f != nullptr && f->finished) continue;
    const Span needed = f == nullptr ? d_.minimum + d_.margin : f->minimum + f->scale * d_.margin;
    for (const std::size_t k : sides_of_edge_[edge]) {
      const Span apart = distance(placed_.sides[k], blank_);
      if (surely_above(apart, needed + off_)) continue;
      find("edge {} needs {} mm for the margin {}, but is {} mm from the outline of the blank", edge,
           needed.low, d_.margin.low, (apart - off_).low);
      return;
    }
    if (holds(blank_, placed_.sides[sides_of_edge_[edge].front()].from) != true) {
      find("edge {} is not inside the blank, or cannot be told from it", edge);
      return;
    }
  }
}

/// Only the rims of finished features may stick out: where the blank's outline runs through the part's
/// material, it must do so within such a rim.
void DemandCheck::check_material() {
  const std::vector<Rim> rims = this->rims();
  if (rims.empty()) {
    if (lies_within(placed_, blank_) != true)
      find("the margin is not negative, but the part is not inside the blank");
    return;
  }
  std::size_t looked = 0;
  for (const Side& side : blank_.sides)
    if (!beside_finished(side, rims, looked))
      return find("the outline of the blank runs through the part's material beside its finished features");
}

bool DemandCheck::beside_finished(const Side& whole, const std::vector<Rim>& rims,
                                  std::size_t& looked) const {
  std::vector<Side> open{whole};
  while (!open.empty()) {
    if (looked++ == kMostPieces) return false;
    const Side piece = open.back();
    open.pop_back();
    // No point of this piece lies in the part.
    if (is_positive(distance(piece, placed_)) && holds(placed_, piece.from) == false) continue;
    if (piece.sweep == Sweep::less) {
      const Corners corners = corners_of(piece);
      const auto in_rim = [&](const Rim& rim) {
        return surely_above(just(rim.by), just(farthest(piece, corners, placed_.sides[rim.side])) + off_);
      };
      if (std::any_of(rims.begin(), rims.end(), in_rim)) continue;
    }
    // A piece that begins in the part and beside all rims has a half that does, too, however often it is
    // halved.
    const auto beside = [&](const Rim& rim) {
      return surely_above(distance(piece.from, placed_.sides[rim.side]), just(rim.by));
    };
    if (std::all_of(rims.begin(), rims.end(), beside) && holds(placed_, piece.from) == true) return false;
    for (const Side& half : halves(piece)) open.push_back(half);
  }
  return true;
}

/// No point of these sides of the placed part may lie deeper in the blank than `most`.
void DemandCheck::check_depth(const std::vector<std::size_t>& sides, double most, const std::string& whose) {
  bool refuted = false;
  if (!is_depth_kept(sides, most, refuted))
    find("{} has an allowance above {} mm, or cannot be told from it", whose, most);
}

bool DemandCheck::is_depth_kept(const std::vector<std::size_t>& sides, double most, bool& refuted) const {
  std::vector<Side> open;
  for (const std::size_t k : sides) open.push_back(placed_.sides[k]);
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    const Side piece = open.back();
    open.pop_back();
    if (piece.sweep == Sweep::less) {
      const Corners corners = corners_of(piece);
      bool near_enough = false;
      blank_.tree->visit_near(box_of(piece), most, [&](std::size_t k) {
        near_enough =
            near_enough || surely_above(just(most), just(farthest(piece, corners, blank_.sides[k])));
      });
      if (near_enough) continue;
      // No point of this piece lies in the blank.
      if (is_positive(distance(piece, blank_)) && holds(blank_, piece.from) == false) continue;
      refuted = surely_above(signed_distance(piece.from, blank_), just(most));
      if (refuted) return false;
    }
    if (looked == kMostPieces) return false;
    for (const Side& half : halves(piece)) open.push_back(half);
  }
  return true;
}

/// Says whether every point of a side of the placed part is shown to have an allowance of `needed`, which may
/// be below 0. It then has that from every point of the blank's outline too, so that what lies within a
/// distance of the side sticks out by no more than the distance less the allowance.
bool DemandCheck::keeps(const Side& whole, Span needed) const {
  std::vector<Side> open{whole};
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    const Side piece = open.back();
    open.pop_back();
    if (looked == kMostPieces) return false;
    if (piece.sweep == Sweep::less) {
      const Vec middle = piece.arc ? piece.from : (piece.from + piece.to) * just(0.5);
      double apart = kInfinity;
      for (const Side& side : blank_.sides) apart = std::min(apart, distance(piece, side).low);
      if (apart > std::max(0.0, needed.high) && holds(blank_, middle) == true) continue;
      const Corners corners = corners_of(piece);
      const auto near = [&](const Side& side) {
        return surely_above(-needed, just(farthest(piece, corners, side)));
      };
      if (std::any_of(blank_.sides.begin(), blank_.sides.end(), near)) continue;
      if (surely_above(needed, signed_distance(middle, blank_))) return false;
    }
    for (const Side& half : halves(piece)) open.push_back(half);
  }
  return true;
}

/// Says whether no point within `by` of a side of the placed part sticks out of the blank by more than
/// `most`. What a side demands may reach into a hole or a notch of the blank and end there, however little
/// allowance the side has.
bool DemandCheck::sticks_out_less(const Side& side, double by, double most, std::size_t& looked) const {
  struct Square {
    Vec centre;
    double half = 0;
  };
  const Box box = box_of(side);
  // The first one is twice as large as it has to be, so that rounding does not matter.
  std::vector<Square> open{
      {{just(0.5 * box.low_x + 0.5 * box.high_x), just(0.5 * box.low_y + 0.5 * box.high_y)},
       std::max(box.high_x - box.low_x, box.high_y - box.low_y) + by + by}};
  while (!open.empty()) {
    if (looked++ == kMostPieces) return false;
    const Square square = open.back();
    open.pop_back();
    const double radius = length(Vec{just(square.half), just(square.half)}).high;
    const Span from_side = distance(square.centre, side), out = distance(square.centre, blank_);
    if (surely_above(from_side, just(by) + just(radius))) continue;
    if (surely_above(just(most), out + just(radius))) continue;
    if (surely_above(out, just(radius)) && holds(blank_, square.centre) == true) continue;
    if (surely_above(out, just(most)) && surely_above(just(by), from_side) &&
        holds(blank_, square.centre) == false)
      return false;
    const double quarter = 0.5 * square.half;
    for (const double dx : {-quarter, quarter})
      for (const double dy : {-quarter, quarter})
        open.push_back({square.centre + Vec{just(dx), just(dy)}, quarter});
  }
  return true;
}

/// Says whether a point within `by` of a side of the part surely sticks out by more.
bool DemandCheck::grown_sticks_out(std::size_t side, Span by, double more_than) const {
  // A finished edge is cut in and has nothing around it, and a point beyond a part's other side is of no edge
  // here.
  if (by.low < 0) return false;
  for (const Vec& p : points_of(placed_.sides[side])) {
    const Side& s = placed_.sides[side];
    const Vec along = s.arc ? p - s.centre : s.to - s.from;
    const Vec normal = unit(s.arc ? along : Vec{-along.y, along.x});
    for (const Vec& q : {p, p + normal * just(by.low), p - normal * just(by.low)})
      if (surely_above(just(-more_than), signed_distance(q, blank_))) return true;
  }
  return false;
}

bool DemandCheck::check_missing() {
  if (!(d_.margin.low < 0)) return true;
  bool shown = true;
  const double missing = (off_ - d_.margin).low, most = (-d_.margin - off_).low;
  std::size_t looked = 0;
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge) {
    const WrittenFeature* const f = feature_of_edge_[edge];
    const bool rim = f != nullptr && f->finished;
    const Span minimum = f == nullptr ? d_.minimum : (rim ? -*f->finished : f->minimum);
    for (const std::size_t k : sides_of_edge_[edge]) {
      if (keeps(placed_.sides[k], minimum + d_.margin + off_)) continue;
      if (grown_sticks_out(k, minimum, missing)) {
        find("at edge {} more is missing than the {} mm that the margin says", edge, -d_.margin.high);
        return true;
      }
      if (rim || !sticks_out_less(placed_.sides[k], minimum.high, most, looked)) shown = false;
    }
  }
  for (const WrittenFeature& f : d_.features) {
    bool refuted = false;
    if (!f.most() || is_depth_kept(sides_of(f), (*f.most() - d_.margin - off_).low, refuted)) continue;
    if (refuted) {
      find("feature \"{}\" has more than its maximum by more than the {} mm that the margin says", f.name,
           -d_.margin.high);
      return true;
    }
    shown = false;
  }
  return shown;
}

bool DemandCheck::leaves_choice_open() const {
  return sgn(d_.margin_found.digits) >= 0 && !knows_criterion(d_.criterion);
}

void DemandCheck::check_criteria(bool optimal) {
  if (above(d_.margin_found, d_.margin_bound_as_written))
    find("margin_found {} is above margin_bound", approximate(d_.margin_found));
  if (above(d_.margin_as_written, d_.margin_bound_as_written))
    find("margin {} is above margin_bound", approximate(d_.margin_as_written));
  if (optimal && above(d_.margin_bound_as_written - d_.margin_found, d_.margin_gap) &&
      differ(d_.margin_bound_as_written - d_.margin_found, d_.margin_gap, d_.margin_found))
    find("status is optimal, but margin_bound is {} above margin_found, more than {}",
         approximate(d_.margin_bound_as_written - d_.margin_found), approximate(d_.margin_gap));
  const bool met = sgn(d_.margin_found.digits) >= 0;
  if (!met || d_.criterion == "smallest") {
    if (d_.second) find("there is a smallest_largest, which was not asked for or cannot be");
    if (compare(d_.margin_as_written, d_.margin_found) != 0) find("margin_found is not margin");
    return;
  }
  const Decimal kept = above(d_.give_up, d_.margin_found) ? Decimal{} : d_.margin_found - d_.give_up;
  if (!d_.second) {
    if (!leaves_choice_open()) return find("smallest_largest is missing, the second criterion");
    if (above(kept, d_.margin_as_written) && differ(d_.margin_as_written, kept, d_.margin_found))
      find("the margin {} is below {}, margin_found less give_up", approximate(d_.margin_as_written),
           approximate(kept));
    return;
  }
  const WrittenSecond& s = *d_.second;
  if (differ(s.margin, kept, d_.margin_found))
    find("smallest_largest.margin {} is not margin_found less give_up", approximate(s.margin));
  if (above(s.margin, d_.margin_as_written))
    find("the margin {} is below {}, which was not to be given up", approximate(d_.margin_as_written),
         approximate(s.margin));
  if (above(s.bound, s.found)) find("smallest_largest.bound {} is above found", approximate(s.bound));
  const bool open = above(s.found - s.bound, s.gap);
  if (open ? differ(s.kept, s.found, s.gap) : differ(s.kept - s.bound, s.gap, s.kept))
    find("smallest_largest.kept {} is neither bound and gap nor found", approximate(s.kept));
  const Decimal& limit = d_.criterion == "largest" ? s.found : s.kept;
  if (above(d_.largest_as_written, limit))
    find("largest {} is above {}, which the second criterion found", approximate(d_.largest_as_written),
         approximate(limit));
  if (optimal && above(s.found - s.bound, s.gap) && differ(s.found - s.bound, s.gap, s.found))
    find("status is optimal, but smallest_largest.found is {} above its bound, more than {}",
         approximate(s.found - s.bound), approximate(s.gap));
  if (!s.proof && sgn(s.bound.digits) > 0)
    find("nothing is said to prove smallest_largest.bound {}", approximate(s.bound));
}

std::vector<double> DemandCheck::growth(Span grown_for) const {
  std::vector<double> growth(part_.sides.size(), 0.0);
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge) {
    const WrittenFeature* const f = feature_of_edge_[edge];
    const Span by = f == nullptr  ? d_.minimum + grown_for
                    : f->finished ? -*f->finished
                                  : f->minimum + f->scale * grown_for;
    // Sums are rounded outwards, so a side that grows by 0 may come out negative, which would mean a rim.
    const bool rim = f != nullptr && f->finished;
    for (const std::size_t k : sides_of_edge_[edge]) growth[k] = rim ? by.low : std::max(0.0, by.low);
  }
  return growth;
}

std::vector<CoverTree::Cap> DemandCheck::caps(Span shift, const std::optional<Span>& most) const {
  std::vector<CoverTree::Cap> caps;
  for (const WrittenFeature& f : d_.features) {
    if (f.most()) caps.push_back({sides_of(f), (*f.most() + shift).high});
  }
  if (most) caps.push_back({unfinished_sides(), (*most + shift).high});
  return caps;
}

double DemandCheck::off_grown_part(const Vec& p, Span grown_for) const {
  const std::vector<double> by = growth(grown_for);
  double off = off_rims(part_, by, p);
  // Every point of a side demands something, also one that lies in the rim of another side.
  for (std::size_t k = 0; k < by.size(); ++k)
    if (by[k] >= 0)
      off = std::min(off, std::max(0.0, (just(distance(p, part_.sides[k]).high) - just(by[k])).high));
  return off;
}

/// A placement with a margin above margin_bound that keeps the maxima must contradict the certificate, which
/// bounds the least of two numbers. The part grown for grown_for would have a clearance of at least the least
/// scale times the difference (its finished features, where they have `bound` to spare), and each cap would
/// have more left than `shift`. So neither number may be below `bound`.
void DemandCheck::check_bound() {
  if (surely_above(just(0), d_.margin_bound)) {
    // Here the demands themselves cannot be met.
    if (!(d_.grown_for.high == 0 && d_.bound.high <= d_.margin_bound.low))
      find("margin_bound {} does not follow from the bound {} of the certificate", d_.margin_bound.low,
           d_.bound.low);
    return;
  }
  const Span spare = just(least_scale()) * (d_.margin_bound - d_.grown_for);
  if (surely_above(d_.grown_for, d_.margin_bound) || surely_above(d_.bound, spare))
    find("margin_bound {} does not follow from the bound {} of the certificate", d_.margin_bound.low,
         d_.bound.low);
  if (any_cap() && surely_above(d_.bound, d_.shift))
    find(
        "the certificate's bound {} is above its shift {}: it says nothing of placements that keep the "
        "maxima",
        d_.bound.low, d_.shift.low);
}

/// A placement with a margin of at least `margin` that keeps the maxima has two properties. The part grown
/// for grown_for has a clearance of at least the least scale times the difference, and each cap of a feature
/// has `shift` or more left. Both are above what the certificate bounds, so it is the cap on all edges that
/// has no more left than the certificate says.
void DemandCheck::check_largest_bound() {
  const WrittenSecond& s = *d_.second;
  const WrittenSecond::Proof& p = *s.proof;
  const Span spare = just(least_scale()) * (enclosed(s.margin) - enclosed(p.grown_for));
  if (above(p.grown_for, s.margin) || !surely_above(spare, p.bound))
    find("the certificate of largest allowances says nothing of placements with a margin of {}",
         approximate(s.margin));
  if (any_cap() && !surely_above(p.shift, p.bound))
    find("the bound {} of the certificate of largest allowances is not below its shift {}", p.bound.low,
         p.shift.low);
  if (!surely_above(p.most + p.shift - p.bound, enclosed(s.bound)))
    find("smallest_largest.bound {} does not follow from the bound {} of its certificate",
         approximate(s.bound), p.bound.low);
}

}  // namespace lekalo::verify
