#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "export_word_taker.hpp"

namespace lekalo::io::detail {
namespace {

constexpr std::size_t kMostJoints = 20;

/// Reads a whole number without sign; false for anything else.
template <class Whole>
bool whole_number(std::string_view text, Whole& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Result<void> ExportWordTaker::joint_rule(const ExportWord& word) {
  nc::JointOptions& joints = request_.profile.joints;
  std::size_t count = 0;
  const bool is_count = whole_number(word.second, count) && count >= 1 && count <= kMostJoints;
  if (is_count || word.second == "tipping") {
    joints.rule = is_count ? nc::JointRule::count : nc::JointRule::tipping;
    joints.count = count;
    return {};
  }
  return failure(ErrorCode::usage, fmt::format("{} {}: has to be tipping, or a whole number from 1 to {}",
                                               shown_(word.first), word.second, kMostJoints));
}

Result<void> ExportWordTaker::joints_of(const ExportWord& word) {
  auto& of = request_.profile.joints.of;
  std::string_view rest = word.second;
  while (true) {
    const std::string_view item = rest.substr(0, rest.find(','));
    const std::size_t middle = std::min(item.find('='), item.size());
    std::uint64_t id = 0;
    std::size_t count = 0;
    if (middle == item.size() || !whole_number(item.substr(0, middle), id) ||
        !whole_number(item.substr(middle + 1), count) || count > kMostJoints)
      return failure(
          ErrorCode::usage,
          fmt::format("{} {}: has to be numbers of placements with 0 to {} joints each, like 12=3,14=0",
                      shown_(word.first), word.second, kMostJoints));
    if (std::any_of(of.begin(), of.end(), [&](const auto& before) { return before.first == id; }))
      return failure(ErrorCode::usage, fmt::format("{} {}: placement {} stands there twice",
                                                   shown_(word.first), word.second, id));
    of.emplace_back(id, count);
    if (item.size() == rest.size()) return {};
    rest.remove_prefix(item.size() + 1);
  }
}

void ExportWordTaker::complain_of_pierces(std::vector<std::string>& complaints) const {
  const nc::ProfileOptions& p = request_.profile;
  if (!was_given("pierce-diameter")) return;
  if (p.process == nc::Process::router)
    complaints.push_back(
        fmt::format("{} has no meaning for routers: leave it out", shown_("pierce-diameter")));
  else if (!(p.pierce_diameter_mm >= p.kerf_mm))
    complaints.push_back(fmt::format("{} {:g}: has to be at least the kerf of {:g} mm",
                                     shown_("pierce-diameter"), p.pierce_diameter_mm, p.kerf_mm));
  else if (const double least = nc::least_lead_mm(p); !(p.lead_in_mm >= least))
    complaints.push_back(
        fmt::format("{} {:g}: a pierce of {:g} mm and a kerf of {:g} mm need a lead of at least "
                    "{:g} mm, or the pierce burns into the part",
                    shown_("lead-in"), p.lead_in_mm, p.pierce_diameter_mm, p.kerf_mm, least));
}

void ExportWordTaker::complain_of_joints(std::vector<std::string>& complaints) const {
  const nc::ProfileOptions& p = request_.profile;
  const bool router = p.process == nc::Process::router;
  const auto needs = [&](const char* name, const char* why) {
    if (!was_given(name)) complaints.push_back(fmt::format("{} is missing: {}", shown_(name), why));
  };
  const auto alone = [&](const char* name, const std::string& goes_with) {
    if (was_given(name))
      complaints.push_back(fmt::format("{} says nothing without {}", shown_(name), goes_with));
  };
  if (p.joints.wanted()) {
    needs("joint-width", "the material that a joint leaves, in mm");
    if (router) needs("tab-height", "how high the tabs of a router are, in mm");
    if (router && was_given("tab-height") && was_given("depth") && !(p.joints.tab_height_mm < p.depth_mm))
      complaints.push_back(fmt::format("{} {:g}: has to be below the depth of {:g} mm", shown_("tab-height"),
                                       p.joints.tab_height_mm, p.depth_mm));
  } else if (!was_given("joints") && !was_given("joints-of")) {
    alone("joint-width", shown_("joints"));
    if (router) alone("tab-height", shown_("joints"));
  }
  if (!was_given("joints")) alone("joints-up-to", shown_("joints"));
  if (p.joints.rule == nc::JointRule::tipping) {
    needs("slat-pitch", "how far apart the slats of the table are, in mm");
  } else if (p.joints.rule == nc::JointRule::count || !was_given("joints")) {
    alone("slat-pitch", shown_("joints") + " tipping");
    alone("slats", shown_("joints") + " tipping");
  }
}

}  // namespace lekalo::io::detail
