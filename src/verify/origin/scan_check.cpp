#include "scan_check.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "verify/number/surely.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// One edge of an outline through measured points.
struct ScanEdge {
  std::size_t from = 0, to = 0;
  /// The points that were measured beside it.
  std::vector<std::size_t> beside;
};
using ScanOutline = std::vector<ScanEdge>;

double middle(Span value) { return 0.5 * value.low + 0.5 * value.high; }
bool equal(const Vec& p, const Vec& q) {
  return p.x.low == q.x.low && p.x.high == q.x.high && p.y.low == q.y.low && p.y.high == q.y.high;
}

class ScanCheck {
 public:
  ScanCheck(const WrittenScan& scan, const MeasuredPoints& points, const Shape& blank)
      : scan_(scan), points_(points.at), starts_(points.contour_starts), blank_(blank) {}

  ScanVerdict run() {
    if (scan_.points != points_.size())
      complain(fmt::format("there are {} points, not {}", points_.size(), scan_.points));
    kept_.assign(points_.size(), true);
    for (const std::size_t k : scan_.left_out)
      if (k < kept_.size())
        kept_[k] = false;
      else
        complain(fmt::format("there is no point {} to be left out", k));
    if (verdict_.fault.empty()) scan_.ordered ? join_in_order() : join_as_written();
    if (verdict_.fault.empty()) check_outlines();
    if (verdict_.fault.empty()) check_parity();
    return verdict_;
  }

 private:
  void complain(std::string sentence) {
    if (verdict_.fault.empty()) verdict_.fault = std::move(sentence);
  }

  void add_outline(std::vector<std::size_t> corners) {
    std::vector<std::size_t> loop;
    for (const std::size_t k : corners)
      if (loop.empty() || !equal(points_[loop.back()], points_[k])) loop.push_back(k);
    while (!loop.empty() && equal(points_[loop.front()], points_[loop.back()])) loop.pop_back();
    if (loop.size() < 3) return complain("a contour of the scan has fewer than three points");
    ScanOutline outline;
    for (std::size_t i = 0; i < loop.size(); ++i)
      outline.push_back({loop[i], loop[(i + 1) % loop.size()], {}});
    outlines_.push_back(std::move(outline));
  }

  void join_in_order() {
    for (std::size_t c = 0; c < starts_.size(); ++c) {
      const std::size_t end = c + 1 < starts_.size() ? starts_[c + 1] : points_.size();
      std::vector<std::size_t> corners;
      for (std::size_t k = starts_[c]; k < end; ++k)
        if (kept_[k]) corners.push_back(k);
      add_outline(std::move(corners));
    }
    if (outlines_.empty()) complain("the scan has no contour");
  }

  void join_as_written() {
    std::vector<bool> corner(points_.size(), false);
    for (const std::vector<std::size_t>& loop : scan_.outlines) {
      for (const std::size_t k : loop) {
        if (k >= points_.size() || !kept_[k]) return complain(fmt::format("an outline has a point {}", k));
        if (corner[k]) return complain(fmt::format("two outlines, or one twice, have point {}", k));
        corner[k] = true;
      }
      add_outline(loop);
      if (!verdict_.fault.empty()) return;
    }
    if (outlines_.empty()) return complain("there are no outlines through the points");
    attach(corner);
  }

