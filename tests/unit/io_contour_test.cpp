#include <gtest/gtest.h>

#include "lekalo/geom/predicates.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "support/io_contours.hpp"

namespace lekalo::io_contour_test {
namespace {

using Indices = std::vector<std::size_t>;

io::ContourFile read(const std::string& bytes, const std::string& name = "a.csv",
                     std::optional<LengthUnit> unit = std::nullopt) {
  auto file = io::parse_contour(bytes, name, unit);
  EXPECT_TRUE(file.has_value()) << file.error().message;
  return file ? *std::move(file) : io::ContourFile{};
}

const geom::Ring kTriangle{{0, 0}, {12.5, 0}, {-3, 1e-3}};

TEST(IoText, ReadsEveryWayToWriteAPoint) {
  for (const char* text : {
           "0,0\n12.5,0\n-3,1e-3\n",                          // comma
           "0;0\n12.5;0\n-3;1e-3",                            // semicolon, no last line end
           "0 0\n12.5 0\n-3 1e-3\n",                          // blank
           "0\t0\r\n12.5\t0\r\n-3\t1e-3\r\n",                 // tab, line ends of Windows
           "  0 , 0 \n\n\t12.5 ,0\n -3, 0.001\n",             // blanks around, empty line
           "x,y\n0,0\n12.5,0\n-3,0.001\n",                    // header
           "\"X [mm]\";\"Y [mm]\"\n0;0\n12.5;0\n-3;0.001\n",  // header of a spreadsheet
           "Messpunkte Rohteil\n0 0\n12.5 0\n-3 .001\n",      // header of words
           "Part 12\n0 0\n+12.5 +0.\n-3 .001\n",              // header with a number of one field
           "# c\n; c\n// c\n% c\n0 0 # here\n12.5 0#\n  # c\n-3 1E-03\n",  // comments
           "\xef\xbb\xbf"
           "0,0\n1.25e+1,0\n-300e-2,0.001\n",      // byte order mark
           "-0,0e5\n0012.500,-0.0\n-3,1000e-6\n",  // zeros
       }) {
    if (std::string(text).find("Part 12") == 0) continue;  // see AHeaderThatCouldBeAPointIsRefused
    for (const char* name : {"a.csv", "dir.x/A.TXT", "b.Xyz"}) {
      EXPECT_EQ(read(text, name).points, kTriangle) << text;
    }
  }
}

TEST(IoText, AHeaderThatCouldBeAPointIsRefused) {
  EXPECT_FALSE(io::parse_contour("Part 12\n0 0\n", "a.txt", std::nullopt).has_value());
  const auto file = read("Part 12 contour scan\n0 0\n", "a.txt");
  ASSERT_EQ(file.notices.size(), 1U);
  EXPECT_NE(file.notices[0].find("line 1 is taken for a header"), std::string::npos);
  EXPECT_TRUE(read("x,y\n0,0\n").notices.empty());
}

TEST(IoText, AThirdNumberIsIgnoredWithANotice) {
  const auto file = read("0 0 7\n12.5 0 7\n-3 0.001\n", "a.xyz");
  EXPECT_EQ(file.points, kTriangle);
  ASSERT_EQ(file.notices.size(), 1U);
  EXPECT_NE(file.notices[0].find("third number of 2 lines"), std::string::npos);
}

TEST(IoText, PlacesAreLines) { EXPECT_EQ(read("# c\nx,y\n0,0\n\n1,0\n").places, (Indices{3, 5})); }

TEST(IoJson, ReadsEveryForm) {
  for (
      const char* text : {
          "[[0,0],[12.5,0],[-3,0.001]]",
          "\xef\xbb\xbf [ [0, 0],\n [1.25e1, -0], [-3.0, 1e-3] ]\r\n",
          R"({"points": [[0,0],[12.5,0],[-3,0.001]], "units": "mm", "name": "p", "date": 7, "ok": true, "by": null})",
          R"({"units": "mm", "outer": [{"line": {"from": [0,0], "to": [12.5,0]}},
               {"line": {"to": [-3,0.001], "from": [12.5,0]}}, {"line": {"from": [-3,0.001], "to": [0,0]}}], "holes": []})",
          R"({"islands": [], "outer": [{"line": {"from": [0,0], "to": [12.5000009,0]}},
               {"line": {"from": [12.5,0], "to": [-3,0.001]}}, {"line": {"from": [-3,0.001], "to": [0,0]}}]})",
      }) {
    const auto file = read(text, "a.JSON");
    EXPECT_EQ(file.points, kTriangle) << text;
    EXPECT_EQ(file.places, (Indices{0, 1, 2}));
  }
}

