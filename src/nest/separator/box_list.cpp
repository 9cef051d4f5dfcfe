#include "box_list.hpp"

#include <cmath>

#include "lekalo/base/wide.hpp"

namespace lekalo::nest {
namespace {

/// A bound so much wider that no meeting is hidden when it, and a bound near it, are rounded to floats.
float below(double v) noexcept { return static_cast<float>(v - 1e-6 * std::abs(v)); }
float above(double v) noexcept { return static_cast<float>(v + 1e-6 * std::abs(v)); }

LEKALO_WIDE void mark(const float* x0, const float* y0, const float* x1, const float* y1,
                      const std::uint32_t* bins, std::size_t count, std::uint32_t bin, float left, float low,
                      float right, float high, std::uint32_t* meets) {
  for (std::size_t i = 0; i < count; ++i)
    meets[i] = static_cast<std::uint32_t>(x0[i] < right) & static_cast<std::uint32_t>(x1[i] > left) &
               static_cast<std::uint32_t>(y0[i] < high) & static_cast<std::uint32_t>(y1[i] > low) &
               static_cast<std::uint32_t>(bins[i] == bin);
}

}  // namespace

BoxList::BoxList(std::size_t items)
    : x0_(items), y0_(items), x1_(items), y1_(items), bins_(items, ~std::uint32_t{0}), meets_(items) {}

void BoxList::set(std::uint32_t item, std::uint32_t bin, const Box& box) noexcept {
  x0_[item] = static_cast<float>(box.x0);
  y0_[item] = static_cast<float>(box.y0);
  x1_[item] = static_cast<float>(box.x1);
  y1_[item] = static_cast<float>(box.y1);
  bins_[item] = bin;
}

void BoxList::find(std::uint32_t bin, const Box& box, std::vector<std::uint32_t>& into) {
  const std::size_t items = bins_.size();
  mark(x0_.data(), y0_.data(), x1_.data(), y1_.data(), bins_.data(), items, bin, below(box.x0), below(box.y0),
       above(box.x1), above(box.y1), meets_.data());
  into.resize(items);
  std::size_t count = 0;
  for (std::size_t i = 0; i < items; ++i) {
    into[count] = static_cast<std::uint32_t>(i);
    count += meets_[i];
  }
  into.resize(count);
}

}  // namespace lekalo::nest
