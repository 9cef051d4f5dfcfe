#pragma once

#include <vector>

#include "air.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "stroke_index.hpp"

namespace lekalo::verify {

/// A pocket, the places in it where the middle of the tool may be, and the distance of any place from both.
class PocketReach {
 public:
  /// \param clearance  the distance of the tool's middle from the outline: its radius and the stock to leave
  /// \param air_width  how far straight out of open edges there is nothing
  static Result<PocketReach> make(const Document& pocket, double clearance, double air_width);

  /// Says whether p lies in the pocket as drawn, or in the air beyond its open edges.
  [[nodiscard]] bool inside(Place p) const { return in_drawing(p) || air_.in_strips(p); }
  [[nodiscard]] bool in_drawing(Place p) const;
  [[nodiscard]] const Air& air() const { return air_; }
  /// Returns the distance from the outline, positive in the pocket.
  [[nodiscard]] double depth(Place p) const;
  /// Says whether the tool's middle may be at p: depth(p) must be at least the clearance, but for `slack`.
  [[nodiscard]] bool allowed(Place p, double slack = 1e-9) const { return depth(p) >= clearance_ - slack; }
  /// Returns the distance from the places where the tool's middle may be, 0 in them.
  [[nodiscard]] double from_allowed(Place p) const;

  [[nodiscard]] const std::vector<Stroke>& outline() const { return outline_; }
  [[nodiscard]] const StrokeIndex& outline_index() const { return outline_index_; }
  /// Returns the boundary of the allowed places.
  [[nodiscard]] const std::vector<Stroke>& limit() const { return limit_; }
  [[nodiscard]] const StrokeIndex& limit_index() const { return limit_index_; }
  [[nodiscard]] Place low() const { return low_; }
  [[nodiscard]] Place high() const { return high_; }
  [[nodiscard]] double clearance() const { return clearance_; }

 private:
  void sort_rows();
  void find_outline();
  void find_limit();

  double clearance_ = 0;
  Place low_, high_;
  /// The outline as drawn, with the pocket on its left.
  std::vector<Stroke> drawn_;
  /// The outline of pocket and air together; the same as drawn_ where no edge is open.
  std::vector<Stroke> outline_;
  Air air_;
  StrokeIndex outline_index_, limit_index_;
  std::vector<Stroke> limit_;
  /// By band of y: the strokes of the drawing whose box meets it.
  std::vector<std::vector<std::uint32_t>> rows_;
  double row_height_ = 1;
};

}  // namespace lekalo::verify
