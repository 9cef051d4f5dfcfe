#include "lekalo/fit/pressing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "element.hpp"
#include "envelope.hpp"
#include "lekalo/base/assert.hpp"
#include "lekalo/base/stop.hpp"
#include "ring_mesh.hpp"

namespace lekalo::fit {
namespace {

constexpr double kSolved = 1e-9;        // of the forces, where an iteration ends
constexpr double kNearlySolved = 1e-2;  // of the forces, from where a tangent is not made anew
constexpr double kGoesOn = 0.1;         // of what was left before, which such a tangent has to leave
constexpr std::size_t kElasticFactors = 3;
constexpr int kIterations = 25;
constexpr int kContactRounds = 40;
constexpr int kHalvings = 8;
constexpr double kStepsOfAll = 16;  // plastic steps of one press()

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The free surface of a hub that yields has reached 2 / sqrt(3) of the yield strain around: the measure of
/// DIN 7190, by which the last fibre carries all it can. A solid shaft yields all at once.
bool yields_through(const Ring& ring, const RingGrowth& grown) {
  if (!(grown.plastic_part > 1 - 1e-9)) return false;
  const double strain = std::abs(in_middle(grown.outer).diameter) / ring.outer_diameter;
  return ring.inner_diameter == 0 ||
         strain >= 2 / std::numbers::sqrt3 * ring.material.yield_mpa / ring.material.youngs_mpa;
}

}  // namespace

const Growth& in_middle(const std::vector<Growth>& surface) {
  const auto at = std::find_if(surface.begin(), surface.end(), [](const Growth& g) { return g.z == 0; });
  LEKALO_ASSERT(at != surface.end());
  return *at;
}

std::string_view name_of(State state) noexcept {
  switch (state) {
    case State::elastic:
      return "elastic";
    case State::plastic:
      return "plastic";
    case State::full:
      return "full";
  }
  return "";
}

struct Pressing::Model {
  /// Nodes of two rings at one place of a seat.
  struct Pair {
    int shaft = 0, hub = 0;
    std::size_t seat = 0;
    double turned = 0;  // what the radii overlap beyond the interference, mm
  };

  Assembly assembly;
  RingMesh mesh;
  std::vector<StrainAt> strains;  // of each element's points
  std::vector<PlasticState> plastic;
  std::vector<Pair> pairs;
  std::vector<char> touching;        // of each pair
  std::vector<double> interference;  // of each seat
  double turned_part = 0;            // of what is turned off seats: it comes with the first interference
  std::vector<double> moved;         // r and z of each node
  std::vector<double> forces;        // what holds each of them, N per radian
  double largest_force = 0;          // that a node ever held, by which what is left over is measured
  std::uint64_t work = 0;
  FirstSeat first_seat;

  Model(const Assembly& a, const Fineness& fineness, const std::vector<Turned>& turned, FirstSeat first);

  /// The parts are pressed to this in one step.
  struct Goal {
    std::vector<double> interference;
    double turned_part = 1;
  };

  // One step; false where no solution was found, with everything as before.
  bool step(const Goal& to, bool apart);
  [[nodiscard]] Pressed read() const;

 private:
  struct Numbering {
    std::vector<int> of;  // of each component of a node: its unknown, or -1 where it is held at 0
    std::size_t unknowns = 0;
  };
  /// The factored matrix of the assembly where nothing yields, which every step begins with. It hangs on what
  /// touches alone.
  struct ElasticFactor {
    std::vector<int> of;  // the numbering
    Envelope matrix;
  };
  /// Those of late, the newest last. Copies of a model share them.
  std::shared_ptr<std::vector<ElasticFactor>> elastic = std::make_shared<std::vector<ElasticFactor>>();

