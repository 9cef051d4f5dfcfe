#include "lekalo/fit/iso286.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "iso286_tables.hpp"
#include "lekalo/base/double_of_text.hpp"

namespace lekalo::fit {
namespace {

constexpr double kLargestMm = 500;
constexpr int kGrade01 = -1;

/// A class taken apart: "ZC8" is the hole zc in grade 8.
struct ToleranceClass {
  bool hole = false;
  std::string zone;  // in small letters
  int grade = 0;     // -1: 01
};

template <class Row, std::size_t N>
const Row& row_of(const std::array<Row, N>& rows, double diameter) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return diameter <= r.up_to; });
}

std::optional<ToleranceClass> taken_apart(std::string_view text) {
  std::size_t letters = 0;
  while (letters < text.size() && std::isalpha(static_cast<unsigned char>(text[letters])) != 0) ++letters;
  const std::string_view zone = text.substr(0, letters), grade = text.substr(letters);
  if (zone.empty() || zone.size() > 2 || grade.empty() || grade.size() > 2) return {};
  ToleranceClass c;
  c.hole = std::isupper(static_cast<unsigned char>(zone[0])) != 0;
  for (const char letter : zone) {
    if ((std::isupper(static_cast<unsigned char>(letter)) != 0) != c.hole) return {};
    c.zone += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  for (const char digit : grade)
    if (digit < '0' || digit > '9') return {};
  if (grade == "01") {
    c.grade = kGrade01;
  } else {
    if (grade.size() == 2 && grade[0] == '0') return {};
    c.grade = grade.size() == 1 ? grade[0] - '0' : 10 * (grade[0] - '0') + grade[1] - '0';
  }
  if (c.grade > 18) return {};
  return c;
}

/// Widths and deviations of one size.
class Size {
 public:
  explicit Size(double diameter)
      : diameter_(diameter), grades_(row_of(kGrades, diameter)), shafts_(row_of(kShafts, diameter)) {}

  [[nodiscard]] std::optional<Limits> limits(const ToleranceClass& c) const {
    if (diameter_ <= 1 && (c.grade >= 14 || c.zone == "a" || c.zone == "b")) return {};
    const double width = width_of(c.grade);
    if (c.zone == "js") return Limits{-width / 2, width / 2};
    return c.hole ? hole(c, width) : shaft(c, width);
  }

 private:
  [[nodiscard]] double width_of(int grade) const {
    return grades_.grades[static_cast<std::size_t>(grade + 1)];
  }

  [[nodiscard]] std::optional<double> deviation(std::string_view zone) const {
    const auto* const at = std::find(kShaftZones.begin(), kShaftZones.end(), zone);
    if (at == kShaftZones.end()) return {};
    const std::int16_t found = shafts_.deviations[static_cast<std::size_t>(at - kShaftZones.begin())];
    return found == kNone ? std::nullopt : std::optional<double>(found);
  }

  static bool is_upper(std::string_view zone) {
    return std::find(kShaftZones.begin(), kShaftZones.begin() + kUpperZones, zone) !=
           kShaftZones.begin() + kUpperZones;
  }

  [[nodiscard]] std::optional<Limits> shaft(const ToleranceClass& c, double width) const {
    if (c.zone == "h") return Limits{-width, 0};
    std::string zone = c.zone;
    if (zone == "j") {
      if (c.grade < 5 || c.grade > 8) return {};
      zone = c.grade <= 6 ? "j6" : fmt::format("j{}", c.grade);
    } else if (zone == "k" && (c.grade < 4 || c.grade > 7)) {
      return Limits{0, width};
    }
    const std::optional<double> d = deviation(zone);
    if (!d) return {};
    return is_upper(zone) ? Limits{*d - width, *d} : Limits{*d, *d + width};
  }

  /// Holes mirror the shafts; in finer grades they are moved by the difference to the next finer grade.
  [[nodiscard]] std::optional<Limits> hole(const ToleranceClass& c, double width) const {
    if (c.zone == "h") return Limits{0, width};
    if (c.zone == "j") {
      if (c.grade < 6 || c.grade > 8) return {};
      const double upper = grades_.j_holes[static_cast<std::size_t>(c.grade - 6)];
      return Limits{upper - width, upper};
    }
    const std::optional<double> d = deviation(c.zone);
    if (!d) return {};
    if (is_upper(c.zone)) return Limits{-*d, -*d + width};
    const std::optional<double> upper = upper_of_hole(c, *d);
    if (!upper) return {};
    return Limits{*upper - width, *upper};
  }

  [[nodiscard]] std::optional<double> upper_of_hole(const ToleranceClass& c, double d) const {
    const bool to_eight = c.zone == "k" || c.zone == "m" || c.zone == "n";
    if (c.grade > (to_eight ? 8 : 7)) {
      if (c.zone == "k" && diameter_ > 3) return {};
      if (c.zone == "n" && diameter_ <= 1) return {};
      return c.zone == "n" && diameter_ > 3 ? 0.0 : -d;
    }
    if (diameter_ <= 3) return -d;
    if (c.zone == "m" && c.grade == 6 && diameter_ > 250 && diameter_ <= 315) return -9.0;
    if (c.grade < 3) return {};  // the tables have no difference there
    return -d + width_of(c.grade) - width_of(c.grade - 1);
  }

  double diameter_;
  const GradeRow& grades_;
  const ShaftRow& shafts_;
};

constexpr const char* kWayOut = "give the interference itself, --diameter MM --interference MM";

}  // namespace

