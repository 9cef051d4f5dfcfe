#pragma once

// Random RS-274 programs within the white list, the same for a seed on every machine: lines, arcs both ways
// in both formats, helices, G90 and G91, G90.1 and G91.1, inches and millimetres, cycles, words left out, odd
// spelling.

#include <array>
#include <cmath>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/trig.hpp"

namespace rs274 {

class RandomProgram {
 public:
  RandomProgram(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}

  std::string write() {
    eol_ = random_.below(4) == 0 ? "\r\n" : "\n";
    line("(random)");
    inch_ = random_.below(3) == 0;
    line(inch_ ? "G20 G90 G17 G40 G80 G94" : "g21g90g17g40g80g94");
    line("F100 S1000 M3");
    line(random_.below(2) == 0 ? "G0 Z5." : "G0 Z5");
    to(place(), place());
    line("G0 X" + number(x_) + " Y" + number(y_));
    const std::uint64_t blocks = 5 + random_.below(40);
    for (std::uint64_t k = 0; k < blocks; ++k) item();
    line("G80");
    line("M2");
    return text_;
  }

 private:
  void line(const std::string& words) { text_ += words + eol_; }

  /// A coordinate with the decimals of this word; the position is kept as written.
  double place() { return cut(random_.uniform(-200, 200) / (inch_ ? 25.4 : 1)); }
  double cut(double value) {
    digits_ = static_cast<int>(random_.below(7));
    double scale = 1;
    for (int k = 0; k < digits_; ++k) scale *= 10;
    return std::nearbyint(value * scale) / scale;
  }

  static std::string fixed(double value, int digits) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
    return buffer.data();
  }
  std::string number(double value) {
    std::string text = fixed(value + 0.0, 6);  // no -0 of the generator's own
    while (text.back() == '0' && random_.below(8) != 0) text.pop_back();
    if (text.back() == '.' && random_.below(2) == 0) text.pop_back();
    if (text[0] != '-' && random_.below(6) == 0) text.insert(0, "+");
    if (text.rfind("0.", 0) == 0 && text.size() > 2 && random_.below(3) == 0) text.erase(0, 1);
    return text;
  }
  std::string word(char letter, double value) {
    const bool lower = random_.below(4) == 0;
    return std::string(random_.below(3) == 0 ? "" : " ") + static_cast<char>(lower ? letter + 32 : letter) +
           number(value);
  }
  void to(double x, double y) {
    x_ = cut6(x);
    y_ = cut6(y);
  }
  static double cut6(double value) { return std::nearbyint(value * 1e6) / 1e6; }

  std::string target(double x, double y) {
    std::string words;
    const double from_x = x_, from_y = y_;
    to(x, y);
    const double dx = incremental_ ? cut6(x_ - from_x) : x_, dy = incremental_ ? cut6(y_ - from_y) : y_;
    const bool same_x = x_ == from_x, same_y = y_ == from_y;
    if (!same_x || same_y || random_.below(2) == 0) words += word('X', dx);
    if (!same_y || random_.below(2) == 0) words += word('Y', dy);
    return words;
  }

  void item() {
    if (random_.below(12) == 0) line("(comment; X1 Y2 stays) ; X3");
    if (random_.below(10) == 0) switch_distance();
    if (random_.below(14) == 0) switch_unit();
    switch (random_.below(8)) {
      case 0:
      case 1:
      case 2:
        return go();
      case 3:
      case 4:
        return arc_centre();
      case 5:
      case 6:
        return arc_radius();
      default:
        return cycle();
    }
  }

  void switch_distance() {
    incremental_ = !incremental_;
    line(incremental_ ? "G91" : "G90");
  }
  void switch_unit() {
    // Positions are carried in the unit of the program: begin anew in the other one.
    inch_ = !inch_;
    incremental_ = false;
    to(place(), place());
    line(std::string(inch_ ? "G20" : "G21") + " G90 G0 X" + number(x_) + " Y" + number(y_));
  }

