#include "lekalo/io/solid/solid_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "support/solid_files.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::io::io_solid_test {
namespace {

using namespace std::string_literals;
using solid::Mesh;
using solid::Vector;

const Mesh& block() {
  static const Mesh mesh = cases::block({0, 0, 0}, {10, 20, 30});
  return mesh;
}

SolidFile parsed(const std::string& bytes, const SolidOptions& options = {SolidUnit::millimetre}) {
  auto file = parse_solid(bytes, "a", options);
  EXPECT_TRUE(file) << file.error().message;
  return file ? *std::move(file) : SolidFile{};
}

std::string facet(const std::string& corners) {
  return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
}
const std::string kFacet = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
const std::string kCorners = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n";

TEST(SolidKind, IsToldByContentAndNeverByTheNameAlone) {
  const std::string binary = solid_files::stl_binary(block());
  std::string longer = binary;
  longer[83] = 1;  // says that it has many more triangles
  struct Kind {
    const char* title;
    std::string bytes;
    const FileFormat* format;
  };
  const std::vector<Kind> all{
      {"text", solid_files::stl_text(block()), &kStlFormat},
      {"text in capitals, behind a mark", "\xef\xbb\xbf  SOLID\r\n FACET NORMAL 0 0 1", &kStlFormat},
      {"nothing in it", "solid\nendsolid\n", &kStlFormat},
      {"binary that begins with the word", binary, &kStlFormat},
      {"binary with another header", solid_files::stl_binary(block(), "ISO-10303-21 OFF"), &kStlFormat},
      {"binary of another length that begins with the word", longer, &kStlFormat},
      {"the word alone", "solid gold is dear\nand heavy\n", nullptr},
      {"OBJ", solid_files::obj(block()), &kObjFormat},
      {"OBJ with what is passed over first", "# c\n\nmtllib a\ng x\nvn 0 0 1\nv 1 2 3\n", &kObjFormat},
      {"v is no vertex", "v one two\n", nullptr},
      {"PLY", "ply\r\nformat ascii 1.0\r\n", &kPlyFormat},
      {"points", "1 2 3\n", &kPointsFormat},
      {"points behind a header", "# scan\nx;y;z\n1;2;-3e1\n", &kPointsFormat},
      {"points in the plane", "1 2\n3 4\n", nullptr},
      {"points with directions", "1 2 3 0 0 1\n", &kPointsFormat},
      {"a drawing", "0\nSECTION\n2\nHEADER\n", nullptr},
      {"JSON", "{\"points\": [[0, 0]]}", nullptr},
      {"STEP", "ISO-10303-21;\nHEADER;\n", nullptr},
      {"nothing", "", nullptr},
  };
  for (const Kind& kind : all) EXPECT_EQ(solid_format_by_content(kind.bytes), kind.format) << kind.title;
}

TEST(SolidStl, HasTheNamesOfItsSolids) {
  const SolidFile file = parsed("solid  left one \n" + kFacet + "endsolid left one\nsolid right\n" + kFacet +
                                kFacet + "endsolid\nsolid left one\n" + kFacet + "endsolid");
  EXPECT_EQ(file.mesh.triangles.size(), 4u);
  EXPECT_EQ(file.mesh.vertices.size(), 12u);
  EXPECT_EQ(file.groups, (std::vector<std::string>{"left one", "right"}));
  EXPECT_EQ(file.group_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 0}));
  const SolidFile unnamed = parsed("solid\n" + kFacet + "endsolid\n");
  EXPECT_TRUE(unnamed.groups.empty() && unnamed.group_of_triangle.empty());
}

TEST(SolidStl, NormalsAreNotRead) {
  const SolidFile file = parsed(
      "solid a\nfacet normal -nan(ind) inf x outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
      "endfacet "
      "endsolid\n");
  EXPECT_EQ(file.mesh.triangles.size(), 1u);
}

