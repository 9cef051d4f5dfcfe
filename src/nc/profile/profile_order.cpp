#include "profile_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "common_lines.hpp"
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

/// Says which of some cuts may come next by their rings.
class Waiting {
 public:
  Waiting(const std::vector<Ring>& rings, const std::vector<std::size_t>& cuts) : rings_(rings) {
    for (const std::size_t cut : cuts) ++left_[rings[cut].heap][rings[cut].depth];
  }
  [[nodiscard]] bool may_come(std::size_t cut) const {
    return left_.at(rings_[cut].heap).rbegin()->first == rings_[cut].depth;
  }
  void take(std::size_t cut) {
    auto& of_heap = left_.at(rings_[cut].heap);
    if (--of_heap.at(rings_[cut].depth) == 0) of_heap.erase(rings_[cut].depth);
  }

 private:
  const std::vector<Ring>& rings_;
  std::map<std::size_t, std::map<std::size_t, std::size_t>> left_;  ///< by heap and depth
};

class Tour {
 public:
  Tour(const std::vector<Starts>& starts, const OrderRules& rules)
      : starts_(starts),
        rings_(rules.rings),
        inner_(starts.size()),
        chosen_(starts.size(), 0),
        heaps_(starts.size()) {
    const auto& enclosing = rules.enclosing;
    for (std::size_t cut = 0; cut < enclosing.size(); ++cut)
      (enclosing[cut] == cut ? outermost_ : inner_[enclosing[cut]]).push_back(cut);
  }

  std::vector<OrderedCut> make() {
    put(outermost_, {});
    place_.resize(starts_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) place_[order_[k]] = k;
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
    Waiting waiting(rings_, cuts);
    Point from = here_;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      std::size_t best = k;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = k; i < cuts.size(); ++i) {
        ask();
        const Point out = discs[i].centre - from;
        const double reach = least + discs[i].radius;
        if (geom::dot(out, out) > reach * reach || !waiting.may_come(cuts[i])) continue;
        for (std::size_t start = 0; start < starts_[cuts[i]].choices.size(); ++start) {
          const double way = travel(from, pierce(cuts[i], start));
          if (way < least) least = way, best = i, chosen_[cuts[i]] = start;
        }
      }
      std::swap(cuts[k], cuts[best]);
      std::swap(discs[k], discs[best]);
      waiting.take(cuts[k]);
      from = end(cuts[k], chosen_[cuts[k]]);
    }
  }

  /// Turns stretches of the tour round while that shortens it and none in them has to wait for another
  /// (2-opt). Travels within a stretch are taken for
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
        ++stretch_;
        (void)waits_in_stretch(cuts[i - 1]);
        for (std::size_t j = i + 1; j <= n; ++j) {
          ask();
          if (waits_in_stretch(cuts[j - 1])) break;
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

  /// Adds a cut to the stretch, and says whether another of its heap and of another depth is in it.
  bool waits_in_stretch(std::size_t cut) {
    HeapInStretch& heap = heaps_[rings_[cut].heap];
    if (heap.stretch != stretch_) heap = {stretch_, rings_[cut].depth};
    return heap.depth != rings_[cut].depth;
  }

  /// How many kerfs the lead of a start meets that are there before it.
  [[nodiscard]] std::size_t crossed(std::size_t cut, const Start& start) const {
    return start.unwelcome([&](std::size_t other) { return place_[other] < place_[cut]; });
  }

  void choose_starts() {
    Point from{};
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const std::size_t cut = order_[k];
      const Point next = k + 1 < order_.size() ? pierce(order_[k + 1]) : Point{};
      std::pair least{std::numeric_limits<std::size_t>::max(), std::numeric_limits<double>::infinity()};
      for (std::size_t start = 0; start < starts_[cut].choices.size(); ++start) {
        const double way = travel(from, pierce(cut, start)) + travel(end(cut, start), next);
        const std::pair here{crossed(cut, starts_[cut].choices[start]), way};
        if (here < least) least = here, chosen_[cut] = start;
      }
      from = end(cut, chosen_[cut]);
    }
  }

  const std::vector<Starts>& starts_;
  const std::vector<Ring>& rings_;
  std::vector<std::vector<std::size_t>> inner_;  ///< by cut: what it directly encloses
  std::vector<std::size_t> outermost_, chosen_, order_, place_;
  struct HeapInStretch {
    std::size_t stretch = 0, depth = 0;
  };
  std::vector<HeapInStretch> heaps_;
  std::size_t stretch_ = 0;
  Point here_;
  std::size_t comparisons_ = 0;
};

