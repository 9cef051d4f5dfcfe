#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "support/places.hpp"

/// Runs the real program in folders that go away afterwards.
namespace lekalo::test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Json = nlohmann::ordered_json;

inline std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  ASSERT_TRUE(file.good()) << path;
}

/// A new empty folder, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "lekalo-e2e-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
  /// Every file below, by name relative to the folder, with its bytes.
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(path_)) {
      if (entry.is_regular_file()) {
        found[fs::relative(entry.path(), path_).string()] = read_bytes(entry.path());
      }
    }
    return found;
  }

 private:
  fs::path path_;
};

struct Ran {
  int status = -1;  ///< exit status, or 128 + signal
  std::string out, err;
  [[nodiscard]] Json json() const {
    const Json parsed = Json::parse(out, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << out;
    return parsed;
  }
};

/// A running program; its output goes to files outside the folder it works in.
class Program {
 public:
  Program(const fs::path& folder, const Words& words, const std::string& stdout_path = "") {
    const std::string out = stdout_path.empty() ? (streams_ / "out").string() : stdout_path;
    const std::string err = (streams_ / "err").string();
    std::vector<std::string> all{cases::program()};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ != 0) return;
    const int to_out = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int to_err = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (to_out < 0 || to_err < 0 || dup2(to_out, 1) < 0 || dup2(to_err, 2) < 0 || chdir(folder.c_str()) != 0)
      _exit(127);
    execv(argv[0], argv.data());
    _exit(127);
  }
  /// Sends a signal once the program has a handler for it; before, it would only be killed. One that ends
  /// without ever having one shows in its exit status.
  void send_when_caught(int signal_number) const {
    while (running() && !catches(signal_number)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(process_, signal_number);
  }
  [[nodiscard]] Ran wait() {
    int state = 0;
    waitpid(process_, &state, 0);
    return {WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state), read_bytes(streams_ / "out"),
            read_bytes(streams_ / "err")};
  }

 private:
  /// A field of the kernel's word about the process, for instance "State".
  [[nodiscard]] std::string status_field(const std::string& name) const {
    std::ifstream lines("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(name + ":\t", 0) == 0) return line.substr(name.size() + 2);
    }
    return {};
  }
  [[nodiscard]] bool running() const {
    const std::string state = status_field("State");
    return !state.empty() && state.front() != 'Z';
  }
  [[nodiscard]] bool catches(int signal_number) const {
    const auto caught = std::strtoull(("0x0" + status_field("SigCgt")).c_str(), nullptr, 16);
    return (caught >> (signal_number - 1) & 1) != 0;
  }

  TemporaryFolder streams_;
  pid_t process_ = 0;
};

inline Ran run(const fs::path& folder, const Words& words) { return Program(folder, words).wait(); }

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline fs::path example(int number, const std::string& role) {
  return fs::path(cases::source_dir()) / "examples/localisation" /
         ("example-" + std::to_string(number) + "-" + role + ".csv");
}

inline Words locate_example(int number) {
  return {"locate", "--part", example(number, "part").string(), "--blank", example(number, "blank").string()};
}

/// A plate of 80 x 40 and a blank of 90 x 50 elsewhere: 5 mm all round, also with the part turned by 180
/// degrees.
inline const std::string kPlate = "0 0\n80 0\n80 40\n0 40\n";
inline const std::string kPlateBlank = "100 100\n190 100\n190 150\n100 150\n";
inline const std::string kPlateProgram =
    "%\nG21 G90 G17\nG54\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F100\nG1 X70\nG2 X70 Y30 I0 J10\nG1 X10\nG0 Z5\nM2\n%\n";

inline void write_plate(const TemporaryFolder& folder) {
  write_bytes(folder / "part.csv", kPlate);
  write_bytes(folder / "blank.csv", kPlateBlank);
  write_bytes(folder / "part.nc", kPlateProgram);
}

inline const Words kLocatePlate{"locate", "--part", "part.csv", "--blank", "blank.csv"};

/// The text without what may differ from run to run: the last field, `run`.
inline std::string without_run(const std::string& result) {
  return result.substr(0, result.rfind("\"run\""));
}

}  // namespace lekalo::test