TEST(SolidObj, FacesAreCutTheSameWayWhateverTheirIndicesLookLike) {
  for (const char* const face :
       {"f 1 2 3 4\n", "f -4 -3 -2 -1\n", "f 1/1 2/2/2 3//3 4/\n", "f 1 2 \\\n 3 4 # c\n"}) {
    const SolidFile file = parsed(kCorners + face);
    EXPECT_EQ(file.mesh.triangles, (std::vector<solid::Triangle>{{0, 1, 2}, {0, 2, 3}})) << face;
    ASSERT_EQ(file.notices.size(), 1u);
    EXPECT_EQ(
        file.notices[0],
        "a: 1 face of more than three corners is cut into triangles; corners lie up to 0 mm off a plane");
  }
  // The dent is the third corner, so that no fan from the first would do.
  const SolidFile dent = parsed("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nv 9 9 9\nf 4 1 2 3\n");
  EXPECT_EQ(dent.mesh.triangles.size(), 2u);
  for (const solid::Triangle& t : dent.mesh.triangles)
    EXPECT_NE(std::find(t.begin(), t.end(), 2u), t.end()) << "the dent is a corner of both";
  const SolidFile bent = parsed("v 0 0 0\nv 4 0 0\nv 4 4 0.4\nv 0 4 0\nf 1 2 3 4\n");
  EXPECT_NE(bent.notices.at(0).find("corners lie up to 0.1 mm off a plane"), std::string::npos)
      << bent.notices[0];
}

TEST(SolidObj, GroupsNameTheFacesThatFollow) {
  const SolidFile file =
      parsed(kCorners + "f 1 2 3\ng top side\nf 1 2 3 4\no body\nf 1 3 4\ng top side\nf 1 2 4\n");
  EXPECT_EQ(file.groups, (std::vector<std::string>{"", "top side", "body"}));
  EXPECT_EQ(file.group_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 2, 1}));
}

TEST(SolidObj, WhatIsNotReadIsTold) {
  const SolidFile file =
      parsed(kCorners + "usemtl a\nvt 0 0\ns off\nl 1 2\np 1\nwibble 1\nf 1 2 3\nwobble \\\n v 1 2 3\n");
  EXPECT_EQ(file.notices, (std::vector<std::string>{
                              "a: 2 lines and points are not read",
                              "a: 2 lines begin with words that are unknown, the first 'wibble' on line 10; "
                              "they are not read"}));
  EXPECT_EQ(file.mesh.vertices.size(), 4u);
}

TEST(SolidObj, AColourMayStandBehindAVertex) {
  const SolidFile file = parsed("v 1 2 3 0.5 0.5 1\nv 1 0 0 1\nv 0 0 1 1 1 1 1\nf 1 2 3\n");
  EXPECT_EQ(file.mesh.vertices, (std::vector<Vector>{{1, 2, 3}, {1, 0, 0}, {0, 0, 1}}));
}

TEST(SolidPly, WithoutFacesItHoldsPoints) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty uchar y\nproperty int z\n";
  for (const char* const faces : {"", "element face 0\nproperty list uchar int vertex_index\n"}) {
    const SolidFile file = parsed(head + faces + "end_header\n0.5 7 -3\n1 2 3\n");
    EXPECT_EQ(file.mesh.vertices, (std::vector<Vector>{{0.5, 7, -3}, {1, 2, 3}}));
    EXPECT_TRUE(file.mesh.triangles.empty());
  }
}

