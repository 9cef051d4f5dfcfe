#include "lekalo/io/scan/scan_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/contour/contour_points.hpp"
#include "io/solid/ply.hpp"
#include "io/text/rows.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/io/text/format.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

class ScanReader {
 public:
  ScanReader(const std::string& name, LengthUnit unit, const std::optional<ScanSlice>& slice)
      : slice_(slice) {
    file_.name = name;
    file_.unit = unit;
    file_.points.contour_starts.clear();
  }

  Result<ScanFile> read_text(std::string_view bytes) {
    const auto take = [&](const TextRow& row) -> Result<void> {
      if (slice_ && row.count < 3)
        return refuse_line(file_.name, row.line, "no z on this line, but a slice at a height was asked for");
      const double z = row.count == 3 ? row.numbers[2].value : 0;
      with_z_ += row.count - 2;
      return add(row.numbers[0].value, row.numbers[1].value, z,
                 std::max(row.numbers[0].error, row.numbers[1].error), row.line, row.after_a_gap && !slice_);
    };
    LEKALO_CHECK(read_text_rows(bytes, file_.name, decimal_factor(file_.unit), take, file_.notices));
    file_.has_order = !slice_;
    return finish();
  }

  /// Other elements than the vertices are not read; what stands after these is not looked at.
  Result<ScanFile> read_ply(std::string_view bytes) {
    file_.places_are_lines = false;
    file_.has_order = false;
    PlyFile ply(bytes, file_.name);
    LEKALO_CHECK(ply.read_header());
    const PlyElement* const vertices = ply.element("vertex");
    if (vertices == nullptr) return refuse(file_.name, "there is no element vertex in this PLY");
    for (const PlyProperty& property : vertices->properties)
      if (property.count)
        return refuse(file_.name, fmt::format("the vertices have a list ({}); only plain numbers can be read",
                                              excerpt(property.name)));
    LEKALO_TRY(const PlyFile::Axes axes, ply.axes_of(*vertices, slice_.has_value()));
    if (vertices->rows > kMostScanPoints)
      return refuse(file_.name,
                    fmt::format("{} vertices; at most {} can be read", vertices->rows, kMostScanPoints));
    for (const PlyElement& element : ply.elements()) {
      if (&element != vertices && element.rows > 0)
        file_.notices.push_back(fmt::format("{}: {} of the element {} are ignored", file_.name, element.rows,
                                            excerpt(element.name)));
    }
    for (const PlyElement* element = ply.elements().data(); element != vertices; ++element)
      LEKALO_CHECK(ply.skip(*element));
    const auto take = [&](const PlyPoint& p, std::size_t vertex) {
      return add(p.xyz[0], p.xyz[1], p.xyz[2], p.error, vertex, false);
    };
    LEKALO_CHECK(ply.read_points(*vertices, axes, decimal_factor(file_.unit), take));
    return finish();
  }

 private:
  Result<void> add(double x, double y, double z, double error, std::size_t place, bool begins_contour) {
    if (++file_.points_in_file > kMostScanPoints)
      return refuse(file_.name, fmt::format("more than {} points; thin the scan out first", kMostScanPoints));
    if (slice_ && !(std::abs(z - slice_->height) <= 0.5 * slice_->thickness)) {
      least_z_ = std::min(least_z_, z);
      greatest_z_ = std::max(greatest_z_, z);
      return {};
    }
    auto& points = file_.points.points;
    if (begins_contour || points.empty()) {
      file_.points.contour_starts.push_back(static_cast<std::uint32_t>(points.size()));
    }
    points.push_back({x, y});
    file_.places.push_back(place);
    file_.coordinate_error = std::max(file_.coordinate_error, error);
    return {};
  }

  Result<ScanFile> finish() {
    if (file_.points_in_file == 0) return refuse(file_.name, "there are no points in this file");
    const std::size_t kept = file_.points.points.size();
    if (slice_) {
      if (kept == 0) {
        return refuse(file_.name,
                      fmt::format("no point lies in the slice at height {:g} mm, {:g} mm thick; z runs from "
                                  "{:g} to {:g} mm",
                                  slice_->height, slice_->thickness, least_z_, greatest_z_));
      }
      file_.notices.push_back(fmt::format("{}: {} of {} lie in the slice at height {:g} mm, {:g} mm thick",
                                          file_.name, kept, counted(file_.points_in_file, "point"),
                                          slice_->height, slice_->thickness));
    } else if (with_z_ > 0) {
      file_.notices.push_back(
          fmt::format("{}: the third number of {} (z) is ignored", file_.name, counted(with_z_, "line")));
    }
    return std::move(file_);
  }

