#include <array>

#include "lekalo/locate/criterion.hpp"

/// Each name stands for a criterion, the value of `criterion_NAME()`, which a file of its own defines:
/// criterion_NAME.cpp.
#define LEKALO_CRITERIA(each) each(smallest) each(largest) each(even)

#define LEKALO_DECLARED(name) Criterion criterion_##name();
#define LEKALO_MADE(name) criterion_##name(),

namespace lekalo::locate {

LEKALO_CRITERIA(LEKALO_DECLARED)

std::span<const Criterion> criteria() noexcept {
  static const std::array all{LEKALO_CRITERIA(LEKALO_MADE)};
  return all;
}

const Criterion* criterion_named(std::string_view name) noexcept {
  for (const Criterion& criterion : criteria())
    if (criterion.name == name) return &criterion;
  return nullptr;
}

std::string criterion_names(std::string_view separator) {
  std::string list;
  for (const Criterion& criterion : criteria()) {
    if (!list.empty()) list += separator;
    list += criterion.name;
  }
  return list;
}

}  // namespace lekalo::locate
