#include "summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::cli {
namespace {

constexpr int kLengthDecimals = 9;

double read_back(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Below this a length has no digits left in kLengthDecimals and is printed with an exponent.
constexpr double kTiny = 1e-7;

/// Two digits and an exponent, never above the value.
std::string tiny_down(double value) {
  std::string text = fmt::format("{:.1e}", value);
  for (double lower = value; read_back(text) > value; text = fmt::format("{:.1e}", lower)) {
    lower -= 0.02 * std::abs(value);
  }
  return text;
}
std::string tiny_up(double value) {
  const std::string negated = tiny_down(-value);
  return negated.front() == '-' ? negated.substr(1) : "-" + negated;
}

bool tiny(double value) { return value != 0 && std::abs(value) < kTiny; }
std::string mm_down(double value) {
  return (tiny(value) ? tiny_down(value) : decimals_down(value, kLengthDecimals)) + " mm";
}
std::string mm_up(double value) {
  return (tiny(value) ? tiny_up(value) : decimals_up(value, kLengthDecimals)) + " mm";
}

double degrees(double radians) { return radians * kDegreesPerRadian; }

std::string headline(const io::LocateDocument& d) {
  if (d.scan && !d.scan->proved)
    return "Stretches of the blank are unknown: what follows holds for the rest of it, and is no yes.";
  const bool undecided = d.shortfall > 0 && !d.demands && d.upper_bound && *d.upper_bound >= d.min_allowance;
  if (d.status == "optimal" && undecided)
    return d.min_allowance > 0
               ? fmt::format(
                     "The demanded allowance is kept within {}; whether all of it can be is undecided.",
                     mm_up(d.shortfall))
               : fmt::format("The part fits within {}; whether it fits is undecided.", mm_up(d.shortfall));
  if (d.status == "optimal") return "The best placement was found and proved.";
  if (d.status == "infeasible" && d.demands)
    return "No placement meets the demands; this is proved. The one that misses least:";
  if (d.status == "infeasible") {
    return fmt::format("No placement reaches the demanded allowance of {} mm; this is proved.",
                       d.min_allowance);
  }
  if (d.status == "stopped") return "Stopped early: a placement that holds, maybe not the best.";
  return fmt::format("The placement that --method {} found; it proves nothing about others.", d.method);
}

std::string window_text(const io::LocateDocument& d) {
  if (d.window_from_deg == 0 && d.window_to_deg == 360) return "at any angle";
  return fmt::format("at an angle from {} to {} degrees", d.window_from_deg, d.window_to_deg);
}

std::string pose_lines(const io::LocateDocument& d) {
  const locate::Placement& p = d.placement;
  return fmt::format(
      "  the part lies at   x = {:.6f} mm, y = {:.6f} mm, turned by {:.6f} degrees\n"
      "  minimum allowance  {}{}\n",
      p.x, p.y, degrees(p.theta), mm_down(p.clearance),
      p.clearance < 0 ? ": the part sticks out of the blank" : "");
}

std::string bound_line(const io::LocateDocument& d) {
  if (!d.upper_bound) return "";
  return fmt::format("  proved             no placement {} has more than {}\n", window_text(d),
                     mm_up(*d.upper_bound));
}

std::string demand_line(const io::LocateDocument& d) {
  if (d.demands) return "";
  if (d.shortfall > 0) {
    const bool open = d.upper_bound && *d.upper_bound >= d.min_allowance;
    return fmt::format("  demanded           {} mm: {} are missing{}\n", d.min_allowance, mm_up(d.shortfall),
                       open ? "; the proved bound leaves open whether another placement has them" : "");
  }
  return d.min_allowance > 0 ? fmt::format("  demanded           {} mm: met\n", d.min_allowance) : "";
}

std::string criteria_lines(const io::LocateDocument& d) {
  if (!d.demands) return "";
  const io::DemandRecord& r = *d.demands;
  std::string text =
      r.margin >= 0
          ? fmt::format(
                "  demands            met, with a margin of {:.6f}; no placement {} has more than {:.6f}\n",
                r.margin - 5e-7, window_text(d), r.margin_bound + 5e-7)
          : fmt::format("  demands            {} are missing{}\n", mm_up(d.shortfall),
                        r.margin_bound >= 0
                            ? "; the proved bound leaves open whether another placement meets them"
                            : "");
  text += fmt::format("  largest allowance  {}", mm_up(r.largest));
  if (r.second)
    text += fmt::format("; with a margin of {:.6f} or more none below {} is possible",
                        r.second->margin + 5e-7, mm_down(r.second->bound));
  text += "\n";
  for (const locate::TradeOff& point : r.curve)
    text +=
        fmt::format("  trade-off          margin {:.4f}: largest allowance {:.4f} mm (none below {:.4f})\n",
                    point.margin - 5e-5, point.largest + 5e-5, point.largest_bound - 5e-5);
  return text;
}

std::string scan_lines(const io::LocateDocument& d) {
  if (!d.scan) return "";
  const io::ScanRecord& scan = *d.scan;
  std::string text =
      fmt::format("  scan               {} points, guard {:.6g} mm, up to {:.6g} mm drawn further in\n",
                  scan.points, scan.guard, scan.loss);
  for (const std::string& sentence : scan.assumptions) text += "  assumed            " + sentence + "\n";
  for (const std::string& sentence : scan.unknown) text += "  unknown            " + sentence + "\n";
  for (const std::string& sentence : scan.dropped) text += "  left out           " + sentence + "\n";
  return text;
}

std::string contact_lines(const io::LocateDocument& d) {
  std::string text;
  const char* separator = d.convex() ? "  held by            " : "  nearest at         blank ";
  for (const locate::Touch& touch : d.contacts) {
    text += separator +
            (d.convex() ? fmt::format("part point {} on blank edge {}", touch.part_edge, touch.blank_edge)
                        : fmt::format("({:.3f}, {:.3f})", touch.blank.x, touch.blank.y));
    separator = ", ";
  }
  if (d.mirrored) text = "  mirrored           in x, before it is turned\n" + text;
  return text.empty() ? text : text + "\n";
}

std::string alternative_lines(const io::LocateDocument& d) {
  std::string text;
  for (const locate::Placement& p : d.alternatives) {
    text += fmt::format("  alternative        x = {:.6f}, y = {:.6f}, {:.6f} degrees: {}\n", p.x, p.y,
                        degrees(p.theta), mm_down(p.clearance));
  }
  if (!d.alternatives_complete) text += "  alternative        there are more\n";
  return text;
}

std::string trim_line(const io::LocateDocument& d) {
  if (!d.trim) return "";
  return fmt::format("  trimmed            the blank lost up to {} of its convex hull\n",
                     mm_up(d.trim->loss));
}

std::string comparison_lines(const io::LocateDocument& d) {
  if (!d.comparison) return "";
  const io::ComparisonRecord& c = *d.comparison;
  return fmt::format(
      "  since last time    x {:+.6f} mm, y {:+.6f} mm, angle {:+.6f} degrees; no part point moved more than "
      "{:.6f} mm\n"
      "  the last placement would keep {} here (it had {})\n",
      c.dx, c.dy, degrees(c.dtheta), c.largest_shift, mm_down(c.last_pose_clearance),
      mm_down(c.last_clearance));
}

std::string deviation_line(const io::LocateDocument& d) {
  if (!d.deviations) return "";
  return fmt::format("  probed points      {}, from {:.6f} to {:.6f} mm off the placed part\n",
                     d.deviations->points, d.deviations->least, d.deviations->greatest);
}

std::string program_lines(const std::optional<io::NcRecord>& nc) {
  if (!nc) return "";
  std::string text = fmt::format("  NC program         {} motions; with its rounding the allowance is {}\n",
                                 nc->motions, mm_down(nc->clearance));
  for (const std::string& note : nc->notes) text += "  NC program         " + note + "\n";
  return text;
}

bool has_maxima(const io::SolidDocument& d) {
  return d.demands && std::any_of(d.demands->features.begin(), d.demands->features.end(),
                                  [](const io::SolidFeature& one) { return one.maximum.has_value(); });
}
bool has_finished(const io::SolidDocument& d) {
  return d.demands && std::any_of(d.demands->features.begin(), d.demands->features.end(),
                                  [](const io::SolidFeature& one) { return one.finished.has_value(); });
}

/// Names what of the place of the part a placement has to keep, beside what is demanded; nothing if there is
/// nothing.
std::string kept_of(const io::SolidDocument& d) {
  std::vector<std::string> kept;
  if (d.demands && !d.demands->datums.empty()) kept.emplace_back("datums");
  if (has_maxima(d)) kept.emplace_back("maxima");
  if (has_finished(d)) kept.emplace_back("finished faces");
  std::string text;
  for (std::size_t k = 0; k < kept.size(); ++k)
    text += (k == 0 ? "the " : k + 1 < kept.size() ? ", " : " and ") + kept[k];
  return text;
}
std::string kept_with(const char* words, const io::SolidDocument& d) {
  const std::string kept = kept_of(d);
  return kept.empty() ? "" : words + kept;
}

std::string headline(const io::SolidDocument& d) {
  if (d.status == "infeasible" && d.demands)
    return fmt::format("No placement in the window meets the demands{}; this is proved.{}",
                       kept_with(" and keeps ", d), d.inside() ? " The one that misses least:" : "");
  if (d.status == "infeasible")
    return d.min_allowance > 0
               ? fmt::format(
                     "No placement in the window reaches the demanded allowance of {} mm; this is "
                     "proved.",
                     d.min_allowance)
               : "No placement in the window has the part inside the blank; this is proved.";
  if (!d.inside())
    return fmt::format("No placement was found that has the part inside the blank{}.",
                       kept_with(" and keeps ", d));
  if (d.scan && !d.scan->proved())
    return "A placement was found, but parts of the blank are unknown, so it is not proved to hold.";
  if (d.status == "optimal" && d.choice)
    return "The largest margin was found and proved, and a placement near it chosen.";
  if (d.status == "optimal") return "The best placement was found and proved.";
  if (d.status == "stopped") return "Stopped early: a placement that holds, maybe not the best.";
  return fmt::format("The placement that --method {} found; it proves nothing about others.", d.method);
}

/// Says why no pose of such a part counts as inside: the datum that is missed by the most comes first.
std::string why_not_inside(const io::SolidDocument& d) {
  const io::SolidDatumRecord* worst = nullptr;
  if (d.demands)
    for (const io::SolidDatumRecord& one : d.demands->datums)
      if (!one.kept() && (worst == nullptr || one.missed() > worst->missed())) worst = &one;
  if (worst != nullptr)
    return fmt::format("the datum \"{}\" is missed by {}", worst->name, mm_up(worst->missed()));
  if (d.demands && !d.demands->keeps_maxima())
    return !has_finished(d) ? "a maximum is not kept"
           : has_maxima(d)  ? "a maximum or a finished face is not kept"
                            : "a finished face is too far from the blank's surface";
  return "the part is not inside the blank";
}

/// The rotation as people turn things: by an angle about an axis.
std::string turn_line(const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  const double sine = std::hypot(x, y, z), side = w < 0 ? -1 : 1;
  if (sine == 0) return "  turned by          nothing\n";
  return fmt::format("  turned by          {:.6f} degrees about the axis ({:.6f}, {:.6f}, {:.6f})\n",
                     degrees(2 * geom::direction_angle(side * w, sine)), side * x / sine, side * y / sine,
                     side * z / sine);
}

std::string pose_lines(const io::SolidDocument& d) {
  const solid::Vector at = d.pose.shift;
  return fmt::format("  the part lies at   x = {:.6f} mm, y = {:.6f} mm, z = {:.6f} mm\n", at.x, at.y, at.z) +
         turn_line(d.pose.quaternion) + "  minimum allowance  " +
         (d.clearance ? mm_down(*d.clearance) : fmt::format("none: {}", why_not_inside(d))) + "\n";
}

std::string datum_lines(const io::SolidDocument& d) {
  std::string text;
  if (d.demands)
    for (const io::SolidDatumRecord& one : d.demands->datums)
      text +=
          fmt::format("  datum              \"{}\" is {} within {} mm: the part is off it by up to {}{}\n",
                      one.name, one.kept() ? "kept" : "not kept", one.within, mm_up(one.off),
                      one.kept() ? "" : fmt::format(", {} too much", mm_up(one.missed())));
  return text;
}

std::string maximum_lines(const io::SolidDocument& d) {
  std::string text;
  if (d.demands)
    for (std::size_t k = 0; k < d.demands->features.size(); ++k) {
      const io::SolidFeature& one = d.demands->features[k];
      const double largest = d.demands->largest[k];
      if (one.maximum)
        text += fmt::format("  maximum            \"{}\" {} {} mm: its largest allowance is {}\n", one.name,
                            largest <= *one.maximum ? "keeps" : "is above", *one.maximum, mm_up(largest));
      if (one.finished)
        text += fmt::format(
            "  finished           \"{}\" is {} {} mm of the blank's surface: the farthest point is {} off\n",
            one.name, largest <= *one.finished ? "within" : "not within", *one.finished, mm_up(largest));
    }
  return text;
}

std::string window_text(const io::SolidDocument& d) {
  constexpr double kAllTurns = 180;
  const bool six = d.freedom == locate::SolidFreedom::six;
  std::string text = fmt::format("within {} mm", d.window.shift);
  if (d.freedom != locate::SolidFreedom::xyz && d.window.turn_deg == kAllTurns)
    return text + " of the start, " + (six ? "turned anyhow," : "turned anyhow about z,");
  if (d.freedom != locate::SolidFreedom::xyz)
    text += fmt::format(" and {} degrees{}", d.window.turn_deg, six ? "" : " about z");
  text += " of the start";
  if (const double farthest = d.window.farthest_turn_deg(d.freedom); farthest > d.window.turn_deg)
    text += fmt::format(" (about some axes {:.2f} degrees)", farthest);
  return text;
}

std::string start_line(const io::SolidDocument& d) {
  if (d.start != "found") return "";
  const solid::Vector at = motion_of(d.window.start)(d.window.pivot);
  return fmt::format(
      "  start              found by climbs from all over: the middle of the part at ({:.3f}, {:.3f}, "
      "{:.3f})\n",
      at.x, at.y, at.z);
}

/// Says what other poses are as good as this one.
std::string symmetry_lines(const io::SolidDocument& d) {
  if (!d.symmetry) return "";
  constexpr std::size_t kMostAxes = 3;
  const solid::Symmetry& found = d.symmetry->found;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMostAxes, found.axes.size()); ++k) {
    const auto& [axis, turns] = found.axes[k];
    text += fmt::format(
        "  symmetric          the part is the same after {} about its axis ({:.4f}, {:.4f}, {:.4f})\n",
        turns == 0 ? "any turn" : fmt::format("1/{} of a turn", turns), axis.x, axis.y, axis.z);
  }
  const std::string more =
      found.axes.size() > kMostAxes ? fmt::format(" ({} axes in all)", found.axes.size()) : "";
  const std::string poses = found.rotations == 0
                                ? "the turn about that axis is free"
                                : fmt::format("this pose is one of {} equal ones", found.rotations);
  return text + fmt::format("  symmetric          so {}{}; estimated, within {} mm\n", poses, more,
                            d.symmetry->tolerance);
}

