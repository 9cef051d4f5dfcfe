#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::server {

/// A thin layer over the C interface of SQLite: handles close themselves, and failures are sentences.

/// Says whether a failure is that of a file whose pages are damaged.
[[nodiscard]] bool tells_damaged_pages(const Error& error);

class Statement {
 public:
  explicit Statement(sqlite3_stmt* raw) : raw_(raw) {}
  /// Binds a value to a parameter, counted from 1. Text is copied.
  Statement& bind(int index, std::int64_t value);
  Statement& bind(int index, std::string_view value);
  Statement& bind_bytes(int index, std::string_view bytes);
  /// Steps to the next row. Returns true when there is one. Fails with ErrorCode::environment.
  [[nodiscard]] Result<bool> step();
  /// Runs the statement to its end and makes it ready for other values.
  [[nodiscard]] Result<void> run();
  /// These return a column of the row, counted from 0. It is valid until the next step.
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::string bytes(int column) const;
  void reset();

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* raw) const noexcept { sqlite3_finalize(raw); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> raw_;
};

class Database {
 public:
  /// Opens a file for reading and writing; one that may not be written, for reading. Fails with
  /// ErrorCode::environment.
  [[nodiscard]] static Result<Database> open(const std::string& path);
  /// Returns an empty one that is no file.
  [[nodiscard]] static Result<Database> in_memory() { return open(":memory:"); }
  /// Copies every page into another one, whose content is lost.
  [[nodiscard]] Result<void> copy_to(const Database& target) const;
  /// Leaves the log as it is when this is closed.
  void keep_log() const noexcept;
  [[nodiscard]] Result<Statement> prepare(std::string_view sql) const;
  /// Runs one or more statements without parameters. Their rows are ignored.
  [[nodiscard]] Result<void> run(const char* sql) const;
  /// Returns the first column of the first row of a statement without parameters; 0 where there is no row.
  [[nodiscard]] Result<std::int64_t> number(std::string_view sql) const;
  [[nodiscard]] std::int64_t last_row() const { return sqlite3_last_insert_rowid(raw_.get()); }
  [[nodiscard]] std::int64_t changed_rows() const { return sqlite3_changes(raw_.get()); }
  /// Undoes an open transaction. It says nothing where that fails, and needs no memory to say it.
  void roll_back() const noexcept { sqlite3_exec(raw_.get(), "ROLLBACK", nullptr, nullptr, nullptr); }
  /// Says whether the last failure was for want of room on the disk.
  [[nodiscard]] bool lacked_room() const;
  [[nodiscard]] bool in_transaction() const { return sqlite3_get_autocommit(raw_.get()) == 0; }

 private:
  struct Close {
    void operator()(sqlite3* raw) const noexcept { sqlite3_close_v2(raw); }
  };
  explicit Database(sqlite3* raw) : raw_(raw) {}
  std::unique_ptr<sqlite3, Close> raw_;
};

/// A transaction is rolled back unless it is committed.
class Transaction {
 public:
  [[nodiscard]] static Result<Transaction> begin(const Database& database);
  Transaction(Transaction&& other) noexcept : database_(other.database_) { other.database_ = nullptr; }
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();
  /// Commits. After success what was done is on the disk; after failure nothing of it counts.
  [[nodiscard]] Result<void> commit();

 private:
  explicit Transaction(const Database& database) : database_(&database) {}
  const Database* database_;
};

}  // namespace lekalo::server
