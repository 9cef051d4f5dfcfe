#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/locate/guaranteed_blank.hpp"
#include "support/region_cases.hpp"

namespace lekalo::cases {

/// Points of the contours of regions, and what a probe makes of them.

struct Sampling {
  double spacing = 1;   ///< mm, along the contour
  double jitter = 0;    ///< share of the spacing by which points are moved along
  double noise = 0;     ///< points anywhere in a disc of this radius, mm
  double gaussian = 0;  ///< or (and) normal errors of this standard deviation in x and y, mm
};

struct SampledPoint {
  geom::Point truth, measured;
};

inline geom::Point normal_pair(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
  const auto [sine, cosine] = geom::sincos(6.283185307179586 * random.uniform());
  return {radius * cosine, radius * sine};
}

/// One list a contour, in the contour's order.
inline std::vector<std::vector<SampledPoint>> sample(const std::vector<geom::Region>& regions,
                                                     const Sampling& how, Random& random) {
  std::vector<std::vector<SampledPoint>> lists;
  const auto contour = [&](const geom::Contour& c) {
    std::vector<SampledPoint> list;
    double at = random.uniform(0, how.spacing);  // distance of the next point from the beginning of the edge
    for (const geom::Edge& e : c) {
      const bool line = e.kind == geom::EdgeKind::line;
      const double radius = line ? 0 : geom::arc_radius(e), sweep = line ? 0 : geom::arc_sweep(e);
      const double length = line ? norm(e.to - e.from) : radius * sweep;
      for (; at < length; at += how.spacing) {
        const double s = std::clamp(at + how.jitter * how.spacing * random.uniform(-0.5, 0.5), 0.0, length);
        geom::Point p = e.from + (s / std::max(length, 1e-300)) * (e.to - e.from);
        if (!line) {
          const auto [sine, cosine] =
              geom::sincos(e.kind == geom::EdgeKind::arc_ccw ? s / radius : -s / radius);
          const geom::Point arm = e.from - e.centre;
          p = e.centre + geom::Point{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y};
        }
        geom::Point off{};
        if (how.noise > 0) {
          do off = {random.uniform(-1, 1), random.uniform(-1, 1)};
          while (norm(off) > 1);
          off = how.noise * off;
        }
        if (how.gaussian > 0) off = off + how.gaussian * normal_pair(random);
        list.push_back({p, p + off});
      }
      at -= length;
    }
    lists.push_back(std::move(list));
  };
  for (const geom::Region& region : regions) {
    contour(region.outer);
    for (const geom::Contour& hole : region.holes) contour(hole);
  }
  return lists;
}

inline locate::ScanPoints scan_of(const std::vector<std::vector<SampledPoint>>& lists) {
  locate::ScanPoints scan;
  scan.contour_starts.clear();
  for (const auto& list : lists) {
    scan.contour_starts.push_back(static_cast<std::uint32_t>(scan.points.size()));
    for (const SampledPoint& p : list) scan.points.push_back(p.measured);
  }
  return scan;
}

inline locate::ScanPoints shuffled(locate::ScanPoints scan, Random& random) {
  for (std::size_t i = scan.points.size(); i > 1; --i)
    std::swap(scan.points[i - 1], scan.points[random.below(i)]);
  scan.contour_starts = {0};
  return scan;
}

/// The blank of a region case without dents (and without holes) sharper than `radius`: closed by a disc.
inline std::vector<geom::Region> without_sharp_dents(const std::vector<geom::Region>& blank, double radius) {
  return geom::offset(geom::offset(blank, radius).value().regions, -radius).value().regions;
}

}  // namespace lekalo::cases
