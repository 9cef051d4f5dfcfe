// 3MF files: archives of any form, bodies of the build put together, and what is refused or told.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lekalo/io/solid/solid_file.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"
#include "support/three_mf_files.hpp"

namespace lekalo::io::io_three_mf_test {
namespace {

using namespace three_mf_files;
using solid::Mesh;
using solid::Vector;

const Mesh& block() {
  static const Mesh made = cases::block({0, 0, 0}, {10, 20, 30});
  return made;
}
std::string one_block() { return model(object(1, mesh(block()), "name=\"part\""), item(1)); }

SolidFile parsed(const std::string& bytes, const SolidOptions& options = {}) {
  auto file = parse_solid(bytes, "a.3mf", options);
  EXPECT_TRUE(file) << file.error().message;
  return file ? *std::move(file) : SolidFile{};
}
std::string fault(const std::string& bytes, const SolidOptions& options = {}) {
  const auto file = parse_solid(bytes, "a", options);
  EXPECT_TRUE(file || file.error().code == ErrorCode::bad_input);
  return file ? "read" : file.error().message;
}
void expect_block(const SolidFile& file, const char* title) {
  EXPECT_EQ(file.mesh.vertices, block().vertices) << title;
  EXPECT_EQ(file.mesh.triangles, block().triangles) << title;
  EXPECT_EQ(file.coordinate_error, 0) << title;
}

TEST(ThreeMf, EveryWayOfPackingGivesTheSameBody) {
  for (const ZipForm form : kZipForms)
    expect_block(parsed(archive(one_block(), {}, form)), "a form of the ZIP");
  const std::string rels = relations();
  const std::string core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
  struct Way {
    const char* title;
    std::string bytes;
  };
  for (const Way& way : std::vector<Way>{
           {"stored", zip({{"_rels/.rels", rels, false}, {"3D/3dmodel.model", one_block(), false}})},
           {"the model first, and a comment", zip({{"3D/3dmodel.model", one_block()}, {"_rels/.rels", rels}},
                                                  ZipForm::plain, "made by PK\5\6")},
           {"a folder, another case, and a leading slash",
            zip({{"3D/", "", false}, {"/_rels/.RELS", rels}, {"3d/3DModel.Model", one_block()}})},
           {"another place",
            zip({{"_rels/.rels", relations("Part/a.model")}, {"Part/a.model", one_block()}})},
           {"a byte order mark", archive("\xef\xbb\xbf" + one_block())},
           {"a prefix",
            archive(fmt::format("<c:model xmlns:c=\"{}\"><c:resources><c:object id=\"7\">{}</c:object>"
                                "</c:resources><c:build><c:item objectid=\"7\"/></c:build></c:model>",
                                core, mesh(block(), "c:")))},
           {"single quotes and entities",
            archive(fmt::format("<model xmlns='{}'><resources><object id='&#49;'>{}</object></resources>"
                                "<build><item objectid='1'/></build></model>",
                                core, mesh(block())))}})
    expect_block(parsed(way.bytes), way.title);
  const SolidFile file = parsed(archive(one_block()));
  EXPECT_EQ(file.format, "3MF");
  EXPECT_EQ(file.groups, std::vector<std::string>{"part"});
  EXPECT_EQ(file.unit, SolidUnit::millimetre);
  EXPECT_TRUE(file.notices.empty()) << file.notices.front();
}

TEST(ThreeMf, IsToldByItsContent) {
  EXPECT_EQ(solid_format_by_content(archive(block())), &kThreeMfFormat);
  EXPECT_TRUE(is_only_solid(archive(block()), "a.zip"));
  EXPECT_TRUE(is_only_solid("PK", "a.3mf"));
  EXPECT_EQ(solid_format_by_content(zip({{"part.stl", "solid"}})), nullptr);
}

TEST(ThreeMf, TheUnitIsTheFilesOwn) {
  const Mesh corner = cases::block({0, 0, 0}, {1, 2, 4});
  for (const auto& [word, unit, factor] :
       std::vector<std::tuple<const char*, SolidUnit, double>>{{"micron", SolidUnit::micron, 0.001},
                                                               {"millimeter", SolidUnit::millimetre, 1},
                                                               {"centimeter", SolidUnit::centimetre, 10},
                                                               {"inch", SolidUnit::inch, 25.4},
                                                               {"foot", SolidUnit::foot, 304.8},
                                                               {"meter", SolidUnit::metre, 1000}}) {
    const SolidFile file = parsed(archive(model(object(1, mesh(corner)), item(1, "1 0 0 0 1 0 0 0 1 2 0 0"),
                                                fmt::format("unit=\"{}\"", word))));
    EXPECT_EQ(file.unit, unit) << word;
    EXPECT_EQ(box_of(file.mesh.vertices).low, (Vector{2 * factor, 0, 0})) << word;
    EXPECT_NEAR(box_of(file.mesh.vertices).high.z, 4 * factor, 4e-13 * factor) << word;
  }
  EXPECT_EQ(parsed(archive(model(object(1, mesh(corner)), item(1), ""))).unit, SolidUnit::millimetre);
  EXPECT_EQ(parsed(archive(block()), {SolidUnit::millimetre}).unit, SolidUnit::millimetre);
  EXPECT_EQ(
      fault(archive(block()), {SolidUnit::inch}),
      "a: '3D/3dmodel.model': line 2: the file says mm, but inch was asked for; leave --units out, or give "
      "the other file in mm, too");
}

TEST(ThreeMf, BodiesArePlacedByTheBuildAndByComponents) {
  const std::string block_1 = object(1, mesh(block()), "name=\"part\"");
  // A row of the point on the left: x becomes y, and then it is moved.
  const SolidFile turned = parsed(archive(model(block_1, item(1, "0 1 0 -1 0 0 0 0 1 100 0 0"))));
  EXPECT_EQ(box_of(turned.mesh.vertices).low, (Vector{80, 0, 0}));
  EXPECT_EQ(box_of(turned.mesh.vertices).high, (Vector{100, 10, 30}));
  EXPECT_EQ(turned.coordinate_error, 0);
  // First the component's own motion, and then what is around it.
  const SolidFile nested = parsed(archive(model(
      block_1 +
          object(2, components(component(1, "1 0 0 0 1 0 0 0 1 5 0 0") + component(1)), "name=\"two\"") +
          object(3, components(component(2, "2 0 0 0 2 0 0 0 2 0 0 1"))),
      item(3, "1 0 0 0 1 0 0 0 1 0 7 0") + item(1))));
  ASSERT_EQ(nested.mesh.triangles.size(), 36U);
  ASSERT_EQ(nested.mesh.vertices.size(), 24U);
  const std::vector<Vector> first(nested.mesh.vertices.begin(), nested.mesh.vertices.begin() + 8);
  EXPECT_EQ(box_of(first).low, (Vector{10, 7, 1}));
  EXPECT_EQ(box_of(first).high, (Vector{30, 47, 61}));
  EXPECT_EQ(nested.groups, std::vector<std::string>{"part"});
}

TEST(ThreeMf, ModelsBesideTheRootAreReadAsItsPathsSay) {
  const std::string beside = model(object(1, mesh(block()), "name=\"part\""), "");
  const std::string root = model(object(8, components(component(1, "", "p:path=\"/3D/Objects/a.model\""))),
                                 item(8), "unit=\"millimeter\" requiredextensions=\"p\"");
  expect_block(parsed(archive(root, {{"3D/Objects/a.model", beside}})), "a component's path");
  expect_block(parsed(archive(model("", item(1, "", "p:path=\"/3D/Objects/a.model\"")),
                              {{"3D/Objects/a.model", beside}})),
               "an item's path");
  EXPECT_EQ(fault(archive(root)),
            "a: there is no '3D/Objects/a.model' in this 3MF; it is damaged, export it again");
  EXPECT_EQ(fault(archive(root, {{"3D/Objects/a.model", root}})),
            "a: '3D/Objects/a.model': line 6: a model beside the root names a third one");
  EXPECT_EQ(fault(archive(root, {{"3D/Objects/a.model", one_block()}})),
            "a: '3D/Objects/a.model': line 35: a model beside the root has a build");
  EXPECT_EQ(fault(archive(root, {{"3D/Objects/a.model", model("", "", "unit=\"inch\"")}})),
            "a: '3D/Objects/a.model': line 2: the model has another unit than the root");
  EXPECT_EQ(fault(archive(root, {{"3D/Objects/a.model", model("", "")}})),
            "a: object 1 is not in '3D/Objects/a.model'");
}

TEST(ThreeMf, WhatIsNoBodyIsLeftOutAndTold) {
  std::string looks = mesh(block());
  looks.replace(looks.rfind("/>"), 2, " pid=\"5\" p1=\"0\"/>");
  looks.replace(looks.find("</mesh>"), 7,
                "<t:trianglesets><t:triangleset name=\"top\"><t:ref index=\"1\"/></t:triangleset>"
                "</t:trianglesets></mesh><metadatagroup/>");
  const SolidFile file = parsed(archive(
      model("<m:colorgroup id=\"5\"><m:color color=\"#fff\"/></m:colorgroup>"
            "<b:strange><b:more/></b:strange>" +
                object(1, looks) + object(2, mesh(block()), "type=\"support\"") + object(3, mesh(block())),
            item(1) + item(2))));
  expect_block(file, "with looks");
  EXPECT_EQ(file.notices, (std::vector<std::string>{
                              "a.3mf: 1 object is no model but support or open surfaces, and not read",
                              "a.3mf: 1 object is not in the build, and not read",
                              "a.3mf: 1 element of an extension is not read, the first 'strange'",
                              "a.3mf: colours and materials are not read"}));
}

struct Bad {
  const char* title;
  std::string bytes;
  std::string says;
};

std::string without(std::string text, const std::string& what, const std::string& with = "") {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(ThreeMfRefusal, EveryBadFileGivesOneSentenceWithItsPlace) {
  const std::string good = archive(block()), text = one_block(), in = "'3D/3dmodel.model': line ",
                    stored = zip({{"_rels/.rels", relations(), false}, {"3D/3dmodel.model", text, false}}),
                    damaged = "; it is cut off or damaged, export or copy it again";
  std::string changed = stored;
  changed[changed.find("x=\"10\"") + 3] = '2';
  std::string deep;
  for (int k = 0; k < 600; ++k) deep += "<a>";
  for (const Bad& bad : std::vector<Bad>{
           {"cut off", good.substr(0, good.size() - 1),
            "there is no directory at the end of this ZIP archive" + damaged},
           {"a part of it", good.substr(0, good.find(".model") + 50),
            "there is no directory at the end of this ZIP archive" + damaged},
           {"without its middle", good.substr(0, 200) + good.substr(400),
            "the directory is not at its place in this ZIP archive" + damaged},
           {"another byte", changed,
            "'3D/3dmodel.model' is damaged: its sum is another one; export it again"},
           {"encrypted", zip({{"_rels/.rels", relations(), true, 1}, {"3D/3dmodel.model", text}}),
            "'_rels/.rels' is encrypted; export it without a password"},
           {"another method", zip({{"_rels/.rels", relations(), true, 0, 9}, {"3D/3dmodel.model", text}}),
            "'_rels/.rels' is packed by method 9, and only what is stored or deflated is read; pack the "
            "archive "
            "anew"},
           {"no relations", zip({{"3D/3dmodel.model", text}}),
            "there is no '_rels/.rels' in this 3MF; it is damaged, export it again"},
           {"no relation", zip({{"_rels/.rels", "<Relationships/>"}, {"3D/3dmodel.model", text}}),
            "_rels/.rels names no 3D model in this 3MF"},
           {"twice", archive(text, {{"3d/3DMODEL.model", text}}),
            "'3d/3DMODEL.model' is there twice in this ZIP archive; export it again"},
           {"no model", zip({{"_rels/.rels", relations()}, {"3D/a", ""}}),
            "there is no '3D/3dmodel.model' in this 3MF; it is damaged, export it again"},
           {"no XML", archive("<model"), in + "1: this is not well-formed XML from here on (unclosed token)"},
           {"other XML", archive("<svg/>"), in + "1: the root is 'svg', not the model of 3MF"},
           {"without its namespace", archive("<model/>"),
            in + "1: the root is 'model', not the model of 3MF"},
           {"a document type", archive("<!DOCTYPE model><model/>"),
            in + "1: a document type is declared, which 3MF does not allow"},
           {"nested deeply", archive(model(deep, "")), in + "5: elements are nested more than 512 deep"},
           {"a unit", archive(model("", "", "unit=\"yard\"")), in + "2: 'yard' is no unit of 3MF"},
           {"an extension", archive(model("", "", "requiredextensions=\"p b\"")),
            in + "2: whoever reads it must know the extension "
                 "'http://schemas.microsoft.com/3dmanufactu...', which is not read; export a mesh alone"},
           {"beams", archive(without(text, "</triangles>\n", "</triangles>\n<b:beamlattice/>")),
            in + "31: 'beamlattice' is not read, and nobody knows what the body is without it; export a mesh "
                 "alone"},
           {"another body", archive(model(object(1, "<b:booleanshape/>"), item(1))),
            in + "6: 'booleanshape' is not read, and nobody knows what the body is without it; export a mesh "
                 "alone"},
           {"a number", archive(without(text, "x=\"10\"", "x=\"ten\"")), in + "9: 'ten' is not a number"},
           {"nan", archive(without(text, "x=\"10\"", "x=\"nan\"")), in + "9: 'nan' is not a finite number"},
           {"no z", archive(without(text, "z=\"0\"")), in + "8: the vertex has no z"},
           {"too large", archive(without(text, "x=\"10\"", "x=\"2e9\"")),
            in + "9: '2e9' is out of range: coordinates go up to 1e+09 mm"},
           {"a corner", archive(without(text, "v1=\"0\"", "v1=\"8\"")),
            in + "18: vertex 8 is not there: 8 vertices stand before this line, numbered from 0"},
           {"no corner", archive(without(text, "v1=\"0\"")), in + "18: the attribute v1 is missing"},
           {"a negative corner", archive(without(text, "v1=\"0\"", "v1=\"-1\"")),
            in + "18: v1 is '-1', not a whole number"},
           {"a type", archive(model(object(1, "", "type=\"hole\""), "")),
            in + "5: 'hole' is no type of an object"},
           {"an id twice", archive(model(object(1, "") + object(1, ""), "")),
            in + "7: object 1 is there twice"},
           {"itself", archive(model(object(1, components(component(1))), item(1))),
            in + "6: object 1 does not stand before this line"},
           {"a later one", archive(model(object(1, components(component(2))) + object(2, ""), item(1))),
            in + "6: object 2 does not stand before this line"},
           {"another item", archive(model("", item(1))), in + "7: object 1 does not stand before this line"},
           {"few numbers", archive(model(object(1, ""), item(1, "1 0 0"))),
            in + "9: the transform has 3 numbers, not 12"},
           {"many numbers", archive(model(object(1, ""), item(1, "1 0 0 0 1 0 0 0 1 0 0 0 0"))),
            in + "9: the transform has more than 12 numbers"},
           {"far away", archive(model(object(1, mesh(block())), item(1, "1 0 0 0 1e9 0 0 0 1 0 0 0"))),
            "where it is placed, 20000000000 is not a finite number up to 1e+09 mm"},
           {"an empty build", archive(model(object(1, mesh(block())), "")),
            "nothing is in the build of this 3MF; place the part there, and export it again"},
           {"no triangles", archive(model(object(1, ""), item(1))),
            "there are no triangles in the build of this 3MF"}})
    EXPECT_EQ(fault(bad.bytes), "a: " + bad.says) << bad.title;
}

TEST(ThreeMfRefusal, WhatFillsTheMemoryIsRefusedAtOnce) {
  const cases::Stopwatch watch;
  const std::string blanks = one_block() + std::string(30'000'000, ' ');
  EXPECT_EQ(fault(archive(blanks)),
            fmt::format("a: '3D/3dmodel.model' would become {} bytes of {}, which no model does",
                        blanks.size(), deflated(blanks).size()));
  // Each object holds the one before it twice.
  const auto doubled = [](int levels, const std::string& inside) {
    std::string all = object(0, inside);
    for (int k = 1; k <= levels; ++k) all += object(k, components(component(k - 1) + component(k - 1)));
    return archive(model(all, item(levels)));
  };
  EXPECT_EQ(fault(doubled(40, "")), "a: more than 100000 objects are placed");
  EXPECT_EQ(fault(doubled(70, "")), "a: objects are within each other more than 64 deep");
  std::string many = mesh(block());
  for (int k = 0; k < 2000; ++k)
    many.insert(many.find("<triangle v"), "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>");
  EXPECT_EQ(fault(doubled(10, many)),
            "a: placing makes more than 1000000 copies of vertices or triangles; place the part once");
  EXPECT_LT(watch.seconds(), 5);
}

}  // namespace
}  // namespace lekalo::io::io_three_mf_test
