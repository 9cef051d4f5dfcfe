#include <fmt/core.h>

#include "export_word_taker.hpp"

namespace lekalo::io::detail {

void ExportWordTaker::complete_engraving(std::vector<std::string>& complaints) {
  nc::ProfileOptions& p = request_.profile;
  const bool router = p.process == nc::Process::router;
  bool is_any = false;
  for (const char* word : {"engrave-feed", "engrave-speed", "engrave-depth", "engrave-tool"}) {
    if (!was_given(word)) continue;
    is_any = true;
    if (p.process == nc::Process::plasma)
      complaints.push_back(
          fmt::format("{} has no meaning for torches and jets of water, which cut through: "
                      "leave it out",
                      shown_(word)));
  }
  if (!is_any || p.process == nc::Process::plasma) return;
  if (!was_given("engrave-feed"))
    complaints.push_back(
        fmt::format("{} is missing: the speed of engraving in mm/min", shown_("engrave-feed")));
  if (router && !was_given("engrave-depth"))
    complaints.push_back(
        fmt::format("{} is missing: how deep a router engraves, in mm", shown_("engrave-depth")));
  if (router && p.depth_mm > 0 && engraving_.depth_mm >= p.depth_mm)
    complaints.push_back(fmt::format("{} {:g}: has to be less than the {} of {:g} mm, which cuts through",
                                     shown_("engrave-depth"), engraving_.depth_mm, shown_("depth"),
                                     p.depth_mm));
  for (const char* word : {"engrave-depth", "engrave-tool"})
    if (!router && was_given(word))
      complaints.push_back(
          fmt::format("{} has a meaning for routers alone: {} router", shown_(word), shown_("process")));
  if (router && was_given("engrave-tool")) {
    if (!was_given("tool"))
      complaints.push_back(fmt::format("{} is missing: the number of the tool that cuts", shown_("tool")));
    else if (engraving_.tool != p.tool && !p.post.changes_tools)
      complaints.push_back(
          fmt::format("{} {}: {} changes no tool on the way; engrave with tool {}, or leave both out",
                      shown_("engrave-tool"), engraving_.tool, p.post.control, p.tool));
  }
  // With the power of the cut marks would be cut through.
  if (!router && p.speed > 0 && !was_given("engrave-speed"))
    complaints.push_back(fmt::format(
        "{} is missing: the power of the beam for engraving, beside that for cuts", shown_("engrave-speed")));
  p.engraving = engraving_;
}

}  // namespace lekalo::io::detail
