#include "lekalo/phi/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::phi {
namespace {

using geom::GridBox;
using geom::GridPoint;

GridBox grown(GridBox box, std::int64_t by) noexcept {
  return {{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}
bool meet(const GridBox& a, const GridBox& b) noexcept {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

}  // namespace

Scene::Scene(const GridBox& world, std::size_t cells) : world_(world) {
  const double width = static_cast<double>(world.high.x - world.low.x) + 1;
  const double height = static_cast<double>(world.high.y - world.low.y) + 1;
  LEKALO_ASSERT(width >= 1 && height >= 1);
  cell_ = static_cast<std::int64_t>(
              std::sqrt(width * height / static_cast<double>(std::max<std::size_t>(cells, 1)))) +
          1;
  columns_ = (world.high.x - world.low.x) / cell_ + 1;
  rows_ = (world.high.y - world.low.y) / cell_ + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
}

ShapeIndex Scene::add_shape(geom::GridRegion outline) {
  const GridBox box = bounds(outline);
  shapes_.push_back({std::move(outline), box});
  return static_cast<ShapeIndex>(shapes_.size() - 1);
}

GridBox Scene::placed_box(const Body& body) const noexcept {
  const GridBox& box = shapes_[body.shape].box;
  return {box.low + body.at, box.high + body.at};
}

Scene::Cells Scene::cells_of(const GridBox& box) const noexcept {
  const auto index = [&](std::int64_t value, std::int64_t low, std::int64_t count) {
    return std::clamp<std::int64_t>(value <= low ? 0 : (value - low) / cell_, 0, count - 1);
  };
  return {index(box.low.x, world_.low.x, columns_), index(box.high.x, world_.low.x, columns_),
          index(box.low.y, world_.low.y, rows_), index(box.high.y, world_.low.y, rows_)};
}

template <class Visit>
bool Scene::visit_near(const GridBox& box, Visit&& visit) const {
  const Cells cells = cells_of(box);
  for (std::int64_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int64_t x = cells.left; x <= cells.right; ++x)
      for (const BodyIndex index : cells_[static_cast<std::size_t>(y * columns_ + x)]) {
        const GridBox other = placed_box(bodies_[index]);
        if (!meet(other, box)) continue;
        // Once: in the first of the cells that both have.
        const Cells theirs = cells_of(other);
        if (x != std::max(theirs.left, cells.left) || y != std::max(theirs.bottom, cells.bottom)) continue;
        if (visit(index)) return true;
      }
  return false;
}

BodyIndex Scene::put(const Body& body) {
  BodyIndex index = static_cast<BodyIndex>(bodies_.size());
  if (free_.empty()) {
    bodies_.push_back(body);
    is_in_.push_back(1);
  } else {
    index = free_.back();
    free_.pop_back();
    bodies_[index] = body;
    is_in_[index] = 1;
  }
  widest_gap_ = std::max(widest_gap_, body.gap);
  if (body.container) {
    containers_.insert(std::lower_bound(containers_.begin(), containers_.end(), index), index);
    return index;
  }
  const Cells cells = cells_of(placed_box(body));
  for (std::int64_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int64_t x = cells.left; x <= cells.right; ++x)
      cells_[static_cast<std::size_t>(y * columns_ + x)].push_back(index);
  return index;
}

void Scene::take(BodyIndex index) {
  LEKALO_ASSERT(index < bodies_.size() && is_in_[index] != 0);
  const Body& body = bodies_[index];
  is_in_[index] = 0;
  free_.push_back(index);
  if (body.container) {
    containers_.erase(std::find(containers_.begin(), containers_.end(), index));
    return;
  }
  const Cells cells = cells_of(placed_box(body));
  for (std::int64_t y = cells.bottom; y <= cells.top; ++y)
    for (std::int64_t x = cells.left; x <= cells.right; ++x) {
      auto& list = cells_[static_cast<std::size_t>(y * columns_ + x)];
      *std::find(list.begin(), list.end(), index) = list.back();
      list.pop_back();
    }
}

bool Scene::forbids(const Body& body, const Probe& probe) const {
  if ((body.layers & probe.layers) == 0 || body.rank <= probe.tolerates) return false;
  const GridPoint shift = probe.at - body.at;
  const geom::GridRegion& theirs = outline(body.shape);
  const geom::GridRegion& ours = outline(probe.shape);
  if (body.container ? !lies_within(theirs, ours, shift) : interiors_meet(theirs, ours, shift)) return true;
  return edges_nearer_than(theirs, ours, std::max(body.gap, probe.gap), shift);
}

bool Scene::forbidden(const Probe& probe) const {
  for (const BodyIndex index : containers_)
    if (index != probe.except && forbids(bodies_[index], probe)) return true;
  const GridBox& box = shapes_[probe.shape].box;
  const GridBox reach = grown({box.low + probe.at, box.high + probe.at}, std::max(widest_gap_, probe.gap));
  return visit_near(reach,
                    [&](BodyIndex index) { return index != probe.except && forbids(bodies_[index], probe); });
}

std::vector<BodyIndex> Scene::forbidding(const Probe& probe) const {
  std::vector<BodyIndex> found;
  for (const BodyIndex index : containers_)
    if (index != probe.except && forbids(bodies_[index], probe)) found.push_back(index);
  const GridBox& box = shapes_[probe.shape].box;
  const GridBox reach = grown({box.low + probe.at, box.high + probe.at}, std::max(widest_gap_, probe.gap));
  visit_near(reach, [&](BodyIndex index) {
    if (index != probe.except && forbids(bodies_[index], probe)) found.push_back(index);
    return false;
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<BodyIndex> Scene::near(const GridBox& box, std::int64_t reach, std::uint32_t layers) const {
  std::vector<BodyIndex> found;
  for (const BodyIndex index : containers_)
    if ((bodies_[index].layers & layers) != 0) found.push_back(index);
  visit_near(grown(box, reach), [&](BodyIndex index) {
    if ((bodies_[index].layers & layers) != 0) found.push_back(index);
    return false;
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<BodyIndex> Scene::at(GridPoint p, std::uint32_t layers) const {
  std::vector<BodyIndex> found;
  visit_near({p, p}, [&](BodyIndex index) {
    const Body& body = bodies_[index];
    if ((body.layers & layers) != 0 &&
        locate_point(outline(body.shape), p - body.at) != geom::PointLocation::outside)
      found.push_back(index);
    return false;
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace lekalo::phi
