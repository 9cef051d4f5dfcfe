#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/archive_limits.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_text.hpp"
#include "verify/read/xml.hpp"
#include "verify/read/zip.hpp"

namespace lekalo::verify {
namespace {

constexpr std::string_view kFormats = "http://schemas.microsoft.com/3dmanufacturing/", kCore = "core/2015/02",
                           kProduction = "production/2015/06", kMaterials = "material/2015/02",
                           kTriangleSets = "trianglesets/2021/07", kRelation = "2013/01/3dmodel";

bool is(std::string_view space, std::string_view format) {
  return space.starts_with(kFormats) && space.substr(kFormats.size()) == format;
}

Decimal without_zeros(Decimal number) {
  if (number.digits == 0) return {};
  while (mpz_divisible_ui_p(number.digits.get_mpz_t(), 10) != 0) number.digits /= 10, ++number.exponent;
  return number;
}
Decimal sum(const Decimal& a, const Decimal& b) { return a - Decimal{-b.digits, b.exponent}; }
Decimal product(const Decimal& a, const Decimal& b) {
  ask(static_cast<std::uint64_t>(bits_of(a.digits) + bits_of(b.digits)) / 512);
  return {a.digits * b.digits, a.exponent + b.exponent};
}

using Place = std::array<Decimal, 3>;
/// The images of x, y and z, and the shift; nothing where all stays.
using Transform = std::optional<std::array<Place, 4>>;

Place turned(const Place& p, const std::array<Place, 4>& by) {
  Place made;
  for (std::size_t k = 0; k < 3; ++k)
    made[k] = sum(sum(product(p[0], by[0][k]), product(p[1], by[1][k])), product(p[2], by[2][k]));
  return made;
}
Place moved(const Place& p, const Transform& by) {
  if (!by) return p;
  Place made = turned(p, *by);
  for (std::size_t k = 0; k < 3; ++k) made[k] = without_zeros(sum(made[k], (*by)[3][k]));
  return made;
}
Transform joined(const Transform& first, const Transform& second) {
  if (!first || !second) return first ? first : second;
  std::array<Place, 4> made;
  for (std::size_t k = 0; k < 3; ++k) made[k] = turned((*first)[k], *second);
  made[3] = moved((*first)[3], second);
  return made;
}

/// A model in the archive by its name without a leading slash, and the id of an object in it.
using Key = std::pair<std::string, std::uint32_t>;
struct Component {
  Key object;
  Transform transform;
};
struct Object {
  std::string name;
  bool is_model = true;
  std::vector<Place> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Component> components;
};
struct Model {
  std::map<Key, Object> objects;
  std::vector<Component> items;
  std::vector<std::string> parts;  ///< in the order in which they are named
  std::set<std::string> named;

  void name(const std::string& part) {
    if (named.insert(part).second) parts.push_back(part);
  }
};

/// Takes one model; what it does not understand is a fault, and ends it.
class ModelTaker final : public XmlTaker {
 public:
  ModelTaker(Model& model, std::string part, SolidMaker& made)
      : model_(model), made_(made), part_(std::move(part)), is_root_(part_ == model.parts.front()) {}

  [[nodiscard]] const std::string& fault() const { return fault_; }

  void begin(XmlElement element) override {
    if (!fault_.empty()) return;
    const std::size_t colon = element.name.find(':');
    const bool has_prefix = colon != std::string::npos;
    const std::string prefix = has_prefix ? element.name.substr(0, colon) : "";
    const std::string local = has_prefix ? element.name.substr(colon + 1) : element.name;
    if (open_.empty()) {
      read_spaces(element);
    } else if (std::ranges::any_of(element.attributes,
                                   [](const auto& one) { return one.first.starts_with("xmlns"); })) {
      fault_ = "a namespace is declared below the model";
      return;
    }
    const std::string space = space_of(prefix);
    const std::string outer = open_.empty() ? "" : open_.back();
    open_.push_back(is(space, kCore) ? local : "");
    if (passed_over_ == 0 && !(is(space, kCore) && take(element, outer, local)))
      pass_over(outer, local, space);
  }
  void end() override {
    if (!fault_.empty()) return;
    if (passed_over_ == open_.size()) passed_over_ = 0;
    open_.pop_back();
  }

 private:
  /// Says whether the element is one of those that are read.
  bool take(const XmlElement& element, std::string_view outer, std::string_view local) {
    const auto in = [&](std::string_view wanted_outer, std::string_view wanted) {
      return outer == wanted_outer && local == wanted;
    };
    if (in("", "model")) {
      begin_model(element);
    } else if (in("resources", "object")) {
      begin_object(element);
    } else if (in("vertices", "vertex")) {
      read_vertex(element);
    } else if (in("triangles", "triangle")) {
      read_triangle(element);
    } else if (in("components", "component")) {
      read_component(element, object_->components, true);
    } else if (in("build", "item")) {
      read_component(element, model_.items, false);
      if (!is_root_) fault_ = "a model beside the root has a build";
    } else {
      return in("model", "resources") || in("model", "build") || in("object", "mesh") ||
             in("object", "components") || in("mesh", "vertices") || in("mesh", "triangles");
    }
    return true;
  }

