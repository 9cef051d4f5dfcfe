#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "group.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/plain_text.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/layout/command.hpp"
#include "places.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using Placements = std::vector<Placement>;

constexpr std::int64_t kMostShift = geom::kGridLimit / 2;

tl::unexpected<Error> wrong(std::string message) { return failure(ErrorCode::usage, std::move(message)); }

/// Returns the placements of these ids, all of which must be there and free to be changed.
Result<Placements> movable(const Workspace& workspace, const std::vector<std::uint64_t>& ids,
                           bool locked_too = false) {
  if (ids.empty()) return wrong("a command without placements; name at least one");
  Placements placements;
  for (const std::uint64_t id : ids) {
    const Placement* placement = workspace.find(id);
    if (placement == nullptr) return wrong(fmt::format("there is no placement {}", id));
    if (std::any_of(placements.begin(), placements.end(), [&](const Placement& p) { return p.id == id; }))
      return wrong(fmt::format("placement {} is named twice", id));
    if (placement->locked && !locked_too)
      return wrong(fmt::format("placement {} is locked; unlock it first", id));
    placements.push_back(*placement);
  }
  return placements;
}

Result<Sheet> known_sheet(const Document& document, Sheet sheet) {
  if (sheet.stock >= document.stocks.size())
    return wrong(fmt::format("there is no stock number {}", sheet.stock));
  const Stock& stock = document.stocks[sheet.stock];
  if (sheet.copy < 0 || sheet.copy >= stock.count)
    return wrong(fmt::format("stock '{}' has {} {}, counted from 0; there is no copy {}", stock.id,
                             stock.count, stock.count == 1 ? "copy" : "copies", sheet.copy));
  return sheet;
}

Result<Sheet> common_sheet(const Placements& placements) {
  const Sheet sheet{placements[0].stock, placements[0].copy};
  for (const Placement& placement : placements)
    if (Sheet{placement.stock, placement.copy} != sheet)
      return wrong(fmt::format("placements {} and {} lie on different sheets; move those of one at a time",
                               placements[0].id, placement.id));
  return sheet;
}

bool on_grid(GridPoint p, std::int64_t most = kMostShift) noexcept {
  return p.x >= -most && p.x <= most && p.y >= -most && p.y <= most;
}

Result<Placements> within_limits(Placements placements) {
  for (const Placement& placement : placements)
    if (!on_grid(placement.at))
      return wrong(fmt::format("placement {} would leave the range of +-{} mm", placement.id,
                               geom::mm_from_grid(kMostShift)));
  return placements;
}

GridBox placed_box(const Workspace& workspace, const Placement& placement) {
  return bounds(placed_outline(workspace.document().parts[placement.part], placement));
}

/// Returns twice the middle of a box, because that is a grid point.
GridPoint twice_middle(const GridBox& box) noexcept { return box.low + box.high; }

GridPoint twice_middle(const Workspace& workspace, const Placements& placements) {
  GridBox all = placed_box(workspace, placements[0]);
  for (const Placement& placement : placements) {
    const GridBox box = placed_box(workspace, placement);
    all = {{std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)},
           {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)}};
  }
  return twice_middle(all);
}

GridPoint halved(GridPoint p) noexcept { return {p.x >> 1, p.y >> 1}; }

/// Returns the rotation after turning further. It is within half a step of the exact product of the pairs,
/// and where the angle is a short decimal it is scaled back to length 1 by the angle's own pair.
geom::GridRotation turned_by(geom::GridRotation rotation, double degrees) {
  return geom::rotation_from_degrees(std::remainder(geom::degrees_of(rotation) + degrees, 360.0));
}

/// The outcome of a command in a workspace: the placements that it changes and those that it removes.
struct Outcome {
  Placements changed;
  std::vector<std::uint64_t> removed;
  /// True for commands that cannot break a rule, so that nothing need be checked.
  bool breaks_no_rule = false;
  std::vector<FeatureChange> features = {};
  JobChange job = {};
};

