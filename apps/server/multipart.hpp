#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::server {

/// A field of a form, or a file that was chosen in it.
struct FormField {
  std::string name;
  std::string file;        ///< the name of the file; empty for a field
  std::string_view value;  ///< into the body
};

/// The most fields and files of a form.
inline constexpr std::size_t kMostFormFields = 2000;

/// Reads the body of a form as browsers and curl send it: multipart/form-data (RFC 7578). The boundary is
/// that of the body's first line, so that the header of the request is not needed. Fails with
/// ErrorCode::bad_input. Cost: O(bytes).
[[nodiscard]] Result<std::vector<FormField>> read_form(std::string_view body);

}  // namespace lekalo::server
