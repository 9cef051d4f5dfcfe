#include "lekalo/field/arrival.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::field {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kKnown = 2.2;  // pitches: a difference of second order needs two nodes behind

class March {
 public:
  March(ArrivalTimes& arrival, const std::vector<double>& speed)
      : arrival_(arrival),
        time_(arrival.time),
        speed_(speed),
        columns_(arrival.frame.columns),
        accepted_(time_.size(), 0) {}

  void run(const geom::RegionIndex& start) {
    for (const std::size_t n : begin(start)) update_about(n);
    while (!heap_.empty()) {
      ask();
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [time, n] = heap_.back();
      heap_.pop_back();
      if (accepted_[n] != 0 || time > time_[n]) continue;
      accepted_[n] = 1;
      arrival_.last = std::max(arrival_.last, time);
      update_about(n);
    }
    for (std::size_t n = 0; n < time_.size(); ++n)
      arrival_.reaches_all = arrival_.reaches_all && !(speed_[n] > 0 && accepted_[n] == 0);
  }

 private:
  /// The nodes whose time is known from the start.
  std::vector<std::size_t> begin(const geom::RegionIndex& start) {
    const geom::Box box = start.bounds();
    const double reach = kKnown * arrival_.frame.pitch;
    std::vector<std::size_t> known;
    for (std::size_t n = 0; n < time_.size(); ++n) {
      const geom::Point p = arrival_.frame.node(n % columns_, n / columns_);
      if (!(speed_[n] > 0) || p.x < box.low.x - reach || p.x > box.high.x + reach ||
          p.y < box.low.y - reach || p.y > box.high.y + reach)
        continue;
      const double d = start.nearest(p).distance;
      const bool inside = start.contains(p);
      if (!inside && d > reach) continue;
      time_[n] = (inside ? -d : d) / speed_[n];
      accepted_[n] = 1;
      known.push_back(n);
    }
    return known;
  }

  void update_about(std::size_t n) {
    const std::size_t column = n % columns_, row = n / columns_;
    if (column > 0) update(n - 1);
    if (column + 1 < columns_) update(n + 1);
    if (row > 0) update(n - columns_);
    if (row + 1 < arrival_.frame.rows) update(n + columns_);
  }

  void update(std::size_t m) {
    if (accepted_[m] != 0 || !(speed_[m] > 0)) return;
    // Each axis adds a (T - b)^2 from the side that arrives first; a is 9/4 for a difference of second order.
    double a[2] = {0, 0}, b[2] = {0, 0};
    int count = 0;
    const auto take = [&](std::size_t at, std::size_t size, std::size_t stride) {
      const bool use_low = at > 0 && accepted_[m - stride] != 0;
      const bool use_high = at + 1 < size && accepted_[m + stride] != 0;
      if (!use_low && !use_high) return;
      const bool take_low = use_low && (!use_high || time_[m - stride] <= time_[m + stride]);
      const std::size_t one = take_low ? m - stride : m + stride;
      const bool has_two = take_low ? at > 1 : at + 2 < size;
      const std::size_t two = take_low ? one - stride : one + stride;
      if (has_two && accepted_[two] != 0 && time_[two] <= time_[one]) {
        a[count] = 2.25;
        b[count] = (4 * time_[one] - time_[two]) / 3;
      } else {
        a[count] = 1;
        b[count] = time_[one];
      }
      ++count;
    };
    take(m % columns_, columns_, 1);
    take(m / columns_, arrival_.frame.rows, columns_);
    const double slow = arrival_.frame.pitch / speed_[m];
    double time = kNever;
    if (count == 2) {
      const double sum = a[0] + a[1], mean = (a[0] * b[0] + a[1] * b[1]) / sum;
      const double rest = slow * slow - a[0] * a[1] / sum * (b[0] - b[1]) * (b[0] - b[1]);
      if (rest >= 0) time = mean + std::sqrt(rest / sum);
      if (!(time >= std::max(b[0], b[1]))) time = kNever;
    }
    if (time == kNever)
      for (int k = 0; k < count; ++k) time = std::min(time, b[k] + slow / std::sqrt(a[k]));
    if (time < time_[m]) {
      time_[m] = time;
      heap_.emplace_back(time, m);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }

  ArrivalTimes& arrival_;
  std::vector<double>& time_;
  const std::vector<double>& speed_;
  std::size_t columns_;
  std::vector<char> accepted_;
  std::vector<std::pair<double, std::size_t>> heap_;
};

}  // namespace

ArrivalTimes arrival_times(const GridFrame& frame, const std::vector<double>& speed,
                           const geom::RegionIndex& start) {
  assert(speed.size() == frame.size());
  ArrivalTimes arrival{frame, std::vector<double>(frame.size(), kNever)};
  March(arrival, speed).run(start);
  return arrival;
}

void extend_beyond_walls(ArrivalTimes& arrival, const std::vector<double>& speed, std::size_t rings) {
  assert(speed.size() == arrival.time.size());
  std::vector<double>& time = arrival.time;
  const std::size_t columns = arrival.frame.columns;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    std::vector<std::pair<std::size_t, double>> more;
    for (std::size_t n = 2 * columns; n + 2 * columns < time.size(); ++n) {
      if (time[n] != kNever || speed[n] > 0) continue;
      double sum = 0, weight = 0;
      const auto carry = [&](std::size_t nodes, std::size_t one, std::size_t two) {
        if (nodes < 1 || time[one] == kNever) return;
        sum += nodes > 1 && time[two] != kNever ? 2 * time[one] - time[two] : time[one];
        ++weight;
      };
      const std::size_t column = n % columns;
      carry(columns - 1 - column, n + 1, n + 2);
      carry(column, n - 1, n - 2);
      carry(2, n + columns, n + 2 * columns);
      carry(2, n - columns, n - 2 * columns);
      if (weight > 0) more.emplace_back(n, sum / weight);
    }
    for (const auto& [n, value] : more) time[n] = value;
  }
}

}  // namespace lekalo::field
