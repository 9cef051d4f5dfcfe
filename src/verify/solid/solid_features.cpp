#include "solid_features.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <string_view>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_document.hpp"
#include "triangle_distance.hpp"
#include "verify/number/both.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

constexpr std::array<std::string_view, 7> kWays{"triangles", "label", "faces", "colour",
                                                "patch",     "box",   "plane"};

/// Returns the sign of a number: an enclosure tells it nearly always.
template <class Exact>
int sign_of(Span quick, const Exact& exact) {
  const int sure = sure_sign(quick);
  return sure == 0 ? sgn(exact()) : sure;
}

/// Finds triangles of the part's file.
class TriangleFinder {
 public:
  explicit TriangleFinder(const SolidReading& part) : part_(part), mesh_(part.mesh) {}

  [[nodiscard]] std::size_t count() const { return mesh_.triangles.size(); }

  [[nodiscard]] Both3 corner(std::uint32_t triangle, std::size_t k) const {
    const std::uint32_t v = mesh_.triangles[triangle][k];
    Both3 place;
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = {mesh_.exact(v, axis), mesh_.enclosed(v, axis)};
    return place;
  }

  [[nodiscard]] std::vector<std::uint32_t> labelled(const std::string& label) const {
    const auto group = std::ranges::find(part_.groups, label);
    return all([&](std::uint32_t t) {
      return group != part_.groups.end() &&
             part_.group_of[t] == static_cast<std::uint32_t>(group - part_.groups.begin());
    });
  }

  [[nodiscard]] std::vector<std::uint32_t> of_face(std::size_t face) const {
    return all([&](std::uint32_t t) { return !part_.face_of.empty() && part_.face_of[t] == face; });
  }

  [[nodiscard]] std::vector<std::uint32_t> coloured(std::uint32_t colour) const {
    return all([&](std::uint32_t t) {
      return !part_.face_of.empty() && part_.face_of[t] < part_.colours.size() &&
             part_.colours[part_.face_of[t]] == colour;
    });
  }

