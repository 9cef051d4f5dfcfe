#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "lekalo/locate/solid.hpp"

namespace lekalo::io {

/// Demands by face of a solid, as a file says them (docs/formats.md, "Features of solids").

/// The triangles of a feature, as the file names them.
struct SolidFeatureSpec {
  struct Numbers {
    std::vector<std::uint32_t> triangles;
  };
  struct Label {
    std::string name;
  };
  /// Those of faces of the STEP file that lekalo-step made the part of.
  struct Faces {
    std::vector<std::uint32_t> faces;
  };
  /// Those of faces that have a colour there, 65536 red + 256 green + blue.
  struct Colour {
    std::uint32_t number = 0;
  };
  /// Those about the triangle that is nearest to a point, up to edges where the surface bends.
  struct Patch {
    solid::Vector point;
  };
  struct Box {
    solid::Vector low, high;
  };
  /// Those along the plane normal . p = at |normal|.
  struct Plane {
    solid::Vector normal;
    double at = 0, within = 0;
  };
  std::string name;
  std::variant<Numbers, Label, Faces, Colour, Patch, Box, Plane> which;
  std::optional<locate::SolidDemand> demand;  ///< none: as cast, or finished
  /// No point of it has more allowance, mm; above the minimum.
  std::optional<double> maximum = std::nullopt;
  /// The allowance that it should have where that does not matter otherwise, mm.
  std::optional<double> target = std::nullopt;
  /// It is finished, so that no point of it is farther than this from the blank's surface, on either side,
  /// mm, > 0; then it demands nothing.
  std::optional<double> finished = std::nullopt;
  double rim = 0;  ///< points of others nearer to one that is finished demand nothing, mm
};

/// A datum, as the file says it: what of the part lies on what of the blank.
struct SolidDatumSpec {
  std::string name;
  std::variant<std::string, std::vector<solid::Vector>> which;  ///< the name of a feature, or points
  /// All but the points of the part.
  locate::SolidDatum datum;
};

/// A file may have so many features, so many datums, and a datum so many points.
inline constexpr std::size_t kMostSolidFeatures = 1000, kMostDatums = 100, kMostDatumPoints = 1000;

struct SolidFeatureFile {
  std::string name;
  std::vector<SolidFeatureSpec> features;
  /// The minimum of all other triangles, mm; or they are as cast.
  std::optional<double> minimum;
  bool as_cast = false;
  std::vector<SolidDatumSpec> datums;
};

/// `{"units", "minimum", "as_cast", "features": [{"name", "triangles" | "label" | "faces" | "colour" |
/// "patch" | "box" | "plane", "minimum", "target", "maximum", "scale", "as_cast", "finished", "rim"}, ...],
/// "datums": [{"name", "feature" | "points", "plane" | "axis" | "point", "within"}, ...]}`. `unit` applies
/// where the file does not say.
///
/// Fails with ErrorCode::bad_input, naming file and feature or datum: words it does not know, numbers out of
/// range, a feature without exactly one of the seven, a demand on what is as cast or finished.
[[nodiscard]] Result<SolidFeatureFile> parse_solid_features(std::string_view bytes, const std::string& name,
                                                            std::optional<SolidUnit> unit);

struct SolidFeature {
  std::string name;
  std::vector<std::uint32_t> triangles;       ///< as the part's file counts them, ascending
  std::optional<locate::SolidDemand> demand;  ///< none: as cast, or finished
  std::optional<double> maximum = std::nullopt, finished = std::nullopt;
  double rim = 0;
  std::optional<double> target = std::nullopt;
  /// No point of it is to be farther from the blank's surface, mm.
  [[nodiscard]] std::optional<double> within() const noexcept { return finished ? finished : maximum; }
};

/// The features with their triangles in the file of a part. bad_input, naming the feature, for one that has
/// none, for a triangle that two features have, and where rounding leaves open which triangles it has.
/// Cost: O(n log n), and O(n) a feature.
[[nodiscard]] Result<std::vector<SolidFeature>> find_solid_features(const SolidFeatureFile& file,
                                                                    const SolidFile& part);

/// The datums with their points: those given, or all corners of a feature. bad_input, naming the datum, for
/// the name of no feature, or of two. \pre the features are those of the file in the part
[[nodiscard]] Result<std::vector<locate::SolidDatum>> find_solid_datums(
    const SolidFeatureFile& file, const std::vector<SolidFeature>& features, const SolidFile& part);

}  // namespace lekalo::io
