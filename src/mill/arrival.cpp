#include "arrival.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "arc_through.hpp"
#include "lekalo/geom/boolean.hpp"
#include "step_law.hpp"

namespace lekalo::mill {

using geom::Point;
using geom::Region;
using geom::RegionIndex;

namespace {
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kFit = 0.004;       // mm
constexpr double kCosine = 0.182;    // of 79.5 degrees
constexpr std::size_t kSquare = 16;  // nodes
constexpr std::size_t kMargin = 4;   // nodes beyond the box
}  // namespace

ArrivalField::ArrivalField(const RegionIndex& allowed, const std::vector<Region>& start, double pitch,
                           const Law& law)
    : law_(law), pitch_(pitch) {
  const geom::Box box = allowed.bounds();
  const double margin = static_cast<double>(kMargin) * pitch_;
  // Half a pitch off, so that walls of round numbers do not run through nodes.
  low_ = box.low - Point{margin + 0.37 * pitch_, margin + 0.41 * pitch_};
  columns_ = static_cast<std::size_t>((box.high.x - box.low.x) / pitch_) + 2 * kMargin + 2;
  rows_ = static_cast<std::size_t>((box.high.y - box.low.y) / pitch_) + 2 * kMargin + 2;
  measure(allowed);
  march(start);
  extend();
  find_squares();
}

double ArrivalField::speed(double distance) const {
  const double step =
      step_for(law_.bend * (law_.beyond + std::max(0.0, distance)), law_.tool_radius, kCosine);
  return std::min(law_.step, std::max(step, law_.least * law_.step));
}

void ArrivalField::measure(const RegionIndex& allowed) {
  depth_.assign(columns_ * rows_, 0);
  std::uint32_t likely = 0;
  for (std::size_t n = 0; n < depth_.size(); ++n) {
    const Point p = node(n);
    const auto near = allowed.nearest(p, likely);
    likely = near.edge;
    // The side changes only where the boundary passes between two nodes.
    const bool same = n % columns_ != 0 && std::abs(depth_[n - 1]) > 1.01 * pitch_;
    const bool inside = same ? depth_[n - 1] > 0 : allowed.contains(p);
    depth_[n] = inside ? near.distance : -near.distance;
  }
}

/// Fast marching, of second order where two nodes behind are known.
void ArrivalField::march(const std::vector<Region>& start) {
  arrival_.assign(depth_.size(), kNever);
  accepted_.assign(depth_.size(), 0);
  const RegionIndex from(start);
  const geom::Box box = from.bounds();
  std::vector<std::pair<double, std::size_t>> heap;
  const double reach = 2.2 * pitch_;
  std::vector<std::size_t> known;
  for (std::size_t n = 0; n < depth_.size(); ++n) {
    const Point p = node(n);
    if (!(depth_[n] > 0) || p.x < box.low.x - reach || p.x > box.high.x + reach || p.y < box.low.y - reach ||
        p.y > box.high.y + reach)
      continue;
    const double d = from.nearest(p).distance;
    const bool inside = from.contains(p);
    if (!inside && d > reach) continue;
    arrival_[n] = (inside ? -d : d) / speed(depth_[n]);
    accepted_[n] = 1;
    known.push_back(n);
  }
  for (const std::size_t n : known) update(n, heap);
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    const auto [time, n] = heap.back();
    heap.pop_back();
    if (accepted_[n] != 0 || time > arrival_[n]) continue;
    accepted_[n] = 1;
    last_ = std::max(last_, time);
    update(n, heap);
  }
  for (std::size_t n = 0; n < depth_.size(); ++n)
    reaches_all_ = reaches_all_ && !(depth_[n] > 0 && accepted_[n] == 0);
}