std::string bound_line(const io::SolidDocument& d) {
  if (!d.upper_bound) return "";
  return fmt::format("  proved             no placement {} has more than {}\n", window_text(d),
                     mm_up(*d.upper_bound));
}

/// The place where most is missing, and the feature there.
std::string missing_place(const io::SolidDocument& d) {
  const locate::SolidTouch* worst = nullptr;
  double least = 0;
  std::string name;
  for (const locate::SolidTouch& touch : d.contacts) {
    locate::SolidDemand demand{d.demands->minimum.value_or(0), 1};
    std::string of = "the triangles of no feature";
    for (const io::SolidFeature& feature : d.demands->features)
      if (feature.demand &&
          std::binary_search(feature.triangles.begin(), feature.triangles.end(), touch.part_triangle))
        demand = *feature.demand, of = fmt::format("\"{}\"", feature.name);
    const double margin = (touch.distance - demand.minimum) / demand.scale;
    if (worst == nullptr || margin < least) worst = &touch, least = margin, name = of;
  }
  if (worst == nullptr) return "";
  return fmt::format(" on {}, at the part's ({:.3f}, {:.3f}, {:.3f}), triangle {}", name, worst->part.x,
                     worst->part.y, worst->part.z, worst->part_triangle);
}

std::string demands_line(const io::SolidDocument& d) {
  const io::SolidDemandRecord& r = *d.demands;
  const std::string bound = !r.margin_bound
                                ? ""
                                : fmt::format("; no placement {}{} has a margin above {}", window_text(d),
                                              kept_with(" that keeps ", d), mm_up(*r.margin_bound));
  if (!r.margin && r.margin_bound && *r.margin_bound < 0 && kept_of(d).empty())
    return fmt::format("  demands            at least {} are missing, wherever in the window the part lies\n",
                       mm_down(-*r.margin_bound));
  if (!r.margin) return fmt::format("  demands            not met{}\n", bound);
  if (*r.margin >= 0)
    return fmt::format("  demands            met, with a margin of {}{}\n", mm_down(*r.margin), bound);
  return fmt::format("  demands            {} are missing{}{}\n", mm_up(*d.shortfall()), missing_place(d),
                     bound);
}

