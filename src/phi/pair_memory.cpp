#include "pair_memory.hpp"

namespace lekalo::phi {

bool PairMemory::is_due(Key key) {
  if (asked_.empty()) asked_.resize(kCounters);
  Counter& counter = asked_[static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> 52)];
  if (counter.key != key) counter = {key, 0};
  return ++counter.asked >= kOften;
}

ContactMap& PairMemory::add(Key key, const OutlinePair& pair) {
  if (maps_.size() % 64 == 63) forget_too_much();
  if (2 * (maps_.size() + 1) > slots_.size()) {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.key != kNone) insert(slot);
  }
  insert({key, static_cast<std::uint32_t>(maps_.size())});
  return maps_.emplace_back(pair);
}

void PairMemory::forget_too_much() {
  if (bytes() <= most_bytes_) return;
  maps_.clear();
  slots_.assign(64, Slot{});
}

void PairMemory::insert(Slot slot) {
  std::size_t i = place(slot.key);
  while (slots_[i].key != kNone) i = (i + 1) & (slots_.size() - 1);
  slots_[i] = slot;
}

std::size_t PairMemory::bytes() const noexcept {
  std::size_t sum = slots_.capacity() * sizeof(Slot) + asked_.capacity() * sizeof(Counter);
  for (const ContactMap& map : maps_) sum += map.bytes();
  return sum + (maps_.capacity() - maps_.size()) * sizeof(ContactMap);
}

}  // namespace lekalo::phi
