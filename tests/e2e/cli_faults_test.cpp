#include <algorithm>
#include <cerrno>
#include <sstream>

#include "e2e/cli_run.hpp"
#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "support/layout_texts.hpp"
#include "support/solid_files.hpp"
#include "support/solids.hpp"

/// Every command with the N-th call to the system failing, for N = 1, 2, ... until the command runs to its
/// end: disks that are full or broken, memory that is out. Whatever fails, the command ends by itself, with a
/// sentence and a documented status; files are there whole or as they were, and never beside.
namespace lekalo::test::cli_faults_test {
namespace {

using Files = std::map<std::string, std::string>;

/// A command, and the files it writes, which stand there before with other bytes.
struct Command {
  std::string name;
  Words words;
  Words outputs;
};
void PrintTo(const Command& command, std::ostream* out) { *out << command.name; }

const std::string kOlder = "what stood here before\n";
constexpr std::size_t kStandardCases = 45;  // of one command

std::string source(const std::string& path) { return cases::source_dir() + "/" + path; }

std::vector<Command> commands() {
  const std::string corpus = source("tests/corpus/data/");
  return {
      {"locate",
       {"locate",   "--part",   "part.csv",   "--blank",      "blank.csv",     "--nc",   "o.nc",
        "--nc-out", "moved.nc", "-o",         "l.json",       "--certificate", "l.cert", "--picture",
        "l.svg",    "--report", "report.svg", "--allowances", "l.csv",         "--json"},
       {"l.json", "l.cert", "l.svg", "report.svg", "l.csv", "moved.nc"}},
      {"locate_regions",
       {"locate", "--part", "ring.json", "--blank", "plate.svg", "--blank-layers", "plate", "--window", "0",
        "0", "--gap", "0.5", "--features", "features.json", "-o", "r.json"},
       {"r.json"}},
      {"locate_solid",
       {"locate", "--part", "part.stl", "--blank", "casting.ply", "--gap", "0.5", "-o", "s.json",
        "--certificate", "s.cert", "--allowances", "s.csv", "--picture", "s.html"},
       {"s.json", "s.cert", "s.csv", "s.html"}},
      {"verify", {"verify", "result.json", "--json"}, {}},
      {"check", {"check", "layout.json", "--json", "--picture", "c.svg"}, {"c.svg"}},
      {"show_dxf", {"show", corpus + "dxf/layers.dxf", "--json"}, {}},
      {"show_svg", {"show", "plate.svg", "--json"}, {}},
      {"nest", {"nest", "layout.json", "--work", "2000", "-o", "n.json"}, {"n.json"}},
      {"export_gcode",
       {"export", "layout.json", "--format", "gcode", "--kerf", "0.2", "--feed", "3000", "-o", "e.nc"},
       {"e.nc"}},
      {"export_dxf", {"export", "layout.json", "--format", "dxf", "-o", "e.dxf"}, {"e.dxf"}},
      {"edit", {"edit", "layout.json", "--commands", "some.commands", "-o", "e.json"}, {"e.json"}},
      {"pocket",
       {"pocket", "pocket.json", "--tool", "6", "--depth", "2", "-o", "p.ngc", "--json"},
       {"p.ngc"}},
      {"simulate", {"simulate", "p.nc", "--pocket", "pocket.json", "--tool", "6", "--json"}, {}},
      {"fit",
       {"fit", "--diameter", "18", "--interference", "0.02", "--hub-outer", "36", "--length", "18",
        "--material", "C45", "--json", "-o", "f.json"},
       {"f.json"}},
      {"heat",
       {"heat",      "p.nc", "--pocket",         "pocket.json", "--stock",    "40x36x6", "--tool",  "6",
        "--teeth",   "3",    "--spindle",        "8000",        "--material", "6061-T6", "--share", "0.1",
        "--cooling", "20",   "--stock-to-leave", "1",           "--voxel",    "6",       "--json",  "-o",
        "h.json"},
       {"h.json", "h.svg"}},
  };
}

/// What the commands read. Numbers are small, so that a run takes milliseconds.
void write_inputs(const TemporaryFolder& folder) {
  write_plate(folder);
  write_bytes(folder / "ring.json", R"({"outer": [{"line": {"from": [0, 0], "to": [30, 0]}},
    {"line": {"from": [30, 0], "to": [30, 20]}}, {"line": {"from": [30, 20], "to": [0, 20]}},
    {"line": {"from": [0, 20], "to": [0, 0]}}]})");
  write_bytes(folder / "features.json",
              R"({"units": "mm", "features": [{"name": "edge", "edges": [0], "minimum": 0.5}]})");
  write_bytes(folder / "plate.svg",
              R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<g id="plate"><path d="M 10 10 H 60 V 50 H 10 Z"/></g></svg>)");
  write_bytes(folder / "pocket.json", R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [20, 0]}},
    {"line": {"from": [20, 0], "to": [20, 16]}}, {"line": {"from": [20, 16], "to": [0, 16]}},
    {"line": {"from": [0, 16], "to": [0, 0]}}]})");
  write_bytes(folder / "part.stl", solid_files::stl_text(cases::block({-20, -15, -10}, {20, 15, 10})));
  write_bytes(folder / "casting.ply", solid_files::ply<float>(cases::block({-22, -17, -13}, {24, 17, 11}),
                                                              solid_files::PlyForm::little));
  write_bytes(folder / "o.nc", kPlateProgram);
  write_bytes(folder / "p.nc",
              "G21 G90 G17\nG0 Z5\nG0 X4 Y4\nG1 Z-1 F100\nG1 X16\nG1 Y12\nG1 X4\nG1 Y4\nG0 Z5\nM2\n");
  Json layout = cases::empty_layout();
  cases::add_part(layout, "square", cases::outline_json(cases::rectangle(0, 0, 10, 10)))["demand"] = 3;
  cases::place(layout, "square", 5, 5);
  cases::place(layout, "square", 25, 5);
  write_bytes(folder / "layout.json", layout.dump());
  write_bytes(folder / "some.commands", "lekalo-commands/1\nmove 1 by 3 4\nfit square s 0\n");
}

