// All tests of the checker in one program, over the copy of src/verify that tools/mutants.py has written. It
// reads questions from stdin, a line each, and answers each with a line; a question is a test run in a child
// of its own:
//
//   reach SECONDS TEST            "passed|failed SECONDS" and the numbers of the mutants that the test asked
//   try MUTANT SECONDS TEST       "passed|failed"; a child that takes longer, or too much memory, has failed

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

#include "mutation/mutants.hpp"

namespace lekalo::mutants {

constexpr int kMost = LEKALO_MUTANTS + 2;
unsigned char state[kMost];

bool asked(int mutant) {
  if (state[mutant] == 1) return true;
  state[mutant] = 3;
  return false;
}

}  // namespace lekalo::mutants

namespace {

using namespace lekalo::mutants;

constexpr rlim_t kMostMemory = rlim_t{3} << 30U;
constexpr unsigned kPatience = 20;  // a busy machine may give a child this small a share

int run_test(const std::string& test, unsigned seconds) {
  const rlimit memory{kMostMemory, kMostMemory}, time{seconds, seconds + 1}, none{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_CORE, &none);
  alarm(kPatience * seconds);
  if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    return 1;
  testing::GTEST_FLAG(filter) = test;
  return RUN_ALL_TESTS();
}

/// The child's last words come through the pipe.
std::string in_a_child(const std::string& test, unsigned seconds, bool tell) {
  int ends[2];
  if (pipe(ends) != 0) return "failed";
  const pid_t child = fork();
  if (child == 0) {
    const int status = run_test(test, seconds);
    std::string words;
    for (int k = 0; tell && k < kMost; ++k)
      if (state[k] == 3) words += " " + std::to_string(k);
    if (!words.empty() && write(ends[1], words.data(), words.size()) < 0) _exit(1);
    _exit(status);
  }
  close(ends[1]);
  std::string words;
  char block[4096];
  for (ssize_t got = 0; (got = read(ends[0], block, sizeof block)) > 0;)
    words.append(block, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 1;
  waitpid(child, &status, 0);
  return (status == 0 ? "passed" : "failed") + words;
}

std::string answer(std::istringstream line) {
  std::string what, test;
  int mutant = 0;
  unsigned seconds = 0;
  line >> what;
  if (what == "try") line >> mutant;
  line >> seconds >> test;
  if (!line || mutant < 0 || mutant >= kMost) return "what?";
  if (what == "try") {
    state[mutant] = 1;
    const std::string verdict = in_a_child(test, seconds, false);
    state[mutant] = 0;
    return verdict;
  }
  std::fill(std::begin(state), std::end(state), 2);
  const auto start = std::chrono::steady_clock::now();
  std::string verdict = in_a_child(test, seconds, true);
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::fill(std::begin(state), std::end(state), 0);
  return verdict.insert(6, " " + std::to_string(took));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1 || testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  for (std::string line; std::getline(std::cin, line);)
    std::cout << answer(std::istringstream(line)) << std::endl;
}
