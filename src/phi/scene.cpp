#include "lekalo/phi/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/stop.hpp"
#include "pair_memory.hpp"

namespace lekalo::phi {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;

GridBox grown(GridBox box, std::int64_t by) noexcept {
  return {{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}
/// Returns the same region with every loop begun at its least point and holes in order, so that equal
/// outlines give equal regions.
GridRegion in_normal_order(const GridRegion& region) {
  const auto less = [](GridPoint a, GridPoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::vector<std::vector<GridPoint>> loops;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    loops.emplace_back(region.points.begin() + region.loop_starts[l],
                       region.points.begin() + region.loop_starts[l + 1]);
    std::rotate(loops[l].begin(), std::min_element(loops[l].begin(), loops[l].end(), less), loops[l].end());
  }
  std::sort(loops.begin() + 1, loops.end(),
            [&](const auto& a, const auto& b) { return less(a.front(), b.front()); });
  GridRegion ordered;
  for (const auto& loop : loops) {
    ordered.points.insert(ordered.points.end(), loop.begin(), loop.end());
    ordered.loop_starts.push_back(static_cast<std::uint32_t>(ordered.points.size()));
  }
  return ordered;
}

std::uint64_t hash(const GridRegion& region) noexcept {
  std::uint64_t value = region.loops();
  const auto mix = [&](std::uint64_t part) {
    value = (value ^ part) * 0x9E3779B97F4A7C15u;
    value ^= value >> 29;
  };
  for (const GridPoint p : region.points) {
    mix(static_cast<std::uint64_t>(p.x));
    mix(static_cast<std::uint64_t>(p.y));
  }
  return value;
}

/// Returns which of 16 ways to go is meant.
std::size_t direction(GridPoint way) noexcept {
  const std::int64_t x = way.x < 0 ? -way.x : way.x, y = way.y < 0 ? -way.y : way.y;
  const auto bit = [](bool value) { return static_cast<std::size_t>(value); };
  return bit(way.x < 0) | bit(way.y < 0) << 1 | (bit(x < y) + bit(x < 2 * y) + bit(2 * x < y)) << 2;
}

constexpr std::size_t kMostGaps = 255;
/// A cell of the index stands for this many of the cells asked for, because a few long lists are visited
/// faster than many short ones.
constexpr std::size_t kCellsInOne = 4;
/// There are this many small cells along the side of a cell.
constexpr std::int32_t kSmall = 12;
/// The inner points of an outline are worth finding after this many questions; a shape that is turned away is
/// not asked so often.
constexpr std::uint8_t kAskedOften = 8;
/// Bodies wider or higher than this many small cells are not marked in them.
constexpr double kMostSmall = 256;

}  // namespace

/// The findings of questions. Forms are outlines that differ by more than a shift. The memory only speeds
/// questions up, so a copy of a scene makes maps of its own.
struct Scene::Memory {
  std::vector<FlatOutline> forms;
  /// The height of a small cell.
  double row = 1;
  /// By form: its spans, in rows of that height.
  std::vector<std::vector<FlatOutline::Span>> covers;
  /// By hash: the forms that have it.
  std::multimap<std::uint64_t, std::uint32_t> form_of;
  std::vector<std::int64_t> gaps = {0};
  PairMemory pairs;

  Memory() = default;
  Memory(const Memory& other)
      : forms(other.forms), row(other.row), covers(other.covers), form_of(other.form_of), gaps(other.gaps) {}
  Memory& operator=(const Memory&) = delete;

  std::uint32_t form(const GridRegion& outline) {
    FlatOutline flat = flat_outline(in_normal_order(outline));
    const std::uint64_t code = hash(flat.region);
    const auto [first, last] = form_of.equal_range(code);
    for (auto i = first; i != last; ++i)
      if (forms[i->second].region == flat.region) return i->second;
    form_of.emplace(code, static_cast<std::uint32_t>(forms.size()));
    covers.emplace_back();
    forms.push_back(std::move(flat));
    return static_cast<std::uint32_t>(forms.size() - 1);
  }

  /// Returns a small number for a gap, or kMostGaps when there are too many gaps to number.
  std::size_t gap_number(std::int64_t gap) {
    if (gap == 0) return 0;
    for (std::size_t i = 1; i < gaps.size(); ++i)
      if (gaps[i] == gap) return i;
    if (gaps.size() == kMostGaps) return kMostGaps;
    gaps.push_back(gap);
    return gaps.size() - 1;
  }
};

struct Scene::Question {
  GridBox box;  ///< of the probe
  /// A body whose box lies beyond it is out of everybody's gap.
  GridBox reach;
  std::int64_t widest, gap, tolerates;
  std::uint32_t form, layers;
  BodyIndex except;
  std::uint32_t number;
  bool is_box;
};

Scene::Scene(const GridBox& world, std::size_t cells) : world_(world), memory_(std::make_unique<Memory>()) {
  const double width = static_cast<double>(world.high.x - world.low.x) + 1;
  const double height = static_cast<double>(world.high.y - world.low.y) + 1;
  LEKALO_ASSERT(width >= 1 && height >= 1);
  const double count =
      static_cast<double>(std::clamp<std::size_t>(cells / kCellsInOne, 1, std::size_t{1} << 26));
  // A world that is much longer than wide has one row of cells, and no more cells than asked for.
  const double side = std::max({std::sqrt(width * height / count), width / count, height / count, 1.0});
  per_step_ = 1 / side;
  columns_ = static_cast<std::int32_t>(width * per_step_) + 1;
  rows_ = static_cast<std::int32_t>(height * per_step_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  small_per_step_ = kSmall / side;
  small_columns_ = kSmall * columns_;
  small_rows_ = kSmall * rows_;
  covered_by_.assign(static_cast<std::size_t>(small_columns_) * static_cast<std::size_t>(small_rows_),
                     kNoBody);
  memory_->row = side / kSmall;
}

Scene::~Scene() = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene::Scene(const Scene& other)
    : world_(other.world_),
      per_step_(other.per_step_),
      columns_(other.columns_),
      rows_(other.rows_),
      cells_(other.cells_),
      free_cell_(other.free_cell_),
      shapes_(other.shapes_),
      bodies_(other.bodies_),
      placed_(other.placed_),
      blockers_(other.blockers_),
      small_per_step_(other.small_per_step_),
      small_columns_(other.small_columns_),
      small_rows_(other.small_rows_),
      covered_by_(other.covered_by_),
      is_in_(other.is_in_),
      free_(other.free_),
      containers_(other.containers_),
      widest_gap_(other.widest_gap_),
      question_(other.question_),
      memory_(std::make_unique<Memory>(*other.memory_)) {}
Scene& Scene::operator=(Scene other) noexcept {
  Scene made(std::move(other));
  std::destroy_at(this);
  std::construct_at(this, std::move(made));
  return *this;
}

ShapeIndex Scene::add_shape(GridRegion outline) {
  const GridBox box = bounds(outline);
  const std::uint32_t form = memory_->form(outline);
  shapes_.push_back({std::move(outline), box, form, memory_->forms[form].box});
  return static_cast<ShapeIndex>(shapes_.size() - 1);
}

Scene::Cells Scene::cells_of(const GridBox& box) const noexcept {
  const auto index = [&](std::int64_t value, std::int64_t low, std::int32_t count) {
    const double at = static_cast<double>(value - low) * per_step_;
    return static_cast<std::int32_t>(std::max(0.0, std::min(at, static_cast<double>(count - 1))));
  };
  return {index(box.low.x, world_.low.x, columns_), index(box.high.x, world_.low.x, columns_),
          index(box.low.y, world_.low.y, rows_), index(box.high.y, world_.low.y, rows_)};
}

std::uint32_t Scene::next_question() const {
  if (++question_ == 0) {
    for (const Placed& placed : placed_) placed.question = 0;
    question_ = 1;
  }
  return question_;
}

template <class Accept, class Visit>
bool Scene::visit_cell(std::size_t cell, std::uint32_t question, Accept&& accept, Visit&& visit) const {
  for (const Cell* at = &cells_[cell];; at = &cells_[at->next]) {
    // The first loop collects all bodies that count, without a branch. The second visits them, which takes
    // long.
    std::array<BodyIndex, std::tuple_size_v<decltype(Cell::bodies)>> some;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < at->count; ++i) {
      const BodyIndex index = at->bodies[i];
      const Placed& placed = placed_[index];
      const bool is_new = placed.question != question;
      placed.question = question;
      some[count] = index;
      count += static_cast<std::size_t>(is_new & accept(placed));
    }
    for (std::size_t i = 0; i < count; ++i)
      if (visit(some[i])) return true;
    if (at->next == 0) return false;
  }
}

template <class Accept, class Visit>
bool Scene::visit_near(const GridBox& box, std::uint32_t question, Accept&& accept, Visit&& visit) const {
  const Cells cells = cells_of(box);
  const auto width = static_cast<std::size_t>(columns_);
  for (std::int32_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int32_t x = cells.left; x <= cells.right; ++x)
      if (visit_cell(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x), question, accept,
                     visit))
        return true;
  return false;
}

void Scene::cover(BodyIndex index, BodyIndex from, BodyIndex to) {
  const Placed& body = placed_[index];
  auto& spans = memory_->covers[body.form];
  const FlatOutline& form = memory_->forms[body.form];
  if (spans.empty() && static_cast<double>(std::max(form.width, form.height)) <= kMostSmall * memory_->row)
    spans = covered_spans(form, memory_->row);
  // Positions are in small cells. A cell counts when it lies in the span whatever the roundings.
  constexpr double kMargin = 0x1p-20;
  const double left = static_cast<double>(body.box.low.x - world_.low.x),
               bottom = static_cast<double>(body.box.low.y - world_.low.y) * small_per_step_;
  const double first_row = std::floor(bottom);
  if (!(first_row >= -0x1p20 && first_row <= 0x1p30)) return;
  for (std::size_t j = 0; j < spans.size(); ++j) {
    if (spans[j].low > spans[j].high) continue;
    const std::int64_t y = static_cast<std::int64_t>(first_row) + static_cast<std::int64_t>(j);
    if (y < 0 || y >= small_rows_) continue;
    const double low = (left + static_cast<double>(spans[j].low)) * small_per_step_,
                 high = (left + static_cast<double>(spans[j].high)) * small_per_step_;
    const auto first = static_cast<std::int64_t>(std::max(0.0, std::ceil(low + kMargin))),
               last = static_cast<std::int64_t>(
                   std::min(std::floor(high - kMargin), static_cast<double>(small_columns_)));
    BodyIndex* const row = covered_by_.data() + y * small_columns_;
    for (std::int64_t x = first; x < last; ++x)
      if (row[x] == from) row[x] = to;
  }
}

/// Step 1 of docs/design/scene.md.
bool Scene::lies_on_covered(const Question& q) const {
  const double x = static_cast<double>(q.box.low.x - world_.low.x),
               y = static_cast<double>(q.box.low.y - world_.low.y);
  FlatOutline& form = memory_->forms[q.form];
  if (form.asked < kAskedOften && ++form.asked == kAskedOften) form.inner = inner_points(form);
  for (const GridPoint inner : form.inner) {
    const double at_x = (x + static_cast<double>(inner.x)) * small_per_step_,
                 at_y = (y + static_cast<double>(inner.y)) * small_per_step_;
    if (!(at_x >= 0 && at_y >= 0 && at_x < small_columns_ && at_y < small_rows_)) continue;
    const BodyIndex index = covered_by_[static_cast<std::size_t>(static_cast<std::int32_t>(at_y)) *
                                            static_cast<std::size_t>(small_columns_) +
                                        static_cast<std::size_t>(static_cast<std::int32_t>(at_x))];
    if (index == kNoBody) continue;
    // The probe is near its own place, so other bodies are not under its middle.
    if (index == q.except) return false;
    if ((placed_[index].layers & q.layers) != 0 && placed_[index].rank > q.tolerates) return true;
  }
  return false;
}

void Scene::add_to_cell(std::size_t cell, BodyIndex index) {
  // The first cell of a chain is the one with room.
  if (cells_[cell].count == cells_[cell].bodies.size()) {
    std::uint32_t room = free_cell_;
    if (room == 0) {
      room = static_cast<std::uint32_t>(cells_.size());
      cells_.emplace_back();
    } else {
      free_cell_ = cells_[room].next;
    }
    cells_[room] = cells_[cell];
    cells_[cell].next = room;
    cells_[cell].count = 0;
  }
  Cell& first = cells_[cell];
  first.bodies[first.count++] = index;
}

void Scene::remove_from_cell(std::size_t cell, BodyIndex index) {
  Cell& first = cells_[cell];
  BodyIndex* found = nullptr;
  for (Cell* at = &first; found == nullptr; at = &cells_[at->next]) {
    BodyIndex* const end = at->bodies.data() + at->count;
    BodyIndex* const place = std::find(at->bodies.data(), end, index);
    if (place != end) found = place;
  }
  *found = first.bodies[--first.count];
  if (first.count == 0 && first.next != 0) {
    const std::uint32_t room = first.next;
    first = cells_[room];
    cells_[room].next = free_cell_;
    free_cell_ = room;
  }
}

BodyIndex Scene::put(const Body& body) {
  BodyIndex index = static_cast<BodyIndex>(bodies_.size());
  const Shape& shape = shapes_[body.shape];
  const Placed placed{{shape.box.low + body.at, shape.box.high + body.at},
                      body.gap,
                      body.rank,
                      shape.form,
                      body.container ? 0 : body.layers,
                      0,
                      shape.is_box};
  if (free_.empty()) {
    bodies_.push_back(body);
    free_.reserve(bodies_.capacity());  // so that taking a body out asks for no memory
    placed_.push_back(placed);
    blockers_.emplace_back().fill(kNoBody);
    is_in_.push_back(1);
  } else {
    index = free_.back();
    free_.pop_back();
    bodies_[index] = body;
    placed_[index] = placed;
    is_in_[index] = 1;
  }
  widest_gap_ = std::max(widest_gap_, body.gap);
  if (body.container) {
    containers_.insert(std::lower_bound(containers_.begin(), containers_.end(), index), index);
    return index;
  }
  cover(index, kNoBody, index);
  const Cells cells = cells_of(placed.box);
  for (std::int32_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int32_t x = cells.left; x <= cells.right; ++x)
      add_to_cell(
          static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x),
          index);
  return index;
}

