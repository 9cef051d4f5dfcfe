#include "api.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/layout.hpp"
#include "order_form.hpp"

namespace lekalo::server {
namespace {

using io::JsonWriter;

ApiAnswer json_answer(int status, JsonWriter& json) {
  return {status, json.take() + "\n", "application/json", {}, {}, {}};
}

ApiAnswer json_answer(int status, std::initializer_list<io::JsonField> fields) {
  JsonWriter json(io::JsonLayout::compact);
  return json_answer(status, json.object(fields));
}

/// An object of one list.
template <class Items, class Write>
ApiAnswer list_answer(const char* key, const Items& items, const Write& write) {
  JsonWriter json(io::JsonLayout::compact);
  json.begin_object().key(key).list(items, [&](const auto& item) { write(json, item); }).end();
  return json_answer(200, json);
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
  return list_answer("layouts", *layouts, [](JsonWriter& json, const LayoutSummary& one) {
    json.object({{"id", one.id},
                 {"name", one.name},
                 {"revision", one.revision},
                 {"placements", one.placements},
                 {"changed", one.changed},
                 {"damaged", one.damaged}});
  });
}

/// The name that a request gives, or the sentence why not.
Result<std::string> name_in(const Target& target) {
  const std::string* const name = target.find("name");
  if (name == nullptr) return failure(ErrorCode::bad_input, "the name is missing: ?name=");
  return check_layout_name(*name).map([&] { return *name; });
}

ApiAnswer made_layout(Store& store, const std::string& name, const Result<jobs::Layout>& made,
                      const std::atomic<bool>& given_up) {
  if (!made) return api_error(400, made.error().message);
  if (given_up) return api_error(503, name + ": nobody waits for it any more");
  const Result<LayoutId> id = store.create(name, made->document);
  if (!id) return trouble(id.error());
  JsonWriter json(io::JsonLayout::compact);
  json.begin_object().fields({{"id", *id}, {"stocks", made->document.stocks.size()}});
  json.key("notices").list(made->notices).end();
  return json_answer(201, json);
}

ApiAnswer create_layout(Store& store, const Target& target, const std::string& body,
                        const std::atomic<bool>& given_up) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  if (body.empty()) return api_error(400, *name + ": the file is empty");
  if (target.find("order") != nullptr) return made_layout(store, *name, ordered_layout(body), given_up);
  return made_layout(store, *name, jobs::open_layout({*name, body}), given_up);
}

/// Reads a file as create_layout does, and keeps nothing of it.
ApiAnswer read_drawing(const Target& target, const std::string& body) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  if (body.empty()) return api_error(400, *name + ": the file is empty");
  const Result<jobs::Layout> read = jobs::open_layout({*name, body});
  if (!read) return api_error(400, read.error().message);
  JsonWriter json(io::JsonLayout::compact);
  json.begin_object().key("document").raw() += io::write_layout(read->document);
  json.key("notices").list(read->notices).end();
  return json_answer(200, json);
}

ApiAnswer history(Store& store, LayoutId id) {
  const Result<std::vector<HistoryEntry>> entries = store.history(id);
  if (!entries) return trouble(entries.error());
  return list_answer("entries", *entries, [](JsonWriter& json, const HistoryEntry& entry) {
    json.begin_object().fields({{"revision", entry.revision},
                                {"at", entry.at},
                                {"author", entry.author},
                                {"text", entry.text},
                                {"kind", name_of(entry.kind)},
                                {"undone", entry.undone},
                                {"damaged", entry.damaged}});
    json.key("parts").list(entry.parts, [&](const TouchedPart& one) {
      json.begin_object();
      one.gone.empty() ? json.field("part", one.part) : json.field("part", one.gone);
      json.fields(
          {{"first", one.first}, {"placed", one.placed}, {"changed", one.changed}, {"removed", one.removed}});
      json.end();
    });
    json.end();
  });
}

/// The notes as the value of a header: as many as fit into one, and a word about the rest.
std::string notes_json(const std::vector<std::string>& notes) {
  if (notes.empty()) return {};
  constexpr std::size_t kMost = 8000;
  JsonWriter json(io::JsonLayout::compact);
  json.begin_list();
  std::size_t size = 0;
  for (std::size_t i = 0; i < notes.size(); ++i) {
    size += io::ascii_json(io::json_string(notes[i])).size() + 2;
    if (size > kMost) {
      json.value(fmt::format("... and {} more; lekalo export says all", notes.size() - i));
      break;
    }
    json.value(notes[i]);
  }
  json.end();
  return io::ascii_json(json.take());
}

