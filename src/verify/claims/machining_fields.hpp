#pragma once

#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/simulate.hpp"
#include "report_fields.hpp"

namespace lekalo::verify {

/// Reads what a report says of the tool, the stock and the machine that a program was followed for.
inline void read_machining(ReportFields& fields, SimulateOptions& options) {
  options.tool_diameter = fields.number("tool_mm");
  options.stock_to_leave = fields.number("stock_to_leave_mm");
  options.step_over = fields.number("step_over");
  options.top = fields.number("top_mm");
  options.acceleration = fields.number("acceleration_mm_per_s2");
  options.rapid_feed = fields.number("rapid_mm_per_min");
  const auto control = words::control_named(fields.text("control"));
  if (!control) fields.complain("field control is none that programs are read for");
  options.control = control.value_or(options.control);
}

}  // namespace lekalo::verify