  [[nodiscard]] Numbering number() const;
  [[nodiscard]] Envelope envelope_of(const Numbering& numbering) const;
  [[nodiscard]] const Envelope* elastic_factor(const Numbering& numbering) const;
  bool solve(const Goal& to, std::vector<PlasticState>& after);
  bool iterate(const Numbering& numbering, std::vector<PlasticState>& after);
  void find_forces(bool elastically, std::vector<PlasticState>& after, const Numbering& numbering,
                   Envelope* matrix);
  bool touch_anew(const Goal& to);
  /// The hub's node moves as it is told, and its force is the shaft's load.
  [[nodiscard]] bool is_held(const Pair& pair) const {
    return pair.seat == 0 && first_seat == FirstSeat::cylinder;
  }
  [[nodiscard]] static double overlap(const Pair& pair, const Goal& to) {
    return to.interference[pair.seat] / 2 + to.turned_part * pair.turned;
  }
  [[nodiscard]] double turned_at(const std::vector<Turned>& turned, std::size_t ring, bool outer,
                                 double z) const {
    double change = 0;
    for (const Turned& t : turned)
      if (at(t.ring) == ring && t.outer == outer) change += t.change(z);
    return change;
  }
  [[nodiscard]] std::vector<Growth> growths(const std::vector<int>& nodes) const;
  [[nodiscard]] SeatLoad load_of(std::size_t seat) const;
  void read_stresses(std::vector<RingGrowth>& rings) const;
};

Pressing::Model::Model(const Assembly& a, const Fineness& fineness, const std::vector<Turned>& turned,
                       FirstSeat first)
    : assembly(a), first_seat(first) {
  std::vector<Turned> free;  // seats keep their nominal diameter in the mesh: theirs is the interference
  for (const Turned& t : turned)
    if (t.outer ? at(t.ring) + 1 == a.rings.size() : t.ring == 0) free.push_back(t);
  mesh = mesh_of(a, fineness, free);
  for (const MeshElement& e : mesh.elements)
    for (int p = 0; p < kPoints; ++p) strains.push_back(strain_at(mesh, e, p));
  plastic.resize(strains.size());
  moved.resize(2 * mesh.nodes.size(), 0.0);
  forces.resize(moved.size(), 0.0);
  interference.resize(a.rings.size() - 1, 0.0);
  for (std::size_t seat = 0; seat + 1 < a.rings.size(); ++seat) {
    const std::vector<int>&inner = mesh.rings[seat].outer, &outer = mesh.rings[seat + 1].inner;
    const std::size_t inner_first = mesh.rings[seat].first, outer_first = mesh.rings[seat + 1].first;
    for (std::size_t k = std::max(inner_first, outer_first);
         k < std::min(inner_first + inner.size(), outer_first + outer.size()); ++k) {
      const int inside = inner[k - inner_first], outside = outer[k - outer_first];
      const double z = mesh.nodes[at(inside)].z;
      pairs.push_back(
          {inside, outside, seat, turned_at(turned, seat, true, z) - turned_at(turned, seat + 1, false, z)});
    }
  }
  touching.resize(pairs.size(), 1);
}

Pressing::Model::Numbering Pressing::Model::number() const {
  Numbering n;
  n.of.assign(moved.size(), -2);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].r == 0) n.of[2 * i] = -1;
    if (mesh.half && mesh.nodes[i].z == 0) n.of[2 * i + 1] = -1;
  }
  // Nothing pulls along the axis: one node holds each ring.
  for (const RingSurfaces& ring : mesh.rings)
    for (const int node : ring.outer)
      if (mesh.nodes[at(node)].z == 0) n.of[2 * at(node) + 1] = -1;
  std::vector<int> same(mesh.nodes.size(), -1);  // the node whose r this node's follows
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (is_held(pairs[p]))
      n.of[2 * at(pairs[p].hub)] = -1;
    else if (touching[p] != 0)
      same[at(pairs[p].hub)] = pairs[p].shaft;
  // A node that is followed has the lower number, so that its unknown is there already.
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) {
      int& unknown = n.of[2 * i + c];
      if (unknown == -1) continue;
      unknown = c == 0 && same[i] >= 0 ? n.of[2 * at(same[i])] : static_cast<int>(n.unknowns++);
    }
  return n;
}

Envelope Pressing::Model::envelope_of(const Numbering& numbering) const {
  std::vector<std::size_t> first(numbering.unknowns);
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = i;
  for (const MeshElement& element : mesh.elements) {
    int lowest = static_cast<int>(first.size());
    for (const int node : element.nodes)
      for (const std::size_t c : {0U, 1U})
        if (const int unknown = numbering.of[2 * at(node) + c]; unknown >= 0)
          lowest = std::min(lowest, unknown);
    for (const int node : element.nodes)
      for (const std::size_t c : {0U, 1U})
        if (const int unknown = numbering.of[2 * at(node) + c]; unknown >= 0)
          first[at(unknown)] = std::min(first[at(unknown)], at(lowest));
  }
  return Envelope(first);
}

const Envelope* Pressing::Model::elastic_factor(const Numbering& numbering) const {
  const auto found = std::find_if(elastic->begin(), elastic->end(),
                                  [&](const ElasticFactor& factor) { return factor.of == numbering.of; });
  return found == elastic->end() ? nullptr : &found->matrix;
}