/// A form that an export can have: its word, and what its file is.
struct Form {
  std::string_view word;
  jobs::LayoutForm form;
  const char *type, *ending;
};
constexpr Form kForms[] = {{"layout", jobs::LayoutForm::layout, "application/json", ".json"},
                           {"placements", jobs::LayoutForm::placements, "application/json", ".json"},
                           {"pdf", jobs::LayoutForm::pdf, "application/pdf", ".pdf"},
                           {"png", jobs::LayoutForm::png, "image/png", ".png"},
                           {"dxf", jobs::LayoutForm::machine, "image/vnd.dxf", ".dxf"},
                           {"svg", jobs::LayoutForm::machine, "image/svg+xml", ".svg"},
                           {"hpgl", jobs::LayoutForm::machine, "application/vnd.hp-hpgl", ".plt"},
                           {"gcode", jobs::LayoutForm::machine, "text/plain; charset=utf-8", ".nc"}};
constexpr const char* kFormWords = "layout, placements, pdf, png, dxf, svg, hpgl or gcode";

/// The other fields of the request are the options of the command line: ?form=gcode&kerf=0.2&feed=2000.
Result<io::ExportRequest> machine_request(std::string_view form, const Target& target) {
  std::vector<io::ExportWord> words;
  for (const auto& field : target.fields)
    if (field.first != "form" && field.first != "token") words.push_back(field);
  return io::read_export_words(*io::export_form(form), words, "");
}

ApiAnswer export_layout(Store& store, LayoutId id, const Target& target) {
  const std::string* const word = target.find("form");
  if (word == nullptr) return api_error(400, fmt::format("the form is missing: ?form={}", kFormWords));
  Result<StoredLayout> stored = store.load(id);
  if (!stored) return trouble(stored.error());
  const auto form =
      std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& one) { return one.word == *word; });
  if (form == std::end(kForms)) return api_error(400, fmt::format("the form has to be {}", kFormWords));
  jobs::ExportOptions options{form->form, stored->name, {}, {}};
  const bool machine = form->form == jobs::LayoutForm::machine;
  if (machine) {
    Result<io::ExportRequest> request = machine_request(*word, target);
    if (!request) return api_error(400, request.error().message);
    options.machine = std::move(*request);
  }
  jobs::Layout layout;
  layout.document = std::move(stored->document);
  const Result<io::Exported> made = jobs::export_layout(layout, options);
  // A sheet that is not there is a wrong word of the request, not a layout that is not there.
  if (!made) return machine ? api_error(400, made.error().message) : trouble(made.error());
  if (made->files.size() > 1)
    return api_error(400,
                     "several sheets are in use and each is a file of its own: name one, for example sheet=" +
                         made->files.front().sheet);
  return {200, made->files.front().bytes, form->type, fmt::format("layout-{}{}", id, form->ending),
          {},  notes_json(made->notes)};
}

ApiAnswer wrong_method(const char* allow) {
  ApiAnswer answer = api_error(405, std::string("the methods here are ") + allow);
  answer.allow = allow;
  return answer;
}

/// The revision that a request gives; nothing where it gives none.
Result<std::optional<Revision>> revision_in(const Target& target) {
  const std::string* const text = target.find("revision");
  if (text == nullptr) return std::optional<Revision>();
  const auto revision = whole_number(*text);
  if (!revision) return failure(ErrorCode::bad_input, "the revision is no whole number: ?revision=");
  return std::optional<Revision>(static_cast<Revision>(*revision));
}

ApiAnswer copy_layout(Store& store, LayoutId id, const Target& target) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  const Result<std::optional<Revision>> revision = revision_in(target);
  if (!revision) return trouble(revision.error());
  const Result<LayoutId> made = store.copy(id, *name, *revision);
  return made ? json_answer(201, {{"id", *made}}) : trouble(made.error());
}

ApiAnswer restore_layout(const ChangeRoom& change_room, const Target& target) {
  const std::string* const text = target.find("revision");
  const auto revision = text != nullptr ? whole_number(*text) : std::nullopt;
  if (!revision) return api_error(400, "the revision is missing or no whole number: ?revision=");
  Revision now = 0;
  const Result<void> done = change_room([&](Room& room) {
    Result<Outbound> out = room.restore(static_cast<Revision>(*revision));
    now = room.revision();
    return out;
  });
  return done ? json_answer(200, {{"revision", now}}) : trouble(done.error());
}

