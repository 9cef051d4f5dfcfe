#include "placer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "lekalo/base/stop.hpp"
#include "lekalo/layout/check.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

constexpr std::uint32_t kPart = 1, kBorder = 2, kDefect = 4, kZone = 8;  ///< layers of a scene
constexpr phi::ShapeIndex kNone = ~phi::ShapeIndex{0};

std::int64_t in_steps(double mm) { return std::llround(mm * static_cast<double>(geom::kGridPerMm)); }

}  // namespace

Placer::Placer(const Problem& problem, const Items& items, Random random, Counts counts)
    : problem_(problem), items_(items), random_(random), counts_(counts), scenes_(problem.bins().size()) {
  for (std::size_t i = 0; i < items.movable(); ++i) area_ += problem.area_of(items.parts[i]);
}

void Placer::load(const State& state) {
  state_ = state;
  for (auto& scene : scenes_) scene.reset();
  loaded_.clear();
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state_.spots[i].bin != kNowhere) loaded_[state_.spots[i].bin].push_back(i);
}

Placer::BinScene& Placer::scene_of(std::uint32_t b) {
  if (scenes_[b]) return *scenes_[b];
  const layout::Document& document = problem_.document();
  const Bin& bin = problem_.bins()[b];
  const layout::Stock& stock = document.stocks[bin.stock];
  geom::GridBox world = geom::bounds(stock.outline.polygon);
  if (bin.open) {  // the scene is only as long as the items may get
    double area = 0;
    for (std::size_t i = 0; i < items_.movable(); ++i) area += problem_.hull_area_of(items_.parts[i]);
    const double length = std::max(state_.ends[b] - bin.box.x0, 2 * area / (bin.box.y1 - bin.box.y0));
    world.high.x = std::min(world.high.x, world.low.x + in_steps(length) + 1);
  }
  // Most bins hold a small share of all items.
  const double share = std::min(1.0, bin.area / area_);
  const auto most = static_cast<std::size_t>(share * static_cast<double>(items_.movable()));
  BinScene& made = scenes_[b].emplace(BinScene{
      phi::Scene(world, 2 * most + 64), std::vector<phi::ShapeIndex>(problem_.forms().size(), kNone), {}});
  made.scene.put(
      {.shape = made.scene.add_shape(stock.outline.polygon), .layers = kBorder, .container = true});
  if (counts_ == Counts::border) return made;
  for (const layout::Defect& defect : stock.defects)
    made.scene.put({.shape = made.scene.add_shape(defect.outline.polygon),
                    .layers = kDefect,
                    .rank = std::int64_t{defect.severity}});
  for (std::uint32_t z = 0; z < stock.zones.size(); ++z) {
    const phi::BodyIndex body = made.scene.put({.shape = made.scene.add_shape(stock.zones[z].outline.polygon),
                                                .layers = kZone,
                                                .rank = -std::int64_t{stock.zones[z].quality}});
    made.zones.resize(body + std::size_t{1});
    made.zones[body] = z;
  }
  if (counts_ == Counts::features) return made;
  const std::span<const layout::Placement> placements(document.placements);
  for (const layout::Placement& p : placements.first(bin.holds_locked ? placements.size() : 0)) {
    if (!p.locked || p.stock != bin.stock || p.copy != bin.copy) continue;
    const layout::Part& part = document.parts[p.part];
    made.scene.put({.shape = made.scene.add_shape(geom::turned(part.outline.polygon, p.rotation, p.mirrored)),
                    .at = p.at,
                    .gap = layout::gap_between(document, part, part),
                    .layers = kPart});
  }
  // Items that came later have found the scene made.
  if (const auto lying = loaded_.find(b); lying != loaded_.end())
    for (const std::size_t i : lying->second) put(i);
  return made;
}

phi::ShapeIndex Placer::shape(BinScene& in, std::uint32_t form, std::uint32_t part) {
  phi::ShapeIndex& index = in.shapes[form];
  const Form& f = problem_.forms()[form];
  if (index == kNone)
    index = in.scene.add_shape(
        geom::turned(problem_.document().parts[part].outline.polygon, f.rotation, f.mirrored));
  return index;
}

void Placer::put(std::size_t i) {
  const Spot& spot = state_.spots[i];
  BinScene& in = *scenes_[spot.bin];
  const layout::Document& document = problem_.document();
  const layout::Part& part = document.parts[items_.parts[i]];
  in.scene.put({.shape = shape(in, spot.form, items_.parts[i]),
                .at = {in_steps(spot.x), in_steps(spot.y)},
                .gap = layout::gap_between(document, part, part),
                .layers = kPart});
}

Placer::Range Placer::range_of(std::size_t i, std::uint32_t form, std::uint32_t b) {
  if (!problem_.follows_grain(form, b)) return {1, 0, 1, 0};
  BinScene& in = scene_of(b);
  const Bin& bin = problem_.bins()[b];
  const layout::Document& document = problem_.document();
  const geom::GridBox& box = in.scene.box(shape(in, form, items_.parts[i]));
  const std::int64_t gap = layout::border_gap_of(document, document.parts[items_.parts[i]]);
  return {in_steps(bin.box.x0) + gap - box.low.x, in_steps(state_.ends[b]) - gap - box.high.x,
          in_steps(bin.box.y0) + gap - box.low.y, in_steps(state_.tops[b]) - gap - box.high.y};
}

bool Placer::can_hold(std::uint32_t bin, std::size_t i) {
  const Forms& forms = items_.forms[i];
  for (std::uint32_t f = forms.first; f < forms.last; ++f) {
    const Range r = range_of(i, f, bin);
    if (r.x1 >= r.x0 && r.y1 >= r.y0) return true;
  }
  return false;
}

