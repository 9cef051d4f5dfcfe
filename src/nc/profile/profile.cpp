#include "lekalo/nc/profile.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "common_cuts.hpp"
#include "common_stretch.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "profile_corners.hpp"
#include "profile_engraving.hpp"
#include "profile_joints.hpp"
#include "profile_leads.hpp"
#include "profile_loose.hpp"
#include "profile_options.hpp"
#include "profile_order.hpp"
#include "profile_path.hpp"
#include "profile_proof.hpp"
#include "profile_words.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

constexpr std::size_t kLongestProgram = 500'000'000;  // bytes

double path_length(const std::vector<WrittenEdge>& edges, const Resolution& resolution) {
  double sum = 0;
  for (const WrittenEdge& edge : edges) sum += length_of(edge_mm(edge, resolution));
  return sum;
}

Result<void> check_holes(const ProfileOptions& o) {
  double before = 0;
  for (const HoleCut& hole : o.holes) {
    const std::string of = fmt::format(" of holes up to {:g} mm", hole.up_to_diameter_mm);
    LEKALO_CHECK(
        check_range("the diameter up to which holes are cut so, in mm", hole.up_to_diameter_mm, 0.01, 1e4));
    LEKALO_CHECK(check_range("lead-in in mm" + of, hole.lead_in_mm.value_or(0), 0, 1000));
    LEKALO_CHECK(check_range("share of the feed" + of, hole.feed_share, 0.01, 1));
    LEKALO_CHECK(check_range("feed in mm/min" + of, hole.feed_share * o.feed_mm_per_min, 0.1, 1e6));
    if (!(hole.up_to_diameter_mm > before))
      return failure(ErrorCode::usage, "diameters of holes have to stand in ascending order");
    before = hole.up_to_diameter_mm;
  }
  return {};
}

Result<void> check_corners(const ProfileOptions& o) {
  LEKALO_CHECK(check_range("share of the feed at corners", o.corners.feed_share, 0.01, 1));
  if (!o.corners.wanted()) return {};
  LEKALO_CHECK(check_range("distance from corners in mm", o.corners.distance_mm, 0.01, 1000));
  double least = o.corners.feed_share * o.feed_mm_per_min;
  for (const HoleCut& hole : o.holes)
    least = std::min(least, hole.feed_share * o.corners.feed_share * o.feed_mm_per_min);
  return check_range("feed in mm/min at corners", least, 0.1, 1e6);
}

Result<void> check_tools(const ProfileOptions& o) {
  const int of_marks = o.engraving ? o.engraving->tool : 0;
  if (o.tool == 0 && of_marks == 0) return {};
  if (o.process != Process::router) return failure(ErrorCode::usage, "routers alone have tools with numbers");
  LEKALO_CHECK(check_range("number of the tool", o.tool, 1, 9999));
  LEKALO_CHECK(check_range("number of the tool of engraving", of_marks, 0, 9999));
  if (of_marks > 0 && of_marks != o.tool && !o.post.changes_tools)
    return failure(ErrorCode::usage,
                   fmt::format("{} changes no tool on the way, so that marks and cuts need the same one",
                               o.post.control));
  return {};
}

