#include "convert.hpp"

#include <fmt/core.h>

#include <optional>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "rows.hpp"

namespace lekalo::server {
namespace {

/// Draws an outline again where all of its points but one are those that its curves give. An outline of
/// another program's chords differs in more.
bool draw_again(layout::Outline& outline, geom::ChordSide side) {
  if (outline.curves.empty()) return false;
  const auto drawn = geom::grid_region_of_curves(outline.curves.front(), side, outline.chord_tolerance_mm,
                                                 io::kMostOutlinePoints);
  if (!drawn || drawn->points.size() != outline.polygon.points.size()) return false;
  std::size_t off = 0;
  for (std::size_t i = 0; i < drawn->points.size(); ++i)
    if (!(drawn->points[i] == outline.polygon.points[i])) ++off;
  if (off != 1) return false;
  outline.polygon = *drawn;
  return true;
}

/// Returns whose outlines were drawn again; empty where none was.
std::string draw_outlines_again(layout::Document& document) {
  std::string whose;
  const auto tell = [&](const std::string& who) { whose += (whose.empty() ? "" : ", ") + who; };
  for (layout::Part& part : document.parts) {
    bool off = draw_again(part.outline, geom::ChordSide::grow);
    for (layout::PartArea& area : part.areas) off = draw_again(area.outline, geom::ChordSide::grow) || off;
    if (off) tell(fmt::format("part '{}'", part.id));
  }
  for (layout::Stock& stock : document.stocks) {
    bool off = draw_again(stock.outline, geom::ChordSide::shrink);
    for (auto& defect : stock.defects) off = draw_again(defect.outline, geom::ChordSide::grow) || off;
    for (auto& zone : stock.zones) off = draw_again(zone.outline, geom::ChordSide::grow) || off;
    if (off) tell(fmt::format("stock '{}'", stock.id));
  }
  return whose;
}

/// The rows of one old layout, taken in the order of their revisions.
class OldLayout {
 public:
  OldLayout(const Database& database, LayoutId id) : database_(database), id_(id) {}

  Result<void> take_snapshot(Revision revision, const std::string& text) {
    Result<io::LayoutFile> file = io::read_layout(text, "snapshot");
    bool whole = file.has_value();
    if (whole && state_) whole = file->document == *state_;
    if (whole && !state_) {
      state_ = std::move(file->document);
      drawn_again_ = draw_outlines_again(*state_);
      whole = drawn_again_.empty();
    }
    const std::string digest =
        whole ? state_digest(id_, revision, revision == 0 ? "" : chain_, text) : std::string();
    if (revision == 0) chain_ = digest;
    return add_snapshot(database_, id_, revision, text, digest);
  }

  Result<void> take_change(ChangeRow row) {
    const Result<layout::Change> change = change_from_text(row.change);
    const bool follows = row.revision == last_ + 1;
    last_ = row.revision;
    if (state_ && !(follows && change && carry_out_if_it_fits(*change, *state_))) {
      state_.reset();
      row.digest.clear();
    } else {
      row.digest = change_digest(id_, chain_, row);
    }
    chain_ = row.digest;
    return add_change(database_, id_, row);
  }

  [[nodiscard]] const std::string& chain() const { return chain_; }
  /// Whose outlines were drawn again in the state(), if any were.
  [[nodiscard]] const std::string& drawn_again() const { return drawn_again_; }
  [[nodiscard]] const std::optional<layout::Document>& state() const { return state_; }

