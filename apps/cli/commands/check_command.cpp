#include "check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/verify/layout.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;
using layout::Document;
using layout::Violation;
using layout::ViolationKind;

/// What both checkers say, in one form.
using Finding = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string, std::int64_t, std::string>;

std::vector<Finding> findings_of(const Document& document, const std::vector<Violation>& violations) {
  std::vector<Finding> findings;
  for (const Violation& v : violations)
    findings.emplace_back(name_of(v.kind), v.a, v.b, document.stocks[v.stock].id, v.copy,
                          feature_id(document, v));
  std::sort(findings.begin(), findings.end());
  return findings;
}

std::vector<Finding> findings_of(const verify::LayoutVerdict& verdict) {
  std::vector<Finding> findings;
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

/// Findings that only one of the two has.
std::vector<std::string> disagreements(const std::vector<Finding>& engine,
                                       const std::vector<Finding>& checker) {
  std::vector<std::string> texts;
  std::vector<Finding> only;
  std::set_difference(engine.begin(), engine.end(), checker.begin(), checker.end(), std::back_inserter(only));
  for (const Finding& finding : only) texts.push_back("only the engine finds " + text_of(finding));
  only.clear();
  std::set_difference(checker.begin(), checker.end(), engine.begin(), engine.end(), std::back_inserter(only));
  for (const Finding& finding : only)
    texts.push_back("only the independent checker finds " + text_of(finding));
  return texts;
}

std::string sentence(const Document& document, const Violation& v) {
  const auto part_of = [&](std::uint64_t id) {
    const auto at = std::find_if(document.placements.begin(), document.placements.end(),
                                 [&](const layout::Placement& placement) { return placement.id == id; });
    return fmt::format("{} (placement {})", document.parts[at->part].id, id);
  };
  const std::string feature = feature_id(document, v);
  std::string text;
  switch (v.kind) {
    case ViolationKind::overlap:
      text = fmt::format("{} overlaps {}", part_of(v.a), part_of(v.b));
      break;
    case ViolationKind::gap:
      text = fmt::format("{} is too near to {}", part_of(v.a), part_of(v.b));
      break;
    case ViolationKind::outside:
      text = fmt::format("{} reaches out of the material", part_of(v.a));
      break;
    case ViolationKind::border_gap:
      text = fmt::format("{} is too near to the border", part_of(v.a));
      break;
    case ViolationKind::defect:
      text = fmt::format("{} covers defect {}", part_of(v.a), feature);
      break;
    case ViolationKind::defect_gap:
      text = fmt::format("{} is too near to defect {}", part_of(v.a), feature);
      break;
    case ViolationKind::quality:
      text = fmt::format("{} reaches into zone {}, which is too bad for it,", part_of(v.a), feature);
      break;
    case ViolationKind::rotation:
      text = fmt::format("{} is turned to an angle it may not have", part_of(v.a));
      break;
    case ViolationKind::mirror:
      text = fmt::format("{} is mirrored and may not be", part_of(v.a));
      break;
    case ViolationKind::grain:
      text = fmt::format("{} lies off the grain", part_of(v.a));
      break;
    case ViolationKind::stock:
      text = fmt::format("{} lies on a copy of the stock that is not there", part_of(v.a));
      break;
  }
  if (v.amount_mm > 0) text += fmt::format(" by {} mm", decimals_up(v.amount_mm, 6));
  text += fmt::format(" at ({:.3f}, {:.3f}) on {}", v.at.x, v.at.y, document.stocks[v.stock].id);
  if (document.stocks[v.stock].count > 1) text += fmt::format(" #{}", v.copy + 1);
  if (v.direction.x != 0 || v.direction.y != 0)
    text += fmt::format("; the way out is ({:.3f}, {:.3f})", v.direction.x, v.direction.y);
  return text;
}

}  // namespace

Result<int> run_check(const CheckOptions& o) {
  const Result<LayoutInput> input = read_layout_input(o.source, {{"--picture", o.picture}});
  if (!input) return tl::unexpected(input.error());
  const std::vector<Violation> violations = layout::check(input->document);
  Result<verify::LayoutVerdict> verdict = verify::verify_layout({o.source.path, input->text});
  // A layout written by hand may leave to lekalo what the checker does not take from it: polygons of curves,
  // pairs of angles.
  if (!verdict) verdict = verify::verify_layout({o.source.path, io::write_layout(input->document)});
  if (!verdict)
    return failure(ErrorCode::refuted,
                   "the independent checker refuses this layout: " + verdict.error().message);
  const std::vector<std::string> doubts =
      disagreements(findings_of(input->document, violations), findings_of(*verdict));
  const bool agree = doubts.empty(), valid = violations.empty();

  disk::AtomicFiles files;
  if (!o.picture.empty()) {
    const layout::Completeness completeness = layout::completeness(layout::Workspace(input->document));
    const Result<std::string> picture =
        picture_bytes(o.picture, o.source.path, input->document, completeness, violations);
    if (!picture) return tl::unexpected(picture.error());
    if (Result<void> done = files.add(o.picture, *picture); !done) return tl::unexpected(done.error());
  }
  if (o.json) {
    Json json = begin_layout_json("lekalo-check",
                                  !agree  ? "refuted"
                                  : valid ? "valid"
                                          : "violations",
                                  *input);
    json["valid"] = valid && agree;
    json["checked_by"] = {"engine", "verify"};
    json["disagreements"] = doubts;
    json["violations"] = Json::parse(io::violations_json(input->document, violations));
    json["run"] = Json::object();
    if (Result<void> done = print(dumped(json)); !done) return tl::unexpected(done.error());
  }
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());

  std::string text = notes(input->notices);
  const std::size_t count = input->document.placements.size();
  const std::string placements = counted(count, "placement");
  if (!agree)
    text +=
        "The engine and the independent checker do not agree; trust neither, and please report this file.\n";
  else if (count == 0)
    text += "Nothing is placed, so no rule is broken.\n";
  else if (valid)
    text += fmt::format("Valid: {}, no rule is broken; confirmed by the independent checker.\n", placements);
  else
    text += fmt::format("Not valid: {} among {}; the independent checker finds the same.\n",
                        counted(violations.size(), "violation"), placements);
  for (const std::string& doubt : doubts) text += "  " + doubt + "\n";
  constexpr std::size_t kMostLines = 200;
  for (std::size_t i = 0; i < std::min(violations.size(), kMostLines); ++i)
    text += fmt::format("  {}  {}\n", i + 1, sentence(input->document, violations[i]));
  if (violations.size() > kMostLines)
    text += fmt::format("  and {} more; --json lists all\n", violations.size() - kMostLines);
  if (!o.picture.empty()) text += fmt::format("Written: {}\n", o.picture);
  tell(text);
  return !agree ? exit_status(ErrorCode::refuted) : valid ? 0 : 1;
}

}  // namespace lekalo::cli
