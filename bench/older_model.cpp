// A figure of docs/design/functional-voxel.md: the source's older model of its pocket, discs and rectangles
// joined by R-disjunctions, beside the model from FLOZ.
//
//   bench_older_model paper-pocket.json FIGURE.png
//
// Rows: the older model by linear and by quadratic R-functions, and FLOZ, quadratic, one model of the whole;
// columns: the M-images A, B, C, D and the value inside, as `lekalo pocket --images` writes them, on the same
// grid, smaller. It fails where the older model has another sign than the pocket.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/disk/files.hpp"
#include "lekalo/draw/grey_png.hpp"
#include "lekalo/draw/voxel_pictures.hpp"
#include "lekalo/field/r_function.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/floz_field.hpp"

namespace {

using namespace lekalo;
using field::Jet;
using field::Logic;
using geom::Point;

constexpr std::size_t kNodes = 500, kShrink = 3, kGap = 4;

/// (r^2 - d^2) / 2 r: slope 1 on the circle.
Jet disc(Point centre, double radius, Point p) {
  const Point d = p - centre;
  return {(radius * radius - geom::dot(d, d)) / (2 * radius), (-1 / radius) * d};
}

/// The conjunction of two strips, each like a disc of one dimension.
Jet rectangle(Point low, Point high, Point p, Logic logic) {
  const Point half = 0.5 * (high - low), d = p - 0.5 * (low + high);
  return field::conjunction({(half.x * half.x - d.x * d.x) / (2 * half.x), {-d.x / half.x, 0}},
                            {(half.y * half.y - d.y * d.y) / (2 * half.y), {0, -d.y / half.y}}, logic);
}

/// The pocket of the test data: seven discs, and two crossing rectangles for each of its two round-cornered
/// ones. Those of the upper one begin where the corners of the middle one do: abutting they would leave a
/// line of zeros between them.
Jet older_model(Point p, Logic logic) {
  Jet all = disc({0, 0}, 22, p);
  const auto join = [&](const Jet& one) { all = field::disjunction(all, one, logic); };
  join(rectangle({-30, 8}, {30, 32}, p, logic));
  join(rectangle({-22, 0}, {22, 40}, p, logic));
  for (const Point centre : {Point{-22, 8}, Point{22, 8}, Point{22, 32}, Point{-22, 32}})
    join(disc(centre, 8, p));
  join(rectangle({-15, 32}, {15, 64}, p, logic));
  join(rectangle({-9, 32}, {9, 70}, p, logic));
  for (const Point centre : {Point{9, 64}, Point{-9, 64}}) join(disc(centre, 6, p));
  return all;
}

field::FieldGrid sampled(const field::GridFrame& frame, Logic logic) {
  field::FieldGrid grid{frame, field::Samples(frame.size()), field::Samples(frame.size()),
                        field::Samples(frame.size())};
  for (std::size_t n = 0; n < frame.size(); ++n) {
    const Jet jet = older_model(frame.node(n % frame.columns, n / frame.columns), logic);
    grid.value[n] = static_cast<float>(jet.value);
    grid.dx[n] = static_cast<float>(jet.gradient.x), grid.dy[n] = static_cast<float>(jet.gradient.y);
  }
  return grid;
}

/// Nodes farther than this from the outline are on the same side of it in both.
constexpr double kAside = 1e-6;  // mm
std::size_t wrong_signs(const field::FieldGrid& grid, const std::vector<double>& distances) {
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < distances.size(); ++n)
    if (std::abs(distances[n]) > kAside && (grid.value[n] > 0) != (distances[n] > 0)) ++wrong;
  return wrong;
}

/// Means of squares of kShrink pixels, 8 bits, to the right of what is in the row.
void append(draw::GreyImage& row, const draw::GreyImage& image) {
  const std::size_t columns = image.columns / kShrink, rows = image.rows / kShrink;
  const std::size_t before = row.columns == 0 ? 0 : row.columns + kGap;
  draw::GreyImage wider;
  wider.columns = before + columns, wider.rows = rows, wider.bits = 8;
  wider.pixels.assign(wider.columns * rows, 255);
  const std::uint32_t scale = (image.bits == 16 ? 257 : 1) * kShrink * kShrink;
  for (std::size_t y = 0; y < rows; ++y) {
    std::copy_n(row.pixels.begin() + static_cast<std::ptrdiff_t>(y * row.columns), row.columns,
                wider.pixels.begin() + static_cast<std::ptrdiff_t>(y * wider.columns));
    for (std::size_t x = 0; x < columns; ++x) {
      std::uint32_t sum = 0;
      for (std::size_t k = 0; k < kShrink * kShrink; ++k)
        sum += image.pixels[(y * kShrink + k / kShrink) * image.columns + x * kShrink + k % kShrink];
      wider.pixels[y * wider.columns + before + x] = static_cast<std::uint16_t>(sum / scale);
    }
  }
  row = std::move(wider);
}

Result<draw::GreyImage> row_of(const field::FieldGrid& grid) {
  LEKALO_TRY(const auto models, draw::voxel_pngs(field::voxel_images(grid)));
  LEKALO_TRY(const auto value, draw::value_png(grid));
  draw::GreyImage row;
  for (const std::string& png : {models[0], models[1], models[2], models[3], value}) {
    LEKALO_TRY(const auto image, draw::parse_grey_png(png, "picture"));
    append(row, image);
  }
  return row;
}

Result<void> drawn_model(const std::string& pocket, const std::string& figure) {
  LEKALO_TRY(const auto bytes, disk::read_file(pocket));
  LEKALO_TRY(const auto file, io::parse_regions(bytes, pocket));
  mill::PocketOptions options;
  options.method = mill::Method::floz_quadratic, options.whole = true;
  LEKALO_TRY(const auto floz, mill::floz_field(file.regions, options, kNodes));
  const std::vector<double> distances = field::signed_distances(geom::RegionIndex(file.regions), floz.frame);
  std::vector<field::FieldGrid> grids;
  for (const Logic logic : {Logic::linear, Logic::quadratic}) {
    grids.push_back(sampled(floz.frame, logic));
    if (const std::size_t wrong = wrong_signs(grids.back(), distances); wrong > 0)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: {} of {} nodes have another sign in the model of discs and rectangles; it "
                      "is that of paper-pocket.json",
                      pocket, wrong, distances.size()));
  }
  grids.push_back(floz);
  draw::GreyImage all;
  for (const field::FieldGrid& grid : grids) {
    LEKALO_TRY(const auto row, row_of(grid));
    if (all.columns > 0) all.pixels.insert(all.pixels.end(), kGap * row.columns, 255);
    all.columns = row.columns, all.bits = row.bits;
    all.pixels.insert(all.pixels.end(), row.pixels.begin(), row.pixels.end());
  }
  all.rows = all.pixels.size() / all.columns;
  LEKALO_TRY(const auto png, draw::grey_png(all));
  disk::AtomicFiles files;
  LEKALO_CHECK(files.add(figure, png));
  return files.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "bench_older_model paper-pocket.json FIGURE.png\n");
    return 2;
  }
  const auto drawn = drawn_model(argv[1], argv[2]);
  if (!drawn) fmt::print(stderr, "{}\n", drawn.error().message);
  return drawn ? 0 : 3;
}
