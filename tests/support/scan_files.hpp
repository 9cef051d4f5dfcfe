#pragma once

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/geom/polygon.hpp"

namespace lekalo::scan_files {

/// Files of points as programs write them.

inline std::string text(const geom::Ring& points) {
  std::string out;
  for (const geom::Point p : points) out += fmt::format("{:.4f} {:.4f}\n", p.x, p.y);
  return out;
}

template <class T>
void append_binary(std::string& out, T value, bool big) {
  char bytes[sizeof(T)];
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = raw[big ? sizeof(T) - 1 - i : i];
  out.append(bytes, sizeof(T));
}

struct Vertex {
  double x = 0, y = 0, z = 0;
};

inline std::string ply_ascii(const std::vector<Vertex>& vertices) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\ncomment made by a test\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n",
      vertices.size());
  for (const Vertex& v : vertices) out += fmt::format("{} {} {} 255\n", v.x, v.y, v.z);
  return out + "3 0 1 2\n";
}

/// Doubles, an element with a list before the vertices, a byte between the coordinates.
inline std::string ply_binary(const std::vector<Vertex>& vertices, bool big) {
  std::string out = fmt::format(
      "ply\r\nformat binary_{}_endian 1.0\r\nelement camera 2\r\nproperty list uchar short path\r\nproperty "
      "int id\r\n"
      "element vertex {}\r\nproperty double x\r\nproperty uchar red\r\nproperty double y\r\nproperty double "
      "z\r\n"
      "end_header\r\n",
      big ? "big" : "little", vertices.size());
  for (int k = 0; k < 2; ++k) {
    append_binary(out, std::uint8_t(k), big);
    for (int i = 0; i < k; ++i) append_binary(out, std::int16_t{7}, big);
    append_binary(out, std::int32_t{k}, big);
  }
  for (const Vertex& v : vertices) {
    append_binary(out, v.x, big);
    append_binary(out, std::uint8_t{200}, big);
    append_binary(out, v.y, big);
    append_binary(out, v.z, big);
  }
  return out;
}

/// Points of a rectangle's outline, `spacing` apart, from (x, y).
inline geom::Ring rectangle(double x, double y, double w, double h, double spacing) {
  geom::Ring ring;
  const geom::Point corners[4] = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
  for (int s = 0; s < 4; ++s) {
    const geom::Point a = corners[s], side = corners[(s + 1) % 4] - a;
    const int n = static_cast<int>(norm(side) / spacing + 0.5);
    for (int i = 0; i < n; ++i) ring.push_back(a + (static_cast<double>(i) / n) * side);
  }
  return ring;
}

}  // namespace lekalo::scan_files
