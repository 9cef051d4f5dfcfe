#include "kernel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/command.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/workspace.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::layout;

constexpr double kMostMm = 0x1p19;  ///< of places and shifts, as in layout files
constexpr double kLargestId = 0x1p53 - 1;
constexpr int kClear = 0, kTooClose = 1, kForbidden = 2, kFailed = -1;

// One module is one kernel for one thread, so calls leave their answers in these for their caller.
std::vector<double> input;
std::string text;
std::vector<double> numbers;
struct Open {
  Workspace layout;
  std::set<std::uint64_t> unchecked;  ///< what lekalo_check_some has still to look at
};
std::map<std::int32_t, Open> layouts;
std::int32_t last_handle = 0;

int fail(std::string sentence) {
  text = std::move(sentence);
  numbers.clear();
  return kFailed;
}

Open* begin_open(std::int32_t handle) {
  text.clear();
  numbers.clear();
  const auto found = layouts.find(handle);
  if (found != layouts.end()) return &found->second;
  fail(fmt::format("there is no layout {} here", handle));
  return nullptr;
}
Workspace* begin(std::int32_t handle) {
  Open* const open = begin_open(handle);
  return open == nullptr ? nullptr : &open->layout;
}

/// A whole number below `count`, as an index.
template <class Integer = std::uint32_t>
std::optional<Integer> index(double value, double count) {
  if (!(value >= 0 && value < count && value == std::floor(value))) return std::nullopt;
  return static_cast<Integer>(value);
}

std::optional<Sheet> sheet_of(const Workspace& layout, double stock, double copy) {
  const auto& stocks = layout.document().stocks;
  const auto which = index(stock, static_cast<double>(stocks.size()));
  if (!which) return std::nullopt;
  const auto number = index<std::int64_t>(copy, static_cast<double>(stocks[*which].count));
  if (!number) return std::nullopt;
  return Sheet{*which, *number};
}

bool is_place(double x, double y) { return std::abs(x) <= kMostMm && std::abs(y) <= kMostMm; }

void put(const Placement& p) {
  numbers.insert(numbers.end(),
                 {static_cast<double>(p.id), static_cast<double>(p.part), static_cast<double>(p.stock),
                  static_cast<double>(p.copy), static_cast<double>(p.rotation.c) * 0x1p-52,
                  static_cast<double>(p.rotation.s) * 0x1p-52, geom::mm_from_grid(p.at.x),
                  geom::mm_from_grid(p.at.y), p.mirrored ? 1.0 : 0.0, p.locked ? 1.0 : 0.0});
}

void put(const Violation& v) {
  numbers.insert(numbers.end(),
                 {static_cast<double>(v.kind), static_cast<double>(v.a), static_cast<double>(v.b),
                  static_cast<double>(v.stock), static_cast<double>(v.copy), static_cast<double>(v.feature),
                  v.amount_mm, v.at.x, v.at.y, v.direction.x, v.direction.y});
}

/// The PLACEMENT at n of the input; nothing, and the text says why, where it is none.
std::optional<Placement> placement(const Workspace& layout, std::size_t n) {
  const std::span<const double> from(input.data() + n * kPlacementSize, kPlacementSize);
  const Document& document = layout.document();
  const auto wrong = [](const char* what, double value) {
    fail(fmt::format("a placement with {} {}", what, value));
    return std::nullopt;
  };
  Placement made;
  const auto id = index<std::uint64_t>(from[0], kLargestId + 1);
  if (!id) return wrong("id", from[0]);
  made.id = *id;
  const auto part = index(from[1], static_cast<double>(document.parts.size()));
  if (!part) return wrong("part", from[1]);
  made.part = *part;
  const auto stock = index(from[2], static_cast<double>(document.stocks.size()));
  if (!stock) return wrong("stock", from[2]);
  made.stock = *stock;
  if (!(std::abs(from[3]) <= 1e9 && from[3] == std::floor(from[3]))) return wrong("copy", from[3]);
  made.copy = static_cast<std::int64_t>(from[3]);
  if (!(std::abs(from[4]) <= 1.5 && std::abs(from[5]) <= 1.5)) return wrong("cosine", from[4]);
  made.rotation = geom::rotation_from_pair(from[4], from[5]);
  if (!geom::is_rotation(made.rotation)) return wrong("no rotation but the cosine", from[4]);
  if (!is_place(from[6], from[7])) return wrong("a place too far away, x", from[6]);
  made.at = {geom::grid_from_mm(from[6]), geom::grid_from_mm(from[7])};
  made.mirrored = from[8] != 0;
  made.locked = from[9] != 0;
  return made;
}

