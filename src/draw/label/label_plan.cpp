#include "label_plan.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "draw/paper/report_sheet.hpp"
#include "lekalo/io/text/words.hpp"
#include "qr_code.hpp"

namespace lekalo::draw {
namespace {

constexpr double kLabelEdge = 1.5;      ///< of a label, where printers of labels do not print
constexpr double kLargestModule = 1;    ///< a larger code is not read from farther away by a hand-held reader
constexpr double kCodeShare = 0.6;      ///< of the label's shorter side
constexpr double kLargestLetters = 4;   ///< mm
constexpr double kLettersStep = 0.1;    ///< between the sizes that are tried
constexpr double kLeastColumn = 16.5;   ///< of text, mm: "1234.5 x 1234.5 mm" in letters of 1.6
constexpr double kBesidePicture = 20;   ///< of text where a picture takes a column of its own
constexpr double kLeastPicture = 4;     ///< mm, the shorter side
constexpr double kPictureShare = 0.25;  ///< of the label's width, at most, for a column of its own
constexpr double kNearly = 1e-9;        ///< mm; what sums of lengths lose

double code_side(double module, int modules) { return module * (modules + 2 * kQuietModules); }

/// The side of the code on a label of this shorter side that has room for so much.
double code_side_in(double shorter, double most, int modules) {
  const double wanted = std::min({kCodeShare * shorter, most, code_side(kLargestModule, modules)});
  return std::max(wanted, code_side(kLeastModule, modules));
}

double height_of_lines(std::size_t lines) { return kNumberLetters + kLabelLine * static_cast<double>(lines); }

/// The number of lines below the number.
std::size_t lines_in(double height, double letters) {
  return static_cast<std::size_t>(std::max(0.0, (height / letters - kNumberLetters + kNearly) / kLabelLine));
}

double shorter_side(const Rect& rect) { return std::min(rect.width, rect.height); }

/// The room of a line in multiples of the letters' size.
double room_of(const Rect& text, double letters, bool bold) {
  return text.width / letters / (bold ? kReportBoldWider : 1);
}

/// The field in at most so many lines; the last one is shortened where there would be more.
std::vector<std::string> lines_of_field(const std::string& field, double room, std::size_t most) {
  std::vector<std::string> lines = io::wrapped(field, room, field.size() + 1);
  if (lines.size() <= most) return lines;
  const std::string words = io::clean_text(field);
  std::size_t rest = 0;
  for (std::size_t k = 0; k + 1 < most; ++k) rest = words.find(lines[k], rest) + lines[k].size();
  rest = words.find_first_not_of(' ', rest);
  lines.resize(most - 1);
  lines.push_back(io::shortened(words.substr(rest), room / kSmallerLetters));
  return lines;
}

/// The largest letters at which no word is wider than a line, but for those that the least letters do not
/// save.
double letters_of_whole_words(const std::vector<std::string>& fields, const Rect& text) {
  double letters = kLargestLetters;
  for (std::size_t i = 0; i < fields.size(); ++i)
    for (std::size_t begin = 0; begin < fields[i].size();) {
      const std::size_t end = std::min(fields[i].find(' ', begin), fields[i].size());
      const double whole =
          io::fitting_size(fields[i].substr(begin, end - begin), letters, room_of(text, 1, i == 0));
      if (whole >= kLeastLetters) letters = whole;
      begin = end + 1;
    }
  return letters;
}

/// The lines at this size of letters: as many as fields need, or fewer where there are no more than `most`.
std::vector<LabelLines::Line> lines_at(const std::vector<std::string>& fields, const Rect& text,
                                       double letters, std::size_t most) {
  std::vector<LabelLines::Line> lines;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::size_t others = lines.size() + fields.size() - i - 1;
    const std::size_t own = most > others ? most - others : 1;
    for (std::string& words : lines_of_field(fields[i], room_of(text, letters, i == 0), own))
      lines.push_back({std::move(words), i == 0});
  }
  return lines;
}

LabelPlan tall_plan(const Rect& whole, int modules, std::size_t fields) {
  const double least = kLeastLetters * height_of_lines(fields);
  const double side =
      code_side_in(whole.width, std::min(whole.width, whole.height - kLabelEdge - least), modules);
  LabelPlan plan{whole, {}, {whole.right() - side, whole.bottom() - side, side, side}, {}};
  const double above = plan.code.y - whole.y - kLabelEdge, width = whole.width - 2 * kLabelEdge;
  plan.text = {whole.x + kLabelEdge, whole.y + kLabelEdge, width,
               std::min(above, kLargestLetters * height_of_lines(2 * fields))};
  plan.picture = {plan.text.x, plan.text.bottom(), width, plan.code.y - plan.text.bottom()};
  const Rect beside{plan.text.x, plan.code.y, plan.code.x - plan.text.x, side - kLabelEdge};
  if (shorter_side(beside) > shorter_side(plan.picture)) plan.picture = beside;
  return plan;
}

LabelPlan wide_plan(const Rect& whole, int modules) {
  const double side =
      code_side_in(whole.height, std::min(whole.height, whole.width - kLabelEdge - kLeastColumn), modules);
  LabelPlan plan{whole, {}, {whole.right() - side, whole.bottom() - side, side, side}, {}};
  const double top = whole.y + kLabelEdge, height = whole.height - 2 * kLabelEdge;
  double right = plan.code.x;
  plan.picture = {plan.code.x + kLabelEdge, top, side - 2 * kLabelEdge, plan.code.y - top};
  const double column = std::min(height, kPictureShare * whole.width);
  if (shorter_side(plan.picture) < kLeastPicture &&
      right - column - whole.x - 2 * kLabelEdge >= kBesidePicture) {
    plan.picture = {right - column, top, column, height};
    right -= column + kLabelEdge;
  }
  plan.text = {whole.x + kLabelEdge, top, right - whole.x - kLabelEdge, height};
  return plan;
}

}  // namespace

LeastLabel least_label(bool tall, int modules, std::size_t fields) {
  const double side = code_side(kLeastModule, modules), lines = kLeastLetters * height_of_lines(fields);
  if (tall) return {std::max(side, kLeastColumn + 2 * kLabelEdge), kLabelEdge + lines + side};
  return {kLabelEdge + kLeastColumn + side, std::max(side, lines + 2 * kLabelEdge)};
}

LabelPlan label_plan(const Rect& whole, int modules, std::size_t fields) {
  LabelPlan plan =
      is_tall(whole.width, whole.height) ? tall_plan(whole, modules, fields) : wide_plan(whole, modules);
  if (shorter_side(plan.picture) < kLeastPicture) plan.picture = {};
  return plan;
}

LabelLines label_lines(const std::vector<std::string>& fields, const Rect& text) {
  const double largest = letters_of_whole_words(fields, text);
  for (double letters = largest; letters >= kLeastLetters; letters -= kLettersStep) {
    const std::size_t most = lines_in(text.height, letters);
    std::vector<LabelLines::Line> lines =
        lines_at(fields, text, letters, std::numeric_limits<std::size_t>::max());
    if (lines.size() <= most) return {letters, std::move(lines)};
  }
  return {kLeastLetters, lines_at(fields, text, kLeastLetters,
                                  std::max(fields.size(), lines_in(text.height, kLeastLetters)))};
}

}  // namespace lekalo::draw
