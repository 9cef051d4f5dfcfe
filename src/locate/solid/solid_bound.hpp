#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/locate/solid_proof.hpp"
#include "solid_form.hpp"

namespace lekalo::locate {

/// A triangle that balls lie over; one of the part as seen from the pivot, turned as at the chart's start.
struct SolidFace {
  std::uint32_t triangle = 0;
  solid::Vector normal;
  /// The corners, and from each to the next one the direction that leads from the edge into the triangle.
  std::array<solid::Vector, 3> corner, inward;
  /// A height over it may be off by this for what its corners are off, mm.
  double loss = 0;
  double width = 0;  ///< the least it has, mm
};

/// An edge of the part, from the pivot and turned as at the chart's start, and one of the blank that passes
/// it.
struct SolidEdges {
  std::uint32_t part_edge = 0, blank_edge = 0;  ///< as in SolidTerm
  solid::Vector p, d, q, g;                     ///< from p to p + d, and from q to q + g
  double off = 0;                               ///< what corners are off, mm
  double width = 0;                             ///< of the blank's triangle, mm, the least it has
};

/// A point of a datum, from the pivot and turned as at the chart's start, that may not go far in a direction.
struct SolidHeld {
  SolidDatumPoint point;
  solid::Vector seen, direction;
};

/// A point of the part that may not be in a body far from the blank's surface.
struct SolidAway {
  solid::Vector seen;  ///< from the pivot and turned as at the chart's start
  double loss = 0;     ///< it may be off by this, mm
  SolidBody body;
  std::vector<BodySide> sides;
};

/// A contact that was met at some pose, and what terms can be made of it. The smallest ball of each kind lies
/// beside the point of contact itself. Which term is best depends on the box of poses.
struct KnownSolid {
  struct PartBall {
    SolidBall ball;
    solid::Vector seen;  ///< its centre from the pivot, turned as at the chart's start
    double loss = 0;     ///< its centre may be off by this, mm
    [[nodiscard]] double radius() const { return ball.radius - loss; }
  };
  std::vector<PartBall> part;
  /// The part's point of contact itself, a ball of radius 0, where triangles have demands; and the demand
  /// there.
  std::optional<PartBall> point;
  SolidPoint on_part;
  SolidDemand demand;
  std::vector<SolidBall> blank;
  SolidPlane plane;
  std::optional<SolidFace> part_face, blank_face;
  std::optional<SolidEdges> edges;
  /// A contact of a datum has this, and nothing else.
  std::optional<SolidHeld> held;
  /// One of a point that is to be near the blank's surface has its place in `on_part`, and this.
  std::optional<SolidAway> away;
};

/// One term of a contact: numbers among its balls, where it is made of some; `part` is a side of its body.
struct SolidChoice {
  SolidTerm::Kind kind = SolidTerm::Kind::plane;
  std::uint16_t part = 0, blank = 0;
};

/// A term over a box. It bounds the margin, and so does a sum of terms with multipliers, unless the bound is
/// below `least` of one of them.
struct SolidForm {
  PoseForm form;
  double least = 0;
  /// True where there are several demands, and that of the term is the least at the bound: then the form is
  /// one of the allowance, from which the demand is still to be taken.
  bool open = false;
  double scale = 1;  ///< of the demand
};

struct SolidRow {
  LinearBound<6> bound;  ///< of the margin
  SolidChoice choice;
  double scale = 1;  ///< of the demand
};

/// Makes contacts known, and terms of them for boxes of poses (docs/formats.md, "Certificate of solids"). Its
/// answers depend on their arguments alone.
class SolidBounds {
 public:
  explicit SolidBounds(const SolidMeter& meter);

  /// A contact that was met at a pose, for boxes of its chart. None if there is no ball on one of the two
  /// sides.
  [[nodiscard]] std::optional<KnownSolid> known(const SolidContact& contact, const FramedPose& pose) const;
  /// The term of a contact that says most about a box, and the row of the program that stands for it.
  [[nodiscard]] std::optional<SolidRow> row(const KnownSolid& known, const CellView& cell) const;
  /// The bound of a term at the middle of a box, and infinity where it does not hold all over
  /// it.
  [[nodiscard]] double level(const KnownSolid& known, SolidChoice choice, const CellView& cell) const;
  /// A term for a box, or none where it does not hold all over it.
  [[nodiscard]] std::optional<SolidForm> form(const KnownSolid& known, SolidChoice choice,
                                              const CellView& cell) const;
  /// The bound of a sum of terms, of which some are open.
  [[nodiscard]] double most(const PoseForm& sum, const PoseForm& open, const CellView& cell) const;

 private:
  /// A mesh and its balls.
  struct Side {
    const solid::Mesh& mesh;
    const solid::TriangleTree& tree;
    bool material;                      ///< balls lie in it, or outside
    double error;                       ///< the true surface may be off by this, mm
    const std::vector<double>& widths;  ///< of its triangles, or none
  };
  [[nodiscard]] double off(const Side& side, solid::Vector centre) const;
  [[nodiscard]] std::optional<SolidBall> ball(const Side& side, solid::Vector centre,
                                              std::uint32_t near) const;
  [[nodiscard]] std::vector<SolidBall> balls(const Side& side, std::uint32_t triangle, solid::Vector from,
                                             solid::Vector direction, double farthest) const;
  [[nodiscard]] std::optional<SolidFace> face(const Side& side, std::uint32_t triangle) const;
  [[nodiscard]] std::optional<SolidEdges> edges(const SolidContact& contact,
                                                const solid::Motion& start) const;
  void set_plane(solid::Vector normal, KnownSolid& made) const;
  [[nodiscard]] KnownSolid held(const SolidContact& contact, const solid::Motion& start) const;
  [[nodiscard]] PoseForm form_of(const SolidHeld& held, const CellView& cell) const;
  [[nodiscard]] std::optional<SolidForm> form_of_allowance(const KnownSolid& known, SolidChoice choice,
                                                           const CellView& cell) const;
  [[nodiscard]] std::optional<KnownSolid> away(const SolidContact& contact, const solid::Motion& start,
                                               const solid::Motion& motion) const;
  [[nodiscard]] std::optional<std::uint16_t> side_in_doubt(const SolidAway& away, const CellView& cell) const;
  [[nodiscard]] PoseForm form_of(const SolidAway& away, std::uint16_t side, const CellView& cell) const;
  void close(SolidForm& term, const CellView& cell) const;
  [[nodiscard]] SolidPoint point_of(std::uint32_t triangle, solid::Vector place) const;
  [[nodiscard]] solid::Vector place_of(const SolidPoint& point) const;
  [[nodiscard]] std::optional<SolidPoint> demanded_point(const SolidContact& contact) const;
  void set_point(const SolidContact& contact, SolidPoint on_part, const solid::Motion& start,
                 KnownSolid& made) const;
  [[nodiscard]] double least_margin(double allowance, const SolidDemand* demand) const;

  const SolidMeter& meter_;
  std::vector<double> none_;
  double scale_;
  Side part_, blank_;
};

}  // namespace lekalo::locate
