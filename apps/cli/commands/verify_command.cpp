#include "verify_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lekalo/base/version.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/verify/verify.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A file that a result names, as it is now.
struct FoundFile {
  std::string role, path, bytes, sha256;
};

struct Evidence {
  std::string result_bytes;
  io::WrittenResult result;
  FoundFile part, blank;
  std::optional<FoundFile> certificate;
  std::vector<std::string> mismatches, notes;
};

/// As written, from the current folder; else from the folder of the result.
std::string where_is(const std::string& path, const std::string& result_path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  const fs::path beside = fs::path(result_path).parent_path() / path;
  return fs::exists(beside, error) ? beside.string() : path;
}

Result<FoundFile> load(const std::string& role, const io::FileRecord& written, const std::string& instead,
                       const std::string& result_path, Evidence& evidence) {
  FoundFile file;
  file.role = role;
  file.path = instead.empty() ? where_is(written.path, result_path) : instead;
  Result<std::string> bytes = disk::read_file(file.path);
  if (!bytes) return tl::unexpected(bytes.error());
  file.bytes = std::move(*bytes);
  file.sha256 = io::sha256(file.bytes);
  if (file.sha256 != written.sha256) {
    evidence.mismatches.push_back(
        fmt::format("{} is not the {} file of this result: its SHA-256 is {}, not {}", file.path, role,
                    file.sha256, written.sha256));
  }
  return file;
}

Result<FoundFile> load_input(const std::string& role, const std::string& instead,
                             const std::string& result_path, Evidence& evidence) {
  const io::InputRecord* record = evidence.result.input(role);
  if (record == nullptr) {
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: \"inputs\" names no file with the role \"{}\"", result_path, role));
  }
  return load(role, record->file, instead, result_path, evidence);
}

/// The program is no evidence for the placement, but a result that names other bytes than stand there is not
/// true. One that is not there may have gone to the machine.
void check_program(const VerifyOptions& o, Evidence& evidence) {
  if (!evidence.result.nc_output) return;
  const io::FileRecord& written = *evidence.result.nc_output;
  std::error_code error;
  if (!fs::exists(where_is(written.path, o.result), error)) {
    evidence.notes.push_back(
        fmt::format("the NC program {} is not there, so it was not compared", written.path));
    return;
  }
  const Result<FoundFile> program = load("NC program", written, "", o.result, evidence);
  if (!program) evidence.notes.push_back(program.error().message);
}

Result<Evidence> gather(const VerifyOptions& o) {
  Evidence evidence;
  Result<std::string> bytes = disk::read_file(o.result);
  if (!bytes) return tl::unexpected(bytes.error());
  evidence.result_bytes = std::move(*bytes);
  Result<io::WrittenResult> result = io::read_result(evidence.result_bytes, o.result);
  if (!result) return tl::unexpected(result.error());
  evidence.result = std::move(*result);
  Result<FoundFile> part = load_input("part", o.part, o.result, evidence);
  if (!part) return tl::unexpected(part.error());
  evidence.part = std::move(*part);
  Result<FoundFile> blank = load_input("blank", o.blank, o.result, evidence);
  if (!blank) return tl::unexpected(blank.error());
  evidence.blank = std::move(*blank);
  if (evidence.result.certificate_file) {
    Result<FoundFile> certificate =
        load("certificate", *evidence.result.certificate_file, o.certificate, o.result, evidence);
    if (!certificate) return tl::unexpected(certificate.error());
    evidence.certificate = std::move(*certificate);
  } else if (!o.certificate.empty()) {
    return failure(ErrorCode::usage,
                   fmt::format("--certificate: the result {} names no certificate file", o.result));
  }
  check_program(o, evidence);
  return evidence;
}

const char* name_of(verify::Verdict verdict) {
  switch (verdict) {
    case verify::Verdict::confirmed:
      return "confirmed";
    case verify::Verdict::unproved:
      return "unproved";
    case verify::Verdict::refuted:
      return "refuted";
  }
  return "";
}