  [[nodiscard]] std::vector<std::uint32_t> in_box(const Both3& low, const Both3& high) const {
    return with_corners([&](std::uint32_t v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Span at = mesh_.enclosed(v, axis);
        const auto exact = [&] { return mesh_.exact(v, axis); };
        if (sign_of(low[axis].near - at, [&] { return Fraction(low[axis].exact - exact()); }) > 0 ||
            sign_of(at - high[axis].near, [&] { return Fraction(exact() - high[axis].exact); }) > 0)
          return false;
      }
      return true;
    });
  }

  [[nodiscard]] std::vector<std::uint32_t> along_plane(const Both3& normal, const Both& at,
                                                       const Both& within) const {
    const Vec3 n = as<Span>(normal);
    const Exact3 exact_n = as<Fraction>(normal);
    const Fraction square = dot(exact_n, exact_n);
    /// Says on which side of so many lengths of n the point is along n.
    const auto side_of = [&](std::uint32_t v, const Fraction& lengths) {
      return sign_of(dot(n, enclosed_at(v)) - enclosed(lengths) * length(n), [&] {
        const Fraction along = dot(exact_n, exact_at(v));
        // The squares of two numbers of one sign tell which is larger.
        if (sgn(along) != sgn(lengths)) return Fraction(sgn(along) - sgn(lengths));
        return Fraction(sgn(lengths) * (along * along - lengths * lengths * square));
      });
    };
    const Fraction most = at.exact + within.exact, least = at.exact - within.exact;
    return with_corners([&](std::uint32_t v) { return side_of(v, most) <= 0 && side_of(v, least) >= 0; });
  }

  [[nodiscard]] std::vector<std::uint32_t> patch_at(const Both3& place) {
    join_patches();
    const std::uint32_t wanted = root(nearest_to(place));
    return all([&](std::uint32_t t) { return root(t) == wanted; });
  }

 private:
  template <class Holds>
  [[nodiscard]] std::vector<std::uint32_t> all(const Holds& holds) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < count(); ++t) {
      ask();
      if (holds(t)) found.push_back(t);
    }
    return found;
  }
  template <class Holds>
  [[nodiscard]] std::vector<std::uint32_t> with_corners(const Holds& holds) const {
    return all([&](std::uint32_t t) { return std::ranges::all_of(mesh_.triangles[t], holds); });
  }
  [[nodiscard]] Vec3 enclosed_at(std::uint32_t v) const {
    return {mesh_.enclosed(v, 0), mesh_.enclosed(v, 1), mesh_.enclosed(v, 2)};
  }
  [[nodiscard]] Exact3 exact_at(std::uint32_t v) const {
    return {mesh_.exact(v, 0), mesh_.exact(v, 1), mesh_.exact(v, 2)};
  }
  [[nodiscard]] Triangle3 enclosed_triangle(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {enclosed_at(a), enclosed_at(b), enclosed_at(c)};
  }
  [[nodiscard]] ExactTriangle exact_triangle(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {exact_at(a), exact_at(b), exact_at(c)};
  }

  /// Returns the first of the nearest triangles.
  [[nodiscard]] std::uint32_t nearest_to(const Both3& place) const {
    const Vec3 p = as<Span>(place);
    double least = kInfinity;
    std::vector<double> low;
    for (std::uint32_t t = 0; t < count(); ++t) {
      ask();
      const Span found = distance({p, p, p}, enclosed_triangle(t), least);
      low.push_back(found.low);
      least = std::min(least, found.high);
    }
    std::optional<Fraction> best;
    std::uint32_t nearest = 0;
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (low[t] > least) continue;
      ask(100);
      const Fraction found = exact_squared_distance(as<Fraction>(place), exact_triangle(t));
      if (!best || found < *best) best = found, nearest = t;
    }
    return nearest;
  }

  /// Says whether two triangles turn by less than 30 degrees against each other.
  [[nodiscard]] bool go_on(std::uint32_t s, std::uint32_t t) const {
    const Vec3 m = normal(enclosed_triangle(s)), n = normal(enclosed_triangle(t));
    const Span along = dot(m, n), rest = just(3) * dot(m, m) * dot(n, n) - just(4) * squared(along);
    const auto exact_m = [&] { return normal(exact_triangle(s)); };
    const auto exact_n = [&] { return normal(exact_triangle(t)); };
    const auto exact_along = [&] { return dot(exact_m(), exact_n()); };
    const auto exact_rest = [&] {
      const Fraction root = 2 * exact_along();
      return Fraction(3 * dot(exact_m(), exact_m()) * dot(exact_n(), exact_n()) - root * root);
    };
    return sign_of(rest, exact_rest) < 0 && sign_of(along, exact_along) > 0;
  }

  /// Joins triangles through edges; corners at one place are one.
  void join_patches() {
    if (!parent_.empty()) return;
    parent_.resize(count());
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::vector<std::uint32_t> order(mesh_.near.size()), place(mesh_.near.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t v) { return mesh_.near[v]; });
    for (std::size_t k = 0; k < order.size(); ++k)
      place[order[k]] =
          k > 0 && mesh_.near[order[k]] == mesh_.near[order[k - 1]] ? place[order[k - 1]] : order[k];
    /// Two places, and the triangle.
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = place[mesh_.triangles[t][k]], b = place[mesh_.triangles[t][(k + 1) % 3]];
        if (a != b) edges.emplace_back(std::minmax(a, b), t);
      }
    ask(edges.size());
    std::ranges::sort(edges);
    for (std::size_t i = 1; i < edges.size(); ++i)
      for (std::size_t j = i; j-- > 0 && edges[j].first == edges[i].first;) {
        ask();
        const auto [s, t] = std::minmax({root(edges[i].second), root(edges[j].second)});
        if (go_on(edges[i].second, edges[j].second)) parent_[t] = s;
      }
  }
  std::uint32_t root(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  const SolidReading& part_;
  const SolidMesh& mesh_;
  std::vector<std::uint32_t> parent_;
};

class FeatureReader {
 public:
  FeatureReader(const SolidReading& part, SolidUnit unit, std::string& complaint)
      : finder_(part), unit_(unit), complaint_(complaint) {}