/// The margin that was kept is part of the proof; that no placement lies less deep, or is more even, is none.
std::string choice_line(const io::SolidDocument& d) {
  if (!d.choice || !d.choice->largest) return "";
  const io::SolidChoiceRecord& choice = *d.choice;
  const std::string largest = fmt::format(
      "  largest allowance  {}; of at most {} mm of the margin {} that was "
      "found, {} were given up for it",
      mm_up(*choice.largest), choice.give_up, mm_down(*choice.margin_found),
      mm_up(*choice.margin_found - *d.margin()));
  if (!choice.deviation) return largest + "; that there is no smaller one is not proved\n";
  return largest +
         fmt::format(
             ", and of the smallest {} that was found, {}\n"
             "  even               allowances deviate by {} from their targets or their mean, as the "
             "root of the mean square; that no placement is more even is not proved\n",
             mm_up(*choice.largest_found), mm_up(std::max(0.0, *choice.largest - *choice.largest_found)),
             mm_up(*choice.deviation));
}

std::string demand_line(const io::SolidDocument& d) {
  const std::string demands = d.demands ? datum_lines(d) + maximum_lines(d) + demands_line(d) : "";
  if (!d.inside())
    return demands +
           fmt::format(
               "  to be tried        a wider window (--shift, --tilt), another start (--find-start, "
               "--start), "
               "other --units{}\n",
               d.demands ? "" : ", faces that the blank has as well said to be as cast (--features)");
  if (d.demands) return demands;
  if (!(*d.shortfall() > 0))
    return d.min_allowance > 0 ? fmt::format("  demanded           {} mm: met\n", d.min_allowance) : "";
  const bool open = !d.upper_bound || *d.upper_bound >= d.min_allowance;
  return fmt::format("  demanded           {} mm: {} are missing{}\n", d.min_allowance, mm_up(*d.shortfall()),
                     open ? "; it is open whether another placement has them" : "");
}

