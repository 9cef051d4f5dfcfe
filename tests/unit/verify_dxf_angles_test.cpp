// Angles of DXF drawings as the checker reads them.

#include <gtest/gtest.h>

#include <string>

#include "verify/origin/drawing.hpp"

namespace lekalo::verify::verify_dxf_angles_test {
namespace {

std::string drawing_of(const std::string& entity) {
  return "0\nSECTION\n2\nENTITIES\n" + entity + "0\nENDSEC\n0\nEOF\n";
}
std::string arc_to(const std::string& degrees) {
  return drawing_of("0\nARC\n8\n0\n10\n5\n20\n7\n40\n3\n50\n0\n51\n" + degrees + "\n");
}
std::string ellipse_to(const std::string& angle) {
  return drawing_of("0\nELLIPSE\n8\n0\n10\n1\n20\n1\n11\n4\n21\n0\n40\n0.5\n41\n0\n42\n" + angle + "\n");
}

std::vector<CurvePiece> pieces_of(const std::string& bytes) {
  const auto drawing = read_dxf_drawing({"d.dxf", bytes}, LengthUnit::millimetre, 0.01);
  EXPECT_TRUE(drawing) << drawing.error().message;
  if (!drawing || drawing->curves.size() != 1) return {};
  return drawing->curves[0].pieces;
}

void expect_near(const Span& a, const Span& b) {
  EXPECT_LE(a.low, b.high + 1e-9);
  EXPECT_GE(a.high, b.low - 1e-9);
}

TEST(VerifyDxfAngles, TurnsMoreOrLessMakeNoOtherArc) {
  const auto quarter = pieces_of(arc_to("90"));
  ASSERT_FALSE(quarter.empty());
  for (const char* degrees : {"450", "-270", "3600000000000090", "-3599999999999910"}) {
    const auto pieces = pieces_of(arc_to(degrees));
    ASSERT_EQ(pieces.size(), quarter.size()) << degrees;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      expect_near(pieces[i].side.to.x, quarter[i].side.to.x);
      expect_near(pieces[i].side.to.y, quarter[i].side.to.y);
    }
  }
  for (const char* degrees : {"0", "360", "-720"})
    EXPECT_FALSE(pieces_of(arc_to(degrees)).empty()) << degrees;
}

/// Turns were once taken off one after the other, which for such an angle never ended.
TEST(VerifyDxfAngles, AnAngleWithThreeHundredDigitsIsReadAtOnce) {
  EXPECT_FALSE(pieces_of(arc_to("6.28311e308")).empty());
  EXPECT_FALSE(pieces_of(ellipse_to("6.28311e308")).empty());
  EXPECT_FALSE(pieces_of(ellipse_to("-6.28311e308")).empty());
}

}  // namespace
}  // namespace lekalo::verify::verify_dxf_angles_test
