#include "lekalo/layout/workspace.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "lekalo/base/assert.hpp"
#include "quality.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;

GridBox placed_box(const phi::Scene& scene, phi::ShapeIndex shape, GridPoint at) {
  return {scene.box(shape).low + at, scene.box(shape).high + at};
}

/// Makes a placement that stands for an id in searches.
Placement with_id(std::uint64_t id) {
  Placement placement;
  placement.id = id;
  return placement;
}

/// Returns the world of a sheet's scene. It fits what lies on the sheet, because an open strip is as long as
/// what is on it.
GridBox world_of(const Document& document, Sheet sheet) {
  GridBox world = bounds(document.stocks[sheet.stock].outline.polygon);
  if (!document.stocks[sheet.stock].open_length) return world;
  std::int64_t length = 1;
  for (const Placement& placement : document.placements)
    if (placement.stock == sheet.stock && placement.copy == sheet.copy)
      length = std::max(length, placement.at.x);
  world.high.x = std::min(world.high.x, length + length / 2 + (world.high.y - world.low.y));
  return world;
}

}  // namespace

Workspace::Workspace(Document document) : document_(std::move(document)) {}

const Placement* Workspace::find(std::uint64_t id) const noexcept {
  const auto& all = document_.placements;
  const auto at = std::lower_bound(
      all.begin(), all.end(), id,
      [](const Placement& placement, std::uint64_t wanted) { return placement.id < wanted; });
  return at == all.end() || at->id != id ? nullptr : &*at;
}

Workspace::SheetScene& Workspace::sheet_scene(Sheet sheet) const {
  if (const auto found = scenes_.find(sheet); found != scenes_.end()) return found->second;
  std::size_t count = 0;
  for (const Placement& placement : document_.placements)
    count += placement.stock == sheet.stock && placement.copy == sheet.copy ? 1 : 0;
  // It is kept when it is whole: whoever is stopped here leaves no scene in which something is missing.
  SheetScene made(world_of(document_, sheet), 4 * count + 64);
  const Stock& stock = document_.stocks[sheet.stock];
  made.scene.put(
      {.shape = made.scene.add_shape(stock.outline.polygon), .layers = kBorderLayer, .container = true});
  made.placements.push_back(0);
  made.features.push_back(0);
  for (const FeatureKind kind : {FeatureKind::defect, FeatureKind::zone})
    for (std::uint32_t i = 0; i < feature_count(stock, kind); ++i)
      put_feature_body(made, feature_at(stock, kind, i), i);
  for (const Placement& placement : document_.placements)
    if (placement.stock == sheet.stock && placement.copy == sheet.copy) put(made, placement);
  return scenes_.emplace(sheet, std::move(made)).first->second;
}

void Workspace::put_feature_body(SheetScene& in, const Feature& feature, std::uint32_t index) const {
  const bool defect = feature.kind == FeatureKind::defect;
  const phi::BodyIndex body =
      in.scene.put({.shape = in.scene.add_shape(feature.outline.polygon),
                    .layers = defect ? kDefectLayer : kZoneLayer,
                    .rank = defect ? std::int64_t{feature.grade} : -std::int64_t{feature.grade}});
  if (body >= in.placements.size()) in.placements.resize(body + 1), in.features.resize(body + 1);
  in.placements[body] = 0;
  in.features[body] = index;
  auto& drawn = in.drawn[static_cast<std::size_t>(feature.kind)];
  drawn.insert(drawn.begin() + index, body);
}

void Workspace::number_features(SheetScene& in, FeatureKind kind, std::size_t from) const {
  const auto& drawn = in.drawn[static_cast<std::size_t>(kind)];
  for (std::size_t i = from; i < drawn.size(); ++i) in.features[drawn[i]] = static_cast<std::uint32_t>(i);
}

void Workspace::put(SheetScene& in, const Placement& placement) const {
  const Part& part = document_.parts[placement.part];
  const phi::BodyIndex body = in.scene.put({.shape = shape_in(in, placement),
                                            .at = placement.at,
                                            .gap = part.gap.value_or(document_.rules.gap),
                                            .layers = kPartLayer});
  in.bodies[placement.id] = body;
  if (body >= in.placements.size()) in.placements.resize(body + 1), in.features.resize(body + 1);
  in.placements[body] = placement.id;
}

Workspace::BodyOfPlacement::node_type Workspace::take(SheetScene& in, std::uint64_t id) {
  const auto at = in.bodies.find(id);
  in.scene.take(at->second);
  return in.bodies.extract(at);
}

