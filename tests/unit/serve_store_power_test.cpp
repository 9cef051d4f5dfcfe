// The power is cut while a store is written: sectors that were not yet flushed are on the disk or not, each
// as chance has it. Whatever was acknowledged has to be there afterwards, and nothing may raise an alarm.
//
// The functions of the C library that change files are this program's own: they note what is done to the
// files of one folder, for SQLite and for the store's own files alike, and then do it.

#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <optional>

#include "lekalo/io/layout/layout_json.hpp"
#include "support/cases.hpp"
#include "support/store_cases.hpp"

namespace {

struct Event {
  enum Kind { write, truncate, flush, unlink } kind;
  std::string file;  ///< its name in the folder
  std::size_t at = 0;
  std::string bytes;
};

/// What is noted; empty folder: nothing.
struct Record {
  std::string folder;
  std::vector<Event> events;
} record;

/// The name of the file in the folder that is watched, empty for any other.
std::string watched(int file) {
  if (record.folder.empty()) return {};
  char path[4096];
  const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path);
  const std::string prefix = record.folder + "/";
  const std::string name(path, length > 0 ? static_cast<std::size_t>(length) : 0);
  return name.compare(0, prefix.size(), prefix) == 0 ? name.substr(prefix.size()) : std::string();
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

void note_write(int file, const void* bytes, ssize_t count, off_t at) {
  const std::string name = watched(file);
  if (name.empty() || count <= 0) return;
  record.events.push_back({Event::write, name, static_cast<std::size_t>(at),
                           std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(count))});
}

ssize_t noted_pwrite(const char* function, int file, const void* bytes, size_t count, off_t at) {
  const ssize_t done = real<ssize_t (*)(int, const void*, size_t, off_t)>(function)(file, bytes, count, at);
  note_write(file, bytes, done, at);
  return done;
}

int noted_truncate(const char* function, int file, off_t size) {
  const std::string name = watched(file);
  if (!name.empty()) record.events.push_back({Event::truncate, name, static_cast<std::size_t>(size), {}});
  return real<int (*)(int, off_t)>(function)(file, size);
}

int noted_flush(const char* function, int file) {
  const std::string name = watched(file);
  if (name.empty()) return real<int (*)(int)>(function)(file);
  record.events.push_back({Event::flush, name, 0, {}});
  return 0;  // what is recorded is flushed; the disk of this machine need not be
}

}  // namespace

extern "C" {
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  return noted_pwrite("pwrite", file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
  return noted_pwrite("pwrite64", file, bytes, count, at);
}
ssize_t write(int file, const void* bytes, size_t count) {
  const off_t at = record.folder.empty() ? 0 : lseek(file, 0, SEEK_CUR);
  const ssize_t done = real<ssize_t (*)(int, const void*, size_t)>("write")(file, bytes, count);
  note_write(file, bytes, done, at);
  return done;
}
int ftruncate(int file, off_t size) noexcept { return noted_truncate("ftruncate", file, size); }
int ftruncate64(int file, off64_t size) noexcept { return noted_truncate("ftruncate64", file, size); }
int fsync(int file) { return noted_flush("fsync", file); }
int fdatasync(int file) { return noted_flush("fdatasync", file); }
int unlink(const char* path) noexcept {
  const std::string prefix = record.folder + "/";
  if (!record.folder.empty() && std::strncmp(path, prefix.c_str(), prefix.size()) == 0)
    record.events.push_back({Event::unlink, path + prefix.size(), 0, {}});
  return real<int (*)(const char*)>("unlink")(path);
}
}

