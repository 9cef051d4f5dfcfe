#include "columns.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "lekalo/layout/check.hpp"

namespace lekalo::nest {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRotation;
using layout::Document;
using layout::Placement;

std::int64_t width(const GridBox& box) { return box.high.x - box.low.x; }
std::int64_t height(const GridBox& box) { return box.high.y - box.low.y; }

/// A piece in one of its allowed positions, and the box that it has there.
struct Piece {
  GridRotation rotation;
  GridBox box;
};

/// Pieces of one part that wait for a place.
struct Alike {
  std::uint32_t part;
  Piece piece;
  std::size_t count;
};

/// The angle to which the columns turn a part: upright, lying, or the first that is allowed.
std::optional<Piece> turned_piece(const layout::Part& part, const layout::Stock& on) {
  std::vector<double> angles{0, 90, 180, 270};
  for (const layout::AngleRange& range : part.rotations) angles.push_back(range.from);
  for (const double degrees : angles) {
    const GridRotation rotation = geom::rotation_from_degrees(degrees);
    if (!rotation_allowed(part, rotation) || !grain_allowed(part, on, rotation, false)) continue;
    return Piece{rotation, geom::bounds(geom::turned(part.outline.polygon, rotation, false))};
  }
  return std::nullopt;
}

/// The free rest of one copy of a stock, with the column that is filled.
class Columns {
 public:
  Columns(const GridBox& room, std::int64_t gap)
      : room_(room), gap_(gap), column_(room.low), x_(room.low.x) {}

  /// Returns where the lower left corner of a box goes.
  std::optional<GridPoint> take(const GridBox& box) {
    GridPoint at = column_;
    if (at.y + height(box) > room_.high.y) at = {x_, room_.low.y};
    if (at.y + height(box) > room_.high.y || at.x + width(box) > room_.high.x) return std::nullopt;
    x_ = std::max(x_, at.x + width(box) + gap_);
    column_ = {at.x, at.y + height(box) + gap_};
    return at;
  }

 private:
  GridBox room_;
  std::int64_t gap_;
  GridPoint column_;
  std::int64_t x_;  ///< where the next column begins
};

/// A copy is full when so many pieces in a row find no room on it: otherwise each copy would be asked about
/// each piece.
constexpr std::size_t kMostMissed = 500;

/// Places pieces on the copies of one stock, one copy after the other; what finds no room is given back.
class Filler {
 public:
  Filler(Document& document, std::uint32_t stock) : document_(document), stock_(stock) {
    for (const layout::Part& part : document.parts) {
      gap_ = std::max(gap_, layout::gap_between(document, part, part));
      border_ = std::max(border_, layout::border_gap_of(document, part));
    }
    for (const Placement& p : document.placements) {
      if (p.stock != stock) continue;
      const std::int64_t far = geom::bounds(placed_outline(document.parts[p.part], p)).high.x + gap_;
      const auto [at, is_new] = used_.emplace(p.copy, far);
      at->second = std::max(at->second, far);
    }
  }

  std::vector<std::uint32_t> fill(const std::vector<std::uint32_t>& parts) {
    const layout::Stock& stock = document_.stocks[stock_];
    const GridBox whole = room();
    std::map<std::uint32_t, Piece> pieces;  // by part: those that an empty copy can hold
    for (const std::uint32_t part : std::set<std::uint32_t>(parts.begin(), parts.end()))
      if (const auto piece = turned_piece(document_.parts[part], stock);
          piece && width(piece->box) <= width(whole) && height(piece->box) <= height(whole))
        pieces.emplace(part, *piece);
    std::vector<std::uint32_t> fitting, left;
    for (const std::uint32_t part : parts) (pieces.count(part) > 0 ? fitting : left).push_back(part);
    std::stable_sort(fitting.begin(), fitting.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto rank = [&](std::uint32_t part) {
        return std::pair(-document_.parts[part].priority, -width(pieces.at(part).box));
      };
      return rank(a) < rank(b);
    });
    // Pieces of one part follow one another, and where one finds no room the others find none.
    std::list<Alike> open;
    for (const std::uint32_t part : fitting) {
      if (open.empty() || open.back().part != part) open.push_back({part, pieces.at(part), 0});
      ++open.back().count;
    }
    for (std::int64_t copy = 0; copy < stock.count && !open.empty(); ++copy) {
      Columns columns(room_of(copy), gap_);
      std::size_t missed = 0;
      for (auto at = open.begin(); at != open.end() && missed < kMostMissed;) {
        const auto corner = columns.take(at->piece.box);
        if (!corner) {
          missed += at->count, ++at;
          continue;
        }
        document_.placements.push_back({document_.next_id++, at->part, stock_, copy, at->piece.rotation,
                                        false, *corner - at->piece.box.low, false});
        missed = 0;
        if (--at->count == 0) at = open.erase(at);
      }
    }
    for (const Alike& rest : open) left.insert(left.end(), rest.count, rest.part);
    return left;
  }

 private:
  /// The room on a copy on which nothing lies.
  [[nodiscard]] GridBox room() const {
    const GridBox box = geom::bounds(document_.stocks[stock_].outline.polygon);
    return {box.low + GridPoint{border_, border_}, box.high - GridPoint{border_, border_}};
  }
  [[nodiscard]] GridBox room_of(std::int64_t copy) const {
    GridBox room = this->room();
    if (const auto used = used_.find(copy); used != used_.end())
      room.low.x = std::max(room.low.x, used->second);
    return room;
  }

  Document& document_;
  std::uint32_t stock_;
  std::int64_t gap_ = 0, border_ = 0;
  std::map<std::int64_t, std::int64_t> used_;  ///< by copy: how far to the right something lies
};

bool is_rectangle(const layout::Stock& stock) {
  const geom::GridRegion& outline = stock.outline.polygon;
  return geom::twice_area(outline) == geom::twice_area(geom::rectangle(geom::bounds(outline)));
}

/// Takes off what breaks a rule of the pieces with ids from `first` on.
void take_off_violations(Document& document, std::uint64_t first) {
  std::set<std::uint64_t> wrong;
  for (const layout::Violation& one : layout::check(document)) wrong.insert(std::max(one.a, one.b));
  std::erase_if(document.placements,
                [&](const Placement& p) { return p.id >= first && wrong.count(p.id) > 0; });
}

}  // namespace

void place_in_columns(Document& document, std::vector<Unplaced>& unplaced) {
  if (!document.kits.empty()) return;
  std::vector<std::uint32_t> open;
  for (const Unplaced& one : unplaced)
    if (one.reason == Reason::not_tried)
      open.insert(open.end(), static_cast<std::size_t>(one.count), one.part);
  if (open.empty()) return;
  std::vector<std::uint32_t> stocks;
  for (std::uint32_t s = 0; s < document.stocks.size(); ++s)
    if (is_rectangle(document.stocks[s])) stocks.push_back(s);
  std::stable_sort(stocks.begin(), stocks.end(), [&](std::uint32_t a, std::uint32_t b) {
    return document.stocks[a].cost < document.stocks[b].cost;
  });
  const std::uint64_t first = document.next_id;
  for (const std::uint32_t stock : stocks) open = Filler(document, stock).fill(open);
  take_off_violations(document, first);
  std::map<std::uint32_t, std::int64_t> placed;
  for (const Placement& p : document.placements)
    if (p.id >= first) ++placed[p.part];
  for (Unplaced& one : unplaced)
    if (one.reason == Reason::not_tried) one.count -= std::exchange(placed[one.part], 0);
  std::erase_if(unplaced, [](const Unplaced& one) { return one.count == 0; });
}

}  // namespace lekalo::nest
