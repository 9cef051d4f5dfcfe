#include "store.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "lekalo/io/layout/layout_json.hpp"
#include "pause.hpp"
#include "rows.hpp"

namespace lekalo::server {
namespace {

/// The pages that are given back at once, so that the log stays small.
constexpr const char* kGiveBack = "PRAGMA incremental_vacuum(512)";

Result<std::int64_t> next_change_number(const Database& database) {
  return database.number("SELECT coalesce(max(change_number), 0) + 1 FROM layout");
}

/// Gives the room of removed rows back to the disk. Where that fails the pages are used again.
Result<void> give_room_back(const Database& database) {
  for (;;) {
    LEKALO_TRY(const std::int64_t before, database.number("PRAGMA freelist_count"));
    if (before == 0) break;
    LEKALO_CHECK(database.run(kGiveBack));
    LEKALO_CHECK(database.run("PRAGMA wal_checkpoint(TRUNCATE)"));
    LEKALO_TRY(const std::int64_t after, database.number("PRAGMA freelist_count"));
    if (after >= before) break;
  }
  return database.run("PRAGMA wal_checkpoint(TRUNCATE)");
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

Result<void> Store::change(const std::function<Result<void>()>& work) {
  LEKALO_TRY(Transaction all, Transaction::begin(database_));
  LEKALO_CHECK(work());
  LEKALO_CHECK(database_.run("UPDATE store SET commits = commits + 1"));
  LEKALO_CHECK(all.commit());
  ++kept_.commits;
  outside_.keep(kept_);
  return {};
}

Result<LayoutId> Store::create_rows(const std::string& name, const layout::Document& document,
                                    const std::string& text, const std::string& origin) {
  // The digests need the id, which an entry without name has for that moment.
  LEKALO_CHECK(database_.run("INSERT INTO layout VALUES (NULL, '', '', 0, 0, '', 0, '')"));
  Entry entry{database_.last_row(),
              name,
              origin,
              0,
              static_cast<std::int64_t>(document.placements.size()),
              {},
              0,
              {},
              true};
  LEKALO_TRY(entry.changed, time_now(database_));
  LEKALO_TRY(entry.change_number, next_change_number(database_));
  entry.chain = state_digest(entry.id, 0, "", text);
  LEKALO_CHECK(add_snapshot(database_, entry.id, 0, text, entry.chain));
  LEKALO_CHECK(change_entry(database_, entry));
  return entry.id;
}

Result<LayoutId> Store::create(const std::string& name, const layout::Document& document,
                               const std::string& origin) {
  const std::string text = io::write_layout(document);
  const std::lock_guard lock(*turn_);
  LayoutId made = 0;
  LEKALO_CHECK(change([&]() -> Result<void> {
    LEKALO_TRY(made, create_rows(name, document, text, origin));
    return {};
  }));
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
  LEKALO_TRY(const std::vector<Entry> entries, all_entries(database_));
  std::vector<LayoutSummary> found;
  for (const Entry& one : entries)
    found.push_back({one.id, one.name, one.revision, one.placements, one.changed, !one.whole});
  return found;
}

Result<LayoutId> Store::copy(LayoutId id, const std::string& name, std::optional<Revision> revision) {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(const StoredLayout layout, load_in_turn(id, revision, turn));
  turn.unlock();
  const std::string text = io::write_layout(layout.document);
  turn.lock();
  LayoutId made = 0;
  LEKALO_CHECK(change([&]() -> Result<void> {
    LEKALO_TRY(made, create_rows(name, layout.document, text, {}));
    return copy_photos(id, made);
  }));
  return made;
}

Result<void> Store::rename(LayoutId id, const std::string& name) {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(Entry entry, entry_of(database_, id));
  // A damaged entry would look whole with a new digest.
  if (!entry.whole) return load_in_turn(id, std::nullopt, turn).map([](StoredLayout&&) {});
  entry.name = name;
  LEKALO_TRY(entry.changed, time_now(database_));
  LEKALO_TRY(entry.change_number, next_change_number(database_));
  return change([&] { return change_entry(database_, entry); });
}

Result<void> Store::remove(LayoutId id) {
  const std::lock_guard lock(*turn_);
  const auto attempt = [&] {
    return change([&]() -> Result<void> {
      LEKALO_TRY(Statement row, database_.prepare("DELETE FROM layout WHERE id = ?"));
      LEKALO_CHECK(row.bind(1, id).run());
      if (database_.changed_rows() == 0) return no_layout(id);
      return {};
    });
  };
  Result<void> done = attempt();
  if (!done && database_.lacked_room()) {
    ::unlink((path_ + "-reserve").c_str());
    done = attempt();
  }
  if (!done) return done;
  const Result<void> given_back = give_room_back(database_);
  if (given_back) make_reserve();
  return {};  // the layout is gone in either case
}

Result<void> Store::append(LayoutId id, const StoredChange& change_made, const layout::Document& after) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Entry entry, entry_of(database_, id));
  if (entry.revision != change_made.revision - 1) return no_layout(id);
  if (!entry.whole) return damaged(fmt::format("layout {} takes no changes", id));
  ChangeRow row{change_made.revision,
                {},
                change_made.author,
                static_cast<std::int64_t>(change_made.kind),
                static_cast<std::int64_t>(change_made.mode),
                change_made.target,
                change_made.text,
                change_text(change_made.change),
                {}};
  LEKALO_TRY(row.at, time_now(database_));
  row.digest = change_digest(id, entry.chain, row);
  entry.revision = row.revision;
  entry.placements = static_cast<std::int64_t>(after.placements.size());
  entry.changed = row.at;
  LEKALO_TRY(entry.change_number, next_change_number(database_));
  entry.chain = row.digest;
  return change([&]() -> Result<void> {
    LEKALO_CHECK(change_entry(database_, entry));
    LEKALO_CHECK(add_change(database_, id, row));
    if (row.revision % kSnapshotEvery != 0) return {};
    const std::string text = io::write_layout(after);
    return add_snapshot(database_, id, row.revision, text, state_digest(id, row.revision, row.digest, text));
  });
}

Result<StoredChange> Store::change_at(LayoutId id, Revision revision) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement found,
             database_.prepare(
                 fmt::format("SELECT {} FROM change WHERE layout = ? AND revision = ?", kChangeColumns)));
  LEKALO_TRY(const bool there, found.bind(1, id).bind(2, revision).step());
  if (!there)
    return failure(ErrorCode::usage, fmt::format("layout {} has no change of revision {}", id, revision));
  ChangeRow row = change_row(found);
  LEKALO_TRY(const std::string before, chain_at(database_, id, revision - 1));
  if (row.digest != change_digest(id, before, row))
    return damaged(fmt::format("revision {} of layout {} is not as it was written", revision, id));
  LEKALO_TRY(layout::Change change, change_from_text(row.change));
  return StoredChange{revision,
                      static_cast<ChangeKind>(row.kind),
                      static_cast<layout::Mode>(row.mode),
                      row.target,
                      std::move(row.author),
                      std::move(row.text),
                      std::move(change)};
}

