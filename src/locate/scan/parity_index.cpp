#include "parity_index.hpp"

#include <algorithm>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::locate {

ParityIndex::ParityIndex(const geom::Ring& points, const std::vector<Loop>& loops) {
  double top = -1e300;
  bottom_ = 1e300;
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    for (std::size_t i = 0; i < loops[l].size(); ++i) {
      geom::Point a = points[loops[l][i]], b = points[loops[l][(i + 1) % loops[l].size()]];
      bottom_ = std::min(bottom_, a.y);
      top = std::max(top, a.y);
      if (a.y > b.y) std::swap(a, b);
      if (a.y < b.y) segments_.push_back({a, b, l});
    }
  }
  const std::size_t strips = std::clamp<std::size_t>(segments_.size() / 4, 1, 1 << 16);
  per_strip_ = top > bottom_ ? static_cast<double>(strips) / (top - bottom_) : 0;
  starts_.assign(strips + 1, 0);
  const auto each_strip = [&](const Segment& s, auto&& use) {
    for (std::size_t k = strip(s.low.y), end = strip(s.high.y); k <= end; ++k) use(k);
  };
  for (const Segment& s : segments_) each_strip(s, [&](std::size_t k) { ++starts_[k + 1]; });
  for (std::size_t k = 0; k < strips; ++k) starts_[k + 1] += starts_[k];
  in_strip_.resize(starts_.back());
  std::vector<std::uint32_t> fill(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < segments_.size(); ++i)
    each_strip(segments_[i], [&](std::size_t k) { in_strip_[fill[k]++] = i; });
}

std::size_t ParityIndex::strip(double y) const {
  const double at = (y - bottom_) * per_strip_;
  const std::size_t last = starts_.size() - 2;
  return at > 0 ? std::min(static_cast<std::size_t>(std::min(at, 1e9)), last) : 0;
}

bool ParityIndex::odd(geom::Point p, std::uint32_t except) const {
  bool inside = false;
  const std::size_t k = strip(p.y);
  for (std::uint32_t at = starts_[k]; at < starts_[k + 1]; ++at) {
    const Segment& s = segments_[in_strip_[at]];
    if (s.loop == except || !(s.low.y <= p.y && p.y < s.high.y)) continue;
    if (geom::orientation(s.low, s.high, p) > 0) inside = !inside;
  }
  return inside;
}

}  // namespace lekalo::locate
