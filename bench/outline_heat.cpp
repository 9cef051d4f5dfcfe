// A figure of docs/design/functional-voxel.md: heat on a pocket's outline at a point and over a stretch, how
// it spreads into the material, the thermal stress there, and the outline that the expansion moves.
//
//   bench_outline_heat paper-pocket.json FIGURE.svg [voxel, mm] [margin, mm]
//
// The pocket's functional-voxel model (quadratic FLOZ) is the workpiece, and the solver of src/heat finds the
// rest: a layer of voxels whose upper and lower sides are free, so that it is a plate in plane stress. The
// source names no law, no width and no constants; ours are below. It fails where the heat that goes in or
// comes out is off by more than 1 %.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/field/grid.hpp"
#include "lekalo/field/level_lines.hpp"
#include "lekalo/heat/conduction.hpp"
#include "lekalo/heat/expansion.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace {

using namespace lekalo;
using geom::Point;
using Numbers = std::vector<double>;

constexpr double kPi = 3.141592653589793;
constexpr Point kPlace{30, 20};               // the middle of a side
constexpr double kSpread = 1, kStretch = 20;  // mm: standard deviation at the point; the stretch's length
constexpr double kHeat = 10;                  // W per mm of depth, in all
constexpr double kSampling = 1;               // mm: the model's chords at most
constexpr double kFactor = 200;               // by which the outline's movement is drawn larger

// Aluminium 6061-T6, handbook values; W/(mm K) and J/(mm3 K).
constexpr heat::Conductor kConductor{0.167, 2.42e-3};
constexpr heat::Elastic kElastic{68.9e3, 0.33, 23.6e-6};

/// A layer of voxels about a pocket that goes through it.
struct Plate {
  heat::Grid grid;
  field::GridFrame nodes, cells;  ///< corners of voxels, and their middles
  Numbers model;                  ///< at the nodes, positive: material
  heat::Body body;

  [[nodiscard]] Point cell(std::size_t n) const { return cells.node(n % cells.columns, n / cells.columns); }
  /// Where the model is 0, next to the middle of a voxel.
  [[nodiscard]] Point wall_at(std::size_t n) const {
    const std::size_t low = n / cells.columns * nodes.columns + n % cells.columns, high = low + nodes.columns;
    const double a = model[low], b = model[low + 1], c = model[high], d = model[high + 1];
    const Point slope = (0.5 / cells.pitch) * Point{b + d - a - c, c + d - a - b};
    return cell(n) - ((a + b + c + d) / 4 / geom::dot(slope, slope)) * slope;
  }
};

Result<Plate> plate_about(const std::vector<geom::Region>& pockets, double pitch, double margin) {
  LEKALO_TRY(const auto model, field::ContourModel::make(pockets, {kSampling, field::Logic::quadratic,
                                                                   field::FlozForm::normalised}));
  const geom::Box box = geom::bounds(pockets.front().outer);
  // Nodes off the round numbers of drawings: a node on the outline has no sign.
  const Point low = box.low - Point{margin + 0.6 * pitch, margin + 0.6 * pitch};
  const auto count = [&](double length) {
    return static_cast<std::size_t>(std::ceil((length + 2 * margin) / pitch)) + 1;
  };
  const std::size_t columns = count(box.high.x - box.low.x), rows = count(box.high.y - box.low.y);
  LEKALO_TRY(const heat::Grid grid, heat::Grid::divide({low.x, low.y, 0},
                                                       {low.x + pitch * static_cast<double>(columns),
                                                        low.y + pitch * static_cast<double>(rows), pitch},
                                                       pitch));
  const field::GridFrame nodes{low, pitch, columns + 1, rows + 1},
      cells{low + Point{pitch / 2, pitch / 2}, pitch, columns, rows};
  const field::FieldGrid sampled = field::sample(model, nodes);
  Numbers outside;
  for (const auto value : sampled.value) outside.push_back(-static_cast<double>(value));
  heat::Body body(grid, [&](heat::Place p) {
    const auto i = static_cast<std::size_t>(std::lround((p.x - low.x) / pitch)),
               j = static_cast<std::size_t>(std::lround((p.y - low.y) / pitch));
    return outside[j * nodes.columns + i];
  });
  return Plate{grid, nodes, cells, std::move(outside), std::move(body)};
}

struct State {
  Numbers temperature, stress;  ///< K, MPa (von Mises): of each voxel
  heat::Expansion expansion;

  [[nodiscard]] Point moved(Point p, double middle) const {
    const heat::Place by = expansion.moved({p.x, p.y, middle});
    return {by.x, by.y};
  }
};

