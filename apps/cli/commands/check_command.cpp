#include "check_command.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/check.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using layout::Document;
using layout::Violation;
using layout::ViolationKind;

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

/// The findings for people; the first two hundred violations a line each.
std::string text_of(const jobs::Layout& input, const jobs::Checked& checked) {
  const std::size_t count = input.document.placements.size(), broken = checked.violations.size();
  const std::string placements = counted(count, "placement");
  std::string text = notes(input.notices);
  if (!checked.agree())
    text +=
        "The engine and the independent checker do not agree; trust neither, and please report this file.\n";
  else if (count == 0)
    text += "Nothing is placed, so no rule is broken.\n";
  else if (checked.valid())
    text += fmt::format("Valid: {}, no rule is broken; confirmed by the independent checker.\n", placements);
  else
    text += fmt::format("Not valid: {} among {}; the independent checker finds the same.\n",
                        counted(broken, "violation"), placements);
  for (const std::string& doubt : checked.disagreements) text += "  " + doubt + "\n";
  constexpr std::size_t kMostLines = 200;
  for (std::size_t i = 0; i < std::min(broken, kMostLines); ++i)
    text += fmt::format("  {}  {}\n", i + 1, sentence(input.document, checked.violations[i]));
  if (broken > kMostLines) text += fmt::format("  and {} more; --json lists all\n", broken - kMostLines);
  return text;
}

}  // namespace

Result<int> run_check(const CheckOptions& o) {
  LEKALO_TRY(const jobs::Layout input, read_layout_input(o.source, {{"--picture", o.picture}}));
  LEKALO_TRY(const jobs::Checked checked, jobs::check(input));
  disk::AtomicFiles files;
  if (!o.picture.empty()) {
    LEKALO_TRY(const std::string picture,
               picture_bytes(o.picture, o.source.path, input.document, checked.violations));
    LEKALO_CHECK(files.add(o.picture, picture));
  }
  if (o.json) LEKALO_CHECK(print(jobs::check_json(input, checked)));
  LEKALO_CHECK(files.commit());
  std::string text = text_of(input, checked);
  if (!o.picture.empty()) text += fmt::format("Written: {}\n", o.picture);
  tell(text);
  if (!checked.agree()) return exit_status(ErrorCode::refuted);
  return checked.valid() ? 0 : 1;
}

}  // namespace lekalo::cli