/// Brings the drawings and sheets of a form into a layout.
ApiAnswer add_to_layout(const ChangeRoom& change_room, const Target& target, ReadFirst read,
                        const std::atomic<bool>& given_up) {
  const std::string* const author = target.find("author");
  if (author != nullptr)
    if (const Result<void> fine = check_author(*author); !fine) return trouble(fine.error());
  Result<jobs::Layout>& made = *read.additions;
  if (!made) return api_error(400, made.error().message);
  if (given_up) return api_error(503, "nobody waits for it any more");
  std::vector<std::string> added;
  Revision now = 0;
  const Result<void> done = change_room([&](Room& room) {
    Result<Outbound> out =
        room.add(author != nullptr ? *author : std::string(),
                 {std::move(made->document.parts), std::move(made->document.stocks)}, added);
    now = room.revision();
    return out;
  });
  if (!done) return trouble(done.error());
  JsonWriter json(io::JsonLayout::compact);
  json.begin_object().field("revision", now).key("added").list(added);
  json.key("notices").list(made->notices).end();
  return json_answer(200, json);
}

ApiAnswer rename_layout(const ChangeRoom& change_room, const Target& target) {
  const Result<std::string> name = name_in(target);
  if (!name) return trouble(name.error());
  const Result<void> done = change_room([&](Room& room) { return room.rename(*name); });
  return done ? json_answer(200, {}) : trouble(done.error());
}

ApiAnswer remove_layout(Store& store, const ChangeRoom& change_room, LayoutId id) {
  Result<void> done = change_room([](Room& room) { return room.remove(); });
  // A layout that cannot be read any more can be deleted all the same.
  if (!done && done.error().code == ErrorCode::environment) done = store.remove(id);
  return done ? json_answer(200, {}) : trouble(done.error());
}

/// "x,y,x,y" of two points that are not one, within +-`most`.
Result<void> take_points(const Target& target, const char* field, double most, double (&points)[4]) {
  const std::string* const text = target.find(field);
  if (text == nullptr)
    return failure(ErrorCode::bad_input,
                   fmt::format("the field {0} is missing: ?{0}=x,y,x,y of two points", field));
  std::string_view rest = *text;
  for (int i = 0; i < 4; ++i) {
    const std::size_t end = i < 3 ? std::min(rest.find(','), rest.size()) : rest.size();
    const auto value = double_of_text(rest.substr(0, end));
    if (!value || !(std::abs(*value) <= most))
      return failure(ErrorCode::bad_input,
                     fmt::format("the field {} has to be four numbers x,y,x,y within +-{}", field, most));
    points[i] = *value;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (points[0] == points[2] && points[1] == points[3])
    return failure(ErrorCode::bad_input, fmt::format("the two points of {} are one", field));
  return {};
}

Result<PhotoScale> scale_in(const Target& target) {
  constexpr double kMostPixels = 65535, kMostMm = 0x1p18;
  PhotoScale scale;
  LEKALO_CHECK(take_points(target, "pixels", kMostPixels, scale.pixels));
  LEKALO_CHECK(take_points(target, "mm", kMostMm, scale.mm));
  return scale;
}

ApiAnswer list_photos(Store& store, LayoutId id) {
  const Result<std::vector<Photo>> photos = store.photos(id);
  if (!photos) return trouble(photos.error());
  return list_answer("photos", *photos, [](JsonWriter& json, const Photo& one) {
    json.begin_object().fields({{"stock", one.stock}, {"type", one.type}, {"bytes", one.bytes}});
    json.key("pixels").list(one.scale.pixels).key("mm").list(one.scale.mm).end();
  });
}

ApiAnswer photo(Store& store, const ChangeRoom& change_room, const std::string& method, LayoutId id,
                const Target& target, const std::string& body) {
  const std::string* const stock = target.find("stock");
  if (stock == nullptr) return api_error(400, "the stock is missing: ?stock=");
  if (method == "GET") {
    Result<std::string> image = store.photo_image(id, *stock);
    if (!image) return trouble(image.error());
    std::string type = image_type(*image);
    return {200, std::move(*image), std::move(type), {}, {}, {}};
  }
  Result<void> done;
  if (method == "DELETE") {
    done = change_room([&](Room& room) { return room.remove_photo(*stock); });
  } else {
    const Result<PhotoScale> scale = scale_in(target);
    if (!scale) return trouble(scale.error());
    if (method == "PATCH") {
      done = change_room([&](Room& room) { return room.set_photo_scale(*stock, *scale); });
    } else {
      const std::string type = image_type(body);
      if (type.empty()) return api_error(415, "a photograph is a PNG or JPEG file; this is neither");
      const Photo given{*stock, type, static_cast<std::int64_t>(body.size()), *scale};
      done = change_room([&](Room& room) { return room.set_photo(given, body); });
    }
  }
  return done ? json_answer(200, {}) : trouble(done.error());
}

constexpr std::string_view kRoot = "/api/layouts", kDrawings = "/api/drawings";

/// "/api/layouts/ID" and what stands behind it.
struct LayoutPath {
  LayoutId id = 0;
  std::string_view what;
};

std::optional<LayoutPath> layout_path(std::string_view path) {
  if (!path.starts_with(kRoot) || path.size() == kRoot.size() || path[kRoot.size()] != '/')
    return std::nullopt;
  path.remove_prefix(kRoot.size() + 1);
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto number = whole_number(path.substr(0, slash));
  if (!number || *number == 0) return std::nullopt;
  return LayoutPath{static_cast<LayoutId>(*number), path.substr(slash)};
}

}  // namespace