  /// Passes over what says nothing about the body, with all in it.
  void pass_over(std::string_view outer, std::string_view local, std::string_view space) {
    passed_over_ = open_.size();
    constexpr std::array<std::string_view, 6> kAround{"model",    "resources", "vertex",
                                                      "triangle", "component", "item"};
    if (outer.empty()) {
      fault_ = "it is no model of 3MF";
    } else if (std::ranges::find(kAround, outer) == kAround.end() && !is(space, kMaterials) &&
               !(outer == "mesh" && is(space, kTriangleSets)) &&
               !(outer == "object" && is(space, kCore) && local == "metadatagroup")) {
      fault_ = fmt::format("{} is an element that is not known", excerpt(local));
    }
  }

  void read_spaces(const XmlElement& root) {
    for (const auto& [key, value] : root.attributes) {
      if (key == "xmlns") spaces_[""] = value;
      if (key.starts_with("xmlns:")) spaces_[key.substr(6)] = value;
    }
  }
  [[nodiscard]] std::string space_of(const std::string& prefix) const {
    const auto found = spaces_.find(prefix);
    return found == spaces_.end() ? std::string() : found->second;
  }

  void begin_model(const XmlElement& model) {
    constexpr std::array<std::pair<std::string_view, SolidUnit>, 6> kUnitWords{
        {{"millimeter", SolidUnit::millimetre},
         {"micron", SolidUnit::micron},
         {"centimeter", SolidUnit::centimetre},
         {"inch", SolidUnit::inch},
         {"foot", SolidUnit::foot},
         {"meter", SolidUnit::metre}}};
    const std::string_view said = model.get("unit"), word = said.empty() ? kUnitWords[0].first : said;
    const auto* const unit = std::ranges::find(kUnitWords, word, [](const auto& one) { return one.first; });
    if (unit == kUnitWords.end()) {
      fault_ = fmt::format("{} is no unit", excerpt(word));
    } else if (!is_root_ && unit->second != made_.unit()) {
      fault_ = "its models have different units";
    } else {
      made_.set_unit(unit->second);
    }
    std::vector<std::string_view> required;
    split(model.get("requiredextensions"), required);
    for (const std::string_view prefix : required) {
      const std::string space = space_of(std::string(prefix));
      if (!is(space, kProduction) && !is(space, kMaterials) && !is(space, kTriangleSets))
        fault_ = fmt::format("it requires the extension {}", excerpt(prefix));
    }
  }

  void begin_object(const XmlElement& element) {
    const auto [at, is_new] = model_.objects.try_emplace(Key{part_, number(element, "id")});
    if (!is_new) fault_ = "an object is there twice";
    object_ = &at->second;
    object_->name = element.get("name");
    constexpr std::array<std::string_view, 4> kNoModels{"solidsupport", "support", "surface", "other"};
    const std::string_view type = element.get("type");
    object_->is_model = std::ranges::find(kNoModels, type) == kNoModels.end();
    if (object_->is_model && !type.empty() && type != "model")
      fault_ = fmt::format("{} is no type of an object", excerpt(type));
  }

  std::uint32_t number(const XmlElement& element, std::string_view key) {
    const std::string_view word = element.get(key);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fault_ = fmt::format("{} of {} is no whole number", key, excerpt(element.name));
    return value;
  }
  Decimal decimal(std::string_view word) {
    const auto read = parse_decimal(word);
    if (!read) fault_ = fmt::format("\"{}\" is not {}", excerpt(word), decimal_rule());
    return read.value_or(Decimal{});
  }

  void read_vertex(const XmlElement& element) {
    object_->vertices.push_back(
        {decimal(element.get("x")), decimal(element.get("y")), decimal(element.get("z"))});
  }
  void read_triangle(const XmlElement& element) {
    const std::array corners{number(element, "v1"), number(element, "v2"), number(element, "v3")};
    if (std::ranges::any_of(corners, [&](std::uint32_t v) { return v >= object_->vertices.size(); }))
      fault_ = "a triangle has a corner that is not there";
    object_->triangles.push_back(corners);
  }

