#include <expat.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/refusal.hpp"
#include "lekalo/base/archive_limits.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/double_double.hpp"
#include "solid_builder.hpp"
#include "text_words.hpp"
#include "zip.hpp"

namespace lekalo::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
                           kProduction = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
                           kMaterials = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
                           kTriangleSets =
                               "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
                           kRelations = "http://schemas.openxmlformats.org/package/2006/relationships",
                           kModelRelation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr std::string_view kRelationsPart = "_rels/.rels";
constexpr std::size_t kDeepestXml = 512;

// ---- XML --------------------------------------------------------------------------------------------------

struct Name {
  std::string_view space, local;
};
constexpr char kSeparator = '|';
Name split(std::string_view all) {
  const std::size_t at = all.rfind(kSeparator);
  if (at == std::string_view::npos) return {{}, all};
  return {all.substr(0, at), all.substr(at + 1)};
}

/// The attributes of an element.
class Attributes {
 public:
  explicit Attributes(const XML_Char** list) : list_(list) {}
  /// The core's own attributes have no namespace.
  [[nodiscard]] std::optional<std::string_view> get(std::string_view local,
                                                    std::string_view space = {}) const {
    for (const XML_Char** at = list_; *at != nullptr; at += 2) {
      const Name name = split(at[0]);
      if (name.local == local && name.space == space) return std::string_view(at[1]);
    }
    return std::nullopt;
  }

 private:
  const XML_Char** list_;
};

/// Takes the elements of an XML file one after the other.
class XmlTaker {
 public:
  virtual ~XmlTaker() = default;
  /// Returns the sentence of refusal, or nothing.
  [[nodiscard]] virtual std::string begin(Name name, const Attributes& attributes) = 0;
  virtual void end() {}
  virtual void declare(std::string_view /*prefix*/, std::string_view /*space*/) {}
};

/// Reads a file of the archive as XML without document types.
class XmlReader {
 public:
  explicit XmlReader(XmlTaker& taker)
      : taker_(taker), parser_(XML_ParserCreateNS(nullptr, kSeparator), &XML_ParserFree) {
    if (parser_ == nullptr) throw std::bad_alloc();
    XML_SetHashSalt(parser_.get(), 1);  // any number, because nothing depends on their order
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &XmlReader::start, &XmlReader::finish);
    XML_SetStartDoctypeDeclHandler(parser_.get(), &XmlReader::doctype);
    XML_SetStartNamespaceDeclHandler(parser_.get(), &XmlReader::space);
  }

  Result<void> read(const ZipArchive& archive, const ZipArchive::File& file, const std::string& name) {
    return archive.unpack(file, [&](std::string_view piece, bool last) -> Result<void> {
      // Expat counts in int.
      constexpr std::size_t kChunk = std::size_t{1} << 16;
      for (std::size_t at = 0;; at += kChunk) {
        ask(1024);
        const std::string_view chunk = piece.substr(at, kChunk);
        const bool ends = at + chunk.size() == piece.size();
        const XML_Status status =
            XML_Parse(parser_.get(), chunk.data(), static_cast<int>(chunk.size()), last && ends ? 1 : 0);
        if (!refused_.empty()) return refuse_line(name, refused_line_, refused_);
        if (status != XML_STATUS_OK) {
          const XML_Error error = XML_GetErrorCode(parser_.get());
          if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
          return refuse_line(
              name, line(),
              fmt::format("this is not well-formed XML from here on ({})", XML_ErrorString(error)));
        }
        if (ends) return {};
      }
    });
  }

 private:
  static XmlReader& self(void* user) { return *static_cast<XmlReader*>(user); }
  static void XMLCALL start(void* user, const XML_Char* name, const XML_Char** attributes) {
    XmlReader& r = self(user);
    if (!r.refused_.empty()) return;
    if (++r.depth_ > kDeepestXml)
      return r.stop(fmt::format("elements are nested more than {} deep", kDeepestXml));
    ask();
    if (const std::string wrong = r.taker_.begin(split(name), Attributes(attributes)); !wrong.empty())
      r.stop(wrong);
  }
  static void XMLCALL finish(void* user, const XML_Char*) {
    XmlReader& r = self(user);
    if (!r.refused_.empty()) return;
    --r.depth_;
    r.taker_.end();
  }
  static void XMLCALL doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    self(user).stop("a document type is declared, which 3MF does not allow");
  }
  static void XMLCALL space(void* user, const XML_Char* prefix, const XML_Char* uri) {
    if (prefix != nullptr && uri != nullptr) self(user).taker_.declare(prefix, uri);
  }

  [[nodiscard]] std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }
  void stop(std::string why) {
    refused_ = std::move(why), refused_line_ = line();
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  XmlTaker& taker_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::string refused_;
  std::size_t refused_line_ = 0, depth_ = 0;
};

