// The photographs of stocks: docs/design/server.md.

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "rows.hpp"

namespace lekalo::server {
namespace {

tl::unexpected<Error> no_photo(const std::string& stock) {
  return failure(ErrorCode::usage, fmt::format("there is no photograph of stock '{}'", stock));
}

tl::unexpected<Error> damaged_photo(const std::string& stock) {
  return damaged(fmt::format("the photograph of stock '{}' is not as it was written; lay it anew", stock));
}

std::string scale_text(const PhotoScale& scale) {
  const auto& [pixels, mm] = scale;
  return fmt::format("{} {} {} {} {} {} {} {}", pixels[0], pixels[1], pixels[2], pixels[3], mm[0], mm[1],
                     mm[2], mm[3]);
}

std::optional<PhotoScale> scale_from(std::string_view text) {
  PhotoScale scale;
  for (double* number : {scale.pixels, scale.pixels + 1, scale.pixels + 2, scale.pixels + 3, scale.mm,
                         scale.mm + 1, scale.mm + 2, scale.mm + 3}) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const auto value = double_of_text(text.substr(0, end));
    if (!value) return std::nullopt;
    *number = *value;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return scale;
}

/// A row of the table `photo` without its image.
struct PhotoRow {
  std::string stock, type, scale, image_sha256;
  std::int64_t bytes = 0;
  bool whole = false;
};
constexpr const char* kPhotoRows =
    "SELECT stock, type, scale, image_sha256, length(image), digest FROM photo WHERE layout = ?";

PhotoRow photo_row(LayoutId id, const Statement& row) {
  PhotoRow photo{row.text(0), row.text(1), row.text(2), row.text(3), row.integer(4), false};
  photo.whole = row.text(5) == photo_digest(id, photo.stock, photo.type, photo.scale, photo.image_sha256);
  return photo;
}

/// Fails where the photograph is not there or damaged.
Result<PhotoRow> find_photo(const Database& database, LayoutId id, const std::string& stock) {
  LEKALO_TRY(Statement row, database.prepare(fmt::format("{} AND stock = ?", kPhotoRows)));
  LEKALO_TRY(const bool found, row.bind(1, id).bind(2, stock).step());
  if (!found) return no_photo(stock);
  PhotoRow photo = photo_row(id, row);
  if (!photo.whole) return damaged_photo(stock);
  return photo;
}

/// The bytes of a photograph, which nobody has looked at yet; none where there is none.
Result<std::string> image_of(const Database& database, LayoutId id, const std::string& stock) {
  LEKALO_TRY(Statement row, database.prepare("SELECT image FROM photo WHERE layout = ? AND stock = ?"));
  LEKALO_TRY(const bool found, row.bind(1, id).bind(2, stock).step());
  return found ? row.bytes(0) : std::string();
}

Result<void> write_photo(const Database& database, LayoutId id, const PhotoRow& photo,
                         const std::string& image) {
  LEKALO_TRY(Statement row, database.prepare("INSERT OR REPLACE INTO photo VALUES (?, ?, ?, ?, ?, ?, ?)"));
  return row.bind(1, id)
      .bind(2, photo.stock)
      .bind(3, photo.type)
      .bind(4, photo.scale)
      .bind_bytes(5, image)
      .bind(6, photo.image_sha256)
      .bind(7, photo_digest(id, photo.stock, photo.type, photo.scale, photo.image_sha256))
      .run();
}

}  // namespace

Result<std::vector<Photo>> Store::photos(LayoutId id) {
  const std::lock_guard lock(*turn_);
  LEKALO_CHECK(entry_of(database_, id));
  LEKALO_TRY(Statement rows, database_.prepare(fmt::format("{} ORDER BY stock", kPhotoRows)));
  rows.bind(1, id);
  std::vector<Photo> photos;
  for (;;) {
    LEKALO_TRY(const bool more, rows.step());
    if (!more) return photos;
    const PhotoRow row = photo_row(id, rows);
    const auto scale = scale_from(row.scale);
    if (!row.whole || !scale) return damaged_photo(row.stock);
    photos.push_back({row.stock, row.type, row.bytes, *scale});
  }
}

Result<std::string> Store::photo_image(LayoutId id, const std::string& stock) {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(const PhotoRow photo, find_photo(database_, id, stock));
  LEKALO_TRY(std::string image, image_of(database_, id, stock));
  turn.unlock();
  if (io::sha256(image) != photo.image_sha256) return damaged_photo(stock);
  return image;
}

Result<void> Store::set_photo(LayoutId id, const Photo& photo, const std::string& image) {
  const PhotoRow row{photo.stock, photo.type, scale_text(photo.scale), io::sha256(image), photo.bytes, true};
  const std::lock_guard lock(*turn_);
  return change([&] { return write_photo(database_, id, row, image); });
}

Result<void> Store::set_photo_scale(LayoutId id, const std::string& stock, const PhotoScale& scale) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(PhotoRow photo, find_photo(database_, id, stock));
  photo.scale = scale_text(scale);
  return change([&]() -> Result<void> {
    LEKALO_TRY(Statement row,
               database_.prepare("UPDATE photo SET scale = ?, digest = ? WHERE layout = ? AND stock = ?"));
    return row.bind(1, photo.scale)
        .bind(2, photo_digest(id, stock, photo.type, photo.scale, photo.image_sha256))
        .bind(3, id)
        .bind(4, stock)
        .run();
  });
}

Result<void> Store::remove_photo(LayoutId id, const std::string& stock) {
  const std::lock_guard lock(*turn_);
  return change([&]() -> Result<void> {
    LEKALO_TRY(Statement row, database_.prepare("DELETE FROM photo WHERE layout = ? AND stock = ?"));
    LEKALO_CHECK(row.bind(1, id).bind(2, stock).run());
    if (database_.changed_rows() == 0) return no_photo(stock);
    return {};
  });
}

Result<void> Store::copy_photos(LayoutId from, LayoutId to) {
  LEKALO_TRY(Statement rows, database_.prepare(kPhotoRows));
  rows.bind(1, from);
  std::vector<PhotoRow> photos;
  for (;;) {
    LEKALO_TRY(const bool more, rows.step());
    if (!more) break;
    photos.push_back(photo_row(from, rows));
  }
  rows.reset();
  for (const PhotoRow& photo : photos) {
    if (!photo.whole) continue;  // a damaged one stays behind
    const Result<std::string> image = image_of(database_, from, photo.stock);
    if (image && io::sha256(*image) == photo.image_sha256)
      LEKALO_CHECK(write_photo(database_, to, photo, *image));
  }
  return {};
}

Result<void> Store::check_photos(LayoutId id, StoreCheck& check) const {
  LEKALO_TRY(Statement rows, database_.prepare(fmt::format("{} ORDER BY stock", kPhotoRows)));
  rows.bind(1, id);
  for (;;) {
    LEKALO_TRY(const bool more, rows.step());
    if (!more) return {};
    ++check.photos;
    const PhotoRow photo = photo_row(id, rows);
    const Result<std::string> image = image_of(database_, id, photo.stock);
    if (!photo.whole || !scale_from(photo.scale) || !image || io::sha256(*image) != photo.image_sha256)
      check.damage.push_back(
          fmt::format("layout {}: the photograph of stock '{}' is not as it was written", id, photo.stock));
  }
}

}  // namespace lekalo::server
