#include "lekalo/io/locate/feature_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "feature_words.hpp"
#include "io/shape/region_reader.hpp"
#include "io/text/json_form.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::io {
namespace {

using detail::is_index;
using detail::is_word;
using detail::JsonKind;
using detail::JsonValue;
using locate::Feature;

/// Stretches of an edge lie this near to it, as part of the part's size.
constexpr double kSameEdge = 1e-9;

class FeatureReader {
 public:
  FeatureReader(std::string name, double scale) : name_(std::move(name)), scale_(scale) {}

  Result<FeatureSpec> read(JsonValue json, std::size_t index) {
    where_ = fmt::format("{}, feature {}", name_, index);
    LEKALO_CHECK(detail::expect_object(
        json, where_,
        {"name", "edges", "contour", "label", "minimum", "target", "maximum", "scale", "finished"}));
    FeatureSpec spec;
    const auto name = json.find("name");
    if (!name || !is_word(*name)) return refuse(where_, "\"name\" must be a text");
    spec.demand.name = name->text();
    where_ = fmt::format("{}, feature \"{}\"", name_, spec.demand.name);
    LEKALO_CHECK(select(json, spec));
    LEKALO_CHECK(length(json, "minimum", [&](double v) { spec.demand.minimum = v; }));
    LEKALO_CHECK(length(json, "target", [&](double v) { spec.demand.target = v; }));
    LEKALO_CHECK(length(json, "maximum", [&](double v) { spec.demand.maximum = v; }));
    LEKALO_CHECK(length(json, "finished", [&](double v) { spec.demand.finished = v; }));
    LEKALO_CHECK(detail::take_scale(json, where_, [&](double v) { spec.demand.scale = v; }));
    if (spec.demand.maximum && !(*spec.demand.maximum > spec.demand.minimum))
      return refuse(where_, fmt::format("\"maximum\" {} mm is not above the minimum of {} mm",
                                        *spec.demand.maximum, spec.demand.minimum));
    if (spec.demand.finished) {
      if (!(*spec.demand.finished > 0)) return refuse(where_, "\"finished\", a tolerance, must be above 0");
      for (const char* other : {"minimum", "target", "maximum", "scale"})
        if (json.find(other))
          return refuse(where_, fmt::format("a \"finished\" feature has no \"{}\"", other));
    }
    return spec;
  }

  template <class Take>
  Result<void> length(JsonValue json, const char* key, Take take) const {
    return detail::take_length(json, key, scale_, where_, take);
  }
  void at(std::string where) { where_ = std::move(where); }

 private:
  Result<void> select(JsonValue json, FeatureSpec& spec) const {
    const auto edges = json.find("edges"), contour = json.find("contour"), label = json.find("label");
    if (edges.has_value() + contour.has_value() + label.has_value() != 1)
      return refuse(where_, "one of \"edges\", \"contour\" and \"label\" must say which edges it has");
    if (label) {
      if (!is_word(*label))
        return refuse(where_, "\"label\" must be a text: a layer or the name of a primitive");
      spec.label = label->text();
    } else if (contour) {
      if (!is_index(*contour)) return refuse(where_, "\"contour\" must be a whole number from 0 on");
      spec.contour = static_cast<std::size_t>(contour->integer());
    } else {
      if (edges->size() == 0 || edges->kind() != JsonKind::list)
        return refuse(where_, "\"edges\" must be a list of edge numbers");
      for (const JsonValue edge : *edges) {
        if (!is_index(edge) || edge.integer() > 0xffffffff)
          return refuse(where_, "\"edges\" must hold whole numbers from 0 on");
        spec.edges.push_back(static_cast<std::uint32_t>(edge.integer()));
      }
    }
    return {};
  }

  std::string name_, where_;
  double scale_;
};

std::vector<std::uint32_t> contour_starts(const std::vector<geom::Region>& part) {
  std::vector<std::uint32_t> starts{0};
  const auto add = [&](const geom::Contour& contour) {
    starts.push_back(starts.back() + static_cast<std::uint32_t>(contour.size()));
  };
  for (const geom::Region& region : part) {
    add(region.outer);
    for (const geom::Contour& hole : region.holes) add(hole);
  }
  return starts;
}

}  // namespace

