#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/part_text.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/marked_layouts.hpp"

/// Marks and texts of parts in any place, mirrored or not: every export holds them all, and where a pose puts
/// them.
namespace lekalo::verify::property_verify_marks_test {
namespace {

int cases_wanted() {
  const char* const said = std::getenv("LEKALO_CASES");
  return said == nullptr ? 8 : std::max(8, std::atoi(said) / 10);
}

std::string told(const Result<ClaimReport>& report) {
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}

/// The place of a point of a part on its sheet, by the definition of a placement.
geom::Point placed(geom::Point p, const layout::Placement& placement) {
  const double c = std::ldexp(static_cast<double>(placement.rotation.c), -52),
               s = std::ldexp(static_cast<double>(placement.rotation.s), -52);
  const double x = placement.mirrored ? -p.x : p.x;
  return geom::Point{c * x - s * p.y, s * x + c * p.y} + geom::mm_from_grid(placement.at);
}

TEST(MarksProperty, EveryExportHoldsEveryMarkAtItsPlace) {
  for (int i = 0; i < cases_wanted(); ++i) {
    Random random(23, static_cast<std::uint64_t>(i));
    const cases::Json json = cases::marked_layout(random, 1 + static_cast<int>(random.below(12)));
    const std::string text = json.dump();
    const auto document = io::read_layout(text, "layout");
    ASSERT_TRUE(document.has_value()) << document.error().message;
    for (const auto form : {io::ExportForm::dxf, io::ExportForm::svg, io::ExportForm::hpgl}) {
      io::ExportRequest request;
      request.form = form;
      const auto made = io::export_layout(document->document, "x", request);
      ASSERT_TRUE(made.has_value()) << made.error().message;
      EXPECT_EQ(told(verify_export({"e", made->files[0].bytes}, {"l", text}, {})), "") << i;
    }
    const auto request = io::read_export_words(io::ExportForm::gcode,
                                               {{"kerf", "0.2"},
                                                {"feed", "900"},
                                                {"engrave-feed", "900"},
                                                {"post", random.below(2) == 0 ? "fanuc" : "linuxcnc"},
                                                {"unit", random.below(2) == 0 ? "mm" : "inch"}},
                                               "");
    ASSERT_TRUE(request.has_value()) << request.error().message;
    const auto program = io::export_layout(document->document, "x", *request);
    ASSERT_TRUE(program.has_value()) << program.error().message;
    ProfileWords words;
    words.kerf_mm = 0.2;
    const auto report = verify_profile({"p.nc", program->files[0].bytes}, {"l", text}, words);
    EXPECT_EQ(told(report), "") << i;
    const std::size_t pieces = document->document.placements.size();
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->notes.back(),
              fmt::format("{} of {} lines and texts on the parts are engraved all along, and nothing else",
                          5 * pieces, 7 * pieces));
  }
}

/// The strokes of a text in a drawing are those of the part's text, placed point by point.
TEST(MarksProperty, TextsAreTurnedAndMirroredLikePoints) {
  for (int i = 0; i < cases_wanted(); ++i) {
    Random random(24, static_cast<std::uint64_t>(i));
    const auto document = io::read_layout(cases::marked_layout(random, 3).dump(), "layout");
    ASSERT_TRUE(document.has_value()) << document.error().message;
    const auto made = io::export_layout(document->document, "x", {});
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const auto drawing = io::parse_dxf(made->files[0].bytes, "x.dxf");
    ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
    std::size_t found = 0;
    for (const layout::Placement& placement : document->document.placements)
      for (const layout::PartText& text : document->document.parts[0].texts) {
        const auto wanted = layout::text_strokes(text);
        for (const io::ReadText& read : drawing->texts) {
          if (read.text != text.text || norm(read.at - placed(text.at, placement)) > 1e-6) continue;
          layout::PartText drawn = text;
          drawn.at = read.at, drawn.degrees = read.degrees, drawn.mirrored = read.mirrored;
          EXPECT_EQ(drawn.mirrored, text.mirrored != placement.mirrored);
          const auto strokes = layout::text_strokes(drawn);
          ASSERT_EQ(strokes.size(), wanted.size());
          for (std::size_t k = 0; k < strokes.size(); ++k)
            for (std::size_t p = 0; p < strokes[k].size(); ++p)
              EXPECT_LT(norm(strokes[k][p] - placed(wanted[k][p], placement)), 1e-6);
          ++found;
        }
      }
    EXPECT_EQ(found, 9U) << i;
  }
}

}  // namespace
}  // namespace lekalo::verify::property_verify_marks_test
