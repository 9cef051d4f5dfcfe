// Forms of files of solids, of each one more that is read, and the next that is not.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "support/solid_files.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_solid_forms_test {
namespace {

using solid_files::append_binary;

const std::string kClosed = "closed, 4 vertices, 4 triangles";

/// "closed" with numbers, or the sentence of what is open or wrong.
std::string reading(const std::string& bytes, SolidUnit unit = SolidUnit::millimetre) {
  const auto read = read_solid({"s", bytes}, unit);
  if (!read) return read.error().message;
  if (read->open) return "open: " + *read->open;
  const auto made = closed(read->mesh, "s");
  if (!made) return made.error().message;
  return fmt::format("closed, {} vertices, {} triangles", made->near.size(), made->triangles.size());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n",
                  kFaces = "element face 4\nproperty list uchar int vertex_indices\n",
                  kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                  kTriangles = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
/// A tetrahedron with more lines in its header, and rows before those of its faces.
std::string ply(const std::string& more, const std::string& rows = "", const std::string& faces = kFaces,
                const std::string& triangles = kTriangles) {
  return "ply\nformat ascii 1.0\n" + kVertices + more + faces + "end_header\n" + kPoints + rows + triangles;
}

TEST(SolidForms, APlyMayHaveMoreInIt) {
  EXPECT_EQ(reading(ply("")), kClosed);
  EXPECT_EQ(reading(ply("obj_info made\ncomment made\n\n")), kClosed);
  EXPECT_EQ(reading(ply("element strip 1\nproperty list uchar float vertex_indices\n", "2 -0.5 x\n")),
            kClosed);
  EXPECT_EQ(reading(ply("element tristrips 0\nproperty list int int vertex_indices\n")), kClosed);
  EXPECT_EQ(reading(ply("property list uchar float vertex_indices\n")),
            "s:11: the row ends early, or has a list without a length");
  // The format may stand anywhere, but once.
  const std::string late = replaced(ply(""), "format ascii 1.0\n", "");
  EXPECT_EQ(reading(replaced(late, "end_header", "format ascii 1.0\nend_header")), kClosed);
  // A list of corners of vertices is none of faces, and a face may have lists beside its corners.
  std::string listed = ply("property list uchar short vertex_indices\n");
  for (const char* point : {"0 0 0\n", "1 0 0\n", "0 1 0\n", "0 0 1\n"})
    listed = replaced(listed, point, std::string(point, 5) + " 2 -1 0.5\n");
  EXPECT_EQ(reading(listed), kClosed);
  EXPECT_EQ(
      reading(ply("", "",
                  "element face 4\nproperty list uchar int vertex_index\nproperty list uchar float uv\n",
                  "3 0 2 1 2 0.5 1\n3 0 1 3 0\n3 1 2 3 4 9 9 9 9\n3 2 0 3 1 -1\n")),
      kClosed);
  EXPECT_EQ(reading(ply("", "", "element face 0\nproperty int a\n", "")), "open: it has no faces");
}

TEST(SolidForms, OfAPlyEachLineOfTheHeaderIsKnown) {
  const std::string unknown = "this line of the header is not known";
  for (const char* const line : {"note float w", "property set uchar int w", "property list float int w",
                                 "element more 99999999999999999999", "element more 1 2", "format ascii"})
    EXPECT_NE(reading(ply(std::string(line) + "\n")).find(unknown), std::string::npos) << line;
  EXPECT_EQ(reading(replaced(ply(""), "property float x", "property list uchar float x")),
            "s: the vertices of this PLY have no x, y and z");
  EXPECT_EQ(reading(ply("", "", "element face 4\nproperty int vertex_indices\n", "1\n1\n1\n1\n")),
            "s: the faces of this PLY have no vertex_indices");
  std::string many = "element more 1\n", row;
  for (int k = 0; k < 256; ++k) many += fmt::format("property int p{}\n", k), row += "0 ";
  EXPECT_EQ(reading(ply(many, row + "\n")), kClosed);
  EXPECT_NE(reading(ply(many + "property int p256\n", row + "0\n")).find(unknown), std::string::npos);
  // The end of the header may be its line 2000.
  std::string long_one = ply("");
  while (long_one.find("end_header") < 20'000)
    long_one = replaced(long_one, "end_header", "comment\nend_header");
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("end_header")),
                      '\n') +
           1;
  };
  while (lines(long_one) > 2000) long_one = replaced(long_one, "comment\n", "");
  ASSERT_EQ(lines(long_one), 2000);
  EXPECT_EQ(reading(long_one), kClosed);
  EXPECT_EQ(reading(replaced(long_one, "comment\n", "comment\ncomment\n")),
            "s: the header of this PLY does not end");
}

