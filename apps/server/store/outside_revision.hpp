#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lekalo/base/error.hpp"

namespace lekalo::server {

/// How many transactions a store has seen, in a small file beside it (PATH-revision). It is written after
/// each commit and flushed, so it may lag behind the store and never leads it: where it does lead, the store
/// has lost what was acknowledged, as it does without its write-ahead log.
class OutsideRevision {
 public:
  struct Kept {
    std::string store;  ///< the id of the store
    std::int64_t commits = 0;
  };
  OutsideRevision() = default;
  OutsideRevision(OutsideRevision&& other) noexcept;
  OutsideRevision& operator=(OutsideRevision&& other) noexcept;
  ~OutsideRevision();

  [[nodiscard]] static std::string path_of(const std::string& store_path) { return store_path + "-revision"; }
  /// Returns what the file says; nothing where there is none, and nothing with `unreadable` where it says
  /// nothing that was written by keep().
  [[nodiscard]] static std::optional<Kept> read(const std::string& store_path, bool& unreadable);
  /// Makes the file where there is none, and opens it. Fails with ErrorCode::environment.
  [[nodiscard]] static Result<OutsideRevision> open(const std::string& store_path);
  /// Writes over what the file says and waits until it is on the disk. A failure leaves it behind the store,
  /// where it does no harm.
  void keep(const Kept& kept) const noexcept;

 private:
  explicit OutsideRevision(int file) : file_(file) {}
  int file_ = -1;
};

/// Makes the folder of a file flush its names to the disk.
void flush_folder_of(const std::string& path);

}  // namespace lekalo::server
