#include "lekalo/layout/material_words.hpp"

#include <fmt/core.h>

#include "lekalo/geom/grid.hpp"

namespace lekalo::layout {

std::string thickness_text(std::int64_t steps) {
  std::string text = fmt::format("{:.4f}", geom::mm_from_grid(steps));
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string words_of(const Material& material) {
  std::string words = material.name;
  if (material.thickness != 0)
    words += fmt::format("{}{} mm", words.empty() ? "" : ", ", thickness_text(material.thickness));
  return words.empty() ? "no material" : words;
}

}  // namespace lekalo::layout