const phi::Scene& Workspace::scene(Sheet sheet) const { return sheet_scene(sheet).scene; }

phi::ShapeIndex Workspace::shape(Sheet sheet, const Placement& placement) const {
  return shape_in(sheet_scene(sheet), placement);
}

phi::ShapeIndex Workspace::shape_in(SheetScene& in, const Placement& placement) const {
  const std::tuple key{placement.part, placement.rotation.c, placement.rotation.s, placement.mirrored};
  if (const auto found = in.shapes.find(key); found != in.shapes.end()) return found->second;
  const phi::ShapeIndex made = in.scene.add_shape(
      geom::turned(document_.parts[placement.part].outline.polygon, placement.rotation, placement.mirrored));
  in.shapes.emplace(key, made);
  return made;
}

std::uint64_t Workspace::placement_of(Sheet sheet, phi::BodyIndex body) const {
  return sheet_scene(sheet).placements[body];
}

std::uint32_t Workspace::feature_of(Sheet sheet, phi::BodyIndex body) const {
  return sheet_scene(sheet).features[body];
}

void Workspace::sort_bodies(Sheet sheet, std::vector<phi::BodyIndex>& bodies) const {
  const SheetScene& in = sheet_scene(sheet);
  // The order is border, defects, zones, parts. Which body is which depends on what came and went, so it
  // cannot be the order.
  const auto key = [&](phi::BodyIndex body) {
    const std::uint64_t id = in.placements[body];
    return id != 0 ? std::tuple{id, 0U, 0U} : std::tuple{id, in.scene.body(body).layers, in.features[body]};
  };
  std::sort(bodies.begin(), bodies.end(),
            [&](phi::BodyIndex a, phi::BodyIndex b) { return key(a) < key(b); });
}

std::vector<phi::BodyIndex> Workspace::near(Sheet sheet, const GridBox& box, std::int64_t reach,
                                            std::uint32_t layers) const {
  std::vector<phi::BodyIndex> found = scene(sheet).near(box, reach, layers);
  sort_bodies(sheet, found);
  return found;
}

