#include "lekalo/io/locate/solid_feature_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "feature_words.hpp"
#include "io/solid/solid_builder.hpp"
#include "io/text/json_form.hpp"
#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::io {
namespace {

using detail::is_index;
using detail::is_word;
using detail::JsonKind;
using detail::JsonValue;
using solid::Vector;

/// Sums and products of coordinates that are nearer to each other than this part of what they are made of may
/// be either way: rounding hides less.
constexpr double kHidden = 0x1p-44;
/// The same of a cosine's square, whose normals lose more where triangles are thin.
constexpr double kHiddenTurn = 0x1p-36;

/// An edge of a closed surface has two triangles as a rule. Where so many meet nothing is a patch.
constexpr std::size_t kMostAtEdge = 64;

constexpr const char* kWhich[]{"triangles", "label", "faces", "colour", "patch", "box", "plane"};

std::optional<Vector> three_numbers(JsonValue json) {
  if (json.kind() != JsonKind::list || json.size() != 3) return std::nullopt;
  double all[3]{};
  std::size_t k = 0;
  for (const JsonValue item : json) {
    if (!item.is_number()) return std::nullopt;
    all[k++] = item.number();
  }
  return Vector{all[0], all[1], all[2]};
}

std::string place(Vector p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

Result<bool> take_as_cast(JsonValue json, const std::string& where) {
  const auto as_cast = json.find("as_cast");
  if (as_cast && as_cast->kind() != JsonKind::boolean)
    return refuse(where, "\"as_cast\" must be true or false");
  return as_cast && as_cast->truth();
}

class SpecReader {
 public:
  SpecReader(std::string name, double scale) : name_(std::move(name)), scale_(scale) {}

  Result<SolidFeatureSpec> read(JsonValue json, std::size_t index) {
    where_ = fmt::format("{}, feature {}", name_, index);
    LEKALO_CHECK(
        detail::expect_object(json, where_,
                              {"name", "triangles", "label", "faces", "colour", "patch", "box", "plane",
                               "minimum", "target", "maximum", "scale", "as_cast", "finished", "rim"}));
    SolidFeatureSpec spec;
    const auto name = json.find("name");
    if (!name || !is_word(*name)) return refuse(where_, "\"name\" must be a text");
    spec.name = name->text();
    where_ = fmt::format("{}, feature \"{}\"", name_, spec.name);
    LEKALO_CHECK(select(json, spec));
    locate::SolidDemand demand;
    LEKALO_CHECK(detail::take_length(json, "minimum", scale_, where_, [&](double v) { demand.minimum = v; }));
    LEKALO_CHECK(detail::take_scale(json, where_, [&](double v) { demand.scale = v; }));
    LEKALO_TRY(const bool as_cast, take_as_cast(json, where_));
    LEKALO_CHECK(detail::take_length(json, "finished", scale_, where_, [&](double v) { spec.finished = v; }));
    if (spec.finished && !(*spec.finished > 0))
      return refuse(where_, "\"finished\" is how far its points may lie from the blank's surface, above 0");
    if (json.find("rim") && !spec.finished)
      return refuse(where_, "\"rim\" is of a feature that is finished: what is nearer to it demands nothing");
    LEKALO_CHECK(detail::take_length(json, "rim", scale_, where_, [&](double v) { spec.rim = v; }));
    if (!as_cast && !spec.finished) {
      LEKALO_CHECK(detail::take_length(json, "maximum", scale_, where_, [&](double v) { spec.maximum = v; }));
      if (spec.maximum && !(*spec.maximum > demand.minimum))
        return refuse(where_, fmt::format("\"maximum\" is {} mm; it must be above the minimum, {} mm",
                                          *spec.maximum, demand.minimum));
      LEKALO_CHECK(detail::take_length(json, "target", scale_, where_, [&](double v) { spec.target = v; }));
      spec.demand = demand;
      return spec;
    }
    if (as_cast && spec.finished) return refuse(where_, "a feature is not both as cast and finished");
    for (const char* other : {"minimum", "target", "maximum", "scale"})
      if (json.find(other))
        return refuse(where_, fmt::format("a feature that is {} has no \"{}\"",
                                          as_cast ? "as cast" : "finished", other));
    return spec;
  }

 private:
  Result<void> select(JsonValue json, SolidFeatureSpec& spec) const {
    std::optional<JsonValue> said;
    std::size_t count = 0;
    for (const char* word : kWhich)
      if (const auto found = json.find(word)) said = found, ++count;
    if (count != 1)
      return refuse(
          where_,
          "one of \"triangles\", \"label\", \"faces\", \"colour\", \"patch\", \"box\" and \"plane\" "
          "must say which triangles it has");
    const std::string_view key = said->key();
    if (key == "triangles" || key == "faces") return numbers(*said, spec);
    if (key == "colour") return colour(*said, spec);
    if (key == "patch") return patch(*said, spec);
    if (key == "box") return box(*said, spec);
    if (key == "plane") return plane(*said, spec);
    if (!is_word(*said))
      return refuse(where_, "\"label\" must be a text: the name of a solid, group, object or face");
    spec.which = SolidFeatureSpec::Label{std::string(said->text())};
    return {};
  }

  Result<void> numbers(JsonValue said, SolidFeatureSpec& spec) const {
    const bool of_triangles = said.key() == "triangles";
    std::vector<std::uint32_t> made;
    if (said.kind() != JsonKind::list || said.size() == 0)
      return refuse(where_, fmt::format("\"{}\" must be a list of {} numbers", said.key(),
                                        of_triangles ? "triangle" : "face"));
    for (const JsonValue number : said) {
      if (!is_index(number) || number.integer() > 0xffffffff)
        return refuse(where_, fmt::format("\"{}\" must hold whole numbers from 0 on", said.key()));
      made.push_back(static_cast<std::uint32_t>(number.integer()));
    }
    if (of_triangles)
      spec.which = SolidFeatureSpec::Numbers{std::move(made)};
    else
      spec.which = SolidFeatureSpec::Faces{std::move(made)};
    return {};
  }

  Result<void> colour(JsonValue said, SolidFeatureSpec& spec) const {
    const std::string text = is_word(said) ? std::string(said.text()) : std::string();
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::uint32_t number = 0;
    bool is_one = text.size() == 7 && text.front() == '#';
    for (std::size_t k = 1; k < text.size() && is_one; ++k) {
      const char c = text[k] >= 'A' && text[k] <= 'F' ? static_cast<char>(text[k] - 'A' + 'a') : text[k];
      const std::size_t digit = kDigits.find(c);
      is_one = digit != std::string_view::npos;
      number = 16 * number + static_cast<std::uint32_t>(digit & 15);
    }
    if (!is_one)
      return refuse(where_,
                    "\"colour\" must be a text like \"#ff8000\": red, green and blue, two digits each");
    spec.which = SolidFeatureSpec::Colour{number};
    return {};
  }

  Result<void> patch(JsonValue said, SolidFeatureSpec& spec) const {
    const auto point = three_numbers(said);
    if (!point) return refuse(where_, "\"patch\" must be a point [x, y, z]");
    spec.which = SolidFeatureSpec::Patch{scale_ * *point};
    return {};
  }

  Result<void> box(JsonValue said, SolidFeatureSpec& spec) const {
    std::vector<Vector> corners;
    if (said.kind() == JsonKind::list && said.size() == 2)
      for (const JsonValue corner : said)
        if (const auto p = three_numbers(corner)) corners.push_back(scale_ * *p);
    if (corners.size() != 2)
      return refuse(where_, "\"box\" must be two points [[x, y, z], [x, y, z]], the low and the high corner");
    const Vector low = corners[0], high = corners[1];
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z))
      return refuse(where_, "\"box\" has a low corner above its high one");
    spec.which = SolidFeatureSpec::Box{low, high};
    return {};
  }

