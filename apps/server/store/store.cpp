#include "store.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/io/layout/layout_json.hpp"

namespace lekalo::server {
namespace {

constexpr std::int64_t kApplicationId = 0x6c656b61;  // "leka"

constexpr const char* kSchema = R"(
CREATE TABLE layout (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL,
  origin TEXT NOT NULL,
  revision INTEGER NOT NULL,
  placements INTEGER NOT NULL,
  changed TEXT NOT NULL,
  change_number INTEGER NOT NULL
) STRICT;
CREATE TABLE snapshot (
  layout INTEGER NOT NULL REFERENCES layout ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  document TEXT NOT NULL,
  PRIMARY KEY (layout, revision)
) STRICT;
CREATE TABLE change (
  layout INTEGER NOT NULL REFERENCES layout ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  at TEXT NOT NULL,
  author TEXT NOT NULL,
  kind INTEGER NOT NULL CHECK (kind BETWEEN 0 AND 3),
  mode INTEGER NOT NULL CHECK (mode BETWEEN 0 AND 1),
  target INTEGER NOT NULL,
  text TEXT NOT NULL,
  placements TEXT NOT NULL,
  PRIMARY KEY (layout, revision)
) STRICT;
)";

/// This table is new in format 2.
constexpr const char* kPhotoSchema = R"(
CREATE TABLE photo (
  layout INTEGER NOT NULL REFERENCES layout ON DELETE CASCADE,
  stock TEXT NOT NULL,
  type TEXT NOT NULL,
  scale TEXT NOT NULL,
  image BLOB NOT NULL,
  PRIMARY KEY (layout, stock)
) STRICT;
)";

constexpr const char* kNow = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";
/// Orders layouts by their last change. A number is counted for that, because the clock may stand still or go
/// back.
constexpr const char* kNextNumber = "(SELECT coalesce(max(change_number), 0) + 1 FROM layout)";

tl::unexpected<Error> no_layout(LayoutId id) {
  return failure(ErrorCode::usage, fmt::format("there is no layout {}", id));
}

/// Makes the file where there is none. If SQLite made it, others could read it for a moment.
Result<void> make_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0)
    return failure(ErrorCode::environment,
                   fmt::format("{}: the store cannot be opened for writing: {}", path, std::strerror(errno)));
  struct stat about {};
  const bool plain = fstat(file, &about) == 0 && S_ISREG(about.st_mode);
  ::close(file);
  if (!plain)
    return failure(ErrorCode::environment, fmt::format("{}: the store has to be a plain file", path));
  return {};
}

/// Says whether a change in the store belongs to the state before it; else the file is damaged.
bool fits(const layout::Change& change, const layout::Document& document) {
  for (const layout::PlacementChange& one : change.placements)
    for (const auto& side : {one.before, one.after})
      if (side && (side->part >= document.parts.size() || side->stock >= document.stocks.size()))
        return false;
  return std::all_of(change.features.begin(), change.features.end(),
                     [&](const layout::FeatureChange& one) { return one.stock < document.stocks.size(); });
}

}  // namespace

const char* name_of(ChangeKind kind) noexcept {
  switch (kind) {
    case ChangeKind::command:
      return "command";
    case ChangeKind::undo:
      return "undo";
    case ChangeKind::redo:
      return "redo";
    case ChangeKind::restore:
      return "restore";
  }
  return "?";
}

Result<Store> Store::open(const std::string& path) {
  LEKALO_CHECK(make_file(path));
  const auto named = [&](const Error& error) {
    return failure(error.code, fmt::format("{}: {}", path, error.message));
  };
  Result<Database> database = Database::open(path);
  if (!database) return named(database.error());
  Store store(path, std::move(*database));
  if (Result<void> ready = store.prepare_file(); !ready) return named(ready.error());
  return store;
}

