// The checker's reader of 3MF: its inflater, its archives and its models.

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
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

/// The lowest bits of a number, the highest first.
std::string high_first(std::size_t number, std::size_t count) {
  return std::bitset<16>(number).to_string().substr(16 - count);
}
std::string low_first(std::size_t number, std::size_t count) {
  const std::string word = high_first(number, count);
  return {word.rbegin(), word.rend()};
}

using WordLengths = std::vector<std::size_t>;
/// The words of a prefix code (RFC 1951, 3.2.2); a length of 0 is of none.
std::vector<std::string> words_of(const WordLengths& lengths) {
  std::vector<std::string> words(lengths.size());
  std::size_t next = 0;
  for (std::size_t length = 1; length <= 15; ++length, next *= 2)
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
      if (lengths[symbol] == length) words[symbol] = high_first(next++, length);
  return words;
}
/// What a block begins with that has its own codes, each length of theirs a word of 4 bits.
std::string head_of(const WordLengths& symbols, const WordLengths& distances, const char* kind = "01") {
  std::string made = "1" + std::string(kind) + low_first(symbols.size() - 257, 5) +
                     low_first(distances.size() - 1, 5) + low_first(15, 4) + "000000000";
  for (int k = 0; k < 16; ++k) made += low_first(4, 3);
  for (const auto& lengths : {symbols, distances})
    for (const std::size_t length : lengths) made += high_first(length, 4);
  return made;
}

TEST(Inflate, TakesWordsOfUpTo15Bits) {
  WordLengths lengths(257, 0);
  for (std::size_t k = 0; k < 14; ++k) lengths['a' + k] = k + 1;
  lengths['o'] = lengths[256] = 15;
  const std::vector<std::string> words = words_of(lengths);
  const std::string all = "abcdefghijklmno";
  std::string text;
  for (const char c : all) text += words[static_cast<std::size_t>(c)];
  text += words[256];
  EXPECT_EQ(inflated(bits(head_of(lengths, {0}) + text), all.size()), all);
  EXPECT_EQ(inflated(bits(head_of(lengths, {0}, "11") + text), all.size()), std::nullopt) << "no such kind";
}

