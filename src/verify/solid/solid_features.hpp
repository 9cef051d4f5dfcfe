#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solid_mesh.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {

/// The demand of a triangle in the doubles nearest to the decimals: a part is placed by these.
struct SolidDemand {
  double minimum = 0;  ///< mm
  double scale = 1;
};

struct SolidFeature {
  std::string name;
  std::optional<SolidDemand> demand;  ///< none: as cast, or finished
  std::size_t triangles{};            ///< of the file
  /// No point of it is farther from the blank's surface, mm: its maximum, or within what it is finished.
  std::optional<double> within = std::nullopt;
  bool finished = false;
  /// Points of other triangles that are nearer to a finished one than this demand nothing, mm.
  double rim = 0;
  /// The allowance that it should have, mm.
  std::optional<double> target = std::nullopt;
  [[nodiscard]] bool as_cast() const { return !demand && !finished; }
};

/// A demand on the place of a part: none of its points is farther from a plane, a line or a point of the
/// blank's frame than `within`.
struct SolidDatum {
  enum class On : std::uint8_t { plane, axis, point };
  std::string name;
  On on = On::plane;
  Both3 through{};    ///< a point of the plane or the line, or the point
  Both3 direction{};  ///< across the plane or along the line, of any length but 0
  double within{};    ///< mm; the double nearest to the decimal
  /// The triangles whose corners are the points, in ascending order; none where the points are given.
  std::vector<std::uint32_t> triangles = {};
  std::vector<Both3> points = {};  ///< three of each triangle, or those given; part coordinates
};

/// Returns the part of a vector that goes straight away from the datum: for that of a place from `through` it
/// is as long as the place is off.
template <class Number>
[[nodiscard]] Of3<Number> straight_off(const SolidDatum& datum, const Of3<Number>& way) {
  if (datum.on == SolidDatum::On::point) return way;
  const Of3<Number> n = as<Number>(datum.direction);
  const Of3<Number> along = n * Number(dot(way, n) / dot(n, n));
  return datum.on == SolidDatum::On::plane ? along : way - along;
}

struct SolidDemands {
  /// That of triangles of no feature, mm; none where they are as cast.
  std::optional<double> minimum = 0;
  std::vector<SolidFeature> features;
  /// The feature of each triangle of the part's file, counted from 1, or 0.
  std::vector<std::uint32_t> feature_of;
  std::vector<SolidDatum> datums;
};

/// Reads a file of features for solids (docs/formats.md) and finds its triangles in the part,
/// exactly. `unit` holds where the file does not say one. bad_input for a word that is none of such a file, a
/// number out of range, a feature without triangles, a triangle of two, and a datum of no feature or of two.
[[nodiscard]] Result<SolidDemands> read_solid_features(const Document& document, const SolidReading& part,
                                                       SolidUnit unit);

}  // namespace lekalo::verify
