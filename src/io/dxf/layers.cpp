#include "layers.hpp"

#include "text.hpp"

namespace lekalo::io {

DxfLayers::DxfLayers() { last_index_ = index("0"); }

std::uint32_t DxfLayers::index(std::string_view name) {
  // Neighbours in a file mostly stand on the same layer.
  if (name == last_ && !last_.empty()) return last_index_;
  const auto fresh = static_cast<std::uint32_t>(entries_.size());
  if (const auto [spelled, is_new] = as_spelled_.try_emplace(name, fresh); is_new) {
    const auto [entry, is_layer] = as_folded_.try_emplace(folded(name), fresh);
    if (is_layer) entries_.push_back({name});
    spelled->second = entry->second;
  }
  last_ = name;
  last_index_ = as_spelled_.find(name)->second;
  return last_index_;
}

}  // namespace lekalo::io
