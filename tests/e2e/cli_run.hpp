#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/json.hpp"
#include "support/places.hpp"

/// Runs the real program in folders that go away afterwards.
namespace lekalo::test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using cases::Json;

std::string read_bytes(const fs::path& path);
void write_bytes(const fs::path& path, const std::string& bytes);

/// A new empty folder, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path operator/(const std::string& name) const;
  /// Every file below, by name relative to the folder, with its bytes.
  [[nodiscard]] std::map<std::string, std::string> files() const;

 private:
  fs::path path_;
};

struct Ran {
  int status = -1;  ///< exit status, or 128 + signal
  std::string out, err;
  [[nodiscard]] Json json() const { return Json::parse(out); }
};

/// A running program; its output goes to files outside the folder it works in.
class Program {
 public:
  /// \param more_environment  NAME=VALUE, beside what the test itself runs in
  Program(const fs::path& folder, const Words& words, const std::string& stdout_path = "",
          Words more_environment = {});
  /// Sends a signal once the program has a handler for it; before, it would only be killed. One that ends
  /// without ever having one shows in its exit status.
  void send_when_caught(int signal_number) const;
  /// Sends a signal once the program has used so much processor time; none where it ends before.
  void send_after_work(int signal_number, double seconds) const;
  [[nodiscard]] Ran wait();

 private:
  /// A field of the kernel's word about the process, for instance "State".
  [[nodiscard]] std::string status_field(const std::string& name) const;
  [[nodiscard]] bool running() const;
  /// Processor time so far, seconds.
  [[nodiscard]] double used() const;
  [[nodiscard]] bool catches(int signal_number) const;

  TemporaryFolder streams_;
  pid_t process_ = 0;
};

Ran run(const fs::path& folder, const Words& words);

Words operator+(Words words, const Words& more);

fs::path example(int number, const std::string& role);
Words locate_example(int number);

/// A plate of 80 x 40 and a blank of 90 x 50 elsewhere: 5 mm all round, also with the part turned by 180
/// degrees.
inline const std::string kPlate = "0 0\n80 0\n80 40\n0 40\n";
inline const std::string kPlateBlank = "100 100\n190 100\n190 150\n100 150\n";
inline const std::string kPlateProgram =
    "%\nG21 G90 G17\nG54\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F100\nG1 X70\nG2 X70 Y30 I0 J10\nG1 X10\nG0 Z5\nM2\n%\n";

void write_plate(const TemporaryFolder& folder);

inline const Words kLocatePlate{"locate", "--part", "part.csv", "--blank", "blank.csv"};

/// The text without what may differ from run to run: the last field, `run`.
std::string without_run(const std::string& result);

}  // namespace lekalo::test