  /// Every other point was measured beside the nearer of the two edges at the corner nearest to it, which is
  /// within the spread of corners.
  void attach(const std::vector<bool>& corner) {
    const double spread = std::max(6 * scan_.guard.high, 0.125 * scan_.step.high) * (1 + 1e-12);
    std::vector<Box> boxes;
    std::vector<std::pair<std::size_t, std::size_t>> place;
    for (std::size_t l = 0; l < outlines_.size(); ++l)
      for (std::size_t i = 0; i < outlines_[l].size(); ++i) {
        boxes.push_back(box_of(points_[outlines_[l][i].from]));
        place.emplace_back(l, i);
      }
    const SideTree corners(std::move(boxes));
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (corner[k] || !kept_[k]) continue;
      double least = kInfinity;
      std::size_t nearest = 0;
      corners.visit_near(box_of(points_[k]), spread, [&](std::size_t j) {
        const double apart =
            middle(length(points_[k] - points_[outlines_[place[j].first][place[j].second].from]));
        if (apart < least || (apart == least && j < nearest)) least = apart, nearest = j;
      });
      if (least == kInfinity) return complain(fmt::format("point {} is at no outline through the points", k));
      ScanOutline& outline = outlines_[place[nearest].first];
      const std::size_t at = place[nearest].second, before = (at + outline.size() - 1) % outline.size();
      const bool back = from_edge(k, outline[before]) < from_edge(k, outline[at]);
      outline[back ? before : at].beside.push_back(k);
    }
  }
  [[nodiscard]] double from_edge(std::size_t k, const ScanEdge& edge) const {
    return middle(distance(points_[k], side_between(points_[edge.from], points_[edge.to])));
  }

  /// The reach of an edge: what is farther from it, and inside the outlines, is material. `dip` holds for
  /// what lies between the points measured beside it.
  struct Reach {
    Span edge, beside;
  };
  Reach reach_of(const ScanEdge& edge) {
    const Span width = length(points_[edge.to] - points_[edge.from]), g = scan_.guard;
    Reach reach{{kInfinity, kInfinity}, g};
    if (scan_.min_radius) {
      const Span inner = *scan_.min_radius - g, half = width * just(0.5);
      if (half.high < inner.low)
        reach.edge = *scan_.min_radius - square_root((inner - half) * (inner + half));
    }
    if (scan_.max_dip && (g + *scan_.max_dip).high < reach.edge.high)
      reach = {g + *scan_.max_dip, g + *scan_.max_dip};
    if (reach.edge.high < kInfinity) return reach;
    if (scan_.min_radius || !(widest_gap(edge, width) <= scan_.step.high * (1 + 1e-12)))
      verdict_.unknown = true;
    reach.edge = g;
    return reach;
  }

  /// Returns the widest stretch along an edge without a point.
  [[nodiscard]] double widest_gap(const ScanEdge& edge, Span width) const {
    std::vector<double> along{0, width.high};
    const Vec chord = points_[edge.to] - points_[edge.from];
    for (const std::size_t k : edge.beside)
      along.push_back(
          std::clamp(middle(dot(points_[k] - points_[edge.from], chord) / width), 0.0, width.high));
    std::sort(along.begin(), along.end());
    double widest = 0;
    for (std::size_t i = 0; i + 1 < along.size(); ++i) widest = std::max(widest, along[i + 1] - along[i]);
    return widest;
  }

  /// Says whether the blank's outline keeps away from a segment by this much.
  bool keeps_away(const Side& segment, Span reach) {
    const Box box = box_of(segment);
    bool away = true;
    blank_.tree->visit_near(box, reach.high, [&](std::size_t k) {
      if (!away) return;
      const Span apart = distance(segment, blank_.sides[k]);
      away = apart.low > 0 && apart.low >= reach.high;
    });
    return away;
  }

  /// Says whether the blank's outline comes within the loss of a corner of the outlines, but for rounding.
  bool is_within_loss(const Vec& p) {
    const double loss = scan_.loss.high + 1e-12 * (1 + std::abs(p.x.high) + std::abs(p.y.high));
    bool within = false;
    blank_.tree->visit_near(
        box_of(p), loss, [&](std::size_t k) { within = within || distance(p, blank_.sides[k]).low <= loss; });
    return within;
  }

  void check_outlines() {
    for (const ScanOutline& outline : outlines_) {
      for (const ScanEdge& edge : outline) {
        const Reach reach = reach_of(edge);
        if (!is_within_loss(points_[edge.from]))
          return complain(
              fmt::format("the blank is farther than the loss of {} mm from the point at ({}, {})",
                          scan_.loss.high, middle(points_[edge.from].x), middle(points_[edge.from].y)));
        const bool away = keeps_away(side_between(points_[edge.from], points_[edge.to]), reach.edge);
        bool apart = true;
        // The hull of the edge and the points beside it is bounded by segments between some two of them.
        const std::vector<std::size_t> hull = hull_of(edge);
        for (auto i = hull.begin(); i != hull.end(); ++i)
          for (auto j = hull.begin(); apart && j != i; ++j)
            apart = keeps_away(side_between(points_[*i], points_[*j]), reach.beside);
        if (!apart && verdict_.open.empty())
          verdict_.open = fmt::format("the blank comes near to points measured beside the edge at ({}, {})",
                                      middle(points_[edge.from].x), middle(points_[edge.from].y));
        if (!away)
          return complain(fmt::format(
              "the blank comes nearer than {} mm to the outline through the points at ({}, {}), or cannot be "
              "told from it",
              reach.edge.high, middle(points_[edge.from].x), middle(points_[edge.from].y)));
      }
      // No outline meets that of the blank, so one point tells for all of it.
      if (holds(blank_, points_[outline.front().from]).value_or(true))
        return complain(fmt::format("the outline through the point at ({}, {}) runs within the blank",
                                    middle(points_[outline.front().from].x),
                                    middle(points_[outline.front().from].y)));
    }
  }

  /// Returns points of an edge and beside it between which the segments bound all of them, without those that
  /// are surely within a triangle of others.
  [[nodiscard]] std::vector<std::size_t> hull_of(const ScanEdge& edge) const {
    if (edge.beside.empty()) return {};
    std::vector<std::size_t> all = edge.beside;
    all.push_back(edge.from), all.push_back(edge.to);
    std::ranges::sort(all, {}, [&](std::size_t k) { return std::pair(points_[k].x.low, points_[k].y.low); });
    std::vector<std::size_t> hull;
    const auto go_round_half = [&] {
      const std::size_t begin = hull.size();
      for (const std::size_t k : all) {
        while (hull.size() >= begin + 2 &&
               // A point goes only if it surely lies on the inner side.
               is_positive(cross(points_[hull[hull.size() - 2]] - points_[hull.back()],
                                 points_[k] - points_[hull.back()])))
          hull.pop_back();
        hull.push_back(k);
      }
      hull.pop_back();
    };
    go_round_half();
    std::reverse(all.begin(), all.end());
    go_round_half();
    return hull;
  }

  void check_parity() {
    for (std::size_t piece = 0; piece + 1 < blank_.piece_starts.size(); ++piece) {
      const std::size_t contour = blank_.piece_starts[piece];
      std::optional<bool> odd;
      for (std::size_t k = blank_.contour_starts[contour]; k < blank_.contour_starts[contour + 1]; ++k)
        for (const Vec& p : points_of(blank_.sides[k]))
          if (!odd) odd = is_odd(p);
      if (!odd.value_or(false))
        return complain(
            fmt::format("piece {} of the blank is not inside the outlines through the points", piece));
    }
  }

  /// Says whether an odd number of outlines runs around p; nothing where a corner may be level with it or
  /// above.
  [[nodiscard]] std::optional<bool> is_odd(const Vec& p) const {
    bool odd = false;
    for (const ScanOutline& outline : outlines_)
      for (const ScanEdge& edge : outline) {
        const Vec &a = points_[edge.from], &b = points_[edge.to];
        const auto above = [&](const Vec& q) -> std::optional<bool> {
          if (surely_above(q.y, p.y)) return true;
          if (surely_above(p.y, q.y)) return false;
          return std::nullopt;
        };
        const auto from = above(a), to = above(b);
        if (surely_above(p.x, a.x) && surely_above(p.x, b.x)) continue;
        if (!from || !to) return std::nullopt;
        if (*from == *to) continue;
        // An edge that runs upwards with p on its left is met by the ray from p to the right.
        const Span turn = *to ? cross(b - a, p - a) : cross(a - b, p - b);
        if (is_positive(turn))
          odd = !odd;
        else if (!is_positive(-turn))
          return std::nullopt;
      }
    return odd;
  }

  const WrittenScan& scan_;
  const std::vector<Vec>& points_;
  const std::vector<std::size_t>& starts_;
  const Shape& blank_;
  std::vector<std::uint8_t> kept_;  ///< 0 or 1
  std::vector<ScanOutline> outlines_;
  ScanVerdict verdict_;
};

}  // namespace

