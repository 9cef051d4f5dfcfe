#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/units.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// The demands of a feature in the doubles nearest to the decimals, mm: a part is placed by these.
struct FeatureNumbers {
  double minimum = 0, scale = 1;
  std::optional<double> target, maximum, finished;
};

/// A feature as a file of features states it (docs/formats.md): one of the three says which edges it has.
struct StatedFeature {
  std::string name;
  FeatureNumbers numbers;
  std::optional<std::vector<std::size_t>> edges;
  std::optional<std::size_t> contour;
  std::optional<std::string> label;
};

struct StatedDemands {
  double minimum = 0;  ///< of edges of no feature, mm
  std::vector<StatedFeature> features;
  std::optional<LengthUnit> unit;
  /// The regions of the part that are to be ignored.
  std::vector<Json> ignored;
};

/// Reads a file of features. `unit` holds where the file does not say one. The complaint names what is no
/// word of such a file, what is out of range, and a feature that does not say in one way which edges it has.
[[nodiscard]] StatedDemands read_features(Json value, LengthUnit unit, std::string& complaint);

}  // namespace lekalo::verify
