#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/field/floz.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::field {

struct ContourModelOptions {
  /// Lines and arcs become segments no longer than this, mm (of arcs the chords).
  double step = 3;
  Logic logic = Logic::quadratic;
  FlozForm form = FlozForm::normalised;
};

/// The source's model of an outline: the R-conjunction of the FLOZ of its segments, 0 exactly on them;
/// positive inside, negative outside. The segments' order and directions change no bit: they are sorted, and
/// the quadratic conjunction, which is not associative, is folded as a balanced binary tree over the sorted
/// list.
class ContourModel {
 public:
  /// bad_input for a step that is not above 0 or would make more than a million segments, and for no regions.
  /// \pre regions made by make_region, apart from one another
  [[nodiscard]] static Result<ContourModel> make(const std::vector<geom::Region>& regions,
                                                 const ContourModelOptions& options);

  /// Value and gradient of the signed function. Cost: O(segments).
  [[nodiscard]] Jet operator()(geom::Point x) const;
  /// The function without its sign.
  [[nodiscard]] Jet unsigned_at(geom::Point x) const;
  /// True when x is inside the chords; either answer for points on them.
  [[nodiscard]] bool inside(geom::Point x) const;

  [[nodiscard]] const std::vector<FlozSegment>& segments() const { return segments_; }
  [[nodiscard]] const ContourModelOptions& options() const { return options_; }
  /// The chords, as pairs of points, sorted as the segments are.
  struct Chord {
    geom::Point a, b;
  };
  [[nodiscard]] const std::vector<Chord>& chords() const { return chords_; }

 private:
  ContourModelOptions options_;
  std::vector<Chord> chords_;
  std::vector<FlozSegment> segments_;
};

/// The conjunction of values in this order as a balanced binary tree. \pre not empty
[[nodiscard]] Jet folded(const std::vector<Jet>& values, Logic logic);

}  // namespace lekalo::field
