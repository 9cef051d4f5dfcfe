#include "lekalo/jobs/check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <vector>

#include "jobs/document/report_document.hpp"
#include "layout_json.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/verify/layout.hpp"

namespace lekalo::jobs {
namespace {

/// A violation in the form that both checkers have: kind, placements, stock, copy, feature.
using Finding = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string, std::int64_t, std::string>;
using Findings = std::vector<Finding>;

Findings findings_of(const layout::Document& document, const std::vector<layout::Violation>& violations) {
  Findings findings;
  for (const layout::Violation& v : violations)
    findings.emplace_back(name_of(v.kind), v.a, v.b, document.stocks[v.stock].id, v.copy,
                          feature_id(document, v));
  std::sort(findings.begin(), findings.end());
  return findings;
}

Findings findings_of(const verify::LayoutVerdict& verdict) {
  Findings findings;
  for (const verify::LayoutViolation& v : verdict.violations)
    findings.emplace_back(name_of(v.kind), v.a, v.b, v.stock, v.copy, v.feature);
  std::sort(findings.begin(), findings.end());
  return findings;
}

std::string text_of(const Finding& finding) {
  const auto& [kind, a, b, stock, copy, feature] = finding;
  std::string text = fmt::format("{}: placement {}", kind, a);
  if (b != 0) text += fmt::format(" and {}", b);
  if (!feature.empty()) text += fmt::format(" at '{}'", feature);
  return text + fmt::format(" on '{}' #{}", stock, copy + 1);
}

/// Adds the sorted findings of one checker that the other does not have.
void add_missing(const Findings& one, const Findings& other, const char* who, std::vector<std::string>& to) {
  Findings only;
  std::set_difference(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(only));
  for (const Finding& finding : only) to.push_back(fmt::format("only {} finds {}", who, text_of(finding)));
}

}  // namespace

Result<Checked> check(const Layout& layout) {
  Checked checked;
  Result<verify::LayoutVerdict> verdict;
  share_out(2, kUsualThreads, [&](std::size_t task) {
    if (task == 0) verdict = verify::verify_layout({layout.name, layout_bytes(layout)});
    if (task == 1) checked.violations = layout::check(layout.document);
  });
  if (!verdict) verdict = verify::verify_layout({layout.name, io::write_layout(layout.document)});
  if (!verdict)
    return failure(ErrorCode::refuted,
                   "the independent checker refuses this layout: " + verdict.error().message);
  const Findings engine = findings_of(layout.document, checked.violations), checker = findings_of(*verdict);
  add_missing(engine, checker, "the engine", checked.disagreements);
  add_missing(checker, engine, "the independent checker", checked.disagreements);
  return checked;
}

std::string check_json(const Layout& layout, const Checked& checked) {
  const char* const status = !checked.agree() ? "refuted" : checked.valid() ? "valid" : "violations";
  io::JsonWriter json =
      begin_layout_json("lekalo-check", status, layout, 0, layout.document.placements.size());
  json.field("valid", checked.valid()).key("checked_by").list({"engine", "verify"});
  json.key("disagreements").list(checked.disagreements);
  io::write_violations(json.key("violations"), layout.document, checked.violations);
  json.key("run").object({});
  return end_document(json);
}

Result<void> confirm_layout(const layout::Document& document, std::string_view bytes) {
  std::vector<layout::Violation> violations;
  Result<verify::LayoutVerdict> verdict;
  share_out(2, kUsualThreads, [&](std::size_t task) {
    if (task == 0) verdict = verify::verify_layout({"the layout found", bytes});
    if (task == 1) violations = layout::check(document);
  });
  if (!violations.empty())
    return failure(ErrorCode::refuted,
                   fmt::format("the layout found breaks a rule ({}), so it was withheld; please report it",
                               layout::name_of(violations[0].kind)));
  if (!verdict) return failure(ErrorCode::refuted, verdict.error().message);
  if (!verdict->violations.empty())
    return failure(
        ErrorCode::refuted,
        fmt::format("the independent checker finds a broken rule ({}) in the layout found, so it was "
                    "withheld; please report it",
                    verify::name_of(verdict->violations[0].kind)));
  return {};
}

}  // namespace lekalo::jobs
