#include "painting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "cover.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::draw {
namespace {

using solid::Triangle;
using solid::Vector;

constexpr int kBandPixels = 48;  ///< rows of pixels that are painted at a time
constexpr double kLine = 1.1;    ///< width of lines, pixels
constexpr double kBias = 1.5;    ///< lines stand out from the surface by so many pixels
constexpr float kNothing = -1e30F;

constexpr unsigned char kPartLine = 1, kNearLine = 2, kFarLine = 4;

struct Light {
  double red = 0, green = 0, blue = 0;
};

/// The colours of the scale, which are asked for at every sample.
std::array<Colour, kColourSteps> palette() {
  std::array<Colour, kColourSteps> colours;
  for (int step = 0; step < kColourSteps; ++step)
    colours[static_cast<std::size_t>(step)] = scale_colour(step);
  return colours;
}

Light mix(Light from, Colour to, double share) {
  return {from.red + share * (to.red - from.red), from.green + share * (to.green - from.green),
          from.blue + share * (to.blue - from.blue)};
}

/// The colour of a surface in the light of two lamps: one over the viewer's left shoulder, a weak one from
/// the lower right. The share of light is kept within bounds, so that colours can be told by the scale.
Light lit(Colour colour, Vector normal, const SpaceView& view) {
  const double length = norm(normal);
  if (length > 0) normal = 1 / length * normal;
  Vector n{dot(normal, view.right), dot(normal, view.up), dot(normal, view.towards)};
  if (n.z < 0) n = -n;  // the inner side of a surface that is not closed
  constexpr Vector kKey{-0.42, 0.58, 0.698}, kFill{0.70, -0.30, 0.648}, kShine{-0.228, 0.315, 0.921};
  const double light = 0.16 + 0.66 * std::max(0.0, dot(n, kKey)) + 0.26 * std::max(0.0, dot(n, kFill));
  const double factor = 0.58 + 0.50 * std::min(1.0, light);
  double shine = std::max(0.0, dot(n, kShine));
  for (int k = 0; k < 5; ++k) shine *= shine;
  const auto channel = [&](double c) {
    const double bright = 14 + factor * c;
    return std::min(255.0, bright + 0.16 * shine * (255 - bright));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

/// The share of light that a pane of the blank keeps: more where one looks along it, as glass does.
double kept_by_glass(Vector normal, const SpaceView& view) {
  const double slant = 1 - std::min(1.0, std::abs(dot(normal, view.towards)));
  return 0.10 + 0.34 * slant * slant * slant;
}

/// Places on the screen in samples.
std::vector<ScreenPoint> on_screen(const std::vector<Vector>& places, const SpaceView& view) {
  std::vector<ScreenPoint> screen;
  screen.reserve(places.size());
  for (const Vector p : places) {
    const ScreenPoint s = view(p);
    screen.push_back({kAcross * s.x, kAcross * s.y, kAcross * s.z});
  }
  return screen;
}

struct Line {
  ScreenPoint a, b;
  unsigned char kind = 0;
};

class Painter {
 public:
  Painter(const PaintedPart& part, const PaintedBlank& blank, const SpaceView& view, int columns, int rows,
          const std::vector<Vector>& marks)
      : part_(part),
        blank_(blank),
        view_(view),
        columns_(columns),
        rows_(rows),
        part_screen_(on_screen(part.surface.places, view)),
        blank_screen_(on_screen(blank.surface.places, view)),
        marks_(on_screen(marks, view)) {
    add_lines(part.surface, part_screen_, true);
    add_lines(blank.surface, blank_screen_, false);
    made_.pixels = {columns, rows,
                    std::vector<Colour>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))};
    seen_.assign(marks.size(), 1);
  }

  Painting paint(unsigned threads) && {
    const auto bands = static_cast<std::size_t>((rows_ + kBandPixels - 1) / kBandPixels);
    share_out(bands, threads, [&](std::size_t band) { paint_band(static_cast<int>(band) * kBandPixels); });
    for (const unsigned char seen : seen_) made_.seen.push_back(seen != 0);
    return std::move(made_);
  }

 private:
  void add_lines(const ShadedMesh& mesh, const std::vector<ScreenPoint>& screen, bool of_part) {
    for (const ShadedMesh::Edge& edge : mesh.edges) {
      const double left = dot(edge.left, view_.towards), right = dot(edge.right, view_.towards);
      if (!edge.sharp && (left > 0) == (right > 0)) continue;
      const unsigned char kind = of_part ? kPartLine : left > 0 || right > 0 ? kNearLine : kFarLine;
      lines_.push_back({screen[edge.a], screen[edge.b], kind});
    }
  }

  /// The samples of a band of rows.
  struct Band {
    int from = 0, until = 0, columns = 0;
    std::vector<float> depth, clear, known;  ///< of the part; shares of light that the glass lets through
    std::vector<Light> light;
    std::vector<unsigned char> lines;
    [[nodiscard]] std::size_t at(int column, int row) const {
      return static_cast<std::size_t>(row - from) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column);
    }
  };

