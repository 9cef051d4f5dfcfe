#pragma once

#include <cstdint>
#include <vector>

#include "convex_blank.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "solid_frame.hpp"
#include "solid_near.hpp"
#include "solid_rims.hpp"

namespace lekalo::locate {

inline constexpr std::uint32_t kNoTriangle = 0xffffffff;

/// A datum that is not kept counts for this much more than a margin.
inline constexpr double kDatumWeight = 0x1p26;

/// A place where part and blank come close, or cross. The normal, of length 1 and in the blank's frame,
/// points from what is not material of the blank into the part's material; the distance, less the width of
/// the blank's triangle, is negative where the part's point lies outside the blank, or the blank's in the
/// part.
struct SolidContact {
  solid::Vector part, blank;  ///< each in its own frame
  solid::Vector normal;
  double distance = 0;
  /// The pair of triangles, or kNoTriangle where they cross.
  std::uint32_t part_triangle = kNoTriangle, blank_triangle = kNoTriangle;
  /// A triangle that has the part's point, and its demand, if there are demands.
  std::uint32_t demanded_triangle = kNoTriangle;
  SolidDemand demand = {};
  /// The numbers of a datum and of a point that it holds, if it is one. Then what is left of the tolerance,
  /// times kDatumWeight and above all margins where it is kept, counts as the distance.
  std::uint32_t datum = kNoTriangle, datum_point = 0;
  /// True of a face of a convex blank: the distance is the height over its plane, at any pose.
  bool of_plane = false;
  /// The same of a point that is to be near the blank's surface: the number of the SolidNear.
  std::uint32_t near = kNoTriangle;
  /// Says if it is of the place of the part, and not of its allowance.
  [[nodiscard]] bool of_place() const { return datum != kNoTriangle || near != kNoTriangle; }
  [[nodiscard]] double margin() const { return (distance - demand.minimum) / demand.scale; }
  /// False where the two points are too near to each other to give a normal.
  [[nodiscard]] bool directed() const { return !(normal == solid::Vector{}); }
};

/// The objective at one pose: where the part is inside, a bound from below of the margin, whatever the
/// coordinates may be off. Elsewhere it is how deep points stick out, which says in which direction to go and
/// no more.
struct MeasuredSolid {
  FramedPose pose;
  double value = 0;
  bool inside = false;
  [[nodiscard]] bool better_than(const MeasuredSolid& other) const {
    return inside != other.inside ? inside : value > other.value;
  }
};

/// The least allowance and the least margin at one pose, whatever the coordinates may be off; inside, but for
/// what is to be near the blank's surface.
struct MeasuredPose {
  double clearance = 0, margin = 0;
  bool inside = false;
};

/// Measures a part in a blank. Its answers depend on their arguments alone, so threads may share it.
class SolidMeter {
 public:
  /// \param threads  that make it, and measure with all pieces
  SolidMeter(const SolidProblem& problem, const SolidFrame& frame, unsigned threads = 1);
  SolidMeter(const SolidMeter&) = delete;
  SolidMeter& operator=(const SolidMeter&) = delete;

