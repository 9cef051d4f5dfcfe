#include "time_left.hpp"

#include <algorithm>

namespace lekalo::server {

void TimeLeft::take(double at, double fraction) {
  constexpr double kLately = 2, kLatelyShare = 0.25, kSoonest = 0.5;
  if (!begun_) begun_ = at;
  samples_.push_back({at, fraction});
  const double passed = at - *begun_, window = std::max(kLately, kLatelyShare * passed);
  while (samples_.size() > 2 && samples_[1].at <= at - window) samples_.pop_front();
  const double pace = (fraction - samples_.front().fraction) / (at - samples_.front().at);
  seconds_ = passed >= kSoonest && pace > 0 ? std::optional((1 - fraction) / pace) : std::nullopt;
}

}  // namespace lekalo::server
