#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/command.hpp"
#include "lekalo/layout/document.hpp"
#include "sqlite.hpp"

namespace lekalo::server {

using LayoutId = std::int64_t;
using Revision = std::int64_t;

/// After so many changes a layout is written whole again, so that opening it reads at most so many changes.
inline constexpr Revision kSnapshotEvery = 256;
/// The format that is written. Format 1 had no changes of features and no photographs; a store of that format
/// is converted when it is opened.
inline constexpr std::int64_t kStoreFormat = 2;

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
};

struct HistoryEntry {
  Revision revision = 0;
  std::string at;  ///< UTC, ISO 8601
  std::string author, text;
  ChangeKind kind = ChangeKind::command;
  Revision target = 0;
  /// True for a command that is undone now.
  bool undone = false;
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

/// The layouts of a server in one SQLite file: docs/design/server.md. Each function that changes something is
/// one transaction. It is on the disk when the function returns (WAL, synchronous=FULL), and after a failure
/// nothing of it counts. Functions fail with ErrorCode::usage for layouts and revisions that are not there,
/// and with ErrorCode::environment for the disk. They may be called from several threads, which take turns.
class Store {
 public:
  /// Opens the file, or makes one that its owner alone can read. Fails with ErrorCode::environment for a file
  /// that cannot be read and written, is used by another server, is damaged, is another program's, or was
  /// written by a newer format.
  [[nodiscard]] static Result<Store> open(const std::string& path);

  [[nodiscard]] Result<LayoutId> create(const std::string& name, const layout::Document& document,
                                        const std::string& origin = {});
  /// Finds the layout that was made from what `origin` says (a digest of a file), the newest if there are
  /// several.
  [[nodiscard]] Result<std::optional<LayoutId>> find_origin(const std::string& origin);
  [[nodiscard]] Result<std::vector<LayoutSummary>> list();
  [[nodiscard]] Result<StoredLayout> load(LayoutId id);
  [[nodiscard]] Result<layout::Document> state_at(LayoutId id, Revision revision);
  [[nodiscard]] Result<LayoutId> copy(LayoutId id, const std::string& name);
  [[nodiscard]] Result<void> rename(LayoutId id, const std::string& name);
  [[nodiscard]] Result<void> remove(LayoutId id);

  /// Adds the next revision. \param after  the document with the change carried out
  [[nodiscard]] Result<void> append(LayoutId id, const StoredChange& change, const layout::Document& after);
  [[nodiscard]] Result<StoredChange> change_at(LayoutId id, Revision revision);
  /// Returns the history, oldest entry first, without the placements.
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
  Store(std::string path, Database database) : path_(std::move(path)), database_(std::move(database)) {}
  [[nodiscard]] Result<void> prepare_file();
  [[nodiscard]] Result<StoredLayout> load_locked(LayoutId id, std::optional<Revision> revision);
  [[nodiscard]] Result<LayoutId> create_rows(const std::string& name, const layout::Document& document,
                                             const std::string& origin);
  [[nodiscard]] Result<void> one_row(LayoutId id, Result<void> done);

  std::string path_;
  Database database_;
  /// The mutex is behind a pointer so that a store can be moved.
  std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();
};

/// Returns a change as exact text, which is not for people: a line for each placement before (-) and after
/// (+) and each feature before (<) and after (>).
[[nodiscard]] std::string change_text(const layout::Change& change);
/// Reads such a text. Fails with ErrorCode::environment for anything that change_text does not write.
[[nodiscard]] Result<layout::Change> change_from_text(std::string_view text);

}  // namespace lekalo::server
