#include "contact_map.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::phi {
namespace {

using geom::GridPoint;
using geom::Int128;

/// All roundings of the raster's positions together are below this many steps.
constexpr double kMargin = 4;

/// Returns one bit for every cell of a row that is `touched`: the lower one of the cell's two bits.
std::uint64_t touched_of(std::uint64_t row) noexcept { return (row >> 1) & ~row & 0x5555555555555555u; }

/// Returns how many bits are set.
/// \pre only bits of even number are set
std::size_t count_even_bits(std::uint64_t bits) noexcept {
  bits = (bits & 0x3333333333333333u) + ((bits >> 2) & 0x3333333333333333u);
  bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
  return static_cast<std::size_t>((bits * 0x0101010101010101u) >> 56);
}

/// Gives one state to a cell that is open, and to all open ones that hang together with it by their sides, in
/// a grid of `size` x `size` cells.
template <class Get, class Set>
void flood(int x, int y, int size, unsigned open, Get&& get, Set&& set) {
  std::array<std::uint16_t, 1024> stack;
  std::size_t top = 0;
  const auto visit = [&](int cx, int cy) {
    if (cx < 0 || cy < 0 || cx >= size || cy >= size || get(cx, cy) != open) return;
    set(cx, cy);
    stack[top++] = static_cast<std::uint16_t>(cy * size + cx);
  };
  visit(x, y);
  while (top > 0) {
    const int at = stack[--top], cx = at % size, cy = at / size;
    visit(cx - 1, cy), visit(cx + 1, cy), visit(cx, cy - 1), visit(cx, cy + 1);
  }
}

}  // namespace

bool OutlinePair::forbidden(GridPoint shift) const {
  if (!container) {
    const Overlap overlap = quick_overlap(fixed, moving, shift);
    if (overlap == Overlap::yes) return true;
    if (overlap == Overlap::no) return edges_nearer_than(fixed.region, moving.region, gap, shift);
  }
  if (container ? !lies_within(fixed.region, moving.region, shift)
                : interiors_meet(fixed.region, moving.region, shift))
    return true;
  return edges_nearer_than(fixed.region, moving.region, gap, shift);
}

bool ContactMap::suits(const OutlinePair& pair) noexcept {
  constexpr std::int64_t kLeast = 64 * kAll;
  if (pair.fixed.edges.size() * pair.moving.edges.size() > kMostPairs) return false;
  if (pair.container)
    return pair.fixed.width - pair.moving.width >= kLeast && pair.fixed.height - pair.moving.height >= kLeast;
  return std::min(pair.fixed.width + pair.moving.width, pair.fixed.height + pair.moving.height) >= kLeast;
}

ContactMap::ContactMap(const OutlinePair& pair) : gap_(static_cast<double>(pair.gap)) {
  double width = 0, height = 0;
  if (pair.container) {
    width = static_cast<double>(pair.fixed.width - pair.moving.width);
    height = static_cast<double>(pair.fixed.height - pair.moving.height);
  } else {
    offset_x_ = static_cast<double>(pair.moving.width + pair.gap);
    offset_y_ = static_cast<double>(pair.moving.height + pair.gap);
    width = static_cast<double>(pair.fixed.width + pair.gap) + offset_x_;
    height = static_cast<double>(pair.fixed.height + pair.gap) + offset_y_;
  }
  step_x_ = (width + kMargin) / kAll, step_y_ = (height + kMargin) / kAll;
  per_step_x_ = 1 / step_x_, per_step_y_ = 1 / step_y_;
  add_contacts(pair.moving, false, pair.fixed, pair.container, true);
  add_contacts(pair.fixed, pair.container, pair.moving, false, false);
  rows_.fill(~std::uint64_t{0});
  for (const Contact& contact : contacts_)
    visit_touched(contact, 0, 0, kFine, kCoarse, [&](int x, int y) {
      rows_[static_cast<std::size_t>(y)] &= ~(std::uint64_t{1} << (2 * x));
    });
  std::size_t count = 0;
  for (std::size_t y = 0; y < kCoarse; ++y) {
    before_[y] = static_cast<std::uint16_t>(count);
    count += count_even_bits(touched_of(rows_[y]));
  }
  block_of_.resize(count);
}

void ContactMap::add_contacts(const FlatOutline& vertices, bool reversed_vertices, const FlatOutline& edges,
                              bool reversed_edges, bool vertices_move) {
  const auto& points = vertices.region.points;
  const auto& starts = vertices.region.loop_starts;
  const auto& others = edges.region.points;
  const auto& other_starts = edges.region.loop_starts;
  for (std::size_t l = 0; l + 1 < starts.size(); ++l)
    for (std::size_t i = starts[l], last = starts[l + 1] - 1; i <= last; ++i) {
      GridPoint before = points[i == starts[l] ? last : i - 1], after = points[i == last ? starts[l] : i + 1];
      if (reversed_vertices) std::swap(before, after);
      const GridPoint at = points[i], in = at - before, out = after - at;
      // A corner that is a dent cannot rest on an edge.
      if (cross(in, out) < 0) continue;
      for (std::size_t m = 0; m + 1 < other_starts.size(); ++m)
        for (std::size_t j = other_starts[m], end = other_starts[m + 1] - 1; j <= end; ++j) {
          GridPoint from = others[j], to = others[j == end ? other_starts[m] : j + 1];
          if (reversed_edges) std::swap(from, to);
          const GridPoint along = to - from;
          // The corner would reach into the material beside the edge.
          if (cross(along, out) > 0 || cross(along, in) < 0) continue;
          const GridPoint start = vertices_move ? from - at : at - from;
          const GridPoint way = vertices_move ? along : -along;
          contacts_.push_back({static_cast<double>(start.x) + offset_x_,
                               static_cast<double>(start.y) + offset_y_, static_cast<double>(way.x),
                               static_cast<double>(way.y)});
        }
    }
}

