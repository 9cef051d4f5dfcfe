#pragma once

// LinuxCNC's interpreter as a test oracle: runs programs and compares the canonical motions of an original
// with those of its rewritten form. See rs274.sh for where it comes from.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "lekalo/io/text/sha256.hpp"

namespace rs274 {

/// One call of the interpreter's canonical interface.
struct Call {
  std::string name;
  std::string arguments;
  std::vector<double> numbers;  ///< those of a motion
  double unit = 1;              ///< millimetres in the unit of its numbers
  char plane = 'Z';             ///< the axis across the plane of an arc

  [[nodiscard]] bool straight() const { return name == "STRAIGHT_FEED" || name == "STRAIGHT_TRAVERSE"; }
  [[nodiscard]] bool arc() const { return name == "ARC_FEED"; }
  [[nodiscard]] bool upright() const { return arc() && plane != 'Z'; }
  /// x, y, z where a motion ends.
  [[nodiscard]] std::array<double, 3> end() const {
    const auto n = [&](std::size_t k) { return numbers.at(k); };
    if (!arc()) return {n(0), n(1), n(2)};
    if (plane == 'Y') return {n(1), n(5), n(0)};
    return plane == 'X' ? std::array{n(5), n(0), n(1)} : std::array{n(0), n(1), n(5)};
  }
};

struct Run {
  bool accepted = false;
  std::vector<Call> calls;
  std::string errors;
};

/// A folder that goes away with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lekalo-rs274-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

class Oracle {
 public:
  /// Fetches and unpacks the interpreter when it is missing; throws with the script's words when that fails,
  /// so that no comparison is ever skipped in silence.
  explicit Oracle(std::string script) : script_(std::move(script)) {
    const auto [status, folder, errors] = shell("'" + script_ + "' prepare");
    if (status != 0) throw std::runtime_error(errors);
    root_ = folder.substr(0, folder.find('\n'));
  }

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }

  /// With LEKALO_RS274_ANSWERS=FOLDER answers are kept there, so that a program is run once.
  [[nodiscard]] Run run(const std::string& program) const {
    const auto [status, output, errors] = answer(program);
    Run result;
    result.accepted = status == 0;
    result.errors = errors;
    double unit = 1;
    char plane = 'Z';
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);)
      if (std::optional<Call> call = parse(line, unit)) {
        if (call->name == "SELECT_PLANE")
          plane = call->arguments.find("XY") != std::string::npos   ? 'Z'
                  : call->arguments.find("XZ") != std::string::npos ? 'Y'
                                                                    : 'X';
        call->plane = plane;
        result.calls.push_back(std::move(*call));
      }
    return result;
  }

 private:
  struct Output {
    int status;
    std::string out, errors;
  };

  Output answer(const std::string& program) const {
    const char* const folder = std::getenv("LEKALO_RS274_ANSWERS");
    if (folder == nullptr) return interpreted(program);
    const std::filesystem::path kept = std::filesystem::path(folder) / lekalo::io::sha256(program);
    if (std::ifstream file(kept, std::ios::binary); file) {
      Output output{};
      std::size_t size = 0;
      file >> output.status >> size;
      file.get();
      output.out.resize(size);
      file.read(output.out.data(), static_cast<std::streamsize>(size));
      output.errors.assign(std::istreambuf_iterator<char>(file), {});
      return output;
    }
    Output output = interpreted(program);
    const std::filesystem::path made = scratch_.path() / "answer";
    std::ofstream(made, std::ios::binary) << output.status << ' ' << output.out.size() << '\n'
                                          << output.out << output.errors;
    std::error_code ignored;  // of another file system: then nothing is kept
    std::filesystem::rename(made, kept, ignored);
    return output;
  }

  Output interpreted(const std::string& program) const {
    const std::filesystem::path file = scratch_.path() / "program.ngc";
    std::ofstream(file, std::ios::binary) << program;
    return shell("'" + script_ + "' run '" + scratch_.path().string() + "' '" + file.string() + "'");
  }

  Output shell(const std::string& command) const {
    const std::filesystem::path errors = scratch_.path() / "errors.txt";
    FILE* pipe = popen((command + " 2>'" + errors.string() + "'").c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string out;
    std::array<char, 65536> buffer{};
    for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      out.append(buffer.data(), n);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out, read_file(errors)};
  }

  /// `   12 N0040  STRAIGHT_FEED(1.0000, 2.0000, ...)`
  static std::optional<Call> parse(const std::string& line, double& unit) {
    const std::size_t open = line.find('(');
    if (open == std::string::npos) return std::nullopt;
    std::size_t name = line.find_last_of(" \t", open) + 1;
    // A long N runs into the name behind it.
    const std::size_t digits = line.find_first_not_of("0123456789", name + 1);
    if (line[name] == 'N' && digits > name + 1) name = digits;
    Call call{line.substr(name, open - name), line.substr(open), {}, unit};
    if (call.name == "USE_LENGTH_UNITS") unit = call.arguments.find("INCHES") != std::string::npos ? 25.4 : 1;
    std::string numbers = call.arguments;
    for (char& c : numbers)
      if (c == '(' || c == ')' || c == ',') c = ' ';
    std::istringstream stream(numbers);
    for (double value = 0; stream >> value;) call.numbers.push_back(value);
    return call;
  }

  std::string script_;
  ScratchFolder scratch_;
  std::filesystem::path root_;
};