TEST(IoUnits, InchesAreScaledExactlyWhereverTheFileSaysSo) {
  const geom::Ring inches{{25.4, 0}, {0.254, 2.54}};
  EXPECT_EQ(read("1 0\n0.01 0.1\n", "a.csv", LengthUnit::inch).points, inches);
  EXPECT_EQ(read("[[1,0],[0.01,0.1]]", "a.json", LengthUnit::inch).points, inches);
  EXPECT_EQ(read(R"({"points": [[1,0],[0.01,0.1]], "units": "inch"})", "a.json").points, inches);
  EXPECT_EQ(read(R"({"units": "inch", "points": [[1,0],[0.01,0.1]]})", "a.json", LengthUnit::inch).points,
            inches);
  EXPECT_EQ(read(R"({"points": [[25.4,0],[0.254,2.54]], "units": "mm"})", "a.json").points, inches);
  const std::string drawn = "0\nLWPOLYLINE\n70\n1\n10\n1\n20\n0\n10\n0.01\n20\n0.1\n";
  for (const char* code : {"1", "     1"}) {
    const std::string header =
        std::string("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n 70\n") + code + "\n0\nENDSEC\n";
    const auto file = read(header + io_cases::dxf_entities(drawn), "a.dxf");
    EXPECT_EQ(file.points, inches);
    EXPECT_EQ(file.unit, LengthUnit::inch);
  }
  for (const char* header : {"", "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n0\n0\nENDSEC\n"}) {
    EXPECT_EQ(read(header + io_cases::dxf_entities(drawn), "a.dxf", LengthUnit::inch).points, inches);
    EXPECT_EQ(read(header + io_cases::dxf_entities(drawn), "a.dxf").points,
              (geom::Ring{{1, 0}, {0.01, 0.1}}));
  }
}

TEST(IoError, IsZeroOnlyForDecimalsThatAreDoubles) {
  EXPECT_EQ(read("1 2\n-3.5 0.125\n1e6 999999999.96875\n").coordinate_error, 0);
  EXPECT_EQ(read("0.5000000000000000000000 1500e-3\n").coordinate_error, 0);
  EXPECT_EQ(read("10 5\n", "a.csv", LengthUnit::inch).coordinate_error, 0);       // 254, 127
  EXPECT_EQ(read("1 5\n", "a.csv", LengthUnit::inch).coordinate_error, 0x1p-49);  // 25.4: ulp 2^-48
  EXPECT_EQ(read("0.1 2\n").coordinate_error, 0x1p-57);                           // ulp of 0.1: 2^-56
  EXPECT_EQ(read("0.1 200.7\n").coordinate_error, 0x1p-46);                       // ulp of 200.7: 2^-45
  EXPECT_EQ(read("200 0.1\n").coordinate_error, 0x1p-57);                         // the large one is exact
  EXPECT_EQ(read("9007199254740993e-9 0\n").coordinate_error, 0x1p-30);
  EXPECT_EQ(read("1e-200 0\n").coordinate_error, 1e-100);
  EXPECT_EQ(read("1e-200 0\n").points[0].x, 0);
  EXPECT_EQ(read("0e999999999999999999999 1\n").points[0].x, 0);
}

