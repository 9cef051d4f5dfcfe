#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::draw {

/// A solid part placed in a solid blank, as pictures, reports and pages show it. docs/design/picture.md.
struct SolidScene {
  /// Names or paths, any bytes. Of a path the last name is shown.
  std::string part_name, blank_name;
  std::string status, method;
  /// mm, each in its own frame; with triangles. The part is best that of locate::measured_part, whose colours
  /// are right between the vertices too.
  solid::Mesh part, blank;
  /// Its contacts are numbered from 1 in the order given. A part that is not inside has none.
  locate::SolidPlacement placement;
  std::optional<double> upper_bound;  ///< mm; none where nothing is proved
  /// With demands by face: what is left over all of them, and what it is proved to be at most, mm.
  struct Margin {
    std::optional<double> is, bound;
    bool of_place = false;  ///< only placements that keep datums, maxima and finished faces count
  };
  /// Counts in place of upper_bound.
  std::optional<Margin> margin;
  /// The demand and what is missing of it, mm.
  double min_allowance = 0, shortfall = 0;
  /// At each vertex of the part, mm, negative outside the blank; or none. With demands by face it is what is
  /// left over the demand, in units of its scale, and no number (NaN) where the part is as cast.
  std::vector<double> allowances;
  /// Allowances below this are missing.
  [[nodiscard]] double least_wanted() const { return margin ? 0 : min_allowance; }
  /// Triangles of the blank that nobody measured, by number, and their area.
  std::vector<std::uint32_t> unknown;
  double unknown_area = 0;  ///< mm2
  /// Sentences that belong under the picture.
  std::vector<std::string> notes;
};

/// The picture as PNG bytes, 4 wide by 3 high: the part in the colours of its allowance within a blank of
/// glass, seen without perspective from where the tightest contact faces the viewer; contacts with numbers
/// and lengths; a section through the tightest one, whole and magnified; a scale, a legend and the figures.
/// Where less than demanded is left the part is red, and what nobody measured is yellow.
///
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
/// \pre coordinates are finite and of size 1e12 at most, `allowances` is empty or has one for each vertex,
///      and the numbers in `unknown` are those of triangles
/// Same input, same bytes on a machine with the same libraries and fonts, for any number of threads.
/// Cost: 100,000 triangles of each within a second.
[[nodiscard]] Result<std::string> solid_png(const SolidScene& scene, int width_px = 1600,
                                            unsigned threads = kUsualThreads);

/// The surface of the placed part as PLY for other viewers, in the frame of the blank: at each vertex the
/// allowance, mm, or what is left over the demand, as `quality`, and its colour in the picture. \pre there
/// are allowances
[[nodiscard]] std::string solid_surface(const SolidScene& scene);

/// Points as PLY for other viewers: of each the deviation, mm, as `quality`, and its colour on the scale of
/// those that are not below 0; the others are red. \pre there is one deviation for each point
[[nodiscard]] std::string solid_points(const std::vector<solid::Vector>& points,
                                       const std::vector<double>& deviations);

/// The scene as one page of HTML without links, which turns with mouse, finger and keys (WebGL2): part,
/// blank, contacts, what nobody measured, where material is missing, and a section. It shows places to
/// 1/65,535 of the size; figures are printed as in the picture. Whatever the texts hold is shown as text.
/// \pre as of solid_png
/// Same input, same bytes.
[[nodiscard]] std::string solid_page(const SolidScene& scene);

}  // namespace lekalo::draw
