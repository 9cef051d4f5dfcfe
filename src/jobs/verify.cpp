#include "lekalo/jobs/verify.hpp"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/verify/offset.hpp"

namespace lekalo::jobs {
namespace {

/// Finds what a result names and compares digests.
class Evidence {
 public:
  Evidence(const File& result, const FileFinder& find) : result_(result), find_(find) {}

  Result<void> gather() {
    LEKALO_TRY(const io::WrittenResult written, io::read_result(result_.bytes, result_.name));
    for (const char* role : {"part", "blank"})
      if (written.input(role) == nullptr)
        return failure(ErrorCode::bad_input,
                       fmt::format("{}: \"inputs\" names no file with the role \"{}\"", result_.name, role));
    for (const io::InputRecord& record : written.inputs) LEKALO_CHECK(take(record));
    if (written.certificate_file) {
      LEKALO_TRY(certificate_, needed("certificate", *written.certificate_file));
    }
    if (is_missing_) return {};
    if (written.nc_output) take_written("NC program", *written.nc_output, program_);
    LEKALO_TRY(const std::optional<verify::OffsetFile> offset, verify::offset_file(document(result_)));
    if (offset) take_written("work offset", {offset->path, offset->sha256}, offset_);
    has_offset_ = offset.has_value();
    if (written.deviations) take_written("deviations", *written.deviations, deviations_);
    return {};
  }

  [[nodiscard]] Result<Verified> judged() const {
    if (is_missing_) return refuted();
    verify::LocateInputs inputs{document(result_), document(*input("part")), document(*input("blank")), {}};
    if (certificate_) inputs.certificate = document(*certificate_);
    for (const auto& [role, to] : {std::pair{"features", &inputs.features},
                                   {"points", &inputs.points},
                                   {"nominal", &inputs.nominal},
                                   {"nc", &inputs.program},
                                   {"allow", &inputs.allow},
                                   {"last-result", &inputs.earlier}})
      if (const File* const file = input(role)) *to = document(*file);
    if (program_) inputs.written_program = document(*program_);
    if (deviations_) inputs.deviations = document(*deviations_);
    Verified verified;
    LEKALO_TRY(verified.report, verify::verify_locate(inputs));
    verify::LocateReport& report = verified.report;
    if (has_offset_) LEKALO_CHECK(check_offset(report));
    report.notes.insert(report.notes.end(), notes_.begin(), notes_.end());
    report.findings.insert(report.findings.begin(), mismatches_.begin(), mismatches_.end());
    if (!report.findings.empty()) report.verdict = verify::Verdict::refuted;
    verified.json = report_json(report);
    return verified;
  }

 private:
  /// Holds the lines of the work offset against the pose. Without them the report cannot confirm all.
  Result<void> check_offset(verify::LocateReport& report) const {
    if (!offset_) {
      report.notes.emplace_back("that the work offset written is that of the placement was not rechecked");
      if (report.verdict == verify::Verdict::confirmed) report.verdict = verify::Verdict::incomplete;
      return {};
    }
    LEKALO_TRY(const std::optional<std::string> fault,
               verify::fault_of_offset(document(result_), document(*offset_)));
    if (fault)
      report.findings.push_back(
          fmt::format("the work offset {} is not that of the placement: {}", offset_->name, *fault));
    return {};
  }

  static verify::Document document(const File& file) { return {file.name, file.bytes}; }

  Result<std::optional<File>> found(const std::string& role, const io::FileRecord& written) {
    LEKALO_TRY(std::optional<File> file, find_(role, written.path));
    if (!file) return file;
    if (const std::string digest = io::sha256(file->bytes); digest != written.sha256)
      mismatches_.push_back(fmt::format("{} is not the {} file of this result: its SHA-256 is {}, not {}",
                                        file->name, role, digest, written.sha256));
    return file;
  }

  /// Without a file that the result rests on nothing of it can be believed, so that its absence is a finding.
  Result<std::optional<File>> needed(const std::string& role, const io::FileRecord& written) {
    LEKALO_TRY(std::optional<File> file, found(role, written));
    if (!file) {
      is_missing_ = true;
      mismatches_.push_back(
          fmt::format("the {} file {}, which it names, is not there; put it back, or say where it is now",
                      role, written.path));
    }
    return file;
  }

  Result<void> take(const io::InputRecord& record) {
    const std::string& role = record.role;
    if (input(role) != nullptr)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: \"inputs\" names two files with the role \"{}\"", result_.name, role));
    LEKALO_TRY(std::optional<File> file, needed(role, record.file));
    if (file) inputs_.emplace_back(role, *std::move(file));
    return {};
  }

  [[nodiscard]] const File* input(const std::string& role) const {
    for (const auto& [name, file] : inputs_)
      if (name == role) return &file;
    return nullptr;
  }

  /// A program that is not there may have gone to the machine, and a table to whoever reads it; the checker
  /// says that it was not compared.
  void take_written(const char* role, const io::FileRecord& written, std::optional<File>& to) {
    Result<std::optional<File>> file = found(role, written);
    if (!file)
      notes_.push_back(file.error().message);
    else
      to = *std::move(file);
    if (file && !to) notes_.push_back(fmt::format("the {} file {} is not there", role, written.path));
  }

  static const char* name_of(verify::Verdict verdict) {
    switch (verdict) {
      case verify::Verdict::confirmed:
        return "confirmed";
      case verify::Verdict::incomplete:
        return "incomplete";
      case verify::Verdict::stated_regions:
        return "confirmed for the stated regions";
      case verify::Verdict::unproved:
        return "unproved";
      case verify::Verdict::refuted:
        return "refuted";
    }
    return "";
  }

  [[nodiscard]] Verified refuted() const {
    Verified verified;
    verified.report.findings = mismatches_;
    verified.report.verdict = verify::Verdict::refuted;
    verified.json = report_json(verified.report);
    return verified;
  }

  [[nodiscard]] std::string report_json(const verify::LocateReport& report) const {
    io::JsonWriter json = begin_document("lekalo-verify");
    json.fields({{"status", name_of(report.verdict)}, {"units", "mm"}}).key("inputs").begin_list();
    write_file(json, "result", result_);
    for (const auto& [role, file] : inputs_) write_file(json, role.c_str(), file);
    if (certificate_) write_file(json, "certificate", *certificate_);
    json.end().key("warnings").list(report.notes);
    json.fields({{"seed", 0},
                 {"work", report.intervals},
                 {"version", kVersion},
                 {"clearance_low", report.clearance_low},
                 {"clearance_high", report.clearance_high}});
    json.key("bound_high");
    report.bound_high.empty() ? json.value(nullptr) : json.value(report.bound_high);
    json.field("intervals", report.intervals).key("findings").list(report.findings);
    json.key("run").object({});
    return end_document(json);
  }

  const File& result_;
  const FileFinder& find_;
  /// With their roles, in the order of the result.
  std::vector<std::pair<std::string, File>> inputs_;
  std::optional<File> certificate_, program_, offset_, deviations_;
  bool has_offset_ = false, is_missing_ = false;
  std::vector<std::string> mismatches_, notes_;
};

}  // namespace

Result<Verified> verify(const File& result, const FileFinder& find) {
  Evidence evidence(result, find);
  LEKALO_CHECK(evidence.gather());
  return evidence.judged();
}

}  // namespace lekalo::jobs