Result<bool> Store::job_changed_since(LayoutId id, Revision revision) {
  const std::lock_guard lock(*turn_);
  LEKALO_TRY(Statement found,
             database_.prepare("SELECT 1 FROM change WHERE layout = ? AND revision > ? AND placements GLOB "
                               "'*' || char(10) || '[pPsS]*' LIMIT 1"));
  return found.bind(1, id).bind(2, revision).step();
}

namespace {

HistoryEntry missing_entry(Revision revision) {
  HistoryEntry entry;
  entry.revision = revision;
  entry.text = "(damaged)";
  entry.kind = ChangeKind::restore;
  entry.damaged = true;
  return entry;
}

/// Reads a few changes after a revision; none where it is the last.
Result<std::vector<ChangeRow>> some_changes(const Database& database, LayoutId id, Revision after) {
  LEKALO_TRY(Statement rows,
             database.prepare(fmt::format("SELECT {} FROM change WHERE layout = ? AND revision > ? ORDER BY "
                                          "revision LIMIT 256",
                                          kChangeColumns)));
  rows.bind(1, id).bind(2, after);
  std::vector<ChangeRow> changes;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return changes;
    changes.push_back(change_row(rows));
  }
}

/// Adds an entry, and says of the one that it takes back or does again which of the two it is now.
void add_to_history(std::vector<HistoryEntry>& entries, HistoryEntry entry) {
  const bool takes_back = entry.kind == ChangeKind::undo, does_again = entry.kind == ChangeKind::redo;
  if ((takes_back || does_again) && entry.target >= 1 &&
      entry.target <= static_cast<Revision>(entries.size()))
    entries[static_cast<std::size_t>(entry.target - 1)].undone = takes_back;
  entries.push_back(std::move(entry));
}

}  // namespace

Result<std::vector<HistoryEntry>> Store::history(LayoutId id) {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(const Entry layout, entry_of(database_, id));
  LEKALO_TRY(std::string chain, chain_at(database_, id, 0));
  std::vector<HistoryEntry> entries;
  std::vector<std::vector<layout::ItemChange<layout::Part>>> shifts;
  for (bool more = true; more;) {
    // A history may be long, so it is read a piece at a time.
    LEKALO_TRY(std::vector<ChangeRow> rows,
               some_changes(database_, id, static_cast<Revision>(entries.size())));
    const Pause pause(turn);
    more = !rows.empty();
    for (ChangeRow& row : rows) {
      // Revisions begin at 1 and have no holes. A damaged number may be far off, and is not filled up to.
      const Revision next = static_cast<Revision>(entries.size()) + 1;
      const bool is_later = row.revision > layout.revision && layout.whole;
      more = !is_later && (row.revision == next || row.revision == next + 1);
      if (!more) break;
      if (row.revision == next + 1) {
        entries.push_back(missing_entry(next));
        chain.clear();
      }
      shifts.resize(entries.size() + 1);
      if (row.digest == change_digest(id, chain, row)) {
        shifts.back() = shifted_parts(row.change);
        add_to_history(entries, {row.revision, std::move(row.at), std::move(row.author), std::move(row.text),
                                 static_cast<ChangeKind>(row.kind), row.target, false, false,
                                 touched_parts(row.change)});
      } else {
        entries.push_back(missing_entry(row.revision));
      }
      chain = row.digest;
    }
  }
  if (layout.whole && static_cast<Revision>(entries.size()) < layout.revision) {
    LEKALO_CHECK(entry_of(database_, id));  // it may have been removed meanwhile
    entries.push_back(missing_entry(static_cast<Revision>(entries.size()) + 1));
  }
  shifts.resize(entries.size());
  name_touched_parts(entries, shifts);
  return entries;
}

}  // namespace lekalo::server