  void go() {
    std::string words = random_.below(2) == 0 ? "G1" : "G0";
    const std::uint64_t axes = random_.below(4);
    const double x = axes == 0 ? x_ : place(), y = axes == 1 ? y_ : place();
    words += target(x, y);
    if (random_.below(4) == 0) words += word('Z', incremental_ ? 0.5 : -1.25);
    line(words);
  }

  void arc_centre() {
    const bool clockwise = random_.below(2) == 0;
    const double radius = random_.uniform(0.5, 60) / (inch_ ? 25.4 : 1);
    const double first = random_.uniform(0, 6.28), sweep = random_.uniform(0.01, 6.27);
    const auto a = lekalo::geom::sincos(first),
               b = lekalo::geom::sincos(clockwise ? first - sweep : first + sweep);
    const double from_x = x_, from_y = y_;
    const double i = cut6(-radius * a.cosine), j = cut6(-radius * a.sine);
    const bool full = random_.below(5) == 0;
    const bool absolute_centre = random_.below(4) == 0;
    std::string words = absolute_centre ? "G90.1 " : "G91.1 ";
    words += clockwise ? "G2" : "G3";
    if (!full)
      words += target(from_x + i + radius * b.cosine, from_y + j + radius * b.sine);
    else if (random_.below(2) == 0)
      words += target(from_x, from_y);
    words +=
        word('I', absolute_centre ? cut6(from_x + i) : i) + word('J', absolute_centre ? cut6(from_y + j) : j);
    if (random_.below(4) == 0) words += word('Z', incremental_ ? -0.5 : -2);
    if (random_.below(5) == 0) words += " P" + std::to_string(1 + random_.below(3));
    line(words);
  }

  void arc_radius() {
    const double from_x = x_, from_y = y_;
    const double chord = random_.uniform(0.05, 80) / (inch_ ? 25.4 : 1);
    const auto way = lekalo::geom::sincos(random_.uniform(0, 6.28));
    std::string words = random_.below(2) == 0 ? "G2" : "G3";
    if (random_.below(6) == 0) {  // the exact half circle
      const double radius = std::nearbyint(chord * 50) / 100 + 0.5;
      words += target(from_x + 2 * radius, from_y) + " R" + fixed(radius, 3);
    } else {
      words += target(from_x + chord * way.cosine, from_y + chord * way.sine);
      const double span = std::sqrt((x_ - from_x) * (x_ - from_x) + (y_ - from_y) * (y_ - from_y));
      const double radius = span / 2 * random_.uniform(1.0001, 4) + 0.001;
      words += " R" + fixed(random_.below(3) == 0 ? -radius : radius, 5);
    }
    if (random_.below(4) == 0) words += word('Z', incremental_ ? -0.5 : -2);
    line(words);
  }

  void cycle() {
    static constexpr std::array kCycles = {"G81", "G82 P.5", "G83 Q1", "G73 Q1", "G85", "G89 P1"};
    line(incremental_ ? "G90 G0 Z5" : "G0 Z5");
    if (incremental_) line("G91");
    std::string words = random_.below(2) == 0 ? "G98 " : "G99 ";
    words += kCycles[random_.below(kCycles.size())];
    words += target(place(), place()) + (incremental_ ? " Z-3 R-1" : " Z-3 R1");
    line(words);
    for (std::uint64_t more = random_.below(3); more > 0; --more) {
      const std::uint64_t axes = random_.below(3);
      const double x = axes == 0 ? x_ : place(), y = axes == 1 ? y_ : place();
      const double from_x = x_, from_y = y_;
      words = target(x, y);
      if (incremental_ && random_.below(2) == 0) {
        const auto repeats = 1 + random_.below(5);
        words += " L" + std::to_string(repeats);
        to(from_x + static_cast<double>(repeats) * cut6(x_ - from_x),
           from_y + static_cast<double>(repeats) * cut6(y_ - from_y));
      }
      line(words);
    }
    line("G80");
  }

  lekalo::Random random_;
  std::string text_, eol_;
  bool inch_ = false, incremental_ = false;
  double x_ = 0, y_ = 0;
  int digits_ = 0;
};

}  // namespace rs274
