#include "store_command.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <system_error>

#include "outputs.hpp"
#include "server/store/store.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;
using server::Store;
using server::StoreCheck;
using server::StoreUse;

constexpr int kWhole = 0, kDamaged = 1;

std::string counts(const StoreCheck& check) {
  return fmt::format("{} {}, {} {}, {} {}", check.layouts, check.layouts == 1 ? "layout" : "layouts",
                     check.revisions, check.revisions == 1 ? "change" : "changes", check.photos,
                     check.photos == 1 ? "photograph" : "photographs");
}

void tell_damage(const std::string& file, const StoreCheck& check) {
  for (const std::string& one : check.damage) tell(fmt::format("{}: {}\n", file, one));
}

Result<int> check_store(const StoreOptions& o) {
  LEKALO_TRY(Store store, Store::open(o.file, StoreUse::inspect));
  LEKALO_TRY(const StoreCheck check, store.check());
  tell_damage(o.file, check);
  std::string found =
      check.damage.empty() ? "everything is as it was written" : fmt::format("{} found", check.damage.size());
  if (check.put_back > 0) found += fmt::format(", {} can be put back", check.put_back);
  StoreCheck in_file = check;
  in_file.layouts -= check.put_back;
  LEKALO_CHECK(print(fmt::format("{}: {}; {}\n", o.file, counts(in_file), found)));
  return check.damage.empty() ? kWhole : kDamaged;
}

Result<int> back_up(const StoreOptions& o) {
  LEKALO_CHECK(check_outputs({{"-o", o.output}}, {{"the store", o.file}}));
  LEKALO_TRY(Store store, Store::open(o.file, StoreUse::inspect));
  LEKALO_TRY(const StoreCheck check, store.check());
  tell_damage(o.file, check);
  if (!check.damage.empty()) {
    tell(fmt::format("{}: not written; a copy of damage would take the place of a good one\n", o.output));
    return kDamaged;
  }
  LEKALO_CHECK(store.write_copy(o.output));
  LEKALO_CHECK(print(fmt::format("{}: {}\n", o.output, counts(check))));
  return kWhole;
}

/// A store is never replaced, and what lies beside one that is gone is not taken for a part of the new one.
Result<void> free_place(const std::string& path) {
  std::error_code error;
  for (const char* beside : {"", "-wal", "-journal"})
    if (fs::exists(path + beside, error) && (*beside == '\0' || fs::file_size(path + beside, error) > 0))
      return failure(ErrorCode::environment,
                     fmt::format("{}{}: is there already; move it away, or name another file", path, beside));
  fs::remove(server::OutsideRevision::path_of(path), error);
  return {};
}

/// Takes the newest whole state of each layout.
Result<void> take_what_is_whole(Store& damaged, const std::string& path) {
  LEKALO_TRY(Store made, Store::open(path));
  LEKALO_TRY(const std::vector<server::LayoutSummary> all, damaged.list());
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    const Result<server::StoredLayout> layout = damaged.newest_whole(one->id);
    if (!layout) {
      tell(fmt::format("layout {}: nothing of it could be taken\n", one->id));
      continue;
    }
    LEKALO_TRY(const server::LayoutId id, made.create(layout->name, layout->document));
    tell(fmt::format("layout {} '{}': its state at revision {} is layout {}\n", one->id, layout->name,
                     layout->revision, id));
  }
  return {};
}

Result<int> restore(const StoreOptions& o) {
  LEKALO_CHECK(check_outputs({{"-o", o.output}}, {{"the copy", o.file}}));
  LEKALO_TRY(Store copy, Store::open(o.file, StoreUse::inspect));
  LEKALO_TRY(const StoreCheck check, copy.check());
  tell_damage(o.file, check);
  LEKALO_CHECK(free_place(o.output));
  if (check.readable) {
    LEKALO_CHECK(copy.write_copy(o.output));
    LEKALO_TRY(const Store made, Store::open(o.output));
  } else {
    LEKALO_CHECK(take_what_is_whole(copy, o.output));
  }
  LEKALO_CHECK(print(fmt::format("{}: {}\n", o.output, counts(check))));
  return check.damage.empty() ? kWhole : kDamaged;
}

}  // namespace

Result<int> run_store(const StoreOptions& options) {
  switch (options.action) {
    case StoreAction::backup:
      return back_up(options);
    case StoreAction::restore:
      return restore(options);
    default:
      return check_store(options);
  }
}

}  // namespace lekalo::cli
