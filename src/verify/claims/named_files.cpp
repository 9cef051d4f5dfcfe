#include <fmt/core.h>

#include "report_fields.hpp"

namespace lekalo::verify {
namespace {

NamedFile read_file(Json item, const std::string& path, std::string& complaint) {
  ReportFields fields(item, path, complaint);
  NamedFile file;
  if (!complaint.empty()) return file;
  file.role = fields.text("role"), file.path = fields.text("path"), file.sha256 = fields.text("sha256");
  if (file.role == "after") file.tool_mm = fields.number("tool_mm");
  fields.refuse_others();
  return file;
}

}  // namespace

Result<std::vector<NamedFile>> named_files(const Document& report) {
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  std::string complaint;
  std::vector<NamedFile> files;
  ReportFields fields(root, "", complaint);
  const auto read = [&](const char* list) {
    fields.each(list, [&](Json item, const std::string& path) {
      if (complaint.empty()) files.push_back(read_file(item, path, complaint));
    });
  };
  read("inputs");
  if (fields.has("outputs")) read("outputs");
  if (!complaint.empty()) return failure(ErrorCode::bad_input, fmt::format("{}: {}", report.name, complaint));
  return files;
}

}  // namespace lekalo::verify