template <class Number>
void expect_numbers(const std::vector<const char*>& names, const std::vector<double>& values) {
  for (const char* const name : names)
    for (const bool big : {false, true}) {
      std::string bytes = fmt::format(
          "ply\nformat binary_{}_endian 1.0\nelement vertex 4\nproperty {} x\nproperty {} y\nproperty {} z\n"
          "element face 4\nproperty list {} {} vertex_indices\nend_header\n",
          big ? "big" : "little", name, name, name, *name == 'f' || *name == 'd' ? "uchar" : name,
          *name == 'f' || *name == 'd' ? "uchar" : name);
      for (const double value : values) append_binary(bytes, static_cast<Number>(value), big);
      for (int k = static_cast<int>(values.size()); k < 12; ++k)
        append_binary(bytes, static_cast<Number>(k % 4 == 3 ? 1 : 0), big);
      for (const int corner : {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3})
        if constexpr (std::is_floating_point_v<Number>)
          append_binary(bytes, static_cast<std::uint8_t>(corner), big);
        else
          append_binary(bytes, static_cast<Number>(corner), big);
      const auto read = read_solid({"s", bytes});
      ASSERT_TRUE(read && !read->open) << name << ": " << reading(bytes);
      ASSERT_EQ(read->mesh.triangles.size(), 4U);
      for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_EQ(read->mesh.near[k / 3][k % 3], values[k]) << name << k;
    }
}

TEST(SolidForms, OfAPlyEachKindOfNumberIsRead) {
  expect_numbers<std::int8_t>({"char", "int8"}, {-128, 127, -1, 0, 1, -77});
  expect_numbers<std::uint8_t>({"uchar", "uint8"}, {255, 128, 1, 0, 127, 9});
  expect_numbers<std::int16_t>({"short", "int16"}, {-32768, 32767, -1, 0, 300, -300});
  expect_numbers<std::uint16_t>({"ushort", "uint16"}, {65535, 32768, 1, 0, 300, 9});
  expect_numbers<std::int32_t>({"int", "int32"}, {-1e9, 1e9, -1, 0, 70000, -70000});
  expect_numbers<std::uint32_t>({"uint", "uint32"}, {1e9, 70000, 1, 0, 300, 9});
  expect_numbers<float>({"float", "float32"}, {-1e9, 0.5, -0.25, 0, 1e-30F, 9});
  expect_numbers<double>({"double", "float64"}, {-1e9, 0.1, -0.25, 0, 1e-99, 9});
}

TEST(SolidForms, WordsOfAnStlAreWhole) {
  const std::string text = "solid\n facet normal 0 0 0\n  outer loop\n";
  for (const auto& [from, to, wanted] : {std::tuple("facet", "fecit", "'facet' or 'endsolid'"),
                                         {"normal", "normae", "'normal'"},
                                         {"outer", "inner", "'outer'"},
                                         {"loop", "loo[", "'loop'"},
                                         {"loop", "lmop", "'loop'"}})
    EXPECT_NE(reading(replaced(text, from, to)).find(fmt::format("\"{}\" where {} is wanted", to, wanted)),
              std::string::npos)
        << to << ": " << reading(replaced(text, from, to));
  EXPECT_EQ(reading("SoLiD\nEndSolid\n"), "s: there are no triangles in it");
  EXPECT_EQ(reading("splid\nendsolid\n"), "open: it is none of STL, OBJ, PLY and 3MF");
  EXPECT_EQ(reading(solid_files::stl_binary({})), "s: there are no triangles in it");
  EXPECT_EQ(reading(std::string(83, ' ')), "open: it is none of STL, OBJ, PLY and 3MF");
}

TEST(SolidForms, AnObjMayHaveTabsAndNumbersFromItsEnd) {
  EXPECT_EQ(reading("v\t0\t0\t0\nv\t1 0 0\nv\t0 1 0\nv\t0 0 1\nf\t1 3 2\nf 1 2 -1\nf -3 -2 -1\nf -2 -4 4\n"),
            kClosed);
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* const none : {"/1", "-0", "+1", "1.", "-9223372036854775808", "9223372036854775807"})
    EXPECT_EQ(reading(three + "f 1 2 " + none + "\n"),
              fmt::format("s:4: \"{}\" is not the number of a vertex that stands before this line", none));
  // What no triangle uses may be anywhere.
  EXPECT_EQ(reading("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5\n"),
            "closed, 5 vertices, 4 triangles");
}