void ArrivalField::update(std::size_t n, std::vector<std::pair<double, std::size_t>>& heap) {
  for (const std::size_t m : {n - 1, n + 1, n - columns_, n + columns_}) {
    if (accepted_[m] != 0 || !(depth_[m] > 0)) continue;
    // Of each axis the side that arrives first: a (T - b)^2, second order with a = 9/4.
    double a[2] = {0, 0}, b[2] = {0, 0};
    int count = 0;
    for (const std::size_t stride : {std::size_t{1}, columns_}) {
      const std::size_t low = m - stride, high = m + stride;
      const bool use_low = accepted_[low] != 0, use_high = accepted_[high] != 0;
      if (!use_low && !use_high) continue;
      const bool take_low = use_low && (!use_high || arrival_[low] <= arrival_[high]);
      const std::size_t one = take_low ? low : high;
      const std::size_t two = take_low ? low - stride : high + stride;
      if (accepted_[two] != 0 && depth_[two] > 0 && arrival_[two] <= arrival_[one]) {
        a[count] = 2.25;
        b[count] = (4 * arrival_[one] - arrival_[two]) / 3;
      } else {
        a[count] = 1;
        b[count] = arrival_[one];
      }
      ++count;
    }
    const double slow = pitch_ / speed(depth_[m]);
    double time = kNever;
    if (count == 2) {
      const double sum = a[0] + a[1], mean = (a[0] * b[0] + a[1] * b[1]) / sum;
      const double rest = slow * slow - a[0] * a[1] / sum * (b[0] - b[1]) * (b[0] - b[1]);
      if (rest >= 0) time = mean + std::sqrt(rest / sum);
      if (!(time >= std::max(b[0], b[1]))) time = kNever;
    }
    if (time == kNever)
      for (int k = 0; k < count; ++k) time = std::min(time, b[k] + slow / std::sqrt(a[k]));
    if (time < arrival_[m]) {
      arrival_[m] = time;
      heap.emplace_back(time, m);
      std::push_heap(heap.begin(), heap.end(), std::greater<>());
    }
  }
}

/// Straight on to a few nodes beyond the boundary, so that level lines cross it.
void ArrivalField::extend() {
  for (std::size_t round = 0; round + 1 < kMargin; ++round) {
    std::vector<std::pair<std::size_t, double>> more;
    for (std::size_t n = 2 * columns_ + 2; n + 2 * columns_ + 2 < depth_.size(); ++n) {
      if (arrival_[n] != kNever || depth_[n] > 0) continue;
      double sum = 0, weight = 0;
      for (const long stride : {1L, -1L, static_cast<long>(columns_), -static_cast<long>(columns_)}) {
        const auto one = static_cast<std::size_t>(static_cast<long>(n) + stride),
                   two = static_cast<std::size_t>(static_cast<long>(n) + 2 * stride);
        if (arrival_[one] == kNever) continue;
        const bool both = arrival_[two] != kNever;
        sum += both ? 2 * arrival_[one] - arrival_[two] : arrival_[one];
        ++weight;
      }
      if (weight > 0) more.emplace_back(n, sum / weight);
    }
    for (const auto& [n, time] : more) arrival_[n] = time;
  }
}

void ArrivalField::find_squares() {
  squares_across_ = columns_ / kSquare + 1;
  squares_.assign(squares_across_ * (rows_ / kSquare + 1), {kNever, -kNever});
  for (std::size_t s = 0; s < squares_.size(); ++s) {
    const std::size_t x = s % squares_across_ * kSquare, y = s / squares_across_ * kSquare;
    for (std::size_t j = y; j <= y + kSquare && j < rows_; ++j)
      for (std::size_t i = x; i <= x + kSquare && i < columns_; ++i) {
        squares_[s].first = std::min(squares_[s].first, arrival_[j * columns_ + i]);
        squares_[s].last = std::max(squares_[s].last, arrival_[j * columns_ + i]);
      }
  }
}