Result<void> Store::prepare_file() {
  // One server locks the file, so that what it keeps in memory agrees with the file.
  for (const char* setting :
       {"PRAGMA locking_mode=EXCLUSIVE", "PRAGMA journal_mode=WAL", "PRAGMA synchronous=FULL",
        "PRAGMA foreign_keys=ON", "PRAGMA journal_size_limit=67108864", "BEGIN IMMEDIATE; COMMIT"}) {
    LEKALO_CHECK(database_.run(setting));
  }
  LEKALO_TRY(const std::int64_t application, database_.number("PRAGMA application_id"));
  LEKALO_TRY(const std::int64_t tables, database_.number("SELECT count(*) FROM sqlite_master"));
  if (application != kApplicationId) {
    if (application != 0 || tables != 0)
      return failure(ErrorCode::environment, "this is a database of another program; name another --store");
    LEKALO_TRY(Transaction all, Transaction::begin(database_));
    for (const char* schema : {kSchema, kPhotoSchema}) LEKALO_CHECK(database_.run(schema));
    const std::string marks =
        fmt::format("PRAGMA application_id={}; PRAGMA user_version={}", kApplicationId, kStoreFormat);
    LEKALO_CHECK(database_.run(marks.c_str()));
    return all.commit();
  }
  LEKALO_TRY(const std::int64_t format, database_.number("PRAGMA user_version"));
  if (format < 1 || format > kStoreFormat)
    return failure(ErrorCode::environment,
                   fmt::format("the store has format {}, this program knows format {}; use the version of "
                               "lekalo that wrote it",
                               format, kStoreFormat));
  LEKALO_TRY(Statement check, database_.prepare("PRAGMA quick_check(1)"));
  LEKALO_CHECK(check.step());
  if (const std::string said = check.text(0); said != "ok")
    return failure(ErrorCode::environment, "the store is damaged: " + said.substr(0, said.find('\n')));
  if (format == kStoreFormat) return {};
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  const std::string mark = fmt::format("PRAGMA user_version={}", kStoreFormat);
  for (const char* change : {kPhotoSchema, mark.c_str()}) LEKALO_CHECK(database_.run(change));
  return all.commit();
}

Result<LayoutId> Store::create_rows(const std::string& name, const layout::Document& document,
                                    const std::string& origin) {
  LEKALO_TRY(Statement row,
             database_.prepare(fmt::format("INSERT INTO layout (name, origin, revision, placements, changed, "
                                           "change_number) VALUES (?, ?, 0, ?, "
                                           "{}, {})",
                                           kNow, kNextNumber)));
  row.bind(1, name).bind(2, origin).bind(3, static_cast<std::int64_t>(document.placements.size()));
  LEKALO_CHECK(row.run());
  const LayoutId id = database_.last_row();
  LEKALO_TRY(Statement snapshot, database_.prepare("INSERT INTO snapshot VALUES (?, 0, ?)"));
  snapshot.bind(1, id).bind(2, io::write_layout(document));
  LEKALO_CHECK(snapshot.run());
  return id;
}

Result<LayoutId> Store::create(const std::string& name, const layout::Document& document,
                               const std::string& origin) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  const Result<LayoutId> made = create_rows(name, document, origin);
  if (!made) return made;
  LEKALO_CHECK(all.commit());
  return made;
}

Result<std::optional<LayoutId>> Store::find_origin(const std::string& origin) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(
      Statement rows,
      database_.prepare("SELECT id FROM layout WHERE origin = ? AND origin <> '' ORDER BY id DESC LIMIT 1"));
  LEKALO_TRY(const bool row, rows.bind(1, origin).step());
  if (!row) return std::optional<LayoutId>();
  return std::optional<LayoutId>(rows.integer(0));
}

Result<std::vector<LayoutSummary>> Store::list() {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(
      Statement rows,
      database_.prepare(
          "SELECT id, name, revision, placements, changed FROM layout ORDER BY change_number DESC, id DESC"));
  std::vector<LayoutSummary> found;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return found;
    found.push_back({rows.integer(0), rows.text(1), rows.integer(2), rows.integer(3), rows.text(4)});
  }
}

Result<StoredLayout> Store::load_locked(LayoutId id, std::optional<Revision> revision) {
  StoredLayout layout;
  {
    LEKALO_TRY(Statement row, database_.prepare("SELECT name, revision FROM layout WHERE id = ?"));
    LEKALO_TRY(const bool found, row.bind(1, id).step());
    if (!found) return no_layout(id);
    layout.name = row.text(0);
    layout.revision = row.integer(1);
  }
  if (revision && (*revision < 0 || *revision > layout.revision))
    return failure(ErrorCode::usage, fmt::format("there is no revision {}; the layout has 0 to {}", *revision,
                                                 layout.revision));
  if (revision) layout.revision = *revision;
  LEKALO_TRY(
      Statement snapshot,
      database_.prepare(
          "SELECT revision, document FROM snapshot WHERE layout = ? AND revision <= ? ORDER BY revision DESC "
          "LIMIT 1"));
  LEKALO_TRY(const bool found, snapshot.bind(1, id).bind(2, layout.revision).step());
  if (!found) return failure(ErrorCode::environment, "the store is damaged: a layout without its beginning");
  Revision at = snapshot.integer(0);
  Result<io::LayoutFile> file = io::read_layout(snapshot.text(1), fmt::format("layout {} in the store", id));
  if (!file) return failure(ErrorCode::environment, "the store is damaged: " + file.error().message);
  layout.document = std::move(file->document);

  LEKALO_TRY(Statement changes, database_.prepare("SELECT revision, placements FROM change WHERE layout = ? "
                                                  "AND revision > ? AND revision <= ? ORDER BY "
                                                  "revision"));
  changes.bind(1, id).bind(2, at).bind(3, layout.revision);
  for (;;) {
    LEKALO_TRY(const bool row, changes.step());
    if (!row) break;
    LEKALO_TRY(const layout::Change change, change_from_text(changes.text(1)));
    if (changes.integer(0) != ++at || !fits(change, layout.document))
      return failure(
          ErrorCode::environment,
          fmt::format("the store is damaged: revision {} of layout {} is missing or wrong", at, id));
    layout::carry_out(layout.document, change);
  }
  if (at != layout.revision)
    return failure(ErrorCode::environment,
                   fmt::format("the store is damaged: layout {} ends at revision {} instead of {}", id, at,
                               layout.revision));
  return layout;
}