struct Fault {
  std::string kind, mode;  ///< memory or files; errno, and + for every later call too
  std::size_t call = 0;
};

class CliFaults : public testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    if (cases::faults_library().empty()) GTEST_SKIP() << "this build has no library that makes calls fail";
    write_inputs(folder_);
    ASSERT_EQ(run(folder_.path(), kLocatePlate + Words{"-o", "result.json"}).status, 0);
    for (const std::string& output : GetParam().outputs) write_bytes(folder_ / output, kOlder);
    before_ = folder_.files();
    good_ = run_with({});
    after_ = folder_.files();
    ASSERT_EQ(good_.status, 0) << good_.err;
  }

  /// Runs the command; calls_ and refused_ are what the library saw.
  Ran run_with(const Words& fault) {
    const std::string report = (report_ / "calls").string();
    Program program(folder_.path(), GetParam().words, "",
                    Words{"LD_PRELOAD=" + cases::faults_library(), "LEKALO_FAULT_REPORT=" + report} + fault);
    const Ran ran = program.wait();
    std::istringstream(read_bytes(report)) >> calls_["memory"] >> calls_["files"] >> refused_;
    fs::remove(report);
    return ran;
  }

  void put_back() {
    for (const auto& [name, bytes] : folder_.files())
      if (before_.count(name) == 0) fs::remove(folder_ / name);
    for (const auto& [name, bytes] : before_)
      if (read_bytes(folder_ / name) != bytes) write_bytes(folder_ / name, bytes);
  }

  void judge(const Fault& fault) {
    refused_ = "none";
    const Ran ran =
        run_with({"LEKALO_FAULT=" + fault.kind + ":" + std::to_string(fault.call) + ":" + fault.mode});
    SCOPED_TRACE(GetParam().name + ": " + fault.kind + " call " + std::to_string(fault.call) + ", " +
                 refused_ + ", fails with " + fault.mode + "; stderr: " + ran.err);
    const bool again = fault.mode == std::to_string(EINTR) && (refused_ == "read" || refused_ == "write");
    if (ran.status == 0 || again) {
      EXPECT_EQ(ran.status, 0) << "an interrupted call is made again";
      EXPECT_EQ(without_run(ran.out), without_run(good_.out));
      expect_files(folder_.files(), true);
    } else {
      EXPECT_TRUE(ran.status == 5 || (ran.status == 3 && fault.kind == "files")) << ran.status;
      const std::size_t end = ran.err.size() - std::min<std::size_t>(ran.err.size(), 1);
      const std::size_t line = end == 0 ? 0 : ran.err.rfind('\n', end - 1) + 1;
      EXPECT_EQ(ran.err.compare(line, 8, "lekalo: "), 0) << "the last line says why";
      Files now = folder_.files();
      if (fault.mode.back() == '+' && refused_ == "rename") put_back_as_told(ran.err, now);
      const bool there = !GetParam().outputs.empty() && now.at(GetParam().outputs[0]) != kOlder;
      expect_files(now, there);
    }
    put_back();
  }

  /// A disk that takes one rename and from then on nothing does not let it be put back either. Then the
  /// sentence names each file that is new, and where what stood there is.
  void put_back_as_told(const std::string& said, Files& now) {
    for (const std::string& output : GetParam().outputs) {
      const std::string words = output + " is new already and could not be put back: ";
      const std::size_t told = said.find(words), name = told + words.size();
      if (told == std::string::npos) continue;
      const std::string kept =
          fs::path(said.substr(name, said.find(" is what it was", name) - name)).filename().string();
      ASSERT_EQ(now.count(kept), 1U) << kept;
      EXPECT_EQ(without_run(now[output]), without_run(after_[output]));
      now[output] = now[kept];
      now.erase(kept);
      ++stuck_;
    }
  }

  /// All outputs new, or all as before; nothing else.
  void expect_files(const Files& now, bool all_new) {
    const Files& wanted = all_new ? after_ : before_;
    for (const auto& [name, bytes] : now) {
      if (wanted.count(name) == 0) ADD_FAILURE() << name << " was left behind";
    }
    for (const auto& [name, bytes] : wanted) {
      ASSERT_EQ(now.count(name), 1U) << name;
      EXPECT_EQ(without_run(now.at(name)), without_run(bytes)) << name;
    }
  }

  TemporaryFolder folder_, report_;
  Files before_, after_;
  Ran good_;
  std::map<std::string, std::size_t> calls_;
  std::string refused_;
  std::size_t stuck_ = 0;  ///< files that were told to be new and not put back
};

