#include "zip.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "lekalo/base/archive_limits.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

// ---- deflated texts ---------------------------------------------------------------------------------------

/// A prefix code by the lengths of its words: shorter words stand before longer ones, and those of one length
/// in the order of their symbols.
class PrefixCode {
 public:
  explicit PrefixCode(std::span<const std::uint8_t> lengths) {
    for (const std::uint8_t length : lengths) ++count_[length];
    count_[0] = 0;
    for (std::uint8_t length = 1; length <= kLongest; ++length)
      for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
        if (lengths[symbol] == length) symbols_.push_back(static_cast<std::uint16_t>(symbol));
  }

  /// Takes bits until they are a word; nothing where they are none.
  template <class NextBit>
  std::optional<std::uint16_t> take(NextBit next_bit) const {
    // The words of one length are the numbers from `first` on, and their symbols begin at `begin`.
    std::size_t word = 0, first = 0, begin = 0;
    for (std::size_t length = 1; length <= kLongest; ++length) {
      word = 2 * word + next_bit();
      first *= 2;
      if (word - first < count_[length]) return symbols_[begin + (word - first)];
      first += count_[length], begin += count_[length];
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kLongest = 15;
  std::array<std::size_t, kLongest + 1> count_{};
  std::vector<std::uint16_t> symbols_;
};

/// The lengths and distances of repetitions begin with these, and so many bits more follow.
struct Range {
  std::size_t first, bits;
};
constexpr std::array<Range, 29> kLengths{
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};
constexpr std::size_t kDistances = 30;
constexpr Range distance_range(std::size_t k) {
  if (k < 2) return {k + 1, 0};
  const std::size_t bits = k / 2 - 1;
  return {((2 + k % 2) << bits) + 1, bits};
}

class Inflater {
 public:
  Inflater(std::string_view packed, std::size_t size) : packed_(packed), size_(size) {}

  std::optional<std::string> read() {
    for (bool last = false; !last;) {
      last = bits(1) == 1;
      const std::size_t kind = bits(2);
      if (!good_ || kind == 3) return std::nullopt;
      const bool fine = kind == 0 ? copy() : (kind == 1 ? read_fixed() : read_dynamic());
      if (!fine || !good_) return std::nullopt;
    }
    if (made_.size() != size_) return std::nullopt;
    return std::move(made_);
  }

 private:
  std::size_t bit() {
    if (at_ >= 8 * packed_.size()) {
      good_ = false;
      return 0;
    }
    const std::size_t bit = static_cast<unsigned char>(packed_[at_ / 8]) >> at_ % 8 & 1;
    ++at_;
    return bit;
  }
  std::size_t bits(std::size_t count) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < count; ++k) value |= bit() << k;
    return value;
  }

  /// Takes bytes that are not packed, from the next whole one on.
  bool copy() {
    at_ = (at_ + 7) / 8 * 8;
    const std::size_t count = bits(16), inverse = bits(16);
    if (!good_ || count + inverse != 0xffff || packed_.size() - at_ / 8 < count ||
        size_ - made_.size() < count)
      return false;
    made_ += packed_.substr(at_ / 8, count);
    at_ += 8 * count;
    return true;
  }

  bool read_fixed() {
    std::array<std::uint8_t, 288> lengths{};
    for (std::size_t k = 0; k < lengths.size(); ++k)
      lengths[k] = k < 144 ? 8 : (k < 256 ? 9 : (k < 280 ? 7 : 8));
    const std::vector<std::uint8_t> distances(kDistances, 5);
    return read_symbols(PrefixCode(lengths), PrefixCode(distances));
  }

  bool read_dynamic() {
    constexpr std::array<std::size_t, 19> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                 11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t symbols = 257 + bits(5), distances = 1 + bits(5), count = 4 + bits(4);
    std::array<std::uint8_t, 19> of_lengths{};
    for (std::size_t k = 0; k < count; ++k) of_lengths[kOrder[k]] = static_cast<std::uint8_t>(bits(3));
    const PrefixCode code(of_lengths);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < symbols + distances) {
      const auto symbol = code.take([&] { return bit(); });
      if (!good_ || !symbol) return false;
      if (*symbol < 16) {
        lengths.push_back(static_cast<std::uint8_t>(*symbol));
      } else if (*symbol == 16) {
        if (lengths.empty()) return false;
        lengths.insert(lengths.end(), 3 + bits(2), std::uint8_t{lengths.back()});
      } else {
        lengths.insert(lengths.end(), *symbol == 17 ? 3 + bits(3) : 11 + bits(7), std::uint8_t{0});
      }
    }
    const std::span<const std::uint8_t> all(lengths.data(), symbols + distances);
    return read_symbols(PrefixCode(all.first(symbols)), PrefixCode(all.subspan(symbols)));
  }

  bool read_symbols(const PrefixCode& symbols, const PrefixCode& distances) {
    constexpr std::size_t kEnd = 256;
    while (good_) {
      ask();
      const auto symbol = symbols.take([&] { return bit(); });
      if (!symbol || made_.size() > size_) return false;
      if (*symbol == kEnd) return true;
      if (*symbol < kEnd) {
        made_ += static_cast<char>(*symbol);
        continue;
      }
      if (*symbol - kEnd - 1 >= kLengths.size()) return false;
      const Range length = kLengths[*symbol - kEnd - 1];
      const std::size_t count = length.first + bits(length.bits);
      const auto far = distances.take([&] { return bit(); });
      if (!far || *far >= kDistances) return false;
      const Range distance = distance_range(*far);
      const std::size_t back = distance.first + bits(distance.bits);
      if (back > made_.size()) return false;
      // It may repeat what it makes itself.
      for (std::size_t k = 0; k < count; ++k) made_ += made_[made_.size() - back];
    }
    return false;
  }

  std::string_view packed_;
  std::size_t size_, at_ = 0;  ///< in bytes; in bits
  bool good_ = true;
  std::string made_;
};