  SolidDemands read(Json root) {
    SolidDemands demands;
    demands.feature_of.assign(finder_.count(), 0);
    Fields file(root, "", complaint_);
    refuse_other_words(file, {"units", "minimum", "as_cast", "features", "datums"});
    if (has(file, "units")) {
      constexpr std::array<std::string_view, 3> kWords{"mm", "inch", "m"};
      const auto unit = std::ranges::find(kWords, file.text("units"));
      if (unit == kWords.end())
        file.complain("field units is none of \"mm\", \"inch\" and \"m\"");
      else
        unit_ = static_cast<SolidUnit>(unit - kWords.begin());
    }
    demands.minimum = length(file, "minimum");
    if (is_as_cast(file, {"minimum"})) demands.minimum.reset();
    if (has(file, "features"))
      file.each("features", [&](Json item, const std::string& path) {
        if (complaint_.empty()) add(item, path, demands);
      });
    if (has(file, "datums"))
      file.each("datums", [&](Json item, const std::string& path) {
        if (complaint_.empty()) add_datum(item, path, demands);
      });
    return demands;
  }

 private:
  static bool has(const Fields& fields, std::string_view key) { return !fields.get(key).text.empty(); }
  static bool is_said(const Fields& fields, std::string_view key) {
    return has(fields, key) && !fields.get(key).is_null();
  }

