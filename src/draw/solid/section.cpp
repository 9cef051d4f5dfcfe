#include "section.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cover.hpp"
#include "draw/paper/colour.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using Lines = std::vector<std::array<Point, 2>>;

constexpr double kHatch = 9;  ///< pixels between the lines
constexpr Colour kPartCut{255, 236, 206}, kBlankCut{226, 232, 239}, kHatchLine{150, 163, 178};

/// Returns where an edge goes through the plane. It begins behind the plane, whichever triangle asks, so both
/// get the same number.
Point crossing(ScreenPoint behind, ScreenPoint before) {
  const double share = behind.z / (behind.z - before.z);
  return {behind.x + share * (before.x - behind.x), behind.y + share * (before.y - behind.y)};
}

/// Samples of a picture, and what lies there.
struct Samples {
  int columns, rows;
  std::vector<unsigned char> kinds;
  Samples(int pixel_columns, int pixel_rows)
      : columns(kAcross * pixel_columns),
        rows(kAcross * pixel_rows),
        kinds(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  [[nodiscard]] unsigned char& at(int column, int row) {
    return kinds[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }

  /// Marks what closed lines hold: a sample with an odd number of them to its left.
  void fill(const Lines& lines, unsigned char kind) {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows));
    for (const auto& [a, b] : lines) {
      ask();
      const double top = kAcross * std::min(a.y, b.y), bottom = kAcross * std::max(a.y, b.y);
      if (!(bottom > top)) continue;
      const double first = std::ceil(std::max(0.0, top - 0.5)), last = std::min<double>(rows, bottom - 0.5);
      for (int row = static_cast<int>(std::min<double>(first, rows)); row < last; ++row)
        crossings[static_cast<std::size_t>(row)].push_back(
            kAcross * (a.x + ((row + 0.5) / kAcross - a.y) / (b.y - a.y) * (b.x - a.x)));
    }
    for (int row = 0; row < rows; ++row) {
      std::vector<double>& at_row = crossings[static_cast<std::size_t>(row)];
      std::sort(at_row.begin(), at_row.end());
      for (std::size_t k = 0; k + 1 < at_row.size(); k += 2) {
        const double from = std::clamp(std::ceil(at_row[k] - 0.5), 0.0, 1.0 * columns);
        const double until = std::clamp(std::ceil(at_row[k + 1] - 0.5), 0.0, 1.0 * columns);
        for (int column = static_cast<int>(from); column < static_cast<int>(until); ++column)
          at(column, row) |= kind;
      }
    }
  }

  void draw(const Lines& lines, double width, unsigned char kind) {
    const Rect visible = Rect{0, 0, 1.0 * columns, 1.0 * rows}.grown(10 * kAcross);
    for (const auto& [from, to] : lines) {
      const auto seen = clipped({kAcross * from, kAcross * to}, visible);
      if (!seen) continue;
      const Point along = seen->b - seen->a;
      const double length = geom::norm(along), half = 0.5 * width * kAcross;
      if (!(length > 0)) continue;
      const Point ahead = half / length * along, aside{-ahead.y, ahead.x};
      const auto corner = [&](Point p) { return ScreenPoint{p.x, p.y, 0}; };
      const ScreenPoint p = corner(seen->a - 0.5 * ahead - aside), q = corner(seen->b + 0.5 * ahead - aside),
                        r = corner(seen->b + 0.5 * ahead + aside), s = corner(seen->a - 0.5 * ahead + aside);
      for (const std::array<ScreenPoint, 3>& t : {std::array{p, q, r}, std::array{p, r, s}})
        cover(t, columns, 0, rows,
              [&](int column, int row, const std::array<double, 3>&) { at(column, row) |= kind; });
    }
  }
};

constexpr unsigned char kInPart = 1, kInBlank = 2, kPartOutline = 4, kBlankOutline = 8;

Colour colour_of(unsigned char kinds, int column, int row) {
  if ((kinds & kPartOutline) != 0) return kInk;
  if ((kinds & kBlankOutline) != 0) return kBlankLine;
  if ((kinds & kInPart) != 0) return (kinds & kInBlank) != 0 ? kPartCut : Colour{255, 170, 170};
  if ((kinds & kInBlank) == 0) return kPaper;
  const int at = (column + row) % static_cast<int>(kHatch * kAcross);
  return at < kAcross ? kHatchLine : kBlankCut;
}

}  // namespace

std::vector<std::array<Point, 2>> section_lines(const ShadedMesh& surface, const SpaceView& view) {
  std::vector<ScreenPoint> screen;
  screen.reserve(surface.places.size());
  for (const solid::Vector p : surface.places) screen.push_back(view(p));
  Lines lines;
  for (const solid::Triangle& t : surface.triangles) {
    ask();
    std::array<Point, 2> line;
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenPoint a = screen[t[k]], b = screen[t[(k + 1) % 3]];
      if ((a.z < 0) == (b.z < 0)) continue;
      line[found++] = a.z < 0 ? crossing(a, b) : crossing(b, a);
    }
    if (found == 2) lines.push_back(line);
  }
  return lines;
}

Pixels section_picture(const ShadedMesh& part, const ShadedMesh& blank, const SpaceView& view, int columns,
                       int rows) {
  Samples samples(columns, rows);
  const Lines of_part = section_lines(part, view), of_blank = section_lines(blank, view);
  samples.fill(of_blank, kInBlank);
  samples.fill(of_part, kInPart);
  samples.draw(of_blank, 1.3, kBlankOutline);
  samples.draw(of_part, 1.3, kPartOutline);
  Pixels pixels{columns, rows, {}};
  pixels.colours.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      int red = 0, green = 0, blue = 0;
      for (int k = 0; k < kAcross * kAcross; ++k) {
        const int x = kAcross * column + k % kAcross, y = kAcross * row + k / kAcross;
        const Colour c = colour_of(samples.at(x, y), x, y);
        red += c.red, green += c.green, blue += c.blue;
      }
      const auto mean = [](int sum) {
        return static_cast<std::uint8_t>((sum + kAcross * kAcross / 2) / (kAcross * kAcross));
      };
      pixels.colours.push_back({mean(red), mean(green), mean(blue)});
    }
  return pixels;
}

}  // namespace lekalo::draw