TEST(SolidDeviation, IsThatOfAMeshOfAStepFile) {
  const auto with = [](const std::string& comments) {
    std::string bytes = solid_files::ply<double>(block(), solid_files::PlyForm::little);
    return bytes.replace(bytes.find("comment made by a test\n"), 23, comments);
  };
  const std::string made = "comment lekalo-step 1\n";
  const SolidFile file = parsed(with(made + "comment units mm\ncomment deviation 1.25e-2\n"), {});
  EXPECT_EQ(file.deviation, 0.0125);
  for (const std::string& notice : file.notices) EXPECT_EQ(notice.find("unit"), std::string::npos) << notice;
  EXPECT_FALSE(parsed(with("comment deviation 1\n")).deviation);
  EXPECT_FALSE(parsed(with("comment other\n" + made + "comment deviation 1\n")).deviation);
  const auto refusal = [](const std::string& bytes, const SolidOptions& options = {}) {
    const auto parsed = parse_solid(bytes, "a", options);
    return parsed ? std::string() : parsed.error().message;
  };
  EXPECT_EQ(refusal(with(made)), "a: lekalo-step made it, but its header has no deviation; make it again");
  EXPECT_EQ(refusal(with(made + "comment deviation -1\n")), "a: the deviation -1 is below 0");
  EXPECT_EQ(refusal(with(made + "comment deviation much\n")).find("a: deviation: "), 0u);
  EXPECT_EQ(refusal(with(made + "comment deviation 1\n"), {SolidUnit::inch}),
            "a: lekalo-step made it in mm; leave --units out, or give the other file in mm, too");
}

