#include <cmath>

#include "io_contour_check.hpp"
#include "lekalo/io/shape/shape_tree.hpp"

// parse_shape_tree on any bytes: a sentence, or regions in order with a tolerance and a name for every edge.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  using fuzz::must;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto unit = size % 2 == 0 ? std::nullopt : std::optional(LengthUnit::inch);
  const auto file = io::parse_shape_tree(bytes, "fuzz.json", unit);
  if (!file) {
    must(file.error().code == ErrorCode::bad_input && file.error().message.rfind("fuzz.json", 0) == 0);
    return 0;
  }
  must(!file->regions.empty() && file->tolerance > 0 && std::isfinite(file->tolerance));
  for (const geom::Region& region : file->regions) {
    const auto again = geom::make_region(region.outer, region.holes);
    must(again.has_value() && *again == region);
  }
  must(file->name_of_edge.size() == geom::edges_in(file->regions));
  for (const std::uint32_t name : file->name_of_edge) must(name == io::kNoName || name < file->names.size());
  return 0;
}