TEST(IoDxf, ReadsOneClosedPolylineAndSkipsTheRest) {
  const std::string body =
      "0\r\nLWPOLYLINE\r\n  5\r\n1F\r\n100\r\nAcDbEntity\r\n  8\r\nCUT\r\n100\r\nAcDbPolyline\r\n 90\r\n     "
      "   3\r\n"
      " 70\r\n     1\r\n 43\r\n0.0\r\n 10\r\n0.0\r\n 20\r\n0.0\r\n 42\r\n0.0\r\n 10\r\n12.5\r\n 20\r\n0.0\r\n"
      " 10\r\n-3.0\r\n "
      "20\r\n0.001\r\n210\r\n0.0\r\n220\r\n0.0\r\n230\r\n1.0\r\n1001\r\nACAD\r\n1010\r\n7.0\r\n";
  const std::string text =
      "999\r\nwritten by a test\r\n  0\r\nSECTION\r\n  2\r\nHEADER\r\n  9\r\n$ACADVER\r\n  1\r\nAC1015\r\n  "
      "9\r\n"
      "$INSUNITS\r\n 70\r\n     4\r\n  0\r\nENDSEC\r\n  0\r\nSECTION\r\n  2\r\nBLOCKS\r\n  0\r\nBLOCK\r\n  "
      "8\r\n0\r\n"
      "  0\r\nARC\r\n 10\r\n0.0\r\n  0\r\nENDBLK\r\n  0\r\nENDSEC\r\n  0\r\nSECTION\r\n  2\r\nENTITIES\r\n" +
      body +
      "  0\r\nENDSEC\r\n  0\r\nSECTION\r\n  2\r\nOBJECTS\r\n  0\r\nDICTIONARY\r\n  0\r\nENDSEC\r\n  "
      "0\r\nEOF\r\n\r\n";
  const auto file = read(text, "A.DXF", LengthUnit::millimetre);
  EXPECT_EQ(file.points, kTriangle);
  EXPECT_TRUE(file.places_are_lines);
  EXPECT_EQ(file.places.size(), 3U);
  // Closed by its last point instead of the flag.
  const auto closed =
      read(io_cases::dxf_entities(io_cases::polyline({{0, 0}, {9, 0}, {0, 9}, {0, 0}}, 0, 128)), "a.dxf");
  EXPECT_EQ(io::make_convex(closed)->dropped, (Indices{3}));
}

