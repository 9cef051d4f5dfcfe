#include "lekalo/jobs/heat_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {
namespace {

/// Rounds away from 0, so that what is below it may be left alone.
double tenths_up(double um) { return std::ceil(10 * um) / 10; }

}  // namespace

std::string between(const char* form, const heat::Interval& value) {
  const std::string least = fmt::format(fmt::runtime(form), value.least),
                    greatest = fmt::format(fmt::runtime(form), value.greatest);
  return least == greatest ? least : least + " to " + greatest;
}

std::vector<std::string> heat_decision(const HeatFound& found) {
  constexpr double kPays = 0.8;
  const double before = found.largest_um.greatest, after = found.scaled_over.largest.greatest;
  std::vector<std::string> sentences{
      fmt::format("Where walls may lie {:.1f} um off, leave it.", tenths_up(before))};
  if (!(before > 0)) return sentences;
  const UniformScaling& s = found.scaling;
  const std::string scaling = fmt::format(
      "scaling the program by {:.6f} about X {:.3f} Y {:.3f} with a shift of X {:+.2f} Y {:+.2f} um",
      s.factor, s.centre[0], s.centre[1], s.shift_um[0], s.shift_um[1]);
  if (after <= kPays * before)
    sentences.push_back(fmt::format("Else {} leaves {} um: that is plain growth, and a control can do it.",
                                    scaling, between("{:.1f}", found.scaled_over.largest)));
  else
    sentences.push_back(
        fmt::format("Do not scale by this alone: {} may leave {:.1f} um; state the share, the "
                    "force or the cooling more closely, or cool more.",
                    scaling, tenths_up(after)));
  return sentences;
}

HeatWait heat_wait(const HeatFound& found) {
  constexpr double kMinute = 60, kPart = 0.25;
  const auto half = waits_over(found.cases, &HeatCase::half_s),
             tenth = waits_over(found.cases, &HeatCase::tenth_s);
  const auto told = [](const std::array<std::optional<double>, 2>& wait) {
    if (!wait[0]) return std::string("more than a day");
    if (!wait[1]) return fmt::format("{:.0f} s or more", *wait[0]);
    return between("{:.0f}", {*wait[0], *wait[1]}) + " s";
  };
  const double worth = std::max(kMinute, kPart * found.source.work.seconds);
  const char* const pays = tenth[1] && *tenth[1] <= worth   ? "that pays before a finishing pass"
                           : tenth[0] && *tenth[0] <= worth ? "that may pay before a finishing pass"
                                                            : "waiting does not pay";
  return {fmt::format("to half in {}, to a tenth in {}", told(half), told(tenth)), pays};
}

}  // namespace lekalo::jobs
