#include "arrangement.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "point_table.hpp"

namespace lekalo::geom::detail {
namespace {

/// A vertex that a piece passes through.
struct Stop {
  std::uint32_t piece, vertex;
  double along;
};

/// Steps 1 and 2 of docs/design/boolean.md.
class Arranger {
 public:
  Arranger(const Outlines& outlines, double snap) : outlines_(outlines) { made_.snap = snap; }

  Arrangement run() {
    cut_into_pieces();
    if (!snap_points()) {
      made_ = {};
      made_.too_much = true;
      return std::move(made_);
    }
    stop_at_vertices();
    cut_into_stretches();
    merge_coinciding();
    return std::move(made_);
  }

 private:
  void cut_into_pieces() {
    for (std::uint32_t i = 0; i < outlines_.edges.size(); ++i)
      append_pieces(outlines_.edges[i], i, 0.25 * made_.snap, made_.pieces);
  }

  /// The points of the operands come first, so that they stay where they are. Returns false where more meets
  /// than limits let through.
  bool snap_points() {
    PointTable table(made_.snap, 2 * made_.pieces.size());
    for (const Edge& edge : outlines_.edges) table.snapped(edge.from);
    for (const Piece& piece : made_.pieces)
      ends_.push_back({table.snapped(piece.from), table.snapped(piece.to)});

    std::vector<Box> boxes;
    for (const Piece& piece : made_.pieces) boxes.push_back(grown(box_of(piece), made_.snap));
    const BoxTree tree(boxes);
    const std::size_t most = limits::most_meeting_pieces(made_.pieces.size());
    std::size_t seen = 0, met = 0;
    const bool all = tree.visit_pairs_while([&](std::uint32_t i, std::uint32_t j) {
      const Crossings found = crossings(made_.pieces[i], made_.pieces[j], made_.snap);
      for (int k = 0; k < found.count; ++k) table.snapped(found.points[static_cast<std::size_t>(k)]);
      met += static_cast<std::size_t>(found.count);
      return ++seen <= most && met <= limits::kMostCrossings;
    });
    made_.vertices = table.points();
    const auto stop_pieces_at = [&](std::uint32_t v) {
      const Box around = grown({made_.vertices[v], made_.vertices[v]}, kHot * made_.snap);
      return tree.visit_meeting_while(around, [&](std::uint32_t i) {
        consider(i, v);
        return ++seen <= 2 * most;
      });
    };
    for (std::uint32_t v = 0; all && v < made_.vertices.size(); ++v)
      if (!stop_pieces_at(v)) return false;
    return all;
  }

  /// Stops piece i at vertex v if the piece passes through it.
  void consider(std::uint32_t i, std::uint32_t v) {
    ask();
    const Piece& piece = made_.pieces[i];
    if (v == ends_[i][0] || v == ends_[i][1]) return;
    const Point p = made_.vertices[v];
    if (!(std::abs(side(piece, p)) <= kHot * made_.snap)) return;
    const double at = along(piece, p);
    if (!(at > 0 && at < length_squared(piece))) return;
    // Two pieces from one vertex whose other ends are near each other must not each pass through the end of
    // the other. The wedge between them would be turned inside out, and would open a crack as long as they
    // are.
    const Point from = made_.vertices[ends_[i][0]], to = made_.vertices[ends_[i][1]];
    const double whole = norm(to - from);
    if (norm(p - from) < whole && norm(p - to) < whole) stops_.push_back({i, v, at});
  }

  void stop_at_vertices() {
    std::sort(stops_.begin(), stops_.end(), [](const Stop& a, const Stop& b) {
      if (a.piece != b.piece) return a.piece < b.piece;
      return a.along != b.along ? a.along < b.along : a.vertex < b.vertex;
    });
  }

  void cut_into_stretches() {
    std::size_t stop = 0;
    for (std::uint32_t i = 0; i < made_.pieces.size(); ++i) {
      while (made_.origin_starts.size() <= made_.pieces[i].origin)
        made_.origin_starts.push_back(static_cast<std::uint32_t>(made_.stretches.size()));
      std::uint32_t at = ends_[i][0];
      for (; stop < stops_.size() && stops_[stop].piece == i; ++stop)
        at = stretch(i, at, stops_[stop].vertex);
      stretch(i, at, ends_[i][1]);
    }
    while (made_.origin_starts.size() <= outlines_.edges.size())
      made_.origin_starts.push_back(static_cast<std::uint32_t>(made_.stretches.size()));
  }

  std::uint32_t stretch(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
    if (from == to) return to;
    Stretch s{from, to, i, false, 0};
    const Piece& piece = made_.pieces[i];
    if (is_arc(piece)) {
      const double half = 0.5 * norm(made_.vertices[to] - made_.vertices[from]), r = piece.radius;
      const double height = half * half / (r + std::sqrt(std::max(0.0, (r - half) * (r + half))));
      s.curved = 2 * half >= kShortArc * made_.snap && height >= 0.25 * made_.snap;
      if (s.curved) s.height = piece.kind == EdgeKind::arc_ccw ? -height : height;
    }
    made_.stretches.push_back(s);
    return to;
  }

