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

std::string ply_text(const solid::Mesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const solid::Vector p : mesh.vertices) {
    ask();
    for (const double x : {p.x, p.y, p.z}) put(bytes, std::bit_cast<std::uint64_t>(x), 8);
  }
  for (const solid::Triangle& t : mesh.triangles) {
    ask();
    bytes.push_back(3);
    for (const std::uint32_t corner : t) put(bytes, corner, 4);
  }
  return bytes;
}

}  // namespace lekalo::io
