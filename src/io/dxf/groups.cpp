#include "groups.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "io/text/refusal.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {

bool DxfGroups::end_or_fault(std::string_view code) {
  const auto is_nothing = [](char c) { return is_blank(c) || c == '\n' || c == '\x1a'; };
  // Editors leave empty lines at the end, and DOS its end-of-file character.
  const bool ended = std::all_of(code.begin(), code.end(), is_nothing) && std::all_of(at_, end_, is_nothing);
  if (!ended)
    fault_ = refuse_line(name_, line_, fmt::format("{} is not a DXF group code", excerpt(code))).value();
  return false;
}

bool DxfGroups::ends_early() {
  fault_ = refuse_line(name_, line_, "the file ends after a group code; it is not complete").value();
  return false;
}

}  // namespace lekalo::io
