#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// Largest file that is read, bytes; larger ones are refused with a sentence.
inline constexpr std::size_t kLargestFile = std::size_t{1} << 30;

/// The whole file. ErrorCode::bad_input for a missing, unreadable, empty or too large file or a folder.
[[nodiscard]] Result<std::string> read_file(const std::string& path);

/// Lower-case hexadecimal SHA-256 of the bytes.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Files that appear together or not at all: written beside their targets under temporary names, then renamed.
/// A target that exists is replaced only at commit; nothing is left behind on failure (or in the destructor).
class AtomicFiles {
 public:
  AtomicFiles() = default;
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();
  [[nodiscard]] Result<void> add(const std::string& path, std::string_view bytes);
  [[nodiscard]] Result<void> commit();

 private:
  struct Pending {
    std::string temporary, target;
  };
  std::vector<Pending> pending_;
};

}  // namespace lekalo::io