// ---- transforms -------------------------------------------------------------------------------------------

/// A double and how far at most it is from the number that it stands for.
struct Near {
  double value = 0, error = 0;
};
/// Errors are sums of a few products, rounded.
constexpr double kUp = 1 + 0x1p-48;

Near operator*(Near a, Near b) {
  const geom::DoubleDouble product = geom::two_product(a.value, b.value);
  double error =
      std::abs(product.lo) + std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  // The rounding error of a product so small is no double any more.
  if (std::abs(product.hi) < 0x1p-900 && a.value != 0 && b.value != 0) error += 0x1p-900;
  return {product.hi, error * kUp};
}
Near operator+(Near a, Near b) {
  const geom::DoubleDouble sum = geom::two_sum(a.value, b.value);
  return {sum.hi, (std::abs(sum.lo) + a.error + b.error) * kUp};
}

/// Rows of x, y, z and the shift, as 3MF writes them: a point is a row on the left. Shifts are millimetres.
struct Transform {
  std::array<std::array<Near, 3>, 4> row{};

  static Transform none() {
    Transform made;
    for (std::size_t k = 0; k < 3; ++k) made.row[k][k].value = 1;
    return made;
  }
  [[nodiscard]] std::array<Near, 3> of(const std::array<Near, 3>& p, bool shifted) const {
    std::array<Near, 3> made{};
    for (std::size_t k = 0; k < 3; ++k) {
      made[k] = p[0] * row[0][k] + p[1] * row[1][k] + p[2] * row[2][k];
      if (shifted) made[k] = made[k] + row[3][k];
    }
    return made;
  }
  /// This one first, and then the other.
  [[nodiscard]] Transform then(const Transform& other) const {
    Transform made;
    for (std::size_t k = 0; k < 4; ++k) made.row[k] = other.of(row[k], k == 3);
    return made;
  }
};

// ---- the model --------------------------------------------------------------------------------------------

/// An object by the number of its model in the archive and its id.
using Key = std::pair<std::size_t, std::uint32_t>;

struct Component {
  Key object;
  Transform transform;
  std::size_t line = 0;
};

struct Object {
  std::string name;
  bool is_model = true;  ///< and no support or open surface
  bool is_used = false;
  std::vector<solid::Vector> vertices;
  double error = 0;  ///< of each coordinate, mm
  std::vector<solid::Triangle> triangles;
  std::vector<Component> components;
};

/// All that the models of an archive hold.
struct Model {
  std::vector<std::string> parts;  ///< the models' names in the archive, the root first
  std::map<std::string, std::size_t, std::less<>> number_of_part;
  std::map<Key, Object> objects;
  std::vector<Component> items;
  std::size_t ignored = 0;  ///< elements of extensions
  std::string first_ignored;
  bool has_looks = false;
  SolidUnit unit = SolidUnit::millimetre;  ///< of the root

  /// The number of a part, which is read later if it is new.
  std::size_t part(std::string_view path) {
    if (path.starts_with('/')) path.remove_prefix(1);
    const auto [found, is_new] = number_of_part.try_emplace(std::string(path), parts.size());
    if (is_new) parts.emplace_back(path);
    return found->second;
  }
};

/// Takes one model of the archive.
class ModelTaker final : public XmlTaker {
 public:
  ModelTaker(Model& model, std::size_t part, SolidBuilder& made) : model_(model), made_(made), part_(part) {}

  void declare(std::string_view prefix, std::string_view space) override {
    spaces_.insert_or_assign(std::string(prefix), std::string(space));
  }

  std::string begin(Name name, const Attributes& attributes) override {
    const Where where = open_.empty() ? Where::file : open_.back();
    open_.push_back(Where::passed_over);
    const auto in = [&](Where outer, std::string_view local, Where inner) {
      if (where != outer || name.local != local || name.space != kCore) return false;
      open_.back() = inner;
      return true;
    };
    if (in(Where::file, "model", Where::model)) return begin_model(attributes);
    if (where == Where::file) return fmt::format("the root is {}, not the model of 3MF", excerpt(name.local));
    if (in(Where::model, "resources", Where::resources) || in(Where::model, "build", Where::build)) return {};
    if (in(Where::resources, "object", Where::object)) return begin_object(attributes);
    if (in(Where::object, "mesh", Where::mesh) || in(Where::object, "components", Where::components) ||
        in(Where::mesh, "vertices", Where::vertices) || in(Where::mesh, "triangles", Where::triangles))
      return {};
    if (in(Where::vertices, "vertex", Where::passed_over)) return read_vertex(attributes);
    if (in(Where::triangles, "triangle", Where::passed_over)) return read_triangle(attributes);
    if (in(Where::components, "component", Where::passed_over))
      return read_component(attributes, object_->components);
    if (in(Where::build, "item", Where::passed_over)) return read_item(attributes);
    return pass_over(where, name);
  }
  void end() override { open_.pop_back(); }