Result<void> check_options(const ProfileOptions& o) {
  const bool router = o.process == Process::router;
  constexpr double kAlmostNothing = 1e-3;
  struct Range {
    const char* what;
    double value, low, high;
    bool needed;
  };
  const Range ranges[] = {
      {"kerf in mm", o.kerf_mm, 0.01, 100, true},
      {"lead-in in mm", o.lead_in_mm, 0, 1000, true},
      {"feed in mm/min", o.feed_mm_per_min, 0.1, 1e6, true},
      {"speed (S word)", o.speed, 0, 1e6, true},
      {"pierce in s", o.pierce_s, 0, 100, true},
      {"depth in mm", o.depth_mm, 0.01, 1000, router},
      {"pass in mm", o.pass_mm, o.pass_mm == 0 ? 0 : std::max(0.01, o.depth_mm * kAlmostNothing), 1000,
       router},
      {"safe height in mm", o.safe_height_mm, 0.1, 1000, router},
      {"plunge in mm/min", o.plunge_mm_per_min, 0.1, 1e6, router},
  };
  for (const Range& range : ranges)
    if (range.needed) LEKALO_CHECK(check_range(range.what, range.value, range.low, range.high));
  LEKALO_CHECK(check_range("tolerance in mm (less than a quarter of the kerf)", o.tolerance_mm, 1e-4,
                           0.25 * o.kerf_mm));
  if (o.engraving) {
    if (o.process == Process::plasma)
      return failure(ErrorCode::usage, "a torch or jet of water cuts through and engraves nothing");
    LEKALO_CHECK(check_range("feed of engraving in mm/min", o.engraving->feed_mm_per_min, 0.1, 1e6));
    LEKALO_CHECK(check_range("speed of engraving (S word)", o.engraving->speed, 0, 1e6));
    if (router) LEKALO_CHECK(check_range("depth of engraving in mm", o.engraving->depth_mm, 0.01, 1000));
  }
  LEKALO_CHECK(check_tools(o));
  if (router && !(o.speed >= 1))
    return failure(ErrorCode::usage, "a router needs the speed of its spindle, the S word");
  if (o.post.laser_needs_power && o.process == Process::laser && !(o.speed >= 1))
    return failure(
        ErrorCode::usage,
        fmt::format("a {} laser needs the power of its beam, the S word: without it the beam stays dark",
                    o.post.control));
  if (router && o.pierce_s > 0)
    return failure(ErrorCode::usage, "a router does not pierce: leave the pierce time out");
  LEKALO_CHECK(check_holes(o));
  LEKALO_CHECK(check_corners(o));
  LEKALO_CHECK(check_pierce_and_order(o));
  LEKALO_CHECK(check_common_line(o));
  return check_joints(o);
}

/// A hole that is drawn with the diameter of a rule is not beyond it by the rounding of its part's turn. The
/// chords of a circle lie in the hole, so that they only make it smaller.
constexpr double kDiameterRounding = 1e-3;  // mm

/// The rule of options.holes by which a contour is cut; none for outlines and larger holes.
std::optional<std::size_t> hole_rule(const ProfilePart& part, const Cut& cut, const ProfileOptions& options) {
  if (!cut.is_hole() || options.holes.empty()) return std::nullopt;
  const geom::Contour& contour = part.region.holes[cut.hole];
  double length = 0;
  for (const geom::Edge& edge : contour) length += length_of(edge);
  const double diameter = 4 * std::abs(geom::signed_area(contour)) / length;
  const auto fits = std::find_if(options.holes.begin(), options.holes.end(), [&](const HoleCut& hole) {
    return diameter <= hole.up_to_diameter_mm + kDiameterRounding;
  });
  if (fits == options.holes.end()) return std::nullopt;
  return static_cast<std::size_t>(fits - options.holes.begin());
}

/// The lead that a cut wants, and its feed.
struct CutTerms {
  std::optional<std::size_t> rule;  ///< of ProfileOptions::holes
  double lead_in_mm = 0, feed_mm_per_min = 0;
};

CutTerms terms_of(const ProfilePart& part, const Cut& cut, const ProfileOptions& options) {
  CutTerms terms{hole_rule(part, cut, options), options.lead_in_mm, options.feed_mm_per_min};
  if (!terms.rule) return terms;
  const HoleCut& hole = options.holes[*terms.rule];
  terms.lead_in_mm = hole.lead_in_mm.value_or(options.lead_in_mm);
  terms.feed_mm_per_min = hole.feed_share * options.feed_mm_per_min;
  return terms;
}

