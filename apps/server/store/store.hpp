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

/// After so many changes a layout is written whole again, so that opening reads at most so many of them.
inline constexpr Revision kSnapshotEvery = 256;
/// Format 1 had no changes of features and no photographs; it is taken over when it is opened.
inline constexpr std::int64_t kStoreFormat = 2;

enum class ChangeKind : std::uint8_t { command, undo, redo, restore };
[[nodiscard]] const char* name_of(ChangeKind kind) noexcept;

/// One revision: what was done, and what it changed, before and after.
struct StoredChange {
  Revision revision = 0;
  ChangeKind kind = ChangeKind::command;
  layout::Mode mode = layout::Mode::strict;
  Revision target = 0;  ///< undo, redo: the command's revision; restore: the state's
  std::string author;   ///< may be empty
  std::string text;     ///< the command
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
  bool undone = false;  ///< a command that is undone now
};

struct StoredLayout {
  std::string name;
  Revision revision = 0;
  layout::Document document;
};

/// A photograph of a stock, laid under it by two points: pixels count right and down from the upper left
/// corner.
struct PhotoScale {
  double pixels[4] = {};  ///< x, y of one point, x, y of the other
  double mm[4] = {};      ///< where they are on the stock
};
struct Photo {
  std::string stock;  ///< id
  std::string type;   ///< "image/png" or "image/jpeg"
  std::int64_t bytes = 0;
  PhotoScale scale;
};

/// The layouts of a server in one SQLite file: docs/design/server.md. Each function that changes something is
/// one transaction, on the disk when it returns (WAL, synchronous=FULL), and after a failure nothing of it
/// counts. Failures: ErrorCode::usage for layouts and revisions that are not there, ErrorCode::environment
/// for the disk. May be called from several threads; they take turns.
class Store {
 public:
  /// Opens the file, or makes it, readable by its owner alone. Fails with ErrorCode::environment for a file
  /// that cannot be read and written, is used by another server, is damaged, is another program's, or was
  /// written by a newer format.
  [[nodiscard]] static Result<Store> open(const std::string& path);

  [[nodiscard]] Result<LayoutId> create(const std::string& name, const layout::Document& document,
                                        const std::string& origin = {});
  /// The layout made from what `origin` says (a digest of a file), the newest of several.
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
  /// Oldest first, without the placements.
  [[nodiscard]] Result<std::vector<HistoryEntry>> history(LayoutId id);

  /// Photographs are no part of a layout's history; copies of it have them too.
  [[nodiscard]] Result<std::vector<Photo>> photos(LayoutId id);
  /// Fails with ErrorCode::usage where there is none.
  [[nodiscard]] Result<std::string> photo_image(LayoutId id, const std::string& stock);
  /// Adds or replaces it.
  [[nodiscard]] Result<void> set_photo(LayoutId id, const Photo& photo, const std::string& image);
  /// Fails with ErrorCode::usage where there is no photograph.
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
  /// Behind a pointer so that a store can be moved.
  std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();
};

/// A change as text: exact, a line for each placement before (-) and after (+) and each feature before (<)
/// and after (>). Not for people.
[[nodiscard]] std::string change_text(const layout::Change& change);
/// Fails with ErrorCode::environment for anything that change_text does not write.
[[nodiscard]] Result<layout::Change> change_from_text(std::string_view text);

}  // namespace lekalo::server
