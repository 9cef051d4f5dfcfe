#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "support/drawn_curves.hpp"
#include "support/places.hpp"

// One plate as different programs draw it (data/dxf_styles/generate.py): polylines with bulges old and new,
// lines and arcs, cubic and rational splines, ellipses, mirrored blocks, mirrored planes; inches, centimetres
// and nothing said.

namespace lekalo::io_drawings_test {
namespace {

struct Style {
  const char* file;
  std::size_t curves;  ///< on layers that are not hidden
  const char* layer;
  double tolerance;  ///< mm of length and mm^2 of moments, as digits and cubics allow
};

constexpr Style kStyles[] = {
    {"autocad_r12.dxf", 9, "РЕЗ", 1e-9},   {"autocad_2018.dxf", 13, "Контур", 1e-9},
    {"librecad.dxf", 9, "Contour", 1e-6},  {"qcad_inch.dxf", 9, "CUT", 1e-9},
    {"inkscape.dxf", 12, "Ebene 1", 3e-2}, {"freecad.dxf", 9, "Sketch001", 1e-9},
    {"rhino_cm.dxf", 9, "Default", 1e-9},  {"coreldraw.dxf", 12, "Layer_1_CorelLayer_été", 3e-2},
};

TEST(IoDrawings, ThePlateIsTheSameWhicheverProgramDrewIt) {
  const double outline = 240 + 20 * M_PI, hole = 16 * M_PI;
  for (const Style& style : kStyles) {
    SCOPED_TRACE(style.file);
    const auto drawing = io::parse_dxf(
        *disk::read_file(cases::source_dir() + "/tests/corpus/data/dxf_styles/" + std::string(style.file)),
        style.file);
    ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
    drawn::Integrals total;
    std::size_t curves = 0;
    for (const io::DrawnCurve& curve : drawing->curves) {
      if (drawing->layers[curve.layer].hidden) continue;
      EXPECT_EQ(drawing->layers[curve.layer].name, style.layer);
      EXPECT_LE(curve.error, style.tolerance);
      const drawn::Integrals one = drawn::integrals(curve.shape);
      total.length += one.length;
      total.x += one.x;
      total.y += one.y;
      ++curves;
    }
    EXPECT_EQ(curves, style.curves);
    EXPECT_NEAR(total.length, outline + hole, style.tolerance);
    EXPECT_NEAR(total.x, 50 * outline + 30 * hole, 100 * style.tolerance);
    EXPECT_NEAR(total.y, 30 * outline + 30 * hole, 100 * style.tolerance);
  }
}

TEST(IoDrawings, EveryFileOfTheCorpusIsHere) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(cases::source_dir() + "/tests/corpus/data/dxf_styles")) {
    files += entry.path().extension() == ".dxf" ? 1 : 0;
  }
  EXPECT_EQ(files, std::size(kStyles));
}

}  // namespace
}  // namespace lekalo::io_drawings_test
