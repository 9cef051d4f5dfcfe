#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::disk {

/// Largest file that is read, bytes; larger ones are refused with a sentence.
inline constexpr std::size_t kLargestFile = std::size_t{1} << 30;

/// The whole file. ErrorCode::bad_input for a missing, unreadable, empty or too large file or a folder.
[[nodiscard]] Result<std::string> read_file(const std::string& path);

/// Files that appear together or not at all: written and flushed to disk beside their targets under temporary
/// names (.lekalo-*.tmp), then renamed. A target that exists is replaced only at commit, keeping its
/// permissions, and if a rename fails the files renamed before it are put back. Nothing is left behind on
/// failure or by the destructor. What POSIX cannot give: between two renames of one commit another program
/// sees the first file new and the second old, and so does a power cut; and a disk that takes one rename and
/// then refuses another and its undoing leaves some files new. The sentence names these then, and under what
/// name the file that stood there is kept; on file systems without hard links it is gone.
///
/// Links are followed: the file they name is replaced (or made). Targets that are no plain files,
/// write-protected files and folders that are not there give ErrorCode::environment, one target named twice
/// ErrorCode::usage.
class AtomicFiles {
 public:
  AtomicFiles() = default;
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();
  [[nodiscard]] Result<void> add(const std::string& path, std::string_view bytes);
  /// After it, in success or failure, the object is as new.
  [[nodiscard]] Result<void> commit();

 private:
  struct Pending {
    std::string temporary, target, backup;
    bool replaces = false;
    bool is_stuck = false;  ///< new, and could not be put back
  };
  [[nodiscard]] static std::string stuck_sentence(const Pending& file);
  void discard() noexcept;
  void undo(std::size_t renamed) noexcept;
  std::vector<Pending> pending_;
};

}  // namespace lekalo::disk
