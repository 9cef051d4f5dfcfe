#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::heat {

/// A figure that is known no better than between two values. It is estimated, not proved.
struct Interval {
  double least = 0, greatest = 0;

  [[nodiscard]] constexpr double middle() const noexcept { return (least + greatest) / 2; }
  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

/// A figure of a table, and the public page or paper that it was read in. Without a source it is not known,
/// and the user has to state it.
struct Figure {
  Interval value{};
  std::string_view source{};

  [[nodiscard]] constexpr bool known() const noexcept { return !source.empty(); }
};

/// The figures of a material that heat and cutting ask for, in the units of handbooks.
enum class Property : unsigned char {
  cutting_force,   ///< k_c1.1, N/mm2: of a chip 1 mm thick and 1 mm wide
  force_exponent,  ///< m_c: k_c = k_c1.1 h^-m_c, h in mm
  conductivity,    ///< W/(m K)
  density,         ///< kg/m3
  heat_capacity,   ///< J/(kg K)
  expansion,       ///< 1/K
  youngs,          ///< MPa
  poisson,
  yield,    ///< MPa, 0.2 %, the least that is promised first; the tensile strength of what is brittle
  melting,  ///< degrees Celsius, where melting begins
  glass,    ///< degrees Celsius, of plastics
  share,    ///< the part of the cutting power that heats the workpiece, in [0, 1]
};
inline constexpr std::size_t kProperties = 12;

/// A property's name in sentences, its unit, empty for numbers, and the range in which any material lies.
struct PropertyWords {
  std::string_view name;
  std::string_view option;  ///< of a command line, without its two dashes
  std::string_view unit;
  Interval range;
};
[[nodiscard]] const PropertyWords& words_of(Property property) noexcept;

/// A material of the table.
struct KnownMaterial {
  std::string_view name;
  std::array<Figure, kProperties> figures;

  [[nodiscard]] const Figure& operator[](Property property) const noexcept {
    return figures[static_cast<std::size_t>(property)];
  }
};

/// All that are known, in the order in which they are listed to people.
[[nodiscard]] std::span<const KnownMaterial> known_materials() noexcept;
[[nodiscard]] const KnownMaterial* known_material(std::string_view name) noexcept;

/// Figures that the user states go before those of the table.
struct MaterialWords {
  std::string name;  ///< of the table; empty: numbers alone
  std::array<std::optional<Interval>, kProperties> stated;
};

/// A material whose figures are all known but for melting and glass, of which one is.
struct Material {
  std::string name;
  std::array<Interval, kProperties> values;

  [[nodiscard]] const Interval& operator[](Property property) const noexcept {
    return values[static_cast<std::size_t>(property)];
  }
  /// Highest temperature for which the figures are taken to hold, degrees Celsius: the glass transition, or
  /// half of where melting begins, from absolute zero.
  [[nodiscard]] double limit_c() const noexcept;
};

/// Returns what the user says and the table knows. bad_input with one sentence for a name that is not in the
/// table, for a figure that neither gives, and for one out of range.
[[nodiscard]] Result<Material> material_of(const MaterialWords& words);

/// A way of cooling: how much heat the workpiece's surfaces give off, W/(m2 K).
struct KnownCooling {
  std::string_view name;
  Figure film;
};
[[nodiscard]] std::span<const KnownCooling> known_coolings() noexcept;
/// Returns the film of a way of cooling by its name, or of a figure `20` or `20..60`, W/(m2 K). bad_input
/// with the names for other words, and for figures that are not from 0 to 100,000.
[[nodiscard]] Result<Interval> film_of(std::string_view words);

/// Reads `A` or `A..B`, finite and A <= B; nothing for other words.
[[nodiscard]] std::optional<Interval> read_interval(std::string_view words);

}  // namespace lekalo::heat
