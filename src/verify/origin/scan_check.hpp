#pragma once

#include <string>
#include <vector>

#include "scan_points.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

/// The words of a result on the scan that its blank was made from: the numbers of the assumptions.
struct WrittenScan {
  LengthUnit unit = LengthUnit::millimetre;
  std::size_t points = 0;
  bool proved = false, ordered = false;
  Span guard, step, loss;
  std::optional<Span> min_radius, max_dip;
  std::optional<Slice> slice;
  std::vector<std::size_t> left_out;
  /// The corners of the outlines, for points in no order.
  std::vector<std::vector<std::size_t>> outlines;
};

/// Reads the field `scan`. Returns nothing for one that was written before it had these numbers.
[[nodiscard]] std::optional<WrittenScan> read_written_scan(Json value, std::string& complaint);

/// Says why the measurement does not prove, under the assumptions stated, that all of `blank` is material;
/// empty where it does (docs/design/scan.md, "What is assumed, and what follows"). Stretches that are wider
/// than the assumptions bridge are found here, whatever the result says of them.
struct ScanVerdict {
  std::string fault;
  /// A thing that is not shown, of points in no order: how far the blank keeps from what lies between those
  /// measured beside an edge.
  std::string open;
  /// True where some stretch of a contour is unknown.
  bool unknown = false;
};
[[nodiscard]] ScanVerdict check_scan(const WrittenScan& scan, const MeasuredPoints& points,
                                     const Shape& blank);

}  // namespace lekalo::verify
