#include "lekalo/layout/check.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <tuple>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "lekalo/phi/separation.hpp"
#include "quality.hpp"

namespace lekalo::layout {
namespace {

using geom::GridRegion;

Violation on_its_own(ViolationKind kind, const Placement& placement) {
  Violation violation;
  violation.kind = kind;
  violation.a = placement.id;
  violation.stock = placement.stock;
  violation.copy = placement.copy;
  violation.at = geom::mm_from_grid(placement.at);
  return violation;
}

Violation set_apart(Violation violation, const phi::Separation& separation) {
  violation.amount_mm = separation.distance_mm;
  violation.direction = separation.direction;
  violation.at = separation.at;
  return violation;
}

/// Completes a violation of a gap without overlap. The way out is straight away from `other`, be it a defect
/// or the border of the stock.
Violation too_near(Violation violation, const GridRegion& outline, const GridRegion& other,
                   std::int64_t gap) {
  const phi::EdgeDistance distance = phi::edge_distance(outline, other);
  violation.amount_mm = geom::mm_from_grid(gap) - distance.distance_mm;
  violation.at = distance.on_a;
  const geom::Point away = distance.on_a - distance.on_b;
  const double length = norm(away);
  if (length > 0) violation.direction = (1 / length) * away;
  return violation;
}

geom::Box grown_box(const GridRegion& outline, std::int64_t by) {
  const geom::GridBox box = bounds(outline);
  return {{static_cast<double>(box.low.x - by), static_cast<double>(box.low.y - by)},
          {static_cast<double>(box.high.x + by), static_cast<double>(box.high.y + by)}};
}

const Part& part_of(const Document& document, const Placement& placement) {
  LEKALO_ASSERT(placement.part < document.parts.size());
  return document.parts[placement.part];
}
const Stock& stock_of(const Document& document, const Placement& placement) {
  LEKALO_ASSERT(placement.stock < document.stocks.size());
  return document.stocks[placement.stock];
}

std::int64_t own_gap(const Document& document, const Part& part) noexcept {
  return part.gap.value_or(document.rules.gap);
}

/// A stock's defects and zones, found by their boxes.
struct Features {
  explicit Features(const Stock& stock) : defects(boxes(stock.defects)), zones(boxes(stock.zones)) {}
  geom::BoxTree defects, zones;

 private:
  template <class Feature>
  static geom::BoxTree boxes(const std::vector<Feature>& features) {
    std::vector<geom::Box> result;
    for (const Feature& feature : features) result.push_back(grown_box(feature.outline.polygon, 0));
    return geom::BoxTree(result);
  }
};

struct Placed {
  const Placement* placement = nullptr;
  GridRegion outline;
};

void add_stock_violations(const Document& document, const Placed& placed, const Features& features,
                          Depths depths, std::vector<Violation>& to) {
  const Placement& placement = *placed.placement;
  ask(1 + placed.outline.points.size());
  const auto add = [&](std::optional<Violation> violation) {
    if (violation) to.push_back(*violation);
  };
  add_own_violations(document, placement, to);
  add(border_violation(document, placement, placed.outline, depths));
  const std::int64_t defect_gap = defect_gap_of(document, part_of(document, placement));
  features.defects.visit_meeting(grown_box(placed.outline, defect_gap), [&](std::uint32_t defect) {
    add(defect_violation(document, placement, placed.outline, defect, depths));
  });
  features.zones.visit_meeting(grown_box(placed.outline, 0), [&](std::uint32_t zone) {
    add(quality_violation(document, placement, placed.outline, zone, depths));
  });
}

void add_pair_violations(const Document& document, const std::vector<Placed>& placed,
                         std::vector<Violation>& to) {
  std::vector<geom::Box> boxes;
  // Each box grows by its own gap, because the larger of two gaps, which counts, is no more than their sum.
  for (const Placed& one : placed)
    boxes.push_back(grown_box(one.outline, own_gap(document, part_of(document, *one.placement))));
  geom::BoxTree(boxes).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
    const bool in_order = placed[i].placement->id < placed[j].placement->id;
    const Placed &a = placed[in_order ? i : j], &b = placed[in_order ? j : i];
    if (const auto violation = pair_violation(document, *a.placement, a.outline, *b.placement, b.outline))
      to.push_back(*violation);
  });
}

