#include "profile_words.hpp"

#include <fmt/core.h>

#include <cmath>

namespace lekalo::nc {
namespace {

constexpr int kInchFeedDecimals = 2;

}  // namespace

ProfileWriter::ProfileWriter(const std::string& name, const ProfileOptions& options, bool engraves)
    : options_(options),
      resolution_(resolution_of(options)),
      out_(options.post, options.unit, resolution_.decimals) {
  out_.begin(name);
  comment(fmt::format("kerf {} compensated in the path, no G41 G42", length(options.kerf_mm)));
  for (const HoleCut& hole : options.holes)
    comment(fmt::format("holes up to {} lead {}{}", length(hole.up_to_diameter_mm),
                        length(hole.lead_in_mm.value_or(options.lead_in_mm)),
                        out_.feed(hole.feed_share * options.feed_mm_per_min, kInchFeedDecimals)));
  if (options.corners.wanted())
    comment(fmt::format("corners{} up to {} from each",
                        out_.feed(options.corners.feed_share * options.feed_mm_per_min, kInchFeedDecimals),
                        length(options.corners.distance_mm)));
  if (options.pierce_diameter_mm > 0)
    comment(fmt::format("pierces {} clear of parts and of earlier cuts", length(options.pierce_diameter_mm)));
  if (options.joints.wanted()) comment(fmt::format("joints {}", length(options.joints.width_mm)));
  out_.lines(options.post.profile.modes);
  if (options.process != Process::router) return;
  const bool begins_with_marks = engraves && has_tool_of_marks();
  start_router(begins_with_marks ? options.engraving->tool : options.tool,
               begins_with_marks && options.engraving->speed > 0 ? options.engraving->speed : options.speed);
}

bool ProfileWriter::has_tool_of_marks() const {
  return options_.engraving && options_.engraving->tool > 0 && options_.engraving->tool != options_.tool;
}

void ProfileWriter::start_router(int tool, double speed) {
  if (tool > 0) out_.lines(options_.post.tool_change, {{"{tool}", std::to_string(tool)}});
  out_.line("G0 Z" + length(options_.safe_height_mm));
  out_.line(fmt::format("M3 S{:.0f}", speed));
}

void ProfileWriter::cut(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path,
                        double feed_mm_per_min) {
  rapid_to(lead.empty() ? path.front().from : lead.front().from);
  if (options_.process == Process::router)
    cut_by_router(lead, path, feed_mm_per_min);
  else
    cut_by_beam(lead, path, feed_mm_per_min);
}

void ProfileWriter::cut_by_beam(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path,
                                double feed) {
  const std::string_view on = options_.process == Process::laser ? options_.post.laser_on : "M3";
  out_.line(fmt::format("{}{}", on, options_.speed > 0 ? fmt::format(" S{:.0f}", options_.speed) : ""));
  const auto& [units_per_second, decimals] = options_.post.dwell;
  if (options_.pierce_s > 0)
    out_.line(fmt::format("G4 P{:.{}f}", units_per_second * options_.pierce_s, decimals));
  follow(lead, feed, true);
  follow(path, feed, lead.empty());
  out_.line("M5");
}

void ProfileWriter::cut_by_router(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path,
                                  double feed) {
  const double pass = options_.pass_mm > 0 ? options_.pass_mm : options_.depth_mm;
  const auto passes = static_cast<int>(std::ceil(options_.depth_mm / pass * (1 - 1e-12)));
  const double tabs = options_.depth_mm - options_.joints.tab_height_mm;
  for (int k = 1; k <= passes; ++k) {
    const double z = k == passes ? options_.depth_mm : k * pass;
    // A line ends elsewhere than it begins.
    if (k > 1 && path.back().to != path.front().from) {
      out_.line("G0 Z" + length(options_.safe_height_mm));
      rapid_to(path.front().from);
    }
    out_.line("G1 Z" + length(-z) + out_.feed(options_.plunge_mm_per_min, kInchFeedDecimals));
    // Later passes go down where the contour closes, in the kerf that is already there.
    if (k == 1) follow(lead, feed, true);
    const bool says_feed = k > 1 || lead.empty();
    if (z > tabs)
      follow_with_tabs(path, z, feed, says_feed);
    else
      follow(path, feed, says_feed);
  }
  out_.line("G0 Z" + length(options_.safe_height_mm));
}

void ProfileWriter::follow_with_tabs(const std::vector<WrittenEdge>& path, double depth, double cut_feed,
                                     bool says_feed) {
  const double tabs = options_.depth_mm - options_.joints.tab_height_mm;
  for (std::size_t k = 0; k < path.size();) {
    std::size_t end = k;
    while (end < path.size() && path[end].joint == path[k].joint) ++end;
    if (k > 0)
      out_.line("G1 Z" + length(path[k].joint ? -tabs : -depth) +
                out_.feed(options_.plunge_mm_per_min, kInchFeedDecimals));
    follow({path.begin() + static_cast<std::ptrdiff_t>(k), path.begin() + static_cast<std::ptrdiff_t>(end)},
           cut_feed, k > 0 || says_feed);
    k = end;
  }
}

std::string ProfileWriter::finish() {
  out_.line("M5");
  rapid_to({0, 0});
  return out_.finish(options_.post.profile.end);
}

void ProfileWriter::follow(const std::vector<WrittenEdge>& edges, double feed, bool says_feed) {
  bool slow = false;
  for (const WrittenEdge& edge : edges) {
    std::string words = edge.kind == geom::EdgeKind::line      ? "G1"
                        : edge.kind == geom::EdgeKind::arc_ccw ? "G3"
                                                               : "G2";
    words += out_.pair('X', 'Y', edge.to);
    if (edge.kind != geom::EdgeKind::line)
      words += out_.pair('I', 'J', {edge.centre.x - edge.from.x, edge.centre.y - edge.from.y});
    if (says_feed || edge.slow != slow)
      words += out_.feed(edge.slow ? options_.corners.feed_share * feed : feed, kInchFeedDecimals);
    says_feed = false, slow = edge.slow;
    out_.line(words);
  }
}

std::string ProfileWriter::length(double mm) const { return out_.number(resolution_.rounded({mm, 0}).x); }

}  // namespace lekalo::nc