/// The order of cuts far from each other.
class SpreadTour {
 public:
  SpreadTour(const std::vector<Starts>& starts, const OrderRules& rules, const KerfsAround& kerfs,
             const Resolution& resolution)
      : starts_(starts),
        rules_(rules),
        kerfs_(kerfs),
        resolution_(resolution),
        inner_left_(starts.size(), 0),
        is_done_(starts.size(), false) {
    std::vector<std::size_t> all(starts.size());
    for (std::size_t cut = 0; cut < all.size(); ++cut) {
      all[cut] = cut;
      if (rules.enclosing[cut] != cut) ++inner_left_[rules.enclosing[cut]];
    }
    waiting_.emplace(rules.rings, all);
  }

  std::vector<OrderedCut> make() {
    std::vector<std::size_t> left(starts_.size());
    for (std::size_t cut = 0; cut < left.size(); ++cut) left[cut] = cut;
    while (!left.empty()) {
      const std::size_t at = next_of(left);
      const OrderedCut& next = order_.back();
      is_done_[next.cut] = true;
      waiting_->take(next.cut);
      if (rules_.enclosing[next.cut] != next.cut) --inner_left_[rules_.enclosing[next.cut]];
      here_ = resolution_.mm(starts_[next.cut].choices[next.start].on_contour);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return std::move(order_);
  }

 private:
  /// Ranks a start by the kerfs that its lead crosses, then by whether it is far
  /// enough from the last cut, then by a short way if it is, and else by a large distance.
  struct Merit {
    std::size_t crossed = std::numeric_limits<std::size_t>::max();
    bool near = true;
    double way = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool operator<(const Merit& other) const {
      return std::tie(crossed, near, way) < std::tie(other.crossed, other.near, other.way);
    }
  };

  [[nodiscard]] Merit merit_of(const Start& start) const {
    Merit merit;
    merit.crossed = static_cast<std::size_t>(std::count_if(
        start.met.begin(), start.met.end(), [&](std::size_t other) { return bool(is_done_[other]); }));
    const Point pierce = resolution_.mm(start.pierce);
    const bool far = order_.empty() || kerfs_.is_apart(order_.back().cut, pierce, rules_.heat_spread_mm);
    merit.near = !far;
    merit.way = far ? travel(here_, pierce) : -kerfs_.distance(order_.back().cut, pierce);
    return merit;
  }

  /// Appends the best next cut to the order, and returns its place in `left`.
  std::size_t next_of(const std::vector<std::size_t>& left) {
    Merit best;
    std::size_t at = 0;
    OrderedCut next;
    for (std::size_t k = 0; k < left.size(); ++k) {
      ask();
      const std::size_t cut = left[k];
      if (inner_left_[cut] > 0 || !waiting_->may_come(cut)) continue;
      for (std::size_t start = 0; start < starts_[cut].choices.size(); ++start) {
        const Merit merit = merit_of(starts_[cut].choices[start]);
        if (merit < best) best = merit, at = k, next = {cut, start};
      }
    }
    order_.push_back(next);
    return at;
  }

  const std::vector<Starts>& starts_;
  const OrderRules& rules_;
  const KerfsAround& kerfs_;
  Resolution resolution_;
  std::vector<std::size_t> inner_left_;  ///< by cut: what it encloses and is not cut yet
  std::vector<bool> is_done_;
  std::optional<Waiting> waiting_;
  std::vector<OrderedCut> order_;
  Point here_;
};

}  // namespace