class Planner {
 public:
  Planner(const Workspace& workspace, Mode mode, const RunControl& run)
      : workspace_(workspace), document_(workspace.document()), mode_(mode), run_(run) {}

  Result<Outcome> operator()(const PlaceCommand& c) const {
    if (c.part >= document_.parts.size()) return wrong(fmt::format("there is no part number {}", c.part));
    LEKALO_CHECK(known_sheet(document_, {c.stock, c.copy}));
    if (!is_rotation(c.rotation)) return wrong("a rotation's c and s must have c^2 + s^2 = 1");
    return limited({{.id = document_.next_id,
                     .part = c.part,
                     .stock = c.stock,
                     .copy = c.copy,
                     .rotation = c.rotation,
                     .mirrored = c.mirrored,
                     .at = c.at}});
  }

  Result<Outcome> operator()(const MoveCommand& c) const {
    LEKALO_TRY(auto placements, shifted(c.ids, c.by, c.to));
    return limited(std::move(placements));
  }

  Result<Outcome> operator()(const RotateCommand& c) const {
    if (!(std::abs(c.degrees) <= 360000))
      return wrong(fmt::format("{} degrees; turn by at most 360000", c.degrees));
    return about_middle(
        c.ids, [&](Placement& placement) { placement.rotation = turned_by(placement.rotation, c.degrees); },
        geom::rotation_from_degrees(c.degrees), false);
  }

  Result<Outcome> operator()(const FlipCommand& c) const {
    // The picture is mirrored in x after the part has been mirrored and turned. That is the same as mirroring
    // the part once more first, and turning it the other way.
    return about_middle(
        c.ids,
        [](Placement& placement) {
          placement.mirrored = !placement.mirrored;
          placement.rotation.s = -placement.rotation.s;
        },
        {}, true);
  }

  Result<Outcome> operator()(const RemoveCommand& c) const {
    LEKALO_TRY(auto placements, movable(workspace_, c.ids));
    return Outcome{{}, c.ids, true};
  }

  Result<Outcome> operator()(const SwapCommand& c) const {
    LEKALO_TRY(auto placements, movable(workspace_, {c.a, c.b}));
    Placement &a = placements[0], &b = placements[1];
    const GridPoint shift =
        halved(twice_middle(placed_box(workspace_, b)) - twice_middle(placed_box(workspace_, a)));
    a.at = a.at + shift;
    b.at = b.at - shift;
    std::swap(a.stock, b.stock);
    std::swap(a.copy, b.copy);
    return limited(std::move(placements));
  }

  Result<Outcome> operator()(const LockCommand& c) const {
    LEKALO_TRY(auto placements, movable(workspace_, c.ids, true));
    for (Placement& placement : placements) placement.locked = c.locked;
    return Outcome{std::move(placements), {}, true};
  }

  Result<Outcome> operator()(const SlideCommand& c) const {
    return moved(c.ids, c.direction,
                 [&](Group& group) { group.slide(unit_vector(c.direction), reach_of(group)); });
  }

  Result<Outcome> operator()(const SlideAlongCommand& c) const {
    return moved(c.ids, c.by, [&](Group& group) { group.slide_along(c.by); });
  }

  Result<Outcome> operator()(const SettleCommand& c) const {
    if (c.then && (*c.then == GridPoint{} || !on_grid(*c.then)))
      return wrong("the second direction has no length, or is too long");
    return moved(c.ids, c.direction, [&](Group& group) {
      group.settle(unit_vector(c.direction));
      // The placements settle into the corner in turns, because settling in one direction may open the way in
      // the other.
      for (int round = 0; c.then && round < 16; ++round) {
        const GridPoint before = group.placements()[0].at;
        group.slide(unit_vector(*c.then), reach_of(group));
        group.slide(unit_vector(c.direction), reach_of(group));
        const GridPoint way = group.placements()[0].at - before;
        if (dot(way, way) < 64) break;
      }
    });
  }

