#include <fmt/core.h>

#include <bit>
#include <cstdint>

#include "lekalo/base/stop.hpp"
#include "lekalo/io/solid/solid_file.hpp"

namespace lekalo::io {
namespace {

void put(std::string& bytes, std::uint64_t word, int count) {
  for (int k = 0; k < count; ++k) bytes.push_back(static_cast<char>(word >> (8 * k) & 0xff));
}

}  // namespace

std::string ply_text(const solid::Mesh& mesh, const PlyLook& look) {
  const bool looks = !look.colours.empty();
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\n{}element face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      mesh.vertices.size(),
      looks ? "property double quality\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
      mesh.triangles.size());
  bytes.reserve(bytes.size() + (looks ? 35 : 24) * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    ask();
    const solid::Vector p = mesh.vertices[k];
    for (const double x : {p.x, p.y, p.z}) put(bytes, std::bit_cast<std::uint64_t>(x), 8);
    if (!looks) continue;
    put(bytes, std::bit_cast<std::uint64_t>(look.quality[k]), 8);
    for (const std::uint8_t share : look.colours[k]) put(bytes, share, 1);
  }
  for (const solid::Triangle& t : mesh.triangles) {
    ask();
    bytes.push_back(3);
    for (const std::uint32_t corner : t) put(bytes, corner, 4);
  }
  return bytes;
}

}  // namespace lekalo::io
