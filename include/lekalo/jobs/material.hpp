#pragma once

#include <string>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::jobs {

/// A material as an order says it behind "@": "steel:2".
[[nodiscard]] std::string order_word_of(const layout::Material& material);

/// Materials as they stand in names of files, each with words that no other has, in whatever case they are
/// read: "steel-2", "birch-plywood-6.5". Everything but letters, digits, points and dashes becomes a dash.
[[nodiscard]] std::vector<std::string> file_words(const std::vector<layout::Material>& materials);

/// A path with a word before its ending: "out.json" and "steel-2" give "out-steel-2.json". The path itself
/// where either is empty.
[[nodiscard]] std::string path_with(const std::string& path, const std::string& word);

/// A name that is the only one becomes that of the materials without one. Then a thickness that is the only
/// one of a name becomes that of the others of this name.
void share_materials(std::vector<layout::Material>& materials);

}  // namespace lekalo::jobs