bool only_gaps(const std::vector<Violation>& violations) {
  return std::all_of(violations.begin(), violations.end(), [](const Violation& v) {
    return v.kind == ViolationKind::gap || v.kind == ViolationKind::border_gap ||
           v.kind == ViolationKind::defect_gap;
  });
}

/// The nearest thing to a part.
struct Nearest {
  double distance_mm = -1;
  double what = 0, other = 0, id = 0;
  geom::Point on_other, on_part;

  void take(const phi::EdgeDistance& edges, double is, double which, std::uint64_t part) {
    if (distance_mm >= 0 && edges.distance_mm >= distance_mm) return;
    *this = {edges.distance_mm, is, which, static_cast<double>(part), edges.on_a, edges.on_b};
  }
};

Nearest nearest(const Workspace& layout, const std::vector<Placement>& placements, std::int64_t reach) {
  Nearest best;
  std::vector<std::uint64_t> ids;
  for (const Placement& one : placements) ids.push_back(one.id);
  const Workspace::Lifted lifted(layout, ids);
  const Document& document = layout.document();
  for (const Placement& one : placements) {
    const Sheet sheet{one.stock, one.copy};
    const Stock& stock = document.stocks[one.stock];
    const phi::Scene& scene = layout.scene(sheet);
    phi::Probe probe{.shape = layout.shape(sheet, one), .at = one.at, .layers = kPartLayer};
    if (const phi::NearestBody near = scene.nearest(probe, reach); near.body != phi::kNoBody)
      best.take(near.edges, 0, static_cast<double>(layout.placement_of(sheet, near.body)), one.id);
    probe.layers = kDefectLayer;
    probe.tolerates = document.parts[one.part].tolerated_severity;
    if (!stock.defects.empty()) {
      if (const phi::NearestBody near = scene.nearest(probe, reach); near.body != phi::kNoBody) {
        best.take(near.edges, 2, static_cast<double>(layout.feature_of(sheet, near.body)), one.id);
      }
    }
    const phi::EdgeDistance border =
        phi::edge_distance(stock.outline.polygon, scene.outline(probe.shape), one.at);
    if (border.distance_mm <= geom::mm_from_grid(reach)) best.take(border, 1, 0, one.id);
  }
  return best;
}

int state(const Workspace& layout, const std::vector<Placement>& placements, double reach_mm,
          std::int32_t depths) {
  int level = kClear;
  std::vector<Violation> violations;
  if (!layout.is_clear(placements)) {
    violations = layout.violations_of(placements, depths != 0 ? Depths::measured : Depths::left_out);
    level = only_gaps(violations) ? kTooClose : kForbidden;
  }
  Nearest line;
  if (level != kForbidden && reach_mm > 0)
    line = nearest(layout, placements, geom::grid_from_mm(std::min(reach_mm, kMostMm)));
  numbers.insert(numbers.end(), {line.distance_mm, line.what, line.other, line.id, line.on_other.x,
                                 line.on_other.y, line.on_part.x, line.on_part.y});
  for (const Violation& violation : violations) put(violation);
  return level;
}

}  // namespace

void* lekalo_input(std::uint32_t bytes) {
  if (input.size() < bytes / 8 + 1) input.resize(bytes / 8 + 1);
  return input.data();
}
const char* lekalo_text() { return text.data(); }
std::uint32_t lekalo_text_size() { return static_cast<std::uint32_t>(text.size()); }
const double* lekalo_numbers() { return numbers.data(); }
std::uint32_t lekalo_numbers_size() { return static_cast<std::uint32_t>(numbers.size()); }

