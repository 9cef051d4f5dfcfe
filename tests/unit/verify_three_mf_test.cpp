// The checker's reader of 3MF: its inflater, its archives and its models.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/base/archive_limits.hpp"
#include "support/solids.hpp"
#include "support/three_mf_files.hpp"
#include "support/verify_solids.hpp"
#include "verify/read/zip.hpp"

namespace lekalo::verify::verify_three_mf_test {
namespace {

using namespace three_mf_files;

solid::Mesh cube() { return cases::block({0, 0, 0}, {1.5, 2, 3}); }
std::string text() { return model(object(1, mesh(cube()), "name=\"part\""), item(1)); }

std::string reading(const std::string& bytes) {
  const auto read = read_solid({"s", bytes});
  if (!read) return read.error().message;
  if (read->open) return *read->open;
  return fmt::format("{} vertices, {} triangles", read->mesh.near.size(), read->mesh.triangles.size());
}
std::string of_root(const std::string& sentence) { return "of 3D/3dmodel.model: " + sentence; }
const std::string kWhole = "8 vertices, 12 triangles";

// ---- deflated texts ---------------------------------------------------------------------------------------

/// Bits of a deflated text, the first the lowest of its byte.
std::string bits(const std::string& of) {
  std::string made;
  int count = 0;
  for (const char c : of) {
    if (c != '0' && c != '1') continue;
    if (count++ % 8 == 0) made += '\0';
    made.back() = static_cast<char>(made.back() | (c - '0') << (count - 1) % 8);
  }
  return made;
}

TEST(Inflate, GivesBackWhatWasDeflated) {
  std::string mixed, noise;
  std::uint32_t state = 1;
  for (int k = 0; k < 70'000; ++k) {
    state = state * 1664525 + 1013904223;
    noise += static_cast<char>(state >> 24);
    mixed += k % 3 == 0 ? fmt::format("<vertex x=\"{}\"/>", state >> 12) : "\n";
  }
  for (const std::string& one : {std::string(), std::string("a"), std::string(100'000, 'a'), noise, mixed,
                                 noise.substr(0, 40'000) + noise.substr(0, 33'000)})
    for (const int level : {0, 1, 6, 9}) EXPECT_EQ(inflated(deflated(one, level), one.size()), one);
}

TEST(Inflate, TakesEachKindOfBlockByHand) {
  // A block that is stored: 1, kind 00, up to the byte's end; the count and its inverse.
  const std::string head = bits("1 00 00000");
  EXPECT_EQ(inflated(head + std::string("\3\0\xfc\xff"
                                        "abc",
                                        7),
                     3),
            "abc");
  EXPECT_EQ(inflated(head + std::string("\3\0\xfd\xff"
                                        "abc",
                                        7),
                     3),
            std::nullopt);
  EXPECT_EQ(inflated(head + std::string("\4\0\xfb\xff"
                                        "abc",
                                        7),
                     4),
            std::nullopt)
      << "too short";
  EXPECT_EQ(inflated(head + std::string("\3\0\xfc\xff"
                                        "abc",
                                        7),
                     2),
            std::nullopt)
      << "too long";
  EXPECT_EQ(inflated(head + std::string("\3\0\xfc\xff"
                                        "abc",
                                        7),
                     4),
            std::nullopt)
      << "too few";
  EXPECT_EQ(inflated(bits("1 11 00000"), 0), std::nullopt) << "no such kind";
  EXPECT_EQ(inflated("", 0), std::nullopt);
  // The fixed code, whose words begin with their highest bit: 'a' is 0x30 + 97, the end is 0000000.
  EXPECT_EQ(inflated(bits("1 10 10010001 0000000"), 1), "a");
  EXPECT_EQ(inflated(bits("1 10 10010001 00000"), 1), std::nullopt) << "ends early";
  EXPECT_EQ(inflated(bits("1 10 10010001 10010001 0000000"), 1), std::nullopt) << "too long";
  EXPECT_EQ(inflated(bits("0 10 10010001 0000000 1 10 10010001 0000000"), 2), "aa") << "two blocks";
  // Three more, one back: the length 3 is 0000001, the distance 1 is 00000; then two back, from before.
  EXPECT_EQ(inflated(bits("1 10 10010001 0000001 00000 0000000"), 4), "aaaa");
  EXPECT_EQ(inflated(bits("1 10 10010001 0000001 00001 0000000"), 4), std::nullopt) << "before its beginning";
  // The highest words of the code stand for nothing, and so do the distances 30 and 31.
  EXPECT_EQ(inflated(bits("1 10 10010001 11000110 00000 0000000"), 259), std::nullopt);
  EXPECT_EQ(inflated(bits("1 10 10010001 0000001 11110 0000000000000000000000"), 4), std::nullopt);
  EXPECT_EQ(inflated(bits("1 10 10010001 11000101 00000 0000000"), 259), std::string(259, 'a'));
}

TEST(Inflate, RefusesCodesThatMeanNothing) {
  // 257 symbols, 1 distance, 4 lengths, of which only 16, "again", has a word: nothing stands before it.
  EXPECT_EQ(inflated(bits("1 01 00000 00000 0000 100 000 000 000 0 00"), 0), std::nullopt);
  // No word at all.
  EXPECT_EQ(inflated(bits("1 01 00000 00000 0000 000 000 000 000 0000000000000000"), 0), std::nullopt);
  // Every one of damaged texts ends, and gives a text of its size or none.
  const std::string whole = text(), packed = deflated(whole);
  for (std::size_t k = 0; k < packed.size(); ++k) {
    std::string damaged = packed;
    damaged[k] = static_cast<char>(damaged[k] ^ 1 << k % 8);
    const auto made = inflated(damaged, whole.size());
    EXPECT_TRUE(!made || made->size() == whole.size());
    EXPECT_EQ(inflated(packed.substr(0, k), whole.size()), std::nullopt);
  }
}

// ---- archives ---------------------------------------------------------------------------------------------

TEST(Unzip, FindsFilesInEveryFormOfArchive) {
  for (const ZipForm form : kZipForms)
    for (const char* comment : {"", "a comment", "PK\5\6 in a comment of some length"}) {
      const std::string archive =
          zip({{"a", "first", false}, {"B/c.Model", "second"}, {"/d", "third"}}, form, comment);
      EXPECT_EQ(unzip(archive, "a"), "first");
      EXPECT_EQ(unzip(archive, "b/C.mODEL"), "second");
      EXPECT_EQ(unzip(archive, "/B/c.Model"), "second");
      EXPECT_EQ(unzip(archive, "d"), "third");
      EXPECT_EQ(unzip(archive, "e"), std::nullopt);
      EXPECT_EQ(unzip(archive, ""), std::nullopt);
      EXPECT_EQ(unzip(archive + "x", "a"), std::nullopt);
      EXPECT_EQ(unzip(archive.substr(0, archive.size() - 1), "a"), std::nullopt);
    }
  EXPECT_EQ(unzip("", "a"), std::nullopt);
  EXPECT_EQ(unzip(zip({}), "a"), std::nullopt);
  const std::string longest(0xffff, 'c');
  EXPECT_EQ(unzip(zip({{"a", "first"}}, ZipForm::plain, longest), "a"), "first");
}

TEST(Unzip, GivesNothingOfADamagedFile) {
  const std::string whole = zip({{"a", "first", false}, {"b", std::string(500, 'b')}});
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x10);
    const auto a = unzip(damaged, "a"), b = unzip(damaged, "b");
    EXPECT_TRUE(!a || *a == "first") << k;
    EXPECT_TRUE(!b || *b == std::string(500, 'b')) << k;
  }
  EXPECT_EQ(unzip(zip({{"a", "first", true, 1}}), "a"), std::nullopt) << "encrypted";
  EXPECT_EQ(unzip(zip({{"a", "first", true, 0, 9}}), "a"), std::nullopt) << "another method";
  // What grows more than any model does, and what is as small as it may be.
  const std::string small(limits::kSmallUnpacked, ' '), large(300 * limits::kSmallUnpacked, ' ');
  EXPECT_EQ(unzip(zip({{"a", small}}), "a"), small);
  EXPECT_EQ(unzip(zip({{"a", large}}), "a"), std::nullopt);
  EXPECT_EQ(unzip(zip({{"a", large, false}}), "a"), large);
}

// ---- models -----------------------------------------------------------------------------------------------

TEST(ThreeMfReader, PutsTheBodiesTogetherExactly) {
  EXPECT_EQ(reading(archive(text())), kWhole);
  const auto read =
      read_solid({"s", archive(model(object(1, mesh(cube()), "name=\"part\"") +
                                         object(2, components(component(1, "0 0.1 0 -0.1 0 0 0 0 1 0.3 0 0")),
                                                "name=\"two\""),
                                     item(2, "1 0 0 0 1 0 0 0 3 1e-30 0 7") + item(1), "unit=\"inch\""))});
  ASSERT_TRUE(read && !read->open);
  EXPECT_EQ(read->unit, SolidUnit::inch);
  EXPECT_EQ(read->groups.at(read->group_of.at(0)), "part");
  ASSERT_EQ(read->mesh.near.size(), 16U);
  // Of (1.5, 2, 3): x becomes 0.3 - 0.2, y 0.15, z 3 times 3 and 7.
  const std::vector<solid::Vector> vertices = cube().vertices;
  const auto corner =
      static_cast<std::uint32_t>(std::ranges::find(vertices, solid::Vector{1.5, 2, 3}) - vertices.begin());
  const Fraction inch(127, 5), tiny(Integer(1), power_of_ten(30));
  EXPECT_TRUE(read->mesh.exact(corner, 0) == (Fraction(1, 10) + tiny) * inch);
  EXPECT_TRUE(read->mesh.exact(corner, 1) == Fraction(15, 100) * inch);
  EXPECT_TRUE(read->mesh.exact(corner, 2) == 16 * inch);
  EXPECT_TRUE(read->mesh.exact(8 + corner, 0) == Fraction(3, 2) * inch);
}

TEST(ThreeMfReader, LeavesOutWhatIsNoBody) {
  EXPECT_EQ(
      reading(archive(model("<m:colorgroup><m:color/></m:colorgroup><b:strange><b:vertices/></b:strange>" +
                                object(1, mesh(cube()) + "<metadatagroup><metadata/></metadatagroup>") +
                                object(2, mesh(cube()), "type=\"support\""),
                            item(1, "", "p:UUID=\"1\"") + item(2)))),
      kWhole);
  std::string sets = text();
  sets.replace(sets.find("</mesh>"), 7, "<t:trianglesets><t:ref/></t:trianglesets></mesh>");
  EXPECT_EQ(reading(archive(sets)), kWhole);
  const std::string beside = model(object(1, mesh(cube())), "");
  EXPECT_EQ(reading(archive(model(object(8, components(component(1, "", "p:path=\"/3D/a.model\""))), item(8),
                                  "requiredextensions=\"p m\""),
                            {{"3D/a.model", beside}})),
            kWhole);
}

TEST(ThreeMfReader, WhatItDoesNotUnderstandIsSaidAndLeftOpen) {
  const auto with = [](const std::string& what, const std::string& instead) {
    std::string changed = text();
    const std::size_t at = changed.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return archive(changed.replace(at, what.size(), instead));
  };
  const std::string unpacked = " cannot be unpacked from it";
  EXPECT_EQ(reading("PK\3\4"), "_rels/.rels" + unpacked);
  EXPECT_EQ(reading(zip({{"_rels/.rels", relations()}})), "3D/3dmodel.model" + unpacked);
  EXPECT_EQ(reading(archive("<model>")), "3D/3dmodel.model in it is no XML that is understood here");
  EXPECT_EQ(reading(archive("<svg/>")), of_root("it is no model of 3MF"));
  EXPECT_EQ(reading(with("millimeter", "yard")), of_root("yard is no unit"));
  EXPECT_EQ(reading(with("unit=", "requiredextensions=\"m t b\" unit=")),
            of_root("it requires the extension b"));
  EXPECT_EQ(reading(with("<resources>", "<resources xmlns:q=\"q\">")),
            of_root("a namespace is declared below the model"));
  for (const auto& [outer, inner] :
       std::vector<std::pair<std::string, std::string>>{{"</object>", "<b:more/></object>"},
                                                        {"</mesh>", "<b:more/></mesh>"},
                                                        {"</vertices>", "<more/></vertices>"},
                                                        {"</triangles>", "<m/><more/></triangles>"},
                                                        {"</build>", "<more/></build>"},
                                                        {"</mesh>", "<metadatagroup/></mesh>"},
                                                        {"</object>", "<t:sets/></object>"}})
    EXPECT_NE(reading(with(outer, inner)).find(" is an element that is not known"), std::string::npos)
        << inner;
  EXPECT_EQ(reading(with("id=\"1\"", "id=\"1\" type=\"hole\"")), of_root("hole is no type of an object"));
  for (const char* type : {"solidsupport", "support", "surface", "other"})
    EXPECT_EQ(reading(with("id=\"1\"", fmt::format("id=\"1\" type=\"{}\"", type))),
              "s: there are no triangles in it");
  EXPECT_EQ(reading(with("id=\"1\"", "id=\"1\" type=\"model\"")), kWhole);
  EXPECT_EQ(reading(with("x=\"1.5\"", "x=\"one\"")), of_root("\"one\" is not " + decimal_rule()));
  EXPECT_EQ(reading(with("v1=\"0\"", "v1=\"8\"")), of_root("a triangle has a corner that is not there"));
  EXPECT_EQ(reading(with("v1=\"0\"", "v1=\"7\"")), kWhole);
  EXPECT_EQ(reading(with("v1=\"0\"", "v1=\"0.5\"")), of_root("v1 of triangle is no whole number"));
  EXPECT_EQ(reading(with("v1=\"0\"", "")), of_root("v1 of triangle is no whole number"));
  EXPECT_EQ(reading(with("</resources>", object(1, "") + "</resources>")),
            of_root("an object is there twice"));
  EXPECT_EQ(reading(with("<item", "<item transform=\"1 2 3\"")), of_root("a transform has 12 numbers"));
  const std::string before = of_root("an object holds one that does not stand before it");
  EXPECT_EQ(reading(archive(model(object(1, components(component(1))), item(1)))), before);
  EXPECT_EQ(reading(archive(model(object(1, components(component(2))) + object(2, ""), item(1)))), before);
  EXPECT_EQ(reading(with("x=\"1.5\"", "x=\"1e10\"")), "s: the coordinate 10000000000 is not within 1e+09 mm");
}

TEST(ThreeMfReader, ModelsBesideTheRootHaveNoBuildAndNoPaths) {
  const auto beside = [](const std::string& other) {
    return reading(archive(model(object(8, components(component(1, "", "p:path=\"3D/a.model\""))), item(8)),
                           {{"3D/a.model", other}}));
  };
  EXPECT_EQ(beside(text()), "of 3D/a.model: a model beside the root has a build");
  EXPECT_EQ(beside(model(object(1, components(component(1, "", "p:path=\"b.model\""))), "")),
            "of 3D/a.model: a model beside the root names a third one");
  EXPECT_EQ(beside(model("", "", "unit=\"inch\"")), "of 3D/a.model: its models have different units");
  EXPECT_EQ(beside(model("", "")),
            "it places an object that is not there, or too many, or too many within each other");
}

TEST(ThreeMfReader, CopiesAndDepthHaveTheLimitsOfTheReader) {
  const auto doubled = [](int levels, int times, const std::string& inside) {
    std::string all = object(0, inside), inner;
    for (int k = 1; k <= levels; ++k) {
      inner.clear();
      for (int n = 0; n < times; ++n) inner += component(k - 1);
      all += object(k, components(inner));
    }
    return reading(
        zip({{"_rels/.rels", relations()}, {"3D/3dmodel.model", model(all, item(levels)), false}}));
  };
  const std::string too_many =
      "it places an object that is not there, or too many, or too many within each other";
  EXPECT_EQ(doubled(63, 1, mesh(cube())), kWhole);
  EXPECT_EQ(doubled(64, 1, mesh(cube())), too_many);
  EXPECT_EQ(doubled(1, 99'999, ""), "s: there are no triangles in it");
  EXPECT_EQ(doubled(1, 100'000, ""), too_many);
}

}  // namespace
}  // namespace lekalo::verify::verify_three_mf_test
