#include "layout_claims.hpp"

#include <fmt/core.h>

#include "lekalo/verify/claims.hpp"
#include "same_layout.hpp"

namespace lekalo::verify {

std::vector<std::string> sentences(const std::vector<LayoutViolation>& violations) {
  std::vector<std::string> list;
  for (const LayoutViolation& v : violations) {
    std::string text = fmt::format("the rule {} is broken by placement {}", name_of(v.kind), v.a);
    if (v.b != 0) text += fmt::format(" and placement {}", v.b);
    if (!v.feature.empty()) text += fmt::format(" at \"{}\"", v.feature);
    list.push_back(text + fmt::format(" on \"{}\" #{}", v.stock, v.copy + 1));
  }
  return list;
}

Result<ClaimReport> verify_layout_claims(const Document& layout, const std::optional<Document>& given) {
  LEKALO_TRY(const LayoutVerdict verdict, verify_layout(layout));
  ClaimReport report;
  report.findings = sentences(verdict.violations);
  report.notes.push_back(fmt::format("every rule was rechecked for {} placements", verdict.placements));
  if (given) {
    LEKALO_TRY(const WrittenLayout written, read_layout(layout));
    LEKALO_TRY(const WrittenLayout before, read_layout(*given, true));
    for (std::string& difference : differences(written, before))
      report.findings.push_back(std::move(difference));
  }
  return report;
}

}  // namespace lekalo::verify