  Result<Outcome> operator()(const PushCommand& c) const {
    LEKALO_TRY(auto placements, startable(c.ids, c.by));
    const Sheet sheet{placements[0].stock, placements[0].copy};
    const geom::Point direction = unit_vector(c.by),
                      way{static_cast<double>(c.by.x), static_cast<double>(c.by.y)};
    Placements pushed = std::move(placements);
    const GridPoint goal = pushed[0].at + c.by;
    while (true) {
      Group group(workspace_, pushed);
      const GridPoint left = goal - pushed[0].at;
      const double length =
          geom::dot(geom::Point{static_cast<double>(left.x), static_cast<double>(left.y)}, way) /
          geom::norm(way);
      const bool blocked = length > 0 && group.slide(direction, length);
      pushed = group.placements();
      if (!blocked) break;
      bool joined = false, fixed = false;
      for (const phi::BodyIndex body : group.blockers(direction)) {
        const std::uint64_t id = workspace_.placement_of(sheet, body);
        const Placement* other = id == 0 ? nullptr : workspace_.find(id);
        fixed = fixed || other == nullptr || other->locked;
        if (other == nullptr || other->locked) continue;
        pushed.push_back(*other);
        joined = true;
      }
      if (fixed || !joined) break;
    }
    return limited(std::move(pushed));
  }

  Result<Outcome> operator()(const SnapCommand& c) const {
    LEKALO_TRY(auto placements, movable(workspace_, {c.id}));
    if (c.reach <= 0 || c.reach > kMostShift) return wrong("snapping needs a reach above 0");
    const auto place = snapped(workspace_, placements.front(), c.reach);
    if (!place)
      return wrong(fmt::format("placement {}: no edge within {} mm that it fits against", c.id,
                               geom::mm_from_grid(c.reach)));
    return limited({*place});
  }

  Result<Outcome> operator()(const CompactCommand& c) const {
    if (c.sheet) {
      LEKALO_CHECK(known_sheet(document_, *c.sheet));
    }
    LEKALO_CHECK(check_direction(c.direction));
    const geom::Point direction = unit_vector(c.direction);
    Workspace work = workspace_;
    std::vector<Sheet> sheets = c.sheet ? std::vector{*c.sheet} : sheets_in_use();
    constexpr int kMostRounds = 8;
    // The first round moves most of it and takes as long as two of the others. Progress counts all rounds,
    // and a sheet that needs fewer ends sooner than was announced.
    constexpr double kShares = kMostRounds + 1;
    std::map<Sheet, double> parts;
    double total = 0;
    for (const Placement& placement : document_.placements) parts[{placement.stock, placement.copy}] += 1;
    for (const Sheet sheet : sheets) total += kShares * parts[sheet];
    std::uint64_t settled = 0;
    // The share of the sheets that are done.
    double behind = 0;
    bool stopped = false;
    for (std::size_t i = 0; i < sheets.size() && !stopped; ++i) {
      for (int round = 0; round < kMostRounds && !stopped; ++round) {
        bool any = false;
        const std::vector<std::uint64_t> ids = foremost_first(work, sheets[i], direction);
        const double begun = round == 0 ? 0 : round + 1, share = round == 0 ? 2 : 1;
        for (std::size_t k = 0; k < ids.size() && !stopped; ++k) {
          ask();
          LEKALO_TRY(auto moved, settled_by(work, ids[k], direction));
          any = any || moved;
          ++settled;
          const double done = begun * parts[sheets[i]] + share * static_cast<double>(k + 1);
          if (run_.progress) run_.progress({settled, std::min(1.0, (behind + done) / total)});
          stopped = run_.stop_requested();
        }
        if (!any) break;
      }
      behind += kShares * parts[sheets[i]];
    }
    Placements changed;
    for (const Placement& placement : work.document().placements)
      if (const Placement* before = workspace_.find(placement.id); *before != placement)
        changed.push_back(placement);
    return limited(std::move(changed));
  }

  Result<Outcome> operator()(const NearestCommand& c) const {
    LEKALO_TRY(auto placements, shifted(c.ids, c.by, c.to));
    LEKALO_CHECK(common_sheet(placements));
    auto place = nearest_place(workspace_, placements);
    if (!place) return wrong("no valid place was found on the sheet");
    return limited(std::move(*place));
  }

