#include "profile_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {
namespace {

/// Controls read short comments in capitals; what is not a letter or digit may act in one of them.
std::string plain(const std::string& words) {
  constexpr std::size_t kLongest = 60;
  std::string text;
  for (const char c : words) {
    const bool lower = c >= 'a' && c <= 'z', kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    const char put = lower ? static_cast<char>(c - 'a' + 'A') : kept || c == '.' || c == '-' ? c : ' ';
    if (put == ' ' && (text.empty() || text.back() == ' ')) continue;
    if (text.size() < kLongest) text += put;
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

ProfileWriter::ProfileWriter(const std::string& name, const ProfileOptions& options)
    : options_(options), resolution_(resolution_of(options)) {
  const bool fanuc = options.post == Post::fanuc, grbl = options.post == Post::grbl;
  const std::string unit = options.unit == LengthUnit::inch ? "G20" : "G21";
  if (fanuc) line("%"), line("O0001 (" + plain(name) + ")");
  if (!fanuc) comment(name);
  comment(fmt::format("kerf {} compensated in the path, no G41 G42", length(options.kerf_mm)));
  line(unit + " G17 G90");
  if (grbl) line("G40 G49 G54 G94 G91.1");  // G80 and path modes it takes as they are
  if (fanuc) line("G40 G49 G80 G54 G94");
  // Exact path: blending would leave the proved path at corners.
  if (!fanuc && !grbl) line("G40 G49 G80 G54 G94 G91.1 G61");
  if (options.process == Process::router) {
    line(fmt::format("G0 Z{}", length(options.safe_height_mm)));
    line(fmt::format("M3 S{:.0f}", options.speed));
  }
}

void ProfileWriter::comment(const std::string& words) {
  const std::string text = plain(words);
  if (!text.empty()) line("(" + text + ")");
}

void ProfileWriter::cut(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path) {
  rapid_to(lead.empty() ? path.front().from : lead.front().from);
  if (options_.process != Process::router) {
    const bool follows_speed = options_.post == Post::grbl && options_.process == Process::laser;
    line(std::string(follows_speed ? "M4" : "M3") +
         (options_.speed > 0 ? fmt::format(" S{:.0f}", options_.speed) : ""));
    if (options_.pierce_s > 0) {
      // In milliseconds without a point for Fanuc, elsewhere in seconds.
      line(options_.post == Post::fanuc ? fmt::format("G4 P{:.0f}", 1000 * options_.pierce_s)
                                        : fmt::format("G4 P{:.3f}", options_.pierce_s));
    }
    follow(lead, true);
    follow(path, lead.empty());
    line("M5");
    return;
  }
  const double pass = options_.pass_mm > 0 ? options_.pass_mm : options_.depth_mm;
  const auto passes = static_cast<int>(std::ceil(options_.depth_mm / pass * (1 - 1e-12)));
  for (int k = 1; k <= passes; ++k) {
    const double z = k == passes ? options_.depth_mm : k * pass;
    line(fmt::format("G1 Z{} F{}", length(-z), feed(options_.plunge_mm_per_min)));
    // Later passes go down where the contour closes, in the kerf that is already there.
    if (k == 1) follow(lead, true);
    follow(path, k > 1 || lead.empty());
  }
  line(fmt::format("G0 Z{}", length(options_.safe_height_mm)));
}

std::string ProfileWriter::finish() {
  line("M5");
  rapid_to({0, 0});
  line(options_.post == Post::fanuc ? "M30" : "M2");
  if (options_.post == Post::fanuc) line("%");
  return std::move(text_);
}

void ProfileWriter::line(const std::string& words) {
  text_ += words;
  text_ += '\n';
}

void ProfileWriter::rapid_to(WrittenPoint p) { line(fmt::format("G0 X{} Y{}", count(p.x), count(p.y))); }

void ProfileWriter::follow(const std::vector<WrittenEdge>& edges, bool feed_changed) {
  for (const WrittenEdge& edge : edges) {
    std::string words = edge.kind == geom::EdgeKind::line      ? "G1"
                        : edge.kind == geom::EdgeKind::arc_ccw ? "G3"
                                                               : "G2";
    words += fmt::format(" X{} Y{}", count(edge.to.x), count(edge.to.y));
    if (edge.kind != geom::EdgeKind::line)
      words +=
          fmt::format(" I{} J{}", count(edge.centre.x - edge.from.x), count(edge.centre.y - edge.from.y));
    if (feed_changed) words += " F" + feed(options_.feed_mm_per_min);
    feed_changed = false;
    line(words);
  }
}

std::string ProfileWriter::length(double mm) const { return count(resolution_.rounded({mm, 0}).x); }

std::string ProfileWriter::feed(double mm_per_min) const {
  return options_.unit == LengthUnit::inch ? fmt::format("{:.2f}", mm_per_min / kMillimetresPerInch)
                                           : fmt::format("{:.1f}", mm_per_min);
}

std::string ProfileWriter::count(std::int64_t units) const {
  return format_decimal(units, resolution_.decimals);
}

}  // namespace lekalo::nc
