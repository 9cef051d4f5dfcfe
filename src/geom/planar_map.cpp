#include "planar_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "around_vertex.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/trig.hpp"
#include "thin_loop.hpp"

namespace lekalo::geom::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

double chord_length(const Arrangement& a, std::uint32_t h) {
  return norm(a.vertices[end_of(a, h)] - a.vertices[start_of(a, h)]);
}
double chord_length(const Arrangement& a, const PlanarMap::Loop& loop) {
  double sum = 0;
  for (const std::uint32_t h : loop.half_edges) sum += chord_length(a, h);
  return sum;
}

double signed_area(const Arrangement& a, const PlanarMap::Loop& loop) {
  const Point origin = a.vertices[start_of(a, loop.half_edges.front())];
  double doubled = 0;
  for (const std::uint32_t h : loop.half_edges) {
    const Point from = a.vertices[start_of(a, h)] - origin, to = a.vertices[end_of(a, h)] - origin;
    doubled += cross(from, to);
    const Stretch& s = a.stretches[a.edges[h / 2].stretch];
    if (!s.curved) continue;
    const double half = 0.5 * norm(to - from), r = a.pieces[s.piece].radius;
    const double sweep = 2 * direction_angle(std::sqrt(std::max(0.0, (r - half) * (r + half))), half);
    const double beside = r * r * (sweep - sincos(sweep).sine);
    doubled += (s.height < 0) == (h % 2 == 0) ? beside : -beside;
  }
  return 0.5 * doubled;
}

/// Returns the pieces of the loop, or of the loop turned round.
std::vector<Piece> chain_of(const Arrangement& a, const PlanarMap::Loop& loop, bool turned) {
  std::vector<Piece> chain;
  for (const std::uint32_t h : loop.half_edges) {
    Piece piece = piece_between(a, a.stretches[a.edges[h / 2].stretch]);
    if ((h % 2 != 0) != turned) {
      std::swap(piece.from, piece.to);
      if (is_arc(piece)) piece.kind = piece.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
    }
    chain.push_back(piece);
  }
  if (turned) std::reverse(chain.begin(), chain.end());
  return chain;
}

}  // namespace

std::optional<PlanarMap> PlanarMap::make(const Arrangement& arrangement) {
  PlanarMap map(arrangement);
  map.sort_around_vertices();
  map.trace_faces();
  map.find_components();
  if (!map.is_planar() || !map.find_windings()) return std::nullopt;
  return map;
}

std::optional<PlanarMap> PlanarMap::make_of_curves(const Arrangement& arrangement) {
  PlanarMap map(arrangement);
  map.sort_around_vertices();
  map.trace_faces();
  map.find_components();
  if (!map.is_planar()) return std::nullopt;
  return map;
}

std::vector<PlanarMap::Loop> PlanarMap::face_loops() const {
  std::vector<char> is_outside(face_starts_.size(), 0);
  for (const Component& component : components_) is_outside[face_[component.outside]] = 1;
  std::vector<Loop> loops;
  std::vector<std::uint32_t> place(a_.vertices.size(), kNone);
  for (std::uint32_t f = 0; f < face_starts_.size(); ++f) {
    if (is_outside[f] != 0) continue;
    const Loop walk = walk_around(f);
    ask(1 + walk.half_edges.size() / 16);
    // A walk that comes back to a vertex has gone around something that touches the face from inside.
    std::vector<std::uint32_t> chain;
    const auto close_loop = [&](std::size_t begin) {
      Loop loop;
      loop.group = f;
      for (std::size_t i = begin; i < chain.size(); ++i) {
        loop.half_edges.push_back(chain[i]);
        place[start_of(a_, chain[i])] = kNone;
      }
      chain.resize(begin);
      if (!loop.half_edges.empty() && signed_area(a_, loop) > 0) loops.push_back(std::move(loop));
    };
    for (const std::uint32_t h : walk.half_edges) {
      const std::uint32_t vertex = start_of(a_, h);
      if (place[vertex] != kNone) close_loop(place[vertex]);
      place[vertex] = static_cast<std::uint32_t>(chain.size());
      chain.push_back(h);
    }
    close_loop(0);
  }
  return loops;
}

std::uint32_t PlanarMap::next(std::uint32_t half_edge) const noexcept {
  // The next edge around the face on the left is the first one clockwise from the way back.
  const std::uint32_t back = half_edge ^ 1, vertex = start_of(a_, back), place = place_[back];
  return around_[place == around_starts_[vertex] ? around_starts_[vertex + 1] - 1 : place - 1];
}

