// Reads a layout from its snapshots and changes, as far as they are as they were written.

#include <fmt/core.h>

#include <optional>
#include <vector>

#include "lekalo/io/layout/layout_json.hpp"
#include "pause.hpp"
#include "rows.hpp"

namespace lekalo::server {
namespace {

/// Steps to the next row. Returns false where there is none, or none that can be read.
Result<bool> step_if_readable(Statement& rows) {
  Result<bool> row = rows.step();
  if (!row && tells_damaged_pages(row.error())) return false;
  return row;
}

struct SnapshotRow {
  Revision revision = 0;
  std::string document, digest;
  /// The digest of the change that led to the state; empty for the first state.
  std::string chain;
};

/// Reads the newest snapshot up to a revision; nothing where there is none.
Result<std::optional<SnapshotRow>> snapshot_up_to(const Database& database, LayoutId id, Revision newest) {
  LEKALO_TRY(Statement rows,
             database.prepare("SELECT revision, document, digest FROM snapshot WHERE layout = ? AND "
                              "revision <= ? ORDER BY revision DESC LIMIT 1"));
  rows.bind(1, id).bind(2, newest);
  LEKALO_TRY(const bool any, step_if_readable(rows));
  if (!any) return std::optional<SnapshotRow>();
  SnapshotRow row{rows.integer(0), rows.text(1), rows.text(2), {}};
  if (row.revision > 0) {
    const Result<std::string> before = chain_at(database, id, row.revision);
    if (!before && !tells_damaged_pages(before.error())) return tl::unexpected(before.error());
    row.chain = before.value_or("");
  }
  return std::optional(std::move(row));
}

Result<std::vector<ChangeRow>> changes_between(const Database& database, LayoutId id, Revision after,
                                               Revision last) {
  LEKALO_TRY(Statement rows,
             database.prepare(fmt::format("SELECT {} FROM change WHERE layout = ? AND revision > ? AND "
                                          "revision <= ? ORDER BY revision",
                                          kChangeColumns)));
  rows.bind(1, id).bind(2, after).bind(3, last);
  std::vector<ChangeRow> changes;
  for (;;) {
    LEKALO_TRY(const bool row, step_if_readable(rows));
    if (!row) return changes;
    changes.push_back(change_row(rows));
  }
}

/// Takes the state of a snapshot if it is whole.
bool take_snapshot(LayoutId id, const SnapshotRow& row, StoredLayout& layout) {
  if (row.digest != state_digest(id, row.revision, row.chain, row.document)) return false;
  Result<io::LayoutFile> file = io::read_layout(row.document, fmt::format("layout {} in the store", id));
  if (!file) return false;
  layout.revision = row.revision;
  layout.document = std::move(file->document);
  return true;
}

}  // namespace

Result<Store::Replay> Store::replay(LayoutId id, std::optional<Revision> revision,
                                    std::unique_lock<std::mutex>& turn) {
  LEKALO_TRY(const Entry entry, entry_of(database_, id));
  Revision newest = entry.revision;
  if (!entry.whole) {
    LEKALO_TRY(Statement last,
               database_.prepare("SELECT coalesce(max(revision), 0) FROM change WHERE layout = ?"));
    LEKALO_TRY(const bool known, step_if_readable(last.bind(1, id)));
    if (known) newest = last.integer(0);
  }
  if (revision && (*revision < 0 || *revision > newest))
    return failure(ErrorCode::usage,
                   fmt::format("there is no revision {}; the layout has 0 to {}", *revision, newest));
  Replay replay;
  replay.layout.name = entry.name;
  const Revision wanted = revision.value_or(newest);
  std::string chain;
  std::vector<ChangeRow> changes;
  for (Revision up_to = wanted; !replay.any;) {
    LEKALO_TRY(const std::optional<SnapshotRow> snapshot, snapshot_up_to(database_, id, up_to));
    if (!snapshot) {
      replay.problem =
          fmt::format("no state of layout {} up to revision {} is as it was written", id, wanted);
      return replay;
    }
    LEKALO_TRY(changes, changes_between(database_, id, snapshot->revision, wanted));
    const Pause pause(turn);
    replay.any = take_snapshot(id, *snapshot, replay.layout);
    chain = snapshot->revision == 0 ? snapshot->digest : snapshot->chain;
    up_to = snapshot->revision - 1;
  }
  std::optional<Pause> pause(turn);
  for (auto change = changes.begin(); replay.layout.revision < wanted; ++change) {
    const Revision next = replay.layout.revision + 1;
    const bool whole = change != changes.end() && change->revision == next &&
                       change->digest == change_digest(id, chain, *change);
    const Result<layout::Change> what = whole ? change_from_text(change->change) : layout::Change{};
    const bool fits = whole && what && carry_out_if_it_fits(*what, replay.layout.document);
    if (!fits) {
      pause.reset();
      // A change that does not fit may have been carried out in part.
      if (whole) {
        LEKALO_TRY(replay, this->replay(id, next - 1, turn));
      }
      replay.problem = fmt::format("revision {} of layout {} is missing or not as it was written", next, id);
      return replay;
    }
    replay.layout.revision = next;
    chain = change->digest;
  }
  if (!entry.whole && !revision)
    replay.problem = fmt::format(
        "the entry of layout {} (its name, or how many revisions it has) is not as it "
        "was written",
        id);
  return replay;
}

Result<StoredLayout> Store::load_in_turn(LayoutId id, std::optional<Revision> revision,
                                         std::unique_lock<std::mutex>& turn) {
  LEKALO_TRY(Replay read, replay(id, revision, turn));
  if (read.problem.empty()) return std::move(read.layout);
  if (!read.any) return damaged(read.problem + "; put a backup in its place: lekalo store restore");
  return damaged(
      fmt::format("{0}; its state at revision {1} is whole and can be opened as a new layout: POST "
                  "/api/layouts/{2}/copy?name=NAME&revision={1}",
                  read.problem, read.layout.revision, id));
}

Result<StoredLayout> Store::load(LayoutId id) {
  std::unique_lock turn(*turn_);
  return load_in_turn(id, std::nullopt, turn);
}

Result<StoredLayout> Store::newest_whole(LayoutId id) {
  std::unique_lock turn(*turn_);
  LEKALO_TRY(Replay read, replay(id, std::nullopt, turn));
  if (!read.any) return damaged(read.problem);
  return std::move(read.layout);
}

Result<layout::Document> Store::state_at(LayoutId id, Revision revision) {
  std::unique_lock turn(*turn_);
  return load_in_turn(id, revision, turn).map([](StoredLayout&& layout) {
    return std::move(layout.document);
  });
}

}  // namespace lekalo::server
