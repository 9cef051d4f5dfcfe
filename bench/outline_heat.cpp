// A figure of docs/design/functional-voxel.md: heat on a pocket's outline at a point and over a stretch, how
// it spreads into the material, the thermal stress there, and the outline that the expansion moves.
//
//   bench_outline_heat paper-pocket.json FIGURE.svg
//
// The source names no law, no width and no constants; ours are those of heated_plate.hpp and below. It fails
// where the heat balance or the closed form of a round hole does not hold.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "heated_plate.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/field/level_lines.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::heated_plate;
using geom::Point;

constexpr double kPi = 3.141592653589793;
constexpr Point kPlace{30, 20};               // the middle of a side
constexpr double kSpread = 1, kStretch = 20;  // mm: standard deviation at the point; the stretch's length
constexpr double kMargin = 35;                // mm of material around the pocket
constexpr double kFactor = 200;               // by which the outline's movement is drawn larger

/// Carried on from the cells that are `known` into those without material, ring by ring, so that bands run
/// under the drawn outline.
Numbers carried_on(const Plate& plate, Numbers values, std::vector<char> known) {
  const std::size_t columns = plate.cells.columns, size = values.size();
  std::vector<std::size_t> ring;
  for (std::size_t n = 0; n < size; ++n)
    if (known[n] != 0) ring.push_back(n);
  while (!ring.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t n : ring)
      for (const std::size_t m : {n + 1, n - 1, n + columns, n - columns})  // below 0: beyond size
        if (m < size && known[m] == 0) known[m] = 1, values[m] = values[n], next.push_back(m);
    ring = std::move(next);
  }
  return values;
}

struct Quantity {
  const char *name, *unit;
  double step;
  int bands;
  std::array<int, 3> low, high;  ///< colours
};
constexpr Quantity kTemperature{"Temperature above ambient", "K", 5, 17, {255, 243, 214}, {176, 28, 20}};
constexpr Quantity kStress{"Thermal stress", "MPa", 5, 12, {236, 242, 236}, {20, 92, 84}};

std::string colour(const Quantity& q, int band) {
  std::string text = "#";
  for (std::size_t k = 0; k < 3; ++k)
    text += fmt::format("{:02x}", q.low[k] + (q.high[k] - q.low[k]) * band / (q.bands - 1));
  return text;
}

/// SVG, mm of the plate, y down; what is drawn lies in the last panel begun.
class Figure {
 public:
  Figure(const Plate& plate, geom::Box block) : plate_(plate), block_(block), outlines_(outlines_of(plate)) {}

  void text(Point at, const std::string& words) {
    body_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\">{}</text>\n", at.x, at.y, words);
  }
  void rectangle(Point at, Point size, const std::string& fill) {
    body_ += fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"{}\"/>\n", at.x,
                         at.y, size.x, size.y, fill);
  }
  /// Bands of a quantity at the cells' centres, and the pocket.
  void panel(Point corner, const Quantity& q, const Numbers& values, double most) {
    corner_ = corner;
    text(corner - Point{0, 3}, fmt::format("{}: at most {:.0f} {}", q.name, most, q.unit));
    rectangle(corner, block_.high - block_.low, colour(q, 0));
    Numbers below = values;
    for (double& v : below) v = -v;
    const field::LevelLines lines(plate_.cells, below);
    for (int band = 1; band < q.bands; ++band) {
      std::string data;
      for (const auto& line : lines.at(-q.step * band)) {
        std::vector<Point> places;
        for (const auto& place : line) places.push_back(place.at);
        data += closed(places);
      }
      if (!data.empty()) path(data, fmt::format("fill=\"{}\" fill-rule=\"evenodd\"", colour(q, band)));
    }
    std::string data;
    for (const auto& line : outlines_) data += closed(line);
    path(data, "fill=\"#fff\" fill-rule=\"evenodd\" stroke=\"#000\" stroke-width=\".5\"");
  }
  void moved_outline(const State& state) {
    std::string data;
    for (std::vector<Point> line : outlines_) {
      for (Point& p : line) p = p + kFactor * moved_at(plate_, state, p);
      data += closed(line);
    }
    path(data, "fill=\"none\" stroke=\"#1450c8\" stroke-width=\".8\"");
  }
  /// Where more than a tenth of the density's peak enters.
  void source(const std::function<double(Point)>& density) {
    std::string data;
    for (const auto& line : outlines_)
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (density(0.5 * (line[i] + line[i + 1])) > 0.1 * density(kPlace))
          data += "M" + place(line[i]) + "L" + place(line[i + 1]);
    path(data, "stroke=\"#e00000\" stroke-width=\"2\" stroke-linecap=\"round\"");
  }
  void scale(Point foot, const Quantity& q) {
    for (int band = 0; band < q.bands; ++band) {
      const double y = foot.y - 6 * band;
      rectangle({foot.x, y - 6}, {6, 6}, colour(q, band));
      text({foot.x + 8, y + 1.5},
           fmt::format("{:g}", q.step * band) + (band == 0 ? fmt::format(" {}", q.unit) : ""));
    }
  }
  [[nodiscard]] const std::string& body() const { return body_; }
  [[nodiscard]] const std::vector<std::vector<Point>>& outlines() const { return outlines_; }

 private:
  void path(const std::string& data, const std::string& look) {
    body_ += fmt::format("<path {} d=\"{}\"/>\n", look, data);
  }
  [[nodiscard]] std::string place(Point p) const {
    return fmt::format("{:.1f} {:.1f}", corner_.x + p.x - block_.low.x, corner_.y + block_.high.y - p.y);
  }
  /// Without places nearer to the one before than is seen.
  [[nodiscard]] std::string closed(const std::vector<Point>& line) const {
    std::string data;
    Point last;
    for (const Point p : line) {
      if (!data.empty() && geom::norm(p - last) < 0.4) continue;
      data += (data.empty() ? "M" : "L") + place(p), last = p;
    }
    return data + "Z";
  }
  const Plate& plate_;
  geom::Box block_;
  std::vector<std::vector<Point>> outlines_;
  Point corner_;
  std::string body_;
};