void PlanarMap::sort_around_vertices() {
  const auto count = static_cast<std::uint32_t>(2 * a_.edges.size());
  around_starts_.assign(a_.vertices.size() + 1, 0);
  for (std::uint32_t h = 0; h < count; ++h) ++around_starts_[start_of(a_, h) + 1];
  for (std::size_t v = 0; v < a_.vertices.size(); ++v) around_starts_[v + 1] += around_starts_[v];
  around_.resize(count);
  std::vector<std::uint32_t> filled(around_starts_.begin(), around_starts_.end() - 1);
  for (std::uint32_t h = 0; h < count; ++h) around_[filled[start_of(a_, h)]++] = h;
  for (std::size_t v = 0; v < a_.vertices.size(); ++v)
    sort_counter_clockwise(a_, around_.data() + around_starts_[v], around_.data() + around_starts_[v + 1]);
  place_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) place_[around_[i]] = i;
}

void PlanarMap::trace_faces() {
  face_.assign(around_.size(), kNone);
  for (std::uint32_t h = 0; h < face_.size(); ++h) {
    if (face_[h] != kNone) continue;
    const auto face = static_cast<std::uint32_t>(face_starts_.size());
    face_starts_.push_back(h);
    for (std::uint32_t at = h; face_[at] == kNone; at = next(at)) face_[at] = face;
  }
}

void PlanarMap::find_components() {
  DisjointSets sets(a_.vertices.size());
  for (std::uint32_t e = 0; e < a_.edges.size(); ++e) sets.join(start_of(a_, 2 * e), end_of(a_, 2 * e));
  component_.assign(a_.vertices.size(), kNone);
  const auto lower = [&](std::uint32_t v, std::uint32_t w) {
    const Point p = a_.vertices[v], q = a_.vertices[w];
    return p.y != q.y ? p.y < q.y : p.x < q.x;
  };
  for (std::uint32_t v = 0; v < a_.vertices.size(); ++v) {
    if (around_starts_[v] == around_starts_[v + 1]) continue;
    // The set is named by its smallest vertex, which is the first of it to come here.
    std::uint32_t& component = component_[sets.of(v)];
    if (component == kNone) {
      component = static_cast<std::uint32_t>(components_.size());
      components_.push_back({v, 0, 0, 0, 0});
    }
    component_[v] = component;
    ++components_[component].vertices;
    if (lower(v, components_[component].lowest)) components_[component].lowest = v;
  }
  for (std::uint32_t e = 0; e < a_.edges.size(); ++e) ++components_[component_[start_of(a_, 2 * e)]].edges;
  for (const std::uint32_t h : face_starts_) ++components_[component_[start_of(a_, h)]].faces;
  // No edge runs down from the lowest vertex of a component, so the outside is where the order around it ends
  // and begins. That order says little where the vertex is hardly apart from others, and areas say more.
  for (Component& component : components_)
    component.outside = around_[around_starts_[component.lowest + 1] - 1];
  std::vector<double> least(components_.size(), 0);
  for (std::uint32_t f = 0; f < face_starts_.size(); ++f) {
    const Loop walk = walk_around(f);
    const double area = signed_area(a_, walk);
    const std::uint32_t c = component_[start_of(a_, walk.half_edges.front())];
    if (area < least[c] && area < -a_.snap * chord_length(a_, walk))
      least[c] = area, components_[c].outside = walk.half_edges.front();
  }
  if (components_.size() < 2) return;
  std::vector<std::vector<std::uint32_t>> numbers(components_.size());
  for (std::uint32_t e = 0; e < a_.edges.size(); ++e) numbers[component_[start_of(a_, 2 * e)]].push_back(e);
  std::vector<Box> wholes;
  for (std::vector<std::uint32_t>& of_one : numbers) {
    std::vector<Box> boxes;
    for (const std::uint32_t e : of_one)
      boxes.push_back(box_of(a_.vertices[start_of(a_, 2 * e)], a_.vertices[end_of(a_, 2 * e)]));
    Box& whole = wholes.emplace_back(boxes.front());
    for (const Box& box : boxes) whole = joined(whole, box);
    edges_of_.push_back({std::move(of_one), BoxTree(boxes)});
  }
  wholes_.emplace(std::move(wholes));
}

