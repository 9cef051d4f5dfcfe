#include "report_parts.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "draw/paper/colour.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {

double draw_report_header(const std::string& title, const std::string& subtitle, const std::string& status,
                          Sheet& sheet) {
  const Rect& frame = kReportFrame;
  const double badge = 3.4 * kReportBoldWider * io::text_width(status) + 5;
  const double left = frame.right() - badge;
  sheet.path(Rect{left, frame.y, badge, 6.4}.ring(), true, filled(colour_of_status(status)), "status-box");
  sheet.text(left + badge / 2, frame.y + 4.5, badge - 4, status,
             {.size = 3.4, .colour = kPaper, .anchor = Anchor::middle, .bold = true, .kind = "status"});
  const double room = left - frame.x - 4;
  sheet.text(frame.x, frame.y + 4.8, room, title, {.size = 5, .bold = true, .kind = "title"});
  sheet.text(frame.x, frame.y + 9.6, frame.width, subtitle,
             {.size = 3.4, .colour = kGrey, .kind = "subtitle"});
  return frame.y + 12;
}

void draw_report_footer(const std::string& made, Sheet& sheet) {
  const Rect& frame = kReportFrame;
  sheet.text(frame.x, frame.bottom(), frame.width / 2, std::string("lekalo ") + kVersion,
             {.size = kReportSmall, .colour = kGrey, .kind = "version"});
  sheet.text(frame.right(), frame.bottom(), frame.width / 2, made,
             {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::end, .kind = "method"});
}

double draw_proof(const std::vector<std::string>& sentences, const Rect& column, double top, Sheet& sheet) {
  double y = sheet.heading(column, top, "What is proved") + kReportSmall + 0.8;
  for (const std::string& sentence : sentences)
    y = sheet.paragraph(column, y, sentence, {.size = kReportSmall, .kind = "proof"}, kReportSmallLine, 6) +
        0.4;
  return y - kReportSmall;
}

double draw_inputs(const std::vector<ReportFile>& files, const Rect& column, double top, Sheet& sheet) {
  double y = sheet.heading(column, top, "Input files and SHA-256 of their bytes");
  for (const ReportFile& file : files) {
    y += kReportLine;
    // A digest of 64 hexadecimal digits must not be shortened. The digits are at most 0.66 of the size wide.
    constexpr double kDigestSize = 1.95, kDigest = 64 * 0.66 * kDigestSize + 1, kRole = 17;
    sheet.text(column.x, y - 1, kRole - 1, file.role, {.size = kReportSmall, .colour = kGrey});
    sheet.text(column.x + kRole, y - 1, column.width - kRole - kDigest - 2, file.words,
               {.size = kReportSmall, .kind = "input"});
    sheet.text(column.right(), y - 1, kDigest, file.sha256,
               {.size = kDigestSize, .colour = kGrey, .anchor = Anchor::end, .kind = "sha256"});
  }
  return y;
}

double draw_notes(const ReportNotes& notes, const Rect& column, double top, std::size_t most_lines,
                  Sheet& sheet) {
  double y = sheet.heading(column, top, "Assumptions and warnings") + kReportSmall + 0.8;
  std::size_t used = 0, left = notes.assumptions.size() + notes.warnings.size();
  const auto add = [&](const std::string& sentence, Colour colour, const char* kind) {
    // One line is kept for the sentence about those that find no room.
    const std::size_t room = most_lines - used - (left > 1 ? 1 : 0);
    if (used >= most_lines || room == 0) return;
    y = sheet.paragraph(column, y, sentence, {.size = kReportSmall, .colour = colour, .kind = kind},
                        kReportSmallLine, std::min<std::size_t>(room, 3), &used);
    --left;
  };
  for (const std::string& warning : notes.warnings) add("Note: " + warning, kInk, "warning");
  for (const std::string& sentence : notes.assumptions) add(sentence, kGrey, "assumption");
  if (left > 0) {
    sheet.text(column.x, y, column.width, fmt::format("and {} more, in the result", left),
               {.size = kReportSmall, .colour = kGrey, .kind = "more-notes"});
    y += kReportSmallLine;
  }
  y = sheet.paragraph(column, y, notes.measured,
                      {.size = kReportSmall, .colour = kGrey, .kind = "assumption"}, kReportSmallLine, 2);
  return y - kReportSmall;
}

}  // namespace lekalo::draw
