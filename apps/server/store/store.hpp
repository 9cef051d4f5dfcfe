#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/command.hpp"
#include "lekalo/layout/document.hpp"
#include "outside_revision.hpp"
#include "sqlite.hpp"

namespace lekalo::server {

using LayoutId = std::int64_t;
using Revision = std::int64_t;

/// After so many changes a layout is written whole again, so that opening it reads at most so many changes.
inline constexpr Revision kSnapshotEvery = 256;
/// The format that is written. Formats 1 (without photographs) and 2 had no digests; a store of those formats
/// is brought forward when it is opened, after a copy beside it (PATH.format-2). Format 3 had no changes of
/// parts, stocks and rules, format 4 none of kits and of the kerf; else they are this one.
inline constexpr std::int64_t kStoreFormat = 5;
/// This much is kept free beside a store (PATH-reserve), so that layouts can be removed from a full disk.
inline constexpr std::int64_t kReserveBytes = std::int64_t{4} << 20;

enum class ChangeKind : std::uint8_t { command, undo, redo, restore };
[[nodiscard]] const char* name_of(ChangeKind kind) noexcept;

/// One revision: what was done, and what it changed, before and after.
struct StoredChange {
  Revision revision = 0;
  ChangeKind kind = ChangeKind::command;
  layout::Mode mode = layout::Mode::strict;
  /// For undo and redo the command's revision, for restore that of the state.
  Revision target = 0;
  std::string author;  ///< may be empty
  std::string text;    ///< the command as the history shows it
  layout::Change change;
};

struct LayoutSummary {
  LayoutId id = 0;
  std::string name;
  Revision revision = 0;
  std::int64_t placements = 0;
  std::string changed;  ///< UTC, ISO 8601
  /// True where this summary is not as it was written; load() says more.
  bool damaged = false;
};

/// How many placements of one part a change put in, changed and took away, and the first of them.
struct TouchedPart {
  /// Its index in the document as it is now; in a change alone, as that change numbers parts.
  std::uint32_t part = 0;
  std::uint64_t first = 0;
  std::int64_t placed = 0, changed = 0, removed = 0;
  std::string gone = {};  ///< the id of a part that is not in the document any more, which has no index
};

struct HistoryEntry {
  Revision revision = 0;
  std::string at;  ///< UTC, ISO 8601
  std::string author, text;
  ChangeKind kind = ChangeKind::command;
  Revision target = 0;
  /// True for a command that is undone now.
  bool undone = false;
  /// True for a change that is missing or not as it was written. Nothing else of it is known then.
  bool damaged = false;
  /// The parts whose placements it changed, ascending by index.
  std::vector<TouchedPart> parts = {};
};

struct StoredLayout {
  std::string name;
  Revision revision = 0;
  layout::Document document;
};

/// A photograph of a stock is laid under it by two points. Pixels count right and down from the upper left
/// corner.
struct PhotoScale {
  double pixels[4] = {};  ///< x, y of one point, x, y of the other
  double mm[4] = {};      ///< the places of these points on the stock
};
struct Photo {
  std::string stock;  ///< the stock's id
  std::string type;   ///< "image/png" or "image/jpeg"
  std::int64_t bytes = 0;
  PhotoScale scale;
};

enum class StoreUse : std::uint8_t {
  serve,   ///< the store is brought forward where it is old, and its revision is kept outside it
  inspect  ///< nothing of the store or beside it is changed
};

/// The findings of a check of everything in a store.
struct StoreCheck {
  std::int64_t layouts = 0, revisions = 0, photos = 0;
  /// So many of these layouts are not in the file: whoever brings it forward adds them beside damaged ones.
  std::int64_t put_back = 0;
  std::vector<std::string> damage;  ///< sentences
  /// False where the file itself is damaged, so that a copy of its pages would be too.
  bool readable = true;
};

/// The layouts of a server in one SQLite file: docs/design/server.md. Each function that changes something is
/// one transaction. It is on the disk when the function returns (WAL, synchronous=FULL), and after a failure
/// nothing of it counts. Functions fail with ErrorCode::usage for layouts and revisions that are not there,
/// and with ErrorCode::environment for the disk and for damage: what a row says is given back only where it
/// fits its digest, and the sentence about damage names the newest state that is whole. They may be called
/// from several threads, which take turns.
class Store {
 public:
  /// Opens the file. To serve, one that is not there is made, and its owner alone can read it. Fails with
  /// ErrorCode::environment for a file that cannot be read and written, is used by another server, is damaged
  /// as a whole, is another program's, was written by a newer format, or holds less than was acknowledged;
  /// with ErrorCode::bad_input for a file to inspect that is not there.
  [[nodiscard]] static Result<Store> open(const std::string& path, StoreUse use = StoreUse::serve);
  /// Returns sentences about what was found at opening: damage, and what was brought forward.
  [[nodiscard]] const std::vector<std::string>& notices() const noexcept { return notices_; }

  /// Reads everything and holds it against its digests. Cost: O(bytes of the store), and that of carrying out
  /// every change.
  [[nodiscard]] Result<StoreCheck> check();
  /// Writes the store into a new file, complete without a log. Fails with ErrorCode::environment.
  [[nodiscard]] Result<void> write_copy(const std::string& path);

