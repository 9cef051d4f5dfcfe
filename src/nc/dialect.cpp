#include "lekalo/nc/dialect.hpp"

#include <array>

/// Each name stands for a post, the value of `post_NAME()`, which a file of its own defines: post_NAME.cpp.
#define LEKALO_POSTS(each) each(linuxcnc) each(grbl) each(fanuc) each(haas)

#define LEKALO_DECLARED(name) Dialect post_##name();
#define LEKALO_MADE(name) post_##name(),

namespace lekalo::nc {

LEKALO_POSTS(LEKALO_DECLARED)

std::span<const Dialect> posts() noexcept {
  static const std::array all{LEKALO_POSTS(LEKALO_MADE)};
  return all;
}

const Dialect& post_of(words::Control language) noexcept {
  for (const Dialect& post : posts())
    if (post.language == language) return post;
  return posts().front();
}

const Dialect* post_named(std::string_view name) noexcept {
  for (const Dialect& post : posts())
    if (post.name == name) return &post;
  return nullptr;
}

std::string post_names(std::string_view separator, std::string_view last_separator) {
  std::string list;
  for (const Dialect& post : posts()) {
    if (&post != &posts().front()) list += &post == &posts().back() ? last_separator : separator;
    list += post.name;
  }
  return list;
}

}  // namespace lekalo::nc
