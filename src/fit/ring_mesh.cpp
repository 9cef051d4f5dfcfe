#include "ring_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lekalo::fit {
namespace {

constexpr double kRatio = 1.35;   // of neighbouring elements
constexpr double kLongest = 0.4;  // element along z, as a part of the thinnest wall
constexpr double kSameEnd = 1e-9;

/// Divides the stretch from 0 to `length` into steps that grow from `least` by `ratio` up to `most`, away
/// from the ends that are fine.
std::vector<double> graded(double length, double least, double ratio, double most, bool fine_at_start,
                           bool fine_at_end) {
  const int sides = static_cast<int>(fine_at_start) + static_cast<int>(fine_at_end);
  std::vector<double> from_side;  // steps that grow from a fine end
  const double reach = sides == 2 ? length / 2 : length;
  double step = sides == 0 ? most : std::min({least, most, reach});
  for (double at = 0; at < reach - 1e-9 * length;) {
    from_side.push_back(step);
    at += step;
    step = std::min(step * ratio, most);
  }
  double total = 0;
  for (const double s : from_side) total += s;
  for (double& s : from_side) s *= reach / total;
  std::vector<double> steps = from_side;
  if (sides == 2) steps.insert(steps.end(), from_side.rbegin(), from_side.rend());
  if (sides == 1 && fine_at_end) std::reverse(steps.begin(), steps.end());
  return steps;
}

void append(std::vector<double>& places, double start, double end, const std::vector<double>& steps) {
  double at = start;
  for (const double s : steps) places.push_back(at += s);
  places.back() = end;
}

double wall_of(const Ring& ring) { return (ring.outer_diameter - ring.inner_diameter) / 2; }

/// A place where rings end, and how many of them.
struct RingEnd {
  double z = 0;
  int rings = 0;
};

/// The ends of rings on one side of z = 0, outwards. Those that differ by rounding are one.
std::vector<RingEnd> ends_on(const Assembly& assembly, double side) {
  std::vector<double> ends;
  for (const Ring& ring : assembly.rings) ends.push_back(ring.length / 2 + side * ring.middle);
  std::sort(ends.begin(), ends.end());
  std::vector<RingEnd> all;
  for (const double z : ends)
    if (!all.empty() && z - all.back().z <= kSameEnd * z)
      ++all.back().rings;
    else
      all.push_back({z, 1});
  return all;
}

/// Places along z on one side, outwards from 0: fine on both sides of every end but that of the longest ring,
/// where no edge presses.
std::vector<double> stations_on(const Assembly& assembly, const Fineness& fineness, double side) {
  double thinnest = 1e300;
  for (const Ring& ring : assembly.rings) thinnest = std::min({thinnest, wall_of(ring), ring.length / 2});
  const std::vector<RingEnd> ends = ends_on(assembly, side);
  std::vector<double> places{0};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double start = i == 0 ? 0 : ends[i - 1].z, length = ends[i].z - start;
    const bool edge = i + 1 < ends.size() || ends[i].rings > 1;
    append(places, start, ends[i].z,
           graded(length, std::min(fineness.least * thinnest, length / 2), kRatio, kLongest * thinnest, i > 0,
                  edge));
  }
  return places;
}

std::vector<double> stations_of(const Assembly& assembly, const Fineness& fineness) {
  const std::vector<double> right = stations_on(assembly, fineness, 1);
  if (assembly.symmetric()) return right;
  const std::vector<double> left = stations_on(assembly, fineness, -1);
  std::vector<double> places;
  for (std::size_t i = left.size(); i-- > 1;) places.push_back(-left[i]);
  places.insert(places.end(), right.begin(), right.end());
  return places;
}

std::vector<double> radii_of(const Assembly& assembly, std::size_t ring, const Fineness& fineness) {
  const Ring& r = assembly.rings[ring];
  const double start = r.inner_diameter / 2, wall = wall_of(r);
  std::vector<double> places{start};
  append(places, start, r.outer_diameter / 2,
         graded(wall, 2 * fineness.least * wall, kRatio, fineness.across * wall, ring > 0,
                ring + 1 < assembly.rings.size()));
  return places;
}

/// A corner or middle between neighbours: places at half steps.
double half_place(const std::vector<double>& places, std::size_t half) {
  return half % 2 == 0 ? places[half / 2] : (places[half / 2] + places[half / 2 + 1]) / 2;
}

