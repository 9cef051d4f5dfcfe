#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/solid/vector.hpp"

namespace lekalo::locate {

/// The reason why no pose of a window has more clearance than a bound: a subdivision of the window into
/// boxes, each with terms whose weighted sum is not above 0 anywhere in it, though each of them would be
/// where the clearance, or with demands the margin, is above the bound. Those of datums and distances would
/// not be below 0 where these are kept. docs/formats.md ("Certificate of solids") has the terms.

/// A ball in the part's material (part coordinates), or one whose inside has none of the blank's (blank
/// coordinates).
struct SolidBall {
  solid::Vector centre;
  double radius = 0;  ///< mm, >= 0
};

/// A half-space without material of the blank: no vertex of it has a smaller product with the normal.
struct SolidPlane {
  solid::Vector normal;  ///< blank coordinates, of length 1 within rounding
  double least = 0;      ///< mm
};

/// A point of the part: v0 + u (v1 - v0) + v (v2 - v0) of a triangle, with u, v >= 0 and u + v <= 1.
struct SolidPoint {
  std::uint32_t triangle = 0;
  double u = 0, v = 0;
};

/// A point of a datum, by the numbers of both.
struct SolidDatumPoint {
  std::uint32_t datum = 0, point = 0;
};

/// The points at + x a + y b + z c with x, y, z from 0 to 1, none of which is nearer to the blank's surface
/// than a distance; blank coordinates.
struct SolidBody {
  solid::Vector at, a, b, c;
  double apart = 0;  ///< mm
  friend bool operator==(const SolidBody&, const SolidBody&) = default;
};

struct SolidTerm {
  enum class Kind : std::uint8_t {
    ball,         ///< a part ball and a blank ball
    plane,        ///< a part ball and a plane
    face,         ///< a part ball over a triangle of the blank
    part_face,    ///< a triangle of the part and a blank ball over it
    edges,        ///< an edge of the part and one of the blank
    point,        ///< a point of the part and a blank ball
    point_plane,  ///< a point of the part and a plane
    point_face,   ///< a point of the part over a triangle of the blank
    datum,        ///< a point of a datum and a direction
    near          ///< a point of the part that is near the blank's surface, and a side of a body
  };
  Kind kind = Kind::ball;
  /// The numbers of what the term is made of, in the tables of the proof or among the triangles of a mesh.
  /// Edge 3 f + k leads from corner k of triangle f to its next one; side 6 k + s of body k is x >= 0, x <=
  /// 1, y >= 0, y <= 1, z >= 0, z <= 1.
  std::uint32_t part = 0, blank = 0;
  std::uint32_t multiplier = 0;  ///< of any scale
};

/// A subdivision of a box of poses in preorder: a split is followed by its low half and its high half. A pose
/// is the place of the pivot in the blank's frame and a Cayley vector: with x = tan(angle / 2) times the axis
/// the part is turned by the rotation of the quaternion 1 + x after that of `quaternion`.
struct SolidTree {
  /// The freedoms in their order; mm, and no unit for those of the Cayley vector.
  enum class Axis : std::uint8_t { x, y, z, turn_x, turn_y, turn_z, leaf };
  struct Node {
    Axis axis = Axis::leaf;
    /// The place of the split.
    double at = 0;
    /// The terms of a leaf are terms[first, first + count).
    std::uint32_t first = 0, count = 0;
  };
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< w, x, y, z
  std::array<double, 6> low{}, high{};
  std::vector<Node> nodes;
  std::vector<SolidTerm> terms;
};

/// All of it. The tables hold what a term uses and nothing else.
struct SolidProof {
  solid::Vector pivot;  ///< part coordinates
  std::vector<SolidBall> part_balls, blank_balls;
  std::vector<SolidPoint> part_points;
  std::vector<SolidDatumPoint> datum_points;
  std::vector<solid::Vector> directions;  ///< blank coordinates, of length 1 within rounding
  std::vector<SolidPlane> planes;
  std::vector<SolidBody> bodies;
  /// They cover the window. Empty when nothing is proved.
  std::vector<SolidTree> trees;
};

}  // namespace lekalo::locate