  void read_component(const XmlElement& element, std::vector<Component>& list, bool in_object) {
    Component made{{part_, number(element, "objectid")}, {}};
    for (const auto& [key, value] : element.attributes) {
      const std::size_t colon = key.find(':');
      if (colon == std::string::npos || key.substr(colon + 1) != "path" ||
          !is(space_of(key.substr(0, colon)), kProduction))
        continue;
      if (!is_root_) fault_ = "a model beside the root names a third one";
      made.object.first = value.starts_with('/') ? value.substr(1) : value;
      model_.name(made.object.first);
    }
    const auto found = model_.objects.find(made.object);
    if (made.object.first == part_ &&
        (found == model_.objects.end() || (in_object && &found->second == object_)))
      fault_ = "an object holds one that does not stand before it";
    std::vector<std::string_view> words;
    split(element.get("transform"), words);
    if (!words.empty()) {
      auto& rows = made.transform.emplace();
      if (words.size() != 12) fault_ = "a transform has 12 numbers";
      for (std::size_t k = 0; k < words.size() && fault_.empty(); ++k) rows[k / 3][k % 3] = decimal(words[k]);
    }
    list.push_back(std::move(made));
  }

  Model& model_;
  SolidMaker& made_;
  std::string part_;
  bool is_root_;
  std::map<std::string, std::string> spaces_;
  std::vector<std::string> open_;  ///< the core's elements; others have no name
  std::size_t passed_over_ = 0;    ///< the depth of the element that is, with all in it
  Object* object_ = nullptr;
  std::string fault_;
};

/// Takes the target of the first relation to a model.
class RelationTaker final : public XmlTaker {
 public:
  std::string target;

  void begin(XmlElement element) override {
    if (target.empty() && is(element.get("Type"), kRelation)) target = element.get("Target");
  }
  void end() override {}
};

/// Puts the bodies of the build together.
class ThreeMf {
 public:
  explicit ThreeMf(SolidMaker& made) : made_(made) {}

  Result<void> read() {
    RelationTaker relations;
    if (!read_part("_rels/.rels", relations)) return {};
    model_.name(relations.target.starts_with('/') ? relations.target.substr(1) : relations.target);
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      ModelTaker taker(model_, model_.parts[k], made_);
      if (!read_part(std::string(model_.parts[k]), taker)) return {};
      if (!taker.fault().empty()) made_.leave_open(fmt::format("of {}: {}", model_.parts[k], taker.fault()));
      if (made_.is_open()) return {};
    }
    for (const auto& [key, object] : model_.objects)
      vertices_ += object.vertices.size(), triangles_ += object.triangles.size();
    for (const Component& item : model_.items) LEKALO_CHECK(place(item, item.transform, 1));
    return {};
  }

 private:
  bool read_part(const std::string& part, XmlTaker& taker) {
    const std::optional<std::string> text = unzip(made_.document().bytes, part);
    if (!text) made_.leave_open(fmt::format("{} cannot be unpacked from it", excerpt(part)));
    if (text && !read_xml({part, *text}, taker))
      made_.leave_open(fmt::format("{} in it is no XML that is understood here", excerpt(part)));
    return !made_.is_open();
  }

  Result<void> place(const Component& component, const Transform& transform, std::size_t depth) {
    const auto found = model_.objects.find(component.object);
    if (++placed_ > limits::kMostPlacedObjects || depth > limits::kMostObjectLevels ||
        found == model_.objects.end()) {
      made_.leave_open("it places an object that is not there, or too many, or too many within each other");
      return {};
    }
    const Object& object = found->second;
    if (!object.is_model) return {};
    LEKALO_CHECK(place_mesh(object, transform));
    for (const Component& inner : object.components)
      if (!made_.is_open()) LEKALO_CHECK(place(inner, joined(inner.transform, transform), depth + 1));
    return {};
  }

  Result<void> place_mesh(const Object& object, const Transform& transform) {
    const auto bad = [&](const std::string& sentence) {
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", made_.document().name, sentence));
    };
    const auto first = static_cast<std::uint32_t>(made_.vertices());
    if (first + object.vertices.size() > vertices_ + limits::kMostPlacedCopies ||
        made_.triangles() + object.triangles.size() > triangles_ + limits::kMostPlacedCopies)
      return bad(fmt::format("placing makes more than {} copies", limits::kMostPlacedCopies));
    for (const Place& p : object.vertices)
      if (const auto fault = made_.add_vertex(moved(p, transform))) return bad(*fault);
    if (!object.triangles.empty()) made_.begin_group(object.name);
    for (const auto& [a, b, c] : object.triangles)
      if (const auto fault = made_.add_triangle({first + a, first + b, first + c})) return bad(*fault);
    return {};
  }

  SolidMaker& made_;
  Model model_;
  std::size_t vertices_ = 0, triangles_ = 0, placed_ = 0;
};

}  // namespace

Result<void> read_three_mf(SolidMaker& made) { return ThreeMf(made).read(); }

}  // namespace lekalo::verify