namespace {
std::string_view input_text(std::uint32_t bytes) {
  lekalo_input(bytes);
  return {reinterpret_cast<const char*>(input.data()), bytes};
}
/// Makes room for what the caller should have written, so that nothing beyond it is read.
void expect_input(std::size_t doubles) {
  if (input.size() < doubles) input.resize(doubles);
}
}  // namespace

std::int32_t lekalo_open(std::uint32_t bytes) {
  text.clear();
  numbers.clear();
  auto file = io::read_layout(input_text(bytes), "layout");
  if (!file) return fail(file.error().message);
  for (const std::string& notice : file->notices) text += notice + "\n";
  Open& open =
      layouts.try_emplace(++last_handle, Open{Workspace(std::move(file->document)), {}}).first->second;
  for (const Placement& one : open.layout.document().placements)
    open.unchecked.insert(open.unchecked.end(), one.id);
  return last_handle;
}

std::int32_t lekalo_close(std::int32_t handle) {
  if (begin(handle) == nullptr) return kFailed;
  layouts.erase(handle);
  return 0;
}

std::int32_t lekalo_document(std::int32_t handle) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  text = io::write_layout(layout->document());
  return 0;
}

std::int32_t lekalo_set(std::int32_t handle) {
  Open* open = begin_open(handle);
  if (open == nullptr) return kFailed;
  Workspace& layout = open->layout;
  expect_input(kPlacementSize);
  const auto made = placement(layout, 0);
  if (!made) return kFailed;
  if (made->id == 0) return fail("a placement with id 0; ids begin with 1");
  layout.set(*made);
  open->unchecked.insert(made->id);
  if (layout.document().next_id <= made->id) layout.set_next_id(made->id + 1);
  return 0;
}

std::int32_t lekalo_erase(std::int32_t handle, double id) {
  Open* open = begin_open(handle);
  if (open == nullptr) return kFailed;
  const auto which = index<std::uint64_t>(id, kLargestId + 1);
  if (!which || open->layout.find(*which) == nullptr)
    return fail(fmt::format("there is no placement {}", id));
  open->layout.erase(*which);
  open->unchecked.erase(*which);
  return 0;
}

std::int32_t lekalo_set_next_id(std::int32_t handle, double id) {
  Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto next = index<std::uint64_t>(id, kLargestId + 2);
  const auto& placements = layout->document().placements;
  if (!next || *next == 0 || (!placements.empty() && *next <= placements.back().id))
    return fail(fmt::format("the next id cannot be {}", id));
  layout->set_next_id(*next);
  return 0;
}

namespace {
/// The stock of a call about features; nothing, and the text says why, where there is none.
std::optional<std::uint32_t> stock_of(const Workspace& layout, double stock, std::int32_t kind) {
  const auto which = index(stock, static_cast<double>(layout.document().stocks.size()));
  if (which && (kind == 0 || kind == 1)) return which;
  fail("there is no such stock, or no such kind: 0 is a defect, 1 a zone");
  return std::nullopt;
}
FeatureKind feature_kind(std::int32_t kind) { return kind == 0 ? FeatureKind::defect : FeatureKind::zone; }

/// Unchecks every part that a feature may concern.
void uncheck_near(Open& open, std::uint32_t stock, FeatureKind kind, std::string_view id) {
  const Document& document = open.layout.document();
  const Stock& of = document.stocks[stock];
  const auto index = find_feature(of, kind, id);
  if (!index) return;
  const geom::GridBox box = bounds(feature_at(of, kind, *index).outline.polygon);
  std::int64_t reach = 0;
  std::set<std::int64_t> copies;
  for (const Placement& one : document.placements) {
    if (one.stock != stock) continue;
    copies.insert(one.copy);
    reach = std::max(reach, defect_gap_of(document, document.parts[one.part]));
  }
  for (const std::int64_t copy : copies)
    for (const phi::BodyIndex body : open.layout.scene({stock, copy}).near(box, reach, kPartLayer))
      open.unchecked.insert(open.layout.placement_of({stock, copy}, body));
}
}  // namespace

