#include "grid_outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "verify/number/exact.hpp"
#include "verify/shape/side_tree.hpp"

namespace lekalo::verify {
namespace {

GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y}; }
Wide cross(GridPoint a, GridPoint b) { return Wide{a.x} * b.y - Wide{a.y} * b.x; }
Wide dot(GridPoint a, GridPoint b) { return Wide{a.x} * b.x + Wide{a.y} * b.y; }
int sign(Wide value) { return (value > 0) - (value < 0); }
int turn(GridPoint a, GridPoint b, GridPoint c) { return sign(cross(b - a, c - a)); }

Integer integer(Wide value) {
  constexpr Wide kHalf = Wide{1} << 62;
  const Wide high = value / kHalf, low = value % kHalf;
  Integer result(static_cast<long>(high / kHalf));
  result <<= 62;
  result += static_cast<long>(high % kHalf);
  result <<= 62;
  return result + static_cast<long>(low);
}

GridBox box_of(const GridEdge& e) {
  return {std::min(e.from.x, e.to.x), std::min(e.from.y, e.to.y), std::max(e.from.x, e.to.x),
          std::max(e.from.y, e.to.y)};
}

GridBox box_of(const std::vector<GridEdge>& edges) {
  GridBox all = box_of(edges.front());
  for (const GridEdge& edge : edges)
    all = {std::min(all.low_x, edge.from.x), std::min(all.low_y, edge.from.y),
           std::max(all.high_x, edge.from.x), std::max(all.high_y, edge.from.y)};
  return all;
}

/// The box, larger by `by` on every side, in numbers that doubles hold exactly.
Box wide(const GridBox& box, std::int64_t by = 0) {
  return {static_cast<double>(box.low_x - by), static_cast<double>(box.low_y - by),
          static_cast<double>(box.high_x + by), static_cast<double>(box.high_y + by)};
}

bool come_within(const GridBox& a, const GridBox& b, std::int64_t gap = 0) {
  return meet(wide(a, gap), wide(b));
}

bool cross_properly(const GridEdge& a, const GridEdge& b) {
  return turn(a.from, a.to, b.from) * turn(a.from, a.to, b.to) < 0 &&
         turn(b.from, b.to, a.from) * turn(b.from, b.to, a.to) < 0;
}

/// Step 2 of docs/design/layout-verify.md: a vertex or a crossing, at (x / w, y / w). Crossings stay below
/// 2^125, because with coordinates within 2^40 w is below 2^83 and a difference of coordinates below 2^41.
struct Event {
  Wide x, y, w;  ///< w > 0
};

Event crossing(const GridEdge& a, const GridEdge& b) {
  const GridPoint along = a.to - a.from, other = b.to - b.from;
  const int up = sign(cross(along, other));
  const Wide w = up * cross(along, other), share = up * cross(b.from - a.from, other);
  return {a.from.x * w + along.x * share, a.from.y * w + along.y * share, w};
}

/// Returns the side of the edge's line on which the event lies: +1 for left, 0 on the line, -1 for right.
int side(const GridEdge& edge, const Event& v) {
  const GridPoint along = edge.to - edge.from;
  const Wide x = v.x - edge.from.x * v.w, y = v.y - edge.from.y * v.w;
  if (v.w == 1) return sign(along.x * y - along.y * x);
  return sgn(Integer(integer(along.x) * integer(y) - integer(along.y) * integer(x)));
}

bool in_box(const Event& v, const GridBox& box) {
  return box.low_x * v.w <= v.x && v.x <= box.high_x * v.w && box.low_y * v.w <= v.y &&
         v.y <= box.high_y * v.w;
}

/// A direction from an event along an edge of outline `of`. `material` says whether material lies on its
/// counter-clockwise side.
struct Ray {
  GridPoint direction;
  std::size_t of;
  bool material;
};