 private:
  const Database& database_;
  LayoutId id_;
  Revision last_ = 0;
  std::string chain_, drawn_again_;
  /// None before the first snapshot, and between damage and the next snapshot.
  std::optional<layout::Document> state_;
};

Result<void> take_rows(const Database& database, LayoutId id, OldLayout& old) {
  LEKALO_TRY(Statement snapshots, database.prepare("SELECT revision, document FROM old_snapshot WHERE layout "
                                                   "= ? ORDER BY revision"));
  LEKALO_TRY(Statement changes,
             database.prepare("SELECT revision, at, author, kind, mode, target, text, placements, '' FROM "
                              "old_change WHERE layout = ? ORDER BY revision"));
  LEKALO_TRY(bool snapshot, snapshots.bind(1, id).step());
  LEKALO_TRY(bool change, changes.bind(1, id).step());
  while (snapshot || change) {
    // A snapshot comes after the change that led to it.
    if (change && (!snapshot || changes.integer(0) <= snapshots.integer(0))) {
      LEKALO_CHECK(old.take_change(change_row(changes)));
      LEKALO_TRY(change, changes.step());
    } else {
      LEKALO_CHECK(old.take_snapshot(snapshots.integer(0), snapshots.text(1)));
      LEKALO_TRY(snapshot, snapshots.step());
    }
  }
  return {};
}

/// A layout beside a damaged one.
struct PutBack {
  Entry damaged;
  std::string whose;
  layout::Document document;
};

Result<void> add_put_back(const Database& database, const PutBack& one, bool is_kept,
                          std::vector<std::string>& notices) {
  Entry entry = one.damaged;
  entry.name += " (put back)";
  entry.origin.clear();
  entry.revision = 0;
  LEKALO_TRY(const std::int64_t last, database.number("SELECT max(id) FROM layout"));
  LEKALO_TRY(const std::int64_t number, database.number("SELECT max(change_number) FROM layout"));
  entry.id = last + 1;
  entry.change_number = number + 1;
  const std::string text = io::write_layout(one.document);
  entry.chain = state_digest(entry.id, 0, "", text);
  LEKALO_CHECK(add_entry(database, entry));
  notices.push_back(fmt::format(
      "the store is damaged: in layout {} '{}' a point of the outline of {} is not where its curves say. The "
      "newest state with the outline drawn again from its curves {} layout {} '{}'{}",
      one.damaged.id, one.damaged.name, one.whose, is_kept ? "is" : "becomes", entry.id, entry.name,
      is_kept ? "" : " by lekalo serve, or by lekalo store restore"));
  return add_snapshot(database, entry.id, 0, text, entry.chain);
}

Result<void> convert_photos(const Database& database) {
  LEKALO_TRY(Statement rows, database.prepare("SELECT layout, stock, type, scale, image FROM old_photo"));
  LEKALO_TRY(Statement row, database.prepare("INSERT INTO photo VALUES (?, ?, ?, ?, ?, ?, ?)"));
  for (;;) {
    LEKALO_TRY(const bool more, rows.step());
    if (!more) return {};
    const std::string stock = rows.text(1), type = rows.text(2), scale = rows.text(3), image = rows.bytes(4);
    const std::string sha256 = io::sha256(image);
    row.bind(1, rows.integer(0)).bind(2, stock).bind(3, type).bind(4, scale).bind_bytes(5, image);
    row.bind(6, sha256).bind(7, photo_digest(rows.integer(0), stock, type, scale, sha256));
    LEKALO_CHECK(row.run());
  }
}

}  // namespace

Result<void> set_old_tables_aside(const Database& database, std::int64_t format) {
  for (const char* rename :
       {"ALTER TABLE layout RENAME TO old_layout", "ALTER TABLE snapshot RENAME TO old_snapshot",
        "ALTER TABLE change RENAME TO old_change"})
    LEKALO_CHECK(database.run(rename));
  return database.run(format == 1 ? "CREATE TABLE old_photo (layout, stock, type, scale, image)"
                                  : "ALTER TABLE photo RENAME TO old_photo");
}

Result<std::int64_t> convert_tables(const Database& database, bool is_kept,
                                    std::vector<std::string>& notices) {
  std::vector<PutBack> put_back;
  LEKALO_TRY(Statement rows, database.prepare("SELECT id, name, origin, revision, placements, changed, "
                                              "change_number FROM old_layout ORDER BY id"));
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) break;
    Entry entry{rows.integer(0), rows.text(1),  rows.text(2), rows.integer(3), rows.integer(4), rows.text(5),
                rows.integer(6), std::string(), false};
    LEKALO_CHECK(add_entry(database, entry));
    OldLayout old(database, entry.id);
    LEKALO_CHECK(take_rows(database, entry.id, old));
    entry.chain = old.chain();
    LEKALO_CHECK(change_entry(database, entry));
    if (!old.drawn_again().empty() && old.state())
      put_back.push_back({entry, old.drawn_again(), *old.state()});
  }
  rows.reset();
  LEKALO_CHECK(convert_photos(database));
  for (const PutBack& one : put_back) LEKALO_CHECK(add_put_back(database, one, is_kept, notices));
  // An id that was given is not given again.
  LEKALO_CHECK(database.run(
      "UPDATE sqlite_sequence SET seq = max(seq, (SELECT seq FROM sqlite_sequence WHERE name = "
      "'old_layout')) "
      "WHERE name = 'layout' AND EXISTS (SELECT 1 FROM sqlite_sequence WHERE name = 'old_layout');"
      "INSERT INTO sqlite_sequence SELECT 'layout', seq FROM sqlite_sequence WHERE name = 'old_layout' AND "
      "NOT "
      "EXISTS (SELECT 1 FROM sqlite_sequence WHERE name = 'layout');"
      "DROP TABLE old_photo; DROP TABLE old_change; DROP TABLE old_snapshot; DROP TABLE old_layout"));
  return static_cast<std::int64_t>(put_back.size());
}

}  // namespace lekalo::server