  Result<void> plane(JsonValue said, SolidFeatureSpec& spec) const {
    const std::string where = where_ + ", plane";
    LEKALO_CHECK(detail::expect_object(said, where, {"normal", "at", "within"}));
    SolidFeatureSpec::Plane made;
    const auto normal = said.find("normal"), at = said.find("at");
    if (const auto n = normal ? three_numbers(*normal) : std::nullopt) made.normal = *n;
    if (const double length = norm(made.normal); !(length > 1e-9 && length < 1e9))
      return refuse(where, "\"normal\" must be a direction [x, y, z]");
    if (!at || !at->is_number()) return refuse(where, "\"at\" must be the plane's distance from the origin");
    made.at = scale_ * at->number();
    if (!said.find("within"))
      return refuse(where, "\"within\" must be how far off the plane corners may lie");
    LEKALO_CHECK(detail::take_length(said, "within", scale_, where, [&](double v) { made.within = v; }));
    spec.which = made;
    return {};
  }

  std::string name_, where_;
  double scale_;
};

class DatumReader {
 public:
  DatumReader(std::string name, double scale) : name_(std::move(name)), scale_(scale) {}

  Result<SolidDatumSpec> read(JsonValue json, std::size_t index) {
    where_ = fmt::format("{}, datum {}", name_, index);
    LEKALO_CHECK(detail::expect_object(json, where_,
                                       {"name", "feature", "points", "plane", "axis", "point", "within"}));
    SolidDatumSpec spec;
    const auto name = json.find("name");
    if (!name || !is_word(*name)) return refuse(where_, "\"name\" must be a text");
    spec.name = name->text();
    where_ = fmt::format("{}, datum \"{}\"", name_, spec.name);
    LEKALO_CHECK(take_points(json, spec));
    LEKALO_CHECK(take_place(json, spec.datum));
    LEKALO_CHECK(
        detail::take_length(json, "within", scale_, where_, [&](double v) { spec.datum.within = v; }));
    if (!(spec.datum.within > 0)) return refuse(where_, "\"within\" must be a length above 0");
    return spec;
  }