Result<FeatureFile> parse_features(std::string_view bytes, const std::string& name,
                                   std::optional<LengthUnit> unit) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  const JsonValue root = tree.root();
  LEKALO_CHECK(detail::expect_object(root, name, {"units", "minimum", "features", "ignore"}));
  LEKALO_TRY(const auto file_unit, detail::unit_of(root, name, unit));
  const double scale = millimetres_per(file_unit);
  FeatureFile file{name, {}, {}, {}};
  FeatureReader reader(name, scale);
  reader.at(name);
  LEKALO_CHECK(reader.length(root, "minimum", [&](double v) { file.minimum = v; }));
  if (const auto features = root.find("features")) {
    if (features->kind() != JsonKind::list) return refuse(name, "\"features\" must be a list");
    for (const JsonValue item : *features) {
      LEKALO_TRY(auto spec, reader.read(item, file.features.size()));
      file.features.push_back(std::move(spec));
    }
  }
  if (const auto ignored = root.find("ignore")) {
    if (ignored->kind() != JsonKind::list) return refuse(name, "\"ignore\" must be a list of regions");
    for (const JsonValue item : *ignored) {
      const std::string where = fmt::format("{}, ignored region {}", name, file.ignored.size());
      LEKALO_CHECK(detail::expect_object(item, where, {"outer", "holes", "islands"}));
      LEKALO_TRY(auto region, detail::read_region(item, where, scale));
      file.ignored.push_back(std::move(region));
    }
  }
  return file;
}

Result<std::vector<Feature>> find_features(const FeatureFile& file, const std::vector<geom::Region>& part,
                                           const std::vector<std::string>& labels) {
  const std::vector<std::uint32_t> starts = contour_starts(part);
  std::vector<Feature> features;
  for (const FeatureSpec& spec : file.features) {
    const std::string where = fmt::format("{}, feature \"{}\"", file.name, spec.demand.name);
    Feature feature = spec.demand;
    feature.edges = spec.edges;
    for (const std::uint32_t edge : spec.edges)
      if (edge >= starts.back())
        return refuse(where, fmt::format("edge {} is not one of the part's {}", edge, starts.back()));
    if (spec.contour) {
      if (*spec.contour + 1 >= starts.size())
        return refuse(
            where, fmt::format("contour {} is not one of the part's {}", *spec.contour, starts.size() - 1));
      for (std::uint32_t k = starts[*spec.contour]; k < starts[*spec.contour + 1]; ++k)
        feature.edges.push_back(k);
    }
    if (!spec.label.empty()) {
      for (std::uint32_t k = 0; k < labels.size(); ++k)
        if (labels[k] == spec.label) feature.edges.push_back(k);
      if (feature.edges.empty()) {
        std::vector<std::string> known = labels;
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
        std::erase(known, "");
        return refuse(
            where, fmt::format("no edge of the part has the label \"{}\"; there {}", spec.label,
                               known.empty() ? "are none" : fmt::format("is: {}", joined_text(known, ", "))));
      }
    }
    features.push_back(std::move(feature));
  }
  return features;
}

Result<RestOfPart> without_ignored(const FeatureFile& file, const std::vector<geom::Region>& part) {
  auto rest = geom::combine(part, file.ignored, geom::BooleanOperation::subtract);
  if (!rest) return refuse(file.name, rest.error().message);
  if (rest->regions.empty()) return refuse(file.name, "nothing of the part is left beside what is ignored");
  RestOfPart result{std::move(rest->regions), {}, rest->edge_error};
  const geom::RegionIndex whole(part), left(result.regions);
  const geom::Box box = whole.bounds();
  const double same = kSameEdge * (norm(box.high - box.low) + norm(box.low));
  for (const geom::Curve& curve : left.curves()) {
    const geom::Edge& edge = curve.edge;
    geom::Point middle = 0.5 * (edge.from + edge.to);
    if (edge.kind != geom::EdgeKind::line) {
      const double half = 0.5 * geom::arc_sweep(edge);
      const geom::SinCos turn = geom::sincos(edge.kind == geom::EdgeKind::arc_ccw ? half : -half);
      const geom::Point out = edge.from - edge.centre;
      middle = edge.centre +
               geom::Point{turn.cosine * out.x - turn.sine * out.y, turn.sine * out.x + turn.cosine * out.y};
    }
    const auto nearest = whole.nearest(middle);
    result.edge_of.push_back(nearest.distance <= same ? std::optional(nearest.edge) : std::nullopt);
  }
  return result;
}

}  // namespace lekalo::io
