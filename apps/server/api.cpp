#include "api.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "lekalo/io/layout_export.hpp"
#include "lekalo/io/layout_json.hpp"
#include "lekalo/io/layout_picture.hpp"
#include "lekalo/io/nesting_files.hpp"
#include "lekalo/io/open_layout.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"

namespace lekalo::server {
namespace {

using Json = nlohmann::ordered_json;

ApiAnswer json_answer(int status, const Json& json) {
  return {
      status, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", "application/json", {}, {}};
}

ApiAnswer trouble(const Error& error) {
  switch (error.code) {
    case ErrorCode::usage:
      return api_error(404, error.message);
    case ErrorCode::environment:
      return api_error(503, error.message);
    default:
      return api_error(400, error.message);
  }
}

ApiAnswer list_layouts(Store& store) {
  const Result<std::vector<LayoutSummary>> layouts = store.list();
  if (!layouts) return trouble(layouts.error());
  Json list = Json::array();
  for (const LayoutSummary& one : *layouts)
    list.push_back({{"id", one.id},
                    {"name", one.name},
                    {"revision", one.revision},
                    {"placements", one.placements},
                    {"changed", one.changed}});
  return json_answer(200, {{"layouts", std::move(list)}});
}

/// The name that a request gives, or the sentence why not.
Result<std::string> name_in(const Target& target) {
  const std::string* const name = target.find("name");
  if (name == nullptr) return failure(ErrorCode::bad_input, "the name is missing: ?name=");
  return check_layout_name(*name).map([&] { return *name; });
}

ApiAnswer create_layout(Store& store, const Target& target, const std::string& body) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  if (body.empty()) return api_error(400, *name + ": the file is empty");
  Result<io::LayoutFile> file = io::read_any_layout(body, *name);
  if (!file) return trouble(file.error());
  const Result<LayoutId> id = store.create(*name, file->document);
  if (!id) return trouble(id.error());
  return json_answer(201, {{"id", *id}, {"notices", file->notices}});
}

ApiAnswer history(Store& store, LayoutId id) {
  const Result<std::vector<HistoryEntry>> entries = store.history(id);
  if (!entries) return trouble(entries.error());
  Json list = Json::array();
  for (const HistoryEntry& entry : *entries)
    list.push_back({{"revision", entry.revision},
                    {"at", entry.at},
                    {"author", entry.author},
                    {"text", entry.text},
                    {"kind", name_of(entry.kind)},
                    {"undone", entry.undone}});
  return json_answer(200, {{"entries", std::move(list)}});
}

/// The other fields of the request are the options of the command line: ?form=gcode&kerf=0.2&feed=2000.
ApiAnswer export_for_machines(const std::string& name, const layout::Document& document, io::ExportForm form,
                              const Target& target, const std::string& stem) {
  std::vector<io::ExportWord> words;
  for (const auto& field : target.fields)
    if (field.first != "form") words.push_back(field);
  const Result<io::ExportRequest> request = io::read_export_words(form, words, "");
  if (!request) return api_error(400, request.error().message);
  const Result<io::Exported> made = io::export_layout(document, name, *request);
  if (!made) return api_error(400, made.error().message);
  if (made->files.size() > 1)
    return api_error(400,
                     "several sheets are in use and each is a file of its own: name one, for example sheet=" +
                         made->files.front().sheet);
  const auto [type, ending] = [&]() -> std::pair<const char*, const char*> {
    if (form == io::ExportForm::dxf) return {"image/vnd.dxf", ".dxf"};
    if (form == io::ExportForm::svg) return {"image/svg+xml", ".svg"};
    if (form == io::ExportForm::hpgl) return {"application/vnd.hp-hpgl", ".plt"};
    return {"text/plain; charset=utf-8", ".nc"};
  }();
  return {200, made->files.front().bytes, type, stem + ending, {}};
}

ApiAnswer export_layout(Store& store, LayoutId id, const Target& target) {
  const std::string* const form = target.find("form");
  if (form == nullptr)
    return api_error(400, "the form is missing: ?form=layout, placements, pdf, png, dxf, svg, hpgl or gcode");
  const Result<StoredLayout> layout = store.load(id);
  if (!layout) return trouble(layout.error());
  const layout::Document& document = layout->document;
  const std::string stem = "layout-" + std::to_string(id);
  const auto file = [&](const Result<std::string>& bytes, const char* type, const char* ending) {
    return bytes ? ApiAnswer{200, *bytes, type, stem + ending, {}} : trouble(bytes.error());
  };
  if (*form == "layout") return file(io::write_layout(document), "application/json", ".json");
  if (*form == "placements") {
    const Result<std::size_t> strip = io::strip_in_use(document);
    if (!strip) return trouble(strip.error());
    return file(io::write_placements(document, *strip, ""), "application/json", ".json");
  }
  if (const auto machine = io::export_form(*form))
    return export_for_machines(layout->name, document, *machine, target, stem);
  if (*form != "pdf" && *form != "png")
    return api_error(400, "the form has to be layout, placements, pdf, png, dxf, svg, hpgl or gcode");
  const layout::Completeness completeness = layout::completeness(layout::Workspace(document));
  const std::vector<layout::Violation> violations = layout::check(document);
  const io::LayoutPicture picture{layout->name, document, completeness, violations};
  if (*form == "pdf") return file(io::layout_pdf(picture), "application/pdf", ".pdf");
  return file(io::layout_png(picture), "image/png", ".png");
}

ApiAnswer wrong_method(const char* allow) {
  ApiAnswer answer = api_error(405, std::string("the methods here are ") + allow);
  answer.allow = allow;
  return answer;
}

ApiAnswer copy_layout(Store& store, LayoutId id, const Target& target) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  const Result<LayoutId> made = store.copy(id, *name);
  return made ? json_answer(201, {{"id", *made}}) : trouble(made.error());
}

ApiAnswer restore_layout(const ChangeRoom& change_room, LayoutId id, const Target& target) {
  const std::string* const text = target.find("revision");
  const auto revision = text != nullptr ? whole_number(*text) : std::nullopt;
  if (!revision) return api_error(400, "the revision is missing or no whole number: ?revision=");
  Revision now = 0;
  const Result<void> done = change_room(id, [&](Room& room) {
    Result<Outbound> out = room.restore(static_cast<Revision>(*revision));
    now = room.revision();
    return out;
  });
  return done ? json_answer(200, {{"revision", now}}) : trouble(done.error());
}

ApiAnswer rename_layout(const ChangeRoom& change_room, LayoutId id, const Target& target) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  const Result<void> done = change_room(id, [&](Room& room) { return room.rename(*name); });
  return done ? json_answer(200, Json::object()) : trouble(done.error());
}

