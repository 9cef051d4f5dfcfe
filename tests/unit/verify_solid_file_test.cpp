// The checker's reader of closed meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "support/solid_files.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_solid_file_test {
namespace {

using namespace solid_files;
using solid::Mesh;

/// "closed" with numbers, or the sentence of what is open or wrong.
std::string reading(const std::string& bytes) {
  const auto read = read_solid({"s", bytes});
  if (!read) return read.error().message;
  if (read->open) return "open: " + *read->open;
  const auto made = closed(read->mesh, "s");
  if (!made) return made.error().message;
  return fmt::format("closed, {} vertices, {} triangles", made->near.size(), made->triangles.size());
}

Mesh cube() { return cases::block({0, 0, 0}, {1.5, 2, 3}); }

TEST(SolidReader, EveryFormatGivesTheSameCube) {
  const std::string closed = "closed, 8 vertices, 12 triangles";
  EXPECT_EQ(reading(stl_text(cube())), closed);
  EXPECT_EQ(reading(stl_binary(cube())), closed);
  EXPECT_EQ(reading(stl_binary(cube(), "head")), closed);
  EXPECT_EQ(reading(obj(cube())), closed);
  for (const PlyForm form : kPlyForms) {
    EXPECT_EQ(reading(ply<float>(cube(), form)), closed);
    EXPECT_EQ(reading(ply<double>(cube(), form, true)), closed);
  }
}

TEST(SolidReader, ColoursAreThoseOfTheFacesOfAStepFile) {
  const std::string closed = "closed, 8 vertices, 12 triangles";
  const auto coloured = [](std::uint32_t one) {
    return step_mesh(cube(), "0.5", {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}, {"", ""}, {7, one});
  };
  const auto with = [](std::string text, const std::string& words, const std::string& others) {
    return text.replace(text.find(words), words.size(), others);
  };
  const auto colours = [](const std::string& text) {
    const auto read = read_solid({"s", text});
    return read ? read->colours : std::vector<std::uint32_t>{~0U};
  };
  EXPECT_EQ(colours(coloured(0x1000000)), (std::vector<std::uint32_t>{7, 0x1000000}));
  EXPECT_NE(reading(coloured(0x1000001)).find("its colour is not one"), std::string::npos);
  EXPECT_NE(reading(with(coloured(0x1000001), "16777217", "red")).find("its colour is not one"),
            std::string::npos);
  EXPECT_NE(reading(with(coloured(0x1000001), "16777217", "-1")).find("its colour is not one"),
            std::string::npos);
  // What others write of colours, or what is none, is nobody's matter.
  EXPECT_EQ(reading(with(coloured(0x1000001), "comment lekalo-step 1\n", "")), closed);
  EXPECT_EQ(colours(with(coloured(7), "comment lekalo-step 1\n", "")), std::vector<std::uint32_t>{});
  const std::string more = with(coloured(7), "end_header", "element more 1\nproperty int colour\nend_header");
  EXPECT_EQ(reading(more + "-1\n"), closed);
  EXPECT_EQ(colours(more + "9\n"), (std::vector<std::uint32_t>{7, 7}));
  const std::string plain = step_mesh(cube(), "0.5", {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}, {"", ""});
  EXPECT_EQ(reading(with(plain, " kind", " colour")), closed);
  EXPECT_EQ(colours(with(plain, " kind", " colour")), std::vector<std::uint32_t>{});
}

TEST(SolidReader, NumbersAreWhatIsWritten) {
  Mesh mesh = cube();
  mesh.vertices[7] = {0.1, 1e-7, 1234567.875};
  for (const std::string& text : {stl_text(mesh), obj(mesh), ply<double>(mesh, PlyForm::text)}) {
    const auto read = read_solid({"s", text});
    ASSERT_TRUE(read && !read->open) << reading(text);
    const auto made = closed(read->mesh, "s");
    ASSERT_TRUE(made);
    const auto at = std::ranges::find(made->near, std::array<double, 3>{0.1, 1e-7, 1234567.875});
    ASSERT_NE(at, made->near.end());
    const auto v = static_cast<std::uint32_t>(at - made->near.begin());
    EXPECT_TRUE(made->exact(v, 0) == Fraction(1, 10));
    EXPECT_TRUE(made->exact(v, 1) == Fraction(1, 10'000'000));
    EXPECT_LT(made->enclosed(v, 0).low, 0.1);
    EXPECT_GT(made->enclosed(v, 0).high, 0.1);
  }
  for (const std::string& bytes : {ply<double>(mesh, PlyForm::little), ply<double>(mesh, PlyForm::big)}) {
    const auto read = read_solid({"s", bytes});
    ASSERT_TRUE(read && !read->open);
    EXPECT_TRUE(read->mesh.exact(7, 0) == Fraction(0.1));
  }
  const auto single = read_solid({"s", stl_binary(mesh)});
  ASSERT_TRUE(single);
  EXPECT_TRUE(std::ranges::any_of(single->mesh.near, [](const auto& p) { return p[0] == 0.1F; }));
}

TEST(SolidReader, PlacesAreOneWhereTheirNumbersAre) {
  std::string text = stl_text(cube());
  const auto replace_first = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace_first("vertex 1.5 0 0", "vertex 15e-1 -0.0 0e5");
  EXPECT_EQ(reading(text), "closed, 8 vertices, 12 triangles");
  // A number below 1e-100 mm is 0; one of 1e-30 is another place, which doubles near 1.5 do not see.
  replace_first("vertex 15e-1 -0.0 0e5", "vertex 1.5 1e-101 0");
  EXPECT_EQ(reading(text), "closed, 8 vertices, 12 triangles");
  replace_first("vertex 1.5 1e-101 0", "vertex 1.500000000000000000000000000001 0 0");
  EXPECT_NE(reading(text).find("s: the surface is open: the edge from ("), std::string::npos)
      << reading(text);
}

TEST(SolidReader, OpenEdgesAreRefusedWithAPlace) {
  Mesh mesh = cube();
  mesh.triangles.pop_back();
  EXPECT_EQ(
      reading(stl_binary(mesh)),
      "s: the surface is open: the edge from (1.5, 0, 3) to (1.5, 2, 0) belongs to one triangle or an odd "
      "number of them");
}

TEST(SolidReader, TrianglesWithoutAreaAreLeftOutUnlessTheSurfaceClosesAlongThem) {
  Mesh mesh = cube();
  mesh.vertices.push_back({0.75, 1, 0});
  mesh.triangles.push_back({1, 2, 8});
  mesh.triangles.push_back({1, 2, 8});
  mesh.triangles.push_back({1, 1, 8});
  EXPECT_EQ(reading(obj(mesh)), "closed, 9 vertices, 12 triangles");
  mesh.triangles.resize(13);
  mesh.triangles[0] = {0, 2, 8};
  mesh.triangles.push_back({0, 8, 1});
  EXPECT_EQ(reading(obj(mesh)), "closed, 9 vertices, 14 triangles");
  // A corner twice makes no edge, whichever two they are.
  for (const solid::Triangle& twice : {solid::Triangle{3, 3, 8}, {3, 8, 3}, {8, 3, 3}}) {
    Mesh more = mesh;
    more.triangles.push_back(twice);
    EXPECT_EQ(reading(obj(more)), "closed, 9 vertices, 14 triangles");
  }
  // Nearly flat is not flat: 0.75 + 1e-30 is off the line.
  std::string text = obj(mesh);
  text.replace(text.find("v 0.75 1 0"), 10, "v 0.75 1 1e-30");
  EXPECT_EQ(reading(text), "closed, 9 vertices, 14 triangles");
  EXPECT_EQ(reading("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 2 3\n"), "s: none of its triangles has an area");
}

TEST(SolidReader, TrianglesThatRepeatOthersAreLeftOutUnlessBodiesTouchThere) {
  const auto numbers = [](const Mesh& mesh) {
    const auto read = read_solid({"s", obj(mesh)});
    return closed(read->mesh, "s")->numbers;
  };
  const std::vector<std::uint32_t> twelve{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  for (std::size_t k = 0; k < 12; ++k) {
    // Once more, and so open; twice more; and once more from the other side.
    const solid::Triangle again = cube().triangles[k];
    for (const std::vector<solid::Triangle>& more :
         {std::vector{again}, {again, again}, {{again[1], again[0], again[2]}}}) {
      Mesh mesh = cube();
      mesh.triangles.insert(mesh.triangles.end(), more.begin(), more.end());
      EXPECT_EQ(numbers(mesh), twelve) << k;
    }
    Mesh before = cube();
    before.triangles.insert(before.triangles.begin(), {again[2], again[0], again[1]});
    std::vector<std::uint32_t> left = twelve;
    left.push_back(12);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    EXPECT_EQ(numbers(before), left) << k;
  }
  // A body that is written twice, or from both sides.
  for (const bool turned : {false, true}) {
    Mesh mesh = cube();
    for (solid::Triangle t : cube().triangles) {
      if (turned) std::swap(t[0], t[1]);
      mesh.triangles.push_back(t);
    }
    EXPECT_EQ(numbers(mesh), twelve);
  }
  // Two bodies that have a face in common: it is there twice, from both sides.
  Mesh pair = cube(), other = cube();
  for (solid::Vector& v : other.vertices) v.x = 3 - v.x;
  pair.vertices.insert(pair.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) pair.triangles.push_back({b + 8, a + 8, c + 8});
  EXPECT_EQ(reading(obj(pair)), "closed, 12 vertices, 24 triangles");
  // Where one of them is inside out, nothing closes without both faces.
  for (std::size_t k = 12; k < 24; ++k) std::swap(pair.triangles[k][0], pair.triangles[k][1]);
  EXPECT_EQ(reading(obj(pair)), "closed, 12 vertices, 24 triangles");
}

TEST(SolidReader, WhatIsNotReadIsSaidAndLeftOpen) {
  EXPECT_EQ(reading("ISO-10303-21;\n"), "open: it is none of STL, OBJ, PLY and 3MF");
  EXPECT_EQ(reading(""), "open: it is none of STL, OBJ, PLY and 3MF");
  EXPECT_EQ(reading("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
            "open: the face on line 5 has 4 corners, and only triangles are read");
  EXPECT_EQ(reading("v 0 0 0 2\n"), "open: the vertex on line 1 has a weight");
  EXPECT_EQ(reading("v 0 0 \\\n0\n"), "open: line 1 goes on in the next one");
  EXPECT_EQ(reading("v 0 0 0\nsurf 0 1 0 1\n"), "open: line 2 begins a curved surface");
  EXPECT_EQ(
      reading("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
              "z\nend_header\n0 0 0\n"),
      "open: it has no faces");
  const std::string quad =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face "
      "1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n4 0 0 0 0\n";
  EXPECT_EQ(reading(quad), "open: face 0 has 4 corners, and only triangles are read");
}

TEST(SolidReader, BadFilesGetOneSentenceWithThePlace) {
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  EXPECT_EQ(reading(changed(stl_text(cube()), "vertex 1.5", "vertex nan")),
            "s:6: \"nan\" is not " + decimal_rule());
  EXPECT_EQ(reading(changed(stl_text(cube()), "vertex 1.5", "vertex 1e10")),
            "s:6: the coordinate 10000000000 is not within 1e+09 mm");
  EXPECT_EQ(reading(changed(stl_text(cube()), "endloop", "vertex")),
            "s:7: \"vertex\" where 'endloop' is wanted");
  EXPECT_EQ(reading("solid a\n"), "s:1: \"\" where 'facet' or 'endsolid' is wanted");
  EXPECT_EQ(reading("solid a\nendsolid\n"), "s: there are no triangles in it");
  EXPECT_EQ(reading("v 0 0 0\nf 1 2 1\n"),
            "s:2: \"2\" is not the number of a vertex that stands before this line");
  EXPECT_EQ(reading("v 0 0\n"), "s:1: 2 numbers where x, y and z of a vertex are wanted");
  EXPECT_EQ(reading("v 0 0 0\nf 1 1\n"), "s:2: a face has three corners or more, not 2");
  std::string binary = stl_binary(cube());
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::copy_n(reinterpret_cast<const char*>(&bad), 4, binary.begin() + 84 + 50 + 12);
  EXPECT_EQ(reading(binary), "s: triangle 2: the coordinate nan is not within 1e+09 mm");
  const std::string text = ply<float>(cube(), PlyForm::text), little = ply<float>(cube(), PlyForm::little);
  EXPECT_NE(reading(little.substr(0, little.size() - 6)).find("s: face 11: "), std::string::npos)
      << reading(little.substr(0, little.size() - 6));
  EXPECT_NE(reading(changed(text, "element vertex 8", "element vertex 7")).find("s:"), std::string::npos);
  EXPECT_EQ(reading(changed(text, "format ascii", "format ebcdic")),
            "s:2: this line of the header is not known");
  EXPECT_EQ(reading("ply\nformat ascii 1.0\n"), "s: the header of this PLY does not end");
  EXPECT_EQ(reading(changed(little, "element vertex 8", "element vertex 18446744073709551615")).substr(0, 2),
            "s:");
  EXPECT_EQ(reading(changed(text, "element face 12", "element face 99999999999")).substr(0, 2), "s:");
}

TEST(SolidReader, EveryCutFileIsToldFromAWholeOne) {
  for (const std::string& whole : {stl_text(cube()), stl_binary(cube()), obj(cube()),
                                   ply<float>(cube(), PlyForm::text), ply<double>(cube(), PlyForm::big)})
    for (std::size_t length = 0; length + 8 < whole.size(); ++length)
      EXPECT_NE(reading(whole.substr(0, length)).substr(0, 28), "closed, 8 vertices, 12 trian")
          << length << " of " << whole.size();
}

TEST(SolidReader, FormsThatAreReadToo) {
  const std::string closed = "closed, 8 vertices, 12 triangles";
  std::string loud = stl_text(cube());
  for (char& c : loud)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  EXPECT_EQ(reading(loud), closed);
  EXPECT_EQ(
      reading(stl_text(cases::block({0, 0, 0}, {1, 1, 1})) + stl_text(cases::block({2, 0, 0}, {3, 1, 1}))),
      "closed, 16 vertices, 24 triangles");
  const std::string tetrahedron = "f 1 3 2\nf 1 2 4\nfo 2 3 4\nf 3 1 4\n";
  EXPECT_EQ(reading("# solid\n\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv\t0 1 0 1 0.5 0.5 0.5\nv 0 0 1 1.0\n" +
                    tetrahedron),
            "closed, 4 vertices, 4 triangles");
  // Whole numbers of each kind, negative ones too; what nobody asked for need not be a number.
  for (const auto& [type, bytes] :
       {std::pair("char", 1U), {"int8", 1U}, {"short", 2U}, {"int16", 2U}, {"int", 4U}, {"int32", 4U}}) {
    std::string ply = fmt::format(
        "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty {0} x\nproperty {0} y\nproperty {0} "
        "z\n"
        "element face 4\nproperty list uint16 {0} vertex_index\nend_header\n",
        type);
    const auto put = [&](int value, unsigned size) {
      for (unsigned k = size; k-- > 0;) ply += static_cast<char>(value >> (8 * k));
    };
    for (const int c : {-1, -2, -3, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(c, bytes);
    for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      put(3, 2);
      for (const int c : face) put(c, bytes);
    }
    EXPECT_EQ(reading(ply), "closed, 4 vertices, 4 triangles") << type;
    const auto read = read_solid({"s", ply});
    EXPECT_EQ(read->mesh.near[0], (std::array<double, 3>{-1, -2, -3})) << type;
  }
  const std::string text = ply<float>(cube(), PlyForm::text);
  std::string unread = text;
  while (unread.find(" 0.25\n") != std::string::npos) unread.replace(unread.find(" 0.25\n"), 6, " nan\n");
  EXPECT_EQ(reading(unread), closed);
}

TEST(SolidReader, NumbersOfVerticesAreInRange) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* const wrong : {"0", "4", "-4", "1x", "1/a", "99999999999999999999"})
    EXPECT_NE(reading(three + "f 1 2 " + wrong + "\n").find("is not the number of a vertex"),
              std::string::npos)
        << wrong;
  EXPECT_EQ(reading("v 0 0 0 1 1\n"), "s:1: 5 numbers where x, y and z of a vertex are wanted");
  EXPECT_EQ(reading("v 0 0 0 1 1 1 1 1\n"), "s:1: 8 numbers where x, y and z of a vertex are wanted");
  const auto ply_face = [](const std::string& corners) {
    return reading(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face "
        "1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
        corners + "\n");
  };
  EXPECT_EQ(ply_face("3 0 1 3"), "s: a face names the vertex 3 of 3, numbered from 0");
  EXPECT_EQ(ply_face("3 0 1 2").find("s: the surface is open"), 0u);
  for (const char* const wrong : {"3 0 1 -1", "3 0 1 0.5", "3 0 1 4294967296", "3 0 1 a"})
    EXPECT_EQ(ply_face(wrong), "s:13: a corner is not the number of a vertex") << wrong;
  EXPECT_EQ(ply_face("2 0 1"), "s:13: a face has three corners or more, not 2");
  EXPECT_EQ(ply_face("-1"), "s:13: the row ends early, or has a list without a length");
  EXPECT_EQ(ply_face("3 0 1"), "s:13: a list ends early");
  EXPECT_EQ(ply_face("3 0 1 2 0"), "s:13: the row has more numbers than it should");
}

TEST(SolidReader, HeadersThatSayTwoThingsAreRefused) {
  const std::string unknown = "this line of the header is not known";
  const std::string begin = "ply\nformat ascii 1.0\n";
  for (const char* const line :
       {"format ascii 1.0", "property float x", "element vertex", "element vertex 1x",
        "element vertex 1\nelement vertex 1", "element a 1\nproperty float128 x",
        "element a 1\nproperty list float int x", "element a 1\nproperty list no int x",
        "element a 1\nproperty float x\nproperty float x", "word"})
    EXPECT_NE(reading(begin + line + "\nend_header\n").find(unknown), std::string::npos) << line;
  EXPECT_EQ(reading("ply\nend_header\n"), "s: the header of this PLY does not say its format");
  EXPECT_EQ(reading(begin + "element vertex 1\nend_header\n"),
            "s: the vertices of this PLY have no x, y and z");
  EXPECT_EQ(reading(begin + "element face 1\nproperty int a\nend_header\n1\n"),
            "s: the faces of this PLY have no vertex_indices");
  EXPECT_EQ(reading(begin + "element a 1\nend_header\n"), "s: the element a has no properties");
  EXPECT_EQ(reading(begin + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n1 0\n"),
            "open: it has strips of triangles");
  for (const char* const word : {"surf", "bzp", "bsp", "cdp"})
    EXPECT_EQ(reading(fmt::format("v 0 0 0\n{} 1\n", word)), "open: line 2 begins a curved surface");
}

TEST(SolidReader, ChangedBytesAreReadOrGetOneSentence) {
  Random random(11);
  for (const std::string& whole : {stl_text(cube()), stl_binary(cube()), obj(cube()),
                                   ply<float>(cube(), PlyForm::text), ply<double>(cube(), PlyForm::little)})
    for (int n = 0; n < 400; ++n) {
      std::string bytes = whole;
      for (std::uint64_t k = 0; k <= random.below(3); ++k) {
        const std::size_t at = random.below(bytes.size());
        switch (random.below(4)) {
          case 0:
            bytes[at] = static_cast<char>(random.below(256));
            break;
          case 1:
            bytes[at] = static_cast<char>('0' + random.below(10));
            break;
          case 2:
            bytes.erase(at, random.below(40));
            break;
          default:
            bytes.insert(at, bytes.substr(random.below(bytes.size()), random.below(40)));
        }
        bytes += ' ';
      }
      const std::string said = reading(bytes);
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      EXPECT_TRUE(said.starts_with("closed") || said.starts_with("open: ") || said.starts_with("s:")) << said;
    }
}

TEST(SolidGrowth, TwiceTheFileCostsTwiceTheTime) {
  const auto seconds = [](std::uint32_t around, auto&& write) {
    Random random(3);
    const std::string bytes = write(cases::ring(random, around, 10, 50, 10));
    double least = 1e9;
    for (int k = 0; k < 3; ++k) {
      const cases::Stopwatch watch;
      const auto read = read_solid({"s", bytes});
      EXPECT_TRUE(read && closed(read->mesh, "s"));
      least = std::min(least, watch.seconds());
    }
    return least;
  };
  const auto check = [&](auto&& write) { EXPECT_LT(seconds(300, write), 3 * seconds(150, write) + 0.02); };
  check([](const Mesh& mesh) { return stl_text(mesh); });
  check([](const Mesh& mesh) { return stl_binary(mesh); });
  check([](const Mesh& mesh) { return obj(mesh); });
  check([](const Mesh& mesh) { return ply<double>(mesh, PlyForm::text); });
  check([](const Mesh& mesh) { return ply<float>(mesh, PlyForm::little); });
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_file_test
