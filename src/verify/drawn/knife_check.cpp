#include "knife_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "placed_sheet.hpp"
#include "trailing_blade.hpp"
#include "verify/number/span.hpp"
#include "verify/pocket/stroke_index.hpp"

namespace lekalo::verify {
namespace {

/// Half a plotter unit in x and in y.
constexpr double kWrittenCorner = 0.0178;
/// Corners are demanded of a tangential knife where they are sharper by so much, in radians, since directions
/// are rounded.
constexpr double kSharper = 1e-3;

/// Lines that places are to be near.
class NearLines {
 public:
  explicit NearLines(std::vector<Stroke> pieces) : pieces_(std::move(pieces)) {
    Place low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const Stroke& piece : pieces_) {
      Place from, to;
      box_of(piece, from, to);
      low = {std::min(low.x, from.x), std::min(low.y, from.y)};
      high = {std::max(high.x, to.x), std::max(high.y, to.y)};
    }
    if (pieces_.empty()) return;
    // A blade draws pieces of hundredths of a millimetre.
    index_ = StrokeIndex(low, high, 1e-3 + length(high - low) / 20'000);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) index_.add(i, pieces_[i]);
  }

  [[nodiscard]] double to(Place p) const { return pieces_.empty() ? kInfinity : index_.nearest(p, pieces_); }

  /// Returns a place of the piece that is farther than `reach`; nothing where all of it is nearer than
  /// `reach` and `slack`.
  [[nodiscard]] std::optional<Place> far(const Stroke& piece, double reach, double slack) const {
    ask();
    const Place middle = at_share(piece, 0.5);
    const double off = to(middle);
    // Written so that a distance that is no number is far.
    if (!(off <= reach)) return middle;
    if (is_along_one(piece, middle, reach)) return std::nullopt;
    // No place of the piece is farther from its middle than half its length.
    if (0.5 * length(piece) <= std::max(slack, reach - off)) return std::nullopt;
    const auto first = far(until(piece, middle), reach, slack);
    return first ? first : far(beginning(piece, middle), reach, slack);
  }

 private:
  /// Says whether a line has both ends within reach of one line, and so all of it.
  [[nodiscard]] bool is_along_one(const Stroke& piece, Place middle, double reach) const {
    if (piece.arc) return false;
    std::vector<std::uint32_t> near;
    index_.near(middle, reach, near);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t i) {
      return !pieces_[i].arc && distance(piece.from, pieces_[i]) <= reach &&
             distance(piece.to, pieces_[i]) <= reach;
    });
  }

  std::vector<Stroke> pieces_;
  StrokeIndex index_;
};

std::vector<Stroke> pieces_of(const std::vector<const DrawnLine*>& lines) {
  std::vector<Stroke> pieces;
  for (const DrawnLine* line : lines)
    for (const Stroke& edge : line->edges) add_pieces(edge, kInfinity, pieces);
  return pieces;
}

/// Adds a finding for the first place of `pieces` that is too far from `others`.
void hold_near(const std::vector<Stroke>& pieces, const std::vector<Stroke>& others, double tolerance,
               double slack, const char* what, ClaimReport& report) {
  const NearLines near(others);
  for (const Stroke& piece : pieces)
    if (const auto place = near.far(piece, tolerance - 2 * slack, slack)) {
      report.findings.push_back(
          fmt::format("layer CUT: {} ({:.3f}, {:.3f}), {:.3f} mm away; {} mm are allowed", what, place->x,
                      place->y, near.to(*place), tolerance));
      return;
    }
}

/// Returns what the tip of a drag knife draws.
std::vector<Stroke> drawn_by_blade(const std::vector<const DrawnLine*>& strokes, const KnifeWords& words,
                                   double within, ClaimReport& report) {
  TrailingBlade blade(words.blade_offset, within);
  std::vector<Stroke> tips;
  for (const DrawnLine* stroke : strokes)
    for (const Stroke& edge : stroke->edges)
      if (!blade.draw(edge.from, edge.to, tips)) {
        report.findings.push_back(fmt::format(
            "layer CUT: from ({:.3f}, {:.3f}) on the blade is pushed backwards", edge.from.x, edge.from.y));
        return tips;
      }
  return tips;
}

/// Every corner that is sharp is a place where a stroke begins, and one where a stroke ends.
void hold_corners(const std::vector<const DrawnLine*>& strokes, const std::vector<const DrawnLine*>& contours,
                  double turn_above, ClaimReport& report) {
  std::vector<Stroke> begins, ends;
  for (const DrawnLine* stroke : strokes) {
    begins.push_back(line_between(stroke->edges.front().from, stroke->edges.front().from));
    ends.push_back(line_between(stroke->edges.back().to, stroke->edges.back().to));
  }
  const NearLines begun(begins), ended(ends);
  for (const DrawnLine* contour : contours)
    for (std::size_t i = 0; i < contour->edges.size(); ++i) {
      const Stroke& in = contour->edges[i];
      const Stroke& out = contour->edges[(i + 1) % contour->edges.size()];
      const double turn = std::abs(angle_between(heading(in, in.to), heading(out, out.from)));
      if (turn <= turn_above + kSharper) continue;
      if (begun.to(in.to) <= kWrittenCorner && ended.to(in.to) <= kWrittenCorner) continue;
      report.findings.push_back(fmt::format(
          "layer CUT: the knife is not lifted at the corner ({:.3f}, {:.3f}), which turns by {:.1f} "
          "degrees",
          in.to.x, in.to.y, turn * kDegreesPerRadian));
      return;
    }
}

}  // namespace

void check_knife(const std::vector<const DrawnLine*>& strokes, const std::vector<const DrawnLine*>& contours,
                 const KnifeWords& words, ClaimReport& report) {
  const double slack = words.tolerance / 64;
  const std::size_t before = report.findings.size();
  const bool drags = words.blade_offset > 0;
  if (drags && strokes.size() != contours.size())
    report.findings.push_back(fmt::format("layer CUT has {} strokes of the knife and is to have {}",
                                          strokes.size(), contours.size()));
  if (!drags) hold_corners(strokes, contours, words.turn_above, report);
  const std::vector<Stroke> tips = drags ? drawn_by_blade(strokes, words, slack, report) : pieces_of(strokes),
                            wanted = pieces_of(contours);
  hold_near(tips, wanted, words.tolerance, slack, "the tip of the knife leaves the outlines at", report);
  hold_near(wanted, tips, words.tolerance, slack, "the knife does not cut the outline at", report);
  if (report.findings.size() > before) return;
  report.notes.push_back(fmt::format("the tip of the knife follows {} outlines within {} mm{}",
                                     contours.size(), words.tolerance,
                                     drags ? ", if the blade points along +x before the plot" : ""));
}

}  // namespace lekalo::verify
