#pragma once

#include "draw/paper/colour.hpp"
#include "draw/paper/report_sheet.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/report.hpp"
#include "report_parts.hpp"

namespace lekalo::draw {

[[nodiscard]] Scene report_page(const Report& report);

/// The choices that all sections of the page share.
struct ReportLook {
  double least = 0, greatest = 0;  ///< allowance along the outline, mm
  ColourRange range;
  int decimals = 6;        ///< of the placement
  int table_decimals = 4;  ///< of measured lengths
};
[[nodiscard]] ReportLook look_of(const Report& report);

/// Returns 'A' to 'Z', and nothing for contacts after that, which are not marked.
[[nodiscard]] std::string contact_letter(std::size_t index);

/// Returns a length as it is printed, with its unit.
[[nodiscard]] std::string length_text(double mm, int decimals, Rounding rounding = Rounding::nearest);

/// Returns the most height that the shapes fill in a frame of this width. Part and blank may be higher than
/// wide; then it is 10 widths at most.
[[nodiscard]] double placement_height(const Report& report, double width);

/// The functions below draw the sections. Each draws from `top` downwards in its column and returns where it
/// ends.
void draw_placement(const Report& report, const ReportLook& look, const Rect& frame, Sheet& sheet);
double draw_histogram(const Report& report, const ReportLook& look, const Rect& column, double top,
                      Sheet& sheet);
double draw_numbers(const Report& report, const ReportLook& look, const Rect& column, double top,
                    Sheet& sheet);
double draw_contacts(const Report& report, const ReportLook& look, const Rect& column, double top,
                     std::size_t most_rows, Sheet& sheet);
double draw_features(const Report& report, const ReportLook& look, const Rect& column, double top,
                     std::size_t most_rows, Sheet& sheet);

}  // namespace lekalo::draw
