#include "rows.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "digest.hpp"

namespace lekalo::server {
namespace {

constexpr const char* kEntries =
    "SELECT id, name, origin, revision, placements, changed, change_number, digest FROM layout";

Result<Entry> read_entry(const Database& database, const Statement& row) {
  Entry entry{row.integer(0), row.text(1),    row.text(2),   row.integer(3), row.integer(4),
              row.text(5),    row.integer(6), std::string(), false};
  const Result<std::string> chain = chain_at(database, entry.id, entry.revision);
  if (!chain && !tells_damaged_pages(chain.error())) return tl::unexpected(chain.error());
  entry.chain = chain.value_or("");
  entry.whole = !entry.chain.empty() && row.text(7) == entry_digest(entry);
  return entry;
}

bool same_placement(const layout::Document& document, const layout::PlacementChange& one) {
  const std::uint64_t id = one.after ? one.after->id : one.before->id;
  const auto at =
      std::lower_bound(document.placements.begin(), document.placements.end(), id,
                       [](const layout::Placement& p, std::uint64_t wanted) { return p.id < wanted; });
  const bool there = at != document.placements.end() && at->id == id;
  return one.before ? there && *at == *one.before : !there;
}

bool same_feature(const layout::Document& document, const layout::FeatureChange& one) {
  const layout::Stock& stock = document.stocks[one.stock];
  const auto at = find_feature(stock, one.either().kind, one.either().id);
  return one.before ? at && feature_at(stock, one.either().kind, *at) == *one.before : !at;
}

}  // namespace

ChangeRow change_row(const Statement& row) {
  return {row.integer(0), row.text(1), row.text(2), row.integer(3), row.integer(4),
          row.integer(5), row.text(6), row.text(7), row.text(8)};
}

std::string entry_digest(const Entry& e) {
  return Digest("layout")
      .add(e.id)
      .add(e.name)
      .add(e.origin)
      .add(e.revision)
      .add(e.placements)
      .add(e.changed)
      .add(e.change_number)
      .add(e.chain)
      .text();
}

std::string change_digest(LayoutId id, const std::string& before, const ChangeRow& c) {
  return Digest("change")
      .add(before)
      .add(id)
      .add(c.revision)
      .add(c.at)
      .add(c.author)
      .add(c.kind)
      .add(c.mode)
      .add(c.target)
      .add(c.text)
      .add(c.change)
      .text();
}

std::string state_digest(LayoutId id, Revision revision, const std::string& chain,
                         const std::string& document) {
  return Digest("state").add(id).add(revision).add(chain).add(document).text();
}

std::string photo_digest(LayoutId id, const std::string& stock, const std::string& type,
                         const std::string& scale, const std::string& image_sha256) {
  return Digest("photo").add(id).add(stock).add(type).add(scale).add(image_sha256).text();
}

Result<std::string> chain_at(const Database& database, LayoutId id, Revision revision) {
  const char* const query = revision == 0 ? "SELECT digest FROM snapshot WHERE layout = ? AND revision = ?"
                                          : "SELECT digest FROM change WHERE layout = ? AND revision = ?";
  LEKALO_TRY(Statement row, database.prepare(query));
  LEKALO_TRY(const bool found, row.bind(1, id).bind(2, revision).step());
  return found ? row.text(0) : std::string();
}

Result<Entry> entry_of(const Database& database, LayoutId id) {
  LEKALO_TRY(Statement row, database.prepare(fmt::format("{} WHERE id = ?", kEntries)));
  LEKALO_TRY(const bool found, row.bind(1, id).step());
  if (!found) return no_layout(id);
  return read_entry(database, row);
}

Result<std::vector<Entry>> all_entries(const Database& database) {
  LEKALO_TRY(Statement rows,
             database.prepare(fmt::format("{} ORDER BY change_number DESC, id DESC", kEntries)));
  std::vector<Entry> entries;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return entries;
    LEKALO_TRY(Entry entry, read_entry(database, rows));
    entries.push_back(std::move(entry));
  }
}

Result<void> add_entry(const Database& database, const Entry& e) {
  LEKALO_TRY(Statement row, database.prepare("INSERT INTO layout VALUES (?, ?, ?, ?, ?, ?, ?, ?)"));
  return row.bind(1, e.id)
      .bind(2, e.name)
      .bind(3, e.origin)
      .bind(4, e.revision)
      .bind(5, e.placements)
      .bind(6, e.changed)
      .bind(7, e.change_number)
      .bind(8, entry_digest(e))
      .run();
}

Result<void> change_entry(const Database& database, const Entry& e) {
  LEKALO_TRY(
      Statement row,
      database.prepare("UPDATE layout SET name = ?, origin = ?, revision = ?, placements = ?, changed = "
                       "?, change_number = ?, digest = ? WHERE id = ?"));
  return row.bind(1, e.name)
      .bind(2, e.origin)
      .bind(3, e.revision)
      .bind(4, e.placements)
      .bind(5, e.changed)
      .bind(6, e.change_number)
      .bind(7, entry_digest(e))
      .bind(8, e.id)
      .run();
}

Result<void> add_change(const Database& database, LayoutId id, const ChangeRow& c) {
  LEKALO_TRY(Statement row, database.prepare("INSERT INTO change VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  return row.bind(1, id)
      .bind(2, c.revision)
      .bind(3, c.at)
      .bind(4, c.author)
      .bind(5, c.kind)
      .bind(6, c.mode)
      .bind(7, c.target)
      .bind(8, c.text)
      .bind(9, c.change)
      .bind(10, c.digest)
      .run();
}

Result<void> add_snapshot(const Database& database, LayoutId id, Revision revision,
                          const std::string& document, const std::string& digest) {
  LEKALO_TRY(Statement row, database.prepare("INSERT INTO snapshot VALUES (?, ?, ?, ?)"));
  return row.bind(1, id).bind(2, revision).bind(3, document).bind(4, digest).run();
}

Result<std::string> time_now(const Database& database) {
  LEKALO_TRY(Statement row, database.prepare("SELECT strftime('%Y-%m-%dT%H:%M:%fZ', 'now')"));
  LEKALO_CHECK(row.step());
  return row.text(0);
}

tl::unexpected<Error> no_layout(LayoutId id) {
  return failure(ErrorCode::usage, fmt::format("there is no layout {}", id));
}

tl::unexpected<Error> damaged(const std::string& what) {
  return failure(ErrorCode::environment, "the store is damaged: " + what);
}

bool carry_out_if_it_fits(const layout::Change& change, layout::Document& document) {
  if (change.next_id_before != document.next_id || !can_bring_in(document, change.job)) return false;
  bring_in(document, change.job);
  for (const layout::PlacementChange& one : change.placements) {
    if (!same_placement(document, one)) return false;
    if (one.after && (one.after->part >= document.parts.size() || one.after->stock >= document.stocks.size()))
      return false;
  }
  layout::Change placements = change;
  placements.features.clear();
  placements.job = {};
  layout::carry_out(document, placements);
  // One feature may be changed twice, so each has to fit what the one before it left.
  for (const layout::FeatureChange& one : change.features) {
    if (one.stock >= document.stocks.size() || !same_feature(document, one)) return false;
    layout::Change single;
    single.next_id_after = change.next_id_after;
    single.features.push_back(one);
    layout::carry_out(document, single);
  }
  if (!can_take_out(document, change.job)) return false;
  take_out(document, change.job);
  return true;
}

}  // namespace lekalo::server
