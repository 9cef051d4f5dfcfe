#include "pocket_reach.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/stop.hpp"
#include "verify/read/json.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/shape/shape.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kRows = 512;

double middle(Span s) { return 0.5 * (s.low + s.high); }
Place middle(const Vec& v) { return {middle(v.x), middle(v.y)}; }

/// Adds a side as strokes. An arc is cut where its tangent is level or upright, so that each stroke is
/// monotone and turns by at most a quarter.
void add_side(const Side& side, std::vector<Stroke>& strokes) {
  const Place from = middle(side.from), to = middle(side.to);
  if (!side.arc) {
    if (length(to - from) > 0) strokes.push_back({false, true, from, to, {}, 0});
    return;
  }
  const Place centre = middle(side.centre);
  const double r = middle(side.radius);
  std::vector<Stroke> quarters;
  add_arc(from, to, centre, side.ccw, kInfinity, quarters);
  for (const Stroke& q : quarters) {
    // At most one of the four extreme places lies inside a quarter turn; the ends of the stroke do not count.
    Stroke rest = q;
    for (const Place extreme : {Place{1, 0}, Place{0, 1}, Place{-1, 0}, Place{0, -1}}) {
      const double turn = q.ccw ? 1 : -1;
      if (turn * cross(q.from - centre, extreme) > 1e-9 * r &&
          turn * cross(extreme, q.to - centre) > 1e-9 * r) {
        const Place at = centre + r * extreme;
        strokes.push_back(until(q, at));
        rest = beginning(q, at);
      }
    }
    strokes.push_back(rest);
  }
}

Stroke reversed(Stroke s) {
  std::swap(s.from, s.to);
  s.ccw = !s.ccw;
  return s;
}

/// Returns twice the area, roughly. That is enough for the direction of a contour without a fault.
double turning_area(const std::vector<Stroke>& contour) {
  double sum = 0;
  for (const Stroke& s : contour) {
    const Place m = at_share(s, 0.5);
    sum += cross(s.from, m) + cross(m, s.to);
  }
  return sum;
}

/// Makes the stroke that lies `by` to the left of another, unless it shrinks to nothing.
bool shifted(const Stroke& s, double by, Stroke& result) {
  result = s;
  if (!s.arc) {
    const Place off = by * left_of(unit(s.to - s.from));
    result.from = s.from + off, result.to = s.to + off;
    return true;
  }
  const double radius = s.ccw ? s.radius - by : s.radius + by;
  if (!(radius > 1e-9)) return false;
  const auto moved = [&](Place p) { return s.centre + (radius / length(p - s.centre)) * (p - s.centre); };
  result.from = moved(s.from), result.to = moved(s.to), result.radius = radius;
  return true;
}

/// Cuts a stroke at places on it and returns the pieces.
std::vector<Stroke> cut_at(const Stroke& s, std::vector<Place> cuts) {
  const Place base = s.arc ? s.centre : s.from;
  const auto along = [&](Place p) {
    return s.arc ? std::abs(angle_between(s.from - base, p - base)) : dot(p - base, s.to - s.from);
  };
  std::sort(cuts.begin(), cuts.end(), [&](Place a, Place b) { return along(a) < along(b); });
  cuts.push_back(s.to);
  std::vector<Stroke> pieces;
  Place at = s.from;
  for (const Place cut : cuts) {
    const Stroke piece = beginning(until(s, cut), at);
    at = cut;
    if (length(cut - piece.from) > 0) pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

Result<PocketReach> PocketReach::make(const Document& pocket, double clearance, double air_width) {
  LEKALO_TRY(const Json json, parse_json(pocket.bytes, pocket.name));
  std::string complaint;
  const Shape shape = read_shape(json, "pocket", complaint);
  if (complaint.empty()) refuse_unknown_words(json, complaint);
  if (!complaint.empty()) return failure(ErrorCode::bad_input, fmt::format("{}: {}", pocket.name, complaint));
  if (const auto fault = fault_of(shape))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", pocket.name, *fault));
  PocketReach reach;
  reach.clearance_ = clearance;
  reach.low_ = {shape.low_x, shape.low_y}, reach.high_ = {shape.high_x, shape.high_y};
  std::vector<char> open;
  for (std::size_t piece = 0; piece + 1 < shape.piece_starts.size(); ++piece) {
    for (std::size_t c = shape.piece_starts[piece]; c < shape.piece_starts[piece + 1]; ++c) {
      std::vector<Stroke> contour;
      std::vector<char> is_open;
      for (std::size_t s = shape.contour_starts[c]; s < shape.contour_starts[c + 1]; ++s) {
        add_side(shape.sides[s], contour);
        is_open.resize(contour.size(), shape.sides[s].open ? 1 : 0);
      }
      const bool outer = c == shape.piece_starts[piece];
      if ((turning_area(contour) > 0) != outer) {
        std::reverse(contour.begin(), contour.end());
        std::reverse(is_open.begin(), is_open.end());
        for (Stroke& s : contour) s = reversed(s);
      }
      reach.drawn_.insert(reach.drawn_.end(), contour.begin(), contour.end());
      open.insert(open.end(), is_open.begin(), is_open.end());
    }
  }
  reach.air_ = Air(reach.drawn_, open, air_width);
  reach.sort_rows();
  reach.find_outline();
  const double cell = std::max(clearance, 1e-3 * length(reach.high_ - reach.low_));
  reach.outline_index_ = StrokeIndex(reach.low_, reach.high_, cell);
  for (std::size_t i = 0; i < reach.outline_.size(); ++i)
    reach.outline_index_.add(static_cast<std::uint32_t>(i), reach.outline_[i]);
  reach.find_limit();
  if (reach.limit_.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: a tool that keeps {:.6g} mm from the outline fits nowhere in this pocket",
                               pocket.name, clearance));
  return reach;
}

/// Finds the outline of pocket and air together. Walls and sides of strips are cut where they cross one
/// another, and a piece with pocket or air on its right belongs to no outline.
void PocketReach::find_outline() {
  outline_ = drawn_;
  if (air_.empty()) return;
  outline_.clear();
  std::vector<Stroke> all = drawn_;
  all.insert(all.end(), air_.sides().begin(), air_.sides().end());
  for (const Stroke& s : air_.sides()) {
    Place low, high;
    box_of(s, low, high);
    low_ = {std::min(low_.x, low.x), std::min(low_.y, low.y)};
    high_ = {std::max(high_.x, high.x), std::max(high_.y, high.y)};
  }
  sort_rows();
  std::vector<Place> cuts;
  for (const Stroke& s : all) {
    ask(1 + all.size() / 4);
    cuts.clear();
    for (const Stroke& other : all) {
      if (&other == &s) continue;
      add_crossings(s, other, cuts);
      // The side of a strip may run along a wall. Then what is behind it changes where one of the two ends.
      for (const Place end : {other.from, other.to})
        if (distance(end, s) <= 1e-9) cuts.push_back(end);
    }
    for (const Stroke& piece : cut_at(s, cuts)) {
      constexpr double kAside = 1e-6;  // mm
      const Place middle = at_share(piece, 0.5);
      if (length(piece) > kAside && !inside(middle - kAside * left_of(heading(piece, middle))))
        outline_.push_back(piece);
    }
  }
}

void PocketReach::sort_rows() {
  rows_.clear();
  rows_.resize(kRows);
  row_height_ = (high_.y - low_.y) / static_cast<double>(kRows);
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const double a = std::min(drawn_[i].from.y, drawn_[i].to.y),
                 b = std::max(drawn_[i].from.y, drawn_[i].to.y);
    const auto row = [&](double y) {
      return static_cast<std::size_t>(
          std::clamp((y - low_.y) / row_height_, 0.0, static_cast<double>(kRows - 1)));
    };
    for (std::size_t r = row(a); r <= row(b); ++r) rows_[r].push_back(static_cast<std::uint32_t>(i));
  }
}