std::vector<std::size_t> enclosing_cuts(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                                        const Resolution& resolution) {
  std::vector<std::size_t> enclosing(cuts.size()), outline_of(parts.size());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    if (!cuts[c].outline) continue;
    outline_of[cuts[c].part] = c;
    for (const std::size_t member : cuts[c].members) outline_of[member] = c;
  }
  struct Hole {
    std::size_t cut;
    double area;
    geom::RegionIndex inside;
  };
  std::vector<Hole> holes;
  std::vector<geom::Box> boxes;
  const auto add_hole = [&](std::size_t cut, const geom::Contour& hole) {
    const geom::Region inside{geom::reversed(hole), {}};
    holes.push_back({cut, geom::area(inside), geom::RegionIndex({inside})});
    boxes.push_back(holes.back().inside.bounds());
  };
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    enclosing[c] = cuts[c].outline ? c : outline_of[cuts[c].part];
    if (cuts[c].is_hole()) add_hole(c, parts[cuts[c].part].region.holes[cuts[c].hole]);
    if (cuts[c].outline && !cuts[c].members.empty())
      for (const geom::Contour& pocket : parts[cuts[c].part].region.holes) add_hole(c, pocket);
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

void put_common_cuts_in_order(const CommonCuts& common, const std::vector<Cut>& cuts,
                              const std::vector<Starts>& starts, const ProfileOptions& options,
                              std::vector<OrderedCut>& order) {
  if (common.clusters.empty()) return;
  const Resolution resolution = resolution_of(options);
  // An outline that began beside the end of a line would leave a part there by a hair until it comes back.
  const auto is_at_line = [&](const CommonCluster* cluster, WrittenPoint p) {
    return cluster != nullptr &&
           std::any_of(cluster->inner.begin(), cluster->inner.end(), [&](std::size_t cut) {
             if (!cuts[cut].is_line) return false;
             const Point at = resolution.mm(p), from = resolution.mm(cuts[cut].path.front().from),
                         to = resolution.mm(cuts[cut].path.back().to);
             return !(std::min(geom::norm(from - at), geom::norm(to - at)) > kHoldingKerfs * options.kerf_mm);
           });
  };
  std::vector<bool> is_inner(cuts.size(), false);
  std::vector<const CommonCluster*> cluster_of(cuts.size(), nullptr);
  for (const CommonCluster& cluster : common.clusters) {
    cluster_of[cluster.outline] = &cluster;
    for (const std::size_t cut : cluster.inner) is_inner[cut] = true;
  }
  std::vector<OrderedCut> anew;
  for (const OrderedCut& ordered : order) {
    if (is_inner[ordered.cut]) continue;
    if (const CommonCluster* cluster = cluster_of[ordered.cut])
      for (const std::size_t cut : cluster->inner) anew.push_back({cut, 0});
    anew.push_back(ordered);
  }
  std::vector<bool> is_there(cuts.size(), false);
  Point here;
  for (OrderedCut& ordered : anew) {
    const Cut& cut = cuts[ordered.cut];
    const std::vector<Start>& choices = starts[ordered.cut].choices;
    if (is_inner[ordered.cut] || cluster_of[ordered.cut] != nullptr) {
      std::tuple least{std::numeric_limits<std::size_t>::max(), false, std::size_t{0},
                       std::numeric_limits<double>::infinity()};
      for (std::size_t k = 0; k < choices.size(); ++k) {
        const std::tuple merit{choices[k].unwelcome([&](std::size_t other) { return bool(is_there[other]); }),
                               is_at_line(cluster_of[ordered.cut], choices[k].on_contour), choices[k].bends,
                               travel(here, resolution.mm(choices[k].pierce))};
        if (merit < least) least = merit, ordered.start = k;
      }
    }
    is_there[ordered.cut] = true;
    const Start& start = choices[ordered.start];
    const WrittenPoint end = !cut.is_line     ? start.on_contour
                             : start.from_end ? cut.path.front().from
                                              : cut.path.back().to;
    here = resolution.mm(end);
  }
  order = std::move(anew);
}

std::vector<OrderedCut> ordered_cuts(const std::vector<Starts>& starts, const OrderRules& rules,
                                     const KerfsAround& kerfs, const Resolution& resolution) {
  if (rules.heat_spread_mm > 0) return SpreadTour(starts, rules, kerfs, resolution).make();
  return Tour(starts, rules).make();
}

}  // namespace lekalo::nc
