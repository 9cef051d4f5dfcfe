#pragma once

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>

#include "verify/origin/drawing.hpp"

namespace lekalo::cases {

/// The middle of an enclosure to four digits. The enclosure itself has to be narrow, or it is said.
inline std::string drawn_number(const verify::Span& span) {
  const double middle = span.low + (span.high - span.low) / 2;
  if (!(span.high - span.low <= 1e-9 * (1 + std::abs(middle)))) return "wide";
  const std::string text = fmt::format("{:.4g}", std::abs(middle) < 1e-9 ? 0.0 : middle);
  return text;
}
inline std::string drawn_point(const verify::Vec& p) { return drawn_number(p.x) + "," + drawn_number(p.y); }

/// ` L FROM TO`, or ` A CENTRE RADIUS FROM TO` with the sweep (-: less than half a turn, =: half, +: more, o:
/// full).
inline std::string drawn_side(const verify::Side& side) {
  std::string text = side.arc ? " A " + drawn_point(side.centre) + " " + drawn_number(side.radius) : " L";
  text += " " + drawn_point(side.from) + " " + drawn_point(side.to);
  if (!side.arc) return text;
  return text + (side.sweep == verify::Sweep::less   ? " -"
                 : side.sweep == verify::Sweep::half ? " ="
                 : side.sweep == verify::Sweep::more ? " +"
                                                     : " o");
}

/// Curves as a text, each on a line: its layer, "!" where it is hidden, and its pieces. One that stands for a
/// curve within some distance ends with `~`. Then what was not read, or the complaint.
inline std::string drawn_text(const Result<verify::ReadDrawing>& drawing) {
  if (!drawing) return drawing.error().message;
  std::string text;
  for (const verify::DrawnCurve& curve : drawing->curves) {
    text += curve.layer + (curve.hidden ? "!" : "") + ":";
    for (const verify::CurvePiece& piece : curve.pieces)
      text += drawn_side(piece.side) + (piece.off > 1e-9 ? "~" : "");
    text += "\n";
  }
  for (const std::string& kind : drawing->not_read) text += "not read: " + kind + "\n";
  return text;
}

/// The text of one curve that is made of these cubics, each of four poles as x and y.
inline std::string drawn_cubics(std::initializer_list<std::array<double, 8>> cubics, double off) {
  verify::ReadDrawing drawing;
  verify::CurveMaker maker(drawing, off);
  for (const std::array<double, 8>& c : cubics) {
    const auto pole = [&](std::size_t k) {
      return verify::Vec{verify::just(c[2 * k]), verify::just(c[2 * k + 1])};
    };
    maker.cubic({}, {pole(0), pole(1), pole(2), pole(3)});
  }
  maker.done("", false);
  return drawn_text(drawing);
}

}  // namespace lekalo::cases