bool lower_half(GridPoint d) { return std::pair{d.y, d.x} < std::pair<std::int64_t, std::int64_t>{}; }
/// Orders directions counter-clockwise from the positive x axis.
bool before(const Ray& a, const Ray& b) {
  if (lower_half(a.direction) != lower_half(b.direction)) return lower_half(b.direction);
  return cross(a.direction, b.direction) > 0;
}

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Edges and a tree over their boxes. The tree is made when it is first asked, as that of a part which lies
/// well inside its sheet never is.
struct IndexedEdges {
  std::vector<GridEdge> edges;

  explicit IndexedEdges(std::vector<GridEdge> all) : edges(std::move(all)) {}

  static std::vector<Box> boxes_of(const std::vector<GridEdge>& edges) {
    std::vector<Box> boxes;
    for (const GridEdge& edge : edges) boxes.push_back(wide(box_of(edge)));
    return boxes;
  }

  /// Calls visit(k) for the edges whose boxes come within `gap` of a box.
  template <class Visit>
  void visit_near(const GridBox& box, std::int64_t gap, const Visit& visit) const {
    const Box room = wide(box, gap);
    tree().visit([&](const Box& other) { return meet(room, other); }, visit);
  }
  /// Calls visit(k) for the edges that a ray from the event to the right may meet.
  template <class Visit>
  void visit_right_of(const Event& v, const Visit& visit) const {
    // The event's coordinates are rounded by less than the step that the box is larger.
    const double x = static_cast<double>(v.x) / static_cast<double>(v.w);
    const double y = static_cast<double>(v.y) / static_cast<double>(v.w);
    const Box ray{x - 1, y - 1, kEndless, y + 1};
    tree().visit([&](const Box& box) { return meet(ray, box); }, visit);
  }

 private:
  [[nodiscard]] const SideTree& tree() const {
    if (!tree_) tree_.emplace(boxes_of(edges));
    return *tree_;
  }
  mutable std::optional<SideTree> tree_;
};

/// Returns the edge in the plane with x and y exchanged, material on the left again.
GridEdge exchanged(const GridEdge& e) { return {{e.to.y, e.to.x}, {e.from.y, e.from.x}}; }
GridBox exchanged(const GridBox& b) { return {b.low_y, b.low_x, b.high_y, b.high_x}; }

/// Says whether a line up meets fewer of the edges than a line to the right, as a rule.
bool are_met_less_upwards(const std::vector<GridEdge>& edges) {
  double across = 0, up = 0;
  for (const GridEdge& edge : edges) {
    const GridBox box = box_of(edge);
    across += static_cast<double>(box.high_x - box.low_x), up += static_cast<double>(box.high_y - box.low_y);
  }
  const GridBox all = box_of(edges);
  return across * static_cast<double>(all.high_y - all.low_y) <
         up * static_cast<double>(all.high_x - all.low_x);
}

/// Collects the rays of an outline at an event that lies on its edges. For any other event the return value
/// says whether it lies inside the outline.
bool look_around(const IndexedEdges& outline, std::size_t of, const Event& v, std::vector<Ray>& rays) {
  bool inside = false;
  ask();
  outline.visit_right_of(v, [&](std::size_t k) {
    ask();
    const GridEdge& edge = outline.edges[k];
    const bool from_above = edge.from.y * v.w > v.y, to_above = edge.to.y * v.w > v.y;
    const bool may_touch = in_box(v, box_of(edge));
    if (from_above == to_above && !may_touch) return;
    const int at = side(edge, v);
    if (at == 0) {
      const GridPoint along = edge.to - edge.from;
      if (v.x != edge.to.x * v.w || v.y != edge.to.y * v.w) rays.push_back({along, of, true});
      if (v.x != edge.from.x * v.w || v.y != edge.from.y * v.w)
        rays.push_back({{-along.x, -along.y}, of, false});
    }
    if (from_above != to_above && at == (to_above ? 1 : -1)) inside = !inside;
  });
  return inside;
}

