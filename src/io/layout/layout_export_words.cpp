#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "export_word_taker.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::io {
namespace detail {

Result<void> ExportWordTaker::take(const ExportWord& word) {
  const auto known = std::find_if(export_words().begin(), export_words().end(),
                                  [&](const ExportWordHelp& help) { return help.name == word.first; });
  const auto& [name, value] = word;
  if (known == export_words().end())
    return failure(ErrorCode::usage, fmt::format("there is no option {}", shown_(name)));
  if (!fits_form(name))
    return failure(ErrorCode::usage,
                   fmt::format("{} has no meaning for the form {}", shown_(name), form_name()));
  given_.push_back(name);
  nc::ProfileOptions& p = request_.profile;
  if (name == "sheet") {
    request_.sheet = value;
    return {};
  }
  if (name == "only") return layers(value);
  if (name == "unit")
    return choice(word, {{"mm", LengthUnit::millimetre}, {"inch", LengthUnit::inch}}, request_.unit);
  if (name == "post") return post(word);
  if (name == "process") return process(word);
  if (name == "lead")
    return choice(word, {{"line", nc::LeadShape::line}, {"arc", nc::LeadShape::arc}}, p.lead);
  if (name == "tolerance" && request_.form == ExportForm::hpgl)
    return number(word, 1e-4, 10, request_.chord_tolerance_mm);
  if (is_knife_word(name)) return knife_number(word);
  if (name == "slats") return choice(word, {{"x", true}, {"y", false}}, p.joints.slats.along_x);
  if (name == "common-line") return choice(word, {{"yes", true}, {"no", false}}, p.common_line);
  if (name == "tool") return tool_number(word, p.tool);
  if (name == "engrave-tool") return tool_number(word, engraving_.tool);
  if (name == "joints") return joint_rule(word);
  if (name == "joints-of") return joints_of(word);
  return profile_number(word);
}

std::vector<std::string> ExportWordTaker::complete() {
  std::vector<std::string> complaints;
  if (request_.form == ExportForm::hpgl) complete_knife(complaints);
  if (request_.form != ExportForm::gcode) return complaints;
  const auto needs = [&](const char* name, const char* why) {
    if (!was_given(name)) complaints.push_back(fmt::format("{} is missing: {}", shown_(name), why));
  };
  nc::ProfileOptions& p = request_.profile;
  needs("kerf", "the width of the cut in mm");
  needs("feed", "the speed of the cut in mm/min");
  const bool router = p.process == nc::Process::router;
  if (router || (p.post.laser_needs_power && p.process == nc::Process::laser))
    needs("speed", router ? "the speed of the spindle, the S word"
                          : "the power of the beam, the S word; without it the beam stays dark");
  if (router) {
    needs("depth", "how deep a router cuts, in mm");
    needs("plunge", "how fast a router goes down, in mm/min");
  }
  for (const char* name : {"depth", "pass", "safe-height", "plunge", "tab-height", "tool"})
    if (!router && was_given(name))
      complaints.push_back(
          fmt::format("{} has a meaning for routers alone: {} router", shown_(name), shown_("process")));
  if (router && p.pierce_s > 0)
    complaints.push_back(fmt::format("{} has no meaning for routers: leave it out", shown_("pierce")));
  complain_of_joints(complaints);
  if (was_given("corner-feed")) needs("corner-distance", "how near a corner the cut is slow, in mm");
  if (was_given("corner-distance")) needs("corner-feed", "the share of the feed near corners");
  for (const char* name : {"joints", "joints-of", "heat-spread"})
    if (p.common_line && was_given(name))
      complaints.push_back(fmt::format("{} and {} do not go together: leave one of them out",
                                       shown_("common-line"), shown_(name)));
  if (p.common_line && p.lead == nc::LeadShape::arc)
    complaints.push_back(fmt::format("{} and {} arc do not go together: take lines for leads",
                                     shown_("common-line"), shown_("lead")));
  if (!was_given("tolerance")) p.tolerance_mm = std::min(p.tolerance_mm, 0.25 * p.kerf_mm);
  if (!(p.tolerance_mm <= 0.25 * p.kerf_mm))
    complaints.push_back(fmt::format("{} {:g}: has to be at most a quarter of the kerf of {:g} mm",
                                     shown_("tolerance"), p.tolerance_mm, p.kerf_mm));
  complete_engraving(complaints);
  complain_of_pierces(complaints);
  return complaints;
}

bool ExportWordTaker::was_given(const char* name) const {
  return std::find(given_.begin(), given_.end(), name) != given_.end();
}

const char* ExportWordTaker::form_name() const {
  constexpr const char* kNames[] = {"dxf", "svg", "hpgl", "gcode"};
  return kNames[static_cast<int>(request_.form)];
}

bool ExportWordTaker::fits_form(const std::string& name) const {
  const bool gcode = request_.form == ExportForm::gcode;
  if (name == "sheet") return true;
  if (name == "only") return !gcode;
  if (name == "unit") return gcode || request_.form == ExportForm::dxf;
  if (name == "tolerance" || name == "process") return gcode || request_.form == ExportForm::hpgl;
  if (is_knife_word(name)) return request_.form == ExportForm::hpgl;
  return gcode;
}

Result<void> ExportWordTaker::layers(const std::string& value) {
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    const std::string layer = value.substr(begin, end - begin);
    if (std::none_of(std::begin(kExportLayers), std::end(kExportLayers),
                     [&](const char* k) { return layer == k; }))
      return failure(ErrorCode::usage, fmt::format("{} {}: the layers are {}", shown_("only"), value,
                                                   joined_text(kExportLayers, ", ")));
    request_.only.push_back(layer);
    begin = end + 1;
  }
  return {};
}