  /// Makes one edge of stretches between the same vertices whose middles are closer than two snaps.
  void merge_coinciding() {
    struct Candidate {
      std::uint32_t low, high;  ///< vertices
      /// The height of the middle on the left of the way from low to high.
      double height;
      std::uint32_t stretch;
    };
    std::vector<Candidate> all;
    for (std::uint32_t i = 0; i < made_.stretches.size(); ++i) {
      const Stretch& s = made_.stretches[i];
      all.push_back(s.from < s.to ? Candidate{s.from, s.to, s.height, i}
                                  : Candidate{s.to, s.from, -s.height, i});
    }
    std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
      if (a.low != b.low) return a.low < b.low;
      if (a.high != b.high) return a.high < b.high;
      return a.height != b.height ? a.height < b.height : a.stretch < b.stretch;
    });
    std::vector<std::uint32_t> first_of(made_.stretches.size());
    for (std::size_t i = 0; i < all.size();) {
      std::size_t end = i;
      MapEdge edge{all[i].stretch, {}};
      // The weights along the way from low to high.
      std::array<std::int32_t, Outlines::kOperands> upwards{};
      for (; end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high &&
             all[end].height - all[i].height <= 2 * made_.snap;
           ++end) {
        const Stretch& s = made_.stretches[all[end].stretch];
        upwards[outlines_.operand[made_.pieces[s.piece].origin]] += s.from < s.to ? 1 : -1;
        edge.stretch = std::min(edge.stretch, all[end].stretch);
      }
      for (std::size_t k = i; k < end; ++k) first_of[all[k].stretch] = edge.stretch;
      const Stretch& shape = made_.stretches[edge.stretch];
      bool any = outlines_.loose;
      for (std::size_t k = 0; k < upwards.size(); ++k) {
        edge.weight[k] = shape.from < shape.to ? upwards[k] : -upwards[k];
        any = any || upwards[k] != 0;
      }
      const double length = norm(made_.vertices[shape.to] - made_.vertices[shape.from]);
      if (any || length <= kShortGap * made_.snap) made_.edges.push_back(edge);
      i = end;
    }
    std::sort(made_.edges.begin(), made_.edges.end(),
              [](const MapEdge& a, const MapEdge& b) { return a.stretch < b.stretch; });
    std::vector<std::uint32_t> edge_of_first(made_.stretches.size(), kNoEdge);
    for (std::uint32_t e = 0; e < made_.edges.size(); ++e) edge_of_first[made_.edges[e].stretch] = e;
    made_.edge_of_stretch.resize(made_.stretches.size());
    for (std::uint32_t i = 0; i < first_of.size(); ++i) made_.edge_of_stretch[i] = edge_of_first[first_of[i]];
  }

  const Outlines& outlines_;
  Arrangement made_;
  /// By piece: its two vertices.
  std::vector<std::array<std::uint32_t, 2>> ends_;
  std::vector<Stop> stops_;
};

}  // namespace

Piece piece_between(const Arrangement& a, const Stretch& s) {
  Piece piece = a.pieces[s.piece];
  piece.from = a.vertices[s.from];
  piece.to = a.vertices[s.to];
  if (!s.curved) piece.kind = EdgeKind::line;
  return piece;
}

void Outlines::add(const Contour& contour, std::uint8_t operand_of_all) {
  const auto first = static_cast<std::uint32_t>(edges.size());
  const auto count = static_cast<std::uint32_t>(contour.size());
  edges.insert(edges.end(), contour.begin(), contour.end());
  operand.insert(operand.end(), contour.size(), operand_of_all);
  for (std::uint32_t i = 0; i < count; ++i) next.push_back(first + (i + 1 == count ? 0 : i + 1));
}

void Outlines::add(const std::vector<Region>& regions, std::uint8_t operand_of_all) {
  for (const Region& region : regions) {
    add(region.outer, operand_of_all);
    for (const Contour& hole : region.holes) add(hole, operand_of_all);
  }
}

double extent(const Outlines& outlines) noexcept {
  double largest = 0;
  const auto include = [&largest](Point p, double r) {
    largest = std::max({largest, std::abs(p.x) + r, std::abs(p.y) + r});
  };
  for (const Edge& edge : outlines.edges) {
    include(edge.from, 0);
    if (edge.kind != EdgeKind::line) include(edge.centre, arc_radius(edge));
  }
  return largest;
}

Arrangement arrange(const Outlines& outlines, double snap) { return Arranger(outlines, snap).run(); }

}  // namespace lekalo::geom::detail