 private:
  Result<void> take_points(JsonValue json, SolidDatumSpec& spec) const {
    const auto feature = json.find("feature"), points = json.find("points");
    if (feature.has_value() == points.has_value())
      return refuse(where_, "one of \"feature\" and \"points\" must say what of the part it holds");
    if (feature) {
      if (!is_word(*feature)) return refuse(where_, "\"feature\" must be the name of a feature");
      spec.which = std::string(feature->text());
      return {};
    }
    if (points->kind() != JsonKind::list || points->size() == 0 || points->size() > kMostDatumPoints)
      return refuse(where_,
                    fmt::format("\"points\" must be a list of 1 to {} points [x, y, z]", kMostDatumPoints));
    std::vector<Vector> made;
    for (const JsonValue point : *points)
      LEKALO_CHECK(take_point(point, "points", where_, made.emplace_back()));
    spec.which = std::move(made);
    return {};
  }

  Result<void> take_place(JsonValue json, locate::SolidDatum& datum) const {
    const auto plane = json.find("plane"), axis = json.find("axis"), point = json.find("point");
    if (plane.has_value() + axis.has_value() + point.has_value() != 1)
      return refuse(where_,
                    "one of \"plane\", \"axis\" and \"point\" must say where in the blank's frame it is");
    if (point) {
      datum.on = locate::SolidDatum::On::point;
      return take_point(point, "point", where_, datum.at);
    }
    datum.on = plane ? locate::SolidDatum::On::plane : locate::SolidDatum::On::axis;
    const char* const key = plane ? "normal" : "along";
    const JsonValue said = plane ? *plane : *axis;
    const std::string where = where_ + (plane ? ", plane" : ", axis");
    LEKALO_CHECK(detail::expect_object(said, where, {key, "through"}));
    const auto direction = said.find(key), through = said.find("through");
    if (const auto n = direction ? three_numbers(*direction) : std::nullopt) datum.direction = *n;
    const double length = norm(datum.direction);
    if (!(length > 1e-9 && length < 1e9))
      return refuse(where, fmt::format("\"{}\" must be a direction [x, y, z]", key));
    datum.direction = 1 / length * datum.direction;
    return take_point(through, "through", where, datum.at);
  }

  Result<void> take_point(std::optional<JsonValue> said, const char* key, const std::string& where,
                          Vector& point) const {
    if (const auto p = said ? three_numbers(*said) : std::nullopt;
        p && norm(scale_ * *p) <= limits::kLargestCoordinate) {
      point = scale_ * *p;
      return {};
    }
    return refuse(where, fmt::format("\"{}\" must be a point [x, y, z] within {:g} mm", key,
                                     limits::kLargestCoordinate));
  }

  std::string name_, where_;
  double scale_;
};

Result<SolidUnit> unit_of(JsonValue root, const std::string& name, std::optional<SolidUnit> said) {
  const auto units = root.find("units");
  if (!units) return said.value_or(SolidUnit::millimetre);
  for (const auto& [word, unit] :
       {std::pair{"mm", SolidUnit::millimetre}, {"inch", SolidUnit::inch}, {"m", SolidUnit::metre}})
    if (units->text_is(word)) return unit;
  return refuse(name, "\"units\" must be \"mm\", \"inch\" or \"m\"");
}

