#include "profile_options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "lekalo/base/joined_text.hpp"

namespace lekalo::nc {
namespace {

/// So many cuts are named in one sentence.
constexpr std::size_t kMostCutsNamed = 20;

/// Names in a list of which the end may be left away.
class CutNames {
 public:
  void add(const std::string& name) {
    if (count_++ < kMostCutsNamed) list_ += (list_.empty() ? "" : ", ") + name;
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::string text() const {
    return count_ <= kMostCutsNamed ? list_ : fmt::format("{} and {} more", list_, count_ - kMostCutsNamed);
  }

 private:
  std::string list_;
  std::size_t count_ = 0;
};

/// A pierce that is wider than the kerf lies on a lead, which has to be long enough.
Result<void> check_lead(const std::string& what, double lead_in_mm, const ProfileOptions& o) {
  const double least = least_lead_mm(o);
  if (lead_in_mm >= least) return {};
  return failure(ErrorCode::usage,
                 fmt::format("{} is {:g}: a pierce of {:g} mm and a kerf of {:g} mm need a lead of at least "
                             "{:g} mm, or the pierce burns into the part",
                             what, lead_in_mm, o.pierce_diameter_mm, o.kerf_mm, least));
}

}  // namespace

Result<void> check_range(const std::string& what, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return failure(ErrorCode::usage,
                 fmt::format("{} is {:g}: from {:g} to {:g} is allowed", what, value, low, high));
}

Result<void> check_pierce_and_order(const ProfileOptions& o) {
  LEKALO_CHECK(check_range("heat spread in mm", o.heat_spread_mm, 0, 1e4));
  if (o.pierce_diameter_mm == 0) return {};
  if (o.process == Process::router)
    return failure(ErrorCode::usage, "a router does not pierce: leave the diameter of pierces out");
  LEKALO_CHECK(
      check_range("diameter of pierces in mm (at least the kerf)", o.pierce_diameter_mm, o.kerf_mm, 100));
  LEKALO_CHECK(check_lead("lead-in in mm", o.lead_in_mm, o));
  for (const HoleCut& hole : o.holes)
    if (hole.lead_in_mm)
      LEKALO_CHECK(check_lead(fmt::format("lead-in in mm of holes up to {:g} mm", hole.up_to_diameter_mm),
                              *hole.lead_in_mm, o));
  return {};
}

Result<void> check_common_line(const ProfileOptions& o) {
  if (!o.common_line) return {};
  if (o.joints.wanted())
    return failure(ErrorCode::usage,
                   "common lines and joints do not go together: a line between two parts cannot hold either "
                   "in the sheet; leave one of them out");
  if (o.lead == LeadShape::arc && o.lead_in_mm > 0)
    return failure(ErrorCode::usage,
                   "common lines and leads that are arcs do not go together: a cut that comes back along its "
                   "lead would free the parts too early; take lines for leads");
  if (o.heat_spread_mm > 0)
    return failure(ErrorCode::usage,
                   "common lines and a spread of heat do not go together: the lines of a cluster are cut one "
                   "after the other; leave one of them out");
  return {};
}

std::string placements_of(const std::vector<ProfilePart>& parts, const Cut& cut, const char* between) {
  std::vector<std::uint64_t> ids;
  for (const std::size_t member : cut.members) ids.push_back(parts[member].id);
  return joined_text(ids, between);
}

std::string name_of_cut(const std::vector<ProfilePart>& parts, const Cut& cut) {
  if (!cut.members.empty()) {
    return fmt::format("{} of placements {}",
                       cut.is_line   ? "a common line"
                       : cut.outline ? "the common outline"
                                     : "a pocket",
                       placements_of(parts, cut, ", "));
  }
  const std::uint64_t id = parts[cut.part].id;
  return cut.outline ? fmt::format("the outline of placement {}", id)
                     : fmt::format("hole {} of placement {}", cut.hole + 1, id);
}

Result<void> check_pierces(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                           const std::vector<Starts>& starts, const ProfileOptions& options) {
  CutNames names;
  for (std::size_t cut = 0; cut < cuts.size(); ++cut)
    if (starts[cut].choices.empty()) names.add(name_of_cut(parts, cuts[cut]));
  if (names.empty()) return {};
  return failure(
      ErrorCode::bad_input,
      fmt::format("there is no room for a pierce of {:g} mm with a lead of {:g} mm or less, clear of every "
                  "part, for {}; move parts apart, leave such holes out of the drawing, or pierce smaller",
                  options.pierce_diameter_mm, options.lead_in_mm, names.text()));
}

Result<void> check_crossings(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                             const std::vector<OrderedCut>& order,
                             const std::vector<std::optional<std::size_t>>& met,
                             const ProfileOptions& options, ProfileProgram& program) {
  CutNames names;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!met[k]) continue;
    ++program.crossed_leads;
    names.add(fmt::format("{} (in the kerf of {})", name_of_cut(parts, cuts[order[k].cut]),
                          name_of_cut(parts, cuts[*met[k]])));
  }
  if (names.empty() || options.pierce_diameter_mm == 0) return {};
  return failure(ErrorCode::bad_input, fmt::format("a pierce of {:g} mm or its lead would meet a kerf that "
                                                   "is there before it, for {}; gaps of {:g} mm "
                                                   "are enough, or pierce smaller",
                                                   options.pierce_diameter_mm, names.text(),
                                                   options.pierce_diameter_mm + options.kerf_mm));
}

void tell_heat(const std::vector<Starts>& starts, const std::vector<OrderedCut>& order,
               const KerfsAround& kerfs, const ProfileOptions& options, ProfileProgram& program) {
  if (options.heat_spread_mm == 0) return;
  program.nearest_start_mm = std::numeric_limits<double>::infinity();
  const Resolution resolution = resolution_of(options);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Start& start = starts[order[k].cut].choices[order[k].start];
    const double apart = kerfs.distance(order[k - 1].cut, resolution.mm(start.pierce));
    program.nearest_start_mm = std::min(program.nearest_start_mm, apart);
    if (apart < options.heat_spread_mm) ++program.near_starts;
  }
}

}  // namespace lekalo::nc