/// Step 1: one question about several outlines, which must hold a disc or must not, as wanted. Of each
/// outline only the edges that can matter inside the window are kept.
class Question {
 public:
  Question(const std::vector<const GridOutline*>& in, const std::vector<const GridOutline*>& out)
      : window_(in[0]->box) {
    for (const GridOutline* outline : in) {
      if (!come_within(window_, outline->box)) return;
      window_.low_x = std::max(window_.low_x, outline->box.low_x);
      window_.low_y = std::max(window_.low_y, outline->box.low_y);
      window_.high_x = std::min(window_.high_x, outline->box.high_x);
      window_.high_y = std::min(window_.high_y, outline->box.high_y);
    }
    wanted_.assign(in.size(), true);
    wanted_.resize(in.size() + out.size(), false);
    // The rays to the right of a comb with level teeth would meet all of them, but those of the comb laid
    // down meet a few.
    bool lay_down = false;
    for (const auto* list : {&in, &out})
      for (const GridOutline* outline : *list)
        if (are_met_less_upwards(outline->edges)) lay_down = true;
    if (lay_down) window_ = exchanged(window_);
    // Edges to the right of the window stay too, because a ray to the right counts them to tell whether an
    // event lies inside.
    Box room = wide(window_);
    room.high_x = kEndless;
    for (const auto* list : {&in, &out}) {
      for (const GridOutline* outline : *list) {
        std::vector<GridEdge> kept;
        for (const GridEdge& as_placed : outline->edges) {
          const GridEdge edge = lay_down ? exchanged(as_placed) : as_placed;
          if (meet(room, wide(box_of(edge)))) kept.push_back(edge);
        }
        edges_.emplace_back(std::move(kept));
      }
    }
    order_.resize(edges_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [this](std::size_t i, std::size_t j) {
      return edges_[i].edges.size() < edges_[j].edges.size();
    });
  }

  [[nodiscard]] bool answer() {
    for (const IndexedEdges& outline : edges_)
      for (const GridEdge& edge : outline.edges)
        if (has_wedge({edge.from.x, edge.from.y, 1})) return true;
    for (auto second = edges_.begin(); second != edges_.end(); ++second)
      for (auto first = edges_.begin(); first != second; ++first)
        if (has_wedge_at_crossing(*first, *second)) return true;
    return false;
  }

 private:
  bool has_wedge_at_crossing(const IndexedEdges& first, const IndexedEdges& second) {
    bool found = false;
    for (const GridEdge& edge : first.edges) {
      ask();
      if (!come_within(box_of(edge), window_)) continue;
      second.visit_near(box_of(edge), 0, [&](std::size_t k) {
        const GridEdge& other = second.edges[k];
        if (!cross_properly(edge, other)) return;
        if (has_wedge(crossing(edge, other))) found = true;
      });
      if (found) return true;
    }
    return false;
  }

  /// Steps 3 and 4: looks for a wedge between two neighbouring directions at the event that is material of
  /// all `ins_` and of no other outline.
  bool has_wedge(const Event& v) {
    if (!in_box(v, window_)) return false;
    rays_.clear();
    material_.assign(edges_.size(), false);
    for (const std::size_t k : order_) {
      const std::size_t rays_before = rays_.size();
      material_[k] = look_around(edges_[k], k, v, rays_);
      const bool elsewhere = rays_.size() == rays_before && material_[k] != wanted_[k];
      if (elsewhere) return false;
    }
    std::sort(rays_.begin(), rays_.end(), before);
    // The wedge before the first ray belongs to the last ray of each outline.
    for (const Ray& ray : rays_) material_[ray.of] = ray.material;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      ask();
      material_[rays_[i].of] = rays_[i].material;
      const bool last_of_direction = i + 1 == rays_.size() || before(rays_[i], rays_[i + 1]);
      if (last_of_direction && material_ == wanted_) return true;
    }
    return false;
  }

  std::vector<bool> wanted_;  ///< of each outline
  GridBox window_;
  std::vector<IndexedEdges> edges_;
  /// The outlines, that of the fewest edges first: it is the cheapest to ask, and often the answer.
  std::vector<std::size_t> order_;
  std::vector<Ray> rays_;
  std::vector<bool> material_;  ///< of each outline, at the event or in a wedge
};