int exit_status_of(verify::Verdict verdict) {
  switch (verdict) {
    case verify::Verdict::confirmed:
      return 0;
    case verify::Verdict::unproved:
      return 1;
    case verify::Verdict::refuted:
      return 4;
  }
  return 4;
}

Json file_json(const char* role, const std::string& path, const std::string& sha256) {
  return {{"role", role}, {"path", path}, {"sha256", sha256}};
}

std::string report_json(const VerifyOptions& o, const Evidence& evidence,
                        const verify::LocateReport& report) {
  Json inputs = Json::array();
  inputs.push_back(file_json("result", o.result, io::sha256(evidence.result_bytes)));
  inputs.push_back(file_json("part", evidence.part.path, evidence.part.sha256));
  inputs.push_back(file_json("blank", evidence.blank.path, evidence.blank.sha256));
  if (evidence.certificate) {
    inputs.push_back(file_json("certificate", evidence.certificate->path, evidence.certificate->sha256));
  }
  Json json{{"format", {{"name", "lekalo-verify"}, {"version", 1}}},
            {"status", name_of(report.verdict)},
            {"units", "mm"},
            {"inputs", std::move(inputs)},
            {"warnings", evidence.notes},
            {"seed", 0},
            {"work", report.intervals},
            {"version", kVersion},
            {"clearance_low", report.clearance_low},
            {"clearance_high", report.clearance_high},
            {"bound_high", report.bound_high.empty() ? Json(nullptr) : Json(report.bound_high)},
            {"intervals", report.intervals},
            {"findings", report.findings},
            {"run", Json::object()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_text(const Evidence& evidence, const verify::LocateReport& report) {
  std::string text;
  switch (report.verdict) {
    case verify::Verdict::confirmed:
      text = "Confirmed: the clearance and the bound hold.\n";
      break;
    case verify::Verdict::unproved:
      text = "Unproved: the clearance holds, but there is no certificate for a bound.\n";
      break;
    case verify::Verdict::refuted:
      text = "Refuted: something in this result is not true.\n";
      break;
  }
  for (const std::string& finding : report.findings) text += "  not true           " + finding + "\n";
  if (!report.clearance_low.empty()) {
    text += fmt::format("  exact allowance    between {} and {} mm\n", report.clearance_low,
                        report.clearance_high);
  }
  if (!report.bound_high.empty()) {
    text += fmt::format("  bound              at most {} mm by {} certificate intervals\n", report.bound_high,
                        report.intervals);
  }
  for (const std::string& note : evidence.notes) text += "  note               " + note + "\n";
  return text;
}

}  // namespace

Result<int> run_verify(const VerifyOptions& o) {
  Result<Evidence> evidence = gather(o);
  if (!evidence) return tl::unexpected(evidence.error());
  verify::LocateInputs inputs{{o.result, evidence->result_bytes},
                              {evidence->part.path, evidence->part.bytes},
                              {evidence->blank.path, evidence->blank.bytes},
                              {}};
  if (evidence->certificate) inputs.certificate = {evidence->certificate->path, evidence->certificate->bytes};
  Result<verify::LocateReport> report = verify::verify_locate(inputs);
  if (!report) return tl::unexpected(report.error());
  evidence->notes.insert(evidence->notes.begin(), report->notes.begin(), report->notes.end());
  report->findings.insert(report->findings.begin(), evidence->mismatches.begin(), evidence->mismatches.end());
  if (!report->findings.empty()) report->verdict = verify::Verdict::refuted;
  if (o.json) {
    if (Result<void> done = print(report_json(o, *evidence, *report)); !done)
      return tl::unexpected(done.error());
  }
  tell(report_text(*evidence, *report));
  return exit_status_of(report->verdict);
}

}  // namespace lekalo::cli