/// The refusal of a cut whose kerf would enter a part.
tl::unexpected<Error> entered(const std::vector<ProfilePart>& parts, const Cut& cut,
                              const KerfProof::Finding& finding, const ProfileOptions& options) {
  const ProfilePart &own = parts[cut.part], &other = parts[finding.part];
  const std::string contour = cut.is_hole() ? fmt::format("hole {}", cut.hole + 1) : "the outline";
  if (cut.part == finding.part)
    return failure(
        ErrorCode::bad_input,
        fmt::format(
            "placement {}: cut along {} the kerf of {:g} mm would enter the part itself by up to {:.4g} mm, "
            "{:g} mm is the tolerance; use a larger tolerance or a narrower kerf",
            own.id, contour, options.kerf_mm, finding.deepest_mm, options.tolerance_mm));
  return failure(
      ErrorCode::bad_input,
      fmt::format("placements {} and {} are too near for the kerf of {:g} mm: cut along {} of {} it would "
                  "enter {} by up to {:.4g} mm, {:g} mm is the tolerance; move them apart or use a narrower "
                  "kerf",
                  std::min(own.id, other.id), std::max(own.id, other.id), options.kerf_mm, contour, own.id,
                  other.id, finding.deepest_mm, options.tolerance_mm));
}

/// Step 7: how deep the kerf enters any part along the path, or the refusal beyond the tolerance.
Result<double> proved_depth(const std::vector<ProfilePart>& parts, const Cut& cut,
                            const std::vector<WrittenEdge>& path, const KerfProof& proof,
                            const ProfileOptions& options) {
  const KerfProof::Finding finding = proof.look(path);
  if (finding.inside || !(finding.deepest_mm <= options.tolerance_mm))
    return entered(parts, cut, finding, options);
  return finding.deepest_mm;
}

/// The words for the operator before a cut.
std::string remark_on(const std::vector<ProfilePart>& parts, const Cut& cut) {
  if (cut.is_hole()) return fmt::format("placement {} hole {}", parts[cut.part].id, cut.hole + 1);
  if (cut.members.empty()) return fmt::format("placement {} outline", parts[cut.part].id);
  return fmt::format("common {} of placements {}",
                     cut.is_line   ? "line"
                     : cut.outline ? "outline"
                                   : "pocket",
                     placements_of(parts, cut, " "));
}

/// The lines of a cut, and whose it is.
CutLines lines_of(const std::vector<ProfilePart>& parts, const Cut& cut, std::size_t first,
                  std::size_t last) {
  CutLines lines{parts[cut.part].id, first, last, {}};
  for (const std::size_t member : cut.members) lines.others.push_back(parts[member].id);
  std::sort(lines.others.begin(), lines.others.end());
  if (!lines.others.empty()) {
    lines.id = lines.others.front();
    lines.others.erase(lines.others.begin());
  }
  return lines;
}

/// The distance from the kerf of that corner of the contour which is farthest from it.
double left_over(const geom::Contour& contour, const std::vector<WrittenEdge>& path,
                 const Resolution& resolution, double half_kerf) {
  std::vector<geom::Curve> curves;
  for (const WrittenEdge& edge : path) curves.push_back(geom::make_curve(edge_mm(edge, resolution)));
  std::vector<geom::Box> boxes;
  for (const geom::Curve& curve : curves) boxes.push_back(geom::curve_box(curve));
  const geom::BoxTree tree(boxes);
  double most = 0;
  for (const geom::Edge& edge : contour) {
    double least = std::numeric_limits<double>::infinity();
    // A corner is seldom far away, so the search begins near it and grows until nothing nearer can be left.
    for (double reach = 2 * half_kerf; !(least <= reach) && reach < 1e9; reach *= 4)
      tree.visit_meeting(
          {edge.from - Point{reach, reach}, edge.from + Point{reach, reach}}, [&](std::uint32_t i) {
            least = std::min(least, geom::norm(geom::nearest_on(curves[i], edge.from) - edge.from));
          });
    most = std::max(most, least - half_kerf);
  }
  return most;
}

/// Keeps the largest of left_over() of all contours.
void tell_left_over(const ProfilePart& part, const Cut& cut, const ProfileOptions& options,
                    ProfileProgram& program) {
  const double left = left_over(cut.outline ? part.region.outer : part.region.holes[cut.hole], cut.path,
                                resolution_of(options), 0.5 * options.kerf_mm);
  if (left > program.left_over_mm) program.left_over_mm = left, program.left_over_of = part.id;
}