PlanarMap::Loop PlanarMap::walk_around(std::uint32_t face) const {
  Loop walk;
  std::uint32_t h = face_starts_[face];
  do {
    walk.half_edges.push_back(h);
    h = next(h);
  } while (h != face_starts_[face]);
  return walk;
}

bool PlanarMap::is_planar() const {
  return std::all_of(components_.begin(), components_.end(),
                     [](const Component& c) { return c.vertices + c.faces == c.edges + 2; }) &&
         has_one_outside();
}

/// Step 3 of docs/design/boolean.md, the last contradiction. An order of edges around vertices that is turned
/// inside out is as planar as the right one, but then some face that is no component's outside is run around
/// clockwise.
bool PlanarMap::has_one_outside() const {
  for (std::uint32_t f = 0; f < face_starts_.size(); ++f) {
    const Loop walk = walk_around(f);
    const std::uint32_t c = component_[start_of(a_, walk.half_edges.front())];
    const double noise = kEdgeErrorInSnaps * a_.snap * chord_length(a_, walk);
    const double area = signed_area(a_, walk);
    if (f == face_[components_[c].outside] ? area > noise : area < -noise) return false;
  }
  return true;
}

template <class Visit>
void PlanarMap::cast_ray(std::uint32_t component, Visit&& visit) const {
  if (!wholes_) return;
  const Point p = a_.vertices[components_[component].lowest];
  wholes_->visit_meeting({p, p}, [&](std::uint32_t other) {
    if (other == component) return;
    const Edges& edges = edges_of_[other];
    edges.tree.visit_meeting({p, {std::numeric_limits<double>::infinity(), p.y}}, [&](std::uint32_t i) {
      const std::uint32_t e = edges.numbers[i];
      const Stretch& s = a_.stretches[a_.edges[e].stretch];
      if (crosses_ray(piece_between(a_, s), p)) visit(e, a_.vertices[s.from].y <= p.y);
    });
  });
}

bool PlanarMap::find_windings() {
  constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::min();
  Winding unknown;
  unknown.fill(kUnknown);
  winding_.assign(face_starts_.size(), unknown);
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    Winding outside{};
    cast_ray(c, [&](std::uint32_t e, bool upwards) {
      for (std::size_t k = 0; k < outside.size(); ++k)
        outside[k] += upwards ? a_.edges[e].weight[k] : -a_.edges[e].weight[k];
    });
    winding_[face_[components_[c].outside]] = outside;
    std::vector<std::uint32_t> waiting{components_[c].outside};
    while (!waiting.empty()) {
      ask();
      const std::uint32_t first = waiting.back();
      waiting.pop_back();
      std::uint32_t h = first;
      do {
        Winding& there = winding_[face_[h ^ 1]];
        const auto& weight = a_.edges[h / 2].weight;
        Winding expected = winding_[face_[h]];
        for (std::size_t k = 0; k < expected.size(); ++k) expected[k] -= h % 2 == 0 ? weight[k] : -weight[k];
        if (there == unknown) {
          there = expected;
          waiting.push_back(h ^ 1);
        } else if (there != expected) {
          return false;
        }
        h = next(h);
      } while (h != first);
    }
  }
  return true;
}

std::vector<PlanarMap::Loop> PlanarMap::traced_loops(const std::vector<char>& kept) const {
  const auto bounds_material = [&](std::uint32_t h) {
    return kept[face_[h]] != 0 && kept[face_[h ^ 1]] == 0;
  };
  std::vector<Loop> loops;
  std::vector<char> done(face_.size(), 0);
  std::vector<std::uint32_t> place(a_.vertices.size(), kNone), chain;
  const auto close_loop = [&](std::size_t begin) {
    Loop loop;
    for (std::size_t i = begin; i < chain.size(); ++i) {
      loop.half_edges.push_back(chain[i]);
      place[start_of(a_, chain[i])] = kNone;
    }
    chain.resize(begin);
    loops.push_back(std::move(loop));
  };
  for (std::uint32_t h = 0; h < face_.size(); ++h) {
    if (done[h] != 0 || !bounds_material(h)) continue;
    for (std::uint32_t at = h; done[at] == 0;) {
      done[at] = 1;
      const std::uint32_t vertex = start_of(a_, at);
      if (place[vertex] != kNone) close_loop(place[vertex]);
      place[vertex] = static_cast<std::uint32_t>(chain.size());
      chain.push_back(at);
      at = next(at);
      // The way goes on through the material.
      while (!bounds_material(at)) at = next(at ^ 1);
    }
    close_loop(0);
  }
  return loops;
}

