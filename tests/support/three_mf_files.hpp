#pragma once

// 3MF files as programs write them.

#include <fmt/core.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/solid/mesh.hpp"
#include "support/scan_files.hpp"

namespace lekalo::three_mf_files {

using scan_files::append_binary;

struct Packed {
  std::string name, text;
  bool deflated = true;
  std::uint16_t flags = 0, method = 8;  ///< as written, of deflated ones
};

/// Descriptors: sizes and sum stand behind each file, and are 0 in front of it. Long: in the form beyond 4
/// GB.
enum class ZipForm { plain, descriptors, far };
inline constexpr ZipForm kZipForms[] = {ZipForm::plain, ZipForm::descriptors, ZipForm::far};

inline std::string deflated(const std::string& text, int level = 6) {
  z_stream stream{};
  deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 8, level == 0 ? Z_HUFFMAN_ONLY : Z_DEFAULT_STRATEGY);
  std::string made(deflateBound(&stream, text.size()) + 16, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(made.data());
  stream.avail_out = static_cast<uInt>(made.size());
  deflate(&stream, Z_FINISH);
  made.resize(stream.total_out);
  deflateEnd(&stream);
  return made;
}

inline std::string zip(const std::vector<Packed>& files, ZipForm form = ZipForm::plain,
                       const std::string& comment = "") {
  const auto put = [](std::string& to, auto number) { append_binary(to, number, false); };
  const bool far = form == ZipForm::far, behind = form == ZipForm::descriptors;
  std::string out, directory;
  for (const Packed& file : files) {
    const std::string bytes = file.deflated ? deflated(file.text) : file.text;
    const auto sum = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(file.text.data()), static_cast<uInt>(file.text.size())));
    const auto at = static_cast<std::uint32_t>(out.size()),
               size = static_cast<std::uint32_t>(file.text.size()),
               packed = static_cast<std::uint32_t>(bytes.size());
    const auto flags = static_cast<std::uint16_t>(file.flags | (behind ? 8 : 0));
    const std::uint16_t method = file.deflated ? file.method : 0;
    const auto put_head = [&](std::string& to, bool zeros) {
      put(to, flags), put(to, method), put(to, std::uint32_t{0x5b000000});
      put(to, zeros ? 0 : sum), put(to, far ? 0xffffffffU : (zeros ? 0 : packed));
      put(to, far ? 0xffffffffU : (zeros ? 0 : size));
      put(to, static_cast<std::uint16_t>(file.name.size()));
    };
    put(out, 0x04034b50U), put(out, std::uint16_t{20}), put_head(out, behind);
    put(out, static_cast<std::uint16_t>(far ? 20 : 0));
    out += file.name;
    if (far)
      put(out, std::uint16_t{1}), put(out, std::uint16_t{16}), put(out, std::uint64_t{size}),
          put(out, std::uint64_t{packed});
    out += bytes;
    if (behind) put(out, 0x08074b50U), put(out, sum), put(out, packed), put(out, size);
    put(directory, 0x02014b50U), put(directory, std::uint16_t{20}), put(directory, std::uint16_t{20});
    put_head(directory, false);
    put(directory, static_cast<std::uint16_t>(far ? 36 : 0)), put(directory, std::uint16_t{0});
    put(directory, std::uint32_t{0}), put(directory, std::uint32_t{0});
    put(directory, far ? 0xffffffffU : at);
    directory += file.name;
    if (!far) continue;
    put(directory, std::uint16_t{7}), put(directory, std::uint16_t{4}), put(directory, std::uint32_t{9});
    put(directory, std::uint16_t{1}), put(directory, std::uint16_t{24}), put(directory, std::uint64_t{size});
    put(directory, std::uint64_t{packed}), put(directory, std::uint64_t{at});
  }
  const auto begin = static_cast<std::uint32_t>(out.size()), count = static_cast<std::uint32_t>(files.size());
  out += directory;
  if (far) {
    const std::uint64_t end = out.size();
    put(out, 0x06064b50U), put(out, std::uint64_t{44}), put(out, std::uint16_t{45}),
        put(out, std::uint16_t{45});
    put(out, std::uint64_t{0}), put(out, std::uint64_t{count}), put(out, std::uint64_t{count});
    put(out, std::uint64_t{directory.size()}), put(out, std::uint64_t{begin});
    put(out, 0x07064b50U), put(out, std::uint32_t{0}), put(out, end), put(out, std::uint32_t{1});
  }
  put(out, 0x06054b50U), put(out, std::uint32_t{0});
  for (int twice = 0; twice < 2; ++twice) put(out, static_cast<std::uint16_t>(far ? 0xffff : count));
  put(out, far ? 0xffffffffU : static_cast<std::uint32_t>(directory.size()));
  put(out, far ? 0xffffffffU : begin), put(out, static_cast<std::uint16_t>(comment.size()));
  return out + comment;
}

inline std::string relations(const std::string& target = "/3D/3dmodel.model") {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
      " <Relationship Target=\"/Metadata/thumbnail.png\" Id=\"rel-2\" "
      "Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>\n"
      " <Relationship Target=\"{}\" Id=\"rel-1\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n</Relationships>\n",
      target);
}

/// Elements of the core stand behind a prefix, if one is given: "m:".
inline std::string mesh(const solid::Mesh& of, const std::string& p = "") {
  std::string out = fmt::format("<{0}mesh>\n<{0}vertices>\n", p);
  for (const solid::Vector v : of.vertices)
    out += fmt::format("<{}vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", p, v.x, v.y, v.z);
  out += fmt::format("</{0}vertices>\n<{0}triangles>\n", p);
  for (const solid::Triangle& t : of.triangles)
    out += fmt::format("<{}triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", p, t[0], t[1], t[2]);
  return out + fmt::format("</{0}triangles>\n</{0}mesh>\n", p);
}
inline std::string object(int id, const std::string& inside, const std::string& attributes = "") {
  return fmt::format("<object id=\"{}\" {}>\n{}</object>\n", id, attributes, inside);
}
inline std::string components(const std::string& inside) {
  return "<components>" + inside + "</components>\n";
}
inline std::string component(int id, const std::string& transform = "", const std::string& more = "") {
  return fmt::format("<component objectid=\"{}\" {} {}/>\n", id,
                     transform.empty() ? "" : "transform=\"" + transform + "\"", more);
}
inline std::string item(int id, const std::string& transform = "", const std::string& more = "") {
  return fmt::format("<item objectid=\"{}\" {} {}/>\n", id,
                     transform.empty() ? "" : "transform=\"" + transform + "\"", more);
}
inline constexpr const char* kSpaces =
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
    "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
    "xmlns:t=\"http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07\"";
inline std::string model(const std::string& resources, const std::string& build,
                         const std::string& attributes = "unit=\"millimeter\"") {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model {} xml:lang=\"en-US\" {}>\n"
      "<metadata name=\"Title\">a &amp; "
      "b</metadata>\n<resources>\n{}</resources>\n<build>\n{}</build>\n</model>\n",
      attributes, kSpaces, resources, build);
}

inline std::string archive(const std::string& root, const std::vector<Packed>& more = {},
                           ZipForm form = ZipForm::plain) {
  std::vector<Packed> files{
      {"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relations()}, {"3D/3dmodel.model", root}};
  files.insert(files.end(), more.begin(), more.end());
  return zip(files, form);
}
/// One object in the build.
inline std::string archive(const solid::Mesh& of) {
  return archive(model(object(1, mesh(of), "name=\"part\" type=\"model\""), item(1)));
}

}  // namespace lekalo::three_mf_files
