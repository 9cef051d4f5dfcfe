#include <fmt/core.h>

#include "export_word_taker.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::io::detail {
namespace {

constexpr double kSwivelAbove = 5, kLiftAbove = 20;  ///< degrees

}  // namespace

bool is_knife_word(const std::string& name) {
  return name == "blade-offset" || name == "turn-above" || name == "overcut" || name == "knife-tolerance";
}

bool is_knife(const std::string& process) { return process == "drag-knife" || process == "tangential-knife"; }

Result<void> ExportWordTaker::process(const ExportWord& word) {
  const std::string& kind = word.second;
  if (request_.form == ExportForm::hpgl && is_knife(kind)) {
    knife_.kind = kind == "drag-knife" ? nc::KnifeKind::drag : nc::KnifeKind::tangential;
    return {};
  }
  nc::Process& to = request_.profile.process;
  if (kind == "laser")
    to = nc::Process::laser;
  else if (kind == "plasma" || kind == "waterjet")
    to = nc::Process::plasma;
  else if (kind == "router")
    to = nc::Process::router;
  else if (!is_knife(kind))
    return none_of(word, "laser, plasma, waterjet, router, drag-knife, tangential-knife");
  if (is_knife(kind) || request_.form == ExportForm::hpgl)
    return failure(ErrorCode::usage, fmt::format("{} {} has a meaning for the form {} alone",
                                                 shown_("process"), kind, is_knife(kind) ? "hpgl" : "gcode"));
  return {};
}

Result<void> ExportWordTaker::knife_number(const ExportWord& word) {
  if (word.first == "blade-offset") return number(word, 0.05, 10, knife_.offset_mm);
  if (word.first == "overcut") return number(word, 0, 100, knife_.overcut_mm);
  if (word.first == "knife-tolerance") return number(word, 0.02, 10, knife_.tolerance_mm);
  LEKALO_CHECK(number(word, 1, 90, knife_.turn_above));
  knife_.turn_above *= kDegree;
  return {};
}

void ExportWordTaker::complete_knife(std::vector<std::string>& complaints) {
  if (!was_given("process")) {
    for (const std::string& name : given_)
      if (is_knife_word(name))
        complaints.push_back(
            fmt::format("{} has a meaning for knives alone: {} drag-knife or tangential-knife", shown_(name),
                        shown_("process")));
    return;
  }
  const bool drags = knife_.kind == nc::KnifeKind::drag;
  if (drags && !was_given("blade-offset"))
    complaints.push_back(fmt::format("{} is missing: how far a drag knife's tip is behind its axis, in mm",
                                     shown_("blade-offset")));
  if (!drags && was_given("blade-offset"))
    complaints.push_back(fmt::format("{} has a meaning for drag knives alone: {} drag-knife",
                                     shown_("blade-offset"), shown_("process")));
  if (!was_given("turn-above")) knife_.turn_above = kDegree * (drags ? kSwivelAbove : kLiftAbove);
  request_.knife = knife_;
}

}  // namespace lekalo::io::detail