std::vector<std::uint64_t> Workspace::at(Sheet sheet, GridPoint p) const {
  const SheetScene& in = sheet_scene(sheet);
  std::vector<std::uint64_t> ids;
  for (const phi::BodyIndex body : in.scene.at(p, kPartLayer)) ids.push_back(in.placements[body]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

void Workspace::forget_old_shapes(Sheet sheet) {
  // A scene keeps every shape that it was ever asked about, and turning a part leaves hundreds behind. Beyond
  // this many it is dropped, and made anew from the document when it is asked for next.
  constexpr std::size_t kSpare = 2000;
  const auto in = scenes_.find(sheet);
  if (in != scenes_.end() &&
      in->second.shapes.size() + in->second.old_shapes > kSpare + 4 * in->second.bodies.size())
    scenes_.erase(in);
}

void Workspace::set(const Placement& placement) {
  auto& all = document_.placements;
  const auto at = std::lower_bound(all.begin(), all.end(), placement.id,
                                   [](const Placement& one, std::uint64_t id) { return one.id < id; });
  if (at != all.end() && at->id == placement.id) {
    if (const auto old = scenes_.find({at->stock, at->copy}); old != scenes_.end())
      take(old->second, placement.id);
    *at = placement;
  } else {
    all.insert(at, placement);
  }
  forget_old_shapes({placement.stock, placement.copy});
  if (const auto in = scenes_.find({placement.stock, placement.copy}); in != scenes_.end())
    put(in->second, placement);
}

void Workspace::erase(std::uint64_t id) {
  const Placement* placement = find(id);
  LEKALO_ASSERT(placement != nullptr);
  if (const auto in = scenes_.find({placement->stock, placement->copy}); in != scenes_.end())
    take(in->second, id);
  document_.placements.erase(document_.placements.begin() + (placement - document_.placements.data()));
}

void Workspace::set_feature(std::uint32_t stock, std::uint32_t index, const Feature& feature) {
  const FeaturePlace place = put_feature(document_.stocks[stock], index, feature);
  const auto kind = static_cast<std::size_t>(feature.kind);
  for (auto at = scenes_.lower_bound({stock, std::numeric_limits<std::int64_t>::min()});
       at != scenes_.end() && at->first.stock == stock;) {
    const Sheet sheet = at->first;
    SheetScene& in = at->second;
    ++at;
    if (!place.is_new) {
      in.scene.take(in.drawn[kind][place.index]);
      in.drawn[kind].erase(in.drawn[kind].begin() + place.index);
      ++in.old_shapes;
    }
    put_feature_body(in, feature, place.index);
    if (place.is_new) number_features(in, feature.kind, place.index + std::size_t{1});
    forget_old_shapes(sheet);
  }
}

void Workspace::erase_feature(std::uint32_t stock, FeatureKind kind, std::string_view id) {
  const auto index = find_feature(document_.stocks[stock], kind, id);
  LEKALO_ASSERT(index.has_value());
  take_feature(document_.stocks[stock], kind, *index);
  for (auto at = scenes_.lower_bound({stock, std::numeric_limits<std::int64_t>::min()});
       at != scenes_.end() && at->first.stock == stock;) {
    const Sheet sheet = at->first;
    SheetScene& in = at->second;
    ++at;
    auto& drawn = in.drawn[static_cast<std::size_t>(kind)];
    in.scene.take(drawn[*index]);
    drawn.erase(drawn.begin() + *index);
    ++in.old_shapes;
    number_features(in, kind, *index);
    forget_old_shapes(sheet);
  }
}

std::vector<Violation> Workspace::violations_with(std::uint32_t stock, FeatureKind kind, std::uint32_t index,
                                                  Depths depths) const {
  const bool defect = kind == FeatureKind::defect;
  const Stock& of = document_.stocks[stock];
  const GridBox box = bounds(defect ? of.defects[index].outline.polygon : of.zones[index].outline.polygon);
  std::int64_t reach = 0;
  std::set<std::int64_t> copies;
  for (const Placement& placement : document_.placements) {
    if (placement.stock != stock || placement.copy < 0 || placement.copy >= of.count) continue;
    copies.insert(placement.copy);
    reach = std::max(reach, defect_gap_of(document_, document_.parts[placement.part]));
  }
  std::vector<Violation> violations;
  for (const std::int64_t copy : copies) {
    const Sheet sheet{stock, copy};
    for (const phi::BodyIndex body : near(sheet, box, defect ? reach : 0, kPartLayer)) {
      const Placement& placement = *find(placement_of(sheet, body));
      const geom::GridRegion outline = placed_outline(document_.parts[placement.part], placement);
      const auto violation = defect ? defect_violation(document_, placement, outline, index, depths)
                                    : quality_violation(document_, placement, outline, index, depths);
      if (violation) violations.push_back(*violation);
    }
  }
  return violations;
}

std::int64_t Workspace::gap_to(const Part& part, Sheet sheet, phi::BodyIndex body) const {
  const phi::Body& other = sheet_scene(sheet).scene.body(body);
  const Rules& rules = document_.rules;
  if ((other.layers & kPartLayer) != 0) return std::max(other.gap, part.gap.value_or(rules.gap));
  if ((other.layers & kBorderLayer) != 0) return part.border_gap.value_or(rules.border_gap);
  if ((other.layers & kDefectLayer) != 0) return part.defect_gap.value_or(rules.defect_gap);
  return 0;
}

bool Workspace::concerns(const Part& part, Sheet sheet, phi::BodyIndex body) const {
  const phi::Body& other = sheet_scene(sheet).scene.body(body);
  if ((other.layers & kDefectLayer) != 0) return other.rank > part.tolerated_severity;
  if ((other.layers & kZoneLayer) == 0) return true;
  const auto demands_more = [&](int quality) { return quality > -other.rank; };
  return demands_more(part.quality) ||
         std::any_of(part.areas.begin(), part.areas.end(),
                     [&](const PartArea& area) { return demands_more(area.quality); });
}

bool Workspace::may_be_so(const Placement& placement) const {
  const Part& part = document_.parts[placement.part];
  const Stock& stock = document_.stocks[placement.stock];
  return placement.copy >= 0 && placement.copy < stock.count && (!placement.mirrored || part.may_mirror) &&
         rotation_allowed(part, placement.rotation) &&
         grain_allowed(part, stock, placement.rotation, placement.mirrored);
}

bool Workspace::has_room(const Placement& placement) const {
  const Part& part = document_.parts[placement.part];
  const Stock& stock = document_.stocks[placement.stock];
  const Sheet sheet{placement.stock, placement.copy};
  const phi::Scene& in = scene(sheet);
  const Rules& rules = document_.rules;
  phi::Probe probe{.shape = shape(sheet, placement), .at = placement.at};
  probe.layers = kPartLayer, probe.gap = part.gap.value_or(rules.gap);
  if (in.forbidden(probe)) return false;
  probe.layers = kBorderLayer, probe.gap = part.border_gap.value_or(rules.border_gap);
  if (in.forbidden(probe)) return false;
  probe.layers = kDefectLayer, probe.gap = part.defect_gap.value_or(rules.defect_gap);
  probe.tolerates = part.tolerated_severity;
  if (!stock.defects.empty() && in.forbidden(probe)) return false;
  if (stock.zones.empty()) return true;
  if (!part.areas.empty()) {
    const geom::GridBox box = placed_box(in, probe.shape, placement.at);
    const geom::GridRegion outline = geom::moved(in.outline(probe.shape), placement.at);
    for (const phi::BodyIndex body : in.near(box, 0, kZoneLayer))
      if (lacks_quality(part, placement, outline, stock.zones[sheet_scene(sheet).features[body]]))
        return false;
    return true;
  }
  probe.layers = kZoneLayer, probe.gap = 0, probe.tolerates = -std::int64_t{part.quality};
  return !in.forbidden(probe);
}

Workspace::Lifted::Lifted(const Workspace& workspace, std::span<const std::uint64_t> ids) {
  std::map<std::uint64_t, SheetScene*> lifted;
  std::vector<std::uint64_t> order;
  for (const std::uint64_t id : ids)
    if (const Placement* placement = workspace.find(id); placement != nullptr)
      if (lifted.emplace(id, &workspace.sheet_scene({placement->stock, placement->copy})).second)
        order.push_back(id);
  // From here on nothing is allocated or stopped, so that whatever is taken out is put back.
  taken_.reserve(order.size());
  for (const std::uint64_t id : order) {
    SheetScene& in = *lifted[id];
    const phi::Body body = in.scene.body(in.bodies.at(id));
    taken_.push_back({&in, body, take(in, id)});
  }
}

Workspace::Lifted::~Lifted() {
  // The last one first: so each becomes the body that it was.
  for (auto one = taken_.rbegin(); one != taken_.rend(); ++one) {
    one->entry.mapped() = one->in->scene.put(one->body);
    one->in->placements[one->entry.mapped()] = one->entry.key();
    one->in->bodies.insert(std::move(one->entry));
  }
}

bool Workspace::is_clear(std::span<const Placement> placements) const {
  std::vector<std::uint64_t> ids;
  ids.reserve(placements.size());
  for (const Placement& placement : placements) ids.push_back(placement.id);
  const Lifted lifted(*this, ids);
  // The placements put in here are taken out again also when somebody stops this.
  struct Laid {
    const Workspace& workspace;
    std::span<const Placement> placements;
    std::size_t count = 0;
    ~Laid() {
      for (; count > 0; --count) {
        const Placement& last = placements[count - 1];
        take(workspace.scenes_.at({last.stock, last.copy}), last.id);
      }
    }
  } laid{*this, placements};
  // The placements are put in one after the other, each against the scene and those put in before it.
  for (const Placement& placement : placements) {
    if (!is_clear_of_scene(placement)) return false;
    put(sheet_scene({placement.stock, placement.copy}), placement);
    ++laid.count;
  }
  return true;
}

std::vector<Violation> Workspace::violations_of(std::span<const Placement> placements, Depths depths) const {
  std::vector<Placement> of(placements.begin(), placements.end());
  const auto by_id = [](const Placement& a, const Placement& b) { return a.id < b.id; };
  std::sort(of.begin(), of.end(), by_id);
  std::vector<std::uint64_t> around;
  for (const Placement& placement : of) {
    if (placement.copy < 0 || placement.copy >= document_.stocks[placement.stock].count) continue;
    const Sheet sheet{placement.stock, placement.copy};
    const phi::Scene& in = scene(sheet);
    const std::int64_t own = document_.parts[placement.part].gap.value_or(document_.rules.gap);
    const GridBox box = placed_box(in, shape(sheet, placement), placement.at);
    for (const phi::BodyIndex body : in.near(box, std::max(own, in.widest_gap()), kPartLayer))
      around.push_back(placement_of(sheet, body));
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::vector<Placement> with;
  for (const std::uint64_t id : around)
    if (!std::binary_search(of.begin(), of.end(), with_id(id), by_id)) with.push_back(*find(id));
  return check_some(document_, of, with, depths);
}

}  // namespace lekalo::layout
