// What the checker leaves out of its looks changes no answer: places in outlines, the nearest stroke and the
// value of a tree are those that a look at everything finds.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/cases.hpp"
#include "support/verify_cases.hpp"
#include "verify/origin/tree_value.hpp"
#include "verify/pocket/stroke_index.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify_pruned_test {
namespace {

using namespace verify;
using lekalo::cases::case_count;
using lekalo::verify_cases::Random;

// ---- places in outlines -----------------------------------------------------------------------------------

struct Corner {
  std::int64_t x = 0, y = 0;
};
using Ring = std::vector<Corner>;

std::string written(const Ring& ring) {
  std::string edges;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Corner &a = ring[k], &b = ring[(k + 1) % ring.size()];
    edges += fmt::format(R"({}{{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", k == 0 ? "" : ", ", a.x,
                         a.y, b.x, b.y);
  }
  return "[" + edges + "]";
}
Shape shape_of(const std::vector<Ring>& rings) {
  std::string holes;
  for (std::size_t k = 1; k < rings.size(); ++k) holes += (k == 1 ? "" : ", ") + written(rings[k]);
  const std::string text = R"({"outer": )" + written(rings[0]) + R"(, "holes": [)" + holes + "]}";
  std::string complaint;
  Shape shape = read_shape(*parse_json(text, "r.json"), "r.json", complaint);
  EXPECT_EQ(complaint, "");
  return shape;
}

/// Says whether a place, in halves of the unit, lies in a ring, by integers; nothing where it lies on it.
std::optional<bool> lies_in(const Ring& ring, Corner p) {
  bool in = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Corner a{2 * ring[k].x, 2 * ring[k].y},
        b{2 * ring[(k + 1) % ring.size()].x, 2 * ring[(k + 1) % ring.size()].y};
    const std::int64_t turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (turn == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
        p.y <= std::max(a.y, b.y))
      return std::nullopt;
    if ((a.y <= p.y) != (b.y <= p.y) && (turn > 0) == (b.y > a.y)) in = !in;
  }
  return in;
}

