#include "support/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

namespace lekalo::cases {
namespace {

using Library = nlohmann::ordered_json;

[[noreturn]] void miss(const std::string& what, const Json& json) {
  throw std::runtime_error("no " + what + " in " + json.dump().substr(0, 200));
}

template <class Tree>
Tree& below(Tree& tree, const std::string& path) {
  Tree* place = &tree;
  for (std::size_t begin = 1, end = 0; begin < path.size(); begin = end + 1) {
    end = std::min(path.find('/', begin), path.size());
    const std::string step = path.substr(begin, end - begin);
    place = place->is_array() ? &(*place)[std::stoul(step)] : &(*place)[step];
  }
  return *place;
}

}  // namespace

struct JsonConversion {
  static Json from(const Library& library) {
    Json json;
    if (library.is_boolean()) {
      json = library.get<bool>();
    } else if (library.is_number_float() ||
               (library.is_number_unsigned() && library.get<std::uint64_t>() > INT64_MAX)) {
      json = library.get<double>();
    } else if (library.is_number()) {
      json = library.get<std::int64_t>();
    } else if (library.is_string()) {
      json = library.get<std::string>();
    } else if (library.is_array()) {
      json.kind_ = Json::Kind::list;
      for (const Library& item : library) json.items_.push_back(from(item));
    } else if (library.is_object()) {
      json.kind_ = Json::Kind::object;
      for (const auto& [key, item] : library.items()) json[key] = from(item);
    }
    return json;
  }

  static Library to(const Json& json) {
    switch (json.kind_) {
      case Json::Kind::null:
        return nullptr;
      case Json::Kind::truth:
        return json.whole_ != 0;
      case Json::Kind::whole:
        return json.whole_;
      case Json::Kind::number:
        return json.number_;
      case Json::Kind::text:
        return json.text_;
      case Json::Kind::list:
      case Json::Kind::object:
        break;
    }
    Library library = json.is_object() ? Library::object() : Library::array();
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (json.is_object())
        library[json.keys_[i]] = to(json.items_[i]);
      else
        library.push_back(to(json.items_[i]));
    }
    return library;
  }
};

Json::Json() noexcept = default;
Json::Json(const char* text) : kind_(Kind::text), text_(text) {}
Json::Json(std::string text) : kind_(Kind::text), text_(std::move(text)) {}
Json::Json(double number) noexcept : kind_(Kind::number), number_(number) {}
Json::Json(Kind kind, std::int64_t whole) noexcept
    : kind_(kind), whole_(whole), number_(static_cast<double>(whole)) {}
Json::Json(std::vector<Json> list) : kind_(Kind::list), items_(std::move(list)) {}
Json::Json(std::initializer_list<Json> items) : kind_(Kind::object) {
  const bool fields = std::all_of(items.begin(), items.end(), [](const Json& item) {
    return item.kind_ == Kind::list && item.size() == 2 && item.items_[0].kind_ == Kind::text;
  });
  if (fields) {
    for (const Json& item : items) (*this)[item.items_[0].text_] = item.items_[1];
  } else {
    *this = array(items);
  }
}
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(Json other) noexcept {
  kind_ = other.kind_;
  whole_ = other.whole_;
  number_ = other.number_;
  text_ = std::move(other.text_);
  items_ = std::move(other.items_);
  keys_ = std::move(other.keys_);
  return *this;
}
Json::~Json() = default;

Json Json::array(std::initializer_list<Json> items) { return Json(std::vector<Json>(items)); }

Json Json::object() { return Json(std::initializer_list<Json>{}); }

Json Json::parse(const std::string& text) { return JsonConversion::from(Library::parse(text)); }

std::string Json::dump(int indent) const { return JsonConversion::to(*this).dump(indent); }

Json& Json::operator[](const std::string& key) {
  if (is_null()) kind_ = Kind::object;
  if (!is_object()) miss("field \"" + key + "\"", *this);
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  if (found != keys_.end()) return items_[static_cast<std::size_t>(found - keys_.begin())];
  keys_.push_back(key);
  return items_.emplace_back();
}

const Json& Json::operator[](const std::string& key) const {
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  if (found == keys_.end()) miss("field \"" + key + "\"", *this);
  return items_[static_cast<std::size_t>(found - keys_.begin())];
}

Json& Json::at(const std::string& path) { return below(*this, path); }
const Json& Json::at(const std::string& path) const { return below(*this, path); }

bool Json::contains(const std::string& key) const {
  return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
}

Json Json::value(const std::string& key, Json otherwise) const {
  return contains(key) ? (*this)[key] : std::move(otherwise);
}

void Json::push_back(Json item) {
  if (is_null()) kind_ = Kind::list;
  if (kind_ != Kind::list) miss("list", *this);
  items_.push_back(std::move(item));
}

void Json::erase(std::size_t index) {
  static_cast<void>(item(index));
  items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(index));
}

void Json::erase(const std::string& key) {
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  if (found == keys_.end()) return;
  items_.erase(items_.begin() + (found - keys_.begin()));
  keys_.erase(found);
}

bool operator==(const Json& a, const Json& b) {
  const auto number = [](const Json& json) {
    return json.kind_ == Json::Kind::whole || json.kind_ == Json::Kind::number;
  };
  if (number(a) && number(b)) return a <=> b == std::partial_ordering::equivalent;
  return a.kind_ == b.kind_ && a.whole_ == b.whole_ && a.text_ == b.text_ && a.keys_ == b.keys_ &&
         a.items_ == b.items_;
}

std::partial_ordering operator<=>(const Json& a, const Json& b) {
  if (a.kind_ == Json::Kind::whole && b.kind_ == Json::Kind::whole) return a.whole_ <=> b.whole_;
  return a.number() <=> b.number();
}

std::ostream& operator<<(std::ostream& stream, const Json& json) { return stream << json.dump(); }

const std::string& Json::text() const {
  if (kind_ != Kind::text) miss("text", *this);
  return text_;
}

std::int64_t Json::whole() const {
  if (kind_ != Kind::truth && kind_ != Kind::whole) miss("whole number", *this);
  return whole_;
}

double Json::number() const {
  if (kind_ != Kind::whole && kind_ != Kind::number) miss("number", *this);
  return number_;
}

const Json& Json::item(std::size_t index) const {
  if (index >= size()) miss("item " + std::to_string(index), *this);
  return items_[index];
}

}  // namespace lekalo::cases