  Result<Outcome> operator()(const FitCommand& c) const {
    if (c.part >= document_.parts.size()) return wrong(fmt::format("there is no part number {}", c.part));
    LEKALO_CHECK(known_sheet(document_, c.sheet));
    std::vector<Placement> places = fits_where(workspace_, c.part, c.sheet, 1, c.mirrored, run_);
    if (!places.empty()) {
      places[0].id = document_.next_id;
      return limited({places[0]});
    }
    return wrong(
        fmt::format("{} where part '{}' fits",
                    run_.stop_requested() ? "stopped before a place was found" : "no place was found",
                    document_.parts[c.part].id));
  }

  Result<Outcome> operator()(const AddFeatureCommand& c) const {
    LEKALO_CHECK(check_stock(c.stock));
    const Stock& stock = document_.stocks[c.stock];
    if (c.id.empty() || c.id.size() > kLongestFeatureId || !is_plain_text(c.id))
      return malformed(fmt::format("the id of a {} has 1 to {} bytes of UTF-8 without control characters",
                                   name_of(c.kind), kLongestFeatureId));
    if (find_feature(stock, c.kind, c.id))
      return wrong(fmt::format("stock '{}' has a {} '{}' already; give the new one another id", stock.id,
                               name_of(c.kind), c.id));
    if (feature_count(stock, c.kind) >= kMostFeatures)
      return wrong(
          fmt::format("stock '{}' has {} {}s; no more are kept", stock.id, kMostFeatures, name_of(c.kind)));
    LEKALO_CHECK(check_grade(c.kind, c.grade));
    LEKALO_TRY(auto outline, drawn_outline(c.loops));
    return of_feature({c.stock, static_cast<std::uint32_t>(feature_count(stock, c.kind)), std::nullopt,
                       Feature{c.kind, c.id, c.grade, std::move(outline)}});
  }

  Result<Outcome> operator()(const MoveFeatureCommand& c) const {
    return changed_feature(c, [&](Feature& feature) -> Result<void> {
      if (c.by == GridPoint{}) return {};
      if (!on_grid(c.by, geom::kGridLimit)) return wrong("a shift beyond the limits of the grid");
      const GridBox box = bounds(feature.outline.polygon);
      constexpr std::int64_t kMost = geom::kGridLimit / 4;
      if (!on_grid(box.low + c.by, kMost) || !on_grid(box.high + c.by, kMost))
        return wrong(fmt::format("{} '{}' would leave the range of +-{} mm", name_of(c.kind), c.id,
                                 geom::mm_from_grid(kMost)));
      // The drawn arcs are left behind. Moved as doubles they would be rounded, and might then reach out of
      // their polygon.
      feature.outline = {geom::moved(std::move(feature.outline.polygon), c.by), {}, 0};
      return {};
    });
  }

  Result<Outcome> operator()(const ReshapeFeatureCommand& c) const {
    return changed_feature(c, [&](Feature& feature) -> Result<void> {
      LEKALO_TRY(auto outline, drawn_outline(c.loops));
      feature.outline = std::move(outline);
      return {};
    });
  }

  Result<Outcome> operator()(const GradeFeatureCommand& c) const {
    return changed_feature(c, [&](Feature& feature) -> Result<void> {
      LEKALO_CHECK(check_grade(c.kind, c.grade));
      feature.grade = c.grade;
      return {};
    });
  }

  Result<Outcome> operator()(const RemoveFeatureCommand& c) const {
    LEKALO_TRY(auto change, feature_named(c));
    change.after.reset();
    return of_feature(std::move(change));
  }

  Result<Outcome> operator()(const QuantityCommand& c) const {
    if (c.quantity < 0 || c.quantity > limits::kMostCount)
      return malformed(
          fmt::format("a quantity is a whole number from 0 to {}, not {}", limits::kMostCount, c.quantity));
    return changed_part(c.part, [&](Part& part) { part.demand = c.quantity; });
  }