  [[nodiscard]] const SolidFrame& frame() const noexcept { return frame_; }
  [[nodiscard]] const solid::MeshClearance& clearance() const noexcept { return clearance_; }
  [[nodiscard]] const solid::Mesh& part() const noexcept { return part_; }
  /// The part's triangles are pieces of those of the problem where rims are left out. Triangles of contacts
  /// are pieces; number() tells those of the problem.
  [[nodiscard]] const CutPart* cut() const noexcept { return cut_ ? &*cut_ : nullptr; }
  [[nodiscard]] std::uint32_t number(std::uint32_t triangle) const {
    return cut_ && triangle != kNoTriangle ? cut_->number(triangle) : triangle;
  }
  [[nodiscard]] const solid::Mesh& blank() const noexcept { return blank_; }
  /// A length of part and blank together that rounding follows, mm.
  [[nodiscard]] double far() const noexcept { return far_; }
  /// No point of the surfaces is farther off that of the file, mm.
  [[nodiscard]] double part_error() const noexcept { return part_error_; }
  [[nodiscard]] double blank_error() const noexcept { return blank_error_; }
  /// The widths of the blank's triangles; none of one taken as drawn.
  [[nodiscard]] const std::vector<double>& widths() const noexcept { return widths_; }
  [[nodiscard]] double width(std::uint32_t blank_triangle) const {
    return widths_.empty() ? 0 : widths_[blank_triangle];
  }
  /// No width is smaller, mm, and none is above the true one by more than the error.
  [[nodiscard]] double narrowest() const noexcept { return narrowest_; }
  [[nodiscard]] double width_error() const noexcept { return width_error_; }
  /// Says if triangles have demands of their own.
  [[nodiscard]] bool has_demands() const noexcept { return !demand_of_.empty(); }
  /// True if no triangle is as cast.
  [[nodiscard]] bool whole() const noexcept { return whole_; }
  /// The demands, each once; the only one is 0 where there are none.
  [[nodiscard]] const std::vector<SolidDemand>& demands() const noexcept { return demands_; }
  /// The one that asks for the least allowance at a margin.
  [[nodiscard]] const SolidDemand& least_demand(double margin) const;
  [[nodiscard]] const std::vector<SolidDatum>& datums() const noexcept { return datums_; }
  [[nodiscard]] const std::vector<NearFace>& nears() const noexcept { return nears_; }
  /// The clearance of the blank's mesh, whatever its widths; and points of each of its surfaces.
  [[nodiscard]] const solid::MeshClearance& bare_clearance() const noexcept {
    return bare_ ? *bare_ : clearance_;
  }
  [[nodiscard]] const std::vector<solid::Vector>& blank_points() const noexcept { return blank_points_; }
  /// A datum's distances may be off by this, mm; and no margin is larger than that.
  [[nodiscard]] double datum_loss() const noexcept { return datum_loss_; }
  [[nodiscard]] double beyond_margins() const noexcept { return beyond_margins_; }
  /// No pose that is inside has less margin: allowances are above 0 there.
  [[nodiscard]] double floor() const noexcept { return floor_; }

  /// True of a convex blank with few faces, without widths, demands and datums. Then planes are all that
  /// poses and boxes are looked at with.
  [[nodiscard]] bool convex() const noexcept { return convex_.has_value(); }
  /// A contact of a plane as it is at a pose.
  [[nodiscard]] static SolidContact over_plane(const solid::Motion& motion, SolidContact contact);

  /// Measures at a pose. Where the part is inside and all has the margin `most` or more, the value is at
  /// least `most`, and nothing more is known. The contacts are those with the least margins of `count` pieces
  /// of the part, less than `most`, and where part and blank cross the deepest points of either in the other;
  /// and what holds the points of datums.
  [[nodiscard]] MeasuredSolid measure(const FramedPose& pose, double most, std::size_t count,
                                      std::vector<SolidContact>& contacts) const;
  /// The same with pairs of triangles, also in a convex blank.
  [[nodiscard]] MeasuredSolid measure_pairs(const FramedPose& pose, double most, std::size_t count,
                                            std::vector<SolidContact>& contacts) const;
  [[nodiscard]] MeasuredPose measure(const solid::Motion& motion) const;
  [[nodiscard]] bool keeps_datums(const solid::Motion& motion) const { return !(beyond_datums(motion) > 0); }
  /// How far the points of a datum are off at a pose at most, mm.
  [[nodiscard]] double off(const SolidDatum& datum, const solid::Motion& motion) const;
  /// No point of a SolidNear is farther from the blank's surface at a pose, mm.
  [[nodiscard]] double far(const NearFace& face, const solid::Motion& motion) const;
  /// The contact of a point that is to be near the blank's surface, or none where it is far from being too
  /// far.
  [[nodiscard]] std::optional<SolidContact> near_contact(const solid::Motion& motion, std::uint32_t near,
                                                         solid::Vector part, std::uint32_t triangle) const;
  /// How far some points of either surface are on the wrong side of the other, all together, mm: a quick
  /// word on how a pose compares with others.
  [[nodiscard]] double misfit(const solid::Motion& motion) const;
  /// The contacts of those patches of both surfaces that have one below `most`, as their first vertices see
  /// it: `count` of them, each a near pair of its patch, and the deepest crossings. It takes a tenth of a
  /// measurement. Returns the least margin that was met, or `most`; the pose may have less.
  [[nodiscard]] double glance(const FramedPose& pose, double most, std::size_t count,
                              std::vector<SolidContact>& contacts) const;
  /// The contacts below `most` that a number of steps meets in each piece of the part: all of a piece is
  /// looked at, and not some vertices as by a glance, but not to its nearest pair as in a measurement.
  /// Returns the least margin, or `most`; the pose may have less.
  [[nodiscard]] double probe(const FramedPose& pose, double most, std::vector<SolidContact>& contacts) const;
  /// The contact of the part's foremost point against a normal, and nothing of the blank. With demands it is
  /// the one with the least margin over a half-space there.
  [[nodiscard]] SolidContact foremost(const solid::Motion& motion, solid::Vector normal) const;
  /// The contact of two triangles at a pose.
  [[nodiscard]] SolidContact contact(const solid::Motion& motion, std::uint32_t part_triangle,
                                     std::uint32_t blank_triangle) const;

