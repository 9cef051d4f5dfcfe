#include "near.hpp"

#include <utility>

#include "verify/shape/shape_distance.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

std::vector<Box> boxes_of(const std::vector<CurvePiece>& pieces) {
  std::vector<Box> boxes;
  for (const CurvePiece& piece : pieces) {
    const Box box = box_of(piece.side);
    const double by = piece.off + piece.more;
    const Span off{-by, by};
    boxes.push_back({(just(box.low_x) + off).low, (just(box.low_y) + off).low, (just(box.high_x) + off).high,
                     (just(box.high_y) + off).high});
  }
  return boxes;
}

/// Arcs are cut into parts of less than half a turn, whose corners are known; a line is said to turn by less.
void add_short(const CurvePiece& piece, std::vector<CurvePiece>& to) {
  if (piece.side.sweep == Sweep::less) return to.push_back(piece);
  for (const Side& half : halves(piece.side)) add_short({half, piece.off, piece.more}, to);
}

}  // namespace

CurvePieces::CurvePieces(std::vector<CurvePiece> pieces)
    : pieces_(std::move(pieces)), index_(boxes_of(pieces_)) {}

std::optional<Vec> CurvePieces::first_not_within(const std::vector<CurvePiece>& pieces, double reach,
                                                 std::size_t& work, std::size_t most_work) const {
  struct Open {
    CurvePiece piece;
    int depth = 0;
  };
  // A part of a curve of 1 m is shorter than any tolerance after so many halvings.
  constexpr int kDeepestHalving = 60;
  for (const CurvePiece& whole : pieces) {
    std::vector<CurvePiece> parts;
    add_short(whole, parts);
    std::vector<Open> open;
    for (const CurvePiece& part : parts) open.push_back({part, 0});
    while (!open.empty()) {
      const Open top = open.back();
      open.pop_back();
      const Side& piece = top.piece.side;
      const Corners corners = corners_of(piece);
      bool within = false;
      double limit = reach;
      // A curve that all of the piece is near to is near to its beginning, whose box meets fewer than its
      // own.
      index_.visit_near(box_of(corners.at[0]), limit, [&](std::size_t k) {
        if (within) return void(limit = -1);  // no box is so near, which ends the walk
        ++work;
        const CurvePiece& other = pieces_[k];
        const Span off = just(farthest(piece, corners, other.side)) + just(top.piece.off) + just(other.off);
        within = off.high <= reach + other.more;
      });
      if (within) continue;
      if (top.depth == kDeepestHalving || work > most_work) return piece.from;
      for (const Side& half : halves(piece)) open.push_back({{half, top.piece.off, 0}, top.depth + 1});
    }
  }
  return std::nullopt;
}

std::vector<CurvePiece> pieces_of(const Shape& shape) {
  std::vector<CurvePiece> pieces;
  for (const Side& side : shape.sides) pieces.push_back({side, 0, 0});
  return pieces;
}

}  // namespace lekalo::verify
