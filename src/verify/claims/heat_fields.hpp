#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report_fields.hpp"
#include "verify/heat/cut_work.hpp"

namespace lekalo::verify {

/// Figures of a result of `lekalo heat` stand to 1e-6 of their unit, factors to 1e-12.
inline constexpr double kShown = 1.1e-6, kFine = 2e-12;
/// Sums and differences of some of them are told apart to this, um, K and MPa. A place 1 m from the middle
/// moves by 1e-6 um where a factor is rounded.
inline constexpr double kWithin = 1e-5;
/// Sums over many pieces are told apart to this part.
inline constexpr double kSummed = 1e-9;

/// So many faults of places are told.
inline constexpr std::size_t kMostFaults = 100;

struct HeatWall {
  std::array<double, 3> at{};
  std::array<double, 2> outward{};
  double seconds = 0, error = 0;
  CheckedRange errors;
};

struct ErrorSummary {
  double least = 0, most = 0, mean = 0;

  [[nodiscard]] double largest() const { return std::max(std::abs(least), std::abs(most)); }
};
struct IntervalSummary {
  CheckedRange least, most, mean, largest;
};

/// \pre there are some
inline ErrorSummary summary_of(const std::vector<double>& errors) {
  ErrorSummary s{errors[0], errors[0], 0};
  for (const double e : errors) {
    s.least = std::min(s.least, e), s.most = std::max(s.most, e);
    s.mean += e / static_cast<double>(errors.size());
  }
  return s;
}

struct HeatBalance {
  double in = 0, stored = 0, lost = 0, removed = 0, not_placed = 0, unaccounted = 0;
  friend bool operator==(const HeatBalance&, const HeatBalance&) = default;
};

/// A film of the cooling, with the middles of force and share.
struct HeatCaseRead {
  double film = 0, factor = 1, warmest = 0, stress = 0;
  std::array<double, 2> shift{};
  std::optional<double> half, tenth;
  std::vector<double> errors;
  ErrorSummary summary;
  HeatBalance balance;
};

inline CheckedRange range_of(ReportFields& fields, std::string_view key) {
  const std::array<double, 2> pair = fields.numbers<2>(key);
  return {pair[0], pair[1]};
}

/// Adds a finding for each figure that is not the one that the checker finds.
class HeldFigures {
 protected:
  void find(const std::string& sentence) { claims_.findings.push_back(sentence); }
  void hold(const std::string& what, double written, double found, double within) {
    if (!(std::abs(written - found) <= within))
      find(fmt::format("{} is {} and is to be {:.9g}", what, written, found));
  }
  void hold(const std::string& what, const CheckedRange& written, const CheckedRange& found, double within) {
    hold(what + "[0]", written.least, found.least, within);
    hold(what + "[1]", written.greatest, found.greatest, within);
  }
  /// Least, most, mean and, where it is said, the largest distance.
  void hold_summary(ReportFields& parent, std::string_view key, const ErrorSummary& found, double within,
                    bool with_intervals = false, const IntervalSummary& over = {}) {
    ReportFields f(parent.get(key), parent.name(key), complaint_);
    if (!complaint_.empty()) return;
    for (const auto& [name, value] :
         {std::pair{"least", found.least}, {"most", found.most}, {"mean", found.mean}})
      hold(f.name(name), f.number(name), value, within);
    if (with_intervals) {
      hold(f.name("largest"), f.number("largest"), found.largest(), within);
      ReportFields i(f.get("intervals"), f.name("intervals"), complaint_);
      if (!complaint_.empty()) return;
      for (const auto& [name, range] : {std::pair{"least", &over.least},
                                        {"most", &over.most},
                                        {"mean", &over.mean},
                                        {"largest", &over.largest}})
        hold(i.name(name), range_of(i, name), *range, within);
      i.refuse_others();
    }
    f.refuse_others();
  }

  /// The work of a program's cuts.
  void hold_booked(ReportFields& parent, const BookedWork& found) {
    if (!found.fault.empty()) find(found.fault);
    const auto within = [](double value) { return verify::kShown + kSummed * std::abs(value); };
    for (const auto& [key, value] : {std::pair{"seconds", found.seconds},
                                     {"cutting_seconds", found.cutting_seconds},
                                     {"volume_mm3", found.volume_mm3}})
      hold(parent.name(key), parent.number(key), value, within(value));
    for (const auto& [key, range] : {std::pair{"work_j", found.work_j},
                                     {"into_workpiece_j", found.into_j},
                                     {"carried_off_j", found.carried_off_j},
                                     {"greatest_power_w", found.power_w}})
      hold(parent.name(key), range_of(parent, key), range, within(range.greatest));
  }

  std::string complaint_;
  ClaimReport claims_;
};

}  // namespace lekalo::verify
