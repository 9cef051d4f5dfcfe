#include "zip.hpp"

#include <fmt/core.h>

#define ZLIB_CONST
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "io/text/refusal.hpp"
#include "lekalo/base/archive_limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kEnd = "PK\x05\x06"sv, kLongEnd = "PK\x06\x06"sv, kLongPlace = "PK\x06\x07"sv,
                           kInDirectory = "PK\x01\x02"sv, kInFront = "PK\x03\x04"sv;
constexpr std::size_t kEndSize = 22, kLongEndSize = 56, kLongPlaceSize = 20, kDirectorySize = 46,
                      kFrontSize = 30, kLongestComment = 0xffff;
constexpr std::uint64_t kElsewhere = 0xffffffff;  // the number stands in the extra field of ZIP64

std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t k = size; k-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

std::string small_letters(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  std::string small(name);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

/// Replaces the numbers of an entry that are too large for 32 bits by those of its extra field.
bool read_long_numbers(std::string_view extra, ZipArchive::File& file) {
  constexpr std::uint64_t kZip64 = 1;
  while (extra.size() >= 4) {
    const std::uint64_t kind = number(extra, 0, 2), size = number(extra, 2, 2);
    extra.remove_prefix(4);
    if (size > extra.size()) return false;
    std::string_view field = extra.substr(0, size);
    extra.remove_prefix(size);
    if (kind != kZip64) continue;
    for (std::uint64_t* const value : {&file.size, &file.packed, &file.at}) {
      if (*value != kElsewhere) continue;
      if (field.size() < 8) return false;
      *value = number(field, 0, 8);
      field.remove_prefix(8);
    }
  }
  return true;
}

struct InflateEnd {
  void operator()(z_stream* stream) const {
    inflateEnd(stream);
    delete stream;
  }
};

}  // namespace

tl::unexpected<Error> ZipArchive::refuse_file(const File& file, const std::string& sentence) const {
  return refuse(name_, fmt::format("{} {}", excerpt(file.name), sentence));
}

Result<ZipArchive> ZipArchive::open(std::string_view bytes, const std::string& name) {
  ZipArchive made(bytes, name);
  LEKALO_CHECK(made.read_directory());
  return made;
}

Result<void> ZipArchive::read_directory() {
  const auto damaged = [&](const char* what) {
    return refuse(
        name_, fmt::format("{} this ZIP archive; it is cut off or damaged, export or copy it again", what));
  };
  std::optional<std::size_t> end;
  for (std::size_t back = kEndSize; back <= std::min(bytes_.size(), kEndSize + kLongestComment); ++back) {
    const std::size_t at = bytes_.size() - back;
    if (bytes_.substr(at, 4) != kEnd || number(bytes_, at + 20, 2) != back - kEndSize) continue;
    end = at;
    break;
  }
  if (!end) return damaged("there is no directory at the end of");
  std::uint64_t count = number(bytes_, *end + 10, 2), size = number(bytes_, *end + 12, 4),
                at = number(bytes_, *end + 16, 4);
  if (*end >= kLongPlaceSize && bytes_.substr(*end - kLongPlaceSize, 4) == kLongPlace) {
    const std::uint64_t place = number(bytes_, *end - kLongPlaceSize + 8, 8);
    if (place > *end || *end - place < kLongEndSize || bytes_.substr(place, 4) != kLongEnd)
      return damaged("there is no directory at its place in");
    count = number(bytes_, place + 32, 8), size = number(bytes_, place + 40, 8),
    at = number(bytes_, place + 48, 8);
  }
  if (at > *end || size > *end - at) return damaged("the directory is not at its place in");
  std::string_view rest = bytes_.substr(at, size);
  for (std::uint64_t k = 0; k < count; ++k) {
    ask();
    if (rest.size() < kDirectorySize || !rest.starts_with(kInDirectory))
      return damaged("the directory ends early in");
    const std::size_t name_size = number(rest, 28, 2), extra = number(rest, 30, 2),
                      comment = number(rest, 32, 2);
    if (rest.size() - kDirectorySize < name_size + extra + comment)
      return damaged("the directory ends early in");
    File file;
    file.name = rest.substr(kDirectorySize, name_size);
    file.flags = static_cast<std::uint16_t>(number(rest, 8, 2));
    file.method = static_cast<std::uint16_t>(number(rest, 10, 2));
    file.crc = static_cast<std::uint32_t>(number(rest, 16, 4));
    file.packed = number(rest, 20, 4), file.size = number(rest, 24, 4), file.at = number(rest, 42, 4);
    if (!read_long_numbers(rest.substr(kDirectorySize + name_size, extra), file))
      return damaged("the directory has a wrong field in");
    rest.remove_prefix(kDirectorySize + name_size + extra + comment);
    if (!files_.emplace(small_letters(file.name), file).second)
      return refuse_file(file, "is there twice in this ZIP archive; export it again");
  }
  return {};
}

