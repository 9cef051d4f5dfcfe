#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report_fields.hpp"
#include "verify/heat/cut_work.hpp"

namespace lekalo::verify {

/// Figures of a result of `lekalo heat` stand to 1e-6 of their unit, factors to 1e-12.
inline constexpr double kShown = 1.1e-6, kFine = 2e-12;
/// Sums and differences of some of them are told apart to this, um, K and MPa. A place 1 m from the middle
/// moves by 1e-6 um where a factor is rounded.
inline constexpr double kWithin = 1e-5;

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

}  // namespace lekalo::verify