void Scene::take(BodyIndex index) {
  LEKALO_ASSERT(index < bodies_.size() && is_in_[index] != 0);
  is_in_[index] = 0;
  free_.push_back(index);
  if (bodies_[index].container) {
    containers_.erase(std::find(containers_.begin(), containers_.end(), index));
    return;
  }
  cover(index, index, kNoBody);
  placed_[index].layers = 0;
  const Cells cells = cells_of(placed_[index].box);
  for (std::int32_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int32_t x = cells.left; x <= cells.right; ++x)
      remove_from_cell(
          static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x),
          index);
}

Scene::Question Scene::question(const Probe& probe) const {
  const Shape& shape = shapes_[probe.shape];
  const GridBox box{shape.box.low + probe.at, shape.box.high + probe.at};
  const std::int64_t widest = std::max(widest_gap_, probe.gap);
  return {.box = box,
          .reach = grown(box, widest),
          .widest = widest,
          .gap = probe.gap,
          .tolerates = probe.tolerates,
          .form = shape.form,
          .layers = probe.layers,
          .except = probe.except,
          .number = next_question(),
          .is_box = shape.is_box};
}

bool Scene::is_in_reach(const Placed& body, const Question& q) noexcept {
  const auto bit = [](bool value) { return static_cast<unsigned>(value); };
  return (bit((body.layers & q.layers) != 0) & bit(body.rank > q.tolerates) &
          bit(q.reach.low.x < body.box.high.x) & bit(q.reach.high.x > body.box.low.x) &
          bit(q.reach.low.y < body.box.high.y) & bit(q.reach.high.y > body.box.low.y)) != 0;
}

