#include "profile_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

/// So many travels are compared in all exchanges of one program, which keeps 10,000 cuts within seconds.
constexpr std::size_t kMostComparisons = 60'000'000;
constexpr int kStartPasses = 3;

Point as_point(WrittenPoint p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
double travel(Point a, Point b) { return geom::norm(b - a); }

class Tour {
 public:
  Tour(const std::vector<Starts>& starts, const std::vector<std::size_t>& enclosing)
      : starts_(starts), inner_(starts.size()), chosen_(starts.size(), 0) {
    for (std::size_t cut = 0; cut < enclosing.size(); ++cut)
      (enclosing[cut] == cut ? outermost_ : inner_[enclosing[cut]]).push_back(cut);
  }

  std::vector<OrderedCut> make() {
    put(outermost_, {});
    for (int pass = 0; pass < kStartPasses; ++pass) choose_starts();
    std::vector<OrderedCut> order;
    for (const std::size_t cut : order_) order.push_back({cut, chosen_[cut]});
    return order;
  }

 private:
  [[nodiscard]] Point pierce(std::size_t cut, std::size_t start) const {
    return as_point(starts_[cut].choices[start].pierce);
  }
  [[nodiscard]] Point pierce(std::size_t cut) const { return pierce(cut, chosen_[cut]); }
  /// A cut ends where its contour began.
  [[nodiscard]] Point end(std::size_t cut, std::size_t start) const {
    return as_point(starts_[cut].choices[start].on_contour);
  }

  /// Appends cuts that do not wait for each other, each behind what it encloses. It calls itself as deep as
  /// parts lie in holes of parts; a stack of our own would not be smaller.
  /// \param then  the place where the way goes on
  void put(std::vector<std::size_t> cuts, Point then) {
    nearest_next(cuts);
    exchange(cuts, then);
    for (const std::size_t cut : cuts) {
      put(inner_[cut], pierce(cut));
      order_.push_back(cut);
      here_ = end(cut, chosen_[cut]);
    }
  }

  /// All starts of a cut lie in a disc. Most cuts are too far away for any of their starts to be the nearest,
  /// and the disc says so at once.
  struct Disc {
    Point centre;
    double radius = 0;
  };
  [[nodiscard]] Disc disc_of(std::size_t cut) const {
    Disc disc{pierce(cut, 0), 0};
    for (std::size_t start = 0; start < starts_[cut].choices.size(); ++start)
      disc.radius = std::max(disc.radius, travel(disc.centre, pierce(cut, start)));
    return disc;
  }

  void nearest_next(std::vector<std::size_t>& cuts) {
    std::vector<Disc> discs;
    for (const std::size_t cut : cuts) discs.push_back(disc_of(cut));
    Point from = here_;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      std::size_t best = k;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = k; i < cuts.size(); ++i) {
        ask();
        const Point out = discs[i].centre - from;
        const double reach = least + discs[i].radius;
        if (geom::dot(out, out) > reach * reach) continue;
        for (std::size_t start = 0; start < starts_[cuts[i]].choices.size(); ++start) {
          const double way = travel(from, pierce(cuts[i], start));
          if (way < least) least = way, best = i, chosen_[cuts[i]] = start;
        }
      }
      std::swap(cuts[k], cuts[best]);
      std::swap(discs[k], discs[best]);
      from = end(cuts[k], chosen_[cuts[k]]);
    }
  }

  /// Turns stretches of the tour round while that shortens it (2-opt). Travels within a stretch are taken for
  /// equally long both ways, because a cut's pierce and end lie only a lead apart; the ways to and from it
  /// count.
  void exchange(std::vector<std::size_t>& cuts, Point then) {
    const std::size_t n = cuts.size();
    std::vector<Point> at{here_};  // the tour: from here_, the pierces, then
    for (const std::size_t cut : cuts) at.push_back(pierce(cut));
    at.push_back(then);
    bool better = n > 2;
    while (better && comparisons_ < kMostComparisons) {
      better = false;
      for (std::size_t i = 1; i < n && comparisons_ < kMostComparisons; ++i) {
        comparisons_ += n - i;
        for (std::size_t j = i + 1; j <= n; ++j) {
          ask();
          const double old_way = travel(at[i - 1], at[i]) + travel(at[j], at[j + 1]);
          const double new_way = travel(at[i - 1], at[j]) + travel(at[i], at[j + 1]);
          if (!(new_way < old_way * (1 - 0x1p-40))) continue;
          const auto first = static_cast<std::ptrdiff_t>(i), last = static_cast<std::ptrdiff_t>(j);
          std::reverse(at.begin() + first, at.begin() + last + 1);
          std::reverse(cuts.begin() + first - 1, cuts.begin() + last);
          better = true;
        }
      }
    }
  }

  void choose_starts() {
    Point from{};
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const std::size_t cut = order_[k];
      const Point next = k + 1 < order_.size() ? pierce(order_[k + 1]) : Point{};
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t start = 0; start < starts_[cut].choices.size(); ++start) {
        const double way = travel(from, pierce(cut, start)) + travel(end(cut, start), next);
        if (way < least) least = way, chosen_[cut] = start;
      }
      from = end(cut, chosen_[cut]);
    }
  }

  const std::vector<Starts>& starts_;
  std::vector<std::vector<std::size_t>> inner_;  ///< by cut: what it directly encloses
  std::vector<std::size_t> outermost_, chosen_, order_;
  Point here_;
  std::size_t comparisons_ = 0;
};

}  // namespace

std::vector<std::size_t> enclosing_cuts(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                                        const Resolution& resolution) {
  std::vector<std::size_t> enclosing(cuts.size()), outline_of(parts.size());
  for (std::size_t c = 0; c < cuts.size(); ++c)
    if (cuts[c].outline) outline_of[cuts[c].part] = c;
  struct Hole {
    std::size_t cut;
    double area;
    geom::RegionIndex inside;
  };
  std::vector<Hole> holes;
  std::vector<geom::Box> boxes;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    enclosing[c] = cuts[c].outline ? c : outline_of[cuts[c].part];
    if (cuts[c].outline) continue;
    const geom::Region inside{geom::reversed(parts[cuts[c].part].region.holes[cuts[c].hole]), {}};
    holes.push_back({c, geom::area(inside), geom::RegionIndex({inside})});
    boxes.push_back(holes.back().inside.bounds());
  }
  const geom::BoxTree tree(boxes);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    if (!cuts[c].outline) continue;
    const Point at = resolution.mm(cuts[c].path.front().from);
    double least = std::numeric_limits<double>::infinity();
    tree.visit_meeting({at, at}, [&](std::uint32_t h) {
      if (!(holes[h].area < least) || !holes[h].inside.contains(at)) return;
      least = holes[h].area;
      enclosing[c] = holes[h].cut;
    });
  }
  return enclosing;
}

std::vector<OrderedCut> ordered_cuts(const std::vector<Starts>& starts,
                                     const std::vector<std::size_t>& enclosing) {
  return Tour(starts, enclosing).make();
}

}  // namespace lekalo::nc