Result<void> draw(const std::string& pocket, const std::string& path) {
  LEKALO_CHECK(check_round_hole());
  LEKALO_TRY(const auto bytes, disk::read_file(pocket));
  LEKALO_TRY(const auto file, io::parse_regions(bytes, pocket));
  geom::Box block = geom::bounds(file.regions.front().outer);
  block = {block.low - Point{kMargin, kMargin}, block.high + Point{kMargin, kMargin}};
  const auto within = [block](Point p) {
    return std::min({p.x - block.low.x, block.high.x - p.x, p.y - block.low.y, block.high.y - p.y});
  };
  LEKALO_TRY(const auto plate, plate_with(file.regions, block, within));
  const std::array<std::function<double(Point)>, 2> sources{
      [](Point p) {
        const double d = geom::norm(p - kPlace) / kSpread;
        return kHeat * std::exp(-d * d / 2) / (kSpread * std::sqrt(2 * kPi));
      },
      [](Point p) { return geom::norm(p - kPlace) <= kStretch / 2 ? kHeat / kStretch : 0; }};
  Figure figure(plate, block);
  const Point size = block.high - block.low, corner{6, 24}, next{size.x + 10, size.y + 22};
  figure.text({corner.x, 7},
              fmt::format("{:g} W per mm of depth enter the outline where it is red: left at a "
                          "point (Gaussian, {:g} mm), right evenly over {:g} mm.",
                          kHeat, kSpread, kStretch));
  figure.text({corner.x, 13.5},
              fmt::format("Blue: the outline moved by the expansion, {:g} times.", kFactor));
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto found = heated(plate, sources[k]);
    if (!found) return failure(found.error().code, fmt::format("{}: {}", pocket, found.error().message));
    std::vector<char> some, whole;
    for (const Cell& cell : plate.cut)
      some.push_back(cell.material.empty() ? 0 : 1), whole.push_back(cell.whole ? 1 : 0);
    const Numbers heat = carried_on(plate, found->temperature, some);
    const Numbers stress = carried_on(plate, found->stress, whole);
    const auto heat_of = [&](std::size_t n) { return heat[n]; };
    double hottest = 0, farthest = 0;
    for (const auto& line : figure.outlines())
      for (const Point p : line) {
        hottest = std::max(hottest, between(plate.cells, heat_of, p));
        farthest = std::max(farthest, geom::norm(moved_at(plate, *found, p)));
      }
    const double most = *std::max_element(stress.begin(), stress.end());
    fmt::print("at most {:.1f} K, {:.1f} MPa, outline moved by {:.4f} mm\n", hottest, most, farthest);
    const Point upper = corner + static_cast<double>(k) * Point{next.x, 0}, lower = upper + Point{0, next.y};
    figure.panel(upper, kTemperature, heat, hottest);
    figure.moved_outline(*found);
    figure.source(sources[k]);
    figure.text(upper + Point{0, size.y + 6},
                fmt::format("The outline moves by at most {:.3f} mm", farthest));
    figure.panel(lower, kStress, stress, most);
    figure.source(sources[k]);
  }
  const Point foot = corner + Point{next.x + size.x + 6, size.y};
  figure.scale(foot, kTemperature);
  figure.scale(foot + Point{0, next.y}, kStress);
  disk::AtomicFiles files;
  const std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}mm\" "
      "height=\"{1:g}mm\" font-family=\"sans-serif\" font-size=\"4.8\">\n<rect width=\"100%\" "
      "height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
      foot.x + 26, foot.y + next.y + 6, figure.body());
  LEKALO_CHECK(files.add(path, svg));
  return files.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "bench_outline_heat paper-pocket.json FIGURE.svg\n");
    return 2;
  }
  const auto drawn = draw(argv[1], argv[2]);
  if (!drawn) fmt::print(stderr, "{}\n", drawn.error().message);
  return drawn ? 0 : exit_status(drawn.error().code);
}