TEST(IoDxf, ChainsLinesAsTheyLie) {
  using io_cases::line;
  const auto file = read(io_cases::dxf_entities(line({0, 0}, {10, 0}, 0) + line({0, 10}, {0, 0}, 0) +
                                                line({0, 10}, {10, 10}, 0) + line({10, 0}, {10, 10}, 0)),
                         "a.dxf");
  EXPECT_EQ(file.points, (geom::Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  EXPECT_EQ(file.places, (Indices{6, 54, 38, 22}));
}

TEST(IoDxf, ChainsLinesUpToAMillionthOfAUnitApart) {
  using io_cases::line;
  const auto chain = [](std::int64_t gap, std::optional<LengthUnit> unit) {
    // Millionths: 1000.1 + gap, where neither end is a double.
    return io::parse_contour(io_cases::dxf_entities(line({0, 0}, {1'000'100'000, 0}, 6) +
                                                    line({1'000'100'000 + gap, 0}, {0, 500'000'000}, 6) +
                                                    line({0, 500'000'000}, {0, 0}, 6)),
                             "a.dxf", unit);
  };
  for (const std::int64_t gap : {-1, 0, 1}) {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::inch}) {
      const auto file = chain(gap, unit);
      ASSERT_TRUE(file.has_value()) << file.error().message;
      EXPECT_NEAR(file->points[1].x / millimetres_per(unit), 1000.1 + 1e-6 * static_cast<double>(gap), 1e-12);
    }
  }
  EXPECT_FALSE(chain(2, LengthUnit::millimetre).has_value());
  EXPECT_FALSE(chain(-2, LengthUnit::inch).has_value());
}

TEST(IoDxf, TheNearestEndContinuesAChainAndAmongEqualsTheFirst) {
  using io_cases::line;
  // From (1, 0): line 3 begins there exactly, line 2 half a millionth away.
  const auto nearest = read(
      io_cases::dxf_entities(line({0, 0}, {10'000'000, 0}, 7) + line({10'000'005, 0}, {0, 10'000'000}, 7) +
                             line({10'000'000, 0}, {10'000'005, 0}, 7) + line({0, 10'000'000}, {0, 0}, 7)),
      "a.dxf");
  EXPECT_EQ(nearest.places, (Indices{6, 38, 22, 54}));
  // A line of no length and the next side both begin at (1, 0): the first in the file is next, and then the
  // line of no length is left over.
  const std::string first = line({0, 0}, {1, 0}, 0), point = line({1, 0}, {1, 0}, 0);
  const std::string rest = line({1, 0}, {0, 1}, 0) + line({0, 1}, {0, 0}, 0);
  EXPECT_EQ(read(io_cases::dxf_entities(first + point + rest), "a.dxf").places, (Indices{6, 22, 38, 54}));
  EXPECT_FALSE(
      io::parse_contour(io_cases::dxf_entities(first + rest + point), "a.dxf", std::nullopt).has_value());
}

TEST(IoDxf, HeightsAreIgnoredWithANotice) {
  std::string text =
      io_cases::dxf_entities(io_cases::line({0, 0}, {1, 0}, 0) + io_cases::line({1, 0}, {0, 1}, 0) +
                             io_cases::line({0, 1}, {0, 0}, 0));
  EXPECT_TRUE(read(text, "a.dxf").notices.empty());
  text.replace(text.find("30\n0.0"), 6, "30\n5.0");
  EXPECT_EQ(read(text, "a.dxf").notices.size(), 1U);
}

// --------------------------------------------------------------------------------------------------------
// convex

TEST(IoConvex, MapsEdgesToTheFileInBothDirections) {
  // 0 and its copy 1, collinear 3, copy 6 of the first at the end.
  const auto forward = io::make_convex(read("0 0\n0 0\n10 0\n10 5\n10 10\n0 10\n0 0\n"));
  ASSERT_TRUE(forward.has_value());
  EXPECT_FALSE(forward->reversed);
  EXPECT_EQ(forward->dropped, (Indices{1, 3, 6}));
  EXPECT_EQ(forward->file_index_of_vertex, (Indices{0, 2, 4, 5}));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(forward->file_edge(k), forward->file_index_of_vertex[k]);

  const auto backward = io::make_convex(read("0 0\n0 10\n10 10\n10 5\n10 0\n0 0\n0 0\n"));
  ASSERT_TRUE(backward.has_value());
  EXPECT_TRUE(backward->reversed);
  EXPECT_EQ(backward->dropped, (Indices{3, 5, 6}));
  EXPECT_EQ(backward->file_index_of_vertex.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    // The edge from (10, 0) to (10, 10) of the polygon is 2 -> 4 in the file.
    const geom::Point from = backward->polygon[k];
    const std::size_t expected = from == geom::Point{0, 0}     ? 4U
                                 : from == geom::Point{10, 0}  ? 2U
                                 : from == geom::Point{10, 10} ? 1U
                                                               : 0U;
    EXPECT_EQ(backward->file_edge(k), expected);
  }
}

TEST(IoConvex, TheFirstPointMayItselfBeCollinear) {
  const auto contour = io::make_convex(read("5 0\n10 0\n10 10\n0 10\n0 0\n"));
  ASSERT_TRUE(contour.has_value());
  EXPECT_EQ(contour->dropped, (Indices{0}));
  EXPECT_EQ(contour->file_index_of_vertex, (Indices{1, 2, 3, 4}));
  EXPECT_EQ(contour->file_edge(3), 4U);
}

TEST(IoConvex, NoticesSayHowManyPointsWereDropped) {
  const auto contour = io::make_convex(read("0 0\n0 0\n4 0\n5 0\n10 0\n10 10\n"));
  ASSERT_EQ(contour->notices.size(), 2U);
  EXPECT_EQ(contour->notices[0], "a.csv: 1 duplicate point dropped (point 1; counted from 0)");
  EXPECT_EQ(contour->notices[1], "a.csv: 2 collinear points dropped (point 2, 3; counted from 0)");
}

TEST(IoConvex, DecimalsThatAreCollinearAreDroppedAndPaidFor) {
  const auto file = read("0.1 0.3\n0.2 0.6\n0.3 0.9\n-5 2\n");
  ASSERT_NE(geom::orientation(file.points[0], file.points[1], file.points[2]), 0)
      << "not collinear as doubles";
  const auto contour = io::make_convex(file);
  ASSERT_TRUE(contour.has_value());
  EXPECT_EQ(contour->dropped, (Indices{1}));
  EXPECT_GT(contour->coordinate_error, file.coordinate_error);
  EXPECT_LE(contour->coordinate_error, 4 * file.coordinate_error);
  const auto exact = io::make_convex(read("0 0\n1 3\n2 6\n-5 2\n"));
  EXPECT_EQ(exact->dropped, (Indices{1}));
  EXPECT_EQ(exact->coordinate_error, 0);
}

TEST(IoConvex, NearbyTwinsOfOneCornerDoNotHideTheContour) {
  // The corner lowest in (x, y) has a twin on either side, each within the rounding of the others.
  const auto contour =
      io::make_convex(read("0.1 0.2\n0.10000000000000001 0.20000000000000004\n1000.3 0.1\n700.7 "
                           "900.3\n0.10000000000000002 0.20000000000000007\n"));
  ASSERT_TRUE(contour.has_value()) << contour.error().message;
  EXPECT_EQ(contour->polygon.size(), 3U);
}

// ----------------------------------------------------------------------------------------------------------
// trim

TEST(IoTrim, MovesAnEdgeInByItsDeepestDent) {
  for (const char* text : {"0 0\n50 1\n100 0\n100 60\n0 60\n", "0 60\n100 60\n100 0\n50 1\n0 0\n"}) {
    const auto trimmed = io::trim_to_convex(read(text), 1);
    ASSERT_TRUE(trimmed.has_value()) << trimmed.error().message;
    const geom::Box box = geom::bounds(trimmed->polygon.vertices());
    EXPECT_EQ(trimmed->polygon.size(), 4U);
    EXPECT_NEAR(box.low.y, 1, 1e-12);
    EXPECT_GE(box.low.y, 1);
    EXPECT_NEAR(box.low.x, 0, 1e-12);
    EXPECT_NEAR(box.high.x, 100, 1e-12);
    EXPECT_NEAR(box.high.y, 60, 1e-12);
    EXPECT_GE(trimmed->loss, 1);
    EXPECT_NEAR(trimmed->loss, 1, 1e-12);
    ASSERT_EQ(trimmed->notices.size(), 1U);
    EXPECT_NE(trimmed->notices[0].find("at most 1 mm"), std::string::npos) << trimmed->notices[0];
  }
}

TEST(IoTrim, RefusesADeeperDentNamingIt) {
  const auto trimmed = io::trim_to_convex(read("0 0\n40 0.5\n50 1.5\n100 0\n100 60\n0 60\n"), 1);
  ASSERT_FALSE(trimmed.has_value());
  EXPECT_NE(trimmed.error().message.find("point 2 (line 3: 50, 1.5 mm) lies 1.5 mm inside"),
            std::string::npos)
      << trimmed.error().message;
  EXPECT_NE(trimmed.error().message.find("--trim 1 is not enough"), std::string::npos);
}

TEST(IoTrim, LeavesTheBackOfAnOpenFrame) {
  const auto frame = io::trim_to_convex(read("0 0\n100 0\n100 60\n0 60\n0 59\n99 59\n99 1\n0 1\n"), 1000);
  ASSERT_TRUE(frame.has_value());
  const geom::Box box = geom::bounds(frame->polygon.vertices());
  EXPECT_NEAR(box.low.x, 99, 1e-12);
  EXPECT_NEAR(box.high.y, 60, 1e-12);
}

TEST(IoTrim, RefusesWhatHasNoConvexInside) {
  const auto star =
      io::trim_to_convex(read("0 0\n50 40\n100 0\n60 50\n100 100\n50 60\n0 100\n40 50\n"), 1000);
  EXPECT_TRUE(star.has_value()) << star.error().message;
  const auto deep = io::trim_to_convex(read("0 0\n50 55\n100 0\n100 100\n60 50\n0 100\n"), 1000);
  ASSERT_FALSE(deep.has_value());
  EXPECT_NE(deep.error().message.find("nothing convex is left"), std::string::npos) << deep.error().message;
  for (const char* crossing : {"0 10\n6 -8\n-9.5 3\n9.5 3\n-6 -8\n", "0 0\n10 10\n10 0\n0 10\n"}) {
    EXPECT_FALSE(io::trim_to_convex(read(crossing), 1000).has_value());
  }
}

TEST(IoTrim, RefusesToleranceThatIsNone) {
  const auto file = read("0 0\n1 0\n0 1\n");
  for (const double tolerance :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto trimmed = io::trim_to_convex(file, tolerance);
    ASSERT_FALSE(trimmed.has_value());
    EXPECT_EQ(trimmed.error().code, ErrorCode::usage);
  }
  EXPECT_TRUE(io::trim_to_convex(file, 0).has_value());
}

}  // namespace
}  // namespace lekalo::io_contour_test