std::int32_t lekalo_set_feature(std::int32_t handle, double stock, std::int32_t kind, double at,
                                std::uint32_t bytes) {
  Open* open = begin_open(handle);
  if (open == nullptr) return kFailed;
  const auto which = stock_of(open->layout, stock, kind);
  if (!which) return kFailed;
  const auto place = index(at, static_cast<double>(kMostFeatures));
  if (!place) return fail(fmt::format("there is no place {} in a list", at));
  const auto feature = io::read_feature(feature_kind(kind), input_text(bytes), "feature");
  if (!feature) return fail(feature.error().message);
  uncheck_near(*open, *which, feature->kind, feature->id);
  open->layout.set_feature(*which, *place, *feature);
  uncheck_near(*open, *which, feature->kind, feature->id);
  return 0;
}

std::int32_t lekalo_erase_feature(std::int32_t handle, double stock, std::int32_t kind, std::uint32_t bytes) {
  Open* open = begin_open(handle);
  if (open == nullptr) return kFailed;
  const auto which = stock_of(open->layout, stock, kind);
  if (!which) return kFailed;
  const std::string id(input_text(bytes));
  if (!find_feature(open->layout.document().stocks[*which], feature_kind(kind), id))
    return fail(fmt::format("there is no {} of this id", name_of(feature_kind(kind))));
  uncheck_near(*open, *which, feature_kind(kind), id);
  open->layout.erase_feature(*which, feature_kind(kind), id);
  return 0;
}

std::int32_t lekalo_violations_with(std::int32_t handle, double stock, std::int32_t kind, double at,
                                    std::int32_t depths) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto which = stock_of(*layout, stock, kind);
  if (!which) return kFailed;
  const FeatureKind drawn = feature_kind(kind);
  const auto place = index(at, static_cast<double>(feature_count(layout->document().stocks[*which], drawn)));
  if (!place) return fail(fmt::format("there is no {} {}", name_of(drawn), at));
  const auto violations =
      layout->violations_with(*which, drawn, *place, depths != 0 ? Depths::measured : Depths::left_out);
  for (const Violation& violation : violations) put(violation);
  return static_cast<std::int32_t>(violations.size());
}

std::int32_t lekalo_state(std::int32_t handle, std::uint32_t count, double dx, double dy, double degrees,
                          double reach, std::int32_t depths) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  if (!is_place(dx, dy)) return fail(fmt::format("a shift by ({}, {}) mm leaves the grid", dx, dy));
  expect_input(count);
  std::vector<Placement> placements;
  RotateCommand turn{{}, degrees};
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto id = index<std::uint64_t>(input[i], kLargestId + 1);
    const Placement* one = id ? layout->find(*id) : nullptr;
    if (one == nullptr) return fail(fmt::format("there is no placement {}", input[i]));
    placements.push_back(*one);
    turn.ids.push_back(*id);
  }
  std::sort(turn.ids.begin(), turn.ids.end());
  if (std::adjacent_find(turn.ids.begin(), turn.ids.end()) != turn.ids.end())
    return fail("a placement is named twice");
  if (degrees != 0) {
    const auto change = plan(*layout, turn, Mode::free);
    if (!change) return fail(change.error().message);
    for (const PlacementChange& one : change->placements)
      *std::find_if(placements.begin(), placements.end(),
                    [&](const Placement& p) { return p.id == one.after->id; }) = *one.after;
  }
  const geom::GridPoint by{geom::grid_from_mm(dx), geom::grid_from_mm(dy)};
  for (Placement& one : placements) {
    one.at = one.at + by;
    if (!is_place(geom::mm_from_grid(one.at.x), geom::mm_from_grid(one.at.y)))
      return fail(fmt::format("placement {} would leave the grid", one.id));
  }
  return state(*layout, placements, reach, depths);
}