 private:
  enum class Where : std::uint8_t {
    file,
    model,
    resources,
    object,
    mesh,
    vertices,
    triangles,
    components,
    build,
    passed_over
  };

  /// Leaves out an element that says nothing about the body. In an object an element that nobody knows may
  /// add to it, or take from it.
  std::string pass_over(Where where, Name name) {
    if (where == Where::passed_over) return {};
    const bool core = name.space == kCore,
               looks = name.space == kMaterials || (core && name.local == "basematerials");
    model_.has_looks = model_.has_looks || (where == Where::resources && looks);
    if (where == Where::model || looks || (where == Where::resources && core)) return {};
    if (where == Where::resources) {
      if (model_.ignored++ == 0) model_.first_ignored = excerpt(name.local);
      return {};
    }
    if (where == Where::object && core && name.local == "metadatagroup") return {};
    if (where == Where::mesh && name.space == kTriangleSets) return {};
    return fmt::format("{} is not read, and nobody knows what the body is without it; export a mesh alone",
                       excerpt(name.local));
  }

  std::string begin_model(const Attributes& attributes) {
    constexpr std::pair<std::string_view, SolidUnit> kUnits[] = {{"millimeter", SolidUnit::millimetre},
                                                                 {"micron", SolidUnit::micron},
                                                                 {"centimeter", SolidUnit::centimetre},
                                                                 {"inch", SolidUnit::inch},
                                                                 {"foot", SolidUnit::foot},
                                                                 {"meter", SolidUnit::metre}};
    const std::string_view word = attributes.get("unit").value_or(kUnits[0].first);
    const auto* const unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                          [&](const auto& one) { return one.first == word; });
    if (unit == std::end(kUnits)) return fmt::format("{} is no unit of 3MF", excerpt(word));
    if (part_ == 0) model_.unit = unit->second;
    if (model_.unit != unit->second) return "the model has another unit than the root";
    if (std::string wrong = made_.set_unit(unit->second); !wrong.empty()) return wrong;
    TextWords prefixes(attributes.get("requiredextensions").value_or(""sv));
    while (const auto prefix = prefixes.next()) {
      const auto found = spaces_.find(*prefix);
      const std::string_view space = found == spaces_.end() ? *prefix : std::string_view(found->second);
      if (space != kProduction && space != kMaterials && space != kTriangleSets)
        return fmt::format(
            "whoever reads it must know the extension {}, which is not read; export a mesh "
            "alone",
            excerpt(space));
    }
    return {};
  }

  std::string begin_object(const Attributes& attributes) {
    std::uint32_t id = 0;
    if (std::string wrong = read_id(attributes, "id", id); !wrong.empty()) return wrong;
    const auto [at, is_new] = model_.objects.try_emplace(Key{part_, id});
    if (!is_new) return fmt::format("object {} is there twice", id);
    object_ = &at->second;
    object_->name = attributes.get("name").value_or(""sv);
    constexpr std::string_view kTypes[] = {"model", "solidsupport", "support", "surface", "other"};
    const std::string_view type = attributes.get("type").value_or(kTypes[0]);
    if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes))
      return fmt::format("{} is no type of an object", excerpt(type));
    object_->is_model = type == kTypes[0];
    model_.has_looks = model_.has_looks || attributes.get("pid").has_value();
    return {};
  }

  static std::string read_id(const Attributes& attributes, std::string_view key, std::uint32_t& id) {
    const auto word = attributes.get(key);
    if (!word) return fmt::format("the attribute {} is missing", key);
    const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), id);
    if (error == std::errc() && end == word->data() + word->size()) return {};
    return fmt::format("{} is {}, not a whole number", key, excerpt(*word));
  }

  std::string read_vertex(const Attributes& attributes) {
    if (object_->vertices.size() == kMostSolidVertices) return too_many_vertices();
    double xyz[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view key = std::string_view("xyz").substr(axis, 1);
      const auto word = attributes.get(key);
      if (!word) return fmt::format("the vertex has no {}", key);
      const auto read = read_millimetres(*word, made_.unit());
      if (!read) return number_sentence(read.error(), *word);
      xyz[axis] = read->value;
      object_->error = std::max(object_->error, read->error);
    }
    object_->vertices.push_back({xyz[0], xyz[1], xyz[2]});
    return {};
  }

  std::string read_triangle(const Attributes& attributes) {
    if (object_->triangles.size() == kMostSolidTriangles) return too_many_triangles();
    constexpr std::string_view kCornerNames[] = {"v1", "v2", "v3"};
    solid::Triangle corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::string wrong = read_id(attributes, kCornerNames[k], corners[k]); !wrong.empty()) return wrong;
      if (corners[k] >= object_->vertices.size())
        return fmt::format("vertex {} is not there: {} before this line, numbered from 0", corners[k],
                           counted(object_->vertices.size(), "vertex stands", "vertices stand"));
    }
    model_.has_looks = model_.has_looks || attributes.get("pid").has_value();
    object_->triangles.push_back(corners);
    return {};
  }

  std::string read_item(const Attributes& attributes) {
    if (part_ > 0) return "a model beside the root has a build";
    return read_component(attributes, model_.items);
  }

  std::string read_component(const Attributes& attributes, std::vector<Component>& list) {
    Component made;
    std::uint32_t id = 0;
    if (std::string wrong = read_id(attributes, "objectid", id); !wrong.empty()) return wrong;
    made.object = {part_, id};
    if (const auto path = attributes.get("path", kProduction)) {
      if (part_ > 0) return "a model beside the root names a third one";
      made.object.first = model_.part(*path);
    }
    // An object of its own file stands before it; so nothing can hold itself.
    if (made.object.first == part_ && (!model_.objects.contains(made.object) ||
                                       (&list != &model_.items && object_ == &model_.objects[made.object])))
      return fmt::format("object {} does not stand before this line", id);
    made.transform = Transform::none();
    const auto words = attributes.get("transform");
    if (std::string wrong = words ? read_transform(*words, made.transform) : ""; !wrong.empty()) return wrong;
    list.push_back(std::move(made));
    return {};
  }

  std::string read_transform(std::string_view text, Transform& made) const {
    TextWords words(text);
    for (std::size_t k = 0; k < 12; ++k) {
      const auto word = words.next();
      if (!word) return fmt::format("the transform has {} numbers, not 12", k);
      const auto read = read_millimetres(*word, k < 9 ? DecimalFactor{} : made_.unit());
      if (!read) return number_sentence(read.error(), *word);
      made.row[k / 3][k % 3] = {read->value, read->error};
    }
    return words.next() ? "the transform has more than 12 numbers" : "";
  }

  Model& model_;
  SolidBuilder& made_;
  std::size_t part_;
  std::vector<Where> open_;
  std::map<std::string, std::string, std::less<>> spaces_;
  Object* object_ = nullptr;
};

