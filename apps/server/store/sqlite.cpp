#include "sqlite.hpp"

#include <fmt/core.h>

namespace lekalo::server {
namespace {

constexpr const char* kDamagedPages = "the file is no store, or is damaged";

tl::unexpected<Error> trouble(sqlite3* database) {
  const int code = sqlite3_errcode(database);
  std::string reason;
  switch (code & 0xff) {
    case SQLITE_FULL:
      reason = "the disk is full";
      break;
    case SQLITE_READONLY:
      reason = "the file cannot be written";
      break;
    case SQLITE_IOERR:
      reason = "the disk does not take it (full, or broken)";
      break;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      reason = "another program uses the file";
      break;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      reason = kDamagedPages;
      break;
    case SQLITE_CANTOPEN:
      reason = "the file cannot be opened";
      break;
    default:
      reason = "it failed";
  }
  return failure(ErrorCode::environment, fmt::format("{}: {}", reason, sqlite3_errmsg(database)));
}

}  // namespace

bool tells_damaged_pages(const Error& error) { return error.message.starts_with(kDamagedPages); }

Statement& Statement::bind(int index, std::int64_t value) {
  sqlite3_bind_int64(raw_.get(), index, value);
  return *this;
}

Statement& Statement::bind(int index, std::string_view value) {
  // A null pointer would bind NULL, which an empty text is not.
  sqlite3_bind_text64(raw_.get(), index, value.empty() ? "" : value.data(), value.size(), SQLITE_TRANSIENT,
                      SQLITE_UTF8);
  return *this;
}

Statement& Statement::bind_bytes(int index, std::string_view bytes) {
  sqlite3_bind_blob64(raw_.get(), index, bytes.empty() ? "" : bytes.data(), bytes.size(), SQLITE_TRANSIENT);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(raw_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  auto error = trouble(sqlite3_db_handle(raw_.get()));
  reset();
  return error;
}

Result<void> Statement::run() {
  for (;;) {
    LEKALO_TRY(const bool row, step());
    if (!row) break;
  }
  reset();
  return {};
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(raw_.get(), column); }

std::string Statement::text(int column) const {
  const unsigned char* bytes = sqlite3_column_text(raw_.get(), column);
  if (bytes == nullptr) return {};
  return {reinterpret_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(raw_.get(), column))};
}

std::string Statement::bytes(int column) const {
  const void* bytes = sqlite3_column_blob(raw_.get(), column);
  if (bytes == nullptr) return {};
  return {static_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(raw_.get(), column))};
}

void Statement::reset() {
  sqlite3_reset(raw_.get());
  sqlite3_clear_bindings(raw_.get());
}

Result<Database> Database::open(const std::string& path) {
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(raw);
  if (raw == nullptr) return failure(ErrorCode::environment, "not enough memory for the store");
  if (code != SQLITE_OK) return trouble(raw);
  sqlite3_extended_result_codes(raw, 1);
  return database;
}

Result<void> Database::copy_to(const Database& target) const {
  sqlite3_backup* const copy = sqlite3_backup_init(target.raw_.get(), "main", raw_.get(), "main");
  if (copy == nullptr) return trouble(target.raw_.get());
  sqlite3_backup_step(copy, -1);
  if (sqlite3_backup_finish(copy) != SQLITE_OK) return trouble(target.raw_.get());
  return {};
}

void Database::keep_log() const noexcept {
  sqlite3_db_config(raw_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

bool Database::lacked_room() const {
  const int code = sqlite3_extended_errcode(raw_.get());
  return code == SQLITE_FULL || code == SQLITE_IOERR_WRITE;
}

Result<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* raw = nullptr;
  if (sqlite3_prepare_v2(raw_.get(), sql.data(), static_cast<int>(sql.size()), &raw, nullptr) != SQLITE_OK)
    return trouble(raw_.get());
  return Statement(raw);
}

Result<void> Database::run(const char* sql) const {
  if (sqlite3_exec(raw_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return trouble(raw_.get());
  return {};
}

Result<std::int64_t> Database::number(std::string_view sql) const {
  LEKALO_TRY(Statement statement, prepare(sql));
  LEKALO_TRY(const bool row, statement.step());
  return row ? statement.integer(0) : 0;
}

Result<Transaction> Transaction::begin(const Database& database) {
  LEKALO_CHECK(database.run("BEGIN IMMEDIATE"));
  return Transaction(database);
}

Transaction::~Transaction() {
  // A failed statement may have rolled back by itself.
  if (database_ != nullptr && database_->in_transaction()) database_->roll_back();
}

Result<void> Transaction::commit() { return database_->run("COMMIT"); }

}  // namespace lekalo::server