bool ContactMap::touches(const Contact& c, const Window& w) const noexcept {
  const double reach = gap_ + kMargin;
  if (std::min(c.x, c.x + c.dx) > w.x1 + reach || std::max(c.x, c.x + c.dx) < w.x0 - reach ||
      std::min(c.y, c.y + c.dy) > w.y1 + reach || std::max(c.y, c.y + c.dy) < w.y0 - reach)
    return false;
  const double half_x = (w.x1 - w.x0) / 2, half_y = (w.y1 - w.y0) / 2;
  const double mx = w.x0 + half_x - c.x, my = w.y0 + half_y - c.y;
  const double length = std::sqrt(c.dx * c.dx + c.dy * c.dy);
  const double height = std::abs(c.dx * my - c.dy * mx) / length;
  const double spread = (std::abs(c.dx) * half_y + std::abs(c.dy) * half_x) / length;
  if (height - spread > reach) return false;
  if (gap_ <= 0) return true;
  // A window that is nearer to the segment than the gap everywhere is not touched, because this segment
  // changes nothing in it.
  const double along = (c.dx * mx + c.dy * my) / length;
  const double beside = std::max({0.0, -along, along - length});
  return std::sqrt(height * height + beside * beside) + std::sqrt(half_x * half_x + half_y * half_y) >
         gap_ - kMargin;
}

template <class Mark>
void ContactMap::visit_touched(const Contact& c, double corner_x, double corner_y, int per_cell, int count,
                               Mark&& mark) const {
  const double wide = step_x_ * per_cell, high = step_y_ * per_cell, reach = gap_ + kMargin;
  const double low_x = std::min(c.x, c.x + c.dx) - reach, high_x = std::max(c.x, c.x + c.dx) + reach;
  const double low_y = std::min(c.y, c.y + c.dy) - reach, high_y = std::max(c.y, c.y + c.dy) + reach;
  const auto index = [&](double value) {
    return static_cast<int>(std::clamp(std::floor(value), -1.0, static_cast<double>(count)));
  };
  const int bottom = std::max(0, index((low_y - corner_y) / high)),
            top = std::min(count - 1, index((high_y - corner_y) / high));
  for (int y = bottom; y <= top; ++y) {
    const double y0 = corner_y + high * y, y1 = y0 + high;
    double left = low_x, right = high_x;
    if (gap_ <= 0 && c.dy != 0) {
      // The segment passes the row between these two shares of its length.
      const double a = std::clamp((y0 - kMargin - c.y) / c.dy, 0.0, 1.0),
                   b = std::clamp((y1 + kMargin - c.y) / c.dy, 0.0, 1.0);
      const double xa = c.x + a * c.dx, xb = c.x + b * c.dx;
      left = std::min(xa, xb) - kMargin, right = std::max(xa, xb) + kMargin;
    }
    const int first = std::max(0, index((left - corner_x) / wide)),
              last = std::min(count - 1, index((right - corner_x) / wide));
    for (int x = first; x <= last; ++x) {
      if (gap_ > 0) {
        const double x0 = corner_x + wide * x;
        if (!touches(c, {x0, y0, x0 + wide, y1})) continue;
      }
      mark(x, y);
    }
  }
}

