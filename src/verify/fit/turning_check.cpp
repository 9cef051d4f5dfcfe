#include "turning_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

constexpr double kHalfDecimal = 5.1e-5;  // mm, of a diameter and of z
constexpr double kLead = 1;              // mm
constexpr double kOff = 0.1;             // mm, of a diameter: no surface is as far off its nominal one

std::optional<double> decimal_of(std::string_view word) {
  const std::optional<Decimal> value = parse_decimal(word);
  if (!value) return {};
  return approximate(*value);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The points of a file against those of the profile.
std::optional<std::string> fault_of_points(const std::vector<ProfilePoint>& found,
                                           const std::vector<ProfilePoint>& profile) {
  if (found.size() != profile.size())
    return fmt::format("it has {} points and is to have {}", found.size(), profile.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!(std::abs(found[i].z - profile[i].z) <= kHalfDecimal &&
          std::abs(found[i].diameter - profile[i].diameter) <= kHalfDecimal))
      return fmt::format("its point {} is z {}, diameter {}, and is to be {}, {}", i, found[i].z,
                         found[i].diameter, profile[i].z, profile[i].diameter);
  return {};
}

/// A program line by line, with the place of the tool and the modes that were said.
class TurningProgram {
 public:
  TurningProgram(const std::vector<ProfilePoint>& profile, const TurningClaim& claim)
      : profile_(profile), claim_(claim), face_(claim.face) {
    for (const ProfilePoint& p : profile)
      least_ = std::min(least_, p.diameter), most_ = std::max(most_, p.diameter);
  }

  std::optional<std::string> fault(std::string_view text) {
    std::size_t count = 0;
    for (const std::string_view line : lines_of(text)) {
      ++count;
      if (const auto why = take(line)) return fmt::format("line {}: {}", count, *why);
    }
    if (!ended_) return "it does not end with M5 and M30";
    if (cut_.size() != profile_.size() + 2)
      return fmt::format("it cuts {} points of {}", cut_.size(), profile_.size() + 2);
    if (on_seat() && !(is_beside(cut_.front(), profile_.front()) && is_beside(cut_.back(), profile_.back())))
      return "it does not come onto the seat and go off it along X";
    // No rapid motion goes farther than to before the part, so that the cuts begin there.
    if (!on_seat() && !(cut_.back().z <= profile_.back().z - kLead + kHalfDecimal))
      return "it does not end behind the part";
    return fault_of_points({cut_.begin() + 1, cut_.end() - 1}, profile_);
  }

 private:
  [[nodiscard]] bool on_seat() const { return claim_.surface == TurnedSurface::seat; }
  /// At the same place along the axis, off the surface.
  [[nodiscard]] bool is_beside(const ProfilePoint& place, const ProfilePoint& of) const {
    return std::abs(place.z - of.z) <= kHalfDecimal && place.diameter - most_ >= kOff;
  }

  std::optional<std::string> take(std::string_view line) {
    if (ended_)
      return line == "%" && claim_.fanuc ? std::nullopt : std::optional<std::string>("something follows M30");
    if (line.empty() || (claim_.fanuc && (line == "%" || line == "O0001")) ||
        (line.front() == '(' && line.find(')') == line.size() - 1))
      return {};
    std::optional<double> x, z;
    std::string motion;
    while (!line.empty()) {
      const std::size_t end = std::min(line.find(' '), line.size());
      const std::string_view word = line.substr(0, end);
      line.remove_prefix(std::min(end + 1, line.size()));
      if (const auto why = take_word(word, x, z, motion)) return why;
    }
    if (motion.empty() != !(x || z)) return "a place without a motion, or the other way round";
    return motion.empty() ? std::nullopt : move(motion, x, z);
  }

  std::optional<std::string> take_word(std::string_view word, std::optional<double>& x,
                                       std::optional<double>& z, std::string& motion) {
    const std::optional<double> value = !word.empty() ? decimal_of(word.substr(1)) : std::nullopt;
    if (!value) return fmt::format("{} is no word", word);
    if (word[0] == 'X') {
      x = *value * (claim_.radius ? 2 : 1);
    } else if (word[0] == 'Z') {
      z = *value + face_;
    } else if (word[0] == 'F') {
      if (*value != claim_.feed) return "the feed is another";
      modes_.insert("F");
    } else if (word[0] == 'S') {
      if (*value != claim_.spindle) return "the speed of the spindle is another";
      modes_.insert("S");
    } else if (word == "G0" || word == "G1") {
      if (!motion.empty()) return "two motions";
      motion = word;
    } else if (word == "M5" || word == "M30") {
      ended_ = word == "M30" && modes_.contains("M5");
      if (word == "M30" && !ended_) return "M30 comes before M5";
      modes_.insert(std::string(word));
    } else {
      static const std::set<std::string_view> linuxcnc{"G21", "G18", "G40", "G80", "G61",
                                                       "G90", "G94", "G97", "M3"};
      static const std::set<std::string_view> fanuc{"G21", "G18", "G40", "G80", "G97", "G98", "M3"};
      const bool known = (claim_.fanuc ? fanuc : linuxcnc).contains(word) ||
                         (!claim_.fanuc && word == (claim_.radius ? "G8" : "G7"));
      if (!known) return fmt::format("{} is no word of such a program", word);
      modes_.insert(std::string(word));
    }
    return {};
  }

  std::optional<std::string> move(const std::string& motion, std::optional<double> x,
                                  std::optional<double> z) {
    const std::size_t modes = claim_.fanuc ? 7 : 10;  // with M3, besides S
    if (modes_.size() - modes_.count("F") - modes_.count("M5") - modes_.count("S") < modes ||
        !modes_.contains("S"))
      return "a motion before all modes are said";
    if (modes_.contains("M5")) return "a motion after the spindle stands";
    const double from_z = z_.value_or(1e300);
    const double to_x = x ? *x : x_.value_or(NAN), to_z = z ? *z : z_.value_or(NAN);
    if (motion == "G0") {
      const bool before = std::min(from_z, to_z) >= face_ + kLead - kHalfDecimal;
      // Behind the part the tool goes off the surface, and back along it only at a distance.
      const bool done = cut_.size() == profile_.size() + 2;
      const double at_x = z && x_ ? *x_ : to_x;
      const double off = claim_.surface == TurnedSurface::bore ? least_ - at_x : at_x - most_;
      const bool behind = (done || (on_seat() && z)) && !(x && z) && off >= kOff;
      if (!before && !behind) return "a rapid motion at the part";
    } else {
      if (!x_ || !z_ || !modes_.contains("F")) return "a cut from a place, or with a feed, that was not said";
      if (cut_.empty()) cut_.push_back({*z_, *x_});
      cut_.push_back({to_z, to_x});
    }
    if (x) x_ = x;
    if (z) z_ = z;
    return {};
  }

  const std::vector<ProfilePoint>& profile_;
  const TurningClaim& claim_;
  double face_, least_ = HUGE_VAL, most_ = -HUGE_VAL;
  std::set<std::string> modes_;
  std::optional<double> x_, z_;    // a diameter; z from the middle
  std::vector<ProfilePoint> cut_;  // the ends of all cuts
  bool ended_ = false;
};

}  // namespace