const ZipArchive::File* ZipArchive::find(std::string_view name) const {
  const auto found = files_.find(small_letters(name));
  return found == files_.end() ? nullptr : &found->second;
}

Result<std::string_view> ZipArchive::packed_bytes(const File& file) const {
  constexpr std::uint16_t kEncrypted = 1;
  if ((file.flags & kEncrypted) != 0) return refuse_file(file, "is encrypted; export it without a password");
  if (file.method != 0 && file.method != Z_DEFLATED)
    return refuse_file(file, fmt::format("is packed by method {}, and only what is stored or deflated is "
                                         "read; pack the archive anew",
                                         file.method));
  if (file.at > bytes_.size() || bytes_.size() - file.at < kFrontSize ||
      bytes_.substr(file.at, 4) != kInFront)
    return refuse_file(file, "is not where the directory says; the archive is damaged, export it again");
  const std::uint64_t begin =
      file.at + kFrontSize + number(bytes_, file.at + 26, 2) + number(bytes_, file.at + 28, 2);
  if (begin > bytes_.size() || file.packed > bytes_.size() - begin)
    return refuse_file(file, "goes on behind the end of the archive; it is damaged, export it again");
  // Models become 5 to 20 times smaller; what becomes very much smaller is there to fill the memory.
  if (file.size > limits::kSmallUnpacked && file.size / limits::kMostUnpackedTimes > file.packed)
    return refuse_file(
        file, fmt::format("would become {} bytes of {}, which no model does", file.size, file.packed));
  return bytes_.substr(begin, file.packed);
}

Result<void> ZipArchive::unpack(const File& file, const Take& take) const {
  LEKALO_TRY(const std::string_view packed, packed_bytes(file));
  if (file.method == Z_DEFLATED) return inflate(file, packed, take);
  if (file.packed != file.size ||
      crc32_z(0, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != file.crc)
    return refuse_file(file, "is damaged: its sum is another one; export it again");
  return take(packed, true);
}

Result<void> ZipArchive::inflate(const File& file, std::string_view packed, const Take& take) const {
  const auto damaged = [&](const char* why) {
    return refuse_file(file, fmt::format("is damaged: {}; export it again", why));
  };
  const std::unique_ptr<z_stream, InflateEnd> stream(new z_stream{});
  if (inflateInit2(stream.get(), -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::vector<Bytef> piece(kPiece);
  std::uint64_t made = 0;
  uLong sum = crc32(0, nullptr, 0);
  for (int state = Z_OK; state != Z_STREAM_END;) {
    ask(1024);
    if (stream->avail_in == 0) {
      const std::string_view next = packed.substr(0, kPiece);
      packed.remove_prefix(next.size());
      stream->next_in = reinterpret_cast<const Bytef*>(next.data());
      stream->avail_in = static_cast<uInt>(next.size());
    }
    stream->next_out = piece.data(), stream->avail_out = kPiece;
    state = ::inflate(stream.get(), Z_NO_FLUSH);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR) return damaged("it ends early");
    if (state != Z_OK && state != Z_STREAM_END) return damaged("it is no deflated file");
    const std::size_t size = kPiece - stream->avail_out;
    made += size;
    sum = crc32_z(sum, piece.data(), size);
    if (made > file.size) return damaged("it is longer than the directory says");
    const bool last = state == Z_STREAM_END;
    if (last && (made != file.size || sum != file.crc)) return damaged("its sum is another one");
    LEKALO_CHECK(take({reinterpret_cast<const char*>(piece.data()), size}, last));
  }
  return {};
}

}  // namespace lekalo::io