TEST_P(CliFaults, WhateverFailsEndsInASentenceAndNoHalfFile) {
  const auto errno_of = [](int number, const char* later = "") { return std::to_string(number) + later; };
  const std::vector<std::pair<std::string, std::string>> kinds{{"files", errno_of(EIO)},
                                                               {"files", errno_of(ENOSPC, "+")},
                                                               {"files", errno_of(EINTR)},
                                                               {"memory", errno_of(ENOMEM)},
                                                               {"memory", errno_of(ENOMEM, "+")}};
  const std::size_t each = std::max<std::size_t>(1, cases::case_count(kStandardCases) / kinds.size());
  const std::map<std::string, std::size_t> calls = calls_;
  Random random(cases::seed());
  for (const auto& [kind, mode] : kinds) {
    const std::size_t all = calls.at(kind), tried = std::min(all, each);
    ASSERT_GT(all, 2U);
    for (std::size_t i = 0; i < tried && !HasFailure(); ++i) {
      // One of each of `tried` equal stretches; every call where there are so many tries.
      const std::size_t first = i * all / tried, next = (i + 1) * all / tried;
      judge({kind, mode, 1 + first + random.below(next - first)});
    }
  }
}

const auto name_of = [](const auto& one) { return one.param.name; };
INSTANTIATE_TEST_SUITE_P(Commands, CliFaults, testing::ValuesIn(commands()), name_of);

/// A command with several outputs, with each of its calls about files failing.
class SeveralFiles : public CliFaults {};

TEST_P(SeveralFiles, AreThereTogetherOrNotAtAll) {
  const std::size_t all = calls_["files"];
  for (const std::string& mode : {std::to_string(EIO), std::to_string(ENOSPC) + "+"})
    for (std::size_t call = 1; call <= all && !HasFailure(); ++call) judge({"files", mode, call});
  std::printf("%zu calls; %zu files could not be put back, and were told\n", all, stuck_);
  EXPECT_GT(stuck_, 0U);
}

INSTANTIATE_TEST_SUITE_P(Commands, SeveralFiles, testing::Values(commands().front()), name_of);

}  // namespace
}  // namespace lekalo::test::cli_faults_test