/// Finds the forces and the plastic strains of the displacements. \param matrix  gets the tangent; may be
/// null
void Pressing::Model::find_forces(bool elastically, std::vector<PlasticState>& after,
                                  const Numbering& numbering, Envelope* matrix) {
  if (matrix != nullptr) matrix->clear();
  std::fill(forces.begin(), forces.end(), 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const MeshElement& element = mesh.elements[e];
    Material material = assembly.rings[at(element.ring)].material;
    if (elastically) material.yield_mpa = 0;
    std::array<std::size_t, 16> component{};
    for (std::size_t i = 0; i < 16; ++i) component[i] = 2 * at(element.nodes[i / 2]) + i % 2;
    std::array<std::array<double, 16>, 16> stiffness{};
    for (std::size_t p = 0; p < kPoints; ++p) {
      const StrainAt& b = strains[kPoints * e + p];
      Tensor strain{};
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < 16; ++i) strain[s] += b.rows[s][i] * moved[component[i]];
      const MaterialAnswer answer = answer_to(material, strain, plastic[kPoints * e + p]);
      after[kPoints * e + p] = answer.plastic;
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < 16; ++i)
          forces[component[i]] += b.volume * b.rows[s][i] * answer.stress[s];
      if (matrix == nullptr) continue;
      std::array<std::array<double, 16>, 4> tangent_rows{};
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t t = 0; t < 4; ++t)
          for (std::size_t i = 0; i < 16; ++i)
            tangent_rows[s][i] += b.volume * answer.tangent[s][t] * b.rows[t][i];
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < 16; ++i)
          for (std::size_t j = 0; j <= i; ++j) stiffness[i][j] += b.rows[s][i] * tangent_rows[s][j];
    }
    if (matrix == nullptr) continue;
    for (std::size_t i = 0; i < 16; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const int a = numbering.of[component[i]], b = numbering.of[component[j]];
        if (a < 0 || b < 0) continue;
        matrix->add(at(std::max(a, b)), at(std::min(a, b)), (i != j && a == b ? 2 : 1) * stiffness[i][j]);
      }
  }
}

/// Newton's iteration with the consistent tangent. The displacements satisfy the contact already.
bool Pressing::Model::iterate(const Numbering& numbering, std::vector<PlasticState>& after) {
  std::vector<double> right(numbering.unknowns);
  const std::vector<double> before = forces;
  Envelope tangent = envelope_of(numbering);
  const Envelope* elastic_tangent = elastic_factor(numbering);
  double left_before = HUGE_VAL;
  bool is_factored = false;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    ask();
    // The jump of the seat lies in one layer of elements at first; it is shared out before anything may
    // yield.
    const bool elastically = iteration == 0;
    const bool has_factor = elastically ? elastic_tangent != nullptr : is_factored;
    find_forces(elastically, after, numbering, has_factor ? nullptr : &tangent);
    std::fill(right.begin(), right.end(), 0.0);
    double left = 0;
    double largest = largest_force;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      largest = std::max(largest, std::abs(forces[i]));
      if (numbering.of[i] >= 0) right[at(numbering.of[i])] -= forces[i];
    }
    for (const Pair& pair : pairs)
      // While the jump of the seat lies in one layer, the hub's forces are those of no pressure.
      if (is_held(pair))
        right[at(numbering.of[2 * at(pair.shaft)])] -= (elastically ? before : forces)[2 * at(pair.hub)];
    for (const double r : right) left = std::max(left, std::abs(r));
    if (!std::isfinite(left)) return false;
    if (!elastically && left <= kSolved * largest) {
      largest_force = largest;
      return true;
    }
    if (!has_factor && !tangent.factor()) return false;
    (elastically && elastic_tangent != nullptr ? *elastic_tangent : tangent).solve(right);
    work += numbering.unknowns;
    if (elastically && elastic_tangent == nullptr) {
      if (elastic->size() == kElasticFactors) elastic->erase(elastic->begin());
      elastic->push_back({numbering.of, tangent});
    }
    // The tangent that has come so near leads on to the end.
    is_factored = !elastically && left <= kNearlySolved * largest && left < kGoesOn * left_before;
    left_before = left;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (numbering.of[i] >= 0) moved[i] += right[at(numbering.of[i])];
  }
  return false;
}