std::string scan_lines(const io::SolidDocument& d) {
  if (!d.scan) return "";
  const io::SolidScanRecord& scan = *d.scan;
  std::string text = fmt::format(
      "  scan               guard {:.6g} mm; material begins up to {:.6g} mm inside its triangles\n",
      scan.guard, scan.widest);
  for (const std::string& sentence : scan.assumptions) text += "  assumed            " + sentence + "\n";
  if (!scan.proved())
    text += fmt::format(
        "  unknown            {} triangles, {:.6g} mm2, are too wide for what is assumed, so nothing is "
        "proved: "
        "measure there, or close the underside with --underside z=LEVEL --flat MM\n",
        scan.unknown_triangles, scan.unknown_area);
  return text;
}

std::string contact_lines(const io::SolidDocument& d) {
  std::string text;
  for (const locate::SolidTouch& touch : d.contacts)
    text += fmt::format("{}({:.3f}, {:.3f}, {:.3f})", text.empty() ? "  nearest at         blank " : ", ",
                        touch.blank.x, touch.blank.y, touch.blank.z);
  return text.empty() ? text : text + "\n";
}

std::string note_lines(const std::vector<std::string>& warnings, const std::vector<std::string>& written) {
  std::string text;
  for (const std::string& warning : warnings) text += "  note               " + warning + "\n";
  for (const std::string& path : written) text += "  wrote              " + path + "\n";
  return text;
}

}  // namespace

