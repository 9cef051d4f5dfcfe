#include "file_faults.hpp"

#include <fmt/core.h>

#include "json_reader.hpp"
#include "refusal.hpp"

namespace lekalo::io {

void FileFaults::add(const std::string& what) {
  if (++count_ <= kMostTold) told_ += (told_.empty() ? "" : "; ") + where + what;
}

Result<void> FileFaults::refused(const std::string& file) const {
  if (count_ == 0) return {};
  return refuse(file, count_ > kMostTold ? fmt::format("{}; and {} more", told_, count_ - kMostTold) : told_);
}

Result<void> expect_format(detail::JsonValue root, const std::string& file, const char* what,
                           std::string_view format) {
  if (root.kind() != detail::JsonKind::object)
    return refuse(file, fmt::format("a {} is an object, not {}", what, name_of(root.kind())));
  const auto said = root.find("format");
  if (!said || !said->text_is(format))
    return refuse(file, fmt::format("this is no {}: \"format\" has to be \"{}\"", what, format));
  return {};
}

}  // namespace lekalo::io