TEST(SolidDeviation, ComesWithFacesAndTheirNames) {
  const std::vector<std::uint32_t> face_of{0, 0, 1, 1, 2, 2, 3, 3, 1, 1, 5, 5};
  const std::string text = solid_files::step_mesh(block(), "0.5", face_of, {"", "a b", "a b", "", "", "c"});
  const SolidFile file = parsed(text, {});
  EXPECT_EQ(file.face_of_triangle, face_of);
  std::vector<std::string> names;
  for (const std::uint32_t group : file.group_of_triangle) names.push_back(file.groups[group]);
  EXPECT_EQ(names,
            (std::vector<std::string>{"", "", "a b", "a b", "a b", "a b", "", "", "a b", "a b", "c", "c"}));
  // Of another maker they mean nothing.
  std::string other = text;
  other.replace(other.find("lekalo-step"), 11, "elsewhere..");
  EXPECT_TRUE(parsed(other).face_of_triangle.empty());
  EXPECT_TRUE(parsed(other).groups.empty());
  std::string wrong = text;
  wrong.replace(wrong.find(" 5\n"), 3, " x\n");
  const auto refused = parse_solid(wrong, "a", {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("its face is not a whole number from 0"), std::string::npos);
}

TEST(SolidUnits, AreMillimetresUnlessSizesSuggestSomethingElse) {
  const auto notice = [](const Mesh& mesh) {
    const SolidFile file = parsed(solid_files::obj(mesh), {});
    return file.notices.empty() ? "" : file.notices.back();
  };
  const std::string plain = "a: the file does not say its unit; it is read as mm";
  EXPECT_EQ(notice(block()), plain);
  EXPECT_EQ(notice(cases::block({0, 0, 0}, {2.25, 4, 0.5})),
            plain + "; its sizes suggest inches: --units inch reads it so");
  EXPECT_EQ(notice(cases::block({0, 0, 0}, {0.21, 0.33, 0.1})),
            plain + "; it is 0.33 mm long, and its sizes suggest metres: --units m reads it so");
  for (const SolidUnit unit : {SolidUnit::millimetre, SolidUnit::inch, SolidUnit::metre})
    EXPECT_TRUE(parsed(solid_files::obj(cases::block({0, 0, 0}, {0.21, 0.33, 0.1})), {unit}).notices.empty());
  EXPECT_EQ(parsed(solid_files::points({{1, 2, 3}, {0.5, 0, 0}}), {SolidUnit::metre}).mesh.vertices[1].x,
            500);
  EXPECT_EQ(parsed(solid_files::stl_binary(block()), {SolidUnit::inch}).mesh.vertices[1].y, 508);
}

struct Bad {
  const char* title;
  const char* name;
  std::string bytes;
  std::string says;  ///< the whole sentence behind the name
};

std::string with_count(std::string stl, std::uint32_t count) {
  for (std::size_t i = 0; i < 4; ++i) stl[80 + i] = static_cast<char>(count >> (8 * i) & 255);
  return stl;
}

std::string ply_head(const std::string& elements, const char* form = "ascii") {
  return "ply\nformat "s + form + " 1.0\n" + elements + "end_header\n";
}

std::string star(std::size_t corners) {
  std::string text, face = "f";
  for (std::size_t k = 0; k < corners; ++k) {
    text += fmt::format("v {} {} 0\n", k, k % 2 == 0 ? k * k : k * k + 7);
    face += fmt::format(" {}", k + 1);
  }
  return text + face + "\n";
}

TEST(SolidRefusal, EveryBadFileGivesOneSentenceWithItsPlaceAndTheWayOut) {
  const std::string binary = solid_files::stl_binary(block());
  std::string nan = binary;
  nan.replace(84 + 50 * 3 + 12 + 12 + 8, 4, "\0\0\xc0\x7f"s);
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string one = "element vertex 1\n" + xyz, three = "element vertex 3\n" + xyz;
  const std::string list = "property list uchar int vertex_indices\n";
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string iges = std::string(72, ' ') + "S      1\n";
  const std::string not_a_solid =
      "this is no solid that can be read; STL, PLY, OBJ, 3MF and points in text 'x y z' are";
  const std::string export_it = "; export it as STL, PLY or OBJ from the program that it comes from";
  const std::vector<Bad> all{
      // other kinds
      {"STEP", "a.stp", "ISO-10303-21;\n",
       "this is a STEP model; make a mesh of it that says how far it is from the model at most: lekalo-step "
       "FILE "
       "-o FILE.ply (tools/setup.sh --step installs what that program needs)"},
      {"IGES", "a.igs", iges, "this is an IGES model" + export_it},
      {"OFF", "a.off", "OFF\n8 6 12\n0 0 0\n", "this is an OFF model" + export_it},
      {"gzip", "a.stl", "\x1f\x8b\x08", "this file is compressed by gzip; unpack it first: gunzip, or 7-Zip"},
      {"3MF", "a.3mf", "PK\x03\x04....3D/3dmodel.model",
       "there is no directory at the end of this ZIP archive; it is cut off or damaged, export or copy it "
       "again"},
      {"ZIP", "a.zip", "PK\x03\x04....part.stl",
       "this is a ZIP archive; unpack it first, and give the model in it"},
      {"something else", "a.json", "{}", not_a_solid},
      {"empty", "a", "", not_a_solid},
      // STL
      {"too long", "a.stl", with_count(binary, 11),
       "this binary STL says 11 triangles, which take 634 bytes, but has 684 bytes (12 triangles); it is "
       "damaged or no STL, export it again"},
      {"a count from nowhere", "a.stl", with_count(binary, 0xffffffffU),
       "this binary STL says 4294967295 triangles, which take 214748364834 bytes, but has 684 bytes (12 "
       "triangles); it is damaged or no STL, export it again"},
      {"cut off", "a", binary.substr(0, 600),
       "this binary STL says 12 triangles, which take 684 bytes, but has 600 bytes (10.32 triangles); it is "
       "damaged or no STL, export it again"},
      {"hardly a header", "a.stl", "\0\0\0"s,
       "the file ends after 3 bytes; a binary STL has 84 before its triangles"},
      {"no triangles, binary", "a.stl", with_count(binary, 0).substr(0, 84),
       "there are no triangles in this STL; export it again"},
      {"decimal commas", "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0 0\n",
       "line 4: '0,5' is not a number; write numbers with a point, not a comma, before their decimals"},
      {"no triangles, text", "a.stl", "solid a\nendsolid a\n",
       "there are no triangles in this STL; export it again"},
      {"binary nan", "a.stl", nan, "triangle 4 (byte 266): nan is not a finite number up to 1e+09 mm"},
      {"no solid", "a.stl", "hello world\n", "line 1: 'hello' where 'solid' is wanted"},
      {"text cut off", "a.stl", "solid a\n" + kFacet,
       "the file ends within its solid, in triangle 2; it is cut off, export it again"},
      {"text cut off in a number", "a.stl", "solid a\n" + kFacet + "facet normal 0 0 0\nouter loop\nvertex 1",
       "the file ends within its solid, in triangle 2; it is cut off, export it again"},
      {"text nan", "a.stl", "solid a\n" + facet("vertex 0 0 0\nvertex 1 nan 0\n"),
       "line 5: 'nan' is not a finite number"},
      {"four corners", "a.stl",
       "solid a\n" + facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 1 1\n"),
       "line 7: 'vertex' where 'endloop' is wanted"},
      {"something between facets", "a.stl", "solid a\nfacet normal 0 0 0\nouter loops\n",
       "line 3: 'loops' where 'loop' is wanted"},
      {"behind the end", "a.stl", "solid a\n" + kFacet + "endsolid a\nfacet\n",
       "line 10: 'facet' where 'solid' is wanted"},
      {"zero bytes", "a.stl", "solid a\n" + kFacet + std::string(600, ' ') + '\0',
       "this is not a text file, it holds zero bytes"},
      // OBJ
      {"out of range", "a.obj", kCorners + "f 1 2 5\n",
       "line 5: vertex 5 is not there: 4 vertices stand before this line, numbered from 1"},
      {"negative out of range", "a.obj", "v 0 0 0\nf -1 -2 1\n",
       "line 2: vertex -2 is not there: 1 vertex stands before this line, numbered from 1"},
      {"zero", "a.obj", kCorners + "f 0 1 2\n",
       "line 5: vertex 0 is not there: 4 vertices stand before this line, numbered from 1"},
      {"a word", "a.obj", kCorners + "f 1 2 c\n",
       "line 5: 'c' is not the number of a vertex, as 7, -1 or 7/2/3"},
      {"a huge number", "a.obj", kCorners + "f 1 2 99999999999999999999\n",
       "line 5: '99999999999999999999' is not the number of a vertex, as 7, -1 or 7/2/3"},
      {"two corners", "a.obj", kCorners + "f 1 2\n", "line 5: a face has three corners or more, not 2"},
      {"two numbers", "a.obj", "v 1 2 3\nv 1 2\n",
       "line 2: 2 numbers where x, y and z of a vertex are wanted"},
      {"infinity", "a.obj", "v 1 2 3\nv 1 -inf 3\n", "line 2: '-inf' is not a finite number"},
      {"too large", "a.obj", "v 1 2 3\nv 1 2e9 3\n",
       "line 2: '2e9' is out of range: coordinates go up to 1e+09 mm"},
      {"a weight", "a.obj", "v 1 2 3 0.5\n",
       "line 1: the vertex has the weight 0.5; only 1 means a point, export a mesh"},
      {"a curved surface", "a.obj", kCorners + "surf 0 1 0 1 1 2 3 4\n",
       "line 5: 'surf' is a curved surface, of which only triangles are read; export a mesh"},
      {"crossing itself", "a.obj", kCorners + "f 1 2 4 3\n",
       "line 5: a face that crosses or touches itself; cut it into triangles"},
      {"many corners and dents", "a.obj", star(2001),
       "line 2002: a face of 2001 corners that is not convex; cut it into triangles, or into faces of at "
       "most 2000"},
      {"no faces", "a.obj", kCorners,
       "there are no faces in this OBJ; points are read from PLY and from text 'x y z'"},
      {"no vertices", "a.obj", "# nothing\n", "there are no vertices in this OBJ"},
      // PLY
      {"no ply", "a.ply", "plyer\n", "this is no PLY file: the first line is not 'ply'"},
      {"no vertices declared", "a.ply", ply_head("element face 1\n" + list) + "3 0 1 2\n",
       "there is no element vertex in this PLY"},
      {"no vertices there", "a.ply", ply_head("element vertex 0\n" + xyz),
       "there are no vertices in this PLY"},
      {"no z", "a.ply", ply_head("element vertex 1\nproperty int x\nproperty int y\n") + "1 2\n",
       "the vertices of this PLY have no property z"},
      {"x is a list", "a.ply",
       ply_head("element vertex 1\nproperty list uchar int x\nproperty int y\nproperty int z\n"),
       "the property x of the vertices is a list"},
      {"too many", "a.ply", ply_head("element vertex 20000001\n" + xyz),
       "more than 20000000 vertices; thin the mesh or the scan out first"},
      {"too many faces", "a.ply", ply_head(three + "element face 20000001\n" + list) + rows,
       "more than 20000000 triangles; thin the mesh out first"},
      {"strips", "a.ply", ply_head(three + "element tristrips 1\n" + list) + rows + "3 0 1 2\n",
       "this PLY has strips of triangles, which are not read; save it with faces"},
      {"faces of something else", "a.ply",
       ply_head(three + "element face 1\nproperty int a\n") + rows + "1\n",
       "the faces of this PLY have no list vertex_indices"},
      {"indices of floats", "a.ply",
       ply_head(three + "element face 1\nproperty list uchar float vertex_index\n") + rows + "3 0 1 2\n",
       "the items of the list 'vertex_index' are no whole numbers"},
      {"text nan", "a.ply", ply_head(one) + "0 nan 0\n", "line 8: 'nan' is not a finite number"},
      {"too few numbers", "a.ply", ply_head(one) + "0 0\n", "line 8: 2 numbers where a vertex has 3"},
      {"index out of range", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "3 0 1 3\n",
       "line 13: vertex 3 is not there: the file has 3 vertices, numbered from 0"},
      {"negative index, binary", "a.ply",
       ply_head(one + "element face 1\n" + list, "binary_little_endian") + std::string(12, '\0') +
           "\3\0\0\0\0\0\0\0\0\xff\xff\xff\xff"s,
       "face 0: vertex -1 is not there: the file has 1 vertex, numbered from 0"},
      {"index no number", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "3 0 1 2.0\n",
       "line 13: '2.0' is not a whole number"},
      {"a short list", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "3 0 1\n",
       "line 13: fewer numbers than the lists of this row of the element 'face' have"},
      {"a long list", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "3 0 1 2 0\n",
       "line 13: more numbers than the lists of this row of the element 'face' have"},
      {"a count that is a word", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "x 0 1 2\n",
       "line 13: 'x' where the number of items of the list 'vertex_indices' is wanted"},
      {"two corners", "a.ply", ply_head(three + "element face 1\n" + list) + rows + "2 0 1\n",
       "line 13: a face has three corners or more, not 2"},
      {"rows missing", "a.ply", ply_head(three) + "0 0 0\n",
       "the file ends in row 1 of 3 of the element 'vertex'"},
      {"a count from nowhere, binary", "a.ply",
       ply_head("element vertex 19999999\n" + xyz, "binary_big_endian") + std::string(13, '\0'),
       "the file ends in row 1 of 19999999 of the element 'vertex'"},
      {"infinite, binary", "a.ply", ply_head(one, "binary_big_endian") + "\x7f\x80\0\0\0\0\0\0\0\0\0\0"s,
       "vertex 0: inf is not a finite number up to 1e+09 mm"},
      {"a face that crosses itself", "a.ply",
       ply_head("element vertex 4\n" + xyz + "element face 1\n" + list) +
           "0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n",
       "face 0: a face that crosses or touches itself; cut it into triangles"},
      // points
      {"two numbers", "a.xyz", "1 2 3\n1 2\n",
       "line 2: two numbers where x, y and z (or those and a direction nx, ny, nz) are wanted: '1 2'"},
      {"four numbers", "a.xyz", "1 2 3 4\n",
       "line 1: 4 numbers where x, y and z (or those and a direction nx, ny, nz) are wanted: '1 2 3 4'"},
      {"a direction that leads nowhere", "a.xyz", "1 2 3 0 0 2\n1 2 3 0 0 0\n",
       "line 2: the direction 0 0 0 has no length, so it leads nowhere"},
      {"a point without direction", "a.xyz", "1 2 3 0 0 2\n1 2 3\n",
       "line 2: 3 numbers where the lines before have 6: give all touches a direction, or none"},
      {"decimal commas, maybe", "a.csv", "1,5,2,5,3,5\n",
       "line 1: '1,5,2,5,3,5' may have decimal commas; put semicolons between the numbers, and decimal "
       "points in "
       "them, as in 12.5"},
      {"point nan", "a.xyz", "1 2 3\n1 NaN 3\n", "line 2: 'NaN' is not a finite number"},
      {"no points", "a.csv", "x,y,z\n", "there are no points in this file"},
      {"UTF-16", "a.txt",
       "\xff\xfe"
       "1\0 \0"s,
       "this is text in UTF-16; save it as UTF-8 (or plain ASCII)"},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.title);
    const auto file = parse_solid(bad.bytes, bad.name);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::bad_input);
    EXPECT_EQ(file.error().message, bad.name + ": "s + bad.says);
  }
}

