#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/locate/demand.hpp"

namespace lekalo::io {

/// Demands by feature, as a file says them (docs/formats.md): which edges by number, contour or label, and
/// what each feature needs.

/// A feature whose edges are still to be found in the part.
struct FeatureSpec {
  /// The demand without the edges, mm.
  locate::Feature demand;
  std::vector<std::uint32_t> edges;
  /// The contour, counted through all pieces, each outer contour before its holes.
  std::optional<std::size_t> contour;
  /// The layer of a drawing or the name of a primitive; "" for none.
  std::string label;
};

struct FeatureFile {
  std::string name;
  std::vector<FeatureSpec> features;
  /// The minimum of all other edges, mm.
  std::optional<double> minimum;
  /// Regions in part coordinates, mm. What lies in them does not count.
  std::vector<geom::Region> ignored;
};

/// `{"units", "minimum", "features": [{"name", "edges" | "contour" | "label", "minimum", "target", "maximum",
/// "scale", "finished"}, ...], "ignore": [regions]}`. `unit` applies where the file does not say.
///
/// Fails with ErrorCode::bad_input, naming file and feature: words it does not know, numbers out of range, a
/// feature without exactly one of edges, contour and label.
[[nodiscard]] Result<FeatureFile> parse_features(std::string_view bytes, const std::string& name,
                                                 std::optional<LengthUnit> unit);

/// The features with their edges. `labels` has a label ("" for none) for every edge of the part.
/// bad_input, naming the feature, for a contour or label that the part does not have.
[[nodiscard]] Result<std::vector<locate::Feature>> find_features(const FeatureFile& file,
                                                                 const std::vector<geom::Region>& part,
                                                                 const std::vector<std::string>& labels);

/// The part without what is ignored, and for each of its edges the edge of `part` that it is a stretch of, if
/// it is one. bad_input where nothing is left.
struct RestOfPart {
  std::vector<geom::Region> regions;
  std::vector<std::optional<std::uint32_t>> edge_of;
  /// The tolerance of the Boolean, mm.
  double tolerance = 0;
};
[[nodiscard]] Result<RestOfPart> without_ignored(const FeatureFile& file,
                                                 const std::vector<geom::Region>& part);

}  // namespace lekalo::io
