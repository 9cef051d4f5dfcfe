#pragma once

#include <string>
#include <vector>

#include "colour.hpp"
#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// Font sizes and distances of baselines of the report, mm of paper.
inline constexpr double kReportBody = 2.9, kReportSmall = 2.4, kReportLine = 4.1, kReportSmallLine = 3.3;
/// Bold letters are wider than plain ones.
inline constexpr double kReportBoldWider = 1.1;

struct TextStyle {
  double size = kReportBody;
  Colour colour = kInk;
  Anchor anchor = Anchor::start;
  bool bold = false;
  const char* kind = "";
};

/// Puts texts and rules on a page; whatever is put is made to fit the width it is given.
class Sheet {
 public:
  explicit Sheet(std::vector<Item>& items) : items_(items) {}

  /// Smaller where it would be wider than `width`, shortened where that would make it smaller than 0.8 of its
  /// size. (x is the side the anchor says.)
  void text(double x, double baseline, double width, const std::string& words, const TextStyle& style);
  /// Lines below each other from the first baseline on; returns the baseline of the next.
  double paragraph(const Rect& column, double baseline, const std::string& words, const TextStyle& style,
                   double line, std::size_t most_lines, std::size_t* used = nullptr);
  /// A bold heading over a rule; returns the y where its content begins.
  double heading(const Rect& column, double y, const std::string& words);
  void path(const geom::Ring& line, bool closed, const Paint& paint, const char* kind = "");
  void rule(double from, double to, double y);
  [[nodiscard]] std::vector<Item>& items() { return items_; }

 private:
  std::vector<Item>& items_;
};

}  // namespace lekalo::draw