std::optional<WrittenScan> read_written_scan(Json value, std::string& complaint) {
  Fields fields(value, "scan", complaint);
  if (fields.get("outlines").text.empty()) return std::nullopt;
  WrittenScan scan;
  const std::string unit = fields.text("units");
  if (unit != "mm" && unit != "inch") fields.complain("field scan.units is neither \"mm\" nor \"inch\"");
  scan.unit = unit == "inch" ? LengthUnit::inch : LengthUnit::millimetre;
  scan.points = fields.index("points");
  for (const auto& [key, to] : {std::pair{"proved", &scan.proved}, {"ordered", &scan.ordered}}) {
    if (!fields.get(key).is_bool())
      fields.complain(fmt::format("field scan.{} is neither true nor false", key));
    *to = fields.get(key).is_true();
  }
  scan.guard = enclosed(fields.number("guard")), scan.step = enclosed(fields.number("step")),
  scan.loss = enclosed(fields.number("loss"));
  if (const auto radius = fields.number_or_null("min_radius")) scan.min_radius = enclosed(*radius);
  if (const auto dip = fields.number_or_null("max_dip")) scan.max_dip = enclosed(*dip);
  if (scan.guard.low < 0 || (scan.max_dip && scan.max_dip->low < 0))
    fields.complain("a length of the field scan is negative");
  if (!fields.get("slice").is_null()) {
    Fields slice(fields.get("slice"), "scan.slice", complaint);
    scan.slice = {slice.number("height"), slice.number("thickness")};
  }
  fields.each("left_out", [&](Json item, const std::string& path) {
    scan.left_out.push_back(fields.index_of(item, path));
  });
  if (scan.ordered != fields.get("outlines").is_null())
    fields.complain("field scan.outlines is for points in no order, and for those alone");
  if (!fields.get("outlines").is_null())
    fields.each("outlines", [&](Json loop, const std::string& path) {
      auto& corners = scan.outlines.emplace_back();
      if (!loop.is_array()) return fields.complain(path + " is not a list");
      JsonItems items(loop);
      while (const auto item = items.next()) corners.push_back(fields.index_of(*item, path));
    });
  return scan;
}

ScanVerdict check_scan(const WrittenScan& scan, const MeasuredPoints& points, const Shape& blank) {
  return ScanCheck(scan, points, blank).run();
}

}  // namespace lekalo::verify
