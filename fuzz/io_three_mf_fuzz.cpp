// Models of 3MF of any text, and archives of any bytes: read or refused with a sentence, and what the checker
// reads, too, is the same body.

#include <cmath>
#include <string>
#include <string_view>

#include "io_contour_check.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "support/three_mf_files.hpp"
#include "verify/solid/solid_mesh.hpp"

namespace {

using namespace lekalo;
using fuzz::must;

void check_same(const io::SolidFile& file, const verify::SolidReading& other) {
  must(other.mesh.near.size() == file.mesh.vertices.size());
  must(other.mesh.triangles.size() == file.mesh.triangles.size());
  const auto name = [](const auto& groups, const auto& of, std::size_t t) {
    return groups.empty() ? std::string() : groups[of[t]];
  };
  for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t) {
    must(other.mesh.triangles[t] == file.mesh.triangles[t]);
    must(name(other.groups, other.group_of, t) == name(file.groups, file.group_of_triangle, t));
  }
  must(static_cast<int>(other.unit) == static_cast<int>(file.unit));
  for (std::size_t v = 0; v < file.mesh.vertices.size(); ++v) {
    const solid::Vector p = file.mesh.vertices[v];
    const double xyz[] = {p.x, p.y, p.z};
    // The double nearest to the exact place is a rounding away from it.
    for (std::size_t axis = 0; axis < 3; ++axis)
      must(std::abs(other.mesh.near[v][axis] - xyz[axis]) <=
           file.coordinate_error + 0x1p-52 * std::abs(other.mesh.near[v][axis]));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string name = "fuzz.3mf";
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool is_archive = data[0] == 'P';
  const std::string bytes = is_archive
                                ? text
                                : three_mf_files::zip({{"_rels/.rels", three_mf_files::relations(), false},
                                                       {"3D/3dmodel.model", text, false}});
  const auto file = io::parse_solid(bytes, name);
  if (!file) fuzz::check_sentence(file.error(), name);
  const auto other = verify::read_solid({name, bytes});
  if (!other) must(other.error().code == ErrorCode::bad_input);
  if (!file || !other || other->open) return 0;
  check_same(*file, *other);
  return 0;
}