bool Placer::is_free(std::size_t i, std::uint32_t form, std::uint32_t b, geom::GridPoint at) {
  ++work_;
  ask();
  const layout::Document& document = problem_.document();
  const std::uint32_t p = items_.parts[i];
  const layout::Part& part = document.parts[p];
  const layout::Stock& stock = document.stocks[problem_.bins()[b].stock];
  if (too_far_from_partner(problem_, items_, state_, i,
                           {geom::mm_from_grid(at.x), geom::mm_from_grid(at.y), form, b}) > 0)
    return false;
  BinScene& in = scene_of(b);
  phi::Probe probe{.shape = shape(in, form, p), .at = at};
  probe.layers = kPart, probe.gap = layout::gap_between(document, part, part);
  if (in.scene.forbidden(probe)) return false;
  probe.layers = kBorder, probe.gap = layout::border_gap_of(document, part);
  if (in.scene.forbidden(probe)) return false;
  if (counts_ == Counts::border) return true;
  probe.layers = kDefect, probe.gap = layout::defect_gap_of(document, part);
  probe.tolerates = part.tolerated_severity;
  if (!stock.defects.empty() && in.scene.forbidden(probe)) return false;
  if (stock.zones.empty()) return true;
  if (part.areas.empty()) {
    probe.layers = kZone, probe.gap = 0, probe.tolerates = -std::int64_t{part.quality};
    return !in.scene.forbidden(probe);
  }
  layout::Placement placement;
  placement.part = p;
  placement.stock = problem_.bins()[b].stock;
  placement.rotation = problem_.forms()[form].rotation;
  placement.mirrored = problem_.forms()[form].mirrored;
  placement.at = at;
  const geom::GridRegion outline = geom::moved(in.scene.outline(probe.shape), at);
  for (const phi::BodyIndex body : in.scene.near(geom::bounds(outline), 0, kZone))
    if (layout::quality_violation(document, placement, outline, in.zones[body], layout::Depths::left_out))
      return false;
  return true;
}

bool Placer::place_low(std::size_t i, std::uint32_t bin, std::size_t samples) {
  const Forms& forms = items_.forms[i];
  const std::uint32_t partner = items_.partners.empty() ? kNowhere : items_.partners[i];
  const bool has_partner = partner != kNowhere && state_.spots[partner].bin == bin;
  bool found = false;
  geom::GridPoint best;
  std::uint32_t best_form = forms.first;
  double best_cost = std::numeric_limits<double>::infinity();
  BinScene& in = scene_of(bin);
  for (std::size_t k = 0; k < samples; ++k) {
    const std::uint32_t form =
        forms.first + static_cast<std::uint32_t>(random_.below(forms.last - forms.first));
    Range r = range_of(i, form, bin);
    if (r.x1 < r.x0 || r.y1 < r.y0) continue;
    const geom::GridBox& box = in.scene.box(in.shapes[form]);
    const auto cost_of = [&](geom::GridPoint at) {
      return static_cast<double>(at.x + box.high.x) + tuning::kDown * static_cast<double>(at.y + box.high.y);
    };
    if (has_partner) {
      const Spot& other = state_.spots[partner];
      const Box &a = problem_.forms()[form].box, &b = problem_.forms()[other.form].box;
      const std::int64_t reach = in_steps(items_.pair_reach);
      const std::int64_t x = in_steps(other.x + 0.5 * (b.x0 + b.x1 - a.x0 - a.x1)),
                         y = in_steps(other.y + 0.5 * (b.y0 + b.y1 - a.y0 - a.y1));
      r = {std::max(r.x0, x - reach), std::min(r.x1, x + reach), std::max(r.y0, y - reach),
           std::min(r.y1, y + reach)};
    }
    // No place further right than the best one is better.
    if (found) r.x1 = std::min(r.x1, static_cast<std::int64_t>(best_cost - cost_of({0, r.y0})));
    if (r.x1 < r.x0 || r.y1 < r.y0) continue;
    const auto between = [&](std::int64_t low, std::int64_t high) {
      return std::clamp(std::llround(random_.uniform(static_cast<double>(low), static_cast<double>(high))),
                        static_cast<long long>(low), static_cast<long long>(high));
    };
    geom::GridPoint at;
    at.x = between(r.x0, r.x1);
    at.y = between(r.y0, r.y1);
    if (cost_of(at) >= best_cost || !is_free(i, form, bin, at)) continue;
    const auto side = static_cast<double>(std::min(box.high.x - box.low.x, box.high.y - box.low.y));
    for (double step = tuning::kFirstSlide * side; step > tuning::kLastSlide * side && step >= 1;) {
      bool moved = false;
      for (const bool left : {true, false}) {
        geom::GridPoint to = at;
        if (left)
          to.x = std::max(r.x0, at.x - static_cast<std::int64_t>(step));
        else
          to.y = std::max(r.y0, at.y - static_cast<std::int64_t>(step));
        if (to == at || !is_free(i, form, bin, to)) continue;
        at = to;
        moved = true;
      }
      if (!moved) step *= 0.5;
    }
    found = true;
    best = at;
    best_form = form;
    best_cost = cost_of(at);
  }
  if (!found) return false;
  state_.spots[i] = {geom::mm_from_grid(best.x), geom::mm_from_grid(best.y), best_form, bin};
  put(i);
  return true;
}

void Placer::open_bin(std::uint32_t bin) { state_.open_bins.push_back(bin); }

void Placer::close_bin(std::uint32_t bin) {
  std::erase(state_.open_bins, bin);
  scenes_[bin].reset();
}

}  // namespace lekalo::nest