std::int32_t lekalo_state_of(std::int32_t handle, std::uint32_t count, double reach, std::int32_t depths) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  expect_input(kPlacementSize * count);
  std::vector<Placement> placements;
  std::vector<std::uint64_t> ids;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto one = placement(*layout, i);
    if (!one) return kFailed;
    // A copy that is not there has no scene to ask.
    if (one->copy < 0 || one->copy >= layout->document().stocks[one->stock].count)
      return fail(fmt::format("there is no copy {} of this stock", one->copy));
    placements.push_back(*one);
    ids.push_back(one->id);
  }
  std::sort(ids.begin(), ids.end());
  if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) return fail("a placement is named twice");
  return state(*layout, placements, reach, depths);
}

std::int32_t lekalo_check(std::int32_t handle) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const std::vector<Violation> violations = check(layout->document());
  for (const Violation& violation : violations) put(violation);
  return static_cast<std::int32_t>(violations.size());
}

std::int32_t lekalo_check_some(std::int32_t handle, std::uint32_t most) {
  Open* open = begin_open(handle);
  if (open == nullptr) return kFailed;
  const Workspace& layout = open->layout;
  const Document& document = layout.document();
  std::vector<Placement> of;
  std::set<std::uint64_t>& unchecked = open->unchecked;
  while (of.size() < most && !unchecked.empty()) {
    of.push_back(*layout.find(*unchecked.begin()));
    unchecked.erase(unchecked.begin());
  }
  std::set<std::uint64_t> with;
  for (const Placement& one : of) {
    const Sheet sheet{one.stock, one.copy};
    const phi::Scene& scene = layout.scene(sheet);
    const geom::GridBox& box = scene.box(layout.shape(sheet, one));
    const std::int64_t gap = document.parts[one.part].gap.value_or(document.rules.gap);
    for (const phi::BodyIndex body :
         scene.near({box.low + one.at, box.high + one.at}, std::max(gap, scene.widest_gap()), kPartLayer))
      with.insert(layout.placement_of(sheet, body));
  }
  for (const Placement& one : of) with.erase(one.id);
  std::vector<Placement> others;
  for (const std::uint64_t id : with)
    if (!unchecked.contains(id)) others.push_back(*layout.find(id));
  const std::vector<Violation> violations = check_some(document, of, others);
  numbers.push_back(static_cast<double>(unchecked.size()));
  numbers.push_back(static_cast<double>(of.size()));
  for (const Placement& one : of) numbers.push_back(static_cast<double>(one.id));
  for (const Violation& violation : violations) put(violation);
  return static_cast<std::int32_t>(violations.size());
}

std::int32_t lekalo_plan(std::int32_t handle, std::uint32_t bytes, std::int32_t strict) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto command = command_from_text(input_text(bytes), layout->document());
  if (!command) return fail(command.error().message);
  const auto change = plan(*layout, *command, strict != 0 ? Mode::strict : Mode::free);
  if (!change) return fail(change.error().message);
  numbers.push_back(static_cast<double>(change->next_id_after));
  for (const PlacementChange& one : change->placements) {
    put(one.after ? *one.after : *one.before);
    if (!one.after) numbers[numbers.size() - kPlacementSize + 1] = -1;
  }
  if (!change->features.empty()) text = io::features_json(layout->document(), change->features);
  return change->is_nothing() ? 0 : 1;
}

std::int32_t lekalo_pick(std::int32_t handle, double stock, double copy, double x, double y) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto sheet = sheet_of(*layout, stock, copy);
  if (!sheet) return fail("there is no such sheet");
  if (!is_place(x, y)) return 0;
  for (const std::uint64_t id : layout->at(*sheet, {geom::grid_from_mm(x), geom::grid_from_mm(y)}))
    numbers.push_back(static_cast<double>(id));
  return 0;
}