tl::unexpected<Error> too_long() {
  return failure(
      ErrorCode::bad_input,
      fmt::format("the program would be longer than {} MB; cut fewer parts at a time, or in fewer passes",
                  kLongestProgram / 1'000'000));
}

/// Writes the marks of all parts, and moves `here` to where the last ends.
Result<void> engrave(EngravedPaths engraved, const Resolution& resolution, ProfileWriter& writer,
                     ProfileProgram& program, Point& here) {
  program.marks = engraved.marks;
  program.marks_left_out = std::move(engraved.left_out);
  if (engraved.paths.empty()) return {};
  writer.begin_engraving();
  for (const std::vector<WrittenEdge>& path : engraved.paths) {
    writer.engrave(path);
    if (writer.size() > kLongestProgram) return too_long();
    program.travel_mm += geom::norm(resolution.mm(path.front().from) - here);
    program.engraved_mm += path_length(path, resolution);
    here = resolution.mm(path.back().to);
  }
  writer.end_engraving();
  return {};
}

/// The closed path, begun at another of its edges.
std::vector<WrittenEdge> begun_at(std::vector<WrittenEdge> path, std::size_t edge) {
  std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(edge), path.end());
  return path;
}

/// The path of a line, from its other end.
std::vector<WrittenEdge> turned_path(std::vector<WrittenEdge> path) {
  std::reverse(path.begin(), path.end());
  for (WrittenEdge& edge : path) std::swap(edge.from, edge.to);
  return path;
}

/// A path that is cut from one pierce on.
struct Stretch {
  const Start* start = nullptr;
  std::vector<WrittenEdge> path;
};

/// The whole path, or its stretches between joints. A router cuts over the joints, at the height of tabs.
std::vector<Stretch> stretches_of(const Cut& cut, const Starts& its, std::size_t first,
                                  const ProfileOptions& options) {
  const Start& start = its.choices[first];
  if (cut.is_line) return {{&start, start.from_end ? turned_path(cut.path) : cut.path}};
  const std::vector<WrittenEdge> path = begun_at(cut.path, start.edge);
  if (options.process == Process::router) return {{&start, path}};
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (path[k].joint) continue;
    if (k == 0 || path[k - 1].joint) {
      const std::size_t edge = (start.edge + k) % path.size();
      const auto own = std::find_if(its.choices.begin(), its.choices.end(),
                                    [&](const Start& choice) { return choice.edge == edge; });
      stretches.push_back({&*own, {}});
    }
    stretches.back().path.push_back(path[k]);
  }
  return stretches;
}

std::size_t joints_of(const std::vector<WrittenEdge>& path) {
  std::size_t joints = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    if (path[k].joint && !path[k == 0 ? path.size() - 1 : k - 1].joint) ++joints;
  return joints;
}

}  // namespace

