#include "lekalo/locate/solid_allowance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lekalo/base/rounding.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::locate {
namespace {

using solid::Mesh;
using solid::Triangle;
using solid::Vector;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vector a = mesh.vertices[t[0]];
    area += 0.5 * norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
  }
  return area;
}

/// An edge that is to be cut, from its smaller vertex, and the vertex in its middle.
struct Cut {
  std::uint32_t a = 0, b = 0, middle = 0;
  friend bool operator<(const Cut& x, const Cut& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); }
  friend bool operator==(const Cut& x, const Cut& y) { return x.a == y.a && x.b == y.b; }
};

/// Cuts edges longer than `step` in half. Both triangles of an edge cut it at the same vertex, so the surface
/// stays closed.
class Cutting {
 public:
  Cutting(MeasuredPart& part, double step) : mesh_(part.mesh), numbers_(part.numbers), step_(step) {
    for (const Triangle& t : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const Cut cut = cut_of(t[k], t[(k + 1) % 3]); longer(cut)) cuts_.push_back(cut);
    std::sort(cuts_.begin(), cuts_.end());
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
  }
  /// The triangles that there will be.
  [[nodiscard]] std::size_t count() const { return mesh_.triangles.size() + 2 * cuts_.size(); }
  [[nodiscard]] bool any() const { return !cuts_.empty(); }

  void cut() {
    for (Cut& one : cuts_) {
      one.middle = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(0.5 * (mesh_.vertices[one.a] + mesh_.vertices[one.b]));
    }
    std::vector<Triangle> before = std::move(mesh_.triangles);
    std::vector<std::uint32_t> numbers = std::move(numbers_);
    mesh_.triangles.clear(), numbers_.clear();
    for (std::size_t k = 0; k < before.size(); ++k) {
      ask(8);
      number_ = numbers[k];
      cut(before[k]);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  static Cut cut_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b), 0}; }
  [[nodiscard]] bool longer(const Cut& cut) const {
    return norm(mesh_.vertices[cut.b] - mesh_.vertices[cut.a]) > step_;
  }
  [[nodiscard]] std::uint32_t middle(std::uint32_t a, std::uint32_t b) const {
    const Cut wanted = cut_of(a, b);
    const auto found = std::lower_bound(cuts_.begin(), cuts_.end(), wanted);
    return found != cuts_.end() && *found == wanted ? found->middle : kNone;
  }
  void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
    numbers_.push_back(number_);
  }
  void cut(Triangle t) {
    std::array<std::uint32_t, 3> m{};
    std::size_t cuts = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      m[k] = middle(t[k], t[(k + 1) % 3]);
      if (m[k] != kNone) ++cuts;
    }
    // Turned so that its first edge is cut, and with two cuts the second one, too.
    for (std::size_t turn = 0; turn < 3 && cuts > 0 && (m[0] == kNone || (cuts == 2 && m[1] == kNone));
         ++turn) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    if (cuts == 0) return put(t[0], t[1], t[2]);
    if (cuts == 1) return put(t[0], m[0], t[2]), put(m[0], t[1], t[2]);
    put(m[0], t[1], m[1]);
    if (cuts == 2) return put(t[0], m[0], m[1]), put(t[0], m[1], t[2]);
    put(t[0], m[0], m[2]), put(m[2], m[1], t[2]), put(m[0], m[1], m[2]);
  }

  Mesh& mesh_;
  std::vector<std::uint32_t>& numbers_;
  double step_;
  std::vector<Cut> cuts_;
  std::uint32_t number_ = 0;
};

/// Calls act(number) for each number below a count, on threads.
template <class Act>
void for_each_of(std::size_t count, unsigned threads, const Act& act) {
  constexpr std::size_t kChunk = 512;
  share_out((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    for (std::size_t k = kChunk * chunk; k < std::min(count, kChunk * (chunk + 1)); ++k) {
      ask(8);
      act(k);
    }
  });
}

}  // namespace

MeasuredPart measured_part(const solid::Mesh& part, const solid::Mesh& blank,
                           const solid::Motion& blank_from_part, std::size_t triangles, unsigned threads,
                           const std::vector<double>& widths) {
  MeasuredPart measured{part, {}, {}};
  for (std::size_t k = 0; k < part.triangles.size(); ++k)
    measured.numbers.push_back(static_cast<std::uint32_t>(k));
  // Equilateral triangles of this side would have twice the area; halving makes them a little smaller.
  const double step = std::sqrt(4.6 * area_of(part) / static_cast<double>(triangles));
  for (;;) {
    Cutting round(measured, step);
    if (!round.any() || round.count() > 4 * triangles) break;
    round.cut();
  }
  const solid::TriangleTree tree(blank);
  const double widest = widths.empty() ? 0 : *std::max_element(widths.begin(), widths.end());
  const std::vector<Vector>& places = measured.mesh.vertices;
  measured.allowances.resize(places.size());
  for_each_of(places.size(), threads, [&](std::size_t k) {
    const Vector p = blank_from_part(places[k]);
    if (!tree.holds(p))
      measured.allowances[k] = -tree.nearest(p)->high;
    else
      measured.allowances[k] = widths.empty() ? tree.nearest(p)->low : tree.least_sum(p, widths, -1, -widest);
  });
  return measured;
}

std::vector<double> deviations_from(const solid::Mesh& part, const solid::Motion& blank_from_part,
                                    const std::vector<Vector>& points, unsigned threads) {
  // Moving a point back is some ten roundings, and the rotation's own, each of 2^-53 of the way at most.
  constexpr double kMovedBack = 0x1p-47;
  const solid::TriangleTree tree(part);
  std::vector<double> deviations(points.size());
  for_each_of(points.size(), threads, [&](std::size_t k) {
    const Vector p = blank_from_part.back(points[k]);
    const solid::Nearest nearest = *tree.nearest(p);
    const double off = kMovedBack * (norm(points[k]) + norm(blank_from_part.shift));
    deviations[k] = difference_rounded_down(tree.holds(p) ? -nearest.high : nearest.low, off);
  });
  return deviations;
}

}  // namespace lekalo::locate