  const std::optional<ScanSlice>& slice_;
  ScanFile file_;
  std::size_t with_z_ = 0;
  double least_z_ = std::numeric_limits<double>::infinity(),
         greatest_z_ = -std::numeric_limits<double>::infinity();
};

std::string where(const ScanFile& file, std::uint32_t point) {
  const geom::Point p = file.points.points[point];
  return fmt::format("{} {} ({:.6g}, {:.6g})", file.places_are_lines ? "line" : "vertex", file.places[point],
                     p.x, p.y);
}

}  // namespace

Result<ScanFile> parse_scan(std::string_view bytes, const std::string& name, std::optional<LengthUnit> unit,
                            const std::optional<ScanSlice>& slice) {
  if (slice && !(slice->thickness > 0 && slice->thickness <= kLargestMillimetres &&
                 std::abs(slice->height) <= kLargestMillimetres)) {
    return failure(
        ErrorCode::usage,
        fmt::format(
            "a slice at height {} mm, {} mm thick: the height must be finite and the thickness above 0",
            slice->height, slice->thickness));
  }
  ScanReader reader(name, unit.value_or(LengthUnit::millimetre), slice);
  if (kPlyFormat.is_named_so(name)) return reader.read_ply(bytes);
  if (const std::string fault = wrong_encoding(bytes); !fault.empty()) return refuse(name, fault);
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  if (kPointsFormat.is_named_so(name)) return reader.read_text(bytes);
  const std::string ending = ending_of(name);
  return refuse(name, fmt::format("scans are read from .csv, .txt, .xyz and .ply files, not from {}",
                                  ending.empty() ? "a name without ending" : excerpt(ending)));
}

Result<ScanBlank> read_scan_blank(std::string_view bytes, const std::string& name,
                                  const ScanBlankOptions& options) {
  LEKALO_TRY(auto file, parse_scan(bytes, name, options.unit, options.slice));
  locate::ScanOptions scan = options.scan;
  // Both coordinates may be off; 1.5 > sqrt(2).
  scan.reading_error += 1.5 * file.coordinate_error;
  if (scan.order == locate::PointOrder::automatic && !file.has_order) scan.order = locate::PointOrder::none;
  auto blank = locate::guaranteed_blank(file.points, scan);
  if (!blank) {
    if (blank.error().code != ErrorCode::bad_input) return tl::unexpected(std::move(blank.error()));
    return refuse(name, blank.error().message);
  }
  ScanBlank made{*std::move(blank), std::move(file), {}, {}, {}};
  made.notices = made.file.notices;
  for (const std::string& notice : made.blank.notices) made.notices.push_back(name + ": " + notice);
  if (options.slice) {
    made.blank.assumptions.push_back(
        fmt::format("the surface stands upright within the slice: points up to {:g} mm above and below "
                    "height {:g} mm count "
                    "as points of one contour",
                    0.5 * options.slice->thickness, options.slice->height));
  }
  for (const locate::UnknownStretch& u : made.blank.unknown) {
    made.unknown.push_back(fmt::format("{}: not measured: from {} to {}, {:.6g} mm", name,
                                       where(made.file, u.from), where(made.file, u.to), u.width));
  }
  for (const std::uint32_t i : made.blank.dropped)
    made.dropped.push_back(fmt::format("{}: left out: {}", name, where(made.file, i)));
  return made;
}

ScanRecord record_of(const ScanBlank& scan, const ScanBlankOptions& options) {
  const locate::GuaranteedBlank& b = scan.blank;
  return {scan.file.points.points.size(),
          b.proved(),
          b.ordered,
          b.guard,
          b.step,
          b.median_spacing,
          b.widest,
          b.deepest,
          b.loss,
          b.assumptions,
          scan.unknown,
          scan.dropped,
          scan.file.unit,
          options.scan.min_radius,
          options.scan.max_dip,
          options.slice,
          b.dropped,
          b.ordered ? std::vector<std::vector<std::uint32_t>>() : b.outlines};
}

}  // namespace lekalo::io
