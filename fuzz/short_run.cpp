// A short run of a fuzz program without libFuzzer, for compilers that have none: the same mutations of the
// seed corpus every time, so that every build asks the question that the long runs ask at random.
//
//   short_NAME [CORPUS FOLDER]
//
// LEKALO_CASES inputs, by LEKALO_SEED. An input that stops the program, that takes 20 s of processor time, or
// after which the process has ever held more than a gigabyte, is left in ./found-NAME, and fails the run.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kStandardCases = 1500;
constexpr std::size_t kLargestInput = 1 << 14;
constexpr unsigned kMostSeconds = 20;         // for one input
constexpr std::size_t kMostMegabytes = 1024;  // what a command may take for an input of a megabyte
constexpr std::array<std::string_view, 12> kAwkward{
    "nan", "-inf", "1e308", "-1e-320", "0", "-1", "99999999999999999999", "1e9", "\xff", "[[", "\r", "\""};

std::string current, found;
double slowest_seconds = 0;

void leave_input(int signal) {
  const int file = ::open(found.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && ::write(file, current.data(), current.size()) >= 0) ::close(file);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::string random_bytes(lekalo::Random& random, std::size_t count) {
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

std::vector<std::string> seeds_in(const char* folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());  // the order of folders differs from machine to machine
  std::vector<std::string> seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

void mutate(std::string& bytes, const std::string& other, lekalo::Random& random) {
  const auto place = [&](const std::string& text) { return random.below(text.size() + 1); };
  const std::size_t at = place(bytes);
  switch (random.below(8)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random.below(256));
      break;
    case 2:
      bytes.erase(at, 1 + random.below(16));
      break;
    case 3:
      bytes.insert(place(bytes), bytes.substr(at, 1 + random.below(64)));
      break;
    case 4:
      bytes.insert(at, random_bytes(random, 1 + random.below(8)));
      break;
    case 5:
      bytes.insert(at, other.substr(place(other), 1 + random.below(64)));
      break;
    case 6:
      bytes.resize(at);
      break;
    default: {  // a number, or whatever stands there, becomes an awkward one
      const std::size_t digit = bytes.find_first_of("0123456789", at);
      if (digit == std::string::npos) break;
      const std::size_t end = std::min(bytes.find_first_not_of("+-.eE0123456789", digit), bytes.size());
      bytes.replace(digit, end - digit, kAwkward[random.below(kAwkward.size())]);
    }
  }
  if (bytes.size() > kLargestInput) bytes.resize(kLargestInput);
}

/// The most memory that this process has held so far.
std::size_t megabytes_held() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<std::size_t>(used.ru_maxrss) / 1024;
}

void try_input(std::string input) {
  current = std::move(input);
  const itimerval most{{}, {kMostSeconds, 0}};
  ::setitimer(ITIMER_PROF, &most, nullptr);
  const std::clock_t start = std::clock();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current.data()), current.size());
  slowest_seconds = std::max(slowest_seconds, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  if (megabytes_held() > kMostMegabytes) {
    std::fprintf(stderr, "more than %zu MB are held after an input\n", kMostMegabytes);
    std::raise(SIGABRT);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = lekalo::cases::seed();
  const std::size_t cases = lekalo::cases::case_count(kStandardCases);
  found = "found-" + std::filesystem::path(argv[0]).filename().string();
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGPROF})
    std::signal(signal, leave_input);

  lekalo::Random random(seed);
  std::vector<std::string> seeds{"", random_bytes(random, 16), random_bytes(random, 200),
                                 random_bytes(random, 2000)};
  if (argc > 1)
    for (std::string& one : seeds_in(argv[1])) seeds.push_back(std::move(one));
  for (const std::string& one : seeds) try_input(one);
  for (std::size_t i = 0; i < cases; ++i) {
    lekalo::Random own(seed, i + 1);
    std::string input = seeds[own.below(seeds.size())];
    const std::string& other = seeds[own.below(seeds.size())];
    for (std::uint64_t k = own.below(6) + 1; k > 0; --k) mutate(input, other, own);
    try_input(std::move(input));
  }
  std::printf("%zu inputs, seed %llu, slowest %.3f s, at most %zu MB\n", cases + seeds.size(),
              static_cast<unsigned long long>(seed), slowest_seconds, megabytes_held());
}
