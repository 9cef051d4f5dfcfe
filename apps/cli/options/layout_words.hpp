#pragma once

#include "form.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// The options that say how a layout is read, and where it is drawn and told; as typed.
struct LayoutWords {
  std::string path, instance, units, chords, join, repair, layer_rules, picture;
  std::vector<std::string> layers;
  bool strict = false, json = false;
};

void add_layout_source(Form& form, LayoutWords& words, bool required = true);
/// The part of these options that says how drawings are read.
void add_drawings_reading(Form& form, LayoutWords& words);
void add_layout_outputs(Form& form, LayoutWords& words);

[[nodiscard]] Result<LayoutSource> to_layout_source(const LayoutWords& words);
/// Fails with ErrorCode::usage unless a picture can be drawn under this name. An empty name passes: no
/// picture is asked for.
[[nodiscard]] Result<void> fine_picture(const std::string& path);

}  // namespace lekalo::cli
