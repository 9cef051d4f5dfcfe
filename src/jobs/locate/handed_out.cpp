#include "handed_out.hpp"

#include "lekalo/io/text/words.hpp"

namespace lekalo::jobs {

std::optional<std::string> warning_of_name(const std::string& name) {
  if (io::as_utf8(name) == name) return std::nullopt;
  return "the file name " + io::as_utf8(name) +
         " is not UTF-8, so the result holds it with replaced characters and verify must be told where the "
         "file is";
}

Result<void> held_against(const Result<verify::LocateReport>& report, verify::Verdict wanted) {
  const bool left_open = report && (report->verdict == verify::Verdict::incomplete ||
                                    report->verdict == verify::Verdict::stated_regions);
  if (left_open || (report && report->verdict == wanted)) return {};
  const std::string why =
      !report ? "self-check: " + report.error().message
              : "self-check refuted the result: " +
                    (report->findings.empty() ? "the proof is not complete" : report->findings.front());
  return failure(ErrorCode::refuted,
                 why + "; no file was written, and this is a mistake of lekalo worth reporting");
}

}  // namespace lekalo::jobs
