#include "lekalo/disk/files.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace lekalo::disk {
namespace {

/// An open file; closing may report what writing did not.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

tl::unexpected<Error> trouble(ErrorCode code, const std::string& path, const char* what) {
  return failure(code, fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

/// Follows symbolic links of the last name, also to a file that is not there yet: renaming over a link would
/// replace the link and leave the file it names as it was.
Result<std::string> behind_links(const std::string& path) {
  constexpr int kMostLinks = 40;
  std::filesystem::path target = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(target, error))) return target.string();
    const auto next = std::filesystem::read_symlink(target, error);
    if (error) return failure(ErrorCode::environment, fmt::format("{}: cannot follow the link", path));
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return failure(ErrorCode::environment, fmt::format("{}: too many links", path));
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// A name beside the target that no other file has; short, because a target's own name may be as long as
/// names go.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}/.lekalo-{}-{}.tmp", folder_of(target), ::getpid(), counter++);
}

/// Makes something beside `target` under a name that no other file has, and says the name. `make` takes a
/// name and returns a number below 0, with errno, where it fails.
template <class Make>
int make_beside(const std::string& target, std::string& name, const Make& make) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    std::string free_name = temporary_name(target);
    const int made = make(free_name.c_str());
    if (made >= 0) name = std::move(free_name);  // which cannot fail: a file whose name is lost would stay
    if (made >= 0 || errno != EEXIST) return made;
  }
  return -1;
}

int create_beside(const std::string& target, std::string& name) {
  return make_beside(target, name, [](const char* path) {
    return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  });
}

/// Says whether a file cannot have a second name, by errno: its file system has none, or not for others.
bool has_one_name() { return errno == EPERM || errno == EOPNOTSUPP || errno == ENOSYS || errno == EMLINK; }

/// Owner and permissions of the file that is replaced. Where the owner cannot be kept, set-user bits must not
/// be.
bool keep_attributes(int file, const struct stat& old) {
  struct stat made {};
  if (::fstat(file, &made) != 0) return false;
  const bool same_owner =
      (made.st_uid == old.st_uid && made.st_gid == old.st_gid) || ::fchown(file, old.st_uid, old.st_gid) == 0;
  return ::fchmod(file, old.st_mode & (same_owner ? 07777U : 0777U)) == 0;
}

/// Makes the names in a folder durable; file systems that cannot are not an error.
void sync_folder(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) return trouble(ErrorCode::bad_input, path, "cannot be opened");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return trouble(ErrorCode::bad_input, path, "cannot be read");
  if (S_ISDIR(status.st_mode))
    return failure(ErrorCode::bad_input, fmt::format("{}: is a folder, not a file", path));
  const auto too_large = [&] {
    return failure(ErrorCode::bad_input, fmt::format("{}: is larger than {} MiB; thin the file out first",
                                                     path, kLargestFile >> 20U));
  };
  if (S_ISREG(status.st_mode) && status.st_size > static_cast<off_t>(kLargestFile)) return too_large();

  // Pipes do not tell their size, so this reads until the end in any case.
  std::string bytes;
  constexpr std::size_t kFirstBlock = std::size_t{1} << 16U;
  std::size_t room =
      std::max(kFirstBlock, S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : 0);
  std::size_t size = 0;
  while (true) {
    if (size == bytes.size()) bytes.resize(std::max(room, 2 * size));
    const ssize_t got = ::read(file.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return trouble(ErrorCode::bad_input, path, "cannot be read");
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size > kLargestFile) return too_large();
  }
  bytes.resize(size);
  if (bytes.empty()) return failure(ErrorCode::bad_input, fmt::format("{}: is empty", path));
  return bytes;
}

AtomicFiles::~AtomicFiles() { discard(); }

void AtomicFiles::discard() noexcept {
  for (const Pending& file : pending_) {
    if (!file.temporary.empty()) ::unlink(file.temporary.c_str());
    if (!file.backup.empty() && !file.is_stuck) ::unlink(file.backup.c_str());
  }
  pending_.clear();
}

Result<void> AtomicFiles::add(const std::string& path, std::string_view bytes) {
  LEKALO_TRY(const auto target, behind_links(path));
  struct stat old {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;
  if (!replaces && errno != ENOENT) return trouble(ErrorCode::environment, path, "cannot be written");
  if (replaces && !S_ISREG(old.st_mode)) {
    return failure(ErrorCode::environment,
                   fmt::format("{}: cannot be written: it is not a plain file", path));
  }
  // Renaming would get around a file's own write protection.
  if (replaces && ::access(target.c_str(), W_OK) != 0) {
    return trouble(ErrorCode::environment, path, "cannot be written");
  }
  for (const Pending& other : pending_) {
    struct stat earlier {};
    const bool same =
        target == other.target || (replaces && ::stat(other.target.c_str(), &earlier) == 0 &&
                                   earlier.st_dev == old.st_dev && earlier.st_ino == old.st_ino);
    if (same) return failure(ErrorCode::usage, fmt::format("{}: named for two outputs", path));
  }

  // The place for its name comes before the file: what is made is removed even when memory ends.
  pending_.push_back({{}, target, {}, replaces});
  std::string& temporary = pending_.back().temporary;
  Descriptor file(create_beside(target, temporary));
  if (file.number() < 0 || !write_all(file.number(), bytes) ||
      (replaces && !keep_attributes(file.number(), old)) || ::fsync(file.number()) != 0 || !file.close()) {
    auto why = trouble(ErrorCode::environment, path, "cannot be written");
    if (!temporary.empty()) ::unlink(temporary.c_str());
    pending_.pop_back();
    return why;
  }
  return {};
}

Result<void> AtomicFiles::commit() {
  const auto given_up = [&](const Pending& file) {
    auto why = trouble(ErrorCode::environment, file.target, "cannot be written");
    for (const Pending& other : pending_)
      if (other.is_stuck) why.value().message += stuck_sentence(other);
    discard();
    return why;
  };
  // A second name for each file that goes, so that it can be put back if a later rename fails.
  for (std::size_t i = 0; i + 1 < pending_.size(); ++i) {
    Pending& file = pending_[i];
    const auto link_to = [&](const char* name) { return ::link(file.target.c_str(), name); };
    if (file.replaces && make_beside(file.target, file.backup, link_to) < 0 && !has_one_name())
      return given_up(file);
  }
  // From the first rename on nothing asks for memory.
  std::vector<std::string> folders;
  for (const Pending& file : pending_) folders.push_back(folder_of(file.target));
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    if (::rename(pending_[i].temporary.c_str(), pending_[i].target.c_str()) == 0) continue;
    const int why = errno;
    undo(i);
    errno = why;
    return given_up(pending_[i]);
  }
  for (Pending& file : pending_) file.temporary.clear();
  for (const std::string& folder : folders) sync_folder(folder);
  discard();
  return {};
}

void AtomicFiles::undo(std::size_t renamed) noexcept {
  for (std::size_t i = renamed; i-- > 0;) {
    Pending& file = pending_[i];
    file.temporary.clear();
    if (!file.replaces) {
      ::unlink(file.target.c_str());
    } else if (!file.backup.empty() && ::rename(file.backup.c_str(), file.target.c_str()) == 0) {
      file.backup.clear();
    } else {
      file.is_stuck = true;
    }
  }
}

std::string AtomicFiles::stuck_sentence(const Pending& file) {
  return file.backup.empty() ? fmt::format("; {} is new already, and what it was is gone", file.target)
                             : fmt::format("; {} is new already and could not be put back: {} is what it was",
                                           file.target, file.backup);
}

}  // namespace lekalo::disk