class Mesher {
 public:
  Mesher(const Assembly& assembly, const Fineness& fineness)
      : symmetric_(assembly.symmetric()), stations_(stations_of(assembly, fineness)) {
    for (std::size_t i = 0; i < assembly.rings.size(); ++i) {
      radii_.push_back(radii_of(assembly, i, fineness));
      const Ring& ring = assembly.rings[i];
      columns_.emplace_back(symmetric_ ? 0 : column_at(ring.middle - ring.length / 2),
                            column_at(ring.middle + ring.length / 2));
    }
  }

  RingMesh made() {
    mesh_.half = symmetric_;
    mesh_.rings.resize(radii_.size());
    for (std::size_t ring = 0; ring < radii_.size(); ++ring) mesh_.rings[ring].first = columns_[ring].first;
    index_.resize(radii_.size());
    for (std::size_t k = 0; k < 2 * stations_.size() - 1; ++k)
      for (std::size_t ring = 0; ring < radii_.size(); ++ring)
        if (k >= columns_[ring].first && k <= columns_[ring].second) add_column(ring, k);
    for (std::size_t ring = 0; ring < radii_.size(); ++ring) add_elements(ring);
    return std::move(mesh_);
  }

 private:
  /// The column at a ring's end.
  [[nodiscard]] std::size_t column_at(double z) const {
    const auto nearest = std::min_element(stations_.begin(), stations_.end(), [&](double a, double b) {
      return std::abs(a - z) < std::abs(b - z);
    });
    return 2 * static_cast<std::size_t>(nearest - stations_.begin());
  }

  void add_column(std::size_t ring, std::size_t k) {
    const std::size_t across = 2 * radii_[ring].size() - 1;
    std::vector<int>& column = index_[ring].emplace_back(across, -1);
    for (std::size_t j = 0; j < across; ++j) {
      if (k % 2 == 1 && j % 2 == 1) continue;  // an element has no node in its middle
      column[j] = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back({half_place(radii_[ring], j), half_place(stations_, k)});
    }
    mesh_.rings[ring].inner.push_back(column.front());
    mesh_.rings[ring].outer.push_back(column.back());
  }

  void add_elements(std::size_t ring) {
    const auto& at = index_[ring];
    for (std::size_t k = 0; k + 2 < at.size(); k += 2)
      for (std::size_t j = 0; j + 2 < at[k].size(); j += 2)
        mesh_.elements.push_back({{at[k][j], at[k][j + 2], at[k + 2][j + 2], at[k + 2][j], at[k][j + 1],
                                   at[k + 1][j + 2], at[k + 2][j + 1], at[k + 1][j]},
                                  static_cast<int>(ring)});
  }

  bool symmetric_;
  std::vector<double> stations_;
  std::vector<std::vector<double>> radii_;
  std::vector<std::pair<std::size_t, std::size_t>> columns_;  // the first and the last of each ring
  std::vector<std::vector<std::vector<int>>> index_;          // by ring, column and place across
  RingMesh mesh_;
};

/// Moves the nodes of a surface, and those in the middle of the element below it by half.
void turn(RingMesh& mesh, const Turned& turned) {
  std::vector<double> moved(mesh.nodes.size(), 0);
  const RingSurfaces& ring = mesh.rings[static_cast<std::size_t>(turned.ring)];
  for (const int node : turned.outer ? ring.outer : ring.inner)
    moved[static_cast<std::size_t>(node)] = turned.change(mesh.nodes[static_cast<std::size_t>(node)].z);
  std::vector<double> half = moved;
  for (const MeshElement& e : mesh.elements) {
    if (e.ring != turned.ring) continue;
    const auto of = [&](int side) {
      return moved[static_cast<std::size_t>(e.nodes[static_cast<std::size_t>(side)])];
    };
    half[static_cast<std::size_t>(e.nodes[4])] = (of(0) + of(1)) / 2;
    half[static_cast<std::size_t>(e.nodes[6])] = (of(2) + of(3)) / 2;
  }
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) mesh.nodes[i].r += half[i];
}

}  // namespace

RingMesh mesh_of(const Assembly& assembly, const Fineness& fineness, const std::vector<Turned>& turned) {
  RingMesh mesh = Mesher(assembly, fineness).made();
  for (const Turned& t : turned) turn(mesh, t);
  return mesh;
}

}  // namespace lekalo::fit