/// The cyclic redundancy check of ZIP: the polynomial 0x04c11db7, its bits in reverse.
std::uint32_t sum_of(std::string_view bytes) {
  constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t k = 0; k < table.size(); ++k) {
      std::uint32_t rest = k;
      for (int bit = 0; bit < 8; ++bit) rest = rest % 2 == 1 ? rest / 2 ^ 0xedb88320U : rest / 2;
      table[k] = rest;
    }
    return table;
  }();
  std::uint32_t sum = 0xffffffffU;
  for (const char c : bytes) sum = kTable[(sum ^ static_cast<unsigned char>(c)) & 0xffU] ^ sum >> 8;
  return ~sum;
}

// ---- the archive ------------------------------------------------------------------------------------------

/// A record of the archive, whose numbers are 0 where it ends early.
class Record {
 public:
  explicit Record(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k)
      if (at + k < bytes_.size()) value |= std::uint64_t{static_cast<unsigned char>(bytes_[at + k])} << 8 * k;
    return value;
  }
  [[nodiscard]] bool is(std::uint32_t mark) const { return number(0, 4) == mark; }

 private:
  std::string_view bytes_;
};

std::string_view from(std::string_view bytes, std::uint64_t at) {
  return at < bytes.size() ? bytes.substr(at) : std::string_view();
}

bool same_name(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : +c; };
  return std::ranges::equal(a, b, {}, small, small);
}

/// Returns the directory; none: no text.
std::string_view directory_of(std::string_view archive) {
  constexpr std::size_t kEnd = 22, kLongestComment = 0xffff, kLongPlace = 20;
  for (std::size_t back = kEnd; back <= std::min(archive.size(), kEnd + kLongestComment); ++back) {
    const std::size_t at = archive.size() - back;
    const Record end(archive.substr(at));
    if (!end.is(0x06054b50) || end.number(20, 2) != back - kEnd) continue;
    if (at >= kLongPlace) {
      const Record place(archive.substr(at - kLongPlace, kLongPlace));
      const Record far_end(from(archive, place.number(8, 8)));
      if (place.is(0x07064b50) && far_end.is(0x06064b50))
        return from(archive, far_end.number(48, 8)).substr(0, far_end.number(40, 8));
    }
    return from(archive, end.number(16, 4)).substr(0, end.number(12, 4));
  }
  return {};
}

struct Packed {
  std::uint64_t size = 0, packed = 0, at = 0;
};

/// Replaces what is too large for 32 bits.
void read_long(std::string_view extra, Packed& file) {
  while (extra.size() >= 4) {
    const Record field(extra);
    const std::uint64_t size = field.number(2, 2);
    if (field.number(0, 2) == 1) {
      std::size_t at = 4;
      for (std::uint64_t* const value : {&file.size, &file.packed, &file.at})
        if (*value == 0xffffffff) *value = field.number(at, 8), at += 8;
    }
    extra = from(extra, 4 + size);
  }
}

}  // namespace

std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
  return Inflater(packed, size).read();
}

std::optional<std::string> unzip(std::string_view archive, std::string_view name) {
  constexpr std::size_t kHead = 46, kFront = 30;
  if (name.starts_with('/')) name.remove_prefix(1);
  std::string_view rest = directory_of(archive);
  while (Record(rest).is(0x02014b50)) {
    ask();
    const Record head(rest);
    const std::size_t name_size = head.number(28, 2), extra = head.number(30, 2);
    const std::string_view called = from(rest, kHead).substr(0, name_size);
    Packed file{head.number(24, 4), head.number(20, 4), head.number(42, 4)};
    read_long(from(rest, kHead + name_size).substr(0, extra), file);
    rest = from(rest, kHead + name_size + extra + head.number(32, 2));
    if (!same_name(called.starts_with('/') ? called.substr(1) : called, name)) continue;
    const Record front(from(archive, file.at));
    const std::string_view bytes =
        from(archive, file.at + kFront + front.number(26, 2) + front.number(28, 2)).substr(0, file.packed);
    const std::uint64_t method = head.number(10, 2);
    if (!front.is(0x04034b50) || bytes.size() != file.packed || head.number(8, 2) % 2 == 1 ||
        (file.size > limits::kSmallUnpacked && file.size / limits::kMostUnpackedTimes > file.packed))
      return std::nullopt;
    std::optional<std::string> made;
    if (method == 0) made = bytes;
    if (method == 8) made = inflated(bytes, file.size);
    if (!made || made->size() != file.size || sum_of(*made) != head.number(16, 4)) return std::nullopt;
    return made;
  }
  return std::nullopt;
}

}  // namespace lekalo::verify
