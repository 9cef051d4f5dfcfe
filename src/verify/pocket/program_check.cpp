#include "program_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "verify/read/fields.hpp"

namespace lekalo::verify {

WrittenNc read_written_nc(Json value, std::string& complaint) {
  Fields nc(value, "nc", complaint);
  WrittenNc written{nc.number("clearance"), nc.number("rounding_mm"), nc.text("mode"),
                    nc.index("work_offset")};
  if (nc.get("control").text.empty()) return written;
  const std::string word = nc.text("control");
  if (const auto control = words::control_named(word))
    written.control = *control;
  else
    nc.complain(fmt::format("there is no control \"{}\"", excerpt(word)));
  return written;
}

namespace {

/// Reads a list of M words, one a line, with remarks behind `#`, `;` or `(`. Nothing where it is no such
/// list.
std::optional<std::vector<int>> allowed_words(std::string_view text) {
  std::vector<int> allowed;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string word;
    for (const char c : text.substr(0, std::min(end, text.find_first_of("#;("))))
      if (std::string_view(" \t\r").find(c) == std::string_view::npos) word += c;
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    int number{};
    const char* const last = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + 1, last, number);
    if (std::string_view("Mm").find(word[0]) == std::string_view::npos || error != std::errc() ||
        stop != last || number < 0)
      return std::nullopt;
    allowed.push_back(number);
  }
  return allowed;
}

}  // namespace

bool check_program(const LocateInputs& inputs, const WrittenNc& nc, const ProgramPose& pose,
                   LocateReport& report) {
  if (!inputs.program) {
    report.findings.emplace_back("a program was written, but the result names none that it was made from");
    return true;
  }
  const auto leave_open = [&](const std::string& why) {
    report.notes.push_back(fmt::format("that the program written is {}, moved, was not rechecked: {}",
                                       inputs.program->name, why));
    return false;
  };
  if (!inputs.written_program) return leave_open("it is not there");
  const auto allowed = allowed_words(inputs.allow ? inputs.allow->bytes : "");
  if (!allowed) return leave_open(fmt::format("{} is no list of M words", inputs.allow->name));
  const ProgramVerdict verdict =
      check_moved_program({*inputs.program, *inputs.written_program, pose.x, pose.y, pose.theta,
                           nc.rounding_mm, nc.mode, nc.work_offset, nc.control, *allowed, pose.solid});
  if (verdict.fault)
    report.findings.push_back(fmt::format("the program {} is not {}, moved: {}", inputs.written_program->name,
                                          inputs.program->name, *verdict.fault));
  return !verdict.open || leave_open(*verdict.open);
}

}  // namespace lekalo::verify
