#include "lekalo/io/locate/solid_feature_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

constexpr const char* kWhich[]{"triangles", "label", "patch", "box", "plane"};

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

class SpecReader {
 public:
  SpecReader(std::string name, double scale) : name_(std::move(name)), scale_(scale) {}

  Result<SolidFeatureSpec> read(JsonValue json, std::size_t index) {
    where_ = fmt::format("{}, feature {}", name_, index);
    LEKALO_CHECK(detail::expect_object(
        json, where_,
        {"name", "triangles", "label", "patch", "box", "plane", "minimum", "scale", "as_cast"}));
    SolidFeatureSpec spec;
    const auto name = json.find("name");
    if (!name || !is_word(*name)) return refuse(where_, "\"name\" must be a text");
    spec.name = name->text();
    where_ = fmt::format("{}, feature \"{}\"", name_, spec.name);
    LEKALO_CHECK(select(json, spec));
    locate::SolidDemand demand;
    LEKALO_CHECK(detail::take_length(json, "minimum", scale_, where_, [&](double v) { demand.minimum = v; }));
    LEKALO_CHECK(detail::take_scale(json, where_, [&](double v) { demand.scale = v; }));
    const auto as_cast = json.find("as_cast");
    if (as_cast && as_cast->kind() != JsonKind::boolean)
      return refuse(where_, "\"as_cast\" must be true or false");
    if (!as_cast || !as_cast->truth()) {
      spec.demand = demand;
      return spec;
    }
    for (const char* other : {"minimum", "scale"})
      if (json.find(other))
        return refuse(where_, fmt::format("a feature that is as cast has no \"{}\"", other));
    return spec;
  }

 private:
  Result<void> select(JsonValue json, SolidFeatureSpec& spec) const {
    std::optional<JsonValue> said;
    std::size_t count = 0;
    for (const char* word : kWhich)
      if (const auto found = json.find(word)) said = found, ++count;
    if (count != 1)
      return refuse(where_,
                    "one of \"triangles\", \"label\", \"patch\", \"box\" and \"plane\" must say which "
                    "triangles it has");
    const std::string_view key = said->key();
    if (key == "triangles") return numbers(*said, spec);
    if (key == "patch") return patch(*said, spec);
    if (key == "box") return box(*said, spec);
    if (key == "plane") return plane(*said, spec);
    if (!is_word(*said))
      return refuse(where_, "\"label\" must be a text: the name of a solid, group or object");
    spec.which = SolidFeatureSpec::Label{std::string(said->text())};
    return {};
  }

  Result<void> numbers(JsonValue said, SolidFeatureSpec& spec) const {
    SolidFeatureSpec::Numbers made;
    if (said.kind() != JsonKind::list || said.size() == 0)
      return refuse(where_, "\"triangles\" must be a list of triangle numbers");
    for (const JsonValue number : said) {
      if (!is_index(number) || number.integer() > 0xffffffff)
        return refuse(where_, "\"triangles\" must hold whole numbers from 0 on");
      made.triangles.push_back(static_cast<std::uint32_t>(number.integer()));
    }
    spec.which = std::move(made);
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

Result<SolidUnit> unit_of(JsonValue root, const std::string& name, std::optional<SolidUnit> said) {
  const auto units = root.find("units");
  if (!units) return said.value_or(SolidUnit::millimetre);
  for (const auto& [word, unit] :
       {std::pair{"mm", SolidUnit::millimetre}, {"inch", SolidUnit::inch}, {"m", SolidUnit::metre}})
    if (units->text_is(word)) return unit;
  return refuse(name, "\"units\" must be \"mm\", \"inch\" or \"m\"");
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
  LEKALO_CHECK(detail::expect_object(root, name, {"units", "minimum", "features"}));
  LEKALO_TRY(const SolidUnit file_unit, unit_of(root, name, unit));
  const double scale = value_of(decimal_factor(file_unit));
  SolidFeatureFile file{name, {}, {}};
  LEKALO_CHECK(detail::take_length(root, "minimum", scale, name, [&](double v) { file.minimum = v; }));
  const auto features = root.find("features");
  if (!features) return file;
  if (features->kind() != JsonKind::list) return refuse(name, "\"features\" must be a list");
  if (features->size() > kMostSolidFeatures)
    return refuse(name, fmt::format("there are {} features; at most {} are looked for in a solid",
                                    features->size(), kMostSolidFeatures));
  SpecReader reader(name, scale);
  for (const JsonValue item : *features) {
    LEKALO_TRY(auto spec, reader.read(item, file.features.size()));
    file.features.push_back(std::move(spec));
  }
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
    features.push_back({spec.name, std::move(triangles), spec.demand});
  }
  return features;
}

}  // namespace lekalo::io