bool Scene::forbids(const Placed& body, const Question& q) const {
  const std::int64_t gap = std::max(body.gap, q.gap);
  // The body is within reach of the widest gap, but not of the gap between the two.
  if (gap != q.widest && (q.box.low.x - gap >= body.box.high.x || q.box.high.x + gap <= body.box.low.x ||
                          q.box.low.y - gap >= body.box.high.y || q.box.high.y + gap <= body.box.low.y))
    return false;
  if (gap == 0 && body.is_box && q.is_box) return true;
  const GridPoint shift = q.box.low - body.box.low;
  return body.form <= q.form ? pair_forbids(body.form, q.form, shift, gap, false)
                             : pair_forbids(q.form, body.form, -shift, gap, false);
}

/// Steps 4 and 5: asks the pair's map if there is one or it is time for one, and else the outlines.
bool Scene::pair_forbids(std::uint32_t fixed, std::uint32_t moving, GridPoint shift, std::int64_t gap,
                         bool container) const {
  Memory& memory = *memory_;
  const std::size_t number = memory.gap_number(gap);
  const OutlinePair pair{memory.forms[fixed], memory.forms[moving], gap, container};
  constexpr std::uint32_t kMostForms = 1u << 27;
  if (number == kMostGaps || fixed >= kMostForms || moving >= kMostForms) return pair.forbidden(shift);
  const PairMemory::Key key = (PairMemory::Key{fixed} << 36) | (PairMemory::Key{moving} << 9) |
                              (PairMemory::Key{number} << 1) | (container ? 1 : 0);
  if (ContactMap* map = memory.pairs.find(key)) return map->forbidden(shift, pair);
  if (!ContactMap::suits(pair) || !memory.pairs.is_due(key)) return pair.forbidden(shift);
  return memory.pairs.add(key, pair).forbidden(shift, pair);
}

