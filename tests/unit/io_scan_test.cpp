#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lekalo/io/scan/scan_file.hpp"
#include "support/scan_files.hpp"

namespace lekalo::io_scan_test {
namespace {

using namespace std::string_literals;
using scan_files::Vertex;

io::ScanFile parsed(const std::string& bytes, const std::string& name,
                    std::optional<io::ScanSlice> slice = {}, std::optional<LengthUnit> unit = {}) {
  auto file = io::parse_scan(bytes, name, unit, slice);
  EXPECT_TRUE(file) << file.error().message;
  return file ? *std::move(file) : io::ScanFile{};
}

TEST(ScanFile, AnEmptyLineBeginsTheNextContourAndACommentDoesNot) {
  const io::ScanFile file = parsed("x,y\n0,0\n1,0\n# still the first\n1,1\n\n\n5,5\n6,5\n6,6\n\n", "a.csv");
  EXPECT_EQ(file.points.points.size(), 6U);
  EXPECT_EQ(file.points.contour_starts, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(file.places, (std::vector<std::size_t>{2, 3, 5, 8, 9, 10}));
  EXPECT_TRUE(file.has_order);
}

TEST(ScanFile, ASliceTakesThePointsWithinHalfItsThickness) {
  const std::string bytes = "0 0 9.4\n1 0 9.5\n2 0 10\n3 0 10.5\n4 0 10.51\n";
  const io::ScanFile file = parsed(bytes, "a.xyz", io::ScanSlice{10, 1});
  EXPECT_EQ(file.points.points, (geom::Ring{{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(file.places, (std::vector<std::size_t>{2, 3, 4}));
  EXPECT_FALSE(file.has_order);
  ASSERT_EQ(file.notices.size(), 1U);
  EXPECT_NE(file.notices[0].find("3 of 5 points lie in the slice at height 10 mm, 1 mm thick"),
            std::string::npos);
  EXPECT_NE(parsed(bytes, "a.xyz").notices[0].find("third number of 5 lines (z) is ignored"),
            std::string::npos);
}

TEST(ScanFile, EveryKindOfPlyGivesTheSamePoints) {
  const std::vector<Vertex> vertices{{0, 0, 1}, {10.5, 0.25, 2}, {-3, 7, 3}};
  const geom::Ring expected{{0, 0}, {10.5, 0.25}, {-3, 7}};
  for (const std::string& bytes : {scan_files::ply_ascii(vertices), scan_files::ply_binary(vertices, false),
                                   scan_files::ply_binary(vertices, true)}) {
    const io::ScanFile file = parsed(bytes, "A.PLY");
    EXPECT_EQ(file.points.points, expected);
    EXPECT_EQ(file.coordinate_error, 0);
    EXPECT_EQ(file.notices.size(), 1U) << "faces or cameras are ignored, but said";
    EXPECT_FALSE(file.has_order);
    EXPECT_EQ(parsed(bytes, "a.ply", io::ScanSlice{2, 0.5}).places, (std::vector<std::size_t>{1}));
    const io::ScanFile inches = parsed(bytes, "a.ply", {}, LengthUnit::inch);
    EXPECT_NEAR(inches.points.points[1].x, 266.7, 1e-12);
    EXPECT_GE(inches.coordinate_error, std::abs(inches.points.points[1].x - 266.7));
  }
}

struct Bad {
  const char* title;
  const char* name;
  std::string bytes;
  std::vector<const char*> says;
  std::optional<io::ScanSlice> slice{};
};

TEST(ScanFile, WhatCannotBeReadIsRefusedWithPlaceAndReason) {
  const std::string head = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const std::string xy = "element vertex 2\nproperty float x\nproperty float y\n";
  const std::string little = "ply\nformat binary_little_endian 1.0\n";
  const std::vector<Bad> all{
      {"no points", "a.csv", "# nothing\n", {"a.csv", "no points"}},
      {"ending", "a.stl", "0 0\n", {"a.stl", ".ply files, not from '.stl'"}},
      {"text errors as in contours", "a.xyz", "0 0\n1 x\n", {"line 2", "'x' is not a number"}},
      {"no z for a slice", "a.xyz", "0 0 1\n1 1\n", {"line 2", "no z"}, io::ScanSlice{1, 1}},
      {"slice beside the scan",
       "a.xyz",
       "0 0 1\n1 1 2\n",
       {"no point lies in the slice", "from 1 to 2"},
       io::ScanSlice{9, 1}},
      {"binary text", "a.csv", "0\0 0\n"s, {"zero bytes"}},
      {"not a ply", "a.ply", "solid\n", {"this is no PLY"}},
      {"empty ply", "a.ply", "", {"no end_header"}},
      {"no end", "a.ply", head + xy, {"no end_header"}},
      {"no format", "a.ply", "ply\n" + xy + end + "0 0\n1 1\n", {"no format"}},
      {"two formats", "a.ply", head + "format ascii 1.0\n", {"line 3", "second format"}},
      {"unknown format", "a.ply", "ply\nformat utf8 1.0\n", {"line 2", "'utf8'"}},
      {"version", "a.ply", "ply\nformat ascii 2.0\n", {"line 2", "format ascii 1.0"}},
      {"unknown word", "a.ply", head + "vertices 3\n", {"line 3", "'vertices'"}},
      {"count", "a.ply", head + "element vertex -1\n", {"line 3", "element NAME COUNT"}},
      {"twice", "a.ply", head + xy + "element vertex 2\n", {"line 6", "declared twice"}},
      {"property alone", "a.ply", head + "property float x\n", {"line 3", "before the first element"}},
      {"type", "a.ply", head + "element vertex 1\nproperty real x\n", {"line 4", "'real'"}},
      {"float counts",
       "a.ply",
       head + "element f 1\nproperty list float int v\n",
       {"line 4", "cannot count"}},
      {"list in vertex", "a.ply", head + xy + "property list uchar int v\n" + end, {"list ('v')"}},
      {"no x", "a.ply", head + "element vertex 1\nproperty float y\n" + end + "0\n", {"no property x"}},
      {"two x", "a.ply", head + xy + "property float x\n" + end, {"two properties x"}},
      {"no z", "a.ply", head + xy + end + "0 0\n1 1\n", {"no property z"}, io::ScanSlice{1, 1}},
      {"no vertex", "a.ply", head + "element face 0\nproperty int a\n" + end, {"no element vertex"}},
      {"no properties",
       "a.ply",
       head + "element a 18446744073709551615\n" + xy + end,
       {"'a' has no properties"}},
      {"too many",
       "a.ply",
       head + "element vertex 20000001\nproperty float x\nproperty float y\n" + end,
       {"20000001 vertices"}},
      {"short row", "a.ply", head + xy + end + "0 0\n1\n", {"line 8", "1 numbers where a vertex has 2"}},
      {"word in row", "a.ply", head + xy + end + "0 0\n1 one\n", {"line 8", "'one' is not a number"}},
      {"rows missing", "a.ply", head + xy + end + "0 0\n", {"ends in row 1 of 2"}},
      {"binary cut", "a.ply", little + xy + end + "12345678abc", {"ends in row 1 of 2"}},
      {"binary nan",
       "a.ply",
       little + xy + end + "\0\0\xc0\x7f\0\0\0\0\0\0\0\0\0\0\0\0"s,
       {"vertex 0", "not a finite"}},
      {"list count negative",
       "a.ply",
       little + "element f 1\nproperty list char int v\n" + xy + end + "\xff",
       {"row 0", "list of -1"}},
      {"list longer than the file",
       "a.ply",
       little + "element f 1\nproperty list uint double v\n" + xy + end + "\xff\xff\xff\xff",
       {"ends in row 0 of 1"}},
  };
  for (const Bad& bad : all) {
    const auto file = io::parse_scan(bad.bytes, bad.name, std::nullopt, bad.slice);
    ASSERT_FALSE(file) << bad.title;
    EXPECT_EQ(file.error().code, ErrorCode::bad_input) << bad.title;
    EXPECT_EQ(file.error().message.rfind(bad.name, 0), 0U) << file.error().message;
    for (const char* part : bad.says)
      EXPECT_NE(file.error().message.find(part), std::string::npos)
          << bad.title << ": " << file.error().message;
  }
  for (const io::ScanSlice slice : {io::ScanSlice{0, 0}, io::ScanSlice{NAN, 1}, io::ScanSlice{0, INFINITY}}) {
    const auto file = io::parse_scan("0 0 0\n", "a.xyz", std::nullopt, slice);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::usage);
  }
}

TEST(ScanBlank, ACoredCastingFromTextAndFromASliceOfAPly) {
  const geom::Ring outer = scan_files::rectangle(0, 0, 60, 40, 1),
                   hole = scan_files::rectangle(20, 10, 20, 20, 1);
  io::ScanBlankOptions options;
  options.scan.uncertainty = 0.01;
  const std::string bytes = scan_files::text(outer) + "\n" + scan_files::text(hole);
  const auto in_order = io::read_scan_blank(bytes, "a.xyz", options);
  ASSERT_TRUE(in_order) << in_order.error().message;
  EXPECT_TRUE(in_order->blank.proved());
  EXPECT_TRUE(in_order->blank.ordered);

  std::vector<Vertex> vertices;
  for (std::size_t i = 0; i < std::max(outer.size(), hole.size()); ++i) {
    if (i < outer.size()) vertices.push_back({outer[i].x, outer[i].y, 5});
    if (i < hole.size()) vertices.push_back({hole[i].x, hole[i].y, 5.1});
    vertices.push_back({1000.0 + static_cast<double>(i), 0, 8});
  }
  options.slice = io::ScanSlice{5, 0.5};
  const auto slice = io::read_scan_blank(scan_files::ply_binary(vertices, true), "a.ply", options);
  ASSERT_TRUE(slice) << slice.error().message;
  EXPECT_FALSE(slice->blank.ordered);
  for (const auto* blank : {&in_order->blank, &slice->blank}) {
    ASSERT_EQ(blank->regions.size(), 1U);
    ASSERT_EQ(blank->regions[0].holes.size(), 1U);
    // 0.02 mm of guard all round, and at most the simplification.
    const double guard = blank->guard, length = 2 * (60 + 40) + 2 * (20 + 20);
    EXPECT_NEAR(geom::area(blank->regions[0]), 60 * 40 - 20 * 20 - guard * length, 0.3);
    EXPECT_LE(geom::area(blank->regions[0]), 60 * 40 - 20 * 20 - guard * length + 0.01);
  }
  EXPECT_NE(slice->blank.assumptions.back().find("stands upright"), std::string::npos);
}

TEST(ScanBlank, UnknownStretchesAndPointsLeftOutAreNamedByLine) {
  geom::Ring ring = scan_files::rectangle(0, 0, 60, 40, 1);
  ring.erase(ring.begin() + 11, ring.begin() + 20);  // from (10, 0) to (20, 0)
  ring.push_back({30, 30});                          // dust
  io::ScanBlankOptions options;
  options.scan.uncertainty = 0.005;
  options.scan.drop_outliers = 5;
  const auto made = io::read_scan_blank(scan_files::text(ring), "b.csv", options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(made->blank.proved());
  ASSERT_EQ(made->unknown.size(), 1U);
  EXPECT_EQ(made->unknown[0], "b.csv: not measured: from line 11 (10, 0) to line 12 (20, 0), 10 mm");
  ASSERT_EQ(made->dropped.size(), 1U);
  EXPECT_EQ(made->dropped[0], "b.csv: left out: line 192 (30, 30)");
}

TEST(ScanBlank, ErrorsOfTheGeometryNameTheFile) {
  const auto made = io::read_scan_blank("0 0\n1 0\n", "c.csv", {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message.rfind("c.csv: ", 0), 0U) << made.error().message;
  io::ScanBlankOptions options;
  options.scan.uncertainty = -1;
  const auto usage = io::read_scan_blank("0 0\n1 0\n1 1\n", "c.csv", options);
  ASSERT_FALSE(usage);
  EXPECT_EQ(usage.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace lekalo::io_scan_test
