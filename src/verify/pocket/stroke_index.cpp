#include "stroke_index.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

double distance_from(Place low, Place high, Place p) {
  return length(
      Place{std::max({0.0, low.x - p.x, p.x - high.x}), std::max({0.0, low.y - p.y, p.y - high.y})});
}

}  // namespace

void box_of(const Stroke& s, Place& low, Place& high) {
  low = {std::min(s.from.x, s.to.x), std::min(s.from.y, s.to.y)};
  high = {std::max(s.from.x, s.to.x), std::max(s.from.y, s.to.y)};
  if (!s.arc) return;
  const double bulge = length(at_share(s, 0.5) - 0.5 * (s.from + s.to)) + 1e-9;
  low = low - Place{bulge, bulge}, high = high + Place{bulge, bulge};
}

StrokeIndex::StrokeIndex(Place low, Place high, double cell)
    : middle_(0.5 * (low + high)), cell_(cell), squares_(1) {
  const Place size = high - low;
  for (side_ = cell_; side_ < std::max(size.x, size.y);) side_ *= 2;
}

template <class Visit>
void StrokeIndex::each_quarter(Place middle, double side, const Box& box, Visit&& visit) {
  for (std::uint32_t q = 0; q < 4; ++q) {
    const bool right = (q & 1) != 0, above = (q & 2) != 0;
    if (right ? !(box.high.x >= middle.x) : !(box.low.x <= middle.x)) continue;
    if (above ? !(box.high.y >= middle.y) : !(box.low.y <= middle.y)) continue;
    visit(q, middle + Place{right ? side / 4 : -side / 4, above ? side / 4 : -side / 4});
  }
}

void StrokeIndex::add(std::uint32_t number, const Stroke& stroke) {
  Box box;
  box_of(stroke, box.low, box.high);
  if (boxes_.size() <= number) boxes_.resize(number + std::size_t{1});
  boxes_[number] = box;
  const Place size = box.high - box.low;
  add(0, middle_, side_, std::max({cell_, size.x, size.y}), box, number);
}

void StrokeIndex::add(std::uint32_t at, Place middle, double side, double least_side, const Box& box,
                      std::uint32_t number) {
  if (side < 2 * least_side) return squares_[at].strokes.push_back(number);
  each_quarter(middle, side, box, [&](std::uint32_t q, Place of_quarter) {
    std::uint32_t next = squares_[at].quarters[q];
    if (next == 0) {
      next = squares_[at].quarters[q] = static_cast<std::uint32_t>(squares_.size());
      squares_.emplace_back();
    }
    add(next, of_quarter, side / 2, least_side, box, number);
  });
}

void StrokeIndex::near(Place p, double reach, std::vector<std::uint32_t>& numbers) const {
  numbers.clear();
  if (squares_.empty()) return;
  collect(0, middle_, side_, {p - Place{reach, reach}, p + Place{reach, reach}}, numbers);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void StrokeIndex::collect(std::uint32_t at, Place middle, double side, const Box& box,
                          std::vector<std::uint32_t>& numbers) const {
  ask();
  const Square& square = squares_[at];
  for (const std::uint32_t i : square.strokes)
    if (boxes_[i].low.x <= box.high.x && boxes_[i].high.x >= box.low.x && boxes_[i].low.y <= box.high.y &&
        boxes_[i].high.y >= box.low.y)
      numbers.push_back(i);
  each_quarter(middle, side, box, [&](std::uint32_t q, Place of_quarter) {
    if (square.quarters[q] != 0) collect(square.quarters[q], of_quarter, side / 2, box, numbers);
  });
}

template <class Distance>
void StrokeIndex::lower(std::uint32_t at, Place middle, double side, const Box& reaches, Place p,
                        double widest, const Distance& distance_of, double& least) const {
  ask();
  // More than the rounding of a distance, so that the least one is found to its last digit.
  constexpr double kSlack = 1e-9;
  const auto may_lower = [&](double far) { return !(far - widest > least + kSlack * (1 + far)); };
  const Square& square = squares_[at];
  for (const std::uint32_t i : square.strokes)
    if (may_lower(distance_from(boxes_[i].low, boxes_[i].high, p))) least = std::min(least, distance_of(i));
  struct Quarter {
    double far;
    std::uint32_t at;
    Place middle;
    Box reaches;
  };
  std::array<Quarter, 4> quarters{};
  std::size_t count = 0;
  const auto add_in_order = [&](const Quarter& quarter) {
    std::size_t k = count++;
    for (; k > 0 && quarters[k - 1].far > quarter.far; --k) quarters[k] = quarters[k - 1];
    quarters[k] = quarter;
  };
  each_quarter(middle, side, {{-kInfinity, -kInfinity}, {kInfinity, kInfinity}},
               [&](std::uint32_t q, Place of_quarter) {
                 if (square.quarters[q] == 0) return;
                 Box part = reaches;
                 ((q & 1) != 0 ? part.low.x : part.high.x) = middle.x;
                 ((q & 2) != 0 ? part.low.y : part.high.y) = middle.y;
                 add_in_order({distance_from(part.low, part.high, p), square.quarters[q], of_quarter, part});
               });
  for (std::size_t k = 0; k < count; ++k)
    if (may_lower(quarters[k].far))
      lower(quarters[k].at, quarters[k].middle, side / 2, quarters[k].reaches, p, widest, distance_of, least);
}

double StrokeIndex::nearest(Place p, const std::vector<Stroke>& strokes) const {
  return nearest(p, strokes, {}, 0);
}

double StrokeIndex::nearest(Place p, const std::vector<Stroke>& strokes, const std::vector<double>& wider,
                            double widest) const {
  double least = kInfinity;
  const auto distance_of = [&](std::uint32_t i) {
    return distance(p, strokes[i]) - (wider.empty() ? 0 : wider[i]);
  };
  if (!squares_.empty())
    lower(0, middle_, side_, {{-kInfinity, -kInfinity}, {kInfinity, kInfinity}}, p, widest, distance_of,
          least);
  return least;
}

}  // namespace lekalo::verify