/// Lets go of pairs that pull, and joins those that overlap. True where something changed.
bool Pressing::Model::touch_anew(const Goal& to) {
  double largest = 0;
  for (const Pair& pair : pairs) largest = std::max(largest, std::abs(forces[2 * at(pair.hub)]));
  bool changed = false;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const Pair& pair = pairs[p];
    if (is_held(pair)) continue;
    const double inside = moved[2 * at(pair.shaft)] + overlap(pair, to) - moved[2 * at(pair.hub)];
    const bool touches = touching[p] != 0 ? forces[2 * at(pair.hub)] > -1e-9 * largest : inside > 1e-12;
    if (touches != (touching[p] != 0)) touching[p] = touches ? 1 : 0, changed = true;
  }
  return changed;
}

bool Pressing::Model::solve(const Goal& to, std::vector<PlasticState>& after) {
  for (int round = 0; round < kContactRounds; ++round) {
    const Numbering numbering = number();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (is_held(pairs[p]))
        moved[2 * at(pairs[p].hub)] = to.interference[0] / 2;
      else if (touching[p] != 0)
        moved[2 * at(pairs[p].hub)] = moved[2 * at(pairs[p].shaft)] + overlap(pairs[p], to);
    if (!iterate(numbering, after)) return false;
    if (!touch_anew(to)) return true;
  }
  return false;
}

bool Pressing::Model::step(const Goal& to, bool apart) {
  const std::vector<double> moved_before = moved, forces_before = forces;
  const std::vector<char> touching_before = touching;
  if (apart) std::fill(touching.begin(), touching.end(), 0);
  std::vector<PlasticState> after = plastic;
  if (solve(to, after)) {
    plastic = std::move(after);
    interference = to.interference, turned_part = to.turned_part;
    return true;
  }
  moved = moved_before, forces = forces_before, touching = touching_before;
  return false;
}

std::vector<Growth> Pressing::Model::growths(const std::vector<int>& nodes) const {
  std::vector<Growth> all;
  for (const int node : nodes) all.push_back({mesh.nodes[at(node)].z, 2 * moved[2 * at(node)]});
  return all;
}

SeatLoad Pressing::Model::load_of(std::size_t seat) const {
  std::vector<std::size_t> of;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p].seat == seat) of.push_back(p);
  SeatLoad load;
  const double radius = assembly.rings[seat].outer_diameter / 2;
  const auto z_of = [&](std::size_t i) { return mesh.nodes[at(pairs[of[i]].shaft)].z; };
  const auto force_of = [&](std::size_t i) { return forces[2 * at(pairs[of[i]].hub)]; };
  const double halves = mesh.half ? 2 : 1;
  for (std::size_t i = 0; i < of.size(); ++i) load.force_n += 2 * halves * std::numbers::pi * force_of(i);
  load.pressure_mpa =
      load.force_n / (2 * halves * std::numbers::pi * radius * (z_of(of.size() - 1) - z_of(0)));
  // The middle of a side carries four sixths of its length.
  std::size_t middle = 0;
  while (z_of(middle) != 0) middle += 2;
  load.middle_mpa = force_of(middle + 1) / (radius * z_of(middle + 2) * 2 / 3);
  for (std::size_t i = 0; i + 2 < of.size(); i += 2)
    if (touching[of[i]] != 0 && touching[of[i + 1]] != 0 && touching[of[i + 2]] != 0)
      load.touching_mm += halves * (z_of(i + 2) - z_of(i));
  return load;
}

void Pressing::Model::read_stresses(std::vector<RingGrowth>& rings) const {
  std::vector<double> wall(rings.size(), 0), yielded(rings.size(), 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const MeshElement& element = mesh.elements[e];
    RingGrowth& ring = rings[at(element.ring)];
    const bool middle = mesh.nodes[at(element.nodes[0])].z == 0;
    const double width = mesh.nodes[at(element.nodes[1])].r - mesh.nodes[at(element.nodes[0])].r;
    for (std::size_t p = 0; p < kPoints; ++p) {
      const std::size_t k = kPoints * e + p;
      Tensor strain{};
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < 16; ++i)
          strain[s] += strains[k].rows[s][i] * moved[2 * at(element.nodes[i / 2]) + i % 2];
      // The answer from the state after: elastic to rounding.
      const double mises =
          mises_of(answer_to(assembly.rings[at(element.ring)].material, strain, plastic[k]).stress);
      ring.largest_mises_mpa = std::max(ring.largest_mises_mpa, mises);
      ring.yields = ring.yields || plastic[k].length > 0;
      if (!middle || p > 1) continue;
      ring.middle_mises_mpa = std::max(ring.middle_mises_mpa, mises);
      wall[at(element.ring)] += width / 2;
      if (plastic[k].length > 0) yielded[at(element.ring)] += width / 2;
    }
  }
  for (std::size_t i = 0; i < rings.size(); ++i) rings[i].plastic_part = yielded[i] / wall[i];
}

