#pragma once

// A second, small reader of RS-274 programs for the tests of the rewriter: long double arithmetic, its own
// lexer, no line of code in common with src/nc. It knows what the generator (rs274_random.hpp) and the
// rewriter write, trusts its input otherwise, and follows work offset, local shift and rotation, so that
// programs of all three modes give paths in one frame.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace rs274 {

using Real = long double;
inline constexpr Real kPi = 3.14159265358979323846264338327950288L;
inline constexpr Real kHalfCircle = 1 - 1e-12L;

struct Point {
  Real x = 0, y = 0;
};
inline Real distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// p -> R p + t, millimetres.
struct Motion {
  Real cosine = 1, sine = 0;
  Point shift;

  static Motion turned(Real x, Real y, Real theta) { return {std::cos(theta), std::sin(theta), {x, y}}; }
  Point operator()(Point p) const {
    return {cosine * p.x - sine * p.y + shift.x, sine * p.x + cosine * p.y + shift.y};
  }
};

/// One motion of the path in millimetres; a cycle gives one for each hole.
struct Step {
  std::size_t line = 0;
  int code = 0;  ///< G word, 0 to 3 or the cycle's
  bool from_known = false;
  Point from, to;
  bool arc = false;
  Point centre;
  Real start_angle = 0, sweep = 0, start_radius = 0, end_radius = 0;  ///< sweep signed, with whole turns
  Real z = 0;

  /// 0 <= part <= 1
  Point at(Real part) const {
    if (!arc) return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
    const Real radius = start_radius + part * (end_radius - start_radius), angle = start_angle + part * sweep;
    return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  }
};

class Reader {
 public:
  explicit Reader(Motion work_offset = {}) : offset_(work_offset) {}

  std::vector<Step> read(const std::string& program) {
    std::size_t begin = 0;
    for (line_ = 1; begin < program.size(); ++line_) {
      const std::size_t end = std::min(program.find('\n', begin), program.size());
      block(program.substr(begin, end - begin));
      begin = end + 1;
    }
    return steps_;
  }

