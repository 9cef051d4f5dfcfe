// Opens a store: makes it, brings it forward, and notices what is wrong with it as a whole.

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "convert.hpp"
#include "rows.hpp"

namespace lekalo::server {
namespace {

constexpr std::int64_t kApplicationId = 0x6c656b61;  // "leka"

constexpr const char* kSchema = R"(
CREATE TABLE store (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  id TEXT NOT NULL,
  commits INTEGER NOT NULL
) STRICT;
CREATE TABLE layout (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL,
  origin TEXT NOT NULL,
  revision INTEGER NOT NULL,
  placements INTEGER NOT NULL,
  changed TEXT NOT NULL,
  change_number INTEGER NOT NULL,
  digest TEXT NOT NULL
) STRICT;
CREATE TABLE snapshot (
  layout INTEGER NOT NULL REFERENCES layout ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  document TEXT NOT NULL,
  digest TEXT NOT NULL,
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
  digest TEXT NOT NULL,
  PRIMARY KEY (layout, revision)
) STRICT;
CREATE TABLE photo (
  layout INTEGER NOT NULL REFERENCES layout ON DELETE CASCADE,
  stock TEXT NOT NULL,
  type TEXT NOT NULL,
  scale TEXT NOT NULL,
  image BLOB NOT NULL,
  image_sha256 TEXT NOT NULL,
  digest TEXT NOT NULL,
  PRIMARY KEY (layout, stock)
) STRICT;
INSERT INTO store VALUES (1, lower(hex(randomblob(16))), 0);
)";

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
  flush_folder_of(path);
  return {};
}

Result<void> find_file(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0)
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", path, std::strerror(errno)));
  if (!S_ISREG(about.st_mode))
    return failure(ErrorCode::bad_input, fmt::format("{}: a store is a plain file", path));
  return {};
}

/// The name, or with a number behind it, so that no copy of another store is written over.
std::string free_name(const std::string& name) {
  std::string free = name;
  for (int n = 2; access(free.c_str(), F_OK) == 0; ++n) free = fmt::format("{}.{}", name, n);
  return free;
}

Result<void> mark(const Database& database) {
  const std::string marks =
      fmt::format("PRAGMA application_id={}; PRAGMA user_version={}", kApplicationId, kStoreFormat);
  return database.run(marks.c_str());
}

Result<std::string> schema_of(const Database& database) {
  LEKALO_TRY(Statement rows,
             database.prepare("SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY type, name"));
  std::string all;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return all;
    for (int column = 0; column < 4; ++column) all += rows.text(column) + '\n';
  }
}

/// The format that the file says it has; 0 for an empty one.
Result<std::int64_t> format_of(const Database& database) {
  LEKALO_TRY(const std::int64_t application, database.number("PRAGMA application_id"));
  if (application != kApplicationId) {
    LEKALO_TRY(const std::int64_t tables, database.number("SELECT count(*) FROM sqlite_master"));
    if (application != 0 || tables != 0)
      return failure(ErrorCode::environment, "it is a file of another program; name another --store");
    return 0;
  }
  LEKALO_TRY(const std::int64_t format, database.number("PRAGMA user_version"));
  if (format < 1 || format > kStoreFormat)
    return failure(ErrorCode::environment,
                   fmt::format("the store has format {}, this program knows format {}; use the version of "
                               "lekalo that wrote it",
                               format, kStoreFormat));
  return format;
}

}  // namespace

Result<Store> Store::open(const std::string& path, StoreUse use) {
  const bool serves = use == StoreUse::serve;
  LEKALO_CHECK(serves ? make_file(path) : find_file(path));
  const auto named = [&](const Error& error) {
    return failure(error.code, fmt::format("{}: {}", path, error.message));
  };
  Result<Database> database = Database::open(path);
  if (!database) return named(database.error());
  Store store(path, use, std::move(*database));
  if (Result<void> ready = store.prepare_file(); !ready) return named(ready.error());
  return store;
}

Result<void> Store::prepare_file() {
  // One server locks the file, so that what it keeps in memory agrees with the file.
  const bool serves = use_ == StoreUse::serve;
  for (const char* setting : {"PRAGMA locking_mode=EXCLUSIVE", "PRAGMA cell_size_check=ON"})
    LEKALO_CHECK(database_.run(setting));
  // A log that is there stays; SQLite removes the empty one that it makes itself.
  struct stat log {};
  if (!serves && stat((path_ + "-wal").c_str(), &log) == 0 && log.st_size > 0) database_.keep_log();
  for (const char* setting :
       {"PRAGMA auto_vacuum=INCREMENTAL", "PRAGMA journal_mode=WAL", "PRAGMA synchronous=FULL",
        "PRAGMA foreign_keys=ON", "PRAGMA secure_delete=FAST", "PRAGMA journal_size_limit=67108864",
        "BEGIN IMMEDIATE; COMMIT"})
    if (serves) LEKALO_CHECK(database_.run(setting));
  LEKALO_TRY(const std::int64_t format, format_of(database_));
  if (format == 0 && !serves) return failure(ErrorCode::bad_input, "the file is empty: it is no store");
  if (format == 0) {
    LEKALO_TRY(Transaction all, Transaction::begin(database_));
    LEKALO_CHECK(database_.run(kSchema));
    LEKALO_CHECK(mark(database_));
    LEKALO_CHECK(all.commit());
  }
  LEKALO_TRY(Statement check, database_.prepare("PRAGMA quick_check(1)"));
  LEKALO_CHECK(check.step());
  if (const std::string said = check.text(0); said != "ok" && serves)
    return damaged(
        fmt::format("{}; what is whole can be taken into a new one: lekalo store restore {} -o NEW",
                    said.substr(said.rfind('\n') + 1), path_));
  check.reset();
  if (format == 1 || format == 2) LEKALO_CHECK(bring_forward(format));
  // Programs that know format 3 or 4 cannot read what is written from now on.
  if ((format == 3 || format == 4) && serves) LEKALO_CHECK(mark(database_));
  LEKALO_CHECK(check_schema());
  LEKALO_CHECK(check_revision());
  Result<void> noted = note_damage();
  if (noted || serves) return noted;
  notices_.push_back(
      noted.error().message);  // what can be read of a damaged file is what an inspection is for
  return {};
}

