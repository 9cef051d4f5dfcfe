#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "certificate_tables.hpp"
#include "solid_window.hpp"

namespace lekalo::verify {

/// A place of the part that goes away from a place of the blank's frame by no more than `within` in a
/// direction, of any length but 0.
struct HeldPoint {
  Both3 place, through, direction;
  Both within;
};

/// A term of a leaf, by what it bounds the clearance with.
struct LeafTerm {
  /// A term of a point has it as a ball of radius 0.
  enum class Kind : std::uint8_t {
    ball,
    plane,
    face,
    part_face,
    edges,
    point,
    point_plane,
    point_face,
    datum,
    near
  };
  Kind kind = Kind::ball;
  const Ball* part_ball = nullptr;
  const Ball* blank_ball = nullptr;
  const HalfSpace* plane = nullptr;
  const FarBody* body = nullptr;
  /// The number of a triangle or an edge of either mesh. Edge 3 f + k leads from corner k of triangle f to
  /// its next one.
  std::uint32_t part{}, blank{};
  Both multiplier;
  /// The bound in place of the leaf's, where the part's triangle has a demand of its own.
  const Both* bound = nullptr;
  /// There is one in a term of a datum, which has neither a bound nor a side of part and blank.
  std::optional<HeldPoint> held = std::nullopt;
  /// Says whether it is of the place of the part alone, so that it may be 0 where poses count.
  [[nodiscard]] bool of_place() const { return kind == Kind::datum || kind == Kind::near; }
};

/// The leaves of one tree have this in common. The placed part is T p = R(x) turn (p - pivot) + t.
struct LeafFrame {
  const SolidMesh& part;
  const SolidMesh& blank;
  SolidMotion turn;  ///< without a shift
  Both3 pivot;
  Both bound;
};

/// Says whether the terms show that no pose of the box has more clearance than the bound. Suppose one has.
/// Then every term is above 0 there:
///   ball:       |T a - c| - r - s - bound. If |T a - c| < r, c would lie in the part, s from the
///               material, so the bound must not be below -s.
///   half-space: (n . T a - b) / |n| - r - bound.
///   triangle of the blank, of the part: the height of the ball's centre over it less r and its width, or s,
///               and the bound, where the foot of the centre stays in the triangle and the height does not
///               fall below -r, or -s; the bound must not be below 0.
///   edges:      N - (w + bound) n . u, where N = n . (p - q) for a point p of the part's edge and q of the
///               blank's, and n their product over its length at the middle of the leaf, on the side where
///               N > 0. Here u is the direction of n at the middle, and not longer than 1. The edges have to
///               cross as seen along u. Then two of their points are N / (n . u) times u apart; the bound
///               must not be below 0.
///   point:      as a ball. It lies on the part's surface, and that needs no condition.
///   datum:      within |u| - u . (T p - q). It is not below 0 where the datum is kept, and no pose without
///               that counts.
///   near:       how far T p is outside of a body on one of its sides. On all others it is shown to be
///   inside.
///               As it is not inside on all of them where its distance from the blank's surface is kept, this
///               is not below 0, and no pose without that counts.
/// So their sum with the multipliers is above 0, and it is shown not to be; or, where all are of datums and
/// bodies, not below 0, and it is shown to be. With |w| <= (|w|^2 + l^2) / 2 l
/// for a ball, and times 1 + |x|^2, the sum is a polynomial of degree 2 in x, convex in t: it is nowhere
/// above the largest of its 27 Bernstein coefficients at the eight corners of the box of t. Spans decide that
/// nearly always, and else fractions.
[[nodiscard]] bool proves(const std::vector<LeafTerm>& terms, const PoseBox& box, const LeafFrame& frame);

}  // namespace lekalo::verify