  Result<Outcome> operator()(const RotationsCommand& c) const {
    if (c.rotations.size() > kMostItems)
      return malformed(fmt::format("{} rotations; at most {} are kept", c.rotations.size(), kMostItems));
    for (const AngleRange& range : c.rotations)
      if (!(range.from <= range.to && -limits::kMostDegrees <= range.from &&
            range.to <= limits::kMostDegrees))
        return malformed(
            fmt::format("rotations lie within +-{} degrees, the first of a range not above its last",
                        limits::kMostDegrees));
    return changed_part(c.part, [&](Part& part) { part.rotations = c.rotations; });
  }

  Result<Outcome> operator()(const MirrorCommand& c) const {
    LEKALO_CHECK(check_part(c.part));
    for (const Kit& kit : document_.kits)
      for (const KitPiece& piece : kit.pieces)
        if (!c.may_mirror && piece.part == c.part && piece.mirrored.value_or(false))
          return wrong(fmt::format("kit '{}' is made with part '{}' turned over, so it may be mirrored",
                                   kit.id, document_.parts[c.part].id));
    return changed_part(c.part, [&](Part& part) { part.may_mirror = c.may_mirror; });
  }

  Result<Outcome> operator()(const RemovePartCommand& c) const {
    LEKALO_CHECK(check_part(c.part));
    LEKALO_TRY(auto outcome, without([&](const Placement& placement) { return placement.part == c.part; }));
    outcome.job.parts.push_back({c.part, document_.parts[c.part], std::nullopt});
    for (std::uint32_t i = 0; i < document_.kits.size(); ++i) {
      Kit rest = document_.kits[i];
      if (std::erase_if(rest.pieces, [&](const KitPiece& piece) { return piece.part == c.part; }) == 0)
        continue;
      // A kit is made of something, so one that has no piece left goes too.
      std::optional<Kit> after;
      if (!rest.pieces.empty()) after = std::move(rest);
      outcome.job.kits.push_back({i, document_.kits[i], std::move(after)});
    }
    return outcome;
  }

  Result<Outcome> operator()(const AddSheetCommand& c) const {
    if (!is_side(c.width) || !is_side(c.height))
      return malformed(fmt::format("a side of a sheet is from {} to {} mm long", limits::kShortestSide,
                                   limits::kLargestOutline));
    if (c.count < 0 || c.count > limits::kMostCount) return malformed(count_sentence(c.count));
    return with_stock(sheet_of(c.width, c.height, c.count));
  }

  Result<Outcome> operator()(const AddStripCommand& c) const {
    if (!is_side(c.width))
      return malformed(
          fmt::format("a strip is from {} to {} mm wide", limits::kShortestSide, limits::kLargestOutline));
    return with_stock(strip_of(c.width));
  }

  Result<Outcome> operator()(const CountCommand& c) const {
    LEKALO_CHECK(check_stock(c.stock));
    const Stock& stock = document_.stocks[c.stock];
    if (c.count < 1 || c.count > limits::kMostCount) return malformed(count_sentence(c.count));
    if (stock.kind == StockKind::strip && c.count != 1)
      return wrong(fmt::format("there is one of strip '{}'; add another strip instead", stock.id));
    LEKALO_TRY(auto outcome, without([&](const Placement& placement) {
                 return placement.stock == c.stock && placement.copy >= c.count &&
                        placement.copy < stock.count;
               }));
    if (stock.count == c.count) return outcome;
    outcome.job.stocks.push_back({c.stock, stock, stock});
    outcome.job.stocks.back().after->count = c.count;
    return outcome;
  }

  Result<Outcome> operator()(const RemoveStockCommand& c) const {
    LEKALO_CHECK(check_stock(c.stock));
    LEKALO_TRY(auto outcome, without([&](const Placement& placement) { return placement.stock == c.stock; }));
    outcome.job.stocks.push_back({c.stock, document_.stocks[c.stock], std::nullopt});
    return outcome;
  }