void sort_violations(std::vector<Violation>& violations) {
  const auto key = [](const Violation& v) {
    return std::tuple{v.stock, v.copy, v.a, v.kind, v.b, v.feature};
  };
  std::sort(violations.begin(), violations.end(),
            [&](const Violation& p, const Violation& q) { return key(p) < key(q); });
}

}  // namespace

std::string_view name_of(ViolationKind kind) noexcept {
  switch (kind) {
    case ViolationKind::overlap:
      return "overlap";
    case ViolationKind::gap:
      return "gap";
    case ViolationKind::outside:
      return "outside";
    case ViolationKind::border_gap:
      return "border-gap";
    case ViolationKind::defect:
      return "defect";
    case ViolationKind::defect_gap:
      return "defect-gap";
    case ViolationKind::quality:
      return "quality";
    case ViolationKind::rotation:
      return "rotation";
    case ViolationKind::mirror:
      return "mirror";
    case ViolationKind::grain:
      return "grain";
    case ViolationKind::stock:
      return "stock";
  }
  return "unknown";
}

std::string feature_id(const Document& document, const Violation& v) {
  const Stock& stock = document.stocks[v.stock];
  if (v.kind == ViolationKind::defect || v.kind == ViolationKind::defect_gap)
    return stock.defects[v.feature].id;
  if (v.kind == ViolationKind::quality) return stock.zones[v.feature].id;
  return {};
}

std::int64_t gap_between(const Document& document, const Part& a, const Part& b) noexcept {
  return std::max(own_gap(document, a), own_gap(document, b));
}
std::int64_t border_gap_of(const Document& document, const Part& part) noexcept {
  return part.border_gap.value_or(document.rules.border_gap);
}
std::int64_t defect_gap_of(const Document& document, const Part& part) noexcept {
  return part.defect_gap.value_or(document.rules.defect_gap);
}

void add_own_violations(const Document& document, const Placement& placement, std::vector<Violation>& to) {
  const Part& part = part_of(document, placement);
  const Stock& stock = stock_of(document, placement);
  const auto add_unless = [&](bool allowed, ViolationKind kind) {
    if (!allowed) to.push_back(on_its_own(kind, placement));
  };
  add_unless(rotation_allowed(part, placement.rotation), ViolationKind::rotation);
  add_unless(part.may_mirror || !placement.mirrored, ViolationKind::mirror);
  add_unless(grain_allowed(part, stock, placement.rotation, placement.mirrored), ViolationKind::grain);
  add_unless(placement.copy >= 0 && placement.copy < stock.count, ViolationKind::stock);
}

std::optional<Violation> border_violation(const Document& document, const Placement& placement,
                                          const GridRegion& outline, Depths depths) {
  const GridRegion& stock = stock_of(document, placement).outline.polygon;
  if (!phi::lies_within(stock, outline)) {
    const Violation violation = on_its_own(ViolationKind::outside, placement);
    if (depths == Depths::left_out) return violation;
    if (const auto back = phi::bring_inside(stock, outline)) return set_apart(violation, *back);
    const phi::StickingOut out = phi::sticking_out(stock, outline);
    return set_apart(violation, {{}, out.distance_mm, {}, out.at});
  }
  const std::int64_t gap = border_gap_of(document, part_of(document, placement));
  if (!phi::edges_nearer_than(stock, outline, gap)) return std::nullopt;
  return too_near(on_its_own(ViolationKind::border_gap, placement), outline, stock, gap);
}

std::optional<Violation> defect_violation(const Document& document, const Placement& placement,
                                          const GridRegion& outline, std::uint32_t index, Depths depths) {
  const Part& part = part_of(document, placement);
  const Defect& defect = stock_of(document, placement).defects[index];
  if (defect.severity <= part.tolerated_severity) return std::nullopt;
  const GridRegion& hurt = defect.outline.polygon;
  Violation violation = on_its_own(ViolationKind::defect, placement);
  violation.feature = index;
  if (phi::interiors_meet(outline, hurt))
    return depths == Depths::left_out ? violation : set_apart(violation, phi::separate(outline, hurt));
  const std::int64_t gap = defect_gap_of(document, part);
  if (!phi::edges_nearer_than(outline, hurt, gap)) return std::nullopt;
  violation.kind = ViolationKind::defect_gap;
  return too_near(violation, outline, hurt, gap);
}