bool PlanarMap::is_thin(const Arrangement& a, const Loop& loop) {
  const double thinnest = kEdgeErrorInSnaps * a.snap, area = signed_area(a, loop);
  // A disc of that radius has more area than the first limit. A chain of length l whose inside is within t of
  // it holds no more than t l. Between the two limits area does not tell, because a long tail makes any
  // thickness look thin.
  constexpr double kLessThanPi = 3.1, kArcInChords = 1.12;
  if (std::abs(area) <= kLessThanPi * thinnest * thinnest) return true;
  if (std::abs(area) > kArcInChords * thinnest * chord_length(a, loop)) return false;
  // Pieces may be off by this many snaps: kHot and rounding.
  constexpr double kOff = 2;
  return detail::is_thin(chain_of(a, loop, area < 0), thinnest - kOff * a.snap, a.snap);
}

void PlanarMap::turn_thin_faces(std::vector<char>& kept) const {
  std::vector<char> is_outside(face_starts_.size(), 0);
  for (const Component& component : components_) is_outside[face_[component.outside]] = 1;
  std::vector<std::uint32_t> thin;
  std::vector<Loop> walks;
  for (std::uint32_t f = 0; f < face_starts_.size(); ++f) {
    if (is_outside[f] != 0) continue;
    Loop walk = walk_around(f);
    if (!is_thin(a_, walk)) continue;
    thin.push_back(f);
    walks.push_back(std::move(walk));
  }
  // Each turn makes the boundary shorter, so the loop ends.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < thin.size(); ++i) {
      ask(1 + walks[i].half_edges.size() / 16);
      double other = 0, same = 0;
      for (const std::uint32_t h : walks[i].half_edges)
        (kept[face_[h ^ 1]] != kept[thin[i]] ? other : same) += chord_length(a_, h);
      if (!(other > same * (1 + 1e-9))) continue;
      kept[thin[i]] = kept[thin[i]] == 0 ? 1 : 0;
      changed = true;
    }
  }
}

void PlanarMap::link_components(const std::vector<char>& kept, std::vector<Loop>& loops,
                                std::vector<std::uint32_t>& group_of_face) const {
  DisjointSets groups(face_starts_.size());
  for (std::uint32_t e = 0; e < a_.edges.size(); ++e)
    if (kept[face_[2 * e]] != 0 && kept[face_[2 * e + 1]] != 0) groups.join(face_[2 * e], face_[2 * e + 1]);

  std::vector<std::uint32_t> loop_of_edge(a_.edges.size(), kNone);
  std::vector<double> areas;
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    for (const std::uint32_t h : loops[i].half_edges) loop_of_edge[h / 2] = i;
    areas.push_back(std::abs(signed_area(a_, loops[i])));
  }
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    const std::uint32_t outside = face_[components_[c].outside];
    if (kept[outside] == 0) continue;
    // The material around the component belongs to the smallest loop that holds it.
    std::vector<std::uint32_t> crossed;
    cast_ray(c, [&](std::uint32_t e, bool) {
      if (loop_of_edge[e] != kNone) crossed.push_back(loop_of_edge[e]);
    });
    std::sort(crossed.begin(), crossed.end());
    std::uint32_t innermost = kNone;
    for (std::size_t i = 0, end = 0; i < crossed.size(); i = end) {
      while (end < crossed.size() && crossed[end] == crossed[i]) ++end;
      if ((end - i) % 2 != 0 && (innermost == kNone || areas[crossed[i]] < areas[innermost]))
        innermost = crossed[i];
    }
    if (innermost != kNone) groups.join(outside, face_[loops[innermost].half_edges.front()]);
  }
  for (std::uint32_t f = 0; f < group_of_face.size(); ++f) group_of_face[f] = groups.of(f);
}

std::vector<PlanarMap::Loop> PlanarMap::loops(KeepRule keep) const {
  std::vector<char> kept;
  // Step 4 of docs/design/boolean.md, up to the thin loops, which overlay_at leaves out.
  for (const Winding& winding : winding_) kept.push_back(keep(winding) ? 1 : 0);
  turn_thin_faces(kept);
  std::vector<Loop> loops = traced_loops(kept);
  std::vector<std::uint32_t> group_of_face(face_starts_.size());
  link_components(kept, loops, group_of_face);
  for (Loop& loop : loops) loop.group = group_of_face[face_[loop.half_edges.front()]];
  return loops;
}

}  // namespace lekalo::geom::detail
