// Checks a store as a whole, and copies it.

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "lekalo/io/layout/layout_json.hpp"
#include "rows.hpp"

namespace lekalo::server {

Result<StoreCheck> Store::check() {
  std::unique_lock turn(*turn_);
  StoreCheck check;
  check.damage = notices_;
  check.put_back = put_back_;
  LEKALO_TRY(Statement rows, database_.prepare("PRAGMA integrity_check(20)"));
  for (;;) {
    LEKALO_TRY(const bool more, rows.step());
    if (!more) break;
    if (rows.text(0) == "ok") continue;
    check.readable = false;
    const std::string said = rows.text(0);
    check.damage.push_back("the file is damaged: " + said.substr(said.rfind('\n') + 1));
  }
  LEKALO_TRY(const std::vector<Entry> entries, all_entries(database_));
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    ++check.layouts;
    for (const Result<void>& read : {check_layout(entry->id, check, turn), check_photos(entry->id, check)})
      if (!read) check.damage.push_back(fmt::format("layout {}: {}", entry->id, read.error().message));
  }
  return check;
}

Result<void> Store::check_layout(LayoutId id, StoreCheck& check, std::unique_lock<std::mutex>& turn) {
  // Loading begins at the newest whole snapshot; a check reads all of them.
  LEKALO_TRY(Replay newest, replay(id, std::nullopt, turn));
  if (!newest.problem.empty()) {
    const Result<StoredLayout> told = load_in_turn(id, std::nullopt, turn);
    if (!told) check.damage.push_back(told.error().message);
  }
  LEKALO_TRY(Statement snapshots,
             database_.prepare("SELECT revision, document, digest FROM snapshot WHERE layout = ? ORDER BY "
                               "revision"));
  snapshots.bind(1, id);
  Revision snapshot = -1;
  for (;;) {
    LEKALO_TRY(const bool more, snapshots.step());
    if (!more) break;
    snapshot = snapshots.integer(0);
    std::string chain;
    if (snapshot > 0) {
      LEKALO_TRY(chain, chain_at(database_, id, snapshot));
    }
    if (snapshots.text(2) != state_digest(id, snapshot, chain, snapshots.text(1)))
      check.damage.push_back(fmt::format(
          "layout {}: the state that was written at revision {} is not as it was written", id, snapshot));
  }
  LEKALO_TRY(std::string chain, chain_at(database_, id, 0));
  LEKALO_TRY(Statement changes,
             database_.prepare(
                 fmt::format("SELECT {} FROM change WHERE layout = ? ORDER BY revision", kChangeColumns)));
  changes.bind(1, id);
  for (Revision next = 1;; ++next) {
    LEKALO_TRY(const bool more, changes.step());
    if (!more) break;
    const ChangeRow row = change_row(changes);
    ++check.revisions;
    if (row.revision != next || row.digest != change_digest(id, chain, row) || !change_from_text(row.change))
      check.damage.push_back(
          fmt::format("layout {}: revision {} is missing or not as it was written", id, next));
    next = row.revision;
    chain = row.digest;
  }
  return {};
}

Result<void> Store::write_copy(const std::string& path) {
  const auto trouble = [&] {
    return failure(ErrorCode::environment, fmt::format("{}: {}", path, std::strerror(errno)));
  };
  const std::string temporary = path + ".lekalo-new";
  // A copy that was interrupted may have left a file; a link that somebody put there would name another.
  ::unlink(temporary.c_str());
  const int file = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return trouble();
  const auto copied = [&]() -> Result<void> {
    LEKALO_TRY(const Database copy, Database::open(temporary));
    LEKALO_CHECK(database_.copy_to(copy));
    // The copy is one file and may be read where it cannot be written.
    return copy.run("PRAGMA journal_mode=DELETE");
  };
  Result<void> done = copied();
  if (done && (::fsync(file) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0)) done = trouble();
  ::close(file);
  if (!done) {
    ::unlink(temporary.c_str());
    return done;
  }
  flush_folder_of(path);
  return {};
}

}  // namespace lekalo::server
