#include "lekalo/solid/mesh_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"
#include "triangle_pair.hpp"

namespace lekalo::solid {

namespace {

/// Moving a point, differences and products with a unit vector are some forty roundings of 2^-53 of the
/// coordinates; making boxes and their axes, moving them and all their shadows less than two hundred.
constexpr double kPairRounding = 0x1p-45;

}  // namespace

std::vector<Vector> surface_points(const Mesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
  std::vector<Vector> points;
  std::vector<bool> used(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t of = sets.of(t[0]);
    if (!used[of]) points.push_back(mesh.vertices[of]);
    used[of] = true;
  }
  return points;
}

MeshClearance::Blank::Blank(const Mesh& blank, const std::vector<double>& widths, unsigned threads)
    : tree(blank, 1, threads), boxes(tree), points(surface_points(blank)) {
  if (widths.empty()) return;
  for (std::uint32_t k = 0; k < widths.size(); ++k) width.push_back(widths[tree.triangle(k)]);
  const auto& nodes = tree.nodes();
  widest.resize(nodes.size());
  for (std::size_t at = nodes.size(); at-- > 0;)
    widest[at] =
        nodes[at].right == 0 ? width[nodes[at].begin] : std::max(widest[at + 1], widest[nodes[at].right]);
}

MeshClearance::MeshClearance(const Mesh& part, TriangleTree tree, std::shared_ptr<const Blank> blank)
    : part_(std::move(tree)),
      part_boxes_(part_),
      pieces_(part_.patches(kPieces)),
      of_part_(surface_points(part)),
      blank_(std::move(blank)) {}

MeshClearance::MeshClearance(const Mesh& part, const Mesh& blank, const std::vector<double>& widths,
                             unsigned threads)
    : MeshClearance(part, TriangleTree(part, 1, threads),
                    std::make_shared<const Blank>(blank, widths, threads)) {}

MeshClearance::MeshClearance(const Mesh& part, const MeshClearance& other)
    : MeshClearance(part, TriangleTree(part, 1), other.blank_) {}

/// Walks both trees at one pose.
struct MeshClearance::Walk {
  Walk(const MeshClearance& from, const Motion& pose) : meter(from), blank(*from.blank_), motion(pose) {
    const double far = std::sqrt(3.0) * meter.part_.largest() + largest_coordinate(motion.shift);
    rounding = kPairRounding * (far + blank.tree.largest());
  }

  void start(double most) {
    // Pairs that are passed over are `most` apart whatever rounding hides.
    limit = most + 2 * rounding;
    best.low = best.high = std::numeric_limits<double>::infinity();
    found = cross = false;
  }

  void look(std::uint32_t of_part, std::uint32_t of_blank) {
    const Corners& t = meter.part_.corners(of_part);
    const Corners a{motion(t[0]), motion(t[1]), motion(t[2])}, &b = blank.tree.corners(of_blank);
    const double width = blank.width.empty() ? 0 : blank.width[of_blank];
    const double most = limit + width - rounding;
    if (clearly_apart(a, b, most)) return;
    const PairFound here = nearest_points(a, b, most, rounding);
    if (here.low >= most) return;
    const double distance = std::sqrt(here.squared);
    best.low = std::min(best.low, std::min(here.low, distance) - width);
    if (!(distance - width < limit)) return;
    limit = best.high = distance - width;
    cross = distance <= rounding;
    best.part_triangle = meter.part_.triangle(of_part);
    best.blank_triangle = blank.tree.triangle(of_blank);
    best.part = here.a, best.blank = here.b;
    found = true;
  }

  /// Says if two boxes are so far apart that no pair in them is nearer than what is known, but for rounding.
  [[nodiscard]] bool apart(double gap, std::uint32_t of_blank) const {
    const double most = limit - rounding + (blank.widest.empty() ? 0 : blank.widest[of_blank]);
    return !(most > 0) || gap >= most * most;
  }

  [[nodiscard]] double widest() const { return blank.widest.empty() ? 0 : blank.widest[0]; }

  void walk(std::uint32_t of_part, std::uint32_t of_blank) {
    struct Open {
      double gap;
      std::uint32_t part, at_blank;
    };
    // Each step leaves one pair behind and takes one, so there are as many as both trees are high.
    std::array<Open, 128> stack;
    std::size_t count = 0;
    const auto& of_parts = meter.part_.nodes();
    const auto& of_blanks = blank.tree.nodes();
    const auto part_box = [&](std::uint32_t at) -> const OrientedBox& {
      return meter.part_boxes_.of(meter.part_, at);
    };
    const auto blank_box = [&](std::uint32_t at) -> const OrientedBox& {
      return blank.boxes.of(blank.tree, at);
    };
    const auto push = [&](const Open& open) {
      if (!apart(open.gap, open.at_blank)) stack[count++] = open;
    };
    push({squared_gap(moved(motion, part_box(of_part)), blank_box(of_blank)), of_part, of_blank});
    while (count > 0) {
      if (cross || limit + widest() <= rounding) {
        // They cross, and no other pair is needed to know that.
        best.low = std::min(best.low, -widest());
        return;
      }
      const Open open = stack[--count];
      const std::uint32_t part = open.part, at_blank = open.at_blank;
      if (apart(open.gap, at_blank)) continue;
      if (steps-- == 0) return;
      ask();
      const TriangleTree::Node &p = of_parts[part], &b = of_blanks[at_blank];
      if (p.right == 0 && b.right == 0) {
        look(p.begin, b.begin);
        continue;
      }
      Open one, other;
      const OrientedBox &of_p = part_box(part), &of_b = blank_box(at_blank);
      if (b.right == 0 || (p.right != 0 && of_p.size() > of_b.size())) {
        const auto child = [&](std::uint32_t at) {
          return Open{squared_gap(moved(motion, part_box(at)), of_b), at, at_blank};
        };
        one = child(part + 1), other = child(p.right);
      } else {
        const OrientedBox box = moved(motion, of_p);
        const auto child = [&](std::uint32_t at) { return Open{squared_gap(box, blank_box(at)), part, at}; };
        one = child(at_blank + 1), other = child(b.right);
      }
      if (other.gap < one.gap) std::swap(one, other);
      push(other);
      push(one);
    }
  }