Result<StoredLayout> Store::load(LayoutId id) {
  const std::lock_guard lock(*turn_);
  return load_locked(id, std::nullopt);
}

Result<layout::Document> Store::state_at(LayoutId id, Revision revision) {
  const std::lock_guard lock(*turn_);
  return load_locked(id, revision).map([](StoredLayout&& layout) { return std::move(layout.document); });
}

Result<LayoutId> Store::copy(LayoutId id, const std::string& name) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(const StoredLayout layout, load_locked(id, std::nullopt));
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  const Result<LayoutId> made = create_rows(name, layout.document, {});
  if (!made) return made;
  LEKALO_TRY(
      Statement photos,
      database_.prepare("INSERT INTO photo SELECT ?, stock, type, scale, image FROM photo WHERE layout = ?"));
  LEKALO_CHECK(photos.bind(1, *made).bind(2, id).run());
  LEKALO_CHECK(all.commit());
  return made;
}

Result<void> Store::one_row(LayoutId id, Result<void> done) {
  if (done && database_.changed_rows() == 0) return no_layout(id);
  return done;
}

Result<void> Store::rename(LayoutId id, const std::string& name) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare(fmt::format(
                                "UPDATE layout SET name = ?, changed = {}, change_number = {} WHERE id = ?",
                                kNow, kNextNumber)));
  return one_row(id, row.bind(1, name).bind(2, id).run());
}

Result<void> Store::remove(LayoutId id) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("DELETE FROM layout WHERE id = ?"));
  return one_row(id, row.bind(1, id).run());
}

Result<void> Store::append(LayoutId id, const StoredChange& change, const layout::Document& after) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  LEKALO_TRY(
      Statement row,
      database_.prepare(fmt::format(
          "UPDATE layout SET revision = ?, placements = ?, changed = {}, change_number = {} WHERE id = "
          "? AND revision = ?",
          kNow, kNextNumber)));
  row.bind(1, change.revision)
      .bind(2, static_cast<std::int64_t>(after.placements.size()))
      .bind(3, id)
      .bind(4, change.revision - 1);
  LEKALO_CHECK(one_row(id, row.run()));
  LEKALO_TRY(Statement entry,
             database_.prepare(fmt::format(
                 "INSERT INTO change (layout, revision, at, author, kind, mode, target, text, placements) "
                 "VALUES (?, ?, {}, ?, ?, ?, ?, ?, ?)",
                 kNow)));
  entry.bind(1, id)
      .bind(2, change.revision)
      .bind(3, change.author)
      .bind(4, static_cast<std::int64_t>(change.kind))
      .bind(5, static_cast<std::int64_t>(change.mode))
      .bind(6, change.target)
      .bind(7, change.text)
      .bind(8, change_text(change.change));
  LEKALO_CHECK(entry.run());
  if (change.revision % kSnapshotEvery == 0) {
    LEKALO_TRY(Statement snapshot, database_.prepare("INSERT INTO snapshot VALUES (?, ?, ?)"));
    snapshot.bind(1, id).bind(2, change.revision).bind(3, io::write_layout(after));
    LEKALO_CHECK(snapshot.run());
  }
  return all.commit();
}