std::string image_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
  return {};
}

std::size_t most_body(std::string_view method, std::string_view path) {
  constexpr std::size_t kLargestFile = std::size_t{64} << 20;
  const std::optional<LayoutPath> layout = layout_path(path);
  if (method == "POST" && (path == kRoot || path == kDrawings || is_read_first(method, path)))
    return kLargestFile;
  return method == "PUT" && layout && layout->what == "/photo" ? kLargestPhoto : 0;
}

std::optional<LayoutId> layout_changed_by(std::string_view method, std::string_view path) {
  const std::optional<LayoutPath> layout = layout_path(path);
  if (!layout) return std::nullopt;
  const auto& [id, what] = *layout;
  const bool changes = (what.empty() && (method == "PATCH" || method == "DELETE")) ||
                       ((what == "/restore" || what == "/order") && method == "POST") ||
                       (what == "/photo" && (method == "PUT" || method == "PATCH" || method == "DELETE"));
  return changes ? std::optional(id) : std::nullopt;
}

bool takes_long(std::string_view method, std::string_view path, std::size_t body) {
  constexpr std::size_t kLargeFile = std::size_t{64} << 10;
  const std::optional<LayoutPath> layout = layout_path(path);
  if (!layout) return body > kLargeFile;
  const std::string_view what = layout->what;
  return (what == "/export" && method == "GET") ||
         ((what == "/copy" || what == "/restore") && method == "POST");
}

bool is_read_first(std::string_view method, std::string_view path) {
  const std::optional<LayoutPath> layout = layout_path(path);
  return method == "POST" && layout && layout->what == "/order";
}

ReadFirst read_first(const std::string& body) { return {ordered_additions(body)}; }

ApiAnswer api_error(int status, const std::string& sentence) {
  return json_answer(status, {{"error", sentence}});
}

ApiAnswer answer_api(Store& store, const ChangeRoom& change_room, const std::string& method,
                     const Target& target, const std::string& body, ReadFirst read,
                     const std::atomic<bool>& given_up) {
  const ApiAnswer nothing = api_error(404, "there is nothing here");
  if (target.path == kRoot) {
    if (method == "GET") return list_layouts(store);
    if (method == "POST") return create_layout(store, target, body, given_up);
    return wrong_method("GET, POST");
  }
  if (target.path == kDrawings) return method == "POST" ? read_drawing(target, body) : wrong_method("POST");
  const std::optional<LayoutPath> path = layout_path(target.path);
  if (!path) return nothing;
  const auto& [id, what] = *path;
  if (what.empty()) {
    if (method == "PATCH") return rename_layout(change_room, target);
    if (method == "DELETE") return remove_layout(store, change_room, id);
    return wrong_method("PATCH, DELETE");
  }
  if (what == "/copy") return method == "POST" ? copy_layout(store, id, target) : wrong_method("POST");
  if (what == "/restore")
    return method == "POST" ? restore_layout(change_room, target) : wrong_method("POST");
  if (what == "/order")
    return method == "POST" ? add_to_layout(change_room, target, std::move(read), given_up)
                            : wrong_method("POST");
  if (what == "/history") return method == "GET" ? history(store, id) : wrong_method("GET");
  if (what == "/export") return method == "GET" ? export_layout(store, id, target) : wrong_method("GET");
  if (what == "/photos") return method == "GET" ? list_photos(store, id) : wrong_method("GET");
  if (what == "/photo") {
    const bool known = method == "GET" || method == "PUT" || method == "PATCH" || method == "DELETE";
    return known ? photo(store, change_room, method, id, target, body)
                 : wrong_method("GET, PUT, PATCH, DELETE");
  }
  return nothing;
}

}  // namespace lekalo::server