Result<ProfileProgram> profile_program(const std::vector<ProfilePart>& placed, const std::string& name,
                                       const ProfileOptions& options) {
  LEKALO_CHECK(check_options(options));
  if (placed.empty()) return failure(ErrorCode::bad_input, "there is no part to cut");
  const Resolution resolution = resolution_of(options);
  LEKALO_TRY(std::vector<Cut> cuts, compensated_cuts(placed, options));  // steps 3 and 4
  const KerfProof proof(placed, options);
  ProfileProgram program;
  std::vector<ProfilePart> parts = placed;  // clusters are added to them
  for (const Cut& cut : cuts) {
    LEKALO_CHECK(proved_depth(parts, cut, cut.path, proof, options));
    tell_left_over(parts[cut.part], cut, options, program);
  }
  CommonCuts common;
  if (options.common_line) {
    LEKALO_TRY(common, take_common_cuts(parts, cuts, proof, options));
    program.shared_mm = common.shared_mm, program.common_lines = common.lines;
    program.common_off_mm = common.off_mm;
  } else {
    program.shared_mm = common_stretches(cuts, options).length_mm;
  }

  // Step 5. The path is proved as it will be written, after starts_of has begun new edges in it.
  const KerfsAround kerfs(cuts, options);
  program.cuts_by_hole.resize(options.holes.size());
  std::vector<CutTerms> terms;
  for (const Cut& cut : cuts) terms.push_back(terms_of(parts[cut.part], cut, options));
  OrderRules rules{enclosing_cuts(parts, cuts, resolution), {}, options.heat_spread_mm};
  const std::vector<JointGround> no_grounds;
  LEKALO_TRY(JointedCuts jointed,
             place_joints(parts, cuts, rules.enclosing, {proof, kerfs, no_grounds}, options));
  program.jointed_parts = jointed.parts;
  program.unheld = jointed.unheld;
  std::vector<Starts> starts;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const Surroundings around{proof, kerfs, jointed.grounds};
    if (cuts[c].is_line)
      starts.push_back(line_starts_of(cuts[c], c, around, options));
    else if (!cuts[c].outline && !cuts[c].is_hole())
      starts.push_back(pocket_starts_of(cuts[c].path, c, terms[c].lead_in_mm, around, options));
    else if (jointed.starts[c].empty())
      starts.push_back(starts_of(cuts[c].path, c, terms[c].lead_in_mm, around, options));
    else
      starts.push_back({std::move(jointed.starts[c])});
  }
  LEKALO_CHECK(check_pierces(parts, cuts, starts, options));
  LEKALO_TRY(rules.rings, loose_rings(parts, cuts, rules.enclosing, options));
  std::vector<OrderedCut> order = ordered_cuts(starts, rules, kerfs, resolution);  // step 6
  put_common_cuts_in_order(common, cuts, starts, options, order);
  LEKALO_CHECK(check_crossings(parts, cuts, order, settle_starts(starts, options, order), options, program));
  tell_heat(starts, order, kerfs, options, program);

  // Steps 7 and 8.
  EngravedPaths engraved = engraved_paths(placed, options);
  ProfileWriter writer(name, options, !engraved.paths.empty());
  Point here;
  LEKALO_CHECK(engrave(std::move(engraved), resolution, writer, program, here));
  for (const OrderedCut& ordered : order) {
    const Cut& cut = cuts[ordered.cut];
    const Starts& its = starts[ordered.cut];
    const CutTerms& on_terms = terms[ordered.cut];
    const std::size_t first_line = writer.line_count() + 1;
    writer.comment(remark_on(parts, cut));
    for (const Stretch& stretch : stretches_of(cut, its, ordered.start, options)) {
      const Start& start = *stretch.start;
      const std::vector<WrittenEdge> path = with_slow_corners(stretch.path, options);
      std::vector<WrittenEdge> all = start.lead;
      all.insert(all.end(), path.begin(), path.end());
      LEKALO_TRY(const double deepest_mm, proved_depth(parts, cut, all, proof, options));
      program.deepest_mm = std::max(program.deepest_mm, deepest_mm);
      writer.cut(start.lead, path, on_terms.feed_mm_per_min);
      program.travel_mm += geom::norm(resolution.mm(start.pierce) - here);
      here = resolution.mm(stretch.path.back().to);
      program.cut_mm += path_length(all, resolution);
      if (on_terms.lead_in_mm > 0 && start.lead.empty())
        ++(start.in_kerf_of.empty() ? program.bare_starts : program.starts_in_kerfs);
      else if (start.lead_mm < on_terms.lead_in_mm)
        ++program.shortened_leads;
    }
    program.lines_of_cuts.push_back(lines_of(parts, cut, first_line, writer.line_count()));
    if (writer.size() > kLongestProgram) return too_long();
    ++program.cuts;
    if (on_terms.rule) ++program.cuts_by_hole[*on_terms.rule];
    program.joints += joints_of(cut.path);
  }
  program.travel_mm += geom::norm(here);
  program.text = writer.finish();
  return program;
}

}  // namespace lekalo::nc
