#include "program_check.hpp"

#include <fmt/core.h>

#include "verify/pocket/moved_program.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

WrittenNc read_written_nc(Json value, std::string& complaint) {
  Fields nc(value, "nc", complaint);
  return {nc.number("clearance"), nc.number("rounding_mm"), nc.text("mode"), nc.index("work_offset")};
}

bool check_program(const LocateInputs& inputs, const WrittenNc& nc, const Decimal& x, const Decimal& y,
                   const Decimal& theta, LocateReport& report) {
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
  const ProgramVerdict verdict = check_moved_program(
      {*inputs.program, *inputs.written_program, x, y, theta, nc.rounding_mm, nc.mode, nc.work_offset});
  if (verdict.fault)
    report.findings.push_back(fmt::format("the program {} is not {}, moved: {}", inputs.written_program->name,
                                          inputs.program->name, *verdict.fault));
  return !verdict.open || leave_open(*verdict.open);
}

}  // namespace lekalo::verify
