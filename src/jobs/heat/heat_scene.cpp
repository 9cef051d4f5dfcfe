#include "heat_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "heat_picture.hpp"
#include "heat_walls.hpp"
#include "lekalo/draw/heat_scene.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/heat_words.hpp"

namespace lekalo::jobs {
namespace {

using heat::Property;

/// A page keeps so many places of the path.
constexpr std::size_t kMostOfPath = 20'000;
/// Colours need a range, K and parts.
constexpr double kLeastRange = 1e-3;

std::string file_part(const std::string& path) {
  return io::as_utf8(path.substr(path.find_last_of('/') + 1));
}

/// The greatest value of each column of voxels at any height, no number without material, and where the
/// greatest of all is. Voxels without material have values below 0.
struct SeenFromAbove {
  std::vector<float> values;
  std::size_t most = 0;  ///< a voxel
};
SeenFromAbove seen(const heat::Grid& grid, const std::vector<float>& voxels) {
  SeenFromAbove made{std::vector<float>(grid.count[0] * grid.count[1], -1), 0};
  for (std::size_t cell = 0; cell < voxels.size(); ++cell) {
    float& value = made.values[cell % made.values.size()];
    value = std::max(value, voxels[cell]);
    if (voxels[cell] > voxels[made.most]) made.most = cell;
  }
  for (float& value : made.values)
    if (value < 0) value = std::numeric_limits<float>::quiet_NaN();
  return made;
}

heat::Place middle_of(const heat::Grid& grid, std::size_t cell) {
  const std::size_t row = cell / grid.count[0];
  return grid.middle(cell % grid.count[0], row % grid.count[1], row / grid.count[1]);
}

/// A layer of temperatures, degrees Celsius.
draw::HeatLayer warmth_layer(std::string title, const HeatResultJob& job, const heat::Grid& grid,
                             const std::vector<float>& rises) {
  const auto [values, most] = seen(grid, rises);
  const double ambient = job.heat.ambient_c;
  const heat::Place at = middle_of(grid, most);
  draw::HeatLayer layer;
  layer.title = std::move(title), layer.unit = "°C", layer.least = ambient;
  layer.greatest = ambient + std::max<double>(kLeastRange, rises[most]);
  layer.most_at = {at.x, at.y};
  layer.most =
      fmt::format("{:.1f} °C at X {:.1f} Y {:.1f} Z {:.1f}", ambient + rises[most], at.x, at.y, at.z);
  layer.values = values;
  for (float& value : layer.values) value += static_cast<float>(ambient);
  return layer;
}

/// The largest stress as a part of the least yield stress, per cent.
draw::HeatLayer stress_layer(const HeatResultJob& job, const HeatFound& found) {
  const HeatCase& middle = found.middle();
  const double yield = job.heat.material[Property::yield].least;
  draw::HeatLayer layer;
  layer.title = "largest thermal stress (von Mises), part of the yield stress", layer.unit = "%";
  layer.values = seen(found.grid, found.record->stress_mpa).values;
  for (float& value : layer.values)
    if (value > 0) value = static_cast<float>(100 * value / yield);
  layer.greatest = std::max(kLeastRange, 100 * middle.stress_mpa / yield);
  layer.most_at = {middle.stress_at.x, middle.stress_at.y};
  layer.most = fmt::format("{:.3g} MPa at X {:.1f} Y {:.1f} Z {:.1f} after {:.0f} s", middle.stress_mpa,
                           middle.stress_at.x, middle.stress_at.y, middle.stress_at.z, middle.stress_seconds);
  return layer;
}

/// Displacements of the corners of voxels, and their extremes where there is material below.
void add_displacement(const HeatFound& found, draw::HeatScene& scene) {
  const heat::Grid& grid = found.grid;
  const auto [nx, ny, nz] = grid.count;
  const auto solid = [&, nx = nx, ny = ny, nz = nz](std::size_t i, std::size_t j) {
    for (std::size_t b = j > 0 ? j - 1 : 0; b <= std::min(j, ny - 1); ++b)
      for (std::size_t a = i > 0 ? i - 1 : 0; a <= std::min(i, nx - 1); ++a)
        if (found.record->at_end_k[grid.cell(a, b, nz - 1)] >= 0) return true;
    return false;
  };
  bool any = false;
  for (std::size_t j = 0; j <= ny; ++j)
    for (std::size_t i = 0; i <= nx; ++i) {
      const heat::Place& moved = found.record->moved[j * (nx + 1) + i];
      scene.moved_um.push_back({1000 * moved.x, 1000 * moved.y});
      if (!solid(i, j)) continue;
      const double lifted = 1000 * moved.z;
      scene.moved_most_um = std::max(scene.moved_most_um, geom::norm(scene.moved_um.back()));
      scene.lifted_um =
          any ? std::array{std::min(scene.lifted_um[0], lifted), std::max(scene.lifted_um[1], lifted)}
              : std::array{lifted, lifted};
      any = true;
    }
}

std::vector<std::uint8_t> in_steps(const std::vector<float>& view, double greatest) {
  std::vector<std::uint8_t> steps;
  for (const float value : view)
    steps.push_back(
        value < 0 ? 0
                  : static_cast<std::uint8_t>(1 + std::lround(254 * std::clamp(value / greatest, 0.0, 1.0))));
  return steps;
}

void add_moments(const HeatResultJob& job, const HeatFound& found, draw::HeatScene& scene) {
  const HeatRecord& record = *found.record;
  const double greatest = scene.warmest.greatest - scene.warmest.least;
  scene.moment_count = record.count;
  const std::array<double, 3> pitch = found.grid.pitches();
  for (std::size_t axis = 0; axis < 3; ++axis)
    scene.moment_size[axis] = static_cast<double>(record.count[axis] * record.fold) * pitch[axis];
  for (const HeatFrame& frame : record.frames)
    scene.moments.push_back({frame.seconds, job.heat.ambient_c + *std::ranges::max_element(frame.from_above),
                             in_steps(frame.from_above, greatest), in_steps(frame.from_front, greatest)});
  const std::vector<heat::ToolPiece>& pieces = found.source.pieces;
  const std::size_t each = pieces.size() / kMostOfPath + 1;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const heat::ToolPiece& p = pieces[i];
    if (i == 0) scene.path.push_back({p.start, p.from[0], p.from[1], p.from[2]});
    if (i % each == 0 || i + 1 == pieces.size())
      scene.path.push_back({p.start + p.seconds, p.to[0], p.to[1], p.to[2]});
  }
  scene.seconds = found.source.work.seconds;
}

/// Returns the correction of which a program was written, or nullptr.
const HeatCorrection* corrected_in(const HeatResult& made) {
  return made.correction && !made.correction->program.empty() ? &*made.correction : nullptr;
}

Result<draw::HeatScene> scene_of(const HeatResultJob& job, const HeatResult& made) {
  const HeatFound& found = made.found;
  const HeatSourceJob& source = job.heat.source;
  std::vector<geom::Edge> open;
  LEKALO_TRY(io::RegionFile pocket, io::parse_regions(source.pocket.bytes, source.pocket.name, {}, &open));
  draw::HeatScene scene;
  scene.name = file_part(source.program.name);
  scene.title = {
      fmt::format("{}: temperature, stress and displacement of {}", scene.name, job.heat.material.name),
      fmt::format("at the middles of all intervals; the warmest place may be {} °C, the largest stress "
                  "{} MPa",
                  between("{:.3g}", {job.heat.ambient_c + found.warmest_k.least,
                                     job.heat.ambient_c + found.warmest_k.greatest}),
                  between("{:.3g}", found.stress_mpa))};
  const heat::StockBox& box = found.source.stock.box;
  scene.stock = {{box.low_x, box.low_y}, {box.high_x, box.high_y}};
  if (const auto& read = found.source.stock.read) scene.outline = read->outline.regions;
  scene.pockets = std::move(pocket.regions);
  scene.count = {found.grid.count[0], found.grid.count[1]};
  scene.warmest = warmth_layer("warmest at any time", job, found.grid, found.record->warmest_k);
  scene.at_end = warmth_layer("temperature at the end", job, found.grid, found.record->at_end_k);
  // At the end all is warm, and what differs is small.
  double coolest = scene.at_end.greatest - kLeastRange;
  for (const float value : scene.at_end.values)
    if (value < coolest) coolest = value;
  scene.at_end.least = coolest;
  scene.stress = stress_layer(job, found);
  add_displacement(found, scene);
  const std::vector<double>& errors_um = found.middle().errors_um;
  const auto strip = [&](const std::string& what, const WallErrors& errors,
                         std::vector<draw::HeatColumn> walls) {
    scene.strips.push_back(
        {fmt::format("{}: {:+.2f} to {:+.2f} um", what, errors.least, errors.most), std::move(walls)});
  };
  strip("as the program is", found.errors, heat_columns(found.walls, errors_um));
  strip(fmt::format("scaled by {:.6f}", found.scaling.factor), found.scaling.left,
        heat_columns(found.walls, scaled(found.walls, errors_um, 1, found.scaling)));
  const HeatCorrection* const moved = corrected_in(made);
  if (moved != nullptr && !moved->errors_um.empty())
    strip("finishing passes moved", moved->after, heat_columns(moved->found.walls, moved->errors_um));
  scene.spacing = job.heat.pitch, scene.height = height_of(scene.strips.front().walls, job.heat.pitch);
  scene.tool_diameter = source.machining.tool_diameter;
  scene.largest_um = std::max({found.errors.largest(), found.scaling.left.largest(), 1e-3});
  scene.low_z = source.machining.top - box.thickness, scene.high_z = source.machining.top;
  add_moments(job, found, scene);
  return scene;
}

std::string of_middle(const char* form, double middle, const heat::Interval& over) {
  return fmt::format("{}; {}", fmt::format(fmt::runtime(form), middle), between(form, over));
}

draw::HeatReport report_of(const HeatResultJob& job, const HeatResult& made, draw::HeatScene scene) {
  const HeatFound& found = made.found;
  const HeatJob& heat = job.heat;
  const HeatSourceJob& source = heat.source;
  const heat::CuttingWork& work = found.source.work;
  draw::HeatReport report;
  report.title = "Heat of " + scene.name;
  report.subtitle = fmt::format(
      "on {} in {}, tool {:g} mm, {} teeth, {:g} rev/min", file_part(source.pocket.name), heat.material.name,
      source.machining.tool_diameter, source.cutting.teeth, source.cutting.spindle_rpm);
  report.status = "computed";
  report.decision = heat_decision(found);
  const HeatWait wait = heat_wait(found);
  report.decision.push_back(fmt::format("It cools down {}: {}.", wait.lasts, wait.verdict));
  const HeatCorrection* const moved = corrected_in(made);
  if (moved != nullptr)
    report.decision.push_back(fmt::format("{} has its finishing passes moved, and leaves {} um.",
                                          file_part(job.corrected_as),
                                          between("{:.2f}", moved->after_over.largest)));
  const HeatCase& middle = found.middle();
  const double balance = found.book.in > 0 ? found.book.in : 1, yield = heat.material[Property::yield].least;
  report.figures = {
      {"largest error, um", of_middle("{:.2f}", found.errors.largest(), found.largest_um), true},
      {"mean error, um", of_middle("{:+.2f}", found.errors.mean, found.errors_over.mean)},
      {"largest if scaled, um", of_middle("{:.2f}", found.scaling.left.largest(), found.scaled_over.largest)},
      {"best scaling", of_middle("{:.6f}", found.scaling.factor, found.factors)},
      {"warmest rise, K", of_middle("{:.3g}", middle.warmest_k, found.warmest_k)},
      {"largest stress, MPa", of_middle("{:.3g}", middle.stress_mpa, found.stress_mpa)},
      {"of the yield stress, %",
       of_middle("{:.2g}", 100 * middle.stress_mpa / yield,
                 {100 * found.stress_mpa.least / yield, 100 * found.stress_mpa.greatest / yield})},
      {"time, cutting, s", fmt::format("{:.0f}, {:.0f}", work.seconds, work.cutting_seconds)},
      {"stays, lost, chips, %",
       fmt::format("{:.0f}, {:.0f}, {:.0f}", 100 * found.book.stored / balance,
                   100 * found.book.lost / balance, 100 * found.book.removed / balance)}};
  report.sensitivity = {{fmt::format("share {}", between("{:.3g}", found.share)),
                         between("{:.2f}", found.sensitivity.share) + " um"},
                        {fmt::format("work {} J", between("{:.0f}", work.work_j)),
                         between("{:.2f}", found.sensitivity.force) + " um"},
                        {fmt::format("film {} W/m2K", between("{:.4g}", heat.film)),
                         between("{:.2f}", found.sensitivity.film) + " um"},
                        {"heat of the workpiece, J", between("{:.0f}", found.heat_j)}};
  for (std::size_t i = 0; i < heat.measured.size(); ++i) {
    const MeasuredTemperature& m = heat.measured[i];
    report.sensitivity.push_back({fmt::format("measured {:g} °C ±{:g}", m.celsius, m.uncertainty_k),
                                  between("{:.0f}", found.supported_j[i]) + " J"});
  }
  const auto input = [&](const char* role, const File& file) {
    report.inputs.push_back({role, io::as_utf8(file.name), io::sha256(file.bytes)});
  };
  input("program", source.program), input("pocket", source.pocket);
  if (source.stock.outline) input("stock", *source.stock.outline);
  for (const EarlierProgram& before : source.after) input("after", before.program);
  report.warnings = made.warnings;
  report.assumptions = {
      "Figures: at the middles of all intervals; over share, cutting force and cooling.",
      fmt::format("Held: {}. Voxels of {:g} mm. Surroundings {:g} °C.", name_of(heat.holding), heat.pitch,
                  heat.ambient_c),
      "Not modelled: growth of the machine and the tool, residual stress, deflection by force."};
  report.made = fmt::format("{} voxels, work {}", found.grid.size(), found.work);
  report.scene = std::move(scene);
  return report;
}

Result<std::string> drawn_maps(const draw::HeatScene& scene, PictureForm form) {
  if (form == PictureForm::pdf) return failure(ErrorCode::usage, "maps of heat are drawn as SVG or PNG");
  if (form == PictureForm::png) return draw::heat_maps_png(scene);
  return draw::heat_maps_svg(scene);
}

Result<std::string> drawn_report(const draw::HeatReport& report, PictureForm form) {
  if (form == PictureForm::pdf) return draw::heat_report_pdf(report);
  if (form == PictureForm::png) return draw::heat_report_png(report);
  return draw::heat_report_svg(report);
}

}  // namespace

Result<void> add_heat_scenes(const HeatResultJob& job, HeatResult& made) {
  if (!job.maps && !job.report && !job.animation) return {};
  LEKALO_TRY(draw::HeatScene scene, scene_of(job, made));
  if (job.maps) {
    LEKALO_TRY(made.maps, drawn_maps(scene, *job.maps));
  }
  if (job.animation) made.animation = draw::heat_page(scene);
  if (job.report) {
    LEKALO_TRY(made.report, drawn_report(report_of(job, made, std::move(scene)), *job.report));
  }
  return {};
}

}  // namespace lekalo::jobs
