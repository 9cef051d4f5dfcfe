#include "lekalo/fit/turning.hpp"

#include <fmt/core.h>

namespace lekalo::fit {
namespace {

constexpr double kLead = 1;  // mm

/// Points of the whole part, from its right end (z > 0) to its left one.
std::vector<TurnedPoint> whole(const Corrected& corrected) {
  std::vector<TurnedPoint> points(corrected.profile.rbegin(), corrected.profile.rend());
  if (corrected.profile.front().z < 0) return points;
  for (const TurnedPoint& p : corrected.profile)
    if (p.z > 0) points.push_back({-p.z, p.diameter});
  return points;
}

/// A number as it is stated, with a point: a result says it, too, and the checker compares them.
std::string exactly(double value) {
  std::string text = fmt::format("{}", value);
  return text.find('.') == std::string::npos ? text + ".0" : text;
}

const char* words_of(Surface surface) {
  return surface == Surface::outside ? "OUTSIDE OF THE HUB"
         : surface == Surface::bore  ? "BORE OF THE SHAFT"
                                     : "SEAT ON THE SHAFT";
}

}  // namespace

std::string profile_csv(const Corrected& corrected) {
  std::string text = "z_mm,diameter_mm\n";
  for (const TurnedPoint& p : whole(corrected)) text += fmt::format("{:.4f},{:.4f}\n", p.z, p.diameter);
  return text;
}

std::string profile_dxf(const Corrected& corrected) {
  std::string text =
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$"
      "INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
      "0\nPOLYLINE\n8\nPROFILE\n66\n1\n70\n0\n";
  for (const TurnedPoint& p : whole(corrected))
    text += fmt::format("0\nVERTEX\n8\nPROFILE\n10\n{:.4f}\n20\n{:.5f}\n", p.z, p.diameter / 2);
  return text + "0\nSEQEND\n8\nPROFILE\n0\nENDSEC\n0\nEOF\n";
}

std::string turning_program(const Corrected& corrected, const TurningWords& words) {
  const std::vector<TurnedPoint> points = whole(corrected);
  const bool on_seat = corrected.surface == Surface::seat;
  const double face = corrected.face, scale = words.radius ? 0.5 : 1,
               away = corrected.surface == Surface::bore ? -2 * kLead : 2 * kLead;
  // A radius is half of a diameter, and needs one decimal more to be as exact.
  const auto x = [&](double diameter) {
    return fmt::format("X{:.{}f}", scale * diameter, words.radius ? 5 : 4);
  };
  const auto z = [&](double place) { return fmt::format("Z{:.4f}", place - face); };
  const std::string feed = "F" + exactly(words.feed_mm_per_min);
  std::string text = words.control == Lathe::fanuc ? "%\nO0001\n" : "";
  text += fmt::format("(LEKALO FIT - {})\n(Z0 IS THE RIGHT FACE, X IS A {})\n", words_of(corrected.surface),
                      words.radius ? "RADIUS" : "DIAMETER");
  text += words.control == Lathe::fanuc
              ? "G21 G18 G40 G80 G97 G98\n"
              : fmt::format("G21 G18 G40 G80 G90 G94 G97 {} G61\n", words.radius ? "G8" : "G7");
  text += fmt::format("S{:.0f} M3\n", words.spindle_rpm);
  // Beside a seat the shaft goes on, so that the tool comes onto it and leaves it along X.
  const double before = points.front().diameter, behind = points.back().diameter;
  text += fmt::format("G0 {}\nG0 {}\n", z(face + kLead), x(before + (on_seat ? away : 0)));
  if (on_seat)
    text += fmt::format("G0 {}\nG1 {} {}\n", z(points.front().z), x(before), feed);
  else
    text += fmt::format("G1 {} {}\n", z(face), feed);
  for (std::size_t i = 1; i < points.size(); ++i)
    text += fmt::format("G1 {} {}\n", x(points[i].diameter), z(points[i].z));
  text += on_seat ? "G1 " + x(behind + away) + "\n"
                  : fmt::format("G1 {}\nG0 {}\n", z(points.back().z - kLead), x(behind + away));
  text += fmt::format("G0 {}\nM5\nM30\n", z(face + kLead));
  return words.control == Lathe::fanuc ? text + "%\n" : text;
}

}  // namespace lekalo::fit
