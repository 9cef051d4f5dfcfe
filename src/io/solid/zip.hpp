#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// A ZIP archive by the directory at its end, with files that are stored or deflated, also beyond 4 GB
/// (PKWARE's APPNOTE 6.3.10). What stands in front of a file is believed only for where its bytes begin.
///
/// Everything fails with bad_input and a sentence that names the archive, and the file in it.
class ZipArchive {
 public:
  struct File {
    std::string_view name;
    std::uint64_t packed = 0, size = 0;
    std::uint64_t at = 0;  ///< of its local header
    std::uint32_t crc = 0;
    std::uint16_t method = 0, flags = 0;
  };

  /// \pre the bytes outlive the archive
  [[nodiscard]] static Result<ZipArchive> open(std::string_view bytes, const std::string& name);

  /// The file of this name, in any case of ASCII letters, with or without a leading slash; none: nullptr.
  [[nodiscard]] const File* find(std::string_view name) const;

  /// take(piece, is the last one) until it fails. Nothing is handed out of a file that says it would be very
  /// much larger than it is packed. The last piece comes when the sum over the bytes is right.
  using Take = std::function<Result<void>(std::string_view, bool)>;
  [[nodiscard]] Result<void> unpack(const File& file, const Take& take) const;

 private:
  ZipArchive(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  [[nodiscard]] Result<void> read_directory();
  [[nodiscard]] Result<std::string_view> packed_bytes(const File& file) const;
  [[nodiscard]] Result<void> inflate(const File& file, std::string_view packed, const Take& take) const;
  [[nodiscard]] tl::unexpected<Error> refuse_file(const File& file, const std::string& sentence) const;

  std::string_view bytes_;
  std::string name_;
  std::map<std::string, File> files_;  ///< by name in small letters
};

}  // namespace lekalo::io