/// Step 5: says whether p lies less than gap from the edge. Every number stays below 2^84 before it is
/// squared.
bool nearer_than(GridPoint p, const GridEdge& edge, std::int64_t gap) {
  const GridPoint along = edge.to - edge.from, out = p - edge.from;
  const Wide at = dot(out, along), length = dot(along, along), most = Wide{gap} * gap;
  if (at <= 0) return dot(out, out) < most;
  if (at >= length) return dot(p - edge.to, p - edge.to) < most;
  const Wide height = cross(along, out);
  const double left = static_cast<double>(height) * static_cast<double>(height),
               right = static_cast<double>(most) * static_cast<double>(length);
  if (left < 0.999 * right) return true;
  if (left > 1.001 * right) return false;
  const Integer exact = integer(height);
  return exact * exact < integer(most) * integer(length);
}

Wide twice_area(const GridLoop& loop) {
  Wide sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  return sum;
}

void append_edges(const GridLoop& loop, std::vector<GridEdge>& edges) {
  for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
}

std::string place(GridPoint p) {
  return fmt::format("({:.6g}, {:.6g}) mm", static_cast<double>(p.x) * 0x1p-20,
                     static_cast<double>(p.y) * 0x1p-20);
}

constexpr std::int64_t kResolution = 3;

/// Says whether p, an end of one edge, comes too near to the other edge. Ends that the two edges share do not
/// count.
bool too_near(GridPoint p, const GridEdge& edge) {
  return p != edge.from && p != edge.to && nearer_than(p, edge, kResolution);
}

std::optional<std::string> fault_between(const GridEdge& a, const GridEdge& b) {
  if (cross_properly(a, b))
    return fmt::format("the edges from {} and {} cross", place(a.from), place(b.from));
  for (const auto& [edge, other] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const GridPoint p : {edge->from, edge->to})
      if (too_near(p, *other))
        return fmt::format("the point {} is less than 3 steps of 2^-20 mm from the edge {} to {}", place(p),
                           place(other->from), place(other->to));
  return std::nullopt;
}

std::optional<std::string> fault_of_edges(const std::vector<GridEdge>& edges) {
  std::vector<std::size_t> order(edges.size()), place(edges.size()), before;
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t i) { return box_of(edges[i]).low_x; };
  std::ranges::stable_sort(order, {}, low);
  for (std::size_t k = 0; const std::size_t i : order) place[i] = k++;
  const IndexedEdges indexed(edges);
  const std::size_t most = limits::most_meeting_boxes(edges.size());
  std::size_t seen = 0;
  // The edges from left to right, each with those before it.
  for (const std::size_t i : order) {
    before.clear();
    indexed.visit_near(box_of(edges[i]), kResolution, [&](std::size_t j) {
      if (place[j] < place[i]) before.push_back(place[j]);
    });
    ask(1 + before.size());
    if ((seen += before.size()) > most)
      return fmt::format("more than {} pairs of its {} edges have boxes that meet, too many to look at", most,
                         edges.size());
    std::sort(before.begin(), before.end());
    for (const std::size_t k : before)
      if (auto fault = fault_between(edges[i], edges[order[k]])) return fault;
  }
  return std::nullopt;
}

/// Finds a point that is written twice: every point begins one edge, so a point that begins two is there
/// twice.
std::optional<std::string> fault_of_points(const std::vector<GridEdge>& edges) {
  std::vector<GridPoint> points;
  for (const GridEdge& edge : edges) points.push_back(edge.from);
  std::ranges::sort(points, {}, [](GridPoint p) { return std::pair{p.x, p.y}; });
  const auto twice = std::adjacent_find(points.begin(), points.end());
  if (twice == points.end()) return std::nullopt;
  return fmt::format("the point {} is there twice", place(*twice));
}

std::string loop_name(std::size_t l) { return l == 0 ? "the outer loop" : fmt::format("hole {}", l - 1); }

