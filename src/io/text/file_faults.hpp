#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/text/json_tree.hpp"
#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// Everything that is wrong in a file that a person wrote, as one sentence, so that one reading of it mends
/// the file. A sentence tells kMostTold faults one by one, and how many more there are.
class FileFaults {
 public:
  static constexpr std::size_t kMostTold = 20;

  /// Stands before each fault from now on, for example "row 3: ".
  std::string where;

  void add(const std::string& what);
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// Fails with ErrorCode::bad_input and the sentence where there is a fault.
  [[nodiscard]] Result<void> refused(const std::string& file) const;

 private:
  std::string told_;
  std::size_t count_ = 0;
};

/// Fails with ErrorCode::bad_input where a file is no object whose "format" is the word.
/// \param what  the file is, for example "file of rates"
[[nodiscard]] Result<void> expect_format(detail::JsonValue root, const std::string& file, const char* what,
                                         std::string_view format);

}  // namespace lekalo::io
