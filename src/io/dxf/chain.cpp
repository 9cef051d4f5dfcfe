#include "chain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "io/text/refusal.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {
namespace {

/// More line ends than this in one place are no contour, and would make every search there slow.
constexpr std::size_t kMostEndsInOnePlace = 64;

/// Sorts the ends of all lines into square cells a little wider than the reach.
class EndGrid {
 public:
  EndGrid(const std::vector<DxfLine>& lines, double reach)
      : lines_(lines), cell_(2 * reach), reach_(reach), used_(lines.size(), false) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto [x, y] = cell_of(lines[i].ends[end]);
        ends_.push_back({x, y, {i, end}});
      }
    }
    std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) { return a.order() < b.order(); });
  }

  void use(std::size_t line) { used_[line] = true; }

  /// The end of an unused line nearest to p within reach. `crowded` is set when too many ends are near p.
  std::optional<ChainLink> nearest(geom::Point p, bool& crowded) const {
    std::optional<ChainLink> best;
    double best_distance = 0;
    std::size_t seen = 0;
    const auto [cx, cy] = cell_of(p);
    for (std::int64_t x = cx - 1; x <= cx + 1; ++x) {
      const End low{x, cy - 1, {0, 0}};
      for (auto end = std::lower_bound(ends_.begin(), ends_.end(), low,
                                       [](const End&a, const End&b) { return a.order() < b.order(); });
           end != ends_.end() && end->x == x && end->y <= cy + 1; ++end) {
        if (++seen > kMostEndsInOnePlace) {
          crowded = true;
          return std::nullopt;
        }
        const ChainLink link = end->link;
        if (used_[link.line]) continue;
        const geom::Point apart = lines_[link.line].ends[link.entered_at] - p;
        const double distance = dot(apart, apart);
        if (!(distance <= reach_ * reach_)) continue;
        if (best && std::tuple(best_distance, best->line, best->entered_at) <=
                        std::tuple(distance, link.line, link.entered_at)) {
          continue;
        }
        best = link;
        best_distance = distance;
      }
    }
    return best;
  }

  /// The distance, wanted for a message only, to the nearest end of any other unused line.
  [[nodiscard]] double distance_to_unused(geom::Point p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (used_[i]) continue;
      for (const geom::Point end : lines_[i].ends) nearest = std::min(nearest, norm(end - p));
    }
    return nearest;
  }

  [[nodiscard]] std::size_t first_unused() const {
    return static_cast<std::size_t>(std::find(used_.begin(), used_.end(), false) - used_.begin());
  }

 private:
  struct End {
    std::int64_t x, y;
    ChainLink link;
    [[nodiscard]] std::tuple<std::int64_t, std::int64_t, std::size_t, std::size_t> order() const {
      return {x, y, link.line, link.entered_at};
    }
  };

  [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell_of(geom::Point p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / cell_)),
            static_cast<std::int64_t>(std::floor(p.y / cell_))};
  }

  const std::vector<DxfLine>& lines_;
  double cell_, reach_;
  std::vector<bool> used_;
  std::vector<End> ends_;
};

std::string line_name(const DxfLine& line) {
  return fmt::format("the LINE at line {} (layer {})", line.line, excerpt(line.layer));
}

}  // namespace

Result<std::vector<ChainLink>> chain_lines(const std::vector<DxfLine>& lines, double reach,
                                           const std::string& name) {
  EndGrid grid(lines, reach);
  std::vector<ChainLink> chain{{0, 0}};
  grid.use(0);
  geom::Point at = lines[0].ends[1];
  while (chain.size() < lines.size()) {
    ask();
    bool crowded = false;
    const auto next = grid.nearest(at, crowded);
    if (crowded) {
      return refuse(name, fmt::format("more than {} ends of LINEs meet at ({}, {}) mm; that is not a contour",
                                      kMostEndsInOnePlace, at.x, at.y));
    }
    if (!next) break;
    grid.use(next->line);
    chain.push_back(*next);
    at = lines[next->line].ends[1 - next->entered_at];
  }
  const double gap = norm(lines[0].ends[0] - at);
  const bool closed = gap <= reach;
  if (closed && chain.size() == lines.size()) return chain;
  const DxfLine& last = lines[chain.back().line];
  if (closed) {
    return refuse(
        name, fmt::format("the LINEs form more than one contour: {} is not on the closed chain that begins "
                          "with {}; keep one contour in the file",
                          line_name(lines[grid.first_unused()]), line_name(lines[0])));
  }
  if (chain.size() == lines.size()) {
    return refuse(
        name, fmt::format("the chain of LINEs is not closed: {} ends at ({}, {}) mm, {:.6g} mm from where "
                          "{} begins",
                          line_name(last), at.x, at.y, gap, line_name(lines[0])));
  }
  return refuse(
      name, fmt::format("the chain of LINEs breaks where {} ends, at ({}, {}) mm: the nearest end of a LINE "
                        "not yet on it is {:.6g} mm away",
                        line_name(last), at.x, at.y, grid.distance_to_unused(at)));
}

}  // namespace lekalo::io
