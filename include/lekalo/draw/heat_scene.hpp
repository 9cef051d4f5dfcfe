#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/draw/heat_picture.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::draw {

/// Values of a workpiece seen from above: of each place the greatest at any height, x first; no number (NaN)
/// where there is no material.
struct HeatLayer {
  std::string title, unit;  ///< UTF-8
  std::vector<float> values;
  double least = 0, greatest = 1;  ///< what the colours reach from and to; least < greatest
  geom::Point most_at;             ///< of the greatest value
  std::string most;                ///< words about it
};

/// A place of the tool's tip at a time.
struct HeatToolPlace {
  double seconds = 0, x = 0, y = 0, z = 0;
};

/// Temperatures at a moment as a page plays them: 0 where there is no material, else 1 to 255 from least to
/// greatest.
struct HeatMoment {
  double seconds = 0, warmest = 0;  ///< warmest: in the unit of the layers
  std::vector<std::uint8_t> from_above, from_front;
};

/// The walls of a pocket with their errors, and words about them.
struct HeatStrip {
  std::string words;  ///< UTF-8
  std::vector<HeatColumn> walls;
};

/// Temperatures, stress, displacement and errors of walls, at the middles of all intervals.
struct HeatScene {
  std::string name;  ///< of the program, UTF-8
  std::array<std::string, 2> title;
  geom::Box stock;                    ///< the block, or the box about its outline
  std::vector<geom::Region> outline;  ///< empty for a block
  std::vector<geom::Region> pockets;
  std::array<std::size_t, 2> count{};  ///< places of layers along x and y
  HeatLayer warmest, at_end, stress;
  /// Displacement of the corners of places at the upper face at the end of the program, um, x first.
  std::vector<geom::Point> moved_um;
  double moved_most_um = 0;           ///< the longest in the plane
  std::array<double, 2> lifted_um{};  ///< the least and the greatest along Z
  /// The walls as they are, what the best scaling leaves, and what moved finishing passes leave where they
  /// are moved.
  std::vector<HeatStrip> strips;
  double spacing = 0, height = 0;  ///< of places along a wall, and up it, mm
  double tool_diameter = 0;        ///< mm
  double largest_um = 0;           ///< what the colours of errors reach to; above 0

  /// For the page.
  double low_z = 0, high_z = 0;               ///< of the stock
  std::array<std::size_t, 3> moment_count{};  ///< places of moments along x, y and z
  std::array<double, 3> moment_size{};        ///< of all of them together, mm; may reach beyond the stock
  std::vector<HeatMoment> moments;
  std::vector<HeatToolPlace> path;
  double seconds = 0;  ///< of the program
};

/// One page (280 x 236 mm, 27 mm more with a third strip): from above the largest temperature, that at the
/// end, the largest stress, and the displacement, exaggerated by a stated number; below, the strips of walls,
/// unrolled. Same input, same bytes (on a machine with the same libraries and fonts).
[[nodiscard]] std::string heat_maps_svg(const HeatScene& scene);
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
[[nodiscard]] Result<std::string> heat_maps_png(const HeatScene& scene, int width_px = 1900);

/// Words and figures of a report.
struct HeatReport {
  HeatScene scene;
  std::string title, subtitle, status;
  std::vector<std::string> decision;  ///< sentences
  struct Row {
    std::string what, value;
    bool strong = false;
  };
  std::vector<Row> figures, sensitivity;
  struct Input {
    std::string role, words, sha256;
  };
  std::vector<Input> inputs;
  std::vector<std::string> warnings, assumptions;
  std::string made;  ///< how, for the foot of the page
};

/// One page (A4): the decision, figures with their intervals, what the error hangs on, the maps, the strips
/// of walls, the files, and what is assumed.
[[nodiscard]] std::string heat_report_svg(const HeatReport& report);
[[nodiscard]] Result<std::string> heat_report_png(const HeatReport& report, int width_px = 1600);
[[nodiscard]] Result<std::string> heat_report_pdf(const HeatReport& report);

/// A page that plays the temperatures over the time of the program in a browser, from above and from the
/// front, with the tool, a slider, and the warmest place over time. One file, no links, at most some 3 MB:
/// of the path at most 20,000 places are kept.
[[nodiscard]] std::string heat_page(const HeatScene& scene);

}  // namespace lekalo::draw