  [[nodiscard]] Result<LayoutId> create(const std::string& name, const layout::Document& document,
                                        const std::string& origin = {});
  /// Finds the layout that was made from what `origin` says (a digest of a file), the newest if there are
  /// several.
  [[nodiscard]] Result<std::optional<LayoutId>> find_origin(const std::string& origin);
  [[nodiscard]] Result<std::vector<LayoutSummary>> list();
  [[nodiscard]] Result<StoredLayout> load(LayoutId id);
  /// Returns the newest state that is as it was written. Fails with ErrorCode::environment where none is.
  [[nodiscard]] Result<StoredLayout> newest_whole(LayoutId id);
  [[nodiscard]] Result<layout::Document> state_at(LayoutId id, Revision revision);
  /// Makes a layout of the newest state of another one, or of that of a revision.
  [[nodiscard]] Result<LayoutId> copy(LayoutId id, const std::string& name,
                                      std::optional<Revision> revision = std::nullopt);
  [[nodiscard]] Result<void> rename(LayoutId id, const std::string& name);
  /// Removes a layout, damaged or not, and gives its room on the disk back. It works on a full disk too, as
  /// long as the reserve is there.
  [[nodiscard]] Result<void> remove(LayoutId id);

  /// Adds the next revision. \param after  the document with the change carried out
  [[nodiscard]] Result<void> append(LayoutId id, const StoredChange& change, const layout::Document& after);
  [[nodiscard]] Result<StoredChange> change_at(LayoutId id, Revision revision);
  /// Says whether parts or stocks were changed after a revision, so that its changes may number them
  /// otherwise.
  [[nodiscard]] Result<bool> job_changed_since(LayoutId id, Revision revision);
  /// Returns the history, oldest entry first, with the counts of the placements.
  [[nodiscard]] Result<std::vector<HistoryEntry>> history(LayoutId id);

  /// Returns the photographs. They are no part of a layout's history, but copies of the layout have them too.
  [[nodiscard]] Result<std::vector<Photo>> photos(LayoutId id);
  /// Returns the bytes of a photograph. Fails with ErrorCode::usage where there is none.
  [[nodiscard]] Result<std::string> photo_image(LayoutId id, const std::string& stock);
  /// Adds or replaces a photograph.
  [[nodiscard]] Result<void> set_photo(LayoutId id, const Photo& photo, const std::string& image);
  /// These two fail with ErrorCode::usage where there is no photograph.
  [[nodiscard]] Result<void> set_photo_scale(LayoutId id, const std::string& stock, const PhotoScale& scale);
  [[nodiscard]] Result<void> remove_photo(LayoutId id, const std::string& stock);

 private:
  /// A layout carried as far as it is whole.
  struct Replay {
    StoredLayout layout;
    bool any = false;     ///< false where no state is whole; the document is empty then
    std::string problem;  ///< why it did not come to the revision that was wanted; empty where it did
  };

  Store(std::string path, StoreUse use, Database database)
      : path_(std::move(path)), use_(use), database_(std::move(database)) {}
  [[nodiscard]] Result<void> prepare_file();
  [[nodiscard]] Result<void> bring_forward(std::int64_t format);
  [[nodiscard]] Result<void> check_schema() const;
  [[nodiscard]] Result<void> check_revision();
  [[nodiscard]] Result<void> note_damage();
  /// Runs the work as one transaction, and keeps its number outside when it is on the disk.
  [[nodiscard]] Result<void> change(const std::function<Result<void>()>& work);
  /// These two let others have their turn while they look at what they have read.
  [[nodiscard]] Result<Replay> replay(LayoutId id, std::optional<Revision> revision,
                                      std::unique_lock<std::mutex>& turn);
  [[nodiscard]] Result<StoredLayout> load_in_turn(LayoutId id, std::optional<Revision> revision,
                                                  std::unique_lock<std::mutex>& turn);
  /// \param text  the document as it is stored
  [[nodiscard]] Result<LayoutId> create_rows(const std::string& name, const layout::Document& document,
                                             const std::string& text, const std::string& origin);
  [[nodiscard]] Result<void> copy_photos(LayoutId from, LayoutId to);
  [[nodiscard]] Result<void> check_layout(LayoutId id, StoreCheck& check, std::unique_lock<std::mutex>& turn);
  [[nodiscard]] Result<void> check_photos(LayoutId id, StoreCheck& check) const;
  void make_reserve() const;

  std::string path_;
  StoreUse use_;
  Database database_;
  OutsideRevision outside_;
  OutsideRevision::Kept kept_;
  std::vector<std::string> notices_;
  std::int64_t put_back_ = 0;  ///< layouts that an inspected file does not have, as StoreCheck says
  /// The mutex is behind a pointer so that a store can be moved.
  std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();
};

/// Returns a change as exact text, which is not for people: a line for each placement before (-) and after
/// (+), each feature before (<) and after (>), each part (p, P), each stock (s, S), and one for the rules
/// (r).
[[nodiscard]] std::string change_text(const layout::Change& change);
/// Reads such a text. Fails with ErrorCode::environment for anything that change_text does not write.
[[nodiscard]] Result<layout::Change> change_from_text(std::string_view text);
/// Counts what such a text does to the placements of each part. It passes over features, whose outlines are
/// long. \pre change_text has written it
[[nodiscard]] std::vector<TouchedPart> touched_parts(std::string_view text);

/// Returns the parts that come or go in such a text, without those that become others. \pre change_text has
/// written it
[[nodiscard]] std::vector<layout::ItemChange<layout::Part>> shifted_parts(std::string_view text);
/// Gives what was touched the numbers and names that parts have now.
/// \param shifts  what came and went with each of the entries
void name_touched_parts(std::vector<HistoryEntry>& entries,
                        const std::vector<std::vector<layout::ItemChange<layout::Part>>>& shifts);

}  // namespace lekalo::server