/// The steady state: the border of the plate is as cold as its surroundings, and held.
/// \param density  of the heat that enters along the outlines, W per mm of length and mm of depth
Result<State> heated(const Plate& plate, const std::function<double(Point)>& density) {
  constexpr double kLong = 1e5;  // s: a plate of 100 mm is steady after some minutes
  heat::Films films;
  heat::Holding holding;
  for (const heat::Side side : {heat::Side::x_low, heat::Side::x_high, heat::Side::y_low, heat::Side::y_high})
    films.sides[of(side)] = heat::kNoResistance, holding.held[of(side)] = true;
  std::vector<heat::Source> sources;
  double in = 0;
  for (std::size_t n = 0; n < plate.grid.size(); ++n)
    if (plate.body.wall(n) > 0 && plate.body.share(n) > 0) {
      sources.push_back({n, plate.body.wall(n) * density(plate.wall_at(n))});
      in += sources.back().watts / plate.grid.pitch.z;
    }
  heat::Conduction conduction(plate.body, kConductor, films);
  double before = 0;
  for (int step = 0; step < 3; ++step) {
    before = conduction.book().lost;
    LEKALO_CHECK(conduction.step(kLong, sources));
  }
  const double out = (conduction.book().lost - before) / kLong / plate.grid.pitch.z;
  fmt::print("heat in {:.4f}, out {:.4f} W/mm\n", in, out);
  if (std::max(std::abs(in - kHeat), std::abs(out - kHeat)) > 0.01 * kHeat)
    return failure(ErrorCode::refuted,
                   fmt::format("{:.4f} W/mm go in and {:.4f} out instead of {:g}; the place of the heat is "
                               "on the outline of paper-pocket.json",
                               in, out, kHeat));
  State state{conduction.temperatures(), {}, heat::Expansion(plate.grid, kElastic, holding)};
  state.expansion.follow(plate.body);
  LEKALO_CHECK(state.expansion.solve(state.temperature));
  state.stress = state.expansion.mises();
  return state;
}

/// The outlines as the model has them, closed.
std::vector<std::vector<Point>> outlines_of(const Plate& plate) {
  std::vector<std::vector<Point>> lines;
  for (const auto& line : field::LevelLines(plate.nodes, plate.model).at(0)) {
    lines.emplace_back();
    for (const auto& place : line) lines.back().push_back(place.at);
  }
  return lines;
}

/// What a grid's nodes have, bilinear between them. \pre p is between four
double between(const field::GridFrame& frame, const Numbers& of, Point p) {
  const Point d = (1 / frame.pitch) * (p - frame.origin);
  const auto i = static_cast<std::size_t>(d.x), j = static_cast<std::size_t>(d.y);
  const double s = d.x - static_cast<double>(i), t = d.y - static_cast<double>(j);
  const std::size_t n = j * frame.columns + i, above = n + frame.columns;
  return (1 - t) * ((1 - s) * of[n] + s * of[n + 1]) + t * ((1 - s) * of[above] + s * of[above + 1]);
}

/// Carried on from the voxels of which more than `share` is material into the others, ring by ring, so that
/// bands run under the drawn outline.
Numbers carried_on(const Plate& plate, Numbers values, double share) {
  const std::size_t columns = plate.cells.columns, size = values.size();
  std::vector<char> known(size, 0);
  std::vector<std::size_t> ring;
  for (std::size_t n = 0; n < size; ++n)
    if (plate.body.share(n) > share) known[n] = 1, ring.push_back(n);
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
      for (Point& p : line) p = p + kFactor * state.moved(p, plate_.grid.pitch.z / 2);
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

Result<void> draw(const std::string& pocket, const std::string& path, double pitch, double margin) {
  LEKALO_TRY(const auto bytes, disk::read_file(pocket));
  LEKALO_TRY(const auto file, io::parse_regions(bytes, pocket));
  LEKALO_TRY(const Plate plate, plate_about(file.regions, pitch, margin));
  const Point size{pitch * static_cast<double>(plate.cells.columns),
                   pitch * static_cast<double>(plate.cells.rows)};
  const geom::Box block{plate.nodes.origin, plate.nodes.origin + size};
  const std::array<std::function<double(Point)>, 2> sources{
      [](Point p) {
        const double d = geom::norm(p - kPlace) / kSpread;
        return kHeat * std::exp(-d * d / 2) / (kSpread * std::sqrt(2 * kPi));
      },
      [](Point p) { return geom::norm(p - kPlace) <= kStretch / 2 ? kHeat / kStretch : 0; }};
  Figure figure(plate, block);
  const Point corner{6, 24}, next{size.x + 10, size.y + 22};
  figure.text({corner.x, 7},
              fmt::format("{:g} W per mm of depth enter the outline where it is red: left at a "
                          "point (Gaussian, {:g} mm), right evenly over {:g} mm.",
                          kHeat, kSpread, kStretch));
  figure.text({corner.x, 13.5},
              fmt::format("Blue: the outline moved by the expansion, {:g} times.", kFactor));
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto found = heated(plate, sources[k]);
    if (!found) return failure(found.error().code, fmt::format("{}: {}", pocket, found.error().message));
    constexpr double kAny = 0, kMost = 0.999;  // stress is said of whole voxels
    const Numbers heat = carried_on(plate, found->temperature, kAny);
    const Numbers stress = carried_on(plate, found->stress, kMost);
    double hottest = 0, farthest = 0;
    for (const auto& line : figure.outlines())
      for (const Point p : line) {
        hottest = std::max(hottest, between(plate.cells, heat, p));
        farthest = std::max(farthest, geom::norm(found->moved(p, pitch / 2)));
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
  std::array<double, 2> sizes{1, 35};  // mm: of voxels; of material around the pocket
  bool read = argc >= 3 && argc <= 5;
  for (int k = 3; read && k < argc; ++k) {
    const std::string_view word = argv[k];
    double& size = sizes[static_cast<std::size_t>(k - 3)];
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), size);
    read = error == std::errc{} && end == word.data() + word.size() && size > 0;
  }
  if (!read) {
    fmt::print(stderr, "bench_outline_heat paper-pocket.json FIGURE.svg [voxel, mm] [margin, mm]\n");
    return 2;
  }
  const auto drawn = draw(argv[1], argv[2], sizes[0], sizes[1]);
  if (!drawn) fmt::print(stderr, "{}\n", drawn.error().message);
  return drawn ? 0 : exit_status(drawn.error().code);
}
