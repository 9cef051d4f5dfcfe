#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/verify/cut_history.hpp"
#include "verify/pocket/stroke_index.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The places of a pocket's walls, and which of them a program cuts, by the checker's own reading (steps 1
/// and 2 of docs/design/heat-walls.md).

/// A place seen from above, and the direction from the pocket into the workpiece.
struct WallStation {
  double x = 0, y = 0;
  std::array<double, 2> outward{};
};

/// Along each edge that is no open one, so that they are `spacing` apart at most, mm. Of more than
/// limits::kMostHeatPlaces so many and one are returned.
[[nodiscard]] std::vector<WallStation> wall_stations(const Shape& pocket, double spacing);

class WallPlaces {
 public:
  /// \param reach  of the tool's rim, with what stays on walls, mm
  WallPlaces(std::vector<WallStation> stations, const CutHistory& history, double top, double thickness,
             double reach, double spacing);

  struct Which {
    std::size_t station = 0, height = 0;
  };
  /// The place that stands there, within what figures are rounded by; none for any other.
  [[nodiscard]] std::optional<Which> find(double x, double y, double z) const;
  [[nodiscard]] const WallStation& station(std::size_t i) const { return stations_[i]; }
  [[nodiscard]] std::size_t stations() const { return stations_.size(); }
  [[nodiscard]] std::size_t heights() const { return heights_.size(); }
  /// Says that there are more than limits::kMostHeatPlaces; then not all heights are there.
  [[nodiscard]] bool too_many() const;

  /// Looks at a station: the functions below are about it. Cost: the pieces of the path near it.
  void go_to(std::size_t station);
  /// Says that the tool comes near enough at a height; rounding decides where `near_limit` is true.
  struct Cut {
    bool is_cut = false, near_limit = false;
  };
  [[nodiscard]] Cut cut(std::size_t height) const;
  /// The tool beside the station once, as deep as a height, by its lines and arcs and not by their chords.
  struct Visit {
    double start{}, end{};            ///< s
    double distance{};                ///< mm
    std::array<double, 2> towards{};  ///< from its way to the station, of length 1
  };
  /// Returns the visits, in the order of time. \param slack  of the limit to which it is a visit, mm
  [[nodiscard]] std::vector<Visit> visits(std::size_t height, double slack) const;
  /// Says whether the tool is at its nearest to the place at this time, s.
  [[nodiscard]] bool visited(std::size_t height, double seconds) const;

 private:
  /// Divides each level of the program by itself: what cuts a place between two would be a matter of
  /// rounding.
  void set_heights(double top, double deepest, double spacing);
  [[nodiscard]] double nearest(std::size_t height) const;

  std::vector<WallStation> stations_;  ///< by x
  std::vector<double> heights_;        ///< from above
  std::vector<const CutPiece*> down_;
  std::vector<Stroke> strokes_;  ///< of each of them, the chord
  std::vector<Stroke> ways_;     ///< and the arc
  std::size_t at_ = 0;           ///< the station that is looked at
  StrokeIndex index_;
  std::vector<std::uint32_t> near_;  ///< which of them are near the station at hand
  std::vector<double> distances_;    ///< of these
  double reach_;
};

}  // namespace lekalo::verify
