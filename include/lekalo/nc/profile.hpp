#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/nc/dialect.hpp"
#include "lekalo/nc/joints.hpp"
#include "lekalo/nc/profile_marks.hpp"

namespace lekalo::nc {

/// Profile cuts: every contour of every placed part, compensated by half the kerf, as one NC program. The
/// numbers of steps are those of docs/design/export.md.

/// A part where it is cut, in the sheet's frame, mm.
struct ProfilePart {
  /// The id of the placement, for messages.
  std::uint64_t id = 0;
  geom::Region region;  ///< made by make_region
  std::vector<ProfileMark> marks{};
};

enum class Process {
  laser,   ///< the beam goes on with the dialect's word and off with M5
  plasma,  ///< the beam, or the jet of water, goes on with M3 and off with M5
  router   ///< the spindle moves in Z: depth in passes, plunge feed, safe height
};
enum class LeadShape {
  line,  ///< at a right angle to the contour
  arc    ///< a quarter of a circle that runs into the contour's direction
};

/// How holes up to a diameter are cut. The diameter of a hole is four times its area over the length of its
/// contour, the hydraulic diameter: that of a circle, the side of a square, twice the width of a long slot.
/// Turning and moving a part changes it by rounding alone.
struct HoleCut {
  double up_to_diameter_mm = 0;  ///< 0.01 to 10000; a micrometre more is as good
  /// The length or radius of the lead, 0 to 1000; nothing: that of all cuts.
  std::optional<double> lead_in_mm;
  double feed_share = 1;  ///< of the feed of all cuts, 0.01 to 1
};

/// Cuts are slow near corners, where a machine stops and its beam or jet trails behind.
struct CornerSpeed {
  double feed_share = 1;   ///< of the feed of the cut, 0.01 to 1
  double distance_mm = 0;  ///< along the cut before and behind each corner, 0.01 to 1000
  [[nodiscard]] bool wanted() const noexcept { return feed_share < 1; }
};

struct ProfileOptions {
  Dialect post = posts().front();
  Process process = Process::laser;
  LengthUnit unit = LengthUnit::millimetre;  ///< the program's words are in it: G21 or G20
  double kerf_mm = 0;                        ///< width of the cut, 0.01 to 100
  /// The cut may enter a part this far: from 1e-4 to a quarter of the kerf.
  double tolerance_mm = 0.01;
  LeadShape lead = LeadShape::line;
  /// The length of the line or the radius of the arc, up to 1000; 0 for no lead.
  double lead_in_mm = 0;
  double feed_mm_per_min = 0;  ///< above 0 to 1e6
  /// The S word, of spindle or beam; 0 for none. Routers and some posts' lasers need it.
  double speed = 0;
  /// The wait after the beam is on, 0 to 100; not for routers.
  double pierce_s = 0;
  /// The depth below Z 0, 0.01 to 1000, and that of one pass, 0 for all at once; routers only.
  double depth_mm = 0, pass_mm = 0;
  /// The Z of travels, 0.1 to 1000; routers only.
  double safe_height_mm = 5;
  /// The feed downwards, above 0 to 1e6; routers only.
  double plunge_mm_per_min = 0;
  /// The number of the tool that cuts, 1 to 9999, and whose length the control takes; 0: it is in the spindle
  /// already; routers only.
  int tool = 0;
  /// In ascending order of their diameters; the first that a hole fits is how it is cut.
  std::vector<HoleCut> holes;
  /// A corner is where a cut turns by more than 33 degrees, at once or in the arc round a corner of a part.
  CornerSpeed corners{};
  /// Nothing: no mark is engraved.
  std::optional<Engraving> engraving{};
  /// The diameter of the disc that a pierce burns, from the kerf to 100; not for routers. Every disc then
  /// lies outside of every part, but for the tolerance, and clear of the kerfs of all cuts before. 0: it is
  /// not known, and nothing is promised of it.
  double pierce_diameter_mm = 0;
  /// A cut begins at least so far from all of the cut before, where there is a choice, 0 to 10000; 0: the
  /// shortest travels.
  double heat_spread_mm = 0;
  JointOptions joints;
  /// Straight edges of two parts that face each other at one kerf, within the tolerance, are cut once
  /// (docs/design/common-line.md); not with joints or a heat spread.
  bool common_line = false;
};

/// The lines of a program that cut one contour, its travel and its remark among them.
struct CutLines {
  std::uint64_t id = 0;                 ///< of the placement
  std::size_t first = 0, last = 0;      ///< from 1
  std::vector<std::uint64_t> others{};  ///< placements that have the cut in common with it, ascending
};

struct ProfileProgram {
  std::string text;  ///< ASCII, lines end with \n
  /// The lines of each cut, in the order of the program; ranges do not overlap.
  std::vector<CutLines> lines_of_cuts;
  /// A bound that is proved for the written numbers: no point of the kerf, leads included, lies deeper than
  /// this inside a part.
  double deepest_mm = 0;
  /// A bare start is pierced on the contour for want of room.
  std::size_t cuts = 0, shortened_leads = 0, bare_starts = 0;
  /// How many holes were cut by each of ProfileOptions::holes.
  std::vector<std::size_t> cuts_by_hole;
  double cut_mm = 0, travel_mm = 0;
  /// Marks are engraved before the first cut; their ways to each other are in travel_mm.
  std::size_t marks = 0;
  double engraved_mm = 0;
  std::vector<MarkLeftOut> marks_left_out;
  /// The distance from the kerf of the corner of a contour that is farthest from it, in the placement
  /// `left_over_of`. Material stays there: little in corners that point inwards, which the kerf rounds, and
  /// all of a slot that is narrower than the kerf.
  double left_over_mm = 0;
  std::uint64_t left_over_of = 0;
  /// Leads that run into the kerf of an earlier cut; none where the diameter of pierces is known.
  std::size_t crossed_leads = 0;
  /// Cuts that begin nearer to the cut before than heat_spread_mm, and the least of all these distances.
  std::size_t near_starts = 0;
  double nearest_start_mm = 0;
  /// How many joints hold how many parts, and the parts that want joints but lie in a hole of another part,
  /// where a joint would hold on to a slug that falls: they have none.
  std::size_t joints = 0, jointed_parts = 0;
  std::vector<std::uint64_t> unheld;
  /// The length of edges that two parts share. With common lines they are cut once, in so many lines, and
  /// these run beside either part at half the kerf, so far off at most. Without, they are cut twice.
  double shared_mm = 0;
  std::size_t common_lines = 0;
  double common_off_mm = 0;
  /// Lines that begin in a kerf which is there already, where no lead has room.
  std::size_t starts_in_kerfs = 0;
};

/// Returns the shortest lead whose pierce lies clear of the contour that it leads to, mm; 0 where the
/// diameter of pierces is not stated, or is no larger than the kerf and the tolerance on either side.
[[nodiscard]] double least_lead_mm(const ProfileOptions& options) noexcept;

/// \pre parts do not overlap (of two in the same place neither's kerf enters the other)
///
/// Outlines are followed clockwise, holes counter-clockwise: the part on the right (climb milling, and the
/// square side of a plasma). Inner contours come before the outline of their part, parts that lie in a hole
/// before that hole. Words have the decimals of the post.
///
/// Fails with ErrorCode::usage for options out of their ranges, and with ErrorCode::bad_input where the parts
/// cannot be cut with this kerf: a hole or the mouth of a notch narrower than the kerf (naming the part), or
/// a cut that would enter a part by more than the tolerance (naming both), where a pierce of the stated
/// diameter has no place (naming all such cuts), and where joints have none (naming all such parts). The
/// operator gets no program in which such a cut is left.
///
/// With common lines parts that share edges are cut as one cluster: the lines between them, the pockets that
/// they surround, and one outline around all of them. An edge is cut once. Parts on two sides of a line are
/// named together in remarks, and CutLines name the one with the lowest id first.
///
/// Nothing is cut that is loose: besides what lies in a hole or an outline, parts whose neighbours' kerfs
/// close round them come before the last of these (docs/design/cut-order.md).
///
/// The proof (deepest_mm) knows nothing of how the paths were made: it reads the rounded numbers. Every edge
/// of a path keeps kerf / 2 - tolerance from every edge of every part (geom/edge_distance.hpp, its error and
/// the differences of radii on the safe side), and one point of the path lies outside each part.
/// \param name  of the program, for its first comment
/// Cost: O(n log n + near pairs of edges), and the tour: O(n^2) of n parts, within a budget.
[[nodiscard]] Result<ProfileProgram> profile_program(const std::vector<ProfilePart>& parts,
                                                     const std::string& name, const ProfileOptions& options);

}  // namespace lekalo::nc
