#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "support/drawn_text.hpp"
#include "verify/origin/scan_points.hpp"

/// What the checker's own reader of scans takes a file of points for.
namespace lekalo::verify::verify_scan_points_test {
namespace {

using cases::drawn_point;

std::string read(const std::string& name, const std::string& bytes, LengthUnit unit = LengthUnit::millimetre,
                 const std::optional<Slice>& slice = {}) {
  const auto points = read_scan_points({name, bytes}, unit, slice);
  if (!points) return points.error().message;
  std::string text;
  for (std::size_t k = 0; k < points->at.size(); ++k) {
    for (const std::size_t start : points->contour_starts)
      if (start == k) text += "| ";
    text += drawn_point(points->at[k]) + " ";
  }
  return text;
}
std::string ply(const std::string& header, const std::string& rows, const std::optional<Slice>& slice = {}) {
  return read("s.ply", "ply\n" + header + "end_header\n" + rows, LengthUnit::millimetre, slice);
}
const std::string kAscii = "format ascii 1.0\n", kXy = "property float x\nproperty float y\n";

/// The bytes of a number, the least first.
template <class T>
std::string little(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}
template <class T>
std::string big(T value) {
  const std::string bytes = little(value);
  return {bytes.rbegin(), bytes.rend()};
}

TEST(VerifyScanPoints, TextHasContoursBetweenEmptyLines) {
  EXPECT_EQ(read("s.csv", "1,2\n3 4\n\n5 6\n7 8 9\n"), "| 1,2 3,4 | 5,6 7,8 ");
  EXPECT_EQ(read("s.csv", "1,2\n", LengthUnit::inch), "| 25.4,50.8 ");
  EXPECT_EQ(read("s.csv", "0,-2\n", LengthUnit::inch), "| 0,-50.8 ");
}

TEST(VerifyScanPoints, ASliceHasThePointsNearItsHeightInOneContour) {
  const Slice slice{Decimal{5, 0}, Decimal{2, 0}};
  const std::string rows = "1 1 5\n2 2 6\n3 3 4\n\n4 4 6.001\n5 5 3.999\n6 6 4.5\n";
  EXPECT_EQ(read("s.csv", rows, LengthUnit::millimetre, slice), "| 1,1 2,2 3,3 6,6 ");
  EXPECT_EQ(read("s.csv", "1 1 1\n2 2 0.2\n\n3 3 0.2", LengthUnit::inch, slice), "| 50.8,50.8 76.2,76.2 ");
  EXPECT_EQ(read("s.csv", "1 1 5\n2 2\n", LengthUnit::millimetre, slice),
            "s.csv:2: no z on this line, but there is a slice");
}

TEST(VerifyScanPoints, APlyIsReadByItsHeader) {
  const std::string vertex = "element vertex 2\n";
  EXPECT_EQ(ply(kAscii + vertex + kXy, "1 2\n3 4\n"), "| 1,2 3,4 ");
  EXPECT_EQ(ply(kAscii + "comment by hand\n\nobj_info none\n" + vertex + kXy, "1 2\n3 4"), "| 1,2 3,4 ");
  EXPECT_EQ(
      ply(kAscii + vertex + "property float y\nproperty uchar red\nproperty float x\n", "1 2 3\n4 5 6\n"),
      "| 3,1 6,4 ");
  EXPECT_EQ(ply(kAscii + "element camera 2\nproperty float x\n" + vertex + kXy, "7\n8\n1 2\n3 4\n"),
            "| 1,2 3,4 ");
  EXPECT_EQ(ply(kAscii + vertex + kXy + "element face 1\nproperty list uchar int vertex_index\n",
                "1 2\n3 4\n3 0 1 1\n"),
            "| 1,2 3,4 ");
  EXPECT_EQ(ply(kAscii + "element vertex 0\n" + kXy, ""), "");
  EXPECT_EQ(ply("element vertex 1\n" + kXy + kAscii, "1 2\n"), "| 1,2 ");
  EXPECT_EQ(ply(kAscii + "element vertex 1e0\n" + kXy, "\t 1\t2 \r\n"), "| 1,2 ");
}

TEST(VerifyScanPoints, APlyInSpaceIsSliced) {
  const Slice slice{Decimal{5, 0}, Decimal{2, 0}};
  const std::string xyz = kXy + "property float z\n";
  EXPECT_EQ(ply(kAscii + "element vertex 3\n" + xyz, "1 2 5\n3 4 7\n5 6 4\n", slice), "| 1,2 5,6 ");
  EXPECT_EQ(ply(kAscii + "element vertex 1\n" + kXy, "1 2\n", slice),
            "s.ply: its vertices lack x, y or a z for the slice");
  EXPECT_EQ(ply(kAscii + "element vertex 1\n" + xyz, "1 2 x\n"), "| 1,2 ");
  EXPECT_EQ(ply(kAscii + "element vertex 1\n" + xyz, "1 2 x\n", slice),
            "s.ply: vertex 0 has a coordinate that is no number");
}

TEST(VerifyScanPoints, BinaryNumbersAreThoseOfTheirType) {
  const auto binary = [](bool turned, const std::string& type, const std::string& bytes) {
    return ply(std::string("format binary_") + (turned ? "big" : "little") +
                   "_endian 1.0\nelement vertex 1\nproperty " + type + " x\nproperty " + type + " y\n",
               bytes);
  };
  const auto both = [&](const std::string& first, const std::string& second, auto x, auto y) {
    const std::string small = binary(false, first, little(x) + little(y));
    EXPECT_EQ(binary(true, second, big(x) + big(y)), small);
    return small;
  };
  EXPECT_EQ(both("char", "int8", std::int8_t{-128}, std::int8_t{127}), "| -128,127 ");
  EXPECT_EQ(both("uchar", "uint8", std::uint8_t{128}, std::uint8_t{255}), "| 128,255 ");
  EXPECT_EQ(both("short", "int16", std::int16_t{-32768}, std::int16_t{258}), "| -3.277e+04,258 ");
  EXPECT_EQ(both("ushort", "uint16", std::uint16_t{32768}, std::uint16_t{258}), "| 3.277e+04,258 ");
  EXPECT_EQ(both("int", "int32", std::int32_t{-2}, std::int32_t{66051}), "| -2,6.605e+04 ");
  EXPECT_EQ(both("uint", "uint32", std::uint32_t{4294967295U}, std::uint32_t{7}), "| 4.295e+09,7 ");
  EXPECT_EQ(both("float", "float32", 1.5F, -2.25F), "| 1.5,-2.25 ");
  EXPECT_EQ(both("double", "float64", 1e300, -0.1), "| 1e+300,-0.1 ");
  for (const double no : {1.1e300, -1.1e300, std::nan("")})
    EXPECT_EQ(binary(false, "double", little(no) + little(0.0)),
              "s.ply: vertex 0 has a coordinate that is no number");
  EXPECT_EQ(binary(false, "double", little(1.0) + little(0.0).substr(1)), "s.ply: it ends within its rows");
}

TEST(VerifyScanPoints, RowsBeforeTheVerticesAreSteppedOver) {
  const std::string head = "format binary_little_endian 1.0\n", tail = "element vertex 1\n" + kXy;
  const std::string point = little(1.0F) + little(2.0F);
  EXPECT_EQ(
      ply(head + "element a 2\nproperty double t\nproperty short s\n" + tail, std::string(20, 'x') + point),
      "| 1,2 ");
  EXPECT_EQ(
      ply(head + "element a 2\nproperty list uchar short s\n" + tail, std::string("\2abcd\1ef") + point),
      "| 1,2 ");
  EXPECT_EQ(ply(head + "element a 1\nproperty list char short s\n" + tail, std::string(1, '\0') + point),
            "| 1,2 ");
  EXPECT_EQ(ply(head + "element a 1\nproperty list char short s\n" + tail, "\xFF" + point),
            "s.ply: it ends within its rows");
  EXPECT_EQ(ply(head + "element a 1\nproperty list uchar short s\n" + tail, std::string("\5") + point),
            "s.ply: it ends within its rows");
  EXPECT_EQ(ply(head + "element a 1\nproperty list uchar short s\n" + tail, std::string("\4") + point),
            "s.ply: it ends within its rows");
  EXPECT_EQ(
      ply(head + "element a 1\nproperty list uchar short s\nelement vertex 0\n" + kXy, std::string("\2abcd")),
      "");
  EXPECT_EQ(ply(head + "element a 1000000000000\nproperty float s\n" + tail, point),
            "s.ply: it ends within its rows");
  EXPECT_EQ(ply(head + "element a 1\nproperty list uint short s\n" + tail, "ab"),
            "s.ply: it ends within its rows");
  EXPECT_EQ(ply(head + "element a 3\nproperty double s\n" + tail, point), "s.ply: it ends within its rows");
  EXPECT_EQ(ply(kAscii + "element a 3\nproperty double s\n" + tail, "1\n2\n"),
            "s.ply: it ends within its rows");
  EXPECT_EQ(ply(kAscii + tail, "1\n"), "s.ply: it ends within its rows");
  EXPECT_EQ(ply(kAscii + tail, "1 2 3\n"), "s.ply: it ends within its rows");
  EXPECT_EQ(ply(kAscii + tail, ""), "s.ply: it ends within its rows");
}

TEST(VerifyScanPoints, AHeaderSaysWhatIsWrongAndWhere) {
  const std::string at = "s.ply:";
  EXPECT_EQ(read("s.ply", "plx\n"), at + "1: it does not begin with the line ply");
  EXPECT_EQ(read("s.ply", "ply x\n"), at + "1: it does not begin with the line ply");
  EXPECT_EQ(read("s.ply", "\n"), at + "1: it does not begin with the line ply");
  EXPECT_EQ(read("s.ply", "ply\n"), "s.ply: the header does not end");
  EXPECT_EQ(ply("", ""), at + "2: the header has no format");
  EXPECT_EQ(ply("format text 1.0\n", ""), at + "2: \"text\" is no format");
  EXPECT_EQ(ply(kAscii + kAscii, ""), at + "3: the header has a line that is not known: format ascii 1.0");
  EXPECT_EQ(ply("format ascii\n", ""), at + "2: the header has a line that is not known: format ascii");
  EXPECT_EQ(ply(kAscii + "element vertex\n", ""),
            at + "3: the header has a line that is not known: element vertex");
  EXPECT_EQ(ply(kAscii + "property float x\n", ""),
            at + "3: the header has a line that is not known: property float x");
  for (const char* count : {"x", "-1", "1.5", "1e13"})
    EXPECT_EQ(ply(kAscii + "element vertex " + count + "\n", ""), at + "3: an element without a count")
        << count;
  const std::string element = kAscii + "element vertex 1\n";
  for (const char* type : {"real x", "list real int x", "list int real x"})
    EXPECT_EQ(ply(element + "property " + type + "\n", ""), at + "4: a property of no known type") << type;
  for (const char* words : {"property x", "property float x y", "property array int int x",
                            "property list int int int x", "strange", "strange float x"})
    EXPECT_EQ(ply(element + words + "\n", ""), at + "4: the header has a line that is not known: " + words);
  EXPECT_EQ(ply(element + kXy + "property list uchar int n\n", "1 2 0\n"), "s.ply: its vertices have lists");
  EXPECT_EQ(ply(element + "property float x\n", "1\n"), "s.ply: its vertices lack x, y or a z for the slice");
  EXPECT_EQ(ply(element + "property float y\n", "1\n"), "s.ply: its vertices lack x, y or a z for the slice");
  EXPECT_EQ(ply(kAscii + "element face 0\n", ""), "s.ply: it has no element vertex");
}

}  // namespace
}  // namespace lekalo::verify::verify_scan_points_test