bool Scene::container_forbids(BodyIndex index, const Question& q) const {
  const Placed& body = placed_[index];
  if (index == q.except || (bodies_[index].layers & q.layers) == 0 || body.rank <= q.tolerates) return false;
  const std::int64_t gap = std::max(body.gap, q.gap);
  // Every loop of the container keeps the gap, and the outer one keeps it around its box at least.
  if (q.box.low.x - gap < body.box.low.x || q.box.high.x + gap > body.box.high.x ||
      q.box.low.y - gap < body.box.low.y || q.box.high.y + gap > body.box.high.y)
    return true;
  if (body.is_box) return false;
  return pair_forbids(body.form, q.form, q.box.low - body.box.low, gap, true);
}

bool Scene::forbidden(const Probe& probe) const {
  ask();
  const Question q = question(probe);
  // Step 2 of docs/design/scene.md: the body that blocked this way last is asked first.
  BodyIndex* blocker = nullptr;
  if (q.except < placed_.size()) {
    const Placed& own = placed_[q.except];
    own.question = q.number;
    blocker = &blockers_[q.except][direction(q.box.low - own.box.low)];
    if (*blocker < placed_.size()) {
      const Placed& body = placed_[*blocker];
      if (is_in_reach(body, q) && body.question != q.number) {
        if (forbids(body, q)) return true;
        body.question = q.number;
      }
    }
  }
  // Containers hold nearly everything, so they are in no list.
  for (const BodyIndex index : containers_)
    if (container_forbids(index, q)) return true;
  // Step 1: covered cells.
  if (lies_on_covered(q)) return true;
  // Step 3: the lists of the coarse cells.
  return visit_near(
      q.reach, q.number, [&](const Placed& body) { return is_in_reach(body, q); },
      [&](BodyIndex index) {
        if (!forbids(placed_[index], q)) return false;
        if (blocker != nullptr) *blocker = index;
        return true;
      });
}