  Result<Outcome> operator()(const RuleCommand& c) const {
    if (c.length < 0 || c.length > geom::grid_from_mm(limits::kLargestOutline))
      return malformed(fmt::format("gap, border and kerf are from 0 to {} mm", limits::kLargestOutline));
    Rules rules = document_.rules;
    switch (c.kind) {
      case RuleKind::gap:
        rules.gap = std::max(c.length, rules.kerf);
        break;
      case RuleKind::border:
        rules.border_gap = c.length;
        break;
      case RuleKind::kerf:
        rules.kerf = c.length;
        rules.gap = std::max(rules.gap, c.length);
    }
    Outcome outcome{{}, {}, true};
    if (!(rules == document_.rules)) outcome.job.rules = RulesChange{document_.rules, rules};
    return outcome;
  }

 private:
  Result<void> check_part(std::uint32_t part) const {
    if (part < document_.parts.size()) return {};
    return failure(ErrorCode::usage, fmt::format("there is no part number {}", part));
  }
  template <class Edit>
  Result<Outcome> changed_part(std::uint32_t part, Edit&& edit) const {
    LEKALO_CHECK(check_part(part));
    Outcome outcome{{}, {}, true};
    Part after = document_.parts[part];
    edit(after);
    if (!(after == document_.parts[part]))
      outcome.job.parts.push_back({part, document_.parts[part], std::move(after)});
    return outcome;
  }
  /// Takes placements off; one that is locked refuses.
  template <class Which>
  Result<Outcome> without(Which&& which) const {
    Outcome outcome{{}, {}, true};
    for (const Placement& placement : document_.placements)
      if (which(placement)) outcome.removed.push_back(placement.id);
    if (!outcome.removed.empty()) LEKALO_CHECK(movable(workspace_, outcome.removed));
    return outcome;
  }
  Result<Outcome> with_stock(Stock stock) const {
    if (document_.stocks.size() >= kMostItems)
      return wrong(fmt::format("the layout has {} stocks; no more are kept", kMostItems));
    Outcome outcome{{}, {}, true};
    outcome.job = added(document_, {{}, {std::move(stock)}});
    return outcome;
  }
  static bool is_side(std::int64_t steps) {
    return geom::grid_from_mm(limits::kShortestSide) <= steps &&
           steps <= geom::grid_from_mm(limits::kLargestOutline);
  }
  static std::string count_sentence(std::int64_t count) {
    return fmt::format("there are from 1 to {} of a stock, not {}", limits::kMostCount, count);
  }

  static Result<Outcome> limited(Placements placements) {
    LEKALO_TRY(auto within, within_limits(std::move(placements)));
    return Outcome{std::move(within), {}, false};
  }

  Result<void> check_stock(std::uint32_t stock) const {
    if (stock < document_.stocks.size()) return {};
    return failure(ErrorCode::usage, fmt::format("there is no stock number {}", stock));
  }
  static tl::unexpected<Error> malformed(std::string message) {
    return failure(ErrorCode::bad_input, std::move(message));
  }
  static Result<void> check_grade(FeatureKind kind, int grade) {
    const bool defect = kind == FeatureKind::defect;
    const int low = defect ? 1 : 0, high = defect ? kMostSeverity : kMostQuality;
    if (grade >= low && grade <= high) return {};
    return failure(ErrorCode::bad_input,
                   fmt::format("the {} of a {} is a whole number from {} to {}, not {}",
                               defect ? "severity" : "quality", name_of(kind), low, high, grade));
  }
  static Result<Outline> drawn_outline(const std::vector<std::vector<GridPoint>>& loops) {
    std::size_t points = 0;
    for (const auto& loop : loops) points += loop.size();
    if (points > kMostFeaturePoints)
      return malformed(
          fmt::format("an outline of {} points; at most {} are kept", points, kMostFeaturePoints));
    LEKALO_TRY(auto polygon, geom::make_grid_region(loops));
    return Outline{std::move(polygon), {}, 0};
  }
  /// Returns the change of the feature that a command names, in which it is as yet the same before and after.
  template <class Named>
  Result<FeatureChange> feature_named(const Named& c) const {
    LEKALO_CHECK(check_stock(c.stock));
    const Stock& stock = document_.stocks[c.stock];
    const auto index = find_feature(stock, c.kind, c.id);
    if (!index) return wrong(fmt::format("stock '{}' has no {} '{}'", stock.id, name_of(c.kind), c.id));
    const Feature feature = feature_at(stock, c.kind, *index);
    return FeatureChange{c.stock, *index, feature, feature};
  }
  static Outcome of_feature(FeatureChange change) {
    Outcome outcome{{}, {}, true};
    if (change.before != change.after) outcome.features.push_back(std::move(change));
    return outcome;
  }
  template <class Named, class Edit>
  Result<Outcome> changed_feature(const Named& c, Edit&& edit) const {
    LEKALO_TRY(auto change, feature_named(c));
    LEKALO_CHECK(edit(*change.after));
    return of_feature(std::move(change));
  }

