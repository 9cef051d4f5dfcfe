#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solid_datum.hpp"
#include "solid_mesh.hpp"

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
  [[nodiscard]] bool as_cast() const { return !demand && !finished; }
};

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
