#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// One pair of lines of an ASCII DXF file.
struct DxfGroup {
  int code = 0;
  std::string_view value;  ///< without blanks around it
  std::size_t line = 0;    ///< of the value, 1-based
};

/// Takes the groups off a DXF text one by one.
class DxfGroups {
 public:
  DxfGroups(std::string_view bytes, const std::string& name) : name_(name), rest_(bytes) {}

  /// False at the end of the file and at the first fault, which is then in `fault`.
  bool next(DxfGroup& group);
  [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }

 private:
  std::optional<std::string_view> next_line();

  const std::string& name_;
  std::string_view rest_;
  std::size_t line_ = 0;
  std::optional<Error> fault_;
};

}  // namespace lekalo::io
