#include "demand_check.hpp"

#include <algorithm>

#include "interval.hpp"
#include "shape_distance.hpp"
#include "shape_inside.hpp"
#include "stretch.hpp"

namespace lekalo::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Pieces of outlines that are looked at for one claim before it counts as not confirmed.
constexpr std::size_t kMostPieces = 200'000;

Span enclosed(const Decimal& value) {
  const Interval interval(value, 64);
  return {interval.low_double(), interval.high_double()};
}

bool is_positive(Span value) { return value.low > 0; }

}  // namespace

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
  if (d.grown_for.low < 0) fields.complain("demands.grown_for is negative");
  if (d.minimum.low < 0) fields.complain("demands.minimum is negative");
  fields.each("features", [&](Json item, const std::string& path) {
    Fields feature(item, path, complaint);
    WrittenFeature f;
    f.name = feature.text("name");
    feature.each("edges",
                 [&](Json edge, const std::string& at) { f.edges.push_back(feature.index_of(edge, at)); });
    f.minimum = enclosed(feature.number("minimum")), f.scale = enclosed(feature.number("scale"));
    if (const auto most = feature.number_or_null("maximum")) f.maximum = enclosed(*most);
    if (const auto off = feature.number_or_null("finished")) f.finished = enclosed(*off);
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
  // What joins an arc's end to its circle belongs to the edge beside it.
  for (std::size_t k = 0; k < part.sides.size(); ++k) {
    if (part.sides[k].written || sides_of_edge_.empty()) sides_of_edge_.emplace_back();
    sides_of_edge_.back().push_back(k);
  }
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

bool DemandCheck::any_finished() const {
  return std::any_of(d_.features.begin(), d_.features.end(),
                     [](const WrittenFeature& f) { return f.finished.has_value(); });
}

void DemandCheck::check_placement() {
  if (d_.margin.high < 0) return;
  check_minima();
  check_material();
  std::vector<std::size_t> free;
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge)
    if (feature_of_edge_[edge] == nullptr || !feature_of_edge_[edge]->finished)
      free.insert(free.end(), sides_of_edge_[edge].begin(), sides_of_edge_[edge].end());
  check_depth(free, (d_.largest - off_).low, "the part");
  for (const WrittenFeature& f : d_.features) {
    if (!f.maximum && !f.finished) continue;
    std::vector<std::size_t> sides;
    for (const std::size_t edge : f.edges)
      if (edge < sides_of_edge_.size())
        sides.insert(sides.end(), sides_of_edge_[edge].begin(), sides_of_edge_[edge].end());
    check_depth(sides, ((f.finished ? *f.finished : *f.maximum) - off_).low, "feature \"" + f.name + "\"");
  }
}

void DemandCheck::check_minima() {
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge) {
    const WrittenFeature* const f = feature_of_edge_[edge];
    if (f != nullptr && f->finished) continue;
    const Span needed = f == nullptr ? d_.minimum + d_.margin : f->minimum + f->scale * d_.margin;
    for (const std::size_t k : sides_of_edge_[edge]) {
      Span apart{kInfinity, kInfinity};
      for (const Side& side : blank_.sides) {
        const Span d = distance(placed_.sides[k], side);
        apart = {std::min(apart.low, d.low), std::min(apart.high, d.high)};
      }
      if ((needed + off_).high <= apart.low) continue;
      find("edge {} needs {} mm for the margin {}, but is {} mm from the outline of the blank", edge,
           needed.low, d_.margin.low, (apart - off_).low);
      return;
    }
    const std::optional<bool> in = holds(blank_, placed_.sides[sides_of_edge_[edge].front()].from);
    if (!in || !*in) {
      find("edge {} is not inside the blank, or cannot be told from it", edge);
      return;
    }
  }
}

/// Nothing but the rims of finished features may stick out: where the blank's outline runs through the part's
/// material, it does so within such a rim.
void DemandCheck::check_material() {
  if (!any_finished()) {
    const std::optional<bool> inside = lies_within(placed_, blank_);
    if (!inside || !*inside) find("the margin is not negative, but the part is not inside the blank");
    return;
  }
  std::size_t looked = 0;
  for (const Side& side : blank_.sides)
    if (!beside_finished(side, looked))
      return find("the outline of the blank runs through the part's material beside its finished features");
}

bool DemandCheck::beside_finished(const Side& whole, std::size_t& looked) const {
  std::vector<Side> open{whole};
  while (!open.empty()) {
    if (++looked > kMostPieces) return false;
    const Side piece = open.back();
    open.pop_back();
    const Vec middle = piece.arc ? piece.from : (piece.from + piece.to) * just(0.5);
    const double reach = farthest(piece, middle);
    const Span from_part = distance(middle, placed_);
    if (from_part.low > reach) {
      const auto in = holds(placed_, middle);
      if (in && !*in) continue;  // none of it in the part
    }
    bool in_rim = false;
    const bool short_arc = !piece.arc || piece.sweep == Sweep::less;
    if (short_arc) {
      const Corners corners = corners_of(piece);
      for (std::size_t edge = 0; edge < sides_of_edge_.size() && !in_rim; ++edge) {
        const WrittenFeature* const f = feature_of_edge_[edge];
        if (f == nullptr || !f->finished) continue;
        for (const std::size_t k : sides_of_edge_[edge])
          in_rim =
              in_rim || (just(farthest(piece, corners, placed_.sides[k])) + off_).high <= f->finished->low;
      }
    }
    if (in_rim) continue;
    const auto two = halves(piece);
    open.insert(open.end(), two.begin(), two.end());
  }
  return true;
}