template <class T>
Result<void> ExportWordTaker::choice(const ExportWord& word,
                                     std::initializer_list<std::pair<const char*, T>> choices, T& to) const {
  std::string list;
  for (const auto& [name, value] : choices) {
    if (word.second == name) {
      to = value;
      return {};
    }
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  return none_of(word, list);
}

Result<void> ExportWordTaker::post(const ExportWord& word) {
  const nc::Dialect* const known = nc::post_named(word.second);
  if (known == nullptr) return none_of(word, nc::post_names(", ", ", "));
  request_.profile.post = *known;
  return {};
}

tl::unexpected<Error> ExportWordTaker::none_of(const ExportWord& word, const std::string& list) const {
  return failure(ErrorCode::usage,
                 fmt::format("{} {}: has to be one of {}", shown_(word.first), word.second, list));
}

Result<void> ExportWordTaker::number(const ExportWord& word, double low, double high, double& to) const {
  const std::string& text = word.second;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
    return failure(ErrorCode::usage, fmt::format("{} {}: has to be a number from {:g} to {:g}",
                                                 shown_(word.first), text, low, high));
  to = value;
  return {};
}

Result<void> ExportWordTaker::tool_number(const ExportWord& word, int& to) const {
  double value = 0;
  LEKALO_CHECK(number(word, 1, 9999, value));
  if (value != std::floor(value))
    return failure(ErrorCode::usage,
                   fmt::format("{} {}: has to be a whole number", shown_(word.first), word.second));
  to = static_cast<int>(value);
  return {};
}

Result<void> ExportWordTaker::profile_number(const ExportWord& word) {
  struct Number {
    const char* name;
    double low, high;
    double* to;
  };
  nc::ProfileOptions& p = request_.profile;
  const Number numbers[] = {{"kerf", 0.01, 100, &p.kerf_mm},
                            {"tolerance", 1e-4, 25, &p.tolerance_mm},
                            {"lead-in", 0, 1000, &p.lead_in_mm},
                            {"feed", 0.1, 1e6, &p.feed_mm_per_min},
                            {"speed", 1, 1e6, &p.speed},
                            {"pierce", 0, 100, &p.pierce_s},
                            {"depth", 0.01, 1000, &p.depth_mm},
                            {"pass", 0.01, 1000, &p.pass_mm},
                            {"safe-height", 0.1, 1000, &p.safe_height_mm},
                            {"plunge", 0.1, 1e6, &p.plunge_mm_per_min},
                            {"engrave-feed", 0.1, 1e6, &engraving_.feed_mm_per_min},
                            {"engrave-speed", 1, 1e6, &engraving_.speed},
                            {"engrave-depth", 0.01, 1000, &engraving_.depth_mm},
                            {"pierce-diameter", 0.01, 100, &p.pierce_diameter_mm},
                            {"heat-spread", 0, 1e4, &p.heat_spread_mm},
                            {"corner-feed", 0.01, 1, &p.corners.feed_share},
                            {"corner-distance", 0.01, 1000, &p.corners.distance_mm},
                            {"joints-up-to", 0.1, 1e4, &p.joints.up_to_mm},
                            {"joint-width", 0.05, 50, &p.joints.width_mm},
                            {"slat-pitch", 1, 1000, &p.joints.slats.pitch_mm},
                            {"tab-height", 0.01, 1000, &p.joints.tab_height_mm}};
  for (const Number& one : numbers)
    if (word.first == one.name) return number(word, one.low, one.high, *one.to);
  return {};
}

}  // namespace detail