Pressed Pressing::Model::read() const {
  Pressed pressed;
  pressed.interference = interference;
  for (std::size_t i = 0; i < assembly.rings.size(); ++i) {
    RingGrowth ring;
    if (assembly.rings[i].inner_diameter > 0) ring.inner = growths(mesh.rings[i].inner);
    ring.outer = growths(mesh.rings[i].outer);
    pressed.rings.push_back(std::move(ring));
  }
  read_stresses(pressed.rings);
  for (std::size_t i = 0; i < pressed.rings.size(); ++i) {
    RingGrowth& ring = pressed.rings[i];
    ring.through = yields_through(assembly.rings[i], ring);
    if (ring.yields) pressed.state = std::max(pressed.state, State::plastic);
    if (ring.through) pressed.state = State::full;
  }
  for (std::size_t seat = 0; seat + 1 < assembly.rings.size(); ++seat) pressed.seats.push_back(load_of(seat));
  return pressed;
}

Pressing::Pressing(const Assembly& assembly, const Fineness& fineness, const std::vector<Turned>& turned,
                   FirstSeat first_seat)
    : model_(std::make_unique<Model>(assembly, fineness, turned, first_seat)) {}
Pressing::~Pressing() = default;
Pressing::Pressing(Pressing&&) noexcept = default;
Pressing& Pressing::operator=(Pressing&&) noexcept = default;

namespace {

tl::unexpected<Error> no_solution(const Assembly& assembly, double part) {
  const bool harden = std::all_of(assembly.rings.begin(), assembly.rings.end(), [](const Ring& ring) {
    return ring.material.yield_mpa == 0 || ring.material.hardening_mpa > 0;
  });
  if (harden)
    return failure(
        ErrorCode::bad_input,
        fmt::format("beyond {:.3g} % of this interference no balance of the parts is found, though "
                    "all of them harden; choose a smaller interference or a thicker wall",
                    100 * part));
  return failure(ErrorCode::bad_input,
                 fmt::format("the parts carry no more than {:.3g} % of this interference: a part has yielded "
                             "through and does not harden; choose a smaller interference, a thicker wall, or "
                             "state --hardening",
                             100 * part));
}

}  // namespace

Result<Pressed> Pressing::press(const std::vector<double>& interference) {
  Model& m = *model_;
  const Model::Goal from{m.interference, m.turned_part};
  const auto place = [&](double part) {
    Model::Goal to = from;
    for (std::size_t i = 0; i < to.interference.size(); ++i)
      to.interference[i] += part * (interference[i] - from.interference[i]);
    to.turned_part += part * (1 - from.turned_part);
    return to;
  };
  // As one step where nothing yields on the way; else in small ones, halved where Newton's iteration fails.
  const std::vector<PlasticState> before = m.plastic;
  const Model kept = m;
  if (m.step({interference}, false)) {
    const bool same =
        std::equal(before.begin(), before.end(), m.plastic.begin(),
                   [](const PlasticState& a, const PlasticState& b) { return a.length == b.length; });
    if (same) return m.read();
  }
  const std::uint64_t work = m.work;
  m = kept;
  m.work = work;
  double part = 0, size = 1 / kStepsOfAll;
  const double least = size / (1 << kHalvings);
  while (part < 1) {
    const double next = part + size > 1 - 1e-9 ? 1.0 : part + size;
    if (m.step(place(next), false)) {
      part = next;
    } else if ((size /= 2) < least) {
      return no_solution(m.assembly, part);
    }
  }
  return m.read();
}

Result<Pressed> Pressing::released() const {
  Model apart = *model_;
  const std::vector<double> none(apart.interference.size(), 0.0);
  // Far apart: nothing touches, whatever has grown.
  std::vector<double> away = none;
  for (std::size_t i = 0; i < away.size(); ++i) away[i] = -apart.assembly.rings[i].outer_diameter;
  if (!apart.step({away}, true)) return no_solution(apart.assembly, 0);
  Pressed pressed = apart.read();
  pressed.interference = none;
  return pressed;
}

std::uint64_t Pressing::work() const noexcept { return model_->work; }

}  // namespace lekalo::fit
