#pragma once

// Stores of layouts for tests, in folders of their own.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/store/store.hpp"
#include "support/layout_cases.hpp"
#include "support/layout_commands.hpp"

namespace lekalo::cases {

class StoreFolder {
 public:
  StoreFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lekalo-store-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
    folder_ = name;
  }
  ~StoreFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  StoreFolder(const StoreFolder&) = delete;
  StoreFolder& operator=(const StoreFolder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

inline std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline server::Store open_store(const std::string& path, server::StoreUse use = server::StoreUse::serve) {
  Result<server::Store> store = server::Store::open(path, use);
  if (!store) throw std::runtime_error(store.error().message);
  return std::move(*store);
}

/// Moves placement 1 to the right by `steps` grid steps, as the next revision.
inline server::StoredChange step_right(layout::Document& d, server::Revision revision, std::int64_t steps) {
  server::StoredChange change;
  change.revision = revision;
  change.text = "move";
  change.author = "tester";
  layout::Placement after = d.placements[0];
  after.at.x += steps;
  change.change.placements.push_back({d.placements[0], after});
  change.change.next_id_before = change.change.next_id_after = d.next_id;
  d.placements[0] = after;
  return change;
}

/// Adds `count` revisions of drawn features and moves to a layout that is at `revision`.
inline void add_revisions(server::Store& store, server::LayoutId id, layout::Document& document,
                          server::Revision revision, int count, Random& random) {
  layout::Workspace now(document);
  for (int done = 0; done < count;) {
    const auto change = plan(now, some_feature_command(now.document(), random), layout::Mode::strict);
    server::StoredChange stored;
    if (random.below(2) == 0 && change && !change->is_nothing()) {
      carry_out(now, *change);
      stored.revision = revision + 1;
      stored.text = "draw";
      stored.change = *change;
      document = now.document();
    } else {
      stored = step_right(document, revision + 1, 1);
      carry_out(now, stored.change);
    }
    if (!store.append(id, stored, document)) throw std::runtime_error("a change was not taken");
    ++revision;
    ++done;
  }
}

}  // namespace lekalo::cases