std::optional<std::string> fault_of_profile_table(std::string_view text,
                                                  const std::vector<ProfilePoint>& profile) {
  std::vector<ProfilePoint> found;
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty() || lines[0] != "z_mm,diameter_mm") return "its first line is not z_mm,diameter_mm";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::size_t comma = std::min(lines[i].find(','), lines[i].size());
    const auto z = decimal_of(lines[i].substr(0, comma));
    const auto diameter = comma < lines[i].size() ? decimal_of(lines[i].substr(comma + 1)) : std::nullopt;
    if (!z || !diameter) return fmt::format("line {} is not two numbers", i + 1);
    found.push_back({*z, *diameter});
  }
  return fault_of_points(found, profile);
}

std::optional<std::string> fault_of_profile_drawing(std::string_view text,
                                                    const std::vector<ProfilePoint>& profile) {
  const std::vector<std::string_view> lines = lines_of(text);
  std::vector<ProfilePoint> found;
  std::vector<std::string_view> entities;
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    const std::string_view code = lines[i], value = lines[i + 1];
    if (code == "0") entities.push_back(value);
    const bool vertex = !entities.empty() && entities.back() == "VERTEX";
    if (code == "10" || code == "20") {
      const auto place = decimal_of(value);
      if (!vertex || !place) return fmt::format("line {} is no coordinate of a vertex", i + 2);
      if (code == "10")
        found.push_back({*place, NAN});
      else if (!found.empty())
        found.back().diameter = 2 * *place;
    } else if (code == "70" && value != "0" && value != "4") {
      return fmt::format("line {} closes or bends what is to be open", i + 2);
    } else if (code == "42") {
      return fmt::format("line {} bends what is to be straight", i + 2);
    }
  }
  std::vector<std::string_view> wanted{"SECTION", "ENDSEC", "SECTION", "POLYLINE"};
  wanted.insert(wanted.end(), profile.size(), "VERTEX");
  wanted.insert(wanted.end(), {"SEQEND", "ENDSEC", "EOF"});
  if (entities != wanted || lines.size() % 2 != 0) return "it is not one polyline of so many points";
  return fault_of_points(found, profile);
}

std::optional<std::string> fault_of_turning(std::string_view text, const std::vector<ProfilePoint>& profile,
                                            const TurningClaim& claim) {
  return TurningProgram(profile, claim).fault(text);
}

}  // namespace lekalo::verify