namespace lekalo::server::serve_store_power_test {
namespace {

constexpr std::size_t kSector = 512;

/// A file as it may be after the power came back.
struct Disk {
  std::string flushed;
  std::vector<Event> pending;
};

void carry_out(std::string& bytes, const Event& event) {
  if (event.kind == Event::truncate) {
    bytes.resize(event.at, '\0');
    return;
  }
  if (bytes.size() < event.at + event.bytes.size()) bytes.resize(event.at + event.bytes.size(), '\0');
  std::memcpy(bytes.data() + event.at, event.bytes.data(), event.bytes.size());
}

/// Each sector of each write is there or not.
void carry_out_by_chance(std::string& bytes, const Event& event, Random& random) {
  if (event.kind == Event::truncate) {
    if (random.below(2) == 0) carry_out(bytes, event);
    return;
  }
  for (std::size_t begin = event.at; begin < event.at + event.bytes.size();) {
    const std::size_t end = std::min((begin / kSector + 1) * kSector, event.at + event.bytes.size());
    if (random.below(2) == 0)
      carry_out(bytes, {Event::write, event.file, begin, event.bytes.substr(begin - event.at, end - begin)});
    begin = end;
  }
}

/// The files after a cut behind the first `count` events.
/// \param deaf  the end of the names of files that the disk does not flush when it is asked to
std::map<std::string, std::string> files_after(std::size_t count, const std::string& deaf, Random& random) {
  std::map<std::string, Disk> disks;
  for (std::size_t i = 0; i < count; ++i) {
    const Event& event = record.events[i];
    if (event.kind == Event::unlink) {
      disks.erase(event.file);
      continue;
    }
    Disk& disk = disks[event.file];
    if (event.kind != Event::flush) {
      disk.pending.push_back(event);
    } else if (deaf.empty() || !event.file.ends_with(deaf)) {
      for (const Event& one : disk.pending) carry_out(disk.flushed, one);
      disk.pending.clear();
    }
  }
  std::map<std::string, std::string> files;
  // All or nothing of what is pending happens too, besides some of it.
  const std::uint64_t luck = random.below(4);
  for (auto& [name, disk] : disks) {
    for (const Event& one : disk.pending) {
      if (luck == 0) carry_out(disk.flushed, one);
      if (luck >= 2) carry_out_by_chance(disk.flushed, one, random);
    }
    files[name] = disk.flushed;
  }
  return files;
}

/// An acknowledged gesture: how many events there were, and the states from then on.
struct Acknowledged {
  std::size_t events = 0;
  Revision revision = 0;
  bool second = false;  ///< whether the second layout is there
};

/// Gestures on a store whose files are watched.
struct Gestures {
  std::vector<Acknowledged> told;
  std::vector<std::string> states;  ///< by revision
};

Gestures make_gestures() {
  Random random(cases::seed(), 91);
  Gestures made;
  const cases::StoreFolder folder;
  record.folder = folder.path().string();
  {
    Store store = cases::open_store(folder / "store.sqlite");
    layout::Document document = cases::random_layout(3, 0, 6);
    const LayoutId first = store.create("a", document).value();
    made.states.push_back(io::write_layout(document));
    made.told.push_back({record.events.size(), 0, false});
    std::optional<LayoutId> second;
    // Enough for the log to be brought into the file several times.
    for (Revision revision = 1; revision <= 700;) {
      if (random.below(20) != 0) {
        cases::add_revisions(store, first, document, revision - 1, 1, random);
        made.states.push_back(io::write_layout(document));
        ++revision;
      } else if (second) {
        EXPECT_TRUE(store.remove(*second));
        second.reset();
      } else {
        second = store.create("b", document).value();
      }
      made.told.push_back(
          {record.events.size(), static_cast<Revision>(made.states.size()) - 1, second.has_value()});
    }
  }
  record.folder.clear();
  return made;
}

const Gestures& gestures() {
  static const Gestures made = make_gestures();
  return made;
}

/// Cuts the power behind an event and opens the store again. \return what is wrong with it
std::string wrong_after(std::size_t cut, const std::string& deaf, Random& random) {
  const std::vector<Acknowledged>& told = gestures().told;
  const auto next =
      std::upper_bound(told.begin(), told.end(), cut,
                       [](std::size_t events, const Acknowledged& a) { return events < a.events; });
  const Acknowledged& last = *(next - 1);
  const cases::StoreFolder folder;
  for (const auto& [name, bytes] : files_after(cut, deaf, random)) cases::write_file(folder / name, bytes);
  Result<Store> store = Store::open(folder / "store.sqlite");
  if (!store) return store.error().message;
  for (const std::string& notice : store->notices())
    if (notice.find("-revision cannot be read") == notice.npos) return notice;
  const Result<StoredLayout> layout = store->load(1);
  if (!layout) return layout.error().message;
  if (layout->revision < last.revision) return "an acknowledged gesture is lost";
  if (layout->revision > last.revision + 1) return "more than the one gesture without an answer";
  if (io::write_layout(layout->document) != gestures().states[static_cast<std::size_t>(layout->revision)])
    return "another layout";
  const bool second = store->list()->size() == 2;
  const bool sure = next == told.end() || next->second == last.second;
  if (sure && second != last.second) return "a layout too many or too few";
  if (store->check()->damage.size() > store->notices().size()) return "damage";
  return {};
}

std::size_t some_cut(Random& random) {
  const std::size_t first = gestures().told.front().events;
  return first + random.below(record.events.size() - first);
}

TEST(StorePower, CutAtAnyMomentNothingAcknowledgedIsLost) {
  ASSERT_GT(gestures().told.size(), 700U);
  ASSERT_GT(record.events.size(), 4000U) << "the functions of the C library are not this program's";
  Random random(cases::seed(), 92);
  // 40 in the quick suite; LEKALO_CASES=200 for the full one.
  for (std::size_t n = 0; n < cases::case_count(40); ++n) {
    const std::size_t cut = some_cut(random);
    ASSERT_EQ(wrong_after(cut, "", random), "")
        << "cut after " << cut << " of " << record.events.size() << " events, seed " << cases::seed();
  }
}

/// The model of the disk is worth nothing unless a store that does not flush fails by it.
TEST(StorePower, ALogThatIsNotFlushedWouldBeNoticed) {
  ASSERT_GT(gestures().told.size(), 700U);
  Random random(cases::seed(), 93);
  std::size_t lost = 0;
  for (int n = 0; n < 20; ++n)
    if (!wrong_after(some_cut(random), "-wal", random).empty()) ++lost;
  EXPECT_GT(lost, 5U);
}

}  // namespace
}  // namespace lekalo::server::serve_store_power_test