/// Finds out which loops are around a point of one of them.
class Loops {
 public:
  explicit Loops(const std::vector<GridLoop>& loops)
      : loops_(loops), lay_down_(false), edges_(std::vector<GridEdge>()) {
    std::vector<GridEdge> edges;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      append_edges(loops[l], edges);
      loop_of_.resize(edges.size(), l);
    }
    lay_down_ = are_met_less_upwards(edges);
    if (lay_down_)
      for (GridEdge& edge : edges) edge = exchanged(edge);
    edges_ = IndexedEdges(std::move(edges));
  }

  /// Returns the other loops around the first point of a loop, ascending. \pre no two loops meet
  [[nodiscard]] std::vector<std::size_t> around(std::size_t loop) const {
    GridPoint p = loops_[loop][0];
    if (lay_down_) std::swap(p.x, p.y);
    std::vector<std::size_t> crossed;
    edges_.visit_right_of({p.x, p.y, 1}, [&](std::size_t k) {
      const GridEdge& edge = edges_.edges[k];
      const bool rises = edge.to.y > p.y;
      if (loop_of_[k] != loop && (edge.from.y > p.y) != rises &&
          turn(edge.from, edge.to, p) == (rises ? 1 : -1))
        crossed.push_back(loop_of_[k]);
    });
    std::sort(crossed.begin(), crossed.end());
    std::vector<std::size_t> found;
    for (std::size_t begin = 0, end = 0; begin < crossed.size(); begin = end) {
      while (end < crossed.size() && crossed[end] == crossed[begin]) ++end;
      if ((end - begin) % 2 != 0) found.push_back(crossed[begin]);
    }
    return found;
  }

 private:
  const std::vector<GridLoop>& loops_;
  bool lay_down_;
  IndexedEdges edges_;
  std::vector<std::size_t> loop_of_;
};

}  // namespace

GridOutline make_outline(std::vector<GridLoop> loops) {
  GridOutline outline;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (sign(twice_area(loops[l])) != (l == 0 ? 1 : -1)) std::reverse(loops[l].begin(), loops[l].end());
    append_edges(loops[l], outline.edges);
  }
  outline.box = box_of(outline.edges);
  return outline;
}

std::optional<std::string> fault_of(const std::vector<GridLoop>& loops) {
  std::vector<GridEdge> edges;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (loops[l].size() < 3) return fmt::format("{} has fewer than three points", loop_name(l));
    append_edges(loops[l], edges);
  }
  if (auto fault = fault_of_points(edges)) return fault;
  if (auto fault = fault_of_edges(edges)) return fault;
  const Loops all(loops);
  for (std::size_t h = 1; h < loops.size(); ++h) {
    const std::vector<std::size_t> around = all.around(h);
    if (around.empty() || around.front() != 0)
      return fmt::format("{} is not inside the outer loop", loop_name(h));
    if (around.size() > 1) return fmt::format("{} is inside {}", loop_name(h), loop_name(around[1]));
  }
  return std::nullopt;
}

bool have_common_disc(const std::vector<const GridOutline*>& in, const std::vector<const GridOutline*>& out) {
  return Question(in, out).answer();
}

bool edges_nearer_than(const GridOutline& a, const GridOutline& b, std::int64_t gap) {
  if (gap <= 0 || !come_within(a.box, b.box, gap)) return false;
  std::vector<GridEdge> near;
  for (const GridEdge& edge : b.edges)
    if (come_within(box_of(edge), a.box, gap)) near.push_back(edge);
  const IndexedEdges others(std::move(near));
  bool found = false;
  for (const GridEdge& edge : a.edges) {
    // Each end of an edge is the beginning of another, which is looked at too.
    others.visit_near(box_of(edge), gap, [&](std::size_t k) {
      const GridEdge& other = others.edges[k];
      found = found || nearer_than(edge.from, other, gap) || nearer_than(other.from, edge, gap) ||
              cross_properly(edge, other);
    });
    if (found) return true;
  }
  return false;
}

}  // namespace lekalo::verify