  /// Complains of words that would be demands if somebody knew them.
  static void refuse_other_words(Fields& fields, std::initializer_list<std::string_view> known) {
    fields.each_key([&](std::string_view key) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        fields.complain(fmt::format("field {} is no word of a file of features", fields.name(key)));
    });
  }

  void add(Json item, const std::string& path, SolidDemands& demands) {
    Fields fields(item, path, complaint_);
    refuse_other_words(fields, {"name", "triangles", "label", "faces", "colour", "patch", "box", "plane",
                                "minimum", "target", "maximum", "scale", "as_cast", "finished", "rim"});
    SolidFeature feature{fields.text("name"), demand(fields), 0};
    if (is_said(fields, "finished")) {
      feature.finished = true;
      feature.within = length(fields, "finished");
      if (!(*feature.within > 0))
        fields.complain(fmt::format("field {} is not above 0", fields.name("finished")));
      feature.rim = length(fields, "rim");
    } else if (is_said(fields, "maximum")) {
      feature.within = length(fields, "maximum");
      if (feature.demand && !(*feature.within > feature.demand->minimum))
        fields.complain(fmt::format("field {} is not above the minimum", fields.name("maximum")));
    }
    if (is_said(fields, "target")) feature.target = length(fields, "target");
    if (has(fields, "rim") && !feature.finished)
      fields.complain(fmt::format("field {} is of what is not finished", fields.name("rim")));
    std::vector<std::uint32_t> triangles = triangles_of(fields);
    if (!complaint_.empty()) return;
    std::ranges::sort(triangles);
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    feature.triangles = triangles.size();
    if (triangles.empty()) fields.complain(path + " has no triangle of the part");
    demands.features.push_back(std::move(feature));
    for (const std::uint32_t t : triangles) {
      if (demands.feature_of[t] != 0)
        fields.complain(fmt::format("triangle {} is of two features, {} and features[{}]", t, path,
                                    demands.feature_of[t] - 1));
      demands.feature_of[t] = static_cast<std::uint32_t>(demands.features.size());
    }
  }

  void add_datum(Json item, const std::string& path, SolidDemands& demands) {
    Fields fields(item, path, complaint_);
    refuse_other_words(fields, {"name", "feature", "points", "plane", "axis", "point", "within"});
    SolidDatum datum{fields.text("name")};
    datum.within = length(fields, "within");
    if (!(datum.within > 0)) fields.complain(fmt::format("field {} is not above 0", fields.name("within")));
    take_place(fields, datum);
    if (has(fields, "feature") == has(fields, "points"))
      fields.complain(fields.name("name") + " is of a datum that has not one of a feature and points");
    if (!complaint_.empty()) return;
    if (has(fields, "feature"))
      take_corners(fields, demands, datum);
    else
      fields.each("points",
                  [&](Json one, const std::string& name) { datum.points.push_back(point(one, name)); });
    if (datum.points.empty()) fields.complain(path + " has no point of the part");
    demands.datums.push_back(std::move(datum));
  }

  void take_corners(Fields& fields, const SolidDemands& demands, SolidDatum& datum) {
    const std::string wanted = fields.text("feature");
    const auto is_it = [&](const SolidFeature& one) { return one.name == wanted; };
    if (std::ranges::count_if(demands.features, is_it) != 1)
      return fields.complain(
          fmt::format("field {} is the name of no feature, or of several", fields.name("feature")));
    const auto number = static_cast<std::uint32_t>(std::ranges::find_if(demands.features, is_it) -
                                                   demands.features.begin() + 1);
    for (std::uint32_t t = 0; t < finder_.count(); ++t) {
      if (demands.feature_of[t] != number) continue;
      datum.triangles.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) datum.points.push_back(finder_.corner(t, k));
    }
  }

  void take_place(Fields& fields, SolidDatum& datum) {
    if (has(fields, "plane") + has(fields, "axis") + has(fields, "point") != 1)
      return fields.complain(fields.name("name") +
                             " is of a datum that is not on one of a plane, an axis and a point");
    if (has(fields, "point")) {
      datum.on = SolidDatum::On::point;
      datum.through = point(fields.get("point"), fields.name("point"));
      return;
    }
    const bool is_plane = has(fields, "plane");
    const std::string_view word = is_plane ? "plane" : "axis", key = is_plane ? "normal" : "along";
    datum.on = is_plane ? SolidDatum::On::plane : SolidDatum::On::axis;
    Fields of(fields.get(word), fields.name(word), complaint_);
    refuse_other_words(of, {key, "through"});
    datum.direction = direction(of, key);
    datum.through = point(of.get("through"), of.name("through"));
  }

  /// Says whether there is no demand, and complains of those that are there all the same.
  bool is_as_cast(Fields& fields, std::initializer_list<const char*> demands) {
    if (!has(fields, "as_cast")) return false;
    const Json as_cast = fields.get("as_cast");
    if (!as_cast.is_bool())
      fields.complain(fmt::format("field {} is neither true nor false", fields.name("as_cast")));
    if (!as_cast.is_true()) return false;
    for (const char* one : demands)
      if (has(fields, one))
        fields.complain(fmt::format("field {} is a demand on what is as cast", fields.name(one)));
    return true;
  }

  std::optional<SolidDemand> demand(Fields& fields) {
    if (is_as_cast(fields, {"minimum", "target", "maximum", "scale", "finished"})) return std::nullopt;
    if (is_said(fields, "finished")) {
      for (const char* one : {"minimum", "target", "maximum", "scale"})
        if (has(fields, one))
          fields.complain(fmt::format("field {} is a demand on what is finished", fields.name(one)));
      return std::nullopt;
    }
    SolidDemand made{.minimum = length(fields, "minimum")};
    if (has(fields, "scale")) made.scale = approximate(fields.number("scale"));
    if (!(made.scale > 0 && std::isfinite(made.scale)))
      fields.complain(fmt::format("field {} is not above 0", fields.name("scale")));
    return made;
  }

  std::vector<std::uint32_t> triangles_of(Fields& fields) {
    std::string_view way;
    for (const std::string_view one : kWays) {
      if (!has(fields, one)) continue;
      if (!way.empty()) fields.complain(fields.name(one) + " is a second way to say which triangles it has");
      way = one;
    }
    if (way.empty()) fields.complain(fields.name("name") + " is of a feature that says of no triangle");
    if (!complaint_.empty()) return {};
    if (way == "triangles") return numbered(fields);
    if (way == "faces") return of_faces(fields);
    if (way == "label") return finder_.labelled(fields.text("label"));
    if (way == "colour") return of_colour(fields);
    if (way == "patch") {
      const Both3 place = point(fields.get("patch"), fields.name("patch"));
      return complaint_.empty() ? finder_.patch_at(place) : std::vector<std::uint32_t>{};
    }
    return way == "box" ? boxed(fields) : flat(fields);
  }

  std::vector<std::uint32_t> numbered(Fields& fields) {
    std::vector<std::uint32_t> found;
    fields.each("triangles", [&](Json item, const std::string& path) {
      const std::size_t number = fields.index_of(item, path);
      if (number >= finder_.count())
        fields.complain(
            fmt::format("field {} is {}, but the part has {} triangles", path, number, finder_.count()));
      found.push_back(static_cast<std::uint32_t>(number));
    });
    return found;
  }

  std::vector<std::uint32_t> of_faces(Fields& fields) {
    std::vector<std::uint32_t> found;
    fields.each("faces", [&](Json item, const std::string& path) {
      const std::vector<std::uint32_t> of_one = finder_.of_face(fields.index_of(item, path));
      if (of_one.empty()) fields.complain(fmt::format("field {} is the number of no face of the part", path));
      found.insert(found.end(), of_one.begin(), of_one.end());
    });
    return found;
  }

  std::vector<std::uint32_t> of_colour(Fields& fields) {
    const std::string text = fields.text("colour");
    const bool is_hexadecimal = text.size() == 7 && text[0] == '#' &&
                                text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    std::uint32_t number{};
    if (is_hexadecimal) std::from_chars(text.data() + 1, text.data() + text.size(), number, 16);
    if (!is_hexadecimal)
      fields.complain(fmt::format("field {} is no colour like #ff8000", fields.name("colour")));
    return is_hexadecimal ? finder_.coloured(number) : std::vector<std::uint32_t>{};
  }

  std::vector<std::uint32_t> boxed(Fields& fields) {
    std::vector<Both3> ends;
    fields.each("box", [&](Json item, const std::string& path) { ends.push_back(point(item, path)); });
    if (ends.size() != 2)
      fields.complain(fmt::format("field {} is not a low and a high corner", fields.name("box")));
    if (!complaint_.empty()) return {};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (ends[0][axis].exact > ends[1][axis].exact)
        fields.complain(fmt::format("field {} has a low corner above its high one", fields.name("box")));
    return finder_.in_box(ends[0], ends[1]);
  }

  std::vector<std::uint32_t> flat(Fields& fields) {
    Fields plane(fields.get("plane"), fields.name("plane"), complaint_);
    refuse_other_words(plane, {"normal", "at", "within"});
    const Both3 n = direction(plane, "normal");
    const Both at = in_mm(plane.number("at")), within = in_mm(plane.number("within"));
    if (sgn(within.exact) < 0) plane.complain(fmt::format("field {} is below 0", plane.name("within")));
    if (!complaint_.empty()) return {};
    return finder_.along_plane(n, at, within);
  }

  Both3 direction(Fields& fields, std::string_view key) {
    const auto numbers =
        numbers_of<3>(fields.get(key), complaint_, [&] { return "field " + fields.name(key); });
    if (!numbers) return {};
    const Both3 n{both((*numbers)[0]), both((*numbers)[1]), both((*numbers)[2])};
    if (std::ranges::all_of(n, [](const Both& one) { return sgn(one.exact) == 0; }))
      fields.complain(fmt::format("field {} is 0, which is no direction", fields.name(key)));
    return n;
  }
  Both in_mm(const Decimal& number) {
    Both made{to_fraction(number) * to_fraction(millimetres_of(unit_))};
    made.near = enclosed(made.exact);
    return made;
  }
  Both3 point(Json list, const std::string& path) {
    const auto numbers = numbers_of<3>(list, complaint_, [&] { return "field " + path; });
    if (!numbers) return {};
    return {in_mm((*numbers)[0]), in_mm((*numbers)[1]), in_mm((*numbers)[2])};
  }
  /// Returns a length in mm; 0 where there is none, or null.
  double length(Fields& fields, std::string_view key) {
    if (!has(fields, key)) return 0;
    const std::optional<Decimal> number = fields.number_or_null(key);
    constexpr std::array kMillimetres{1.0, 25.4, 1000.0};
    const double mm = number ? kMillimetres[static_cast<std::size_t>(unit_)] * approximate(*number) : 0;
    if (!(mm >= 0 && mm <= limits::kLargestCoordinate))
      fields.complain(fmt::format("field {} is no length from 0 to {:g} mm", fields.name(key),
                                  limits::kLargestCoordinate));
    return mm;
  }

  TriangleFinder finder_;
  SolidUnit unit_;
  std::string& complaint_;
};

}  // namespace

Result<SolidDemands> read_solid_features(const Document& document, const SolidReading& part, SolidUnit unit) {
  LEKALO_TRY(const Json root, parse_json(document.bytes, document.name));
  std::string complaint;
  SolidDemands demands = FeatureReader(part, unit, complaint).read(root);
  if (!complaint.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, complaint));
  return demands;
}

}  // namespace lekalo::verify