TEST(Inflate, TakesEveryLengthAndDistance) {
  std::string noise;
  std::uint32_t state = 7;
  for (int k = 0; k < 33'000; ++k)
    state = state * 1664525 + 1013904223, noise += static_cast<char>(state >> 24);
  for (std::size_t length = 3; length <= 258; ++length) {
    const std::string text = noise.substr(0, 300) + noise.substr(0, length);
    EXPECT_EQ(inflated(deflated(text, 9), text.size()), text) << length;
  }
  for (std::size_t bound = 4; bound <= 32'768; bound *= 2)
    for (const std::size_t distance : {bound - 1, bound, bound + 1, bound / 2 * 3, bound / 2 * 3 + 1}) {
      const std::string text =
          noise.substr(0, distance) + noise.substr(0, std::min<std::size_t>(distance, 40));
      EXPECT_EQ(inflated(deflated(text, 9), text.size()), text) << distance;
    }
}

TEST(Inflate, DistancesFrom30OnAreNone) {
  WordLengths lengths(286, 0), distances(32, 0);
  lengths['a'] = 1, lengths[256] = lengths[285] = 2;
  distances[0] = 1, distances[29] = 2, distances[30] = distances[31] = 3;
  const std::vector<std::string> words = words_of(lengths), far = words_of(distances);
  std::string before = head_of(lengths, distances) + words['a'];
  for (int k = 0; k < 255; ++k) before += words[285] + far[0];
  const std::size_t size = 1 + 255 * 258;
  const auto made = [&](std::size_t distance, std::size_t extra) {
    return inflated(bits(before + words[285] + far[distance] + std::string(extra, '0') + words[256]),
                    size + 258);
  };
  EXPECT_EQ(inflated(bits(before + words[256]), size), std::string(size, 'a'));
  EXPECT_EQ(made(29, 13), std::string(size + 258, 'a'));
  EXPECT_EQ(made(30, 14), std::nullopt);
  EXPECT_EQ(made(31, 14), std::nullopt);
}

TEST(Inflate, StoredBytesBeginAtTheNextWholeOne) {
  // A literal of 9 bits moves the head of the block behind it by one bit.
  std::string literals;
  for (std::size_t count = 0; count < 8; ++count, literals += high_first(400 + 56, 9))
    EXPECT_EQ(inflated(bits("0 10" + literals + "0000000 1 00") + std::string("\3\0\xfc\xff", 4) + "abc",
                       count + 3),
              std::string(count, '\xc8') + "abc");
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

/// Changes a number of 2 or 4 bytes.
std::string with_number(std::string bytes, std::size_t at, std::size_t size, std::uint32_t number) {
  for (std::size_t k = 0; k < size; ++k) bytes.at(at + k) = static_cast<char>(number >> 8 * k);
  return bytes;
}
constexpr const char* kFrontMark = "PK\3\4";
constexpr const char* kHeadMark = "PK\1\2";

TEST(Unzip, NamesAreTheSameInEveryCaseOfTheirLetters) {
  const std::string archive = zip({{"AZ@[/m", "first"}});
  EXPECT_EQ(unzip(archive, "az@[/M"), "first");
  EXPECT_EQ(unzip(archive, "AZ`[/m"), std::nullopt);
  EXPECT_EQ(unzip(archive, "AZ@{/m"), std::nullopt);
}

TEST(Unzip, EveryNumberHasToFit) {
  const std::string stored = zip({{"a", "first", false}}), small = zip({{"a", "first"}});
  const auto made = [](const std::string& of, std::size_t at, std::size_t size, std::uint32_t number) {
    return unzip(with_number(of, of.find(kHeadMark) + at, size, number), "a");
  };
  EXPECT_EQ(made(stored, 10, 2, 0), "first");
  for (const std::uint32_t method : {1U, 8U, 0x100U}) EXPECT_EQ(made(stored, 10, 2, method), std::nullopt);
  EXPECT_EQ(made(stored, 8, 2, 1), std::nullopt) << "encrypted";
  EXPECT_EQ(made(stored, 8, 2, 0x808), "first");
  for (const std::uint32_t size : {4U, 6U, 0x1000005U}) {
    EXPECT_EQ(made(stored, 24, 4, size), std::nullopt) << size;
    EXPECT_EQ(made(small, 24, 4, size), std::nullopt) << size;
    EXPECT_EQ(made(stored, 20, 4, size), std::nullopt) << size;
  }
  // More bytes than there are, of which fewer would do.
  const std::size_t front = 31;
  EXPECT_EQ(made(small, 20, 4, static_cast<std::uint32_t>(small.size() - front)), "first");
  EXPECT_EQ(made(small, 20, 4, static_cast<std::uint32_t>(small.size() - front + 1)), std::nullopt);
  for (const char* mark : {kFrontMark, kHeadMark, "PK\5\6"})
    for (std::size_t k = 0; k < 4; ++k) {
      std::string damaged = stored;
      ++damaged[damaged.find(mark) + k];
      EXPECT_EQ(unzip(damaged, "a"), std::nullopt) << mark;
    }
}

TEST(Unzip, FarPlacesHaveTheirMarks) {
  const std::string far = zip({{"a", "first"}}, ZipForm::far);
  for (const char* mark : {"PK\6\6", "PK\6\7"})
    for (std::size_t k = 0; k < 4; ++k) {
      std::string damaged = far;
      ++damaged[damaged.find(mark) + k];
      EXPECT_EQ(unzip(damaged, "a"), std::nullopt) << mark;
    }
  // The place and the end may be the first of the archive, and all that they name stands in the comment.
  std::string rest = far.substr(0, far.size() - 42), place = far.substr(rest.size(), 20),
              end = far.substr(rest.size() + 20);
  const auto later = [](char& byte) { byte = static_cast<char>(byte + 42); };
  const std::size_t far_end = rest.find("PK\6\6");
  later(rest[far_end - 8]), later(rest[far_end + 48]), later(place[8]);
  end = with_number(end, 20, 2, static_cast<std::uint32_t>(rest.size()));
  EXPECT_EQ(unzip(place + end + rest, "a"), "first");
  EXPECT_EQ(unzip(place.substr(1) + end + rest, "a"), std::nullopt);
}

TEST(Unzip, AFieldThatEndsEarlySaysZeros) {
  // The sizes and the place of an empty file become its comment.
  std::string empty = zip({{"a", "", false}}, ZipForm::far);
  const std::size_t head = empty.find(kHeadMark);
  EXPECT_EQ(unzip(with_number(with_number(empty, head + 30, 2, 12), head + 32, 2, 24), "a"), "");
  EXPECT_EQ(unzip(with_number(with_number(empty, head + 30, 2, 8), head + 32, 2, 28), "a"), std::nullopt);
}

TEST(Unzip, AFileIsAtMost100TimesAsLongAsItIsPacked) {
  const std::string spaces(limits::kMostUnpackedTimes * 700 + 99, ' '), rest(1000, 'r');
  const std::string archive = zip({{"a", spaces}, {"b", rest, false}});
  // What stands behind a text counts as packed.
  const auto packed = [&](std::uint32_t size) {
    return unzip(with_number(archive, archive.find(kHeadMark) + 20, 4, size), "a");
  };
  EXPECT_EQ(packed(700), spaces);
  EXPECT_EQ(packed(699), std::nullopt);
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

/// The text of one cube with a place of it changed.
std::string changed(const std::string& what, const std::string& instead) {
  std::string made = text();
  const std::size_t at = made.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return made.replace(at, what.size(), instead);
}

TEST(ThreeMfReader, ReadsEveryUnit) {
  for (const auto& [unit, millimetres] :
       std::vector<std::pair<std::string, Fraction>>{{"micron", Fraction(1, 1000)},
                                                     {"millimeter", Fraction(1)},
                                                     {"centimeter", Fraction(10)},
                                                     {"inch", Fraction(127, 5)},
                                                     {"foot", Fraction(1524, 5)},
                                                     {"meter", Fraction(1000)}}) {
    const auto read = read_solid({"s", archive(changed("millimeter", unit))});
    ASSERT_TRUE(read && !read->open) << unit;
    EXPECT_TRUE(read->mesh.exact(7, 2) == 3 * millimetres) << unit;
  }
}

TEST(ThreeMfReader, OneOfTwoTransformsMayBeMissing) {
  const auto vertices = [](const std::string& inner, const std::string& outer) {
    const auto read =
        read_solid({"s", archive(model(object(1, mesh(cube())) + object(2, components(component(1, inner))),
                                       item(2, outer)))});
    std::vector<Fraction> made;
    for (std::uint32_t v = 0; read && v < read->mesh.near.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) made.push_back(read->mesh.exact(v, axis));
    return made;
  };
  const std::string turned = "0 1 0 -1 0 0 0 0 1 0.1 5 7", still = "1 0 0 0 1 0 0 0 1 0 0 0";
  const std::vector<Fraction> wanted = vertices(turned, still);
  ASSERT_EQ(wanted.size(), 24U);
  EXPECT_TRUE(vertices(turned, "") == wanted);
  EXPECT_TRUE(vertices("", turned) == wanted);
}

TEST(ThreeMfReader, NamesAreOfTheirSpaces) {
  // The core behind a prefix, and another space without one.
  std::string prefixed = text();
  for (const char* name : {"model", "resources", "object", "build", "item", "mesh", "vertices", "triangles",
                           "vertex ", "triangle "})
    for (const std::string& begin : {std::string("<"), std::string("</")})
      for (std::size_t at = 0; (at = prefixed.find(begin + name, at)) != std::string::npos; ++at)
        prefixed.insert(at + begin.size(), "core:");
  const std::string space = "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"";
  prefixed.replace(prefixed.find(space), space.size(), "xmlns=\"q\" xmlns:core" + space.substr(5));
  EXPECT_EQ(reading(archive(prefixed)), kWhole);
  // Elements of other spaces are not those of the core with their names.
  EXPECT_EQ(reading(archive(changed("<resources>", "<resources><b:object id=\"1\"/>"))), kWhole);
  EXPECT_EQ(reading(archive(changed("<build>", "<build><m:item objectid=\"7\"/>"))), kWhole);
  EXPECT_EQ(reading(archive(changed("</object>", "<m:more/></object>"))), kWhole);
  EXPECT_EQ(reading(archive(changed("unit=", "requiredextensions=\"t\" unit="))), kWhole);
  // Paths are of the extension for production.
  for (const char* path : {"m:path=\"a.model\"", "path=\"a.model\"", "p:pat=\"a.model\""}) {
    EXPECT_EQ(reading(archive(changed("<item", "<item " + std::string(path)))), kWhole) << path;
    const std::string with_space = changed("<item", "<item " + std::string(path));
    std::string named = with_space;
    named.replace(named.find("xmlns:p="), 8, "xmlns:path=");
    EXPECT_EQ(reading(archive(named)), kWhole) << path;
  }
  EXPECT_EQ(reading(archive(changed("<item", "<item p:path=\"a.model\""))),
            "a.model cannot be unpacked from it");
}

TEST(ThreeMfReader, TheFirstRelationToAModelCounts) {
  std::string two = relations();
  const std::string other = relations("/3D/other.model");
  const std::size_t begin = other.rfind("<Relationship "), end = other.find("</Relationships>");
  two.insert(two.find("</Relationships>"), other.substr(begin, end - begin));
  EXPECT_EQ(reading(zip({{"_rels/.rels", two}, {"3D/3dmodel.model", text()}})), kWhole);
}

TEST(ThreeMfReader, WhatItDoesNotUnderstandIsSaidAndLeftOpen) {
  const auto with = [](const std::string& what, const std::string& instead) {
    return archive(changed(what, instead));
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
                                                        {"</mesh>", "<vertex/></mesh>"},
                                                        {"</vertices>", "<triangle/></vertices>"},
                                                        {"</object>", "<item/></object>"},
                                                        {"</object>", "<more/></object>"},
                                                        {"</object>", "<b:metadatagroup/></object>"},
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
  for (const char* numbers : {"1 2 3", "1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0"})
    EXPECT_EQ(reading(with("<item", fmt::format("<item transform=\"{}\"", numbers))),
              of_root("a transform has 12 numbers"));
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

TEST(ThreeMfReader, PlacingMakesAMillionVerticesOrTriangles) {
  // One object of so many, placed so often that all of them but its own are copies.
  const auto placed = [](std::size_t vertices, std::size_t triangles, int times) {
    std::string all = "<mesh><vertices>", items;
    for (std::size_t k = 0; k < vertices; ++k) all += "<vertex x=\"0\" y=\"0\" z=\"0\"/>";
    all += "</vertices><triangles>";
    for (std::size_t k = 0; k < triangles; ++k) all += "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>";
    for (int k = 0; k < times; ++k) items += item(1);
    const std::string root = model(object(1, all + "</triangles></mesh>"), items);
    return reading(zip({{"_rels/.rels", relations()}, {"3D/3dmodel.model", root, false}}));
  };
  const std::string refused = "s: placing makes more than 1000000 copies";
  EXPECT_EQ(placed(10'000, 0, 101), "s: there are no triangles in it");
  EXPECT_EQ(placed(10'000, 0, 102), refused);
  EXPECT_EQ(placed(3, 10'000, 101), "303 vertices, 1010000 triangles");
  EXPECT_EQ(placed(3, 10'000, 102), refused);
}

}  // namespace
}  // namespace lekalo::verify::verify_three_mf_test