  std::vector<Sheet> sheets_in_use() const {
    std::set<Sheet> sheets;
    for (const Placement& placement : document_.placements)
      if (placement.copy >= 0 && placement.copy < document_.stocks[placement.stock].count)
        sheets.insert({placement.stock, placement.copy});
    return {sheets.begin(), sheets.end()};
  }

  /// Settles one placement of a workspace.
  /// \return whether it went further than a few steps
  Result<bool> settled_by(Workspace& work, std::uint64_t id, geom::Point direction) const {
    const Placement before = *work.find(id);
    Placement after = before;
    {
      Group group(work, {before});
      if (!group.is_clear()) {
        if (mode_ == Mode::free) return false;
        return failure(ErrorCode::refuted,
                       fmt::format("placement {} breaks a rule where it lies; mend that first", id));
      }
      group.settle(direction);
      after = group.placements()[0];
    }
    const GridPoint way = after.at - before.at;
    if (dot(way, way) < 64) return false;
    work.set(after);
    return true;
  }

  static Result<void> check_direction(GridPoint direction) {
    if (direction == GridPoint{}) return failure(ErrorCode::usage, "a direction of no length");
    if (!on_grid(direction, geom::kGridLimit))
      return failure(ErrorCode::usage, "a direction beyond the limits of the grid");
    return {};
  }

  double reach_of(const Group& group) const {
    const GridBox world = bounds(document_.stocks[group.sheet().stock].outline.polygon);
    const GridBox box = group.box();
    return static_cast<double>(world.high.x - world.low.x) + static_cast<double>(world.high.y - world.low.y) +
           static_cast<double>(box.high.x - box.low.x) + static_cast<double>(box.high.y - box.low.y);
  }

  Result<Placements> shifted(const std::vector<std::uint64_t>& ids, GridPoint by,
                             const std::optional<Sheet>& to) const {
    LEKALO_TRY(auto placements, movable(workspace_, ids));
    if (!on_grid(by, geom::kGridLimit)) return wrong("a shift beyond the limits of the grid");
    if (to) {
      LEKALO_CHECK(known_sheet(document_, *to));
    }
    for (Placement& placement : placements) {
      placement.at = placement.at + by;
      if (to) placement.stock = to->stock, placement.copy = to->copy;
    }
    return placements;
  }

  /// Turns each placement by `turn`, and then moves it so that the middle of its box goes round the middle of
  /// all.
  template <class Turn>
  Result<Outcome> about_middle(const std::vector<std::uint64_t>& ids, Turn&& turn,
                               geom::GridRotation rotation, bool mirrored) const {
    LEKALO_TRY(auto placements, movable(workspace_, ids));
    LEKALO_CHECK(common_sheet(placements));
    const GridPoint centre = twice_middle(workspace_, placements);
    for (Placement& placement : placements) {
      // The placement's origin turns with the whole about the centre. Half steps keep the centre exact.
      const GridPoint origin = placement.at + placement.at - centre;
      turn(placement);
      placement.at = halved(geom::turned(origin, rotation, mirrored) + centre);
    }
    return limited(std::move(placements));
  }