std::string decimals_down(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // Nearest rounding may lie above by half a unit of the last decimal; then one unit less lies below.
  for (double lower = value; read_back(text) > value; text = fmt::format("{:.{}f}", lower, decimals)) {
    lower -= std::max(0.5 * std::pow(10.0, -decimals), std::abs(value) * 0x1p-52);
  }
  return text;
}

std::string decimals_up(double value, int decimals) {
  const std::string negated = decimals_down(-value, decimals);
  return negated.front() == '-' ? negated.substr(1) : "-" + negated;
}

std::string locate_summary(const io::LocateDocument& d, const std::vector<std::string>& written) {
  return headline(d) + "\n" + pose_lines(d) + bound_line(d) + demand_line(d) + criteria_lines(d) +
         scan_lines(d) + contact_lines(d) + alternative_lines(d) + trim_line(d) + comparison_lines(d) +
         deviation_line(d) + program_lines(d.nc) + note_lines(d.warnings, written);
}

std::string solid_summary(const io::SolidDocument& d, const std::vector<std::string>& written) {
  return headline(d) + "\n" + pose_lines(d) + symmetry_lines(d) + start_line(d) + bound_line(d) +
         demand_line(d) + choice_line(d) + scan_lines(d) + contact_lines(d) + program_lines(d.nc) +
         note_lines(d.warnings, written);
}

void tell(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace lekalo::cli