/// No point of these sides of the placed part lies deeper in the blank than `most`.
void DemandCheck::check_depth(const std::vector<std::size_t>& sides, double most, const std::string& whose) {
  std::vector<Side> open;
  for (const std::size_t k : sides) open.push_back(placed_.sides[k]);
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    const Side piece = open.back();
    open.pop_back();
    if (piece.arc && piece.sweep != Sweep::less) {
      for (const Side& half : halves(piece)) open.push_back(half);
      continue;
    }
    const Corners corners = corners_of(piece);
    const auto near_enough = [&](const Side& side) { return farthest(piece, corners, side) <= most; };
    if (std::any_of(blank_.sides.begin(), blank_.sides.end(), near_enough)) continue;
    const Vec middle = (piece.from + piece.to) * just(0.5);
    if (distance(middle, blank_).low > farthest(piece, middle)) {
      const auto in = holds(blank_, middle);
      if (in && !*in) continue;  // none of it in the blank
    }
    if (signed_distance(piece.from, blank_).low > most || looked == kMostPieces)
      return find("{} has an allowance above {} mm, or cannot be told from it", whose, most);
    for (const Side& half : halves(piece)) open.push_back(half);
  }
}

std::vector<double> DemandCheck::growth() const {
  std::vector<double> growth(part_.sides.size(), 0.0);
  for (std::size_t edge = 0; edge < sides_of_edge_.size(); ++edge) {
    const WrittenFeature* const f = feature_of_edge_[edge];
    const Span by = f == nullptr  ? d_.minimum + d_.grown_for
                    : f->finished ? -*f->finished
                                  : f->minimum + f->scale * d_.grown_for;
    // Sums are rounded outwards: what grows by 0 is no rim.
    const bool rim = f != nullptr && f->finished;
    for (const std::size_t k : sides_of_edge_[edge]) growth[k] = rim ? by.low : std::max(0.0, by.low);
  }
  return growth;
}

std::vector<CoverTree::Cap> DemandCheck::caps() const {
  std::vector<CoverTree::Cap> caps;
  for (const WrittenFeature& f : d_.features) {
    if (!f.maximum && !f.finished) continue;
    CoverTree::Cap cap;
    cap.most = ((f.finished ? *f.finished : *f.maximum) + d_.shift).high;
    for (const std::size_t edge : f.edges)
      if (edge < sides_of_edge_.size())
        cap.sides.insert(cap.sides.end(), sides_of_edge_[edge].begin(), sides_of_edge_[edge].end());
    caps.push_back(std::move(cap));
  }
  return caps;
}

double DemandCheck::off_grown_part(const Vec& p) const {
  const std::vector<double> by = growth();
  const auto beside_rims = [&](const auto& distance_from) {  // no finished side is as near as its rim is wide
    for (std::size_t k = 0; k < by.size(); ++k)
      if (by[k] < 0 && !((just(distance_from(part_.sides[k]).low) + just(by[k])).low >= 0)) return false;
    return true;
  };
  const std::optional<bool> in = holds(part_, p);
  if (in && *in && beside_rims([&](const Side& side) { return distance(p, side); })) return 0;
  double off = kInfinity;
  for (std::size_t k = 0; k < by.size(); ++k) {
    if (by[k] < 0) continue;
    if (by[k] == 0 && !beside_rims([&](const Side& side) { return distance(part_.sides[k], side); }))
      continue;
    off = std::min(off, std::max(0.0, (just(distance(p, part_.sides[k]).high) - just(by[k])).high));
  }
  return off;
}

/// A placement with a margin above margin_bound that keeps the maxima: the part grown for grown_for has a
/// clearance of at least scale times the difference, for the least scale (its finished features if they have
/// `bound` to spare), and each cap has more left than `shift`. So that much must be above `bound`.
void DemandCheck::check_bound() {
  if (d_.margin_bound.high < 0) {
    // The demands themselves cannot be met.
    if (!(d_.grown_for.low == 0 && d_.grown_for.high == 0 && d_.bound.high <= d_.margin_bound.low))
      find("margin_bound {} does not follow from the bound {} of the certificate", d_.margin_bound.low,
           d_.bound.low);
    return;
  }
  double least_scale = kInfinity;
  for (const WrittenFeature* const f : feature_of_edge_)
    if (f == nullptr || !f->finished) least_scale = std::min(least_scale, f == nullptr ? 1 : f->scale.low);
  if (least_scale == kInfinity) least_scale = 1;
  const Span spare = just(least_scale) * (d_.margin_bound - d_.grown_for);
  if (!((d_.margin_bound - d_.grown_for).high >= 0 && d_.bound.low <= spare.high))
    find("margin_bound {} does not follow from the bound {} of the certificate", d_.margin_bound.low,
         d_.bound.low);
  const bool capped = std::any_of(d_.features.begin(), d_.features.end(),
                                  [](const WrittenFeature& f) { return f.maximum || f.finished; });
  if (capped && !(d_.bound.low <= d_.shift.high))
    find(
        "the certificate's bound {} is above its shift {}: it says nothing of placements that keep the "
        "maxima",
        d_.bound.low, d_.shift.low);
}

}  // namespace lekalo::verify