TEST(SolidForms, SizesEndAtTheirLimits) {
  const auto with = [](const std::string& x) {
    return "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  };
  EXPECT_EQ(reading(with("-1e9")), kClosed);
  EXPECT_EQ(reading(with("1000000000.001")), "s:1: the coordinate 1000000000.001 is not within 1e+09 mm");
  EXPECT_EQ(reading(with("1e6"), SolidUnit::metre), kClosed);
  EXPECT_EQ(reading(with("1e7"), SolidUnit::metre), "s:1: the coordinate 10000000000 is not within 1e+09 mm");
  const auto first = [&](const std::string& x) { return read_solid({"s", with(x)})->mesh.near[0][0]; };
  EXPECT_EQ(first("1e-100"), limits::kSmallestCoordinate);
  EXPECT_EQ(first("-1e-100"), -limits::kSmallestCoordinate);
  EXPECT_EQ(first("0.99e-100"), 0);
  EXPECT_TRUE(read_solid({"s", with("1e-100")})->mesh.exact(0, 0) != 0);
  EXPECT_TRUE(read_solid({"s", with("0.99e-100")})->mesh.exact(0, 0) == 0);
  // Of doubles, too.
  const auto doubles = [](double x, SolidUnit unit) {
    solid::Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
    mesh.vertices[0].x = x;
    return reading(solid_files::ply<double>(mesh, solid_files::PlyForm::little), unit);
  };
  const std::string cube = "closed, 8 vertices, 12 triangles";
  EXPECT_EQ(doubles(-1e9, SolidUnit::millimetre), cube);
  EXPECT_EQ(doubles(1e7, SolidUnit::inch), cube);
  EXPECT_EQ(doubles(1e9, SolidUnit::inch), "s: vertex 0: the coordinate 25400000000 is not within 1e+09 mm");
  EXPECT_EQ(doubles(1e9, SolidUnit::metre),
            "s: vertex 0: the coordinate 1000000000000 is not within 1e+09 mm");
  EXPECT_EQ(doubles(2e9, SolidUnit::metre), "s: vertex 0: the coordinate 2000000000 is not within 1e+09 mm");
}

TEST(SolidForms, FlatIsWhatIsExactlyFlat) {
  // Two triangles back to back: they close, so that they count unless they are without area.
  const std::string cube = solid_files::obj(cases::block({0, 0, 0}, {1.5, 2, 3}));
  const auto with = [&](const char* middle) {
    return reading(cube + "v " + middle + "\nf 2 3 9\nf 2 3 9\n");
  };
  EXPECT_EQ(with("0.75 1 0"), "closed, 9 vertices, 12 triangles");
  for (const char* off :
       {"0.75 1 1e-30", "0.750000000000000000000000000001 1 0", "0.75 1.00000000000000000001 0"})
    EXPECT_EQ(with(off), "closed, 9 vertices, 14 triangles") << off;
  // Places that differ in the last digits are in the order of their numbers, however these are written.
  const std::string near =
      "v 1.00000000000000000001 0 0\nv 10000000000000000000000e-22 0 0\nv 1.0000000000000000000100 0 0\n"
      "v 0 1 0\nv 0 0 1\nv 0.0 0 0e3\n";
  EXPECT_EQ(reading(near + "f 1 4 5\nf 3 5 6\nf 1 6 4\nf 4 6 5\n"), "closed, 5 vertices, 4 triangles");
  EXPECT_NE(reading(near + "f 1 4 5\nf 2 5 6\nf 1 6 4\nf 4 6 5\n").find("the surface is open"),
            std::string::npos);
}

TEST(SolidForms, TrianglesKeepTheirNumbersInTheFile) {
  const auto read = read_solid({"s",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 1 2\nf 1 3 2\nf 1 2 4\nf 2 3 2\nf 2 "
                                "3 4\nf 3 1 4\nf 4 4 4\n"});
  const auto made = closed(read->mesh, "s");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->numbers, (std::vector<std::uint32_t>{1, 2, 4, 5}));
  for (const auto& [number, at] : {std::pair(1U, 0U), {2, 1}, {4, 2}, {5, 3}})
    EXPECT_EQ(made->triangle_of_file(number), at);
  for (const std::size_t none : {0U, 3U, 6U, 7U}) EXPECT_FALSE(made->triangle_of_file(none)) << none;
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_forms_test