const std::vector<ExportWordHelp>& export_words() {
  static const std::vector<ExportWordHelp> words{
      {"sheet", "STOCK[#COPY]", "This sheet alone [all in use]"},
      {"only", "LAYER,...",
       "dxf, svg, hpgl: these layers alone: CUT, MARK, LABEL, SHEET, DEFECT, ZONE, AREA"},
      {"unit", "mm|inch", "dxf, gcode: of the numbers written [mm]"},
      {"tolerance", "MM", "hpgl: chords from arcs [0.02]; gcode: how far the kerf may enter a part [0.01]"},
      {"kerf", "MM", "gcode: width of the cut"},
      {"feed", "MM/MIN", "gcode: speed of the cut"},
      {"lead-in", "MM", "gcode: length of a lead, or radius of an arc [0: none]"},
      {"lead", "line|arc", "gcode: shape of a lead [line]"},
      {"post", nc::post_names("|", "|"), fmt::format("gcode: the control [{}]", nc::posts().front().name)},
      {"process", "laser|plasma|waterjet|router|drag-knife|tangential-knife",
       "gcode: the tool [laser]; hpgl: the knife [a pen]"},
      {"speed", "S", "gcode: the S word: speed of a spindle, power of a beam"},
      {"pierce", "S", "gcode: seconds to wait for the pierce [0]"},
      {"depth", "MM", "gcode, router: depth below Z 0"},
      {"pass", "MM", "gcode, router: depth of one pass [all at once]"},
      {"safe-height", "MM", "gcode, router: Z of travels [5]"},
      {"plunge", "MM/MIN", "gcode, router: speed downwards"},
      {"tool", "N", "gcode, router: change to this tool to cut, with its length [it is in the spindle]"},
      {"engrave-tool", "N", "gcode, router: change to this tool to engrave [that of the cuts]"},
      {"engrave-feed", "MM/MIN", "gcode: speed along lines and texts on parts [they are not engraved]"},
      {"engrave-speed", "S", "gcode: the S word of engraving"},
      {"engrave-depth", "MM", "gcode, router: depth of engraving below Z 0"},
      {"pierce-diameter", "MM", "gcode: what a pierce burns; kept clear of parts and of earlier cuts"},
      {"heat-spread", "MM", "gcode: begin so far from the cut before, where there is a choice [0]"},
      {"corner-feed", "SHARE", "gcode: of the feed, near corners [1]"},
      {"corner-distance", "MM", "gcode, with corner-feed: how near a corner, along the cut"},
      {"common-line", "", "gcode: cut edges once that two parts have in common, at one kerf"},
      {"joints", "N|tipping", "gcode: joints on each part, or as many as keep it from tipping [none]"},
      {"joints-of", "ID=N,...", "gcode: these placements have so many joints instead"},
      {"joints-up-to", "MM", "gcode: joints on parts up to this size alone, corner to corner [all]"},
      {"joint-width", "MM", "gcode: the material that a joint leaves"},
      {"slat-pitch", "MM", "gcode, joints tipping: from one slat of the table to the next"},
      {"slats", "x|y", "gcode, joints tipping: the axis along which slats run [y]"},
      {"tab-height", "MM", "gcode, router: height of the tabs that joints are"},
      {"blade-offset", "MM", "hpgl, drag-knife: from the axis of the blade back to its tip"},
      {"turn-above", "DEG", "hpgl, knives: corners to swivel [5], or to lift, turn and lower at [20]"},
      {"overcut", "MM", "hpgl, knives: go on so far where a cut began [0]"},
      {"knife-tolerance", "MM", "hpgl, knives: how far the tip may be from an outline [0.1]"}};
  return words;
}

Result<ExportRequest> read_export_words(ExportForm form, const std::vector<ExportWord>& words,
                                        const std::string& prefix) {
  ExportRequest request;
  request.form = form;
  detail::ExportWordTaker taker(request, [&](const std::string& name) { return prefix + name; });
  for (const ExportWord& word : words) LEKALO_CHECK(taker.take(word));
  if (const std::vector<std::string> complaints = taker.complete(); !complaints.empty())
    return failure(ErrorCode::usage, complaints.front());
  request.profile.unit = request.unit;
  return request;
}

}  // namespace lekalo::io
