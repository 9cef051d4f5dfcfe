#include "loose_check.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

constexpr double kLongestLoosePiece = 20;  // mm
/// Kerfs that only touch leave nothing between them, and nothing is said of that.
constexpr double kMeetingReserve = 1e-6;  // mm

/// How often a straight way crosses the ray from p to the right: upwards counts 1, downwards -1.
int windings(Place from, Place to, Place p) {
  const int upwards = static_cast<int>(from.y <= p.y) - static_cast<int>(to.y <= p.y);
  if (upwards == 0) return 0;
  const double x = from.x + (p.y - from.y) / (to.y - from.y) * (to.x - from.x);
  return x > p.x ? upwards : 0;
}

/// The nearest places of two short pieces, within what an arc is off its chord.
std::pair<Place, Place> nearest_places(const Stroke& a, const Stroke& b) {
  std::vector<Place> crossings;
  add_crossings(a, b, crossings);
  if (!crossings.empty()) return {crossings[0], crossings[0]};
  std::pair best{a.from, nearest_on(b, a.from)};
  for (const std::pair<Place, Place>& other :
       {std::pair{a.to, nearest_on(b, a.to)}, {nearest_on(a, b.from), b.from}, {nearest_on(a, b.to), b.to}})
    if (length(other.second - other.first) < length(best.second - best.first)) best = other;
  return best;
}

/// Ways between cuts, each with its windings: a tree, and what closes a loop in it.
class WindingTree {
 public:
  explicit WindingTree(std::size_t count) : parent_(count), to_parent_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// Joins two cuts by a way with so many windings; true where there is a way with others already.
  bool join(std::size_t a, std::size_t b, int way) {
    const auto [root_a, from_a] = root_of(a);
    const auto [root_b, from_b] = root_of(b);
    if (root_a == root_b) return from_a != way + from_b;
    parent_[root_a] = root_b;
    to_parent_[root_a] = way + from_b - from_a;
    return false;
  }

 private:
  /// The root, and the windings of the way to it.
  std::pair<std::size_t, int> root_of(std::size_t a) {
    int way = 0;
    while (parent_[a] != a) {
      // Halving the path keeps later ways short; a root is its own parent, with no windings between.
      const std::size_t up = parent_[a];
      to_parent_[a] += to_parent_[up];
      parent_[a] = parent_[up];
      way += to_parent_[a];
      a = parent_[a];
    }
    return {a, way};
  }

  std::vector<std::size_t> parent_;
  std::vector<int> to_parent_;
};

}  // namespace

void LooseCheck::add(const Strokes& edges, std::size_t of) {
  Cut cut{pieces_.size(), 0, of};
  // Arcs are off their chords by little against the half kerf that p is away.
  const double off = 0.05 * kerf_;
  for (const Stroke& edge : edges)
    add_pieces(edge,
               edge.arc ? std::min(kLongestLoosePiece, std::sqrt(8 * edge.radius * off)) : kLongestLoosePiece,
               pieces_);
  cut.last = pieces_.size();
  cut_of_piece_.resize(cut.last, cuts_.size());
  cuts_.push_back(cut);
  is_ready_ = false;
}

void LooseCheck::find_meetings() {
  meetings_.clear();
  StrokeExtent extent;
  extent.add(pieces_);
  StrokeIndex index(extent.low, extent.high, kLongestLoosePiece);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    ask();
    near.clear();
    index.near(at_share(pieces_[i], 0.5), 0.5 * length(pieces_[i]) + kerf_, near);
    for (const std::uint32_t j : near) {
      const auto [on_i, on_j] = nearest_places(pieces_[i], pieces_[j]);
      if (!(length(on_j - on_i) < kerf_ - kMeetingReserve)) continue;
      meetings_.push_back({j, i, on_j, on_i});
    }
    index.add(i, pieces_[i]);
  }
  is_ready_ = true;
}

bool LooseCheck::kerfs_meet() {
  if (!is_ready_) find_meetings();
  // Neighbours along one cut meet always.
  return std::any_of(meetings_.begin(), meetings_.end(), [&](const Meeting& meeting) {
    return cuts_[cut_of_piece_[meeting.a]].of != cuts_[cut_of_piece_[meeting.b]].of ||
           meeting.b > meeting.a + 3;
  });
}

