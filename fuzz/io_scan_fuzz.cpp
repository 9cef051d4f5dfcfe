// Scans of any bytes: read or refused with a sentence, and what is called guaranteed keeps away from every
// point.

#include <algorithm>
#include <cmath>

#include "io_contour_check.hpp"
#include "lekalo/geom/region_check.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/scan/scan_file.hpp"

namespace {

using namespace lekalo;
using fuzz::must;

void check_file(const io::ScanFile& file) {
  must(!file.points.points.empty() && file.places.size() == file.points.points.size());
  must(file.points.contour_starts.front() == 0);
  must(std::is_sorted(file.points.contour_starts.begin(), file.points.contour_starts.end()));
  for (const geom::Point p : file.points.points)
    must(geom::is_exact(p) && std::max(std::abs(p.x), std::abs(p.y)) <= 1e9);
}

void check_blank(const io::ScanBlank& made) {
  must(!made.blank.regions.empty() && !made.blank.assumptions.empty());
  must(!geom::fault_of(made.blank.regions));
  const geom::RegionIndex index(made.blank.regions);
  const auto& dropped = made.blank.dropped;
  for (std::uint32_t i = 0; i < made.file.points.points.size(); ++i) {
    if (std::binary_search(dropped.begin(), dropped.end(), i)) continue;
    const geom::Point p = made.file.points.points[i];
    must(!index.contains(p) && index.nearest(p).distance >= made.blank.guard);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::uint8_t how = data[0], more = data[1];
  const std::string name = how % 2 == 0 ? "fuzz.ply" : "fuzz.csv";
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  io::ScanBlankOptions options;
  if (how & 2) options.unit = LengthUnit::inch;
  if (how & 4) options.slice = io::ScanSlice{1, 2};
  const auto file = io::parse_scan(bytes, name, options.unit, options.slice);
  if (!file) {
    fuzz::check_sentence(file.error(), name);
    return 0;
  }
  check_file(*file);
  if (how & 8) options.scan.uncertainty = 0.01;
  if (how & 16) options.scan.min_radius = 1;
  if (how & 32) options.scan.max_dip = 0.1;
  if (how & 64) options.scan.step = 0.5;
  if (how & 128) options.scan.drop_outliers = 2;
  options.scan.order = more % 3 == 0   ? locate::PointOrder::automatic
                       : more % 3 == 1 ? locate::PointOrder::given
                                       : locate::PointOrder::none;
  const auto made = io::read_scan_blank(bytes, name, options);
  if (made) {
    check_blank(*made);
  } else {
    fuzz::check_sentence(made.error(), name);
  }
  return 0;
}