TEST(SolidGrowth, TwiceTheFileCostsTwiceTheTime) {
  const auto seconds = [](const std::string& bytes) {
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
      const cases::Stopwatch watch;
      EXPECT_TRUE(parse_solid(bytes, "a")) << parse_solid(bytes, "a").error().message;
      least = std::min(least, watch.seconds());
    }
    return least;
  };
  const auto wavy = [](std::size_t size) {
    Random random(1);
    return cases::ring(random, static_cast<std::uint32_t>(size), 100, 50, 3);
  };
  const auto dents = [](std::size_t faces) {
    std::string text = star(500);
    const std::string face = text.substr(text.find('f'));
    for (std::size_t k = 1; k < faces; ++k) text += face;
    return text;
  };
  const auto groups = [](std::size_t count) {
    std::string text = kCorners;
    for (std::size_t k = 0; k < count; ++k) text += fmt::format("g part {}\nf 1 2 3 4\n", k);
    return text;
  };
  const auto wide = [](std::size_t corners) {  // one convex face
    std::string text, face = "f";
    for (std::size_t k = 0; k < corners; ++k) {
      text += fmt::format("v {} {} 0\n", k, k * k);
      face += fmt::format(" {}", k + 1);
    }
    return text + face + "\n";
  };
  const std::vector<std::pair<const char*, std::function<std::string(std::size_t)>>> families{
      {"STL text", [&](std::size_t n) { return solid_files::stl_text(wavy(n)); }},
      {"STL binary", [&](std::size_t n) { return solid_files::stl_binary(wavy(8 * n)); }},
      {"OBJ", [&](std::size_t n) { return solid_files::obj(wavy(n)); }},
      {"PLY text",
       [&](std::size_t n) { return solid_files::ply<double>(wavy(n), solid_files::PlyForm::text); }},
      {"PLY binary",
       [&](std::size_t n) { return solid_files::ply<float>(wavy(4 * n), solid_files::PlyForm::big); }},
      {"faces with dents", dents},
      {"groups", [&](std::size_t n) { return groups(100 * n); }},
      {"one wide face", [&](std::size_t n) { return wide(100 * n); }},
  };
  constexpr std::size_t kSize = 50;
  for (const auto& [title, make] : families) {
    double first = 1e9, second = 1e9;
    // Tens of milliseconds are a matter of chance; what really grows faster does so every time.
    for (int attempt = 0; attempt < 4 && !(second < 2.5 * std::max(first, 0.02)); ++attempt)
      first = std::min(first, seconds(make(kSize))), second = std::min(second, seconds(make(2 * kSize)));
    EXPECT_LT(second, 2.5 * std::max(first, 0.02)) << title << ": " << first << " s, " << second << " s";
  }
}

}  // namespace
}  // namespace lekalo::io::io_solid_test
