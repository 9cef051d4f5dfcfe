#pragma once

// Files of solids as programs write them.

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/solid/mesh.hpp"
#include "support/scan_files.hpp"

namespace lekalo::solid_files {

using scan_files::append_binary;

inline std::string stl_text(const solid::Mesh& mesh, const std::string& name = "part") {
  std::string out = "solid " + name + "\n";
  for (const solid::Triangle& t : mesh.triangles) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t v : t) {
      const solid::Vector p = mesh.vertices[v];
      out += fmt::format("   vertex {} {} {}\n", p.x, p.y, p.z);
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid " + name + "\n";
}

/// Coordinates are rounded to single precision.
inline std::string stl_binary(const solid::Mesh& mesh, std::string header = "solid made by a test") {
  header.resize(80, ' ');
  append_binary(header, static_cast<std::uint32_t>(mesh.triangles.size()), false);
  for (const solid::Triangle& t : mesh.triangles) {
    for (int axis = 0; axis < 3; ++axis) append_binary(header, 0.0F, false);
    for (const std::uint32_t v : t)
      for (const double c : {mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z})
        append_binary(header, static_cast<float>(c), false);
    append_binary(header, std::uint16_t{0}, false);
  }
  return header;
}

/// With every form of an index in turn.
inline std::string obj(const solid::Mesh& mesh) {
  std::string out = "# made by a test\nmtllib a.mtl\no part\n";
  for (const solid::Vector p : mesh.vertices) out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  out += "vn 0 0 1\nvt 0 0\n";
  std::size_t form = 0;
  for (const solid::Triangle& t : mesh.triangles) {
    out += "f";
    for (const std::uint32_t v : t) {
      switch (form++ % 5) {
        case 0:
          out += fmt::format(" {}", v + 1);
          break;
        case 1:
          out += fmt::format(" {}",
                             static_cast<std::int64_t>(v) - static_cast<std::int64_t>(mesh.vertices.size()));
          break;
        case 2:
          out += fmt::format(" {}/1", v + 1);
          break;
        case 3:
          out += fmt::format(" {}//1", v + 1);
          break;
        default:
          out += fmt::format(" {}/1/-1", v + 1);
      }
    }
    out += "\n";
  }
  return out;
}

enum class PlyForm { text, little, big };
inline constexpr PlyForm kPlyForms[] = {PlyForm::text, PlyForm::little, PlyForm::big};

/// Properties that nobody asked for stand between the coordinates, which are not in order, and a list of its
/// own in every vertex; an element that nobody knows comes first. Coordinates of type Number.
template <class Number>
std::string ply(const solid::Mesh& mesh, PlyForm form, bool faces_first = false) {
  const char* const type = sizeof(Number) == 8 ? "double" : "float";
  const std::string vertices = fmt::format(
      "element vertex {}\nproperty {} z\nproperty uchar red\nproperty {} x\nproperty list uchar short near\n"
      "property {} y\n",
      mesh.vertices.size(), type, type, type);
  const std::string faces = mesh.triangles.empty()
                                ? std::string()
                                : fmt::format(
                                      "element face {}\nproperty int flags\nproperty list uchar uint "
                                      "vertex_indices\nproperty float quality\n",
                                      mesh.triangles.size());
  std::string out = fmt::format(
      "ply\nformat {} 1.0\ncomment made by a test\nelement camera 2\nproperty list uint double "
      "view\nproperty char id\n",
      form == PlyForm::text  ? "ascii"
      : form == PlyForm::big ? "binary_big_endian"
                             : "binary_little_endian");
  out += (faces_first ? faces + vertices : vertices + faces) + "end_header\n";
  const auto put = [&](auto value, bool last = false) {
    if (form == PlyForm::text)
      out += fmt::format("{}{}", value, last ? '\n' : ' ');
    else
      append_binary(out, value, form == PlyForm::big);
  };
  for (std::uint32_t k = 0; k < 2; ++k) {
    put(k);
    for (std::uint32_t i = 0; i < k; ++i) put(0.5);
    put(std::int8_t{3}, true);
  }
  const auto put_faces = [&] {
    for (const solid::Triangle& t : mesh.triangles) {
      put(std::int32_t{-1}), put(std::uint8_t{3});
      for (const std::uint32_t v : t) put(v);
      put(0.25F, true);
    }
  };
  if (faces_first) put_faces();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const solid::Vector p = mesh.vertices[v];
    put(static_cast<Number>(p.z)), put(std::uint8_t{200}), put(static_cast<Number>(p.x));
    put(static_cast<std::uint8_t>(v % 3));
    for (std::size_t i = 0; i < v % 3; ++i) put(std::int16_t{-7});
    put(static_cast<Number>(p.y), true);
  }
  if (!faces_first) put_faces();
  return out;
}

inline std::string points(const std::vector<solid::Vector>& all, char separator = ' ') {
  std::string out;
  for (const solid::Vector p : all) out += fmt::format("{}{}{}{}{}\n", p.x, separator, p.y, separator, p.z);
  return out;
}

/// A text PLY as lekalo-step writes it: each triangle has the number of its face, and each face a name; and a
/// colour, where there are colours.
inline std::string step_mesh(const solid::Mesh& mesh, const std::string& deviation,
                             const std::vector<std::uint32_t>& face_of, const std::vector<std::string>& names,
                             const std::vector<std::uint32_t>& colours = {}) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\ncomment lekalo-step 1\ncomment deviation {}\nelement vertex {}\nproperty "
      "double x\n"
      "property double y\nproperty double z\nelement face {}\nproperty list uchar uint vertex_indices\n"
      "property uint face\nelement body_face {}\nproperty double deviation\n{}property list uchar uchar "
      "kind\n"
      "property list uchar uchar name\nend_header\n",
      deviation, mesh.vertices.size(), mesh.triangles.size(), names.size(),
      colours.empty() ? "" : "property uint colour\n");
  for (const solid::Vector p : mesh.vertices) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    out += fmt::format("3 {} {} {} {}\n", mesh.triangles[t][0], mesh.triangles[t][1], mesh.triangles[t][2],
                       face_of[t]);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string& name = names[k];
    out += deviation;
    if (!colours.empty()) out += fmt::format(" {}", colours[k]);
    out += fmt::format(" 1 112 {}", name.size());
    for (const char c : name) out += fmt::format(" {}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += "\n";
  }
  return out;
}

}  // namespace lekalo::solid_files
