#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sqlite.hpp"
#include "store.hpp"

namespace lekalo::server {

/// The rows of the store with the digests that chain them: docs/design/server.md.

/// A row of the table `layout`.
struct Entry {
  LayoutId id = 0;
  std::string name, origin;
  Revision revision = 0;
  std::int64_t placements = 0;
  std::string changed;
  std::int64_t change_number = 0;
  /// The digest of its last change, or of its first state where nothing was changed yet.
  std::string chain;
  /// False where the row is not as it was written, or the last change is another one.
  bool whole = false;
};

/// A row of the table `change`.
struct ChangeRow {
  Revision revision = 0;
  std::string at, author;
  std::int64_t kind = 0, mode = 0, target = 0;
  std::string text, change, digest;
};
inline constexpr const char* kChangeColumns =
    "revision, at, author, kind, mode, target, text, placements, digest";
/// Reads the columns of kChangeColumns.
[[nodiscard]] ChangeRow change_row(const Statement& row);

[[nodiscard]] std::string entry_digest(const Entry& entry);
/// \param before  the digest of the change before, or of the first state
[[nodiscard]] std::string change_digest(LayoutId id, const std::string& before, const ChangeRow& change);
/// \param chain  the digest of the change that led to the state; empty for the first state
[[nodiscard]] std::string state_digest(LayoutId id, Revision revision, const std::string& chain,
                                       const std::string& document);
[[nodiscard]] std::string photo_digest(LayoutId id, const std::string& stock, const std::string& type,
                                       const std::string& scale, const std::string& image_sha256);

/// Returns the digest of a change, or of the first state; empty where there is no such row.
[[nodiscard]] Result<std::string> chain_at(const Database& database, LayoutId id, Revision revision);
/// Fails with ErrorCode::usage where there is no such layout.
[[nodiscard]] Result<Entry> entry_of(const Database& database, LayoutId id);
/// Returns all layouts, the one that was changed last first.
[[nodiscard]] Result<std::vector<Entry>> all_entries(const Database& database);

/// These write a row with its digest.
[[nodiscard]] Result<void> add_entry(const Database& database, const Entry& entry);
[[nodiscard]] Result<void> change_entry(const Database& database, const Entry& entry);
[[nodiscard]] Result<void> add_change(const Database& database, LayoutId id, const ChangeRow& change);
[[nodiscard]] Result<void> add_snapshot(const Database& database, LayoutId id, Revision revision,
                                        const std::string& document, const std::string& digest);

/// The time of the change that is being written, UTC, ISO 8601.
[[nodiscard]] Result<std::string> time_now(const Database& database);

[[nodiscard]] tl::unexpected<Error> no_layout(LayoutId id);
[[nodiscard]] tl::unexpected<Error> damaged(const std::string& what);

/// Carries out a change where everything is as the change says it was before. Returns false, with the
/// document in any state, where it is not: then one of the two is damaged.
[[nodiscard]] bool carry_out_if_it_fits(const layout::Change& change, layout::Document& document);

}  // namespace lekalo::server
