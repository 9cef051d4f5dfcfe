#include "verify_command.hpp"

#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/jobs/verify.hpp"
#include "outputs.hpp"
#include "summary.hpp"
#include "verify_claims.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;

/// The path as written, from the current folder; else from the folder of the result.
std::string where_is(const std::string& path, const std::string& result_path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  const fs::path beside = fs::path(result_path).parent_path() / path;
  return fs::exists(beside, error) ? beside.string() : path;
}

/// The options that say where files are, each with the role of its file.
struct Place {
  const char *option, *role;
  std::string VerifyOptions::*path;
};
constexpr std::array<Place, 12> kPlaces{{{"--part", "part", &VerifyOptions::part},
                                         {"--blank", "blank", &VerifyOptions::blank},
                                         {"--features", "features", &VerifyOptions::features},
                                         {"--nc", "nc", &VerifyOptions::program},
                                         {"--compare", "last-result", &VerifyOptions::earlier},
                                         {"--start", "start", &VerifyOptions::start},
                                         {"--points", "points", &VerifyOptions::points},
                                         {"--nominal-blank", "nominal", &VerifyOptions::nominal},
                                         {"--certificate", "certificate", &VerifyOptions::certificate},
                                         {"--pocket", "pocket", &VerifyOptions::pocket},
                                         {"--program", "program", &VerifyOptions::cut_program},
                                         {"--layout", "layout", &VerifyOptions::layout}}};

std::string given_instead(const VerifyOptions& o, const std::string& role) {
  for (const Place& place : kPlaces)
    if (role == place.role) return o.*place.path;
  return "";
}

/// A file of the result, where an option says or where the result does; none where the result says and there
/// is none. A program or a table that was written may have gone from where an option says, too.
Result<std::optional<jobs::File>> find(const VerifyOptions& o, const std::string& role,
                                       const std::string& path) {
  const std::string instead = given_instead(o, role);
  const std::string place = instead.empty() ? where_is(path, o.result) : instead;
  std::error_code error;
  const bool written = role == "NC program" || role == "work offset" || role == "deviations";
  if ((written || instead.empty()) && fs::status(place, error).type() == fs::file_type::not_found)
    return std::nullopt;
  LEKALO_TRY(std::string bytes, disk::read_file(place));
  return jobs::File{place, std::move(bytes)};
}

/// Refuses an option for a file that the result does not name.
Result<void> check_words(const VerifyOptions& o, const std::string& result_bytes) {
  for (const Place& place : kPlaces) {
    if ((o.*place.path).empty()) continue;
    LEKALO_TRY(const io::WrittenResult result, io::read_result(result_bytes, o.result));
    const bool named = place.role == std::string_view("certificate") ? result.certificate_file.has_value()
                                                                     : result.input(place.role) != nullptr;
    if (!named)
      return failure(ErrorCode::usage,
                     fmt::format("{}: the result {} names no {} file", place.option, o.result, place.role));
  }
  return {};
}

int exit_status_of(verify::Verdict verdict) {
  switch (verdict) {
    case verify::Verdict::confirmed:
      return 0;
    case verify::Verdict::incomplete:
    case verify::Verdict::stated_regions:
    case verify::Verdict::unproved:
      return 1;
    case verify::Verdict::refuted:
      return 4;
  }
  return 4;
}

/// A solid that is not inside has no clearance.
const char* sentence_of(verify::Verdict verdict, bool has_clearance) {
  switch (verdict) {
    case verify::Verdict::confirmed:
      return has_clearance ? "Confirmed: the clearance and the bound hold.\n"
                           : "Confirmed: the part is not inside there, and the bound holds.\n";
    case verify::Verdict::incomplete:
      return has_clearance
                 ? "Incomplete: the clearance and the bound hold, but not everything was rechecked.\n"
                 : "Incomplete: the part is not inside there, and the bound holds, but not everything was "
                   "rechecked.\n";
    case verify::Verdict::stated_regions:
      return "Confirmed for the stated regions: how a file became its region was not rechecked.\n";
    case verify::Verdict::unproved:
      return has_clearance
                 ? "Unproved: the clearance holds, but there is no certificate for a bound.\n"
                 : "Unproved: the part is not inside there, and there is no certificate for a bound.\n";
    case verify::Verdict::refuted:
      return "Refuted: something in this result is not true.\n";
  }
  return "";
}

std::string words(const verify::LocateReport& report) {
  std::string text = sentence_of(report.verdict, !report.clearance_low.empty());
  for (const std::string& finding : report.findings) text += "  not true           " + finding + "\n";
  if (!report.clearance_low.empty())
    text += fmt::format("  exact allowance    between {} and {} mm\n", report.clearance_low,
                        report.clearance_high);
  if (!report.bound_high.empty())
    text += fmt::format("  bound              at most {} mm by {} certificate intervals\n", report.bound_high,
                        report.intervals);
  for (const std::string& note : report.notes) text += "  note               " + note + "\n";
  return text;
}

}  // namespace

Result<int> run_verify(const VerifyOptions& o) {
  LEKALO_TRY(const std::string bytes, disk::read_file(o.result));
  const jobs::FileFinder finder = [&](const std::string& role, const std::string& path) {
    return find(o, role, path);
  };
  LEKALO_TRY(const verify::Kind kind, verify::kind_of({o.result, bytes}));
  if (kind != verify::Kind::placement) return verify_other(o, bytes, kind, finder);
  LEKALO_CHECK(check_words(o, bytes));
  LEKALO_TRY(const jobs::Verified verified, jobs::verify({o.result, bytes}, finder));
  if (o.json) LEKALO_CHECK(print(verified.json));
  tell(words(verified.report));
  return exit_status_of(verified.report.verdict);
}

}  // namespace lekalo::cli
