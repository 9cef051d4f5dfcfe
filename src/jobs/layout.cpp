#include "lekalo/jobs/layout.hpp"

#include <utility>

#include "jobs/document/report_document.hpp"
#include "layout_json.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::jobs {

Result<Layout> open_layout(File file, const io::PartOptions& parts, const io::FindItems& find) {
  LEKALO_TRY(io::AnyLayout read, io::read_any_layout(file.bytes, file.name, parts, find));
  Layout layout;
  layout.inputs.push_back({"layout", file.name, io::sha256(file.bytes)});
  layout.document = std::move(read.document);
  layout.notices = std::move(read.notices);
  layout.form = read.form;
  layout.instance_name =
      read.form == io::NestingForm::strip ? io::file_name(file.name) : std::move(read.instance);
  layout.name = std::move(file.name);
  if (file.bytes.find("lekalo-layout/1") != std::string::npos) layout.bytes = std::move(file.bytes);
  return layout;
}

std::string layout_bytes(const Layout& layout) {
  return layout.bytes.empty() ? io::write_layout(layout.document) : layout.bytes;
}

io::JsonWriter begin_layout_json(const char* format, const std::string& status, const Layout& layout,
                                 std::uint64_t seed, std::uint64_t work) {
  io::JsonWriter json = begin_document(format);
  json.fields({{"status", status}, {"units", "mm"}}).key("inputs").begin_list();
  for (const LayoutInput& input : layout.inputs)
    json.object({{"role", input.role}, {"path", input.name}, {"sha256", input.sha256}});
  json.end().key("warnings").list(layout.notices);
  json.fields({{"seed", seed}, {"work", work}, {"version", kVersion}});
  return json;
}

}  // namespace lekalo::jobs