std::int32_t lekalo_in_box(std::int32_t handle, double stock, double copy, double left, double bottom,
                           double right, double top) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto sheet = sheet_of(*layout, stock, copy);
  if (!sheet) return fail("there is no such sheet");
  if (!(left <= right && bottom <= top)) return 0;
  const auto step = [](double mm) { return geom::grid_from_mm(std::clamp(mm, -kMostMm, kMostMm)); };
  const geom::GridBox box{{step(left), step(bottom)}, {step(right), step(top)}};
  for (const phi::BodyIndex body : layout->scene(*sheet).near(box, 0, kPartLayer))
    numbers.push_back(static_cast<double>(layout->placement_of(*sheet, body)));
  std::sort(numbers.begin(), numbers.end());
  return 0;
}

std::int32_t lekalo_fits_where(std::int32_t handle, double part, double stock, double copy,
                               std::uint32_t most, std::int32_t mirrored) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const auto which = index(part, static_cast<double>(layout->document().parts.size()));
  const auto sheet = sheet_of(*layout, stock, copy);
  if (!which || !sheet) return fail("there is no such part or sheet");
  for (const Placement& one :
       fits_where(*layout, *which, *sheet, most, mirrored < 0 ? std::nullopt : std::optional(mirrored != 0)))
    put(one);
  return 0;
}

std::int32_t lekalo_placements(std::int32_t handle) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  numbers.reserve(kPlacementSize * layout->document().placements.size());
  for (const Placement& one : layout->document().placements) put(one);
  return 0;
}

std::int32_t lekalo_outline(std::int32_t handle, std::int32_t kind, double a, double b) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  const Document& document = layout->document();
  const auto item = [](const auto& list, double which) {
    const auto i = index(which, static_cast<double>(list.size()));
    return i ? &list[*i] : nullptr;
  };
  const Outline* found = nullptr;
  if (kind == 0 || kind == 4) {
    if (const Part* part = item(document.parts, a)) {
      if (kind == 0) {
        found = &part->outline;
      } else if (const PartArea* area = item(part->areas, b)) {
        found = &area->outline;
      }
    }
  } else if (const Stock* stock = item(document.stocks, a)) {
    if (kind == 1) {
      found = &stock->outline;
    } else if (kind == 2) {
      if (const Defect* defect = item(stock->defects, b)) found = &defect->outline;
    } else if (kind == 3) {
      if (const QualityZone* zone = item(stock->zones, b)) found = &zone->outline;
    }
  }
  if (found == nullptr) return fail("there is no such outline");
  const geom::GridRegion& polygon = found->polygon;
  numbers.push_back(static_cast<double>(polygon.loops()));
  for (const std::uint32_t start : polygon.loop_starts) numbers.push_back(start);
  for (const geom::GridPoint p : polygon.points) {
    numbers.push_back(geom::mm_from_grid(p.x));
    numbers.push_back(geom::mm_from_grid(p.y));
  }
  return 0;
}

std::int32_t lekalo_completeness(std::int32_t handle) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  text = io::completeness_json(layout->document(), completeness(layout->document()));
  return 0;
}

std::int32_t lekalo_kits(std::int32_t handle) {
  const Workspace* layout = begin(handle);
  if (layout == nullptr) return kFailed;
  text = io::kits_json(layout->document(), kits_served(layout->document()).kits);
  return 0;
}

std::int32_t lekalo_rotation(double degrees) {
  text.clear();
  numbers.clear();
  if (!(std::abs(degrees) <= 360000)) return fail(fmt::format("{} degrees; at most 360000", degrees));
  const geom::GridRotation made = geom::rotation_from_degrees(degrees);
  numbers = {static_cast<double>(made.c) * 0x1p-52, static_cast<double>(made.s) * 0x1p-52};
  return 0;
}

std::int32_t lekalo_degrees(double c, double s) {
  text.clear();
  numbers.clear();
  if (!(std::abs(c) <= 1.5 && std::abs(s) <= 1.5)) return fail("no cosine and sine");
  const geom::GridRotation pair = geom::rotation_from_pair(c, s);
  if (!geom::is_rotation(pair)) return fail("no cosine and sine");
  numbers = {geom::degrees_of(pair)};
  return 0;
}
