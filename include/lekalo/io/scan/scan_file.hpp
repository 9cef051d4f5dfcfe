#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/locate/guaranteed_blank.hpp"

namespace lekalo::io {

/// Most points of a scan file, before a slice is taken; more are refused.
inline constexpr std::size_t kMostScanPoints = 20'000'000;

/// A slice of a 3D scan: the points with |z - height| <= thickness / 2.
struct ScanSlice {
  double height = 0, thickness = 0;  ///< mm
};

/// The points of a scan as they stand in a file (docs/formats.md), scaled to millimetres, in file order.
struct ScanFile {
  std::string name;
  LengthUnit unit = LengthUnit::millimetre;
  locate::ScanPoints points;
  /// The place of each point: its line, 1-based, or its vertex in a PLY, 0-based.
  std::vector<std::size_t> places;
  bool places_are_lines = true;
  /// True for text without a slice. Otherwise the order in the file means nothing.
  bool has_order = true;
  /// Every coordinate is within this of the number in the file, mm.
  double coordinate_error = 0;
  std::size_t points_in_file = 0;
  std::vector<std::string> notices;
};

/// Reads .csv, .txt, .xyz (points "x y" or "x y z"; an empty line begins the next contour) and .ply (ascii,
/// binary of either order; vertices only). `unit` is what the user said, millimetres without.
///
/// Fails with ErrorCode::usage for a slice that is not finite or without thickness; with bad_input and one
/// sentence that names file, line or vertex, what stands there and the way out. Cost: O(bytes).
[[nodiscard]] Result<ScanFile> parse_scan(std::string_view bytes, const std::string& name,
                                          std::optional<LengthUnit> unit,
                                          const std::optional<ScanSlice>& slice);

struct ScanBlankOptions {
  std::optional<LengthUnit> unit;
  std::optional<ScanSlice> slice;
  /// reading_error is added to by the reader; order `automatic` means none for a PLY or a slice.
  locate::ScanOptions scan;
};

/// A blank from a scan, for locate_regions: `blank.regions` with a blank_tolerance of 0. Its upper bound then
/// holds for the guaranteed blank, not for the true one, which may allow more. Where `blank.proved()` is
/// false no "yes" may be given, whatever the clearance.
struct ScanBlank {
  locate::GuaranteedBlank blank;
  ScanFile file;
  /// The notices of both.
  std::vector<std::string> notices;
  /// A sentence for each unknown stretch and each point left out, with its line or vertex in the file.
  std::vector<std::string> unknown, dropped;
};

/// Holds what a result says of a blank that was measured (GuaranteedBlank). Lengths are in mm.
struct ScanRecord {
  std::size_t points = 0;
  bool proved = false, ordered = false;
  double guard = 0, step = 0, median_spacing = 0, widest = 0, deepest = 0, loss = 0;
  std::vector<std::string> assumptions, unknown, dropped;  ///< sentences
  // How the points became the blank, so that somebody else can follow.
  LengthUnit unit = LengthUnit::millimetre;
  std::optional<double> min_radius, max_dip;
  std::optional<ScanSlice> slice;
  /// Indices among the points that count; the outlines for points in no order.
  std::vector<std::uint32_t> left_out;
  std::vector<std::vector<std::uint32_t>> outlines;
};
[[nodiscard]] ScanRecord record_of(const ScanBlank& scan, const ScanBlankOptions& options);

/// Fails as parse_scan and guaranteed_blank do, naming the file.
[[nodiscard]] Result<ScanBlank> read_scan_blank(std::string_view bytes, const std::string& name,
                                                const ScanBlankOptions& options);

}  // namespace lekalo::io