/// A rigid motion of the plane, and for solids a shift along Z, millimetres.
struct PlaneMotion {
  double x = 0, y = 0, theta = 0, z = 0;

  [[nodiscard]] std::array<double, 2> operator()(double px, double py) const {
    return {std::cos(theta) * px - std::sin(theta) * py + x, std::sin(theta) * px + std::cos(theta) * py + y};
  }
};

/// Compares two runs call by call. The written one's announced work offset and rotation are applied when
/// `announced_frame` is set (its positions ignore them); else they must be the same as the original's.
class Comparison {
 public:
  /// \param homes  the programs go to points of the machine, which rs274 has at 0, 0, wherever the part lies
  Comparison(PlaneMotion pose, double tolerance_units, bool announced_frame, bool homes = false)
      : pose_(pose), tolerance_(tolerance_units), announced_(announced_frame), homes_(homes) {}

  /// What differs first; empty when nothing does.
  std::string difference(const Run& original, const Run& written) {
    if (original.accepted != written.accepted)
      return original.accepted ? "the rewritten program is not accepted: " + written.errors
                               : "only the original is not accepted: " + original.errors;
    const std::vector<Call> a = relevant(original.calls, false), b = relevant(written.calls, true);
    std::size_t next = 0;
    for (const Call& call : a) {
      if (next == b.size()) return "the rewritten program has fewer calls";
      const Call& other = b[next];
      const std::string what =
          call.upright() && other.straight() ? differ_from_chords(call, b, next) : differ(call, b[next++]);
      if (!what.empty())
        return what + "\n  " + call.name + call.arguments + "\n  " + other.name + other.arguments;
      if (call.straight() || call.arc()) at_ = call.end();
    }
    return next == b.size() ? "" : "the rewritten program has more calls";
  }

  std::size_t motions = 0;   ///< compared
  double largest_units = 0;  ///< deviation seen, in the unit of the program

 private:
  /// Drops what only tells of the interpreter's state, and follows the announced frame into the calls.
  std::vector<Call> relevant(const std::vector<Call>& calls, bool is_written) const {
    std::vector<Call> kept;
    PlaneMotion frame;
    for (Call call : calls) {
      // Comments may stand for calls and assignments, and chords need another plane; neither moves.
      if (call.name == "USE_LENGTH_UNITS" || call.name == "COMMENT" || call.name == "SELECT_PLANE") continue;
      if (announced_ && call.name == "SET_G5X_OFFSET") {
        frame.x = call.numbers.at(1) * call.unit;
        frame.y = call.numbers.at(2) * call.unit;
        if (pose_.z != 0) frame.z = call.numbers.at(3) * call.unit;
        continue;
      }
      if (announced_ && call.name == "SET_XY_ROTATION") {
        frame.theta = call.numbers.at(0) * 3.14159265358979323846 / 180;
        continue;
      }
      if (announced_ && is_written && (call.straight() || call.arc())) place(frame, call);
      kept.push_back(std::move(call));
    }
    return kept;
  }

  /// An arc outside the XY plane is only ever shifted.
  static void place(const PlaneMotion& frame, Call& call) {
    for (const std::size_t k : heights(call)) call.numbers.at(k) += frame.z / call.unit;
    if (call.upright()) {
      const double x = frame.x / call.unit, y = frame.y / call.unit;
      for (const std::size_t k : {0U, 2U})
        call.numbers[call.plane == 'Y' ? k + 1 : k] += call.plane == 'Y' ? x : y;
      call.numbers[5] += call.plane == 'Y' ? y : x;
      return;
    }
    move(frame, call, 0);
    if (call.arc()) move(frame, call, 2);
  }
  /// The numbers that are heights: of an upright arc that of the end and that of the middle.
  static std::vector<std::size_t> heights(const Call& call) {
    if (call.straight()) return {2};
    if (!call.upright()) return {5};
    return call.plane == 'Y' ? std::vector<std::size_t>{0, 2} : std::vector<std::size_t>{1, 3};
  }
  /// A rapid before the first word in Z, or from a point of the machine, is at a height that nothing shifts.
  [[nodiscard]] bool stays_up(const Call& a, const Call& b, std::size_t k) const {
    return pose_.z != 0 && k == 2 && a.name == "STRAIGHT_TRAVERSE" &&
           std::abs(a.numbers[k] - b.numbers[k]) <= tolerance_;
  }
  static void move(const PlaneMotion& motion, Call& call, std::size_t at) {
    const auto moved = motion(call.numbers.at(at) * call.unit, call.numbers.at(at + 1) * call.unit);
    call.numbers[at] = moved[0] / call.unit;
    call.numbers[at + 1] = moved[1] / call.unit;
  }

