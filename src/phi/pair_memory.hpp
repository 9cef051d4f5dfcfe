#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact_map.hpp"

namespace lekalo::phi {

/// Contact maps of the pairs of outlines that are asked about often, within a bounded amount of memory. A map
/// that is forgotten is made again when it is needed, so answers never depend on this memory.
class PairMemory {
 public:
  using Key = std::uint64_t;
  static constexpr Key kNone = ~Key{0};

  explicit PairMemory(std::size_t most_bytes = std::size_t{128} << 20) : most_bytes_(most_bytes) {}

  /// Returns the pair's map, or none. The pointer is good until the next call.
  [[nodiscard]] ContactMap* find(Key key) {
    // Maps grow as they are asked, so their memory is looked at now and then.
    if (++found_ % kLookEvery == 0) forget_too_much();
    for (std::size_t i = place(key);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i].key == key) return &maps_[slots_[i].map];
      if (slots_[i].key == kNone) return nullptr;
    }
  }
  /// Counts a question about a pair without a map; true when the pair has been asked about often enough for
  /// one.
  [[nodiscard]] bool is_due(Key key);
  ContactMap& add(Key key, const OutlinePair& pair);
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  static constexpr std::size_t kLookEvery = 1 << 16;
  static constexpr std::size_t kCounters = 1 << 12;
  static constexpr std::uint8_t kOften = 8;
  /// Counts the questions about one pair, until another pair takes its place.
  struct Counter {
    Key key = kNone;
    std::uint8_t asked = 0;
  };
  struct Slot {
    Key key = kNone;
    std::uint32_t map = 0;
  };
  [[nodiscard]] std::size_t place(Key key) const noexcept {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> 32) & (slots_.size() - 1);
  }
  void insert(Slot slot);
  void forget_too_much();

  /// The most bytes that all maps may take, about.
  std::size_t most_bytes_;
  std::size_t found_ = 0;
  std::vector<Slot> slots_ = std::vector<Slot>(64);
  std::vector<ContactMap> maps_;
  std::vector<Counter> asked_;
};

}  // namespace lekalo::phi