/// Reads a list by an item reader, if there is one.
template <class Reader, class Item>
Result<void> take_list(JsonValue root, const char* key, std::size_t most, Reader reader,
                       const std::string& name, std::vector<Item>& items) {
  const auto list = root.find(key);
  if (!list) return {};
  if (list->kind() != JsonKind::list) return refuse(name, fmt::format("\"{}\" must be a list", key));
  if (list->size() > most)
    return refuse(
        name, fmt::format("there are {} {}; at most {} are looked for in a solid", list->size(), key, most));
  for (const JsonValue item : *list) {
    LEKALO_TRY(auto read, reader.read(item, items.size()));
    items.push_back(std::move(read));
  }
  return {};
}

/// Finds triangles in the file of a part.
class TriangleFinder {
 public:
  explicit TriangleFinder(const SolidFile& part) : part_(part), mesh_(part.mesh) {}

  Result<std::vector<std::uint32_t>> find(const SolidFeatureSpec& spec, const std::string& where) {
    where_ = where;
    return std::visit([&](const auto& which) { return found(which); }, spec.which);
  }

 private:
  using Found = Result<std::vector<std::uint32_t>>;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }
  [[nodiscard]] solid::Corners corners(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }

  Found found(const SolidFeatureSpec::Numbers& which) {
    for (const std::uint32_t t : which.triangles)
      if (t >= count())
        return refuse(where_, fmt::format("triangle {} is not one of the part's {}", t, count()));
    return which.triangles;
  }

  Found found(const SolidFeatureSpec::Label& which) {
    const auto group = std::find(part_.groups.begin(), part_.groups.end(), which.name);
    if (group == part_.groups.end()) {
      std::vector<std::string> known = part_.groups;
      std::erase(known, "");
      return refuse(
          where_, fmt::format("no triangle of the part has the label \"{}\"; there {}", which.name,
                              known.empty() ? "are none" : fmt::format("is: {}", joined_text(known, ", "))));
    }
    std::vector<std::uint32_t> made;
    for (std::uint32_t t = 0; t < count(); ++t)
      if (part_.group_of_triangle[t] == static_cast<std::uint32_t>(group - part_.groups.begin()))
        made.push_back(t);
    return made;
  }

  Found found(const SolidFeatureSpec::Faces& which) {
    const std::vector<std::uint32_t>& face_of = part_.face_of_triangle;
    if (face_of.empty())
      return refuse(where_,
                    "the part has no faces by number, which meshes by lekalo-step have; name the triangles "
                    "by \"patch\", \"box\" or \"plane\"");
    std::vector<std::uint32_t> made;
    for (const std::uint32_t face : which.faces) {
      const std::size_t before = made.size();
      for (std::uint32_t t = 0; t < count(); ++t)
        if (face_of[t] == face) made.push_back(t);
      if (made.size() == before)
        return refuse(where_, fmt::format("face {} is none of the part's {}", face,
                                          1 + *std::max_element(face_of.begin(), face_of.end())));
    }
    return made;
  }

  Found found(const SolidFeatureSpec::Colour& which) {
    const std::vector<std::uint32_t>& colours = part_.colour_of_face;
    std::vector<std::uint32_t> made;
    for (std::uint32_t t = 0; t < count() && !colours.empty(); ++t)
      if (const std::uint32_t face = part_.face_of_triangle[t];
          face < colours.size() && colours[face] == which.number)
        made.push_back(t);
    if (!made.empty()) return made;
    std::set<std::string> known;
    for (const std::uint32_t colour : colours)
      if (colour != SolidFile::kNoColour) known.insert(fmt::format("#{:06x}", colour));
    if (known.empty())
      return refuse(where_,
                    "the part has no colours, which meshes by lekalo-step have where the faces of the STEP "
                    "file do; make the mesh again, or name the triangles by \"faces\" or \"patch\"");
    return refuse(where_,
                  fmt::format("no face of the part has the colour \"#{:06x}\"; there is: {}", which.number,
                              joined_text(std::vector<std::string>(known.begin(), known.end()), ", ")));
  }

  Found found(const SolidFeatureSpec::Box& which) {
    return all_corners([&](Vector p) {
      return p.x >= which.low.x && p.y >= which.low.y && p.z >= which.low.z && p.x <= which.high.x &&
             p.y <= which.high.y && p.z <= which.high.z;
    });
  }

  Found found(const SolidFeatureSpec::Plane& which) {
    const Vector n = which.normal;
    const double length = norm(n), within = length * which.within;
    // Along an axis nothing is rounded that need be.
    const bool exact = (n.x != 0) + (n.y != 0) + (n.z != 0) == 1 && which.within == 0;
    std::optional<Vector> doubtful;
    auto made = all_corners([&](Vector p) {
      const double off = std::abs(dot(n, p) - length * which.at) - within,
                   size = length * (norm(p) + std::abs(which.at) + which.within);
      if (!exact && std::abs(off) <= kHidden * size) doubtful = p;
      return off <= 0;
    });
    if (doubtful)
      return refuse(where_, fmt::format("the corner {} is as far off the plane as \"within\" allows, as far "
                                        "as rounding lets that be told; say a little more or less",
                                        place(*doubtful)));
    return made;
  }

  template <class Holds>
  [[nodiscard]] std::vector<std::uint32_t> all_corners(const Holds& holds) const {
    std::vector<std::uint32_t> made;
    for (std::uint32_t t = 0; t < count(); ++t) {
      ask();
      const solid::Corners at = corners(t);
      if (std::all_of(at.begin(), at.end(), holds)) made.push_back(t);
    }
    return made;
  }

  Found found(const SolidFeatureSpec::Patch& which) {
    if (patches_.empty()) join_patches();
    if (crowded_)
      return refuse(where_,
                    fmt::format("triangle {} has an edge at which more than {} meet; name the triangles "
                                "by \"box\", \"plane\" or \"triangles\"",
                                *crowded_, kMostAtEdge));
    double nearest = std::numeric_limits<double>::infinity(), size = norm(which.point);
    std::vector<double> far(count());
    for (std::uint32_t t = 0; t < count(); ++t) {
      ask();
      const solid::Corners at = corners(t);
      for (const Vector p : at) size = std::max(size, norm(p));
      far[t] = solid::distance(at, which.point);
      nearest = std::min(nearest, far[t]);
    }
    std::optional<std::uint32_t> patch;
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (far[t] > nearest + kHidden * size) continue;
      if (patch && *patch != patches_[t])
        return refuse(where_, fmt::format("{} is as near to one patch as to another; give a point beside the "
                                          "middle of one",
                                          place(which.point)));
      patch = patches_[t];
    }
    for (const auto& [a, b] : doubtful_)
      if ((patches_[a] == *patch) != (patches_[b] == *patch))
        return refuse(where_, fmt::format("triangles {} and {} meet at 30 degrees, as far as rounding lets "
                                          "that be told, so they may be one patch or two; name the triangles "
                                          "by \"box\", \"plane\" or \"triangles\"",
                                          a, b));
    std::vector<std::uint32_t> made;
    for (std::uint32_t t = 0; t < count(); ++t)
      if (patches_[t] == *patch) made.push_back(t);
    return made;
  }

  /// Joins triangles through edges where their normals differ by less than 30 degrees.
  void join_patches() {
    // Vertices at one place have one number.
    std::vector<std::uint32_t> order(mesh_.vertices.size()), number(mesh_.vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
      const Vector a = mesh_.vertices[i], b = mesh_.vertices[j];
      return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::sort(order.begin(), order.end(), before);
    for (std::size_t k = 0; k < order.size(); ++k)
      number[order[k]] =
          k > 0 && !before(order[k - 1], order[k]) ? number[order[k - 1]] : static_cast<std::uint32_t>(k);
    struct Edge {
      std::uint32_t low, high, triangle;
      bool operator<(const Edge& other) const {
        return low != other.low     ? low < other.low
               : high != other.high ? high < other.high
                                    : triangle < other.triangle;
      }
    };
    std::vector<Edge> edges;
    std::vector<Vector> normals;
    for (std::uint32_t t = 0; t < count(); ++t) {
      const solid::Corners at = corners(t);
      normals.push_back(cross(at[1] - at[0], at[2] - at[0]));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = number[mesh_.triangles[t][k]], b = number[mesh_.triangles[t][(k + 1) % 3]];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t});
      }
    }
    std::sort(edges.begin(), edges.end());
    DisjointSets sets(count());
    for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
      ask();
      for (end = begin;
           end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high;)
        ++end;
      if (end - begin > kMostAtEdge) crowded_ = edges[begin].triangle;
      if (crowded_) break;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = i + 1; j < end; ++j) {
          const Vector m = normals[edges[i].triangle], n = normals[edges[j].triangle];
          const double along = dot(m, n), squares = dot(m, m) * dot(n, n),
                       bend = 4 * along * along - 3 * squares;
          if (!(along > 0)) continue;
          if (std::abs(bend) <= kHiddenTurn * squares) {
            doubtful_.emplace_back(edges[i].triangle, edges[j].triangle);
          } else if (bend > 0) {
            sets.join(edges[i].triangle, edges[j].triangle);
          }
        }
    }
    for (std::uint32_t t = 0; t < count(); ++t) patches_.push_back(sets.of(t));
  }

  const SolidFile& part_;
  const solid::Mesh& mesh_;
  std::string where_;
  /// The patch of each triangle, by its first one; and pairs that may be of one or of two.
  std::vector<std::uint32_t> patches_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> doubtful_;
  std::optional<std::uint32_t> crowded_;
};

}  // namespace