std::optional<Violation> quality_violation(const Document& document, const Placement& placement,
                                           const GridRegion& outline, std::uint32_t index, Depths depths) {
  const QualityZone& zone = stock_of(document, placement).zones[index];
  const auto at = lacks_quality(part_of(document, placement), placement, outline, zone);
  if (!at) return std::nullopt;
  Violation violation = on_its_own(ViolationKind::quality, placement);
  violation.feature = index;
  if (depths == Depths::left_out) return violation;
  violation = set_apart(violation, phi::separate(outline, zone.outline.polygon));
  violation.at = geom::kGridStep * *at;
  return violation;
}

std::optional<Violation> pair_violation(const Document& document, const Placement& a,
                                        const GridRegion& outline_a, const Placement& b,
                                        const GridRegion& outline_b, Depths depths) {
  ask(1 + (outline_a.points.size() + outline_b.points.size()) / 8);
  Violation violation = on_its_own(ViolationKind::overlap, a);
  violation.b = b.id;
  if (phi::interiors_meet(outline_a, outline_b))
    return depths == Depths::left_out ? violation : set_apart(violation, phi::separate(outline_a, outline_b));
  const std::int64_t gap = gap_between(document, part_of(document, a), part_of(document, b));
  if (!phi::edges_nearer_than(outline_a, outline_b, gap)) return std::nullopt;
  violation.kind = ViolationKind::gap;
  return too_near(violation, outline_a, outline_b, gap);
}

std::vector<Violation> check(const Document& document) {
  std::vector<const Placement*> order;
  for (const Placement& placement : document.placements) order.push_back(&placement);
  const auto sheet = [](const Placement* p) { return std::tuple{p->stock, p->copy}; };
  std::stable_sort(order.begin(), order.end(),
                   [&](const Placement* p, const Placement* q) { return sheet(p) < sheet(q); });
  std::vector<std::span<const Placement* const>> sheets;
  std::map<std::uint32_t, Features> features;  // by stock
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && sheet(order[end]) == sheet(order[begin])) ++end;
    sheets.push_back(std::span(order).subspan(begin, end - begin));
    features.try_emplace(order[begin]->stock, stock_of(document, *order[begin]));
  }
  // Sheets have nothing to do with each other.
  std::vector<std::vector<Violation>> found(sheets.size());
  share_out(sheets.size(), kUsualThreads, [&](std::size_t i) {
    std::vector<Placed> placed;
    for (const Placement* one : sheets[i])
      placed.push_back({one, placed_outline(part_of(document, *one), *one)});
    for (const Placed& one : placed)
      add_stock_violations(document, one, features.at(one.placement->stock), Depths::measured, found[i]);
    add_pair_violations(document, placed, found[i]);
  });
  std::vector<Violation> violations;
  for (const std::vector<Violation>& some : found)
    violations.insert(violations.end(), some.begin(), some.end());
  sort_violations(violations);
  return violations;
}

std::vector<Violation> check_some(const Document& document, std::span<const Placement> of,
                                  std::span<const Placement> with, Depths depths) {
  std::vector<Violation> violations;
  // The placements of `of` come first.
  std::vector<Placed> placed;
  for (const std::span<const Placement> some : {of, with})
    for (const Placement& placement : some)
      placed.push_back({&placement, placed_outline(part_of(document, placement), placement)});
  const auto reach = [&](const Placed& one) {
    return grown_box(one.outline, own_gap(document, part_of(document, *one.placement)));
  };
  const auto add_pair = [&](const Placed& one, const Placed& other) {
    if (one.placement->stock != other.placement->stock || one.placement->copy != other.placement->copy)
      return;
    const bool in_order = one.placement->id < other.placement->id;
    const Placed &a = in_order ? one : other, &b = in_order ? other : one;
    if (const auto violation =
            pair_violation(document, *a.placement, a.outline, *b.placement, b.outline, depths))
      violations.push_back(*violation);
  };
  std::vector<geom::Box> boxes;
  for (const Placed& one : placed) boxes.push_back(reach(one));
  const geom::BoxTree all(boxes);
  std::map<std::uint32_t, Features> features;  // by stock
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::uint32_t stock = of[i].stock;
    add_stock_violations(document, placed[i],
                         features.try_emplace(stock, stock_of(document, of[i])).first->second, depths,
                         violations);
    // Two placements of `of` meet once, when the later one is looked at.
    all.visit_meeting(reach(placed[i]), [&](std::uint32_t j) {
      if (j < i || j >= of.size()) add_pair(placed[i], placed[j]);
    });
  }
  sort_violations(violations);
  return violations;
}

}  // namespace lekalo::layout