/// Takes the target of the relation to the root model.
class RelationTaker final : public XmlTaker {
 public:
  std::optional<std::string> target;

  std::string begin(Name name, const Attributes& attributes) override {
    if (name.space == kRelations && name.local == "Relationship" && !target &&
        attributes.get("Type") == kModelRelation)
      target = attributes.get("Target").value_or(""sv);
    return {};
  }
};

/// Reads the archive and puts the bodies of its build together.
class ThreeMf {
 public:
  ThreeMf(const ZipArchive& archive, SolidBuilder& made) : archive_(archive), made_(made) {}

  Result<void> read() {
    RelationTaker relations;
    LEKALO_CHECK(read_part(kRelationsPart, relations));
    if (!relations.target)
      return refuse(made_.name(), fmt::format("{} names no 3D model in this 3MF", kRelationsPart));
    model_.part(*relations.target);
    for (std::size_t part = 0; part < model_.parts.size(); ++part) {
      ModelTaker taker(model_, part, made_);
      LEKALO_CHECK(read_part(std::string(model_.parts[part]), taker));
    }
    if (model_.items.empty())
      return refuse(made_.name(),
                    "nothing is in the build of this 3MF; place the part there, and export it again");
    for (const auto& [key, object] : model_.objects)
      in_file_.vertices += object.vertices.size(), in_file_.triangles += object.triangles.size();
    for (const Component& item : model_.items) LEKALO_CHECK(place(item, item.transform, 1));
    tell_what_is_left_out();
    if (made_.triangles() == 0)
      return refuse(made_.name(), "there are no triangles in the build of this 3MF");
    return {};
  }

