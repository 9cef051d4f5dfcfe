#include "shells.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "turned_sets.hpp"

namespace lekalo::solid {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class ShellFinder {
 public:
  explicit ShellFinder(ClosedMesh& closed)
      : mesh_(closed.mesh),
        shells_(closed.shells),
        sets_(mesh_.triangles.size()),
        shell_of_(mesh_.triangles.size()),
        turn_(mesh_.triangles.size(), 0) {}

  void find(const std::vector<Edge>& edges) {
    std::vector<std::uint32_t> doubtful;  // triangles whose shell cannot be turned
    for_each_edge(edges, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin + 1; k < end; ++k) {
        const bool against = edges[k].forward == edges[begin].forward;
        const bool fits = sets_.unite(edges[begin].triangle, edges[k].triangle, against);
        if (!fits || end - begin > 2) doubtful.push_back(edges[k].triangle);
      }
    });
    for (std::uint32_t t = 0; t < shell_of_.size(); ++t) {
      const auto [root, against] = sets_.find(t);
      if (root == t) {
        shell_of_[t] = static_cast<std::uint32_t>(shells_.size());
        shells_.push_back({t, 0, {}, 0});
      } else {
        shell_of_[t] = shell_of_[root];
      }
      turn_[t] = against ? 1 : 0;
      ++shells_[shell_of_[t]].triangles;
    }
    two_sided_.assign(shells_.size(), 1);
    for (const std::uint32_t t : doubtful) two_sided_[shell_of_[t]] = 0;
    find_volumes();
    find_depths();
  }

  /// Turns what can be turned.
  void turn(ClosedMesh& closed) {
    std::vector<std::string>& notices = closed.notices;
    closed.turned.assign(turn_.size(), false);
    std::vector<std::uint32_t> turned(shells_.size(), 0);
    for (std::uint32_t t = 0; t < turn_.size(); ++t) {
      const std::uint32_t s = shell_of_[t];
      if (!can_be_turned(s)) continue;
      if ((turn_[t] != 0) == is_right_side_out(s)) {
        std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
        closed.turned[t] = true;
        ++turned[s];
      }
    }
    std::size_t triangles = 0, bodies = 0, left = 0;
    std::uint32_t first = 0;
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      Shell& shell = shells_[s];
      if (!can_be_turned(s)) {
        ++left;
        continue;
      }
      const bool is_void = *shell.depth % 2 != 0;
      shell.volume = is_void ? -std::abs(shell.volume) : std::abs(shell.volume);
      if (is_void && turned[s] == shell.triangles) {
        if (bodies++ == 0) first = shell.first;
      } else {
        triangles += turned[s];
      }
    }
    if (triangles > 0)
      notices.push_back(fmt::format("{} of {} looked into the material and {} turned round", triangles,
                                    counted(turn_.size(), "triangle"), triangles == 1 ? "is" : "are"));
    if (left > 0)
      notices.push_back(fmt::format(
          "{} turned as given, because surfaces meet or cross there, enclose nothing or are too many to "
          "tell which way is outside",
          counted(left, "shell stays", "shells stay")));
    if (bodies > 0) {
      const Vector p = mesh_.vertices[mesh_.triangles[first][0]];
      notices.push_back(fmt::format(
          "{} within another and {} turned as a body is; {}, the first at ({:.6g}, {:.6g}, {:.6g})",
          counted(bodies, "shell lies", "shells lie"), bodies == 1 ? "was" : "were",
          bodies == 1 ? "it counts as a void" : "they count as voids", p.x, p.y, p.z));
    }
  }

 private:
  [[nodiscard]] bool can_be_turned(std::uint32_t s) const {
    return two_sided_[s] != 0 && shells_[s].depth && shells_[s].volume != 0;
  }
  [[nodiscard]] bool is_right_side_out(std::uint32_t s) const {
    return (shells_[s].volume > 0) == (*shells_[s].depth % 2 == 0);
  }

  /// The volumes of shells whose triangles are all turned as their first one is. One that rounding may have
  /// made is 0.
  void find_volumes() {
    std::vector<double> sizes(shells_.size(), 0);
    for (std::uint32_t t = 0; t < turn_.size(); ++t) {
      Shell& shell = shells_[shell_of_[t]];
      const Vector from = mesh_.vertices[mesh_.triangles[shell.first][0]];
      const auto [i, j, k] = mesh_.triangles[t];
      const Vector a = mesh_.vertices[i] - from, b = mesh_.vertices[j] - from, c = mesh_.vertices[k] - from;
      const double six = dot(a, cross(b, c));
      shell.volume += (turn_[t] != 0 ? -six : six) / 6;
      sizes[shell_of_[t]] += norm(a) * norm(b) * norm(c);
    }
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      const double rounding = (shells_[s].triangles + 32.0) * 0x1p-52 * sizes[s];
      if (two_sided_[s] == 0 || !(std::abs(shells_[s].volume) > rounding)) shells_[s].volume = 0;
    }
  }

  /// Asks from the middles of a few triangles of each shell which others lie around them an odd number of
  /// times.
  void find_depths() {
    if (shells_.size() == 1) {
      shells_[0].depth = 0;
      return;
    }
    constexpr std::uint32_t kAsked = 8;
    const TriangleTree tree(mesh_);
    std::vector<std::uint32_t> asked(shells_.size(), 0), seen(shells_.size(), 0), last(shells_.size(), kNone);
    std::vector<std::uint32_t> crossed;
    // Above an ordinary place lie a few triangles; above thousands of nested shells it would be the square.
    std::size_t looks_left = limits::most_meeting_boxes(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < shell_of_.size(); ++t) {
      const std::uint32_t s = shell_of_[t];
      Shell& shell = shells_[s];
      const std::uint32_t spacing = (shell.triangles + kAsked - 1) / kAsked;
      if (seen[s]++ % spacing != 0) continue;
      const auto [i, j, k] = mesh_.triangles[t];
      const Vector middle = (1.0 / 3) * (mesh_.vertices[i] + mesh_.vertices[j] + mesh_.vertices[k]);
      if (looks_left == 0) {
        last[s] = kNone;
        continue;
      }
      crossed.clear();
      looks_left -= std::min(looks_left, tree.crossed_above(middle, crossed));
      for (std::uint32_t& c : crossed) c = shell_of_[c];
      std::sort(crossed.begin(), crossed.end());
      std::uint32_t depth = 0;
      for (std::size_t begin = 0, end; begin < crossed.size(); begin = end) {
        for (end = begin; end < crossed.size() && crossed[end] == crossed[begin];) ++end;
        if (crossed[begin] != s && (end - begin) % 2 != 0) ++depth;
      }
      if (asked[s]++ == 0) last[s] = depth;
      if (last[s] != depth) last[s] = kNone;
    }
    for (std::uint32_t s = 0; s < shells_.size(); ++s)
      if (last[s] != kNone) shells_[s].depth = last[s];
  }

  Mesh& mesh_;
  std::vector<Shell>& shells_;
  TurnedSets sets_;
  std::vector<std::uint32_t> shell_of_;
  std::vector<char> turn_;       ///< of a triangle: it is turned against the first of its shell
  std::vector<char> two_sided_;  ///< of a shell
};

}  // namespace

void find_shells(const std::vector<Edge>& edges, ClosedMesh& closed) {
  ShellFinder finder(closed);
  finder.find(edges);
  finder.turn(closed);
}

}  // namespace lekalo::solid