bool LooseCheck::is_loose(Place p, std::size_t before, std::size_t of) {
  if (!is_ready_) find_meetings();
  steps_ += pieces_.size() + meetings_.size();
  ask();
  const auto counts = [&](std::uint32_t piece) {
    const std::size_t cut = cut_of_piece_[piece];
    return cut < before && cuts_[cut].of != of;
  };
  // The windings from the beginning of each cut to the beginning of each of its pieces.
  std::vector<int> along(pieces_.size(), 0);
  for (std::size_t cut = 0; cut < before; ++cut)
    for (std::size_t i = cuts_[cut].first + 1; i < cuts_[cut].last; ++i)
      along[i] = along[i - 1] + windings(pieces_[i - 1].from, pieces_[i - 1].to, p);
  WindingTree tree(cuts_.size());
  for (const Meeting& meeting : meetings_) {
    if (!counts(meeting.a) || !counts(meeting.b)) continue;
    const Place from = pieces_[meeting.a].from, to = pieces_[meeting.b].from;
    const int way = along[meeting.a] + windings(from, meeting.on_a, p) +
                    windings(meeting.on_a, meeting.on_b, p) + windings(meeting.on_b, to, p) -
                    along[meeting.b];
    if (tree.join(cut_of_piece_[meeting.a], cut_of_piece_[meeting.b], way)) return true;
  }
  return false;
}

double LooseCheck::begins_at(const Meeting& meeting) const {
  const Stroke &later = pieces_[meeting.b], &earlier = pieces_[meeting.a];
  const auto meets = [&](Place p) { return distance(p, earlier) < kerf_ - kMeetingReserve; };
  if (meets(later.from)) return 0;
  // The distance of a straight piece from another falls up to the nearest place.
  const double whole = length(later);
  double apart = 0, together = std::min(1.0, length(until(later, meeting.on_b)) / whole);
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (apart + together);
    (meets(at_share(later, middle)) ? together : apart) = middle;
  }
  return apart;
}

std::optional<LooseCheck::Moment> LooseCheck::parted_at(Place p, std::optional<Place> q) {
  if (!is_ready_) find_meetings();
  steps_ += pieces_.size() + meetings_.size();
  ask();
  const auto turns = [&](Place from, Place to) {
    return windings(from, to, p) - (q ? windings(from, to, *q) : 0);
  };
  std::vector<int> along(pieces_.size(), 0);
  for (const Cut& cut : cuts_)
    for (std::size_t i = cut.first + 1; i < cut.last; ++i)
      along[i] = along[i - 1] + turns(pieces_[i - 1].from, pieces_[i - 1].to);
  const auto join = [&](WindingTree& tree, const Meeting& meeting) {
    const Place from = pieces_[meeting.a].from, to = pieces_[meeting.b].from;
    const int way = along[meeting.a] + turns(from, meeting.on_a) + turns(meeting.on_a, meeting.on_b) +
                    turns(meeting.on_b, to) - along[meeting.b];
    return tree.join(cut_of_piece_[meeting.a], cut_of_piece_[meeting.b], way);
  };
  WindingTree tree(cuts_.size());
  const auto closing =
      std::find_if(meetings_.begin(), meetings_.end(), [&](const Meeting& m) { return join(tree, m); });
  if (closing == meetings_.end()) return std::nullopt;
  // The last piece may meet several: the meeting that closes the ring is looked for in the order of the cut.
  WindingTree before(cuts_.size());
  auto own = meetings_.begin();
  for (; own->b < closing->b; ++own) join(before, *own);
  std::vector<std::pair<double, const Meeting*>> by_share;
  for (; own != meetings_.end() && own->b == closing->b; ++own) by_share.emplace_back(begins_at(*own), &*own);
  std::sort(by_share.begin(), by_share.end());
  const auto first = std::find_if(by_share.begin(), by_share.end(),
                                  [&](const auto& one) { return join(before, *one.second); });
  return Moment{closing->b, first->first};
}

}  // namespace lekalo::verify
