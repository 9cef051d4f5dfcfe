#include "feature_file.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

class FeatureReader {
 public:
  FeatureReader(LengthUnit unit, std::string& complaint) : unit_(unit), complaint_(complaint) {}

  StatedDemands read(Json value) {
    StatedDemands stated;
    Fields file(value, "", complaint_);
    refuse_other_words(value, "", {"units", "minimum", "features", "ignore"});
    if (has(file, "units")) {
      const std::string unit = file.text("units");
      if (unit != "mm" && unit != "inch") file.complain("field units is neither \"mm\" nor \"inch\"");
      unit_ = unit == "inch" ? LengthUnit::inch : LengthUnit::millimetre;
      stated.unit = unit_;
    }
    stated.minimum = length(file, "minimum").value_or(0);
    if (has(file, "features"))
      file.each("features",
                [&](Json item, const std::string& path) { stated.features.push_back(feature(item, path)); });
    if (has(file, "ignore"))
      file.each("ignore", [&](Json item, const std::string& path) {
        refuse_other_words(item, path, {"outer", "holes", "islands"});
        stated.ignored.push_back(item);
      });
    return stated;
  }

 private:
  static bool has(const Fields& fields, std::string_view key) { return !fields.get(key).text.empty(); }

  /// Complains of words that would be demands if somebody knew them.
  void refuse_other_words(Json object, const std::string& path,
                          std::initializer_list<std::string_view> known) {
    if (!object.is_object()) return;
    JsonItems members(object);
    while (members.next())
      if (std::find(known.begin(), known.end(), members.key()) == known.end() && complaint_.empty())
        complaint_ = fmt::format("{}{}\"{}\" is no word of a file of features", path,
                                 path.empty() ? "" : ": ", excerpt(members.key()));
  }

  StatedFeature feature(Json item, const std::string& path) {
    Fields fields(item, path, complaint_);
    refuse_other_words(
        item, path,
        {"name", "edges", "contour", "label", "minimum", "target", "maximum", "scale", "finished"});
    StatedFeature f;
    f.name = fields.text("name");
    if (has(fields, "edges") + has(fields, "contour") + has(fields, "label") != 1)
      fields.complain(path + " does not say in one way which edges it has");
    if (has(fields, "label")) {
      f.label = fields.text("label");
    } else if (has(fields, "contour")) {
      f.contour = fields.index("contour");
    } else {
      auto& edges = f.edges.emplace();
      fields.each("edges",
                  [&](Json edge, const std::string& at) { edges.push_back(fields.index_of(edge, at)); });
    }
    FeatureNumbers& n = f.numbers;
    n.minimum = length(fields, "minimum").value_or(n.minimum);
    n.target = length(fields, "target"), n.maximum = length(fields, "maximum");
    n.finished = length(fields, "finished");
    if (has(fields, "scale")) n.scale = approximate(fields.number("scale"));
    if (!(n.scale > 0 && n.scale <= std::numeric_limits<double>::max()))
      fields.complain(fields.name("scale") + " is not above 0");
    if (n.maximum && !(*n.maximum > n.minimum))
      fields.complain(fields.name("maximum") + " is not above the minimum");
    if (n.finished && !(*n.finished > 0)) fields.complain(fields.name("finished") + " is not above 0");
    for (const char* other : {"minimum", "target", "maximum", "scale"})
      if (n.finished && has(fields, other))
        fields.complain(fmt::format("{} is finished and has a {}", path, other));
    return f;
  }

  /// Returns a length in mm; null is no length.
  std::optional<double> length(Fields& fields, std::string_view key) {
    if (!has(fields, key)) return std::nullopt;
    const std::optional<Decimal> number = fields.number_or_null(key);
    if (!number) return std::nullopt;
    const double mm = millimetres_per(unit_) * approximate(*number);
    if (!(mm >= 0 && mm <= std::numeric_limits<double>::max()))
      fields.complain(fields.name(key) + " is not a length that is not negative");
    return mm;
  }

  LengthUnit unit_;
  std::string& complaint_;
};

}  // namespace

StatedDemands read_features(Json value, LengthUnit unit, std::string& complaint) {
  return FeatureReader(unit, complaint).read(value);
}

}  // namespace lekalo::verify