 private:
  void block(const std::string& text) {
    std::map<char, Real> words;
    std::vector<int> codes;
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (text[k] == ';' || text[k] == '/') break;
      if (text[k] == '(')  // a comment may hold another one
        for (int depth = 1; depth > 0 && ++k < text.size();)
          depth += text[k] == '(' ? 1 : text[k] == ')' ? -1 : 0;
      if (k >= text.size()) break;
      if (!std::isalpha(static_cast<unsigned char>(text[k]))) continue;
      const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[k])));
      std::size_t end = k + 1;
      std::string number;
      while (end < text.size() && std::string("+-.0123456789 \t").find(text[end]) != std::string::npos)
        number += text[end++];
      k = end - 1;
      const Real value = std::strtold(number.c_str(), nullptr);
      if (letter == 'G')
        codes.push_back(static_cast<int>(std::lround(10 * value)));
      else
        words[letter] = value;
    }
    modes(codes);
    if (has(codes, 100)) {
      offset_ = Motion::turned(unit_ * words['X'], unit_ * words['Y'], words['R'] * kPi / 180);
    } else if (has(codes, 520)) {
      local_ = {unit_ * words['X'], unit_ * words['Y']};
    } else if (has(codes, 680)) {
      rotation_ = Motion::turned(0, 0, words['R'] * kPi / 180);
    } else if (has(codes, 690)) {
      rotation_ = {};
    } else if (!has(codes, 40)) {  // the X of a dwell is its time
      move(words);
    }
  }

  static bool has(const std::vector<int>& codes, int code) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
  }

  void modes(const std::vector<int>& codes) {
    for (const int code : codes) {
      if (code == 200) unit_ = 25.4L;
      if (code == 210) unit_ = 1;
      if (code == 900) incremental_ = false;
      if (code == 910) incremental_ = true;
      if (code == 901) absolute_centre_ = true;
      if (code == 911) absolute_centre_ = false;
      if (code <= 30 || (code >= 730 && code <= 890)) motion_ = code / 10;
    }
  }

  Point placed(Point p) const {
    Point turned = rotation_(p);
    turned.x += local_.x;
    turned.y += local_.y;
    return offset_(turned);
  }

  void move(const std::map<char, Real>& words) {
    const auto value = [&](char letter, Real otherwise) {
      const auto found = words.find(letter);
      return found == words.end() ? otherwise : unit_ * found->second;
    };
    const bool xy = words.count('X') != 0 || words.count('Y') != 0;
    const bool centre = words.count('I') != 0 || words.count('J') != 0;
    if (words.count('Z') != 0) z_ = (incremental_ ? z_ : 0) + value('Z', 0);
    if (!xy && !centre) return;
    const bool cycle = motion_ >= 73;
    const int repeats = cycle && incremental_ && words.count('L') != 0 ? static_cast<int>(words.at('L')) : 1;
    for (int k = 0; k < repeats; ++k) {
      const Point from = here_;
      here_.x = words.count('X') != 0 ? (incremental_ ? here_.x : 0) + value('X', 0) : here_.x;
      here_.y = words.count('Y') != 0 ? (incremental_ ? here_.y : 0) + value('Y', 0) : here_.y;
      Step step;
      step.line = line_;
      step.code = motion_;
      step.from_known = known_;
      step.z = z_;
      known_ = true;
      step.from = placed(from);
      step.to = placed(here_);
      if (motion_ == 2 || motion_ == 3) {
        const Point middle = words.count('R') != 0 ? centre_by_radius(from, here_, value('R', 0))
                             : absolute_centre_    ? Point{value('I', 0), value('J', 0)}
                                                   : Point{from.x + value('I', 0), from.y + value('J', 0)};
        const bool full = distance(from, here_) < 1e-12L;  // sums of decimals are not exact here
        bend(step, placed(middle), full, words.count('P') != 0 ? static_cast<int>(words.at('P')) : 1);
      }
      steps_.push_back(step);
    }
  }

  Point centre_by_radius(Point a, Point b, Real radius) const {
    const Real half = distance(a, b) / 2, size = std::abs(radius);
    const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    if (half / size > kHalfCircle) return middle;
    const Real height = std::sqrt((size - half) * (size + half)) / (2 * half);
    const Real side = (motion_ == 3) == (radius > 0) ? 1 : -1;
    return {middle.x - side * height * (b.y - a.y), middle.y + side * height * (b.x - a.x)};
  }

  void bend(Step& step, Point centre, bool full, int turns) const {
    step.arc = true;
    step.centre = centre;
    step.start_radius = distance(step.from, centre);
    step.end_radius = distance(step.to, centre);
    step.start_angle = std::atan2(step.from.y - centre.y, step.from.x - centre.x);
    const Real end_angle = std::atan2(step.to.y - centre.y, step.to.x - centre.x);
    const Real direction = motion_ == 3 ? 1 : -1;
    Real sweep = direction * (end_angle - step.start_angle);
    if (full) sweep = 2 * kPi;
    while (sweep <= 0) sweep += 2 * kPi;
    step.sweep = direction * (sweep + 2 * kPi * (turns - 1));
  }

  Motion offset_, rotation_;
  Point local_;
  Real unit_ = 1, z_ = 0;
  int motion_ = 0;
  bool incremental_ = false, absolute_centre_ = false, known_ = false;
  Point here_;
  std::size_t line_ = 0;
  std::vector<Step> steps_;
};

/// Largest distance between `exact` carried by `pose` and `written`, at equal fractions of the length of each
/// step; negative when they are not the same steps.
inline Real deviation(const std::vector<Step>& exact, const std::vector<Step>& written, const Motion& pose) {
  if (exact.size() != written.size()) return -1;
  Real worst = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const Step &a = exact[k], &b = written[k];
    if (a.code != b.code || a.arc != b.arc || std::abs(a.z - b.z) > 1e-12L) return -1;
    worst = std::max(worst, distance(pose(a.to), b.to));
    if (!a.from_known) continue;
    constexpr int kPieces = 24;
    for (int part = 0; part <= kPieces; ++part) {
      const Real fraction = static_cast<Real>(part) / kPieces;
      worst = std::max(worst, distance(pose(a.at(fraction)), b.at(fraction)));
    }
  }
  return worst;
}

}  // namespace rs274