/// A comb, standing or lying, with a hole in each tooth; or a square spiral with one hole in its passage.
std::vector<Ring> drawn(Random& random) {
  const auto n = static_cast<std::int64_t>(2 + random.below(12));
  std::vector<Ring> rings(1);
  const auto hole = [&](std::int64_t x, std::int64_t y) {
    rings.push_back({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
  };
  if (random.below(3) == 0) {
    // The passage is three units wide, on the left of the way, and every other arm is longer by ten.
    const std::array<Corner, 4> ways{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    Corner at{0, 0};
    Ring back;
    for (std::int64_t k = 0; k < 2 * n; ++k) {
      const Corner way = ways[static_cast<std::size_t>(k % 4)],
                   last = ways[static_cast<std::size_t>((k + 3) % 4)];
      const bool first = k == 0, end = k + 1 == 2 * n;
      const Corner left{(end ? 0 : -way.y) + (first ? 0 : -last.y), (end ? 0 : way.x) + (first ? 0 : last.x)};
      rings[0].push_back(at);
      back.push_back({at.x + 3 * left.x, at.y + 3 * left.y});
      at = {at.x + 10 * (k / 2 + 1) * way.x, at.y + 10 * (k / 2 + 1) * way.y};
    }
    rings[0].insert(rings[0].end(), back.rbegin(), back.rend());
    hole(4, 1);
    return rings;
  }
  const bool lying = random.below(2) == 0;
  for (std::int64_t k = 0; k < n; ++k)
    for (const Corner c : {Corner{6 * k, 2}, {6 * k, 40}, {6 * k + 4, 40}, {6 * k + 4, 2}})
      rings[0].push_back(c);
  rings[0].push_back({6 * n - 2, 0});
  rings[0].push_back({0, 0});
  for (std::int64_t k = 0; k < n; ++k) hole(6 * k + 1, 10 + static_cast<std::int64_t>(random.below(20)));
  if (lying)
    for (Ring& ring : rings)
      for (Corner& c : ring) std::swap(c.x, c.y);
  return rings;
}

TEST(VerifyPruned, PlacesAreInsideAsIntegersSay) {
  Random random(lekalo::cases::seed());
  const std::size_t count = case_count(300);
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<Ring> rings = drawn(random);
    const Shape shape = shape_of(rings);
    ASSERT_EQ(fault_of(shape), std::nullopt) << i;
    for (int k = 0; k < 100; ++k) {
      const auto reach = static_cast<std::uint64_t>(2 * (shape.high_x - shape.low_x) + 20),
                 rise = static_cast<std::uint64_t>(2 * (shape.high_y - shape.low_y) + 20);
      const Corner p{
          2 * static_cast<std::int64_t>(shape.low_x) - 10 + static_cast<std::int64_t>(random.below(reach)),
          2 * static_cast<std::int64_t>(shape.low_y) - 10 + static_cast<std::int64_t>(random.below(rise))};
      std::optional<bool> expected = lies_in(rings[0], p);
      for (std::size_t r = 1; r < rings.size() && expected; ++r) {
        const auto in = lies_in(rings[r], p);
        expected = in ? std::optional(*expected && !*in) : std::nullopt;
      }
      const Vec at{just(0.5 * static_cast<double>(p.x)), just(0.5 * static_cast<double>(p.y))};
      const auto found = holds(shape, at);
      // A place on an outline is open. Any other is told by one ray or another.
      ASSERT_EQ(found, expected) << "seed " << lekalo::cases::seed() << ", case " << i << ", place " << p.x
                                 << "/2, " << p.y << "/2";
    }
  }
}

// ---- the nearest stroke -----------------------------------------------------------------------------------

Place drawn_place(Random& random, double size) {
  return {size * (random.uniform(0, 1) - 0.5), size * (random.uniform(0, 1) - 0.5)};
}

TEST(VerifyPruned, TheNearestStrokeIsTheNearestOfAll) {
  Random random(lekalo::cases::seed());
  const std::size_t count = case_count(60);
  for (std::size_t i = 0; i < count; ++i) {
    const double size = random.below(2) == 0 ? 100 : 1e5;
    StrokeIndex index({-0.5 * size, -0.5 * size}, {0.5 * size, 0.5 * size},
                      size * (0.01 + random.uniform(0, 1)) / 10);
    std::vector<Stroke> strokes;
    std::vector<double> wider;
    std::vector<std::uint32_t> numbers;
    for (int k = 0; k < 60; ++k) {
      // Some are long, some arcs, some outside of the area.
      const Place from = drawn_place(random, random.below(5) == 0 ? 3 * size : size);
      const double longest = random.below(4) == 0 ? 2 * size : 0.02 * size;
      const Place to = from + drawn_place(random, longest);
      if (random.below(3) == 0)
        add_arc(from, to, 0.5 * (from + to), random.below(2) == 0, 1e30, strokes);
      else
        strokes.push_back({false, true, from, to, {}, 0});
      while (wider.size() < strokes.size()) {
        index.add(static_cast<std::uint32_t>(wider.size()), strokes[wider.size()]);
        wider.push_back(0.01 * size * random.uniform(0, 1));
      }
      const Place p = drawn_place(random, random.below(3) == 0 ? 1e4 * size : 1.5 * size);
      double least = std::numeric_limits<double>::infinity(), least_wider = least;
      for (std::size_t s = 0; s < strokes.size(); ++s) {
        const double d = distance(p, strokes[s]);
        least = std::min(least, d), least_wider = std::min(least_wider, d - wider[s]);
      }
      ASSERT_EQ(index.nearest(p, strokes), least) << i << ' ' << k;
      ASSERT_EQ(index.nearest(p, strokes, wider, 0.01 * size), least_wider) << i << ' ' << k;
      const double reach = size * random.uniform(0, 1);
      index.near(p, reach, numbers);
      ASSERT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
      ASSERT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
      for (std::uint32_t s = 0; s < strokes.size(); ++s) {
        const bool found = std::binary_search(numbers.begin(), numbers.end(), s);
        ASSERT_TRUE(found || distance(p, strokes[s]) > reach) << i << ' ' << k;
      }
    }
  }
}

// ---- the value of a tree ----------------------------------------------------------------------------------

std::size_t grow(Tree& tree, Random& random, int depth) {
  const std::uint64_t kind = depth == 0 ? 0 : random.below(4);
  if (kind == 0) {
    tree.primitives.emplace_back().half_plane = random.below(4) == 0;
    tree.nodes.push_back({Tree::Kind::primitive, tree.primitives.size() - 1, {}});
    return tree.nodes.size() - 1;
  }
  Tree::Node node;
  node.kind = kind == 1 ? Tree::Kind::unite : kind == 2 ? Tree::Kind::intersect : Tree::Kind::subtract;
  for (std::uint64_t k = 0, children = 1 + random.below(4); k < children; ++k)
    node.children.push_back(grow(tree, random, depth - 1));
  tree.nodes.push_back(node);
  return tree.nodes.size() - 1;
}

In both(In a, In b) {
  return a == In::no || b == In::no ? In::no : (a == In::yes && b == In::yes ? In::yes : In::open);
}
In inverse(In a) { return a == In::open ? a : (a == In::yes ? In::no : In::yes); }

In value_of(const Tree& tree, std::size_t n, const std::vector<In>& primitives) {
  const Tree::Node& node = tree.nodes[n];
  if (node.kind == Tree::Kind::primitive) return primitives[node.primitive];
  In value = value_of(tree, node.children[0], primitives);
  for (std::size_t k = 1; k < node.children.size(); ++k) {
    const In child = value_of(tree, node.children[k], primitives);
    if (node.kind == Tree::Kind::unite) value = inverse(both(inverse(value), inverse(child)));
    if (node.kind == Tree::Kind::intersect) value = both(value, child);
    if (node.kind == Tree::Kind::subtract) value = both(value, inverse(child));
  }
  return value;
}

TEST(VerifyPruned, TheValueOfATreeIsThatOfItsNodes) {
  Random random(lekalo::cases::seed());
  const std::size_t count = case_count(2'000);
  for (std::size_t i = 0; i < count; ++i) {
    Tree tree;
    grow(tree, random, 4);
    TreeValue value(tree);
    std::vector<In> primitives;
    for (const Primitive& one : tree.primitives) primitives.push_back(one.half_plane ? In::open : In::no);
    ASSERT_EQ(value.value(), value_of(tree, tree.nodes.size() - 1, primitives)) << i;
    std::vector<std::pair<std::size_t, std::vector<In>>> earlier{{value.said(), primitives}};
    for (int k = 0; k < 30; ++k) {
      if (random.below(4) == 0) earlier.emplace_back(value.said(), primitives);
      if (random.below(6) == 0) {
        earlier.resize(1 + random.below(earlier.size()));
        value.take_back(earlier.back().first);
        primitives = earlier.back().second;
        ASSERT_EQ(value.value(), value_of(tree, tree.nodes.size() - 1, primitives)) << i << ' ' << k;
      }
      const std::size_t at = random.below(primitives.size());
      primitives[at] = static_cast<In>(random.below(3));
      value.set(at, primitives[at]);
      ASSERT_EQ(value.value(), value_of(tree, tree.nodes.size() - 1, primitives)) << i << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace lekalo::verify_pruned_test