 private:
  /// The triangles of the part that have one demand.
  struct Demanded {
    SolidDemand demand;
    std::vector<std::uint32_t> numbers;  ///< of its triangles among all
    solid::MeshClearance clearance;
  };
  struct Sample {
    solid::Vector place;
    std::uint32_t triangle = kNoTriangle;  ///< one that has it, if there are demands
  };
  /// A patch of the part, of the triangles with one demand, or of the blank.
  struct Patch {
    solid::Vector place;         ///< a corner of one of its triangles
    std::uint32_t triangle = 0;  ///< that one's number in the mesh
    std::uint32_t node = 0;      ///< of the tree in
    const solid::MeshClearance* clearance = nullptr;
    /// The numbers in the part of the triangles of that tree, if they are others.
    const std::vector<std::uint32_t>* numbers = nullptr;
  };
  void sort_by_demand();
  void prepare_datums();
  void add_datums(const solid::Motion& motion, std::vector<SolidContact>& contacts) const;
  [[nodiscard]] double beyond_datums(const solid::Motion& motion) const;
  [[nodiscard]] double add_nears(const solid::Motion& motion, std::vector<SolidContact>& contacts) const;
  [[nodiscard]] std::optional<SolidContact> contact_of(std::uint32_t near, const FarPoint& point) const;
  [[nodiscard]] std::vector<Sample> samples_of_part() const;
  void cut_in_patches();
  [[nodiscard]] std::vector<solid::NearPair> nearest(const solid::Motion& motion, double most,
                                                     std::size_t count) const;
  [[nodiscard]] bool inside(const solid::Motion& motion) const;
  [[nodiscard]] std::optional<SolidContact> sticks_out(const solid::Motion& motion, solid::Vector part,
                                                       std::uint32_t triangle) const;
  [[nodiscard]] std::optional<SolidContact> sticks_in(const solid::Motion& motion, solid::Vector blank) const;
  [[nodiscard]] std::optional<SolidContact> crossing(solid::Vector part, solid::Vector blank, double depth,
                                                     solid::Vector way, std::uint32_t triangle) const;
  void add_crossings(const solid::Motion& motion, const std::vector<solid::NearPair>& pairs,
                     std::vector<SolidContact> crossing, std::vector<SolidContact>& contacts) const;
  [[nodiscard]] SolidContact contact(const solid::Motion& motion, const solid::NearPair& pair) const;
  void measure_planes(const solid::Motion& motion, double most, std::size_t count,
                      std::vector<SolidContact>& contacts) const;

  SolidFrame frame_;
  unsigned threads_;
  std::optional<CutPart> cut_;
  const solid::Mesh &part_, &blank_;
  const std::vector<double>& widths_;
  solid::MeshClearance clearance_;
  std::optional<ConvexBlank> convex_;
  const std::vector<std::optional<SolidDemand>>& demand_of_;
  bool whole_ = true;
  double floor_ = 0;
  std::vector<SolidDemand> demands_;
  /// None where triangles have no demands of their own.
  std::vector<Demanded> demanded_;
  /// With demands: the vertices of each surface of the blank that hangs together; and of each vertex of the
  /// part the triangle that demands most of those that have it.
  std::vector<std::vector<solid::Vector>> blank_surfaces_;
  std::vector<std::uint32_t> demanded_at_;
  const std::vector<SolidDatum>& datums_;
  /// Some points of each datum, spread over all.
  std::vector<std::vector<std::size_t>> of_datum_;
  double datum_loss_ = 0, beyond_margins_ = 0;
  std::vector<NearFace> nears_;
  std::optional<solid::MeshClearance> bare_;  ///< where the blank has widths and something is to be near it
  std::vector<solid::Vector> blank_points_;
  /// Vertices spread over the surfaces.
  std::vector<Sample> of_part_;
  std::vector<solid::Vector> of_blank_;
  std::vector<Patch> patches_of_part_, patches_of_blank_;
  double far_ = 0, widest_ = 0, part_error_, blank_error_, width_error_, narrowest_ = 0;
};

}  // namespace lekalo::locate
