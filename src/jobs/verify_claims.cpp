#include "lekalo/jobs/verify_claims.hpp"

#include <fmt/core.h>

#include <utility>

#include "jobs/document/earlier_documents.hpp"
#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::jobs {
namespace {

using verify::ClaimReport;
using verify::Kind;

verify::Document document(const File& file) { return {file.name, file.bytes}; }

std::string status_of(const ClaimReport& report) {
  if (!report.findings.empty()) return "refuted";
  if (report.stated_regions) return "confirmed for the stated regions";
  return report.unchecked.empty() ? "confirmed" : "incomplete";
}

/// Judges one file, and keeps what it was judged by.
class ClaimJudge {
 public:
  ClaimJudge(const File& result, const Beside& beside, const FileFinder& find)
      : result_(result), beside_(beside), find_(find) {}

  Result<VerifiedClaims> judged() {
    LEKALO_TRY(kind_, verify::kind_of(document(result_)));
    VerifiedClaims verified;
    LEKALO_TRY(verified.report, report());
    verified.status = status_of(verified.report);
    verified.json = json(verified);
    return verified;
  }

 private:
  Result<ClaimReport> report() {
    switch (kind_) {
      case Kind::layout:
        return layout();
      case Kind::pocket_report:
      case Kind::simulate_report:
        return reported(verify::verify_cut_report);
      case Kind::nest_report:
      case Kind::order_report:
      case Kind::check_report:
      case Kind::show_report:
        return reported(verify::verify_layout_report);
      case Kind::fit_report:
        return reported(verify::verify_fit_report);
      case Kind::heat_report:
        return reported(verify::verify_heat_report);
      case Kind::quote_report:
        return reported(verify::verify_quote_report);
      case Kind::stock_book:
        return verify::verify_stock(document(result_));
      case Kind::program:
        return beside_.layout && beside_.profile ? profile() : program();
      case Kind::dxf:
      case Kind::svg:
      case Kind::hpgl:
        return exported();
      default:
        return refused();
    }
  }

  Result<ClaimReport> layout() {
    std::optional<verify::Document> given;
    if (beside_.layout) given = used("layout", *beside_.layout);
    return verify::verify_layout_claims(document(result_), given);
  }

  /// The files that a report names, with their bytes compared.
  Result<std::vector<verify::Document>> named() {
    LEKALO_TRY(const std::vector<verify::NamedFile> names, verify::named_files(document(result_)));
    files_.reserve(names.size());
    std::vector<verify::Document> documents;
    for (const verify::NamedFile& name : names) {
      if (name.path.empty())
        return failure(ErrorCode::bad_input, fmt::format("{}: the {} that it speaks of was not written; run "
                                                         "the command again with -o FILE",
                                                         result_.name, name.role));
      LEKALO_TRY(std::optional<File> file, find_(name.role, name.path));
      if (!file) {
        mismatches_.push_back(
            fmt::format("the {} file {}, which it names, is not there; put it back, or say where it is now",
                        name.role, name.path));
        continue;
      }
      files_.push_back(*std::move(file));
      if (const std::string digest = io::sha256(files_.back().bytes); digest != name.sha256)
        mismatches_.push_back(fmt::format("{} is not the {} file of this report: its SHA-256 is {}, not {}",
                                          files_.back().name, name.role, digest, name.sha256));
      documents.push_back(used(name.role, files_.back()));
    }
    return documents;
  }

  /// A file that is not there or has other bytes refutes as such; what the figures are no longer matters.
  Result<ClaimReport> reported(Result<ClaimReport> (*recheck)(const verify::Document&,
                                                              const std::vector<verify::Document>&)) {
    LEKALO_TRY(const std::vector<verify::Document> files, named());
    if (!mismatches_.empty()) return ClaimReport{std::move(mismatches_), {}, {}, false};
    return recheck(document(result_), files);
  }

  Result<ClaimReport> profile() {
    return verify::verify_profile(document(result_), used("layout", *beside_.layout), *beside_.profile);
  }

  Result<ClaimReport> exported() {
    if (!beside_.layout)
      return failure(ErrorCode::usage, fmt::format("{}: {} says nothing of the layout that it was made from; "
                                                   "give --layout FILE",
                                                   result_.name, name_of(kind_)));
    return verify::verify_export(document(result_), used("layout", *beside_.layout), beside_.export_words);
  }

  Result<ClaimReport> program() {
    if (!beside_.pocket || !beside_.tool_diameter)
      return failure(ErrorCode::usage,
                     fmt::format("{}: a program says nothing of the part; give --pocket FILE --tool MM, or "
                                 "--layout FILE --kerf MM, or verify the result that names it",
                                 result_.name));
    verify::SimulateOptions machining = beside_.machining;
    machining.tool_diameter = *beside_.tool_diameter;
    for (const EarlierProgram& before : beside_.after) used("after", before.program);
    return verify::verify_pocket_program(document(result_), used("pocket", *beside_.pocket), machining,
                                         earlier_documents(beside_.after));
  }

  /// One sentence about a file that cannot be verified, or not alone.
  [[nodiscard]] tl::unexpected<Error> refused() const {
    switch (kind_) {
      case Kind::picture:
        return failure(ErrorCode::bad_input,
                       fmt::format("{}: it is a picture, which says nothing that can be verified; verify the "
                                   "result that it was drawn from",
                                   result_.name));
      case Kind::verify_report:
        return failure(ErrorCode::usage, fmt::format("{}: it is a report of verify; verify the file that it "
                                                     "names as \"result\" again",
                                                     result_.name));
      case Kind::placements:
        return failure(ErrorCode::usage, fmt::format("{}: placements for other programs say too little to be "
                                                     "verified; verify the layout that they were made from",
                                                     result_.name));
      case Kind::certificate:
        return failure(
            ErrorCode::usage,
            fmt::format("{}: it is a certificate; verify the placement that names it", result_.name));
      default:
        return failure(ErrorCode::bad_input,
                       fmt::format("{}: it is none of the files that lekalo writes and verify knows "
                                   "(placements, layouts, reports, programs, exports)",
                                   result_.name));
    }
  }

  verify::Document used(const std::string& role, const File& file) {
    used_.emplace_back(role, &file);
    return document(file);
  }

  [[nodiscard]] std::string json(const VerifiedClaims& verified) const {
    io::JsonWriter json = begin_document("lekalo-verify");
    json.fields({{"status", verified.status}, {"units", "mm"}}).key("inputs").begin_list();
    write_file(json, "result", result_);
    for (const auto& [role, file] : used_) write_file(json, role.c_str(), *file);
    json.end().key("warnings").list(verified.report.notes);
    json.fields({{"seed", 0}, {"work", 0}, {"version", kVersion}, {"kind", std::string(name_of(kind_))}});
    json.key("findings").list(verified.report.findings);
    json.key("unchecked").list(verified.report.unchecked);
    json.key("run").object({});
    return end_document(json);
  }

  const File& result_;
  const Beside& beside_;
  const FileFinder& find_;
  Kind kind_ = Kind::unknown;
  std::vector<std::pair<std::string, const File*>> used_;
  std::vector<File> files_;
  std::vector<std::string> mismatches_;
};

}  // namespace

Result<VerifiedClaims> verify_claims(const File& result, const Beside& beside, const FileFinder& find) {
  return ClaimJudge(result, beside, find).judged();
}

}  // namespace lekalo::jobs
