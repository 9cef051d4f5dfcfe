#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Standard_Failure.hxx>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "convert.hpp"
#include "lekalo/base/plain_text.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::step {
namespace {

constexpr std::string_view kUsage =
    "lekalo-step IN.step -o OUT.ply [--deviation MM] [--seconds N] [--memory MB]\n"
    "\n"
    "Makes a mesh of the solids of a STEP file, which says how far it is from them at most. lekalo locate "
    "takes\n"
    "it as a part or as a blank.\n"
    "\n"
    "  -o OUT.ply       the mesh\n"
    "  --deviation MM   how far triangles and faces may be apart; 0.01 without\n"
    "  --seconds N      processor time that it may take; 600 without\n"
    "  --memory MB      memory that it may take; 4000 without\n";

/// Sanitizers need more addresses than there is memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

struct Options {
  std::string in, out;
  double deviation = 0.01;
  long seconds = 600, megabytes = 4000;
};

/// Text that stands in a sentence or in a comment of a PLY.
std::string shown(std::string_view text) { return std::string(is_plain_text(text) ? text : "?"); }

void complain(const std::string& sentence) {
  std::fputs(("lekalo-step: " + sentence + "\n").c_str(), stderr);
}

/// Returns nothing, and has complained, where the line says nothing that can be done.
bool read_line(int argc, char** argv, Options& o) {
  const auto number = [&](const char* text, const char* name, double least, double most, double& value) {
    char* end = nullptr;
    value = std::strtod(text, &end);
    if (end != text && *end == 0 && value >= least && value <= most) return true;
    complain(fmt::format("{} takes a number from {:g} to {:g}, not '{}'", name, least, most, text));
    return false;
  };
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    const bool has_next = k + 1 < argc;
    double value = 0;
    if (word == "-o" && has_next) {
      o.out = argv[++k];
    } else if (word == "--deviation" && has_next) {
      if (!number(argv[++k], "--deviation", 1e-6, 1e3, o.deviation)) return false;
    } else if (word == "--seconds" && has_next) {
      if (!number(argv[++k], "--seconds", 1, 1e6, value)) return false;
      o.seconds = static_cast<long>(value);
    } else if (word == "--memory" && has_next) {
      if (!number(argv[++k], "--memory", 100, 1e6, value)) return false;
      o.megabytes = static_cast<long>(value);
    } else if (!word.starts_with('-') && o.in.empty()) {
      o.in = word;
    } else {
      complain(fmt::format("'{}' is not understood; --help says what is", shown(word)));
      return false;
    }
  }
  if (!o.in.empty() && !o.out.empty()) return true;
  complain("give a STEP file and -o OUT.ply; --help says more");
  return false;
}

/// The child writes the mesh to the file, and sentences to the pipe.
int convert_file(const Options& o, int sentences) {
  const auto tell = [&](const std::string& text) {
    if (write(sentences, text.data(), text.size()) < 0) _exit(2);
  };
  std::string problem;
  try {
    std::ifstream in(o.in, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) {
      tell(fmt::format("{}: {}", o.in, std::strerror(errno)));
      return 2;
    }
    const Result<Converted> made = convert(o.in, o.deviation);
    if (made) {
      const std::string text =
          written(*made, shown(std::filesystem::path(o.in).filename().string()), io::sha256(bytes));
      std::ofstream out(o.out, std::ios::binary | std::ios::trunc);
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
      out.close();
      if (!out) {
        tell(fmt::format("{} cannot be written: {}", o.out, std::strerror(errno)));
        return 3;
      }
      for (const std::string& notice : made->notices) tell(fmt::format("{}: {}\n", o.in, notice));
      if (made->deviation > o.deviation)
        tell(fmt::format("{}: {:.3g} mm were asked for, and OCCT's triangles come no nearer than {:.3g} mm\n",
                         o.in, o.deviation, made->deviation));
      tell(fmt::format("{}: {} triangles of {} faces, within {:.3g} mm of them", o.out,
                       made->mesh.triangles.size(), made->faces.size(), made->deviation));
      return 0;
    }
    problem = made.error().message;
  } catch (const Standard_Failure& failed) {
    problem = fmt::format("OCCT cannot read it ({})", failed.DynamicType()->Name());
  } catch (const std::bad_alloc&) {
    problem = "not enough memory; --memory allows more";
  } catch (const std::exception& failed) {
    problem = fmt::format("OCCT cannot read it ({})", shown(failed.what()));
  }
  tell(fmt::format("{}: {}", o.in, problem));
  return 2;
}

/// A file that OCCT crashes or hangs on ends the child alone.
int run(const Options& o) {
  int ends[2];
  if (pipe(ends) != 0) return complain(std::strerror(errno)), 3;
  const pid_t child = fork();
  if (child < 0) return complain(std::strerror(errno)), 3;
  if (child == 0) {
    close(ends[0]);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // OCCT prints what is not for whoever called.
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    const auto limit = [](int what, rlim_t most) {
      const rlimit both{most, most};
      setrlimit(what, &both);
    };
    limit(RLIMIT_CPU, static_cast<rlim_t>(o.seconds));
    limit(RLIMIT_CORE, 0);
    if (!kSanitized) limit(RLIMIT_AS, static_cast<rlim_t>(o.megabytes) << 20);
    const int status = convert_file(o, ends[1]);
    _exit(status);
  }
  close(ends[1]);
  std::string sentences;
  char buffer[4096];
  ssize_t count = 0;
  while ((count = read(ends[0], buffer, sizeof buffer)) > 0 || (count < 0 && errno == EINTR))
    if (count > 0) sentences.append(buffer, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && !sentences.empty()) {
    complain(sentences);
    return WEXITSTATUS(status);
  }
  const bool out_of_time =
      WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  complain(out_of_time
               ? fmt::format("{}: OCCT did not come to an end in {} s; --seconds allows more, a larger "
                             "--deviation takes less, or export a mesh (STL, PLY, OBJ)",
                             o.in, o.seconds)
               : fmt::format("{}: OCCT crashed on it; export it again, or as a mesh (STL, PLY, OBJ)", o.in));
  return 2;
}

}  // namespace
}  // namespace lekalo::step

int main(int argc, char** argv) {
  if (argc == 2 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h")) {
    std::fputs(lekalo::step::kUsage.data(), stdout);
    return 0;
  }
  lekalo::step::Options options;
  if (!lekalo::step::read_line(argc, argv, options)) return 2;
  return lekalo::step::run(options);
}
