#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lekalo::io {

/// Layers by name, in either case.
class DxfLayers {
 public:
  struct Entry {
    std::string_view name;  ///< bytes of the file: of the table, or of where it was first used
    bool off = false;       ///< switched off: what stands on it is not seen
    bool frozen = false;    ///< likewise, and what is inserted on it is not seen either
    /// The groups 62, 420 and 6; empty where the file has none.
    std::string_view colour{}, true_colour{}, line_type{};
  };

  static constexpr std::uint32_t kZero =
      0;  ///< the layer "0", which a block's contents leave to the insertion

  DxfLayers();

  /// \pre the bytes of the name outlive the object
  [[nodiscard]] std::uint32_t index(std::string_view name);
  [[nodiscard]] Entry& operator[](std::uint32_t index) { return entries_[index]; }
  [[nodiscard]] const Entry& operator[](std::uint32_t index) const { return entries_[index]; }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  std::vector<Entry> entries_;
  std::unordered_map<std::string_view, std::uint32_t> as_spelled_;
  std::unordered_map<std::string, std::uint32_t> as_folded_;
  std::string_view last_;
  std::uint32_t last_index_ = 0;
};

}  // namespace lekalo::io