/// Closed lines with the earlier on their left, by cells.
std::vector<std::vector<ArrivalField::Place>> ArrivalField::level_lines(double time) const {
  // A crossing between node n and the next to the right is 2 n, to the next above 2 n + 1.
  std::map<std::size_t, std::size_t> next;
  const auto early = [&](std::size_t n) { return arrival_[n] < time; };
  const auto cell = [&](std::size_t n) {
    const std::size_t corner[4] = {n, n + 1, n + 1 + columns_, n + columns_};
    const bool in[4] = {early(corner[0]), early(corner[1]), early(corner[2]), early(corner[3])};
    const int count = in[0] + in[1] + in[2] + in[3];
    if (count == 0 || count == 4) return;
    // Sides counter-clockwise: below, right, above, left. With the early on its left a line enters where they
    // go from early to late.
    const std::size_t side[4] = {2 * n, 2 * (n + 1) + 1, 2 * (n + columns_), 2 * n + 1};
    std::size_t enters[2] = {}, leaves[2] = {};
    int e = 0, l = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (in[k] && !in[(k + 1) % 4]) enters[e++] = k;
      if (!in[k] && in[(k + 1) % 4]) leaves[l++] = k;
    }
    if (e == 1) {
      next[side[enters[0]]] = side[leaves[0]];
      return;
    }
    double sum = 0;
    for (const std::size_t c : corner) sum += arrival_[c];
    const bool joined = sum < 4 * time;  // the two early corners are one
    for (const std::size_t from : enters) next[side[from]] = side[(from + (joined ? 1 : 3)) % 4];
  };
  for (std::size_t s = 0; s < squares_.size(); ++s) {
    if (!(squares_[s].first < time && time <= squares_[s].last)) continue;
    const std::size_t x = s % squares_across_ * kSquare, y = s / squares_across_ * kSquare;
    for (std::size_t j = y; j < y + kSquare && j + 1 < rows_; ++j)
      for (std::size_t i = x; i < x + kSquare && i + 1 < columns_; ++i) cell(j * columns_ + i);
  }
  std::vector<std::vector<Place>> lines;
  while (!next.empty()) {
    std::vector<Place> line;
    for (auto step = next.begin(); step != next.end();) {
      const auto [at, following] = *step;
      const std::size_t n = at / 2, m = at % 2 == 0 ? n + 1 : n + columns_;
      const bool known = arrival_[n] != kNever && arrival_[m] != kNever;
      const double share = known ? (time - arrival_[n]) / (arrival_[m] - arrival_[n]) : 0.5;
      line.push_back({node(n) + std::clamp(share, 1e-3, 1 - 1e-3) * (node(m) - node(n)), known});
      next.erase(step);
      step = next.find(following);
    }
    if (line.size() > 2) lines.push_back(std::move(line));
  }
  return lines;
}

Result<std::vector<Region>> ArrivalField::before(double time) const {
  std::vector<geom::Contour> contours;
  for (std::vector<Place>& line : level_lines(time)) {
    const std::size_t n = line.size();
    // Begun at a place that is not smooth, if there is one.
    const auto rough = std::find_if(line.begin(), line.end(), [](const Place& p) { return !p.smooth; });
    std::rotate(line.begin(), rough == line.end() ? line.begin() : rough, line.end());
    for (int round = 0; round < 2; ++round) {
      std::vector<Place> smoother = line;
      for (std::size_t i = 0; i < n; ++i) {
        const Place &a = line[(i + n - 1) % n], &b = line[(i + 1) % n];
        if (a.smooth && b.smooth && line[i].smooth) smoother[i].at = 0.25 * (a.at + 2 * line[i].at + b.at);
      }
      line = std::move(smoother);
    }
    geom::Contour contour;
    for (std::size_t i = 0; i < n;) {
      if (!line[i].smooth || !line[(i + 1) % n].smooth) {
        const Point a = line[i].at, b = line[(i + 1) % n].at;
        if (!(a == b)) contour.push_back({geom::EdgeKind::line, a, b, {}});
        ++i;
        continue;
      }
      std::vector<Point> run;
      std::size_t k = i;
      while (k <= n && line[k % n].smooth && (k < n || i == 0)) run.push_back(line[k++ % n].at);
      fit_arcs(run, kFit, contour);
      i = k - 1;
      if (i == 0) break;
    }
    if (contour.size() > 2) contours.push_back(std::move(contour));
  }
  return geom::nest_contours(std::move(contours));
}

}  // namespace lekalo::mill
