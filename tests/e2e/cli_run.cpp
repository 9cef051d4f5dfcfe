#include "e2e/cli_run.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>

#ifdef LEKALO_COMMAND_INSIDE  // tests/mutation: the command is a part of the program that tests it
int lekalo_command(int argc, char** argv);
#endif

namespace lekalo::test {

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  ASSERT_TRUE(file.good()) << path;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "lekalo-e2e-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::operator/(const std::string& name) const { return path_ / name; }

std::map<std::string, std::string> TemporaryFolder::files() const {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(path_)) {
    if (entry.is_regular_file()) {
      found[fs::relative(entry.path(), path_).string()] = read_bytes(entry.path());
    }
  }
  return found;
}

Program::Program(const fs::path& folder, const Words& words, const std::string& stdout_path,
                 Words more_environment) {
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
  for (std::string& one : more_environment) putenv(one.data());
#ifdef LEKALO_COMMAND_INSIDE
  const int status = lekalo_command(static_cast<int>(all.size()), argv.data());
  std::cout.flush();
  std::fflush(nullptr);
  _exit(status);
#else
  execv(argv[0], argv.data());
  _exit(127);
#endif
}

void Program::send_when_caught(int signal_number) const {
  while (running() && !catches(signal_number)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process_, signal_number);
}

void Program::send_after_work(int signal_number, double seconds) const {
  while (running() && !(catches(signal_number) && used() >= seconds))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process_, signal_number);
}

double Program::used() const {
  std::ifstream file("/proc/" + std::to_string(process_) + "/stat");
  std::string words;
  std::getline(file, words);
  std::istringstream fields(words.substr(std::min(words.size(), words.rfind(')') + 1)));
  std::string field;
  double ticks = 0;
  constexpr int kUser = 12, kSystem = 13;  // behind the name, where the state is the first
  for (int k = 1; k <= kSystem && fields >> field; ++k)
    if (k >= kUser) ticks += std::stod(field);
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

Ran Program::wait() {
  int state = 0;
  waitpid(process_, &state, 0);
  return {WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state), read_bytes(streams_ / "out"),
          read_bytes(streams_ / "err")};
}

std::string Program::status_field(const std::string& name) const {
  std::ifstream lines("/proc/" + std::to_string(process_) + "/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(name + ":\t", 0) == 0) return line.substr(name.size() + 2);
  }
  return {};
}

bool Program::running() const {
  const std::string state = status_field("State");
  return !state.empty() && state.front() != 'Z';
}

bool Program::catches(int signal_number) const {
  const auto caught = std::strtoull(("0x0" + status_field("SigCgt")).c_str(), nullptr, 16);
  return (caught >> (signal_number - 1) & 1) != 0;
}

Ran run(const fs::path& folder, const Words& words) { return Program(folder, words).wait(); }

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

fs::path example(int number, const std::string& role) {
  return fs::path(cases::source_dir()) / "examples/localisation" /
         ("example-" + std::to_string(number) + "-" + role + ".csv");
}

Words locate_example(int number) {
  return {"locate", "--part", example(number, "part").string(), "--blank", example(number, "blank").string()};
}

void write_plate(const TemporaryFolder& folder) {
  write_bytes(folder / "part.csv", kPlate);
  write_bytes(folder / "blank.csv", kPlateBlank);
  write_bytes(folder / "part.nc", kPlateProgram);
}

std::string without_run(const std::string& result) { return result.substr(0, result.rfind("\"run\"")); }

}  // namespace lekalo::test