/// Counts the crossings of a ray to the right; an odd number means inside. Every stroke is monotone in y and
/// half open.
bool PocketReach::in_drawing(Place p) const {
  const auto row =
      static_cast<std::size_t>(std::clamp((p.y - low_.y) / row_height_, 0.0, static_cast<double>(kRows - 1)));
  bool in = false;
  for (const std::uint32_t i : rows_[row])
    if (crosses_ray_to_the_right(drawn_[i], p)) in = !in;
  return in;
}

double PocketReach::depth(Place p) const {
  const double d = outline_index_.nearest(p, outline_);
  return inside(p) ? d : -d;
}

double PocketReach::from_allowed(Place p) const { return allowed(p) ? 0 : limit_index_.nearest(p, limit_); }

/// Step 9 of docs/design/simulate.md: the allowed places are bounded by strokes shifted inwards and by
/// circles about corners. All of these are cut where they cross one another, and a piece whose middle keeps
/// the clearance belongs to the boundary.
void PocketReach::find_limit() {
  std::vector<Stroke> carriers;
  for (const Stroke& s : outline_) {
    Stroke moved;
    if (shifted(s, clearance_, moved)) carriers.push_back(moved);
  }
  // Only the arc of a circle about a corner that faces between the normals of the two sides can matter.
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const Place v = outline_[i].to;
    for (std::size_t k = 0; k < outline_.size(); ++k) {
      if (!(std::abs(outline_[k].from.x - v.x) < 1e-9 && std::abs(outline_[k].from.y - v.y) < 1e-9)) continue;
      const Place a = left_of(heading(outline_[i], v)), b = left_of(heading(outline_[k], v));
      // The side of a strip and an arc may form a thorn where the outline turns back by half a turn, and its
      // tip is such a corner too.
      const bool thorn = std::abs(cross(a, b)) <= 1e-9 && dot(a, b) < 0;
      // The pocket bends round no other corner.
      if (!(cross(a, b) < -1e-12 || thorn)) continue;
      add_arc(v + clearance_ * a, v + clearance_ * b, v, false, kInfinity, carriers);
    }
  }
  StrokeIndex index(low_, high_, std::max(clearance_, 1e-3 * length(high_ - low_)));
  for (std::size_t i = 0; i < carriers.size(); ++i) index.add(static_cast<std::uint32_t>(i), carriers[i]);
  std::vector<std::uint32_t> close;
  std::vector<Place> cuts;
  for (const Stroke& s : carriers) {
    Place low, high;
    box_of(s, low, high);
    cuts.clear();
    index.near(0.5 * (low + high), 0.5 * length(high - low) + 1e-9, close);
    for (const std::uint32_t k : close) add_crossings(s, carriers[k], cuts);
    for (const Stroke& piece : cut_at(s, cuts))
      if (allowed(at_share(piece, 0.5))) limit_.push_back(piece);
  }
  limit_index_ = StrokeIndex(low_, high_, std::max(clearance_, 1e-3 * length(high_ - low_)));
  for (std::size_t i = 0; i < limit_.size(); ++i) limit_index_.add(static_cast<std::uint32_t>(i), limit_[i]);
}

}  // namespace lekalo::verify
