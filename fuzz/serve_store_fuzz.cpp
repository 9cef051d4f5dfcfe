// Any bytes as the file of a store, and a whole store with any of its bytes changed: it is refused or damage
// is told, and what is given back is whole.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "lekalo/base/assert.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "support/store_cases.hpp"

namespace {

using namespace lekalo;

/// A file of this process, in memory where the system has a place for that.
const std::string& path() {
  static const std::string path = [] {
    const std::string folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    return folder + "/lekalo-store-fuzz-" + std::to_string(getpid()) + ".sqlite";
  }();
  return path;
}

void remove_files() {
  for (const char* beside : {"", "-wal", "-journal", "-revision", "-reserve", ".format-1", ".format-2"})
    std::remove((path() + beside).c_str());
}

const std::string& whole_store() {
  static const std::string bytes = [] {
    remove_files();
    {
      server::Store store = cases::open_store(path());
      layout::Document document = cases::two_squares();
      Random random(1, 5);
      cases::add_revisions(store, store.create("a", document).value(), document, 0, 12, random);
    }
    return cases::file_bytes(path());
  }();
  return bytes;
}

/// The first byte says how the others are meant: as the file, or as changes of the whole store, four bytes
/// each: the place and the byte that goes there.
std::string file_of(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || data[0] % 4 == 0) return {reinterpret_cast<const char*>(data), size};
  std::string bytes = whole_store();
  for (std::size_t k = 1; k + 4 <= size; k += 4)
    bytes[(data[k] | data[k + 1] << 8 | data[k + 2] << 16) % bytes.size()] = static_cast<char>(data[k + 3]);
  return bytes;
}

void read_all(server::Store& store) {
  const auto list = store.list();
  if (!list) return;
  for (const server::LayoutSummary& one : *list) {
    const auto history = store.history(one.id);
    const auto photos = store.photos(one.id);
    const auto layout = store.load(one.id);
    if (!layout) continue;
    LEKALO_ASSERT(!one.damaged);
    const auto again = store.state_at(one.id, layout->revision);
    LEKALO_ASSERT(again && io::write_layout(*again) == io::write_layout(layout->document));
  }
  const auto check = store.check();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = file_of(data, size);
  remove_files();
  cases::write_file(path(), bytes);
  const bool serves = size > 0 && data[0] % 8 == 1;
  if (auto store = server::Store::open(path(), serves ? server::StoreUse::serve : server::StoreUse::inspect))
    read_all(*store);
  remove_files();
  return 0;
}