Result<SolidFeatureFile> parse_solid_features(std::string_view bytes, const std::string& name,
                                              std::optional<SolidUnit> unit) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  const JsonValue root = tree.root();
  LEKALO_CHECK(detail::expect_object(root, name, {"units", "minimum", "as_cast", "features", "datums"}));
  LEKALO_TRY(const SolidUnit file_unit, unit_of(root, name, unit));
  const double scale = value_of(decimal_factor(file_unit));
  SolidFeatureFile file;
  file.name = name;
  LEKALO_CHECK(detail::take_length(root, "minimum", scale, name, [&](double v) { file.minimum = v; }));
  LEKALO_TRY(file.as_cast, take_as_cast(root, name));
  if (file.as_cast && file.minimum) return refuse(name, "what is as cast has no \"minimum\"");
  LEKALO_CHECK(take_list(root, "features", kMostSolidFeatures, SpecReader(name, scale), name, file.features));
  LEKALO_CHECK(take_list(root, "datums", kMostDatums, DatumReader(name, scale), name, file.datums));
  return file;
}

Result<std::vector<SolidFeature>> find_solid_features(const SolidFeatureFile& file, const SolidFile& part) {
  constexpr std::uint32_t kNobody = 0xffffffff;
  TriangleFinder finder(part);
  std::vector<std::uint32_t> owner(part.mesh.triangles.size(), kNobody);
  std::vector<SolidFeature> features;
  for (const SolidFeatureSpec& spec : file.features) {
    const std::string where = fmt::format("{}, feature \"{}\"", file.name, spec.name);
    LEKALO_TRY(auto triangles, finder.find(spec, where));
    if (triangles.empty()) return refuse(where, "no triangle of the part is of it");
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const auto number = static_cast<std::uint32_t>(features.size());
    for (const std::uint32_t t : triangles) {
      if (owner[t] != kNobody)
        return refuse(where, fmt::format("triangle {} is also of the feature \"{}\"; it can be of one", t,
                                         features[owner[t]].name));
      owner[t] = number;
    }
    features.push_back(
        {spec.name, std::move(triangles), spec.demand, spec.maximum, spec.finished, spec.rim, spec.target});
  }
  return features;
}