  std::string differ(const Call& a, const Call& b) {
    if (a.name != b.name) return "different calls";
    // Under G93 rs274 computes the feed from the length of the way, which the last decimals change.
    if (a.name == "SET_FEED_RATE" && std::abs(a.numbers.at(0) - b.numbers.at(0)) <= 1e-4 * a.numbers.at(0))
      return "";
    if (!a.straight() && !a.arc()) return a.arguments == b.arguments ? "" : "different arguments";
    if (a.unit != b.unit) return "different units";
    // Until the first words in X and Y the machine stands where it was switched on, whatever the frame.
    const bool resting = a.straight() && a.numbers.at(0) == 0 && a.numbers.at(1) == 0;
    const double rise = a.straight() ? b.numbers.at(2) - a.numbers.at(2) : 0;
    if (!placed_ && resting && rests(b))
      return rise == 0 || (pose_.z != 0 && std::abs(rise - pose_.z / a.unit) <= tolerance_) ? ""
                                                                                            : "different Z";
    if (homes_ && resting && a.name == "STRAIGHT_TRAVERSE" && a.numbers == b.numbers) return "";
    placed_ = true;
    ++motions;
    Call image = a;
    place(pose_, image);
    for (std::size_t k = 0; k < image.numbers.size(); ++k) {
      const double off = std::abs(image.numbers[k] - b.numbers.at(k));
      const bool shifted = k == 2 && a.straight() ? pose_.z != 0 : k == 5 && pose_.z != 0;
      const bool in_plane = k < 2 || (a.arc() && k < 4) || (a.upright() && k == 5) || shifted;
      if (shifted && stays_up(a, b, k)) continue;
      if (in_plane) largest_units = std::max(largest_units, off);
      if (!(off <= (in_plane ? tolerance_ : 0))) return "different positions";
    }
    return "";
  }

  /// Lines that stand for an arc, each end and middle near the point of the arc at the same share.
  std::string differ_from_chords(const Call& a, const std::vector<Call>& b, std::size_t& next) {
    const bool zx = a.plane == 'Y';
    const std::size_t first = zx ? 2 : 1, second = zx ? 0 : 2, across = zx ? 1 : 0;
    const std::array<double, 3> end = a.end();
    const double u = a.numbers.at(2), v = a.numbers.at(3), turns = a.numbers.at(4);
    const double pi = 3.14159265358979323846, way = turns > 0 ? 1 : -1;
    const double r0 = std::hypot(at_[first] - u, at_[second] - v),
                 r1 = std::hypot(end[first] - u, end[second] - v);
    const double begin = std::atan2(at_[second] - v, at_[first] - u);
    double sweep = way * (std::atan2(end[second] - v, end[first] - u) - begin);
    while (sweep <= 1e-4) sweep += 2 * pi;
    sweep += 2 * pi * (std::abs(turns) - 1);
    const auto point = [&](double share) {
      std::array<double, 3> p = at_;
      const double angle = begin + way * share * sweep, radius = r0 + share * (r1 - r0);
      p[first] = u + radius * std::cos(angle), p[second] = v + radius * std::sin(angle);
      p[across] += share * (end[across] - at_[across]);
      return share == 1 ? end : p;
    };
    const double near = tolerance_ + 1.1e-3 / a.unit;
    const auto off = [&](const std::array<double, 3>& p, const std::array<double, 3>& q) {
      const auto image = pose_(p[0] * a.unit, p[1] * a.unit);
      return std::hypot(std::hypot(image[0] / a.unit - q[0], image[1] / a.unit - q[1]),
                        p[2] + pose_.z / a.unit - q[2]);
    };
    std::size_t last = next;
    while (last < b.size() && b[last].straight() && !(off(end, b[last].end()) <= tolerance_ * 2)) ++last;
    if (last == b.size() || !b[last].straight()) return "no chords end where the arc ends";
    const auto count = static_cast<double>(last + 1 - next);
    std::array<double, 3> before = b[next].end();
    for (std::size_t k = 0; next <= last; ++next, ++k) {
      const std::array<double, 3> here = b[next].end();
      if (b[next].name != "STRAIGHT_FEED") return "a chord that is no feed";
      if (!(off(point(static_cast<double>(k + 1) / count), here) <= near)) return "a chord off the arc";
      const std::array<double, 3> middle{(before[0] + here[0]) / 2, (before[1] + here[1]) / 2,
                                         (before[2] + here[2]) / 2};
      if (k > 0 && !(off(point((static_cast<double>(k) + 0.5) / count), middle) <= near))
        return "a chord whose middle is off the arc";
      before = here;
    }
    ++motions;
    placed_ = true;
    return "";
  }

  bool rests(const Call& b) const {
    if (!announced_) return b.numbers.at(0) == 0 && b.numbers.at(1) == 0;
    // Before its first move a machine at rest has other coordinates in another frame: LinuxCNC keeps (0, 0).
    return true;
  }

  std::array<double, 3> at_{};  ///< of the original
  PlaneMotion pose_;
  double tolerance_;
  bool announced_;
  bool homes_;
  bool placed_ = false;
};

}  // namespace rs274
