#include "lekalo/geom/region_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "box_tree.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::geom {
namespace {

/// Where an edge stands, in words.
class Names {
 public:
  explicit Names(const std::vector<Region>& regions) : several_(regions.size() > 1) {
    for (std::size_t p = 0; p < regions.size(); ++p) {
      contours_.push_back({p, "outer contour"});
      for (std::size_t h = 0; h < regions[p].holes.size(); ++h)
        contours_.push_back({p, fmt::format("hole {}", h)});
    }
  }
  [[nodiscard]] std::string contour(std::size_t c) const {
    return several_ ? fmt::format("{} of piece {}", contours_[c].name, contours_[c].piece)
                    : contours_[c].name;
  }
  [[nodiscard]] std::size_t piece(std::size_t c) const { return contours_[c].piece; }

 private:
  struct Contour {
    std::size_t piece;
    std::string name;
  };
  std::vector<Contour> contours_;
  bool several_;
};

class Checker {
 public:
  explicit Checker(const std::vector<Region>& regions) : regions_(regions), index_(regions), names_(regions) {
    const Box box = index_.bounds();
    limit_ = kEdgeDistanceError *
             std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  }

  std::optional<std::string> run() {
    for (std::size_t c = 0; c + 1 < index_.contour_starts().size(); ++c)
      for (std::uint32_t i = index_.contour_starts()[c]; i < index_.contour_starts()[c + 1]; ++i)
        if (auto fault = meets_another(c, i)) return fault;
    return misplaced();
  }

 private:
  [[nodiscard]] std::size_t contour_of(std::uint32_t edge) const {
    const auto& starts = index_.contour_starts();
    return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), edge) - starts.begin()) -
           1;
  }

  std::optional<std::string> meets_another(std::size_t c, std::uint32_t i) {
    const std::uint32_t begin = index_.contour_starts()[c], end = index_.contour_starts()[c + 1];
    const Curve& curve = index_.curves()[i];
    const Box box = curve_box(curve);
    std::optional<std::string> fault;
    index_.visit_within(
        0.5 * (box.low + box.high), 0.5 * norm(box.high - box.low), limit_, [&](std::uint32_t j) {
          if (j <= i || fault) return;
          const Curve& other = index_.curves()[j];
          const bool neighbours = j < end && (j == i + 1 || (i == begin && j + 1 == end));
          if (neighbours) {
            if (curve.edge.kind != EdgeKind::line || other.edge.kind != EdgeKind::line || end - begin < 3)
              return;
            if (segment_relation(curve.edge.from, curve.edge.to, other.edge.from, other.edge.to) !=
                SegmentRelation::overlap)
              return;
          }
          const ClosestPoints close = closest_points(curve, other);
          if (close.distance > limit_) return;
          const std::size_t d = contour_of(j);
          fault = fmt::format("edge {} of the {} meets edge {} of the {} at ({}, {}) mm", i - begin,
                              names_.contour(c), j - index_.contour_starts()[d], names_.contour(d), close.a.x,
                              close.a.y);
        });
    return fault;
  }

  /// Outlines of which each was asked for, and a tree of their boxes to know whom to ask.
  class Outlines {
   public:
    explicit Outlines(std::vector<Region> outlines)
        : outlines_(std::move(outlines)), indices_(outlines_.size()), tree_(boxes_of(outlines_)) {}
    /// visit(i) for every outline that holds p, but not `own`.
    template <class Visit>
    void visit_holding(Point p, std::size_t own, Visit&& visit) {
      tree_.visit_meeting({p, p}, [&](std::uint32_t i) {
        if (i == own) return;
        if (!indices_[i]) indices_[i].emplace(std::vector<Region>{outlines_[i]});
        if (indices_[i]->contains(p)) visit(i);
      });
    }

   private:
    static std::vector<Box> boxes_of(const std::vector<Region>& outlines) {
      std::vector<Box> boxes;
      for (const Region& r : outlines) {
        boxes.push_back(RegionIndex({{r.outer, {}}}).bounds());  // with its margin for rounding
      }
      return boxes;
    }
    std::vector<Region> outlines_;
    std::vector<std::optional<RegionIndex>> indices_;
    detail::BoxTree tree_;
  };

  std::optional<std::string> misplaced() {
    Outlines materials(regions_);
    for (std::size_t p = 0; p < regions_.size(); ++p) {
      const auto& holes = regions_[p].holes;
      const std::string of = regions_.size() > 1 ? fmt::format(" of piece {}", p) : "";
      const RegionIndex outline({{regions_[p].outer, {}}});
      std::vector<Region> as_regions;
      for (const Contour& hole : holes) as_regions.push_back({hole, {}});
      Outlines all(std::move(as_regions));
      for (std::size_t h = 0; h < holes.size(); ++h) {
        const Point at = holes[h].front().from;
        if (!outline.contains(at))
          return fmt::format("hole {}{} lies outside the outer contour, at ({}, {}) mm", h, of, at.x, at.y);
        std::size_t around = holes.size();
        all.visit_holding(at, h, [&](std::size_t k) { around = std::min(around, k); });
        if (around < holes.size())
          return fmt::format("hole {}{} lies inside hole {}, at ({}, {}) mm", h, of, around, at.x, at.y);
      }
    }
    for (std::size_t q = 0; q < regions_.size(); ++q) {
      const Point at = regions_[q].outer.front().from;
      std::size_t around = regions_.size();
      materials.visit_holding(at, q, [&](std::size_t p) { around = std::min(around, p); });
      if (around < regions_.size())
        return fmt::format("piece {} lies in the material of piece {}, at ({}, {}) mm", q, around, at.x,
                           at.y);
    }
    return std::nullopt;
  }

  const std::vector<Region>& regions_;
  RegionIndex index_;
  Names names_;
  double limit_ = 0;
};

}  // namespace

std::optional<std::string> fault_of(const std::vector<Region>& regions) { return Checker(regions).run(); }

}  // namespace lekalo::geom