  void paint_band(int first_row) {
    Band band;
    band.from = kAcross * first_row, band.until = kAcross * std::min(rows_, first_row + kBandPixels);
    band.columns = kAcross * columns_;
    const std::size_t samples = band.at(0, band.until);
    band.depth.assign(samples, kNothing);
    band.clear.assign(samples, 1), band.known.assign(samples, 1);
    band.light.assign(samples, Light{255, 255, 255});
    band.lines.assign(samples, 0);
    paint_part(band);
    for (std::size_t k = 0; k < marks_.size(); ++k) look_at_mark(band, k);
    paint_blank(band);
    for (const Line& line : lines_) draw(band, line);
    mix_samples(band, first_row);
  }

  template <class Visit>
  void cover_triangle(const Band& band, const Triangle& t, const std::vector<ScreenPoint>& screen,
                      const Visit& visit) const {
    ask();
    const std::array<ScreenPoint, 3> corners{screen[t[0]], screen[t[1]], screen[t[2]]};
    const auto [high, low] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    if (low < band.from || high > band.until) return;
    cover(corners, band.columns, band.from, band.until,
          [&](int column, int row, const std::array<double, 3>& w) {
            const double z = w[0] * corners[0].z + (w[1] * corners[1].z + w[2] * corners[2].z);
            visit(band.at(column, row), static_cast<float>(z), w);
          });
  }

  void paint_part(Band& band) const {
    const ShadedMesh& mesh = part_.surface;
    for (const Triangle& t : mesh.triangles) {
      cover_triangle(band, t, part_screen_, [&](std::size_t at, float z, const std::array<double, 3>& w) {
        if (!(z > band.depth[at])) return;
        band.depth[at] = z;
        const Vector normal =
            w[0] * mesh.normals[t[0]] + (w[1] * mesh.normals[t[1]] + w[2] * mesh.normals[t[2]]);
        Colour colour = kPlainPart;
        if (!part_.values.empty()) {
          const double value =
              w[0] * part_.values[t[0]] + (w[1] * part_.values[t[1]] + w[2] * part_.values[t[2]]);
          if (!std::isnan(value))
            colour =
                value < kLeastValue ? kOutside : palette_[static_cast<std::size_t>(scale_step(value, 0, 1))];
        }
        band.light[at] = lit(colour, normal, view_);
      });
    }
  }

  /// A mark lies on the surface and is hidden where that is nearer by more than its slope explains.
  void look_at_mark(const Band& band, std::size_t k) {
    const int column = static_cast<int>(std::floor(std::clamp(marks_[k].x, -1.0, 1e6)));
    const int row = static_cast<int>(std::floor(std::clamp(marks_[k].y, -1.0, 1e6)));
    if (column < 0 || column >= band.columns || row < band.from || row >= band.until) return;
    constexpr double kSlope = 4;
    if (band.depth[band.at(column, row)] > marks_[k].z + kSlope * kAcross) seen_[k] = 0;
  }