Result<std::vector<locate::SolidDatum>> find_solid_datums(const SolidFeatureFile& file,
                                                          const std::vector<SolidFeature>& features,
                                                          const SolidFile& part) {
  std::vector<locate::SolidDatum> datums;
  for (const SolidDatumSpec& spec : file.datums) {
    datums.push_back(spec.datum);
    std::vector<locate::SolidDatum::Point>& points = datums.back().points;
    if (const auto* const given = std::get_if<std::vector<Vector>>(&spec.which)) {
      for (const Vector p : *given) points.push_back({p, static_cast<std::uint32_t>(points.size())});
      continue;
    }
    const std::string& wanted = std::get<std::string>(spec.which);
    const auto is_it = [&](const SolidFeature& one) { return one.name == wanted; };
    if (const auto count = std::count_if(features.begin(), features.end(), is_it); count != 1)
      return refuse(fmt::format("{}, datum \"{}\"", file.name, spec.name),
                    fmt::format("there {} named \"{}\"",
                                count == 0 ? "is no feature" : "are several features", wanted));
    std::set<std::uint32_t> seen;
    for (const std::uint32_t t : std::find_if(features.begin(), features.end(), is_it)->triangles)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (const std::uint32_t v = part.mesh.triangles[t][k]; seen.insert(v).second)
          points.push_back({part.mesh.vertices[v], 3 * t + k});
  }
  return datums;
}

}  // namespace lekalo::io