Result<void> Store::bring_forward(std::int64_t format) {
  if (use_ == StoreUse::inspect) {
    LEKALO_TRY(Database copy, Database::in_memory());
    LEKALO_CHECK(database_.copy_to(copy));
    database_ = std::move(copy);
    LEKALO_CHECK(database_.run("PRAGMA foreign_keys=ON"));
  } else {
    const std::string copy = free_name(fmt::format("{}.format-{}", path_, format));
    LEKALO_CHECK(write_copy(copy));
    notices_.push_back(
        fmt::format("the store was of format {} and is of format {} now; {} is the store as it was", format,
                    kStoreFormat, copy));
  }
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  LEKALO_CHECK(set_old_tables_aside(database_, format));
  LEKALO_CHECK(database_.run(kSchema));
  LEKALO_TRY(const std::int64_t added, convert_tables(database_, use_ == StoreUse::serve, notices_));
  if (use_ == StoreUse::inspect) put_back_ = added;
  LEKALO_CHECK(mark(database_));
  LEKALO_CHECK(all.commit());
  // Only a file that is written anew can give back what is removed from it. Without room for that it goes on.
  if (use_ == StoreUse::serve)
    if (Result<void> anew = database_.run("PRAGMA auto_vacuum=INCREMENTAL; VACUUM"); !anew) return {};
  return {};
}

Result<void> Store::check_schema() const {
  LEKALO_TRY(const Database model, Database::in_memory());
  LEKALO_CHECK(model.run(kSchema));
  LEKALO_TRY(const std::string wanted, schema_of(model));
  LEKALO_TRY(const std::string found, schema_of(database_));
  if (found != wanted) return damaged("its tables are not those of a store");
  return {};
}

Result<void> Store::check_revision() {
  LEKALO_TRY(Statement row, database_.prepare("SELECT id, commits FROM store"));
  LEKALO_TRY(const bool found, row.step());
  if (!found) return damaged("it does not say which store it is");
  kept_ = {row.text(0), row.integer(1)};
  bool unreadable = false;
  const std::optional<OutsideRevision::Kept> outside = OutsideRevision::read(path_, unreadable);
  if (outside && outside->store == kept_.store && outside->commits > kept_.commits) {
    const std::string lost = fmt::format(
        "the store is older than what was acknowledged: it holds {} transactions of {}. Its log ({}-wal) is "
        "missing, or the file was put in place of a newer one. Put the log back; or take the store as it is: "
        "lekalo store restore {} -o NEW",
        kept_.commits, outside->commits, path_, path_);
    if (use_ == StoreUse::serve) return failure(ErrorCode::environment, lost);
    notices_.push_back(lost);
  }
  const std::string name = OutsideRevision::path_of(path_);
  if (unreadable)
    notices_.push_back(name + " cannot be read, so whether the store is the newest is not known");
  if (outside && outside->store != kept_.store) notices_.push_back(name + " belongs to another store");
  if (use_ == StoreUse::inspect) return {};
  LEKALO_TRY(outside_, OutsideRevision::open(path_));
  outside_.keep(kept_);
  make_reserve();
  return {};
}

Result<void> Store::note_damage() {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(const std::vector<Entry> entries, all_entries(database_));
  for (const Entry& entry : entries) {
    if (entry.whole) continue;
    const Result<StoredLayout> loaded = load_in_turn(entry.id, std::nullopt, turn);
    if (!loaded) notices_.push_back(loaded.error().message);
  }
  LEKALO_TRY(Statement strays, database_.prepare("PRAGMA foreign_key_check"));
  LEKALO_TRY(const bool stray, strays.step());
  if (stray) notices_.push_back("the store is damaged: it has changes of a layout that is not there");
  return {};
}

void Store::make_reserve() const {
  const std::string path = path_ + "-reserve";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) return;
  // Without room for all of it there is no reserve; a part of it would only be in the way.
  if (posix_fallocate(file, 0, kReserveBytes) != 0) ::unlink(path.c_str());
  ::close(file);
}

}  // namespace lekalo::server