  void paint_blank(Band& band) const {
    const ShadedMesh& mesh = blank_.surface;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Triangle& t = mesh.triangles[k];
      const bool unknown = !blank_.unknown.empty() && blank_.unknown[k] != 0;
      cover_triangle(band, t, blank_screen_, [&](std::size_t at, float z, const std::array<double, 3>& w) {
        if (!(z > band.depth[at])) return;
        const Vector normal =
            w[0] * mesh.normals[t[0]] + (w[1] * mesh.normals[t[1]] + w[2] * mesh.normals[t[2]]);
        if (unknown) band.known[at] *= 0.55F;
        band.clear[at] *= 1 - static_cast<float>(kept_by_glass(normal, view_));
      });
    }
  }

  void draw(Band& band, const Line& line) const {
    const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) return;
    ask();
    const double half = 0.5 * kLine * kAcross, reach = half;
    if (std::max(line.a.y, line.b.y) + reach < band.from || std::min(line.a.y, line.b.y) - reach > band.until)
      return;
    const double ux = half * dx / length, uy = half * dy / length;
    const auto corner = [&](ScreenPoint p, double along, double aside) {
      return ScreenPoint{p.x + along * ux - aside * uy, p.y + along * uy + aside * ux, p.z + kBias * kAcross};
    };
    const ScreenPoint p = corner(line.a, -0.5, -1), q = corner(line.b, 0.5, -1), r = corner(line.b, 0.5, 1),
                      s = corner(line.a, -0.5, 1);
    for (const std::array<ScreenPoint, 3>& t : {std::array{p, q, r}, std::array{p, r, s}}) {
      cover(t, band.columns, band.from, band.until, [&](int column, int row, const std::array<double, 3>& w) {
        const double z = w[0] * t[0].z + (w[1] * t[1].z + w[2] * t[2].z);
        const std::size_t at = band.at(column, row);
        if (z > band.depth[at]) band.lines[at] |= line.kind;
      });
    }
  }

  void mix_samples(const Band& band, int first_row) {
    for (int row = first_row; kAcross * row < band.until; ++row) {
      ask(static_cast<std::uint64_t>(columns_) / 8);
      for (int column = 0; column < columns_; ++column) {
        Light sum;
        for (int k = 0; k < kAcross * kAcross; ++k) {
          const Light one =
              light_at(band, band.at(kAcross * column + k % kAcross, kAcross * row + k / kAcross));
          sum.red += one.red, sum.green += one.green, sum.blue += one.blue;
        }
        const auto mean = [](double total) {
          return static_cast<std::uint8_t>(std::lround(total / (kAcross * kAcross)));
        };
        made_.pixels.colours[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(column)] = {mean(sum.red), mean(sum.green),
                                                                  mean(sum.blue)};
      }
    }
  }

  static Light light_at(const Band& band, std::size_t at) {
    Light light = band.light[at];
    if (band.lines[at] == 0 && band.clear[at] == 1) return light;
    const unsigned char lines = band.lines[at];
    if ((lines & kPartLine) != 0) light = mix(light, kInk, 0.7);
    light = mix(light, kGlass, 1 - band.clear[at]);
    light = mix(light, kUnknownGlass, 1 - band.known[at]);
    if ((lines & kFarLine) != 0) light = mix(light, kBlankLine, 0.3);
    if ((lines & kNearLine) != 0) light = mix(light, kBlankLine, 0.8);
    return light;
  }

  const PaintedPart& part_;
  const PaintedBlank& blank_;
  const SpaceView& view_;
  const std::array<Colour, kColourSteps> palette_ = palette();
  int columns_, rows_;
  std::vector<ScreenPoint> part_screen_, blank_screen_, marks_;
  std::vector<Line> lines_;
  Painting made_;
  std::vector<unsigned char> seen_;
};

}  // namespace

Colour colour_of_value(double value) {
  return value < kLeastValue ? kOutside : scale_colour(scale_step(value, 0, 1));
}

Painting paint(const PaintedPart& part, const PaintedBlank& blank, const SpaceView& view, int columns,
               int rows, const std::vector<Vector>& marks, unsigned threads) {
  return Painter(part, blank, view, columns, rows, marks).paint(threads);
}

}  // namespace lekalo::draw