 private:
  template <class Taker>
  Result<void> read_part(std::string_view part, Taker& taker) {
    const ZipArchive::File* const file = archive_.find(part);
    if (file == nullptr)
      return refuse(made_.name(),
                    fmt::format("there is no {} in this 3MF; it is damaged, export it again", excerpt(part)));
    return XmlReader(taker).read(archive_, *file, fmt::format("{}: {}", made_.name(), excerpt(part)));
  }

  Result<void> place(const Component& component, const Transform& transform, std::size_t depth) {
    if (++placed_ > limits::kMostPlacedObjects)
      return refuse(made_.name(), fmt::format("more than {} objects are placed", limits::kMostPlacedObjects));
    if (depth > limits::kMostObjectLevels)
      return refuse(made_.name(), fmt::format("objects are within each other more than {} deep",
                                              limits::kMostObjectLevels));
    const auto found = model_.objects.find(component.object);
    if (found == model_.objects.end())
      return refuse(made_.name(), fmt::format("object {} is not in {}", component.object.second,
                                              excerpt(model_.parts[component.object.first])));
    Object& object = found->second;
    object.is_used = true;
    if (!object.is_model) {
      ++left_out_;
      return {};
    }
    LEKALO_CHECK(place_mesh(object, transform));
    for (const Component& inner : object.components)
      LEKALO_CHECK(place(inner, inner.transform.then(transform), depth + 1));
    return {};
  }

  Result<void> place_mesh(const Object& object, const Transform& transform) {
    const std::size_t first = made_.vertices();
    const std::size_t vertices = first + object.vertices.size(),
                      triangles = made_.triangles() + object.triangles.size();
    if (vertices > in_file_.vertices + limits::kMostPlacedCopies ||
        triangles > in_file_.triangles + limits::kMostPlacedCopies)
      return refuse(made_.name(), fmt::format("placing makes more than {} copies of vertices or triangles; "
                                              "place the part once",
                                              limits::kMostPlacedCopies));
    if (vertices > kMostSolidVertices) return refuse(made_.name(), too_many_vertices());
    if (triangles > kMostSolidTriangles) return refuse(made_.name(), too_many_triangles());
    for (const solid::Vector p : object.vertices) {
      ask();
      const std::array<Near, 3> at =
          transform.of({Near{p.x, object.error}, Near{p.y, object.error}, Near{p.z, object.error}}, true);
      constexpr double kBeyond = std::numeric_limits<double>::infinity();
      double xyz[3], error = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        // An error beyond all numbers makes the value one, too.
        const bool bounded = at[k].error <= kLargestMillimetres;
        const auto read = scaled_millimetres(bounded ? at[k].value : kBeyond, 1);
        if (!read) return refuse(made_.name(), "where it is placed, " + beyond_millimetres(at[k].value));
        xyz[k] = read->value;
        error = std::max(error, read->error + at[k].error);
      }
      made_.add_vertex({xyz[0], xyz[1], xyz[2]}, error);
    }
    if (!object.triangles.empty()) made_.begin_group(object.name);
    for (const solid::Triangle& t : object.triangles) {
      solid::Triangle corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(first + t[k]);
      made_.add_triangle(corners);
    }
    return {};
  }

  void tell_what_is_left_out() {
    if (left_out_ > 0)
      made_.tell(fmt::format("{} no model but support or open surfaces, and not read",
                             counted(left_out_, "object is", "objects are")));
    const auto unused = static_cast<std::size_t>(std::count_if(
        model_.objects.begin(), model_.objects.end(), [](const auto& one) { return !one.second.is_used; }));
    if (unused > 0)
      made_.tell(
          fmt::format("{} not in the build, and not read", counted(unused, "object is", "objects are")));
    if (model_.ignored > 0)
      made_.tell(
          fmt::format("{} not read, the first {}",
                      counted(model_.ignored, "element of an extension is", "elements of extensions are"),
                      model_.first_ignored));
    if (model_.has_looks) made_.tell("colours and materials are not read");
  }

  const ZipArchive& archive_;
  SolidBuilder& made_;
  Model model_;
  struct {
    std::size_t vertices = 0, triangles = 0;
  } in_file_;
  std::size_t placed_ = 0, left_out_ = 0;
};

}  // namespace

bool is_three_mf(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04"sv) &&
         (bytes.find(".model"sv) != std::string_view::npos || bytes.find("3D/"sv) != std::string_view::npos);
}

Result<void> read_three_mf(std::string_view bytes, SolidBuilder& made) {
  LEKALO_TRY(const ZipArchive archive, ZipArchive::open(bytes, made.name()));
  return ThreeMf(archive, made).read();
}

}  // namespace lekalo::io