  [[nodiscard]] NearPair pair() const {
    NearPair pair = best;
    // The pairs that were passed over are farther apart than the nearest, but for the rounding of the boxes.
    pair.low = std::min(best.low, best.high - rounding) - rounding;
    pair.high = best.high + rounding;
    return pair;
  }

  const MeshClearance& meter;
  const Blank& blank;
  const Motion& motion;
  double rounding, limit = 0;
  std::size_t steps = std::numeric_limits<std::size_t>::max();
  NearPair best;
  bool found = false, cross = false;
};

std::optional<NearPair> MeshClearance::near_below(const Motion& blank_from_part, std::uint32_t part_node,
                                                  std::uint32_t blank_node, double most,
                                                  std::size_t steps) const {
  Walk walk(*this, blank_from_part);
  walk.steps = steps;
  walk.start(most);
  walk.walk(part_node, blank_node);
  if (!walk.found) return std::nullopt;
  return walk.pair();
}

std::optional<NearPair> MeshClearance::nearest(const Motion& blank_from_part, double most,
                                               const NearPair* near) const {
  Walk walk(*this, blank_from_part);
  walk.start(most);
  if (near != nullptr)
    walk.look(part_.place_in_order(near->part_triangle), blank_->tree.place_in_order(near->blank_triangle));
  if (!part_.nodes().empty() && !blank_->tree.nodes().empty()) walk.walk(0, 0);
  if (!walk.found) return std::nullopt;
  return walk.pair();
}

NearPair MeshClearance::pair(const Motion& blank_from_part, std::uint32_t part_triangle,
                             std::uint32_t blank_triangle) const {
  Walk walk(*this, blank_from_part);
  walk.start(std::numeric_limits<double>::infinity());
  walk.look(part_.place_in_order(part_triangle), blank_->tree.place_in_order(blank_triangle));
  return walk.pair();
}

void MeshClearance::nearest_by_piece(const Motion& blank_from_part, double most, std::size_t count,
                                     std::vector<NearPair>& found, unsigned threads) const {
  found.clear();
  const auto nearer = [](const NearPair& a, const NearPair& b) { return a.high < b.high; };
  if (count >= pieces_.size()) {
    std::vector<std::optional<NearPair>> of_piece(pieces_.size());
    share_out(pieces_.size(), threads, [&](std::size_t k) {
      Walk walk(*this, blank_from_part);
      walk.start(most);
      walk.walk(pieces_[k], 0);
      if (walk.found) of_piece[k] = walk.pair();
    });
    for (const std::optional<NearPair>& pair : of_piece)
      if (pair) found.push_back(*pair);
    std::stable_sort(found.begin(), found.end(), nearer);
    return;
  }
  Walk walk(*this, blank_from_part);
  for (const std::uint32_t piece : pieces_) {
    walk.start(found.size() < count ? most : std::min(most, found.front().high));
    walk.walk(piece, 0);
    if (!walk.found) continue;
    // The heap has the farthest of them in front.
    if (found.size() == count) {
      std::pop_heap(found.begin(), found.end(), nearer);
      found.pop_back();
    }
    found.push_back(walk.pair());
    std::push_heap(found.begin(), found.end(), nearer);
  }
  std::sort_heap(found.begin(), found.end(), nearer);
}

void MeshClearance::near_by_piece(const Motion& blank_from_part, double most, std::size_t steps,
                                  std::vector<NearPair>& found) const {
  found.clear();
  for (const std::uint32_t piece : pieces_)
    if (const auto pair = near_below(blank_from_part, piece, 0, most, steps)) found.push_back(*pair);
}

bool MeshClearance::part_in_blank(const Motion& blank_from_part) const {
  return std::all_of(of_part_.begin(), of_part_.end(),
                     [&](Vector p) { return blank_->tree.holds(blank_from_part(p)); });
}

bool MeshClearance::inside(const Motion& blank_from_part) const {
  return part_in_blank(blank_from_part) &&
         std::none_of(blank_->points.begin(), blank_->points.end(),
                      [&](Vector q) { return part_.holds(blank_from_part.back(q)); });
}

}  // namespace lekalo::solid
