// Solids and scans in space from their bytes: a million points in PLY, and a body of 100,000 triangles in
// every format.

#include <fmt/core.h>

#include <cstdlib>
#include <string>

#include "lekalo/io/solid/solid_file.hpp"
#include "support/solid_files.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"

namespace {

using namespace lekalo;
using solid_files::PlyForm;

void read(const char* what, const std::string& bytes) {
  constexpr int kRuns = 5;
  double least = 1e9, closing = 0;
  std::size_t vertices = 0, triangles = 0;
  for (int run = 0; run < kRuns; ++run) {
    const cases::Stopwatch watch;
    const auto file = io::parse_solid(bytes, "a", {io::SolidUnit::millimetre});
    least = std::min(least, watch.seconds());
    if (!file) {
      fmt::print("{}\n", file.error().message);
      std::exit(EXIT_FAILURE);
    }
    vertices = file->mesh.vertices.size();
    triangles = file->mesh.triangles.size();
    if (run > 0 || triangles == 0) continue;
    const cases::Stopwatch after;
    if (!solid::closed_mesh(file->mesh)) std::exit(EXIT_FAILURE);
    closing = after.seconds();
  }
  fmt::print("{:32} {:7.1f} MB {:8} vertices {:7} triangles: read {:6.3f} s, closed {:6.3f} s\n", what,
             static_cast<double>(bytes.size()) / 1e6, vertices, triangles, least, closing);
}

/// As scanners write them: nothing but coordinates.
template <class Number>
std::string plain_points(const std::vector<solid::Vector>& points) {
  const char* const type = sizeof(Number) == 8 ? "double" : "float";
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
      "end_header\n",
      points.size(), type, type, type);
  for (const solid::Vector p : points)
    for (const double c : {p.x, p.y, p.z}) solid_files::append_binary(out, static_cast<Number>(c), false);
  return out;
}

}  // namespace

int main() {
  Random random(1);
  const solid::Mesh scan{cases::ring(random, 1000, 1000, 100, 20).vertices, {}};
  read("points, PLY float", plain_points<float>(scan.vertices));
  read("points, PLY double", plain_points<double>(scan.vertices));
  read("points and others, PLY double", solid_files::ply<double>(scan, PlyForm::little));
  read("points, PLY text", solid_files::ply<double>(scan, PlyForm::text));
  read("points, text", solid_files::points(scan.vertices));
  const solid::Mesh body = cases::ring(random, 250, 200, 100, 20);
  read("STL binary", solid_files::stl_binary(body));
  read("STL text", solid_files::stl_text(body));
  read("OBJ", solid_files::obj(body));
  read("PLY float", solid_files::ply<float>(body, PlyForm::little));
  read("PLY text", solid_files::ply<double>(body, PlyForm::text));
}