void Scene::forbidding(const Probe& probe, std::vector<BodyIndex>& found) const {
  found.clear();
  const Question q = question(probe);
  if (q.except < placed_.size()) placed_[q.except].question = q.number;
  for (const BodyIndex index : containers_)
    if (container_forbids(index, q)) found.push_back(index);
  visit_near(
      q.reach, q.number, [&](const Placed& body) { return is_in_reach(body, q); },
      [&](BodyIndex index) {
        if (forbids(placed_[index], q)) found.push_back(index);
        return false;
      });
  std::sort(found.begin(), found.end());
}

std::vector<BodyIndex> Scene::forbidding(const Probe& probe) const {
  std::vector<BodyIndex> found;
  forbidding(probe, found);
  return found;
}

std::vector<BodyIndex> Scene::near(const GridBox& box, std::int64_t reach, std::uint32_t layers) const {
  std::vector<BodyIndex> found;
  for (const BodyIndex index : containers_)
    if ((bodies_[index].layers & layers) != 0) found.push_back(index);
  const GridBox window = grown(box, reach);
  visit_near(
      window, next_question(),
      [&](const Placed& body) { return (body.layers & layers) != 0 && boxes_meet(body.box, window); },
      [&](BodyIndex index) {
        found.push_back(index);
        return false;
      });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<BodyIndex> Scene::at(GridPoint p, std::uint32_t layers) const {
  std::vector<BodyIndex> found;
  const GridBox window{p, p};
  visit_near(
      window, next_question(),
      [&](const Placed& body) { return (body.layers & layers) != 0 && boxes_meet(body.box, window); },
      [&](BodyIndex index) {
        const Body& body = bodies_[index];
        if (locate_point(outline(body.shape), p - body.at) != geom::PointLocation::outside)
          found.push_back(index);
        return false;
      });
  std::sort(found.begin(), found.end());
  return found;
}

NearestBody Scene::nearest(const Probe& probe, std::int64_t within) const {
  const Question q = question(probe);
  NearestBody best;
  double best_mm = HUGE_VAL;
  const auto box_distance_mm = [&](const GridBox& box) {
    const auto beyond = [](std::int64_t a, std::int64_t b) {
      return static_cast<double>(std::max<std::int64_t>({0, a, b}));
    };
    const double x = beyond(box.low.x - q.box.high.x, q.box.low.x - box.high.x),
                 y = beyond(box.low.y - q.box.high.y, q.box.low.y - box.high.y);
    return std::sqrt(x * x + y * y) * geom::kGridStep;
  };
  const auto look_at = [&](BodyIndex index) {
    if (index == q.except) return false;
    const Placed& placed = placed_[index];
    // Box distances are off by roundings. A box as near as the best may hold a body that is nearer, or as
    // near with a lower index.
    if (box_distance_mm(placed.box) > std::max(0.0, best_mm) * (1 + 0x1p-40)) return false;
    const Body& body = bodies_[index];
    const GridRegion &theirs = outline(body.shape), &ours = outline(probe.shape);
    const GridPoint shift = probe.at - body.at;
    NearestBody one{index, interiors_meet(theirs, ours, shift), edge_distance(theirs, ours, shift)};
    const geom::Point at = geom::mm_from_grid(body.at);
    one.edges.on_a = one.edges.on_a + at;
    one.edges.on_b = one.edges.on_b + at;
    const double mm = one.overlaps ? -1 : one.edges.distance_mm;
    if (mm < best_mm || (mm == best_mm && index < best.body)) best = one, best_mm = mm;
    return false;
  };
  // A body that the window does not meet is further away than the window reaches.
  for (std::int64_t reach = std::min(within, static_cast<std::int64_t>(0.25 / per_step_) + 1);;
       reach = reach > within / 4 ? within : 4 * reach) {
    const GridBox window = grown(q.box, reach);
    visit_near(
        window, next_question(),
        [&](const Placed& body) {
          return (body.layers & q.layers) != 0 && body.rank > q.tolerates && boxes_meet(body.box, window);
        },
        look_at);
    if (best_mm <= geom::mm_from_grid(reach) || reach >= within) break;
  }
  if (best_mm > geom::mm_from_grid(within)) return {};
  return best;
}

std::size_t Scene::bytes() const noexcept {
  std::size_t sum = sizeof *this + cells_.capacity() * sizeof(Cell) + shapes_.capacity() * sizeof(Shape) +
                    bodies_.capacity() * sizeof(Body) + placed_.capacity() * sizeof(Placed) +
                    covered_by_.capacity() * sizeof(BodyIndex) + blockers_.capacity() * sizeof blockers_[0] +
                    is_in_.capacity() + (free_.capacity() + containers_.capacity()) * sizeof(BodyIndex) +
                    memory_->pairs.bytes() + memory_->form_of.size() * 32;
  for (const Shape& shape : shapes_) sum += shape.outline.points.capacity() * sizeof(GridPoint);
  for (const FlatOutline& form : memory_->forms)
    sum += sizeof form + (form.region.points.capacity() + form.inner.capacity()) * sizeof(GridPoint) +
           form.edges.capacity() * sizeof(FlatOutline::Edge);
  for (const auto& spans : memory_->covers) sum += sizeof spans + spans.capacity() * sizeof spans[0];
  return sum;
}

}  // namespace lekalo::phi
