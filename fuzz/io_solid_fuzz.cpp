// Files of solids of any bytes: read or refused with a sentence, and what is called closed is.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io_contour_check.hpp"
#include "lekalo/io/solid/solid_file.hpp"

namespace {

using namespace lekalo;
using fuzz::must;

void check_file(const io::SolidFile& file) {
  must(!file.mesh.vertices.empty() && file.coordinate_error >= 0);
  for (const solid::Vector p : file.mesh.vertices)
    for (const double c : {p.x, p.y, p.z}) must(c == 0 || (std::abs(c) <= 1e9 && std::abs(c) >= 1e-100));
  for (const solid::Triangle& t : file.mesh.triangles)
    for (const std::uint32_t v : t) must(v < file.mesh.vertices.size());
  must(file.group_of_triangle.size() == (file.groups.empty() ? 0 : file.mesh.triangles.size()));
  for (const std::uint32_t group : file.group_of_triangle) must(group < file.groups.size());
}

void check_closed(const solid::ClosedMesh& closed, std::size_t given) {
  must(closed.numbers.size() == closed.mesh.triangles.size() && !closed.shells.empty());
  must(std::is_sorted(closed.numbers.begin(), closed.numbers.end()) && closed.numbers.back() < given);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const solid::Triangle& t : closed.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      must(a != b && a < closed.mesh.vertices.size());
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  }
  for (const auto& [ends, count] : edges) must(count % 2 == 0);
  std::size_t triangles = 0;
  for (const solid::Shell& shell : closed.shells) {
    triangles += shell.triangles;
    must(std::isfinite(shell.volume));
  }
  must(triangles == closed.mesh.triangles.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  constexpr const char* kNames[] = {"fuzz.stl", "fuzz.obj", "fuzz.ply", "fuzz.xyz", "fuzz"};
  const std::string name = kNames[data[0] % 5];
  io::SolidOptions options;
  if (data[0] & 64) options.units = io::SolidUnit::inch;
  if (data[0] & 128) options.units = io::SolidUnit::metre;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto file = io::parse_solid(bytes, name, options);
  if (!file) {
    fuzz::check_sentence(file.error(), name);
    return 0;
  }
  check_file(*file);
  if (file->mesh.triangles.empty()) return 0;
  if (const auto closed = solid::closed_mesh(file->mesh)) check_closed(*closed, file->mesh.triangles.size());
  return 0;
}