  /// Returns placements that lie on one sheet, clear of everything else. Fails where they do not, or where
  /// the direction has no length.
  Result<Placements> startable(const std::vector<std::uint64_t>& ids, GridPoint direction) const {
    LEKALO_TRY(auto placements, movable(workspace_, ids));
    LEKALO_CHECK(common_sheet(placements));
    LEKALO_CHECK(check_direction(direction));
    if (!Group(workspace_, placements).is_clear())
      return failure(
          ErrorCode::refuted,
          fmt::format("placement {} breaks a rule where it lies; sliding needs a valid place to start from",
                      ids.front()));
    return placements;
  }

  template <class Motion>
  Result<Outcome> moved(const std::vector<std::uint64_t>& ids, GridPoint direction, Motion&& motion) const {
    LEKALO_TRY(auto placements, startable(ids, direction));
    Group group(workspace_, std::move(placements));
    motion(group);
    return limited(group.placements());
  }

  static std::vector<std::uint64_t> foremost_first(const Workspace& work, Sheet sheet,
                                                   geom::Point direction) {
    std::vector<std::pair<double, std::uint64_t>> order;
    for (const Placement& placement : work.document().placements) {
      if (placement.locked || Sheet{placement.stock, placement.copy} != sheet) continue;
      const GridBox& box = work.scene(sheet).box(work.shape(sheet, placement));
      const GridPoint low = box.low + placement.at, high = box.high + placement.at;
      const double front =
          std::max(direction.x * static_cast<double>(low.x), direction.x * static_cast<double>(high.x)) +
          std::max(direction.y * static_cast<double>(low.y), direction.y * static_cast<double>(high.y));
      order.push_back({-front, placement.id});
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint64_t> ids;
    for (const auto& [front, id] : order) ids.push_back(id);
    return ids;
  }

  const Workspace& workspace_;
  const Document& document_;
  Mode mode_;
  const RunControl& run_;
};

std::string described(const Violation& violation) {
  std::string text = fmt::format("placement {}: {}", violation.a, name_of(violation.kind));
  if (violation.b != 0) text += fmt::format(" with placement {}", violation.b);
  if (violation.amount_mm > 0) text += fmt::format(", {:.6g} mm", violation.amount_mm);
  return text;
}

}  // namespace

Result<Change> plan(const Workspace& workspace, const Command& command, Mode mode, const RunControl& run) {
  LEKALO_TRY(auto outcome, std::visit(Planner(workspace, mode, run), command));
  const bool new_one =
      std::holds_alternative<PlaceCommand>(command) || std::holds_alternative<FitCommand>(command);
  if (mode == Mode::strict && !outcome.breaks_no_rule && !workspace.is_clear(outcome.changed)) {
    const auto violations = workspace.violations_of(outcome.changed);
    return failure(
        ErrorCode::refuted,
        fmt::format("not admitted: {}{}", violations.empty() ? "a rule" : described(violations.front()),
                    violations.size() > 1 ? fmt::format(" (and {} more)", violations.size() - 1) : ""));
  }
  Change change;
  change.features = std::move(outcome.features);
  change.job = std::move(outcome.job);
  const std::uint64_t next = workspace.document().next_id;
  change.next_id_before = next;
  change.next_id_after = new_one ? next + 1 : next;
  for (const Placement& after : outcome.changed) {
    const Placement* before = workspace.find(after.id);
    if (before != nullptr && *before == after) continue;
    change.placements.push_back({before == nullptr ? std::nullopt : std::optional(*before), after});
  }
  for (const std::uint64_t id : outcome.removed)
    change.placements.push_back({*workspace.find(id), std::nullopt});
  std::sort(change.placements.begin(), change.placements.end(),
            [](const PlacementChange& a, const PlacementChange& b) {
              return (a.before ? a.before->id : a.after->id) < (b.before ? b.before->id : b.after->id);
            });
  return change;
}

}  // namespace lekalo::layout