ApiAnswer remove_layout(const ChangeRoom& change_room, LayoutId id) {
  const Result<void> done = change_room(id, [](Room& room) { return room.remove(); });
  return done ? json_answer(200, Json::object()) : trouble(done.error());
}

}  // namespace

ApiAnswer api_error(int status, const std::string& sentence) {
  return json_answer(status, {{"error", sentence}});
}

ApiAnswer answer_api(Store& store, const ChangeRoom& change_room, const std::string& method,
                     const Target& target, const std::string& body) {
  constexpr std::string_view kRoot = "/api/layouts";
  std::string_view rest = target.path;
  const ApiAnswer nothing = api_error(404, "there is nothing here");
  if (!rest.starts_with(kRoot)) return nothing;
  rest.remove_prefix(kRoot.size());
  if (rest.empty()) {
    if (method == "GET") return list_layouts(store);
    if (method == "POST") return create_layout(store, target, body);
    return wrong_method("GET, POST");
  }
  if (rest.front() != '/') return nothing;
  rest.remove_prefix(1);
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const auto number = whole_number(rest.substr(0, slash));
  if (!number || *number == 0) return nothing;
  const auto id = static_cast<LayoutId>(*number);
  const std::string_view what = rest.substr(slash);
  if (what.empty()) {
    if (method == "PATCH") return rename_layout(change_room, id, target);
    if (method == "DELETE") return remove_layout(change_room, id);
    return wrong_method("PATCH, DELETE");
  }
  if (what == "/copy") return method == "POST" ? copy_layout(store, id, target) : wrong_method("POST");
  if (what == "/restore")
    return method == "POST" ? restore_layout(change_room, id, target) : wrong_method("POST");
  if (what == "/history") return method == "GET" ? history(store, id) : wrong_method("GET");
  if (what == "/export") return method == "GET" ? export_layout(store, id, target) : wrong_method("GET");
  return nothing;
}

}  // namespace lekalo::server