Result<Limits> limits_of(double diameter_mm, std::string_view tolerance_class) {
  if (!(diameter_mm > 0 && diameter_mm <= kLargestMm))
    return failure(ErrorCode::bad_input,
                   fmt::format("{} mm: the tables of ISO 286 that are known here go from 0 to {} mm; {}",
                               diameter_mm, kLargestMm, kWayOut));
  const std::optional<ToleranceClass> c = taken_apart(tolerance_class);
  if (!c)
    return failure(
        ErrorCode::bad_input,
        fmt::format(
            "{}: not a tolerance class; it is a zone from a to zc (shaft) or A to ZC (hole) and a grade "
            "from 01 to 18, like H8",
            tolerance_class));
  const std::optional<Limits> found = Size(diameter_mm).limits(*c);
  if (!found)
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}{}: two public tables do not agree on such a class at this size, or have none; {}",
                    diameter_mm, tolerance_class, kWayOut));
  return *found;
}

Result<NamedFit> read_fit(std::string_view text) {
  std::size_t digits = 0;
  while (digits < text.size() &&
         (std::isdigit(static_cast<unsigned char>(text[digits])) != 0 || text[digits] == '.'))
    ++digits;
  const std::size_t slash = text.find('/');
  const std::optional<double> diameter = double_of_text(text.substr(0, digits));
  if (!diameter || slash == std::string_view::npos || slash < digits)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: not a fit; it is a diameter, a hole and a shaft, like 18H8/z8", text));
  NamedFit fit;
  fit.diameter_mm = *diameter;
  fit.hole = text.substr(digits, slash - digits);
  fit.shaft = text.substr(slash + 1);
  if (fit.hole.empty() || std::isupper(static_cast<unsigned char>(fit.hole[0])) == 0 || fit.shaft.empty() ||
      std::islower(static_cast<unsigned char>(fit.shaft[0])) == 0)
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: not a fit; the hole comes first, with a capital letter, like 18H8/z8", text));
  LEKALO_TRY(fit.hole_limits, limits_of(fit.diameter_mm, fit.hole));
  LEKALO_TRY(fit.shaft_limits, limits_of(fit.diameter_mm, fit.shaft));
  fit.least_um = fit.shaft_limits.lower_um - fit.hole_limits.upper_um;
  fit.greatest_um = fit.shaft_limits.upper_um - fit.hole_limits.lower_um;
  return fit;
}

}  // namespace lekalo::fit