bool ContactMap::in_fine(int qx, int qy, double u, double v, GridPoint shift, const OutlinePair& pair) {
  const int cx = qx / kFine, cy = qy / kFine;
  const std::uint64_t coarse = rows_[static_cast<std::size_t>(cy)];
  if (((coarse >> (2 * cx)) & 3) == open) {
    const bool result = pair.forbidden(shift);
    flood(
        cx, cy, kCoarse, open,
        [&](int x, int y) {
          return static_cast<unsigned>(rows_[static_cast<std::size_t>(y)] >> (2 * x)) & 3;
        },
        [&](int x, int y) {
          rows_[static_cast<std::size_t>(y)] ^= std::uint64_t{result ? 2u : 3u} << (2 * x);
        });
    return result;
  }
  const std::uint64_t below = (std::uint64_t{1} << (2 * cx)) - 1;
  const std::size_t rank =
      before_[static_cast<std::size_t>(cy)] + count_even_bits(touched_of(coarse) & below);
  if (block_of_[rank] == 0) block_of_[rank] = static_cast<std::uint16_t>(make_block(cx, cy) + 1);
  Block& block = blocks_[block_of_[rank] - 1u];
  const int fx = qx % kFine, fy = qy % kFine;
  const auto word_of = [](int y) { return static_cast<std::size_t>(y / 2); };
  const auto bit_of = [](int x, int y) { return 2 * (x + kFine * (y % 2)); };
  const std::uint64_t word = block.rows[word_of(fy)];
  const unsigned state = (word >> bit_of(fx, fy)) & 3;
  if (state < touched) return state == hit;
  if (state == open) {
    const bool result = pair.forbidden(shift);
    flood(
        fx, fy, kFine, open,
        [&](int x, int y) { return static_cast<unsigned>(block.rows[word_of(y)] >> bit_of(x, y)) & 3; },
        [&](int x, int y) { block.rows[word_of(y)] ^= std::uint64_t{result ? 2u : 3u} << bit_of(x, y); });
    return result;
  }
  if (gap_ > 0) return pair.forbidden(shift);
  const std::uint64_t before = (std::uint64_t{1} << bit_of(fx, fy)) - 1;
  std::uint32_t& leaf =
      leaf_of_[block.leaves + block.before[word_of(fy)] + count_even_bits(touched_of(word) & before)];
  if (leaf == 0) {
    leaves_.push_back(make_leaf(qx, qy));
    leaf = static_cast<std::uint32_t>(leaves_.size());
  }
  return in_leaf(leaves_[leaf - 1], u, v, shift, pair);
}

std::uint32_t ContactMap::make_block(int cx, int cy) {
  Block block;
  block.rows.fill(~std::uint64_t{0});
  const double x0 = step_x_ * kFine * cx, y0 = step_y_ * kFine * cy;
  const Window window{x0, y0, x0 + step_x_ * kFine, y0 + step_y_ * kFine};
  for (const Contact& contact : contacts_)
    if (touches(contact, window))
      visit_touched(contact, x0, y0, 1, kFine, [&](int x, int y) {
        block.rows[static_cast<std::size_t>(y / 2)] &= ~(std::uint64_t{1} << (2 * (x + kFine * (y % 2))));
      });
  std::size_t count = 0;
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    block.before[i] = static_cast<std::uint16_t>(count);
    count += count_even_bits(touched_of(block.rows[i]));
  }
  block.leaves = static_cast<std::uint32_t>(leaf_of_.size());
  if (gap_ <= 0) leaf_of_.resize(leaf_of_.size() + count);
  blocks_.push_back(block);
  return static_cast<std::uint32_t>(blocks_.size() - 1);
}

/// Bounds of docs/design/scene.md: collects the lines through contacts that pass a fine cell.
ContactMap::Leaf ContactMap::make_leaf(int qx, int qy) const {
  const Window window{step_x_ * qx, step_y_ * qy, step_x_ * (qx + 1), step_y_ * (qy + 1)};
  Leaf leaf;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    if (!touches(contact, window)) continue;
    // Contacts on one line need that line only once.
    const auto exact = [](double value) { return static_cast<std::int64_t>(value); };
    const GridPoint way{exact(contact.dx), exact(contact.dy)}, at{exact(contact.x), exact(contact.y)};
    bool is_new = true;
    for (std::size_t k = 0; k < leaf.count && is_new; ++k) {
      const Contact& other = contacts_[leaf.lines[k]];
      is_new = cross(way, {exact(other.dx), exact(other.dy)}) != 0 ||
               cross(way, GridPoint{exact(other.x), exact(other.y)} - at) != 0;
    }
    if (!is_new) continue;
    if (leaf.count == kLines || i > 0xFFFF) {
      leaf.count = kLines + 1;
      break;
    }
    leaf.lines[leaf.count++] = static_cast<std::uint16_t>(i);
  }
  return leaf;
}

bool ContactMap::in_leaf(Leaf& leaf, double u, double v, GridPoint shift, const OutlinePair& pair) {
  if (leaf.count > kLines) return pair.forbidden(shift);
  unsigned pattern = 0;
  for (std::size_t k = 0; k < leaf.count; ++k) {
    const Contact& c = contacts_[leaf.lines[k]];
    // Differences are exact; each product rounds once, and so does their difference.
    const double left = c.dx * (v - c.y), right = c.dy * (u - c.x), side = left - right;
    if (std::abs(side) <= 0x1p-51 * (std::abs(left) + std::abs(right))) return pair.forbidden(shift);
    pattern |= (side > 0 ? 1u : 0u) << k;
  }
  const std::uint32_t bit = std::uint32_t{1} << pattern;
  if ((leaf.known & bit) == 0) {
    leaf.known |= bit;
    if (pair.forbidden(shift)) leaf.hit |= bit;
  }
  return (leaf.hit & bit) != 0;
}

std::size_t ContactMap::bytes() const noexcept {
  return sizeof *this + contacts_.capacity() * sizeof(Contact) +
         block_of_.capacity() * sizeof(std::uint16_t) + blocks_.capacity() * sizeof(Block) +
         leaf_of_.capacity() * sizeof(std::uint32_t) + leaves_.capacity() * sizeof(Leaf);
}

}  // namespace lekalo::phi
