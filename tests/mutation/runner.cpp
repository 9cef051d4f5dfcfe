// All tests of the checker in one program, over the copy of src/verify that tools/mutants.py has written. It
// reads questions from stdin, a line each, and answers each with a line; a question is a test run in a child
// of its own:
//
//   reach SECONDS TEST            "passed|failed SECONDS" and the numbers of the mutants that the test asked
//   try MUTANT SECONDS TEST       "passed|failed"; a child that takes longer, or too much memory, has failed
//
// Seconds are those of the processor, of all that the test started.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>

#include "mutation/mutants.hpp"
#include "support/prepared.hpp"

namespace lekalo::mutants {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kMost = (LEKALO_MUTANTS + 2 + kPage - 1) / kPage * kPage;
alignas(kPage) unsigned char state[kMost];

bool asked(int mutant) {
  if (state[mutant] == 1) return true;
  state[mutant] = 3;
  return false;
}

}  // namespace lekalo::mutants

namespace {

using namespace lekalo::mutants;
namespace fs = std::filesystem;

constexpr rlim_t kMostMemory = rlim_t{3} << 30U;
constexpr double kPatience = 20;  // a busy machine may give a child this small a share

int run_test(const std::string& test, double seconds) {
  setpgid(0, 0);
  const auto whole = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit memory{kMostMemory, kMostMemory}, time{whole, whole + 1}, none{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CPU, &time);  // what the test starts inherits this one alone
  setrlimit(RLIMIT_CORE, &none);
  const itimerval timer{
      {}, {static_cast<time_t>(seconds), static_cast<suseconds_t>(std::fmod(seconds, 1) * 1e6)}};
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(static_cast<unsigned>(kPatience * static_cast<double>(whole)));
  if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    return 1;
  testing::GTEST_FLAG(filter) = test;
  testing::GTEST_FLAG(break_on_failure) = true;  // the first failure ends the trial
  return RUN_ALL_TESTS();
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Runs a test in a group of processes of its own, of which nothing is left, and no file in `folder`.
std::string in_a_child(const std::string& test, double seconds, double& took, const fs::path& folder) {
  const pid_t child = fork();
  if (child == 0) _exit(run_test(test, seconds));
  int status = 1;
  rusage used{};
  wait4(child, &status, 0, &used);
  kill(-child, SIGKILL);
  took = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) fs::remove_all(entry.path(), ignored);
  return status == 0 ? "passed" : "failed";
}

std::string answer(std::istringstream line, const fs::path& folder) {
  std::string what, test;
  int mutant = 0;
  double seconds = 0, took = 0;
  line >> what;
  if (what == "try") line >> mutant;
  line >> seconds >> test;
  if (!line || mutant < 0 || mutant >= static_cast<int>(kMost)) return "what?";
  if (what == "try") {
    state[mutant] = 1;
    const std::string verdict = in_a_child(test, seconds, took, folder);
    state[mutant] = 0;
    return verdict;
  }
  std::fill(std::begin(state), std::end(state), 2);
  std::string words = in_a_child(test, seconds, took, folder);
  words += " " + std::to_string(took);
  for (std::size_t k = 0; k < kMost; ++k)
    if (state[k] == 3) words += " " + std::to_string(k);
  std::fill(std::begin(state), std::end(state), 0);
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_asked = argc == 1;  // with words it is a program of tests like others
  testing::InitGoogleTest(&argc, argv);
  if (!is_asked) return RUN_ALL_TESTS();
  // Shared with the children, which note there what they asked.
  if (mmap(state, sizeof state, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
      MAP_FAILED)
    return 1;
  std::string folder = (fs::temp_directory_path() / "lekalo-mutants-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr || setenv("TMPDIR", folder.c_str(), 1) != 0) return 1;
  for (const auto& make : lekalo::cases::preparations()) make();
  for (std::string line; std::getline(std::cin, line);)
    std::cout << answer(std::istringstream(line), folder) << std::endl;
  fs::remove_all(folder);
}
