#include "report_words.hpp"

#include <fmt/core.h>

#include <cmath>

#include "draw/paper/printed_number.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

/// Returns the file's name, shortened so that the digest after it finds room.
std::string name_of(const io::FileRecord& file) {
  return io::shortened(io::file_name(io::as_utf8(file.path)), 30);
}

std::string where_looked(const io::LocateDocument& d) {
  std::string text = d.window_from_deg == 0 && d.window_to_deg == 360
                         ? "at any angle"
                         : fmt::format("at an angle from {}° to {}°", d.window_from_deg, d.window_to_deg);
  if (d.mirror == locate::Mirror::yes) text += ", mirrored,";
  if (d.mirror == locate::Mirror::either) text += ", mirrored or not,";
  return text;
}

std::string none_has(const io::LocateDocument& d, int decimals) {
  const double bound = *d.upper_bound;
  if (bound < 0) {
    return fmt::format("every placement {} sticks out of the blank by {} mm or more", where_looked(d),
                       decimal(-bound, decimals, Rounding::down));
  }
  if (!std::isfinite(bound)) return "nothing about other placements";
  return fmt::format("no placement {} leaves more than {} mm everywhere", where_looked(d),
                     decimal(bound, decimals, Rounding::up));
}

std::string this_has(const io::LocateDocument& d, int decimals) {
  const double clearance = d.placement.clearance;
  if (clearance < 0)
    return fmt::format("this one has {} mm: it sticks out", decimal(clearance, decimals, Rounding::down));
  return fmt::format("this one leaves at least {} mm", decimal(clearance, decimals, Rounding::down));
}

std::string demand_verdict(const io::LocateDocument& d, const io::DemandRecord& demands, int decimals) {
  const std::string bound = decimal(demands.margin_bound, decimals, Rounding::up);
  if (d.status == "infeasible")
    return fmt::format("Proved: no placement {} meets the demands; {} mm are missing at the best one found.",
                       where_looked(d), decimal(d.shortfall, decimals, Rounding::up));
  const std::string has =
      demands.margin >= 0 ? fmt::format("every demand is met, with a margin of {}",
                                        decimal(demands.margin, decimals, Rounding::down))
                          : fmt::format("{} mm are missing", decimal(d.shortfall, decimals, Rounding::up));
  const std::string lead =
      d.status == "optimal" ? "Proved" : "Stopped before the search was complete; proved so far";
  std::string text = fmt::format("{}: no placement {} has a margin above {}. This one: {}.", lead,
                                 where_looked(d), bound, has);
  if (demands.second)
    text += fmt::format(
        " Its largest allowance is {} mm; with a margin of {} or more none below {} mm is possible.",
        decimal(demands.largest, decimals, Rounding::up),
        decimal(demands.second->margin, decimals, Rounding::up),
        decimal(demands.second->bound, decimals, Rounding::down));
  return text;
}

std::string verdict(const io::LocateDocument& d, int decimals) {
  if (d.demands) return demand_verdict(d, *d.demands, decimals);
  if (!d.upper_bound) {
    return fmt::format("Nothing is proved about other placements: the method {} cannot; {}.", d.method,
                       this_has(d, decimals));
  }
  if (d.status == "infeasible") {
    const std::string what = d.min_allowance > 0
                                 ? fmt::format("the demanded {} mm cannot be had", d.min_allowance)
                                 : std::string("the part does not fit");
    return fmt::format("Proved: {}; {}. The best found: {}.", what, none_has(d, decimals),
                       this_has(d, decimals));
  }
  const double gap = difference_rounded_up(*d.upper_bound, d.placement.clearance);
  if (d.status == "optimal") {
    return fmt::format("Proved: {}; {}. So no other is better by more than {} mm.", none_has(d, decimals),
                       this_has(d, decimals), short_number_up(gap));
  }
  return fmt::format("Stopped before the search was complete: {}. Proved so far: {}.", this_has(d, decimals),
                     none_has(d, decimals));
}

std::string proof_place(const io::LocateDocument& d) {
  if (!d.upper_bound && !d.demands) return {};
  const bool inside = io::has_proof(d), angles = d.convex();
  const std::string what =
      fmt::format("{} {}", angles && inside ? io::proof_size(d) : d.certificate_intervals,
                  angles ? "intervals of the angle" : "boxes of poses");
  if (d.certificate_file) {
    return fmt::format("The proof, {}, is in {}, SHA-256 {}.", what, name_of(*d.certificate_file),
                       d.certificate_file->sha256);
  }
  if (inside) return fmt::format("The proof, {}, is in the result.", what);
  return "The proof was checked, but is too long for the result and was not kept.";
}

}  // namespace

std::vector<std::string> proof_sentences(const io::LocateDocument& d, int decimals) {
  std::vector<std::string> sentences{verdict(d, decimals)};
  if (const std::string place = proof_place(d); !place.empty()) {
    sentences.push_back(place +
                        " lekalo verify rechecks it and the clearance exactly, with code of its own.");
  } else {
    sentences.emplace_back("lekalo verify rechecks the clearance exactly, with code of its own.");
  }
  return sentences;
}

std::string as_sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text.ends_with('.') ? text : text + ".";
}

std::vector<std::string> assumption_sentences(const io::LocateDocument& d, int decimals) {
  std::vector<std::string> sentences;
  if (d.part_tolerance + d.blank_tolerance > 0) {
    sentences.push_back(fmt::format(
        "The true outlines lie within {} mm (part) and {} mm (blank) of those used; this is taken off "
        "the allowance and added to the bound.",
        short_number_up(d.part_tolerance), short_number_up(d.blank_tolerance)));
  }
  if (d.scan) {
    const io::ScanRecord& scan = *d.scan;
    for (const std::string& assumption : scan.assumptions) sentences.push_back(as_sentence(assumption));
    if (!scan.proved)
      sentences.push_back(fmt::format(
          "{} stretches of the blank are unknown; nothing here is proved of them.", scan.unknown.size()));
  }
  if (d.trim) {
    sentences.push_back(
        fmt::format("The blank was cut inwards to a convex contour and lost up to {} mm ({} mm allowed).",
                    decimal(d.trim->loss, decimals, Rounding::up), d.trim->tolerance));
  }
  for (const io::InputRecord& input : d.inputs) {
    if (input.dropped.empty()) continue;
    sentences.push_back(fmt::format("{}: {} points that repeat one or lie on a straight line were left out.",
                                    input.role, input.dropped.size()));
  }
  if (d.window_from_deg != 0 || d.window_to_deg != 360) {
    sentences.push_back(
        fmt::format("Only angles from {}° to {}° were looked at.", d.window_from_deg, d.window_to_deg));
  }
  if (d.nc) {
    sentences.push_back(fmt::format(
        "NC program {}, SHA-256 {}: scan in {} coordinates, work offset {}, points rounded by up to {} mm; "
        "it "
        "keeps {} mm.",
        name_of(d.nc->output), d.nc->output.sha256, d.nc->scan_frame, d.nc->work_offset,
        short_number_up(d.nc->rounding_mm), decimal(d.nc->clearance, decimals, Rounding::down)));
    for (const std::string& note : d.nc->notes) sentences.push_back("NC program: " + note);
  }
  return sentences;
}

}  // namespace lekalo::draw
