#include "outside_revision.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "lekalo/io/text/sha256.hpp"

namespace lekalo::server {
namespace {

constexpr std::string_view kFormat = "lekalo-store-revision/1";
constexpr std::size_t kIdLength = 32, kSumLength = 16, kCommitsLength = 20;
/// One line, well within the sector that a disk writes whole or not at all.
constexpr std::size_t kLength = kFormat.size() + 1 + kIdLength + 1 + kCommitsLength + 1 + kSumLength + 1;

std::string line_of(const OutsideRevision::Kept& kept) {
  const std::string said = fmt::format("{} {} {:020}", kFormat, kept.store, kept.commits);
  return fmt::format("{} {}\n", said, io::sha256(said).substr(0, kSumLength));
}

}  // namespace

OutsideRevision::OutsideRevision(OutsideRevision&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

OutsideRevision& OutsideRevision::operator=(OutsideRevision&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

OutsideRevision::~OutsideRevision() {
  if (file_ >= 0) ::close(file_);
}

std::optional<OutsideRevision::Kept> OutsideRevision::read(const std::string& store_path, bool& unreadable) {
  unreadable = false;
  const int file = ::open(path_of(store_path).c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    unreadable = errno != ENOENT;
    return std::nullopt;
  }
  std::array<char, kLength + 1> bytes{};
  const ssize_t count = ::read(file, bytes.data(), bytes.size());
  ::close(file);
  if (count == 0) return std::nullopt;  // made, and not written before the power went
  unreadable = true;
  if (count != static_cast<ssize_t>(kLength)) return std::nullopt;
  const std::string text(bytes.data(), kLength);
  Kept kept;
  kept.store = text.substr(kFormat.size() + 1, kIdLength);
  const char* const digits = text.data() + kFormat.size() + 1 + kIdLength + 1;
  std::from_chars(digits, digits + kCommitsLength, kept.commits);
  if (line_of(kept) != text) return std::nullopt;
  unreadable = false;
  return kept;
}

Result<OutsideRevision> OutsideRevision::open(const std::string& store_path) {
  const std::string path = path_of(store_path);
  // Who may write in this folder could put a link here to a file that is not his.
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0)
    return failure(ErrorCode::environment, fmt::format("{}: the revision of the store cannot be kept: {}",
                                                       path, std::strerror(errno)));
  flush_folder_of(path);
  return OutsideRevision(file);
}

void OutsideRevision::keep(const Kept& kept) const noexcept {
  try {
    const std::string line = line_of(kept);
    if (::pwrite(file_, line.data(), line.size(), 0) == static_cast<ssize_t>(line.size())) ::fdatasync(file_);
  } catch (const std::bad_alloc&) {
    // The revision kept outside lags behind the store, as it does when the power goes here.
  }
}

void flush_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace lekalo::server