Result<StoredChange> Store::change_at(LayoutId id, Revision revision) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("SELECT kind, mode, target, author, text, placements FROM "
                                              "change WHERE layout = ? AND revision = ?"));
  LEKALO_TRY(const bool found, row.bind(1, id).bind(2, revision).step());
  if (!found)
    return failure(ErrorCode::usage, fmt::format("layout {} has no change of revision {}", id, revision));
  LEKALO_TRY(layout::Change change, change_from_text(row.text(5)));
  return StoredChange{revision,
                      static_cast<ChangeKind>(row.integer(0)),
                      static_cast<layout::Mode>(row.integer(1)),
                      row.integer(2),
                      row.text(3),
                      row.text(4),
                      std::move(change)};
}

namespace {

/// Fails where there is no such layout.
Result<void> exists(Database& database, LayoutId id) {
  LEKALO_TRY(Statement layout, database.prepare("SELECT 1 FROM layout WHERE id = ?"));
  LEKALO_TRY(const bool there, layout.bind(1, id).step());
  if (!there) return no_layout(id);
  return {};
}

/// Goes through the rows of a query about one layout, which has to be there.
/// \param take  takes a row and returns a Result<void>
template <class Take>
Result<void> each_row(Database& database, LayoutId id, const char* query, Take&& take) {
  LEKALO_CHECK(exists(database, id));
  LEKALO_TRY(Statement rows, database.prepare(query));
  rows.bind(1, id);
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return {};
    LEKALO_CHECK(take(rows));
  }
}

}  // namespace

Result<std::vector<HistoryEntry>> Store::history(LayoutId id) {
  const std::lock_guard lock(*turn_);
  std::vector<HistoryEntry> entries;
  Result<void> read = each_row(
      database_, id,
      "SELECT revision, at, author, text, kind, target FROM change WHERE layout = ? ORDER BY revision",
      [&](const Statement& row) -> Result<void> {
        const HistoryEntry entry{
            row.integer(0), row.text(1), row.text(2), row.text(3), static_cast<ChangeKind>(row.integer(4)),
            row.integer(5), false};
        // Revisions begin at 1 and have no holes.
        const bool takes_back = entry.kind == ChangeKind::undo, does_again = entry.kind == ChangeKind::redo;
        if ((takes_back || does_again) && entry.target >= 1 &&
            entry.target <= static_cast<Revision>(entries.size()))
          entries[static_cast<std::size_t>(entry.target - 1)].undone = takes_back;
        entries.push_back(entry);
        return {};
      });
  LEKALO_CHECK(read);
  return entries;
}

namespace {

tl::unexpected<Error> no_photo(const std::string& stock) {
  return failure(ErrorCode::usage, fmt::format("there is no photograph of stock '{}'", stock));
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

}  // namespace

Result<std::vector<Photo>> Store::photos(LayoutId id) {
  const std::lock_guard lock(*turn_);
  std::vector<Photo> photos;
  Result<void> read = each_row(
      database_, id, "SELECT stock, type, length(image), scale FROM photo WHERE layout = ? ORDER BY stock",
      [&](const Statement& row) -> Result<void> {
        const auto scale = scale_from(row.text(3));
        if (!scale)
          return failure(ErrorCode::environment,
                         "the store is damaged: the scale of a photograph is no scale");
        photos.push_back({row.text(0), row.text(1), row.integer(2), *scale});
        return {};
      });
  LEKALO_CHECK(read);
  return photos;
}

Result<std::string> Store::photo_image(LayoutId id, const std::string& stock) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("SELECT image FROM photo WHERE layout = ? AND stock = ?"));
  LEKALO_TRY(const bool found, row.bind(1, id).bind(2, stock).step());
  if (!found) return no_photo(stock);
  return row.bytes(0);
}

Result<void> Store::set_photo(LayoutId id, const Photo& photo, const std::string& image) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("INSERT OR REPLACE INTO photo VALUES (?, ?, ?, ?, ?)"));
  return row.bind(1, id)
      .bind(2, photo.stock)
      .bind(3, photo.type)
      .bind(4, scale_text(photo.scale))
      .bind_bytes(5, image)
      .run();
}

Result<void> Store::set_photo_scale(LayoutId id, const std::string& stock, const PhotoScale& scale) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("UPDATE photo SET scale = ? WHERE layout = ? AND stock = ?"));
  Result<void> done = row.bind(1, scale_text(scale)).bind(2, id).bind(3, stock).run();
  if (done && database_.changed_rows() == 0) return no_photo(stock);
  return done;
}

Result<void> Store::remove_photo(LayoutId id, const std::string& stock) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement row, database_.prepare("DELETE FROM photo WHERE layout = ? AND stock = ?"));
  Result<void> done = row.bind(1, id).bind(2, stock).run();
  if (done && database_.changed_rows() == 0) return no_photo(stock);
  return done;
}

}  // namespace lekalo::server
