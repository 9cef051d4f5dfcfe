#pragma once

// Results for solids as texts, which tests write by hand and change: a cube in a cube, whose best clearance
// is known by argument.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/json.hpp"
#include "support/solid_files.hpp"
#include "support/solids.hpp"

namespace lekalo::cases {

/// A result with its files. \pre `result` keeps its fields
struct SolidResultFiles {
  Json result;
  std::string part, blank;
  /// The certificate, where it stands in a file of its own.
  std::optional<std::string> certificate;
  /// The points that the blank was made from.
  std::optional<std::string> points = {};
  std::optional<std::string> features = {};
  /// The mesh that was moved to touches.
  std::optional<std::string> nominal = {};

  [[nodiscard]] Result<verify::LocateReport> report() const {
    const std::string text = result.dump();
    verify::LocateInputs inputs{{"result.json", text}, {"part.stl", part}, {"blank.stl", blank}, {}};
    if (certificate) inputs.certificate = verify::Document{"certificate.json", *certificate};
    if (points) inputs.points = verify::Document{"points.xyz", *points};
    if (nominal) inputs.nominal = verify::Document{"nominal.stl", *nominal};
    if (features) inputs.features = verify::Document{"features.json", *features};
    return verify::verify_locate(inputs);
  }
  /// The verdict in a word, or "bad input", then what was found.
  [[nodiscard]] std::string told() const {
    const auto made = report();
    if (!made) return "bad input: " + made.error().message;
    constexpr std::array kNames{"confirmed", "incomplete", "stated regions", "unproved", "refuted"};
    std::string all = kNames[static_cast<std::size_t>(made->verdict)];
    for (const std::string& finding : made->findings) all += "; " + finding;
    return all;
  }
};

/// A certificate with one leaf over the whole window about the origin, of shifts by `shift` and turns with
/// tangents of half the angle up to `turn`.
inline Json one_leaf(Json terms, Json part_balls, Json blank_balls, Json planes, double shift = 0.5,
                     const std::array<double, 3>& turn = {0, 0, 0}) {
  const Json place{-shift, shift};
  Json tree{{"quaternion", {1, 0, 0, 0}}, {"x", place}, {"y", place}, {"z", place}};
  for (std::size_t k = 0; k < 3; ++k) tree[std::string("turn_") + "xyz"[k]] = Json{-turn[k], turn[k]};
  tree["nodes"] = Json::array({std::move(terms)});
  return {{"pivot", {0, 0, 0}},
          {"part_balls", std::move(part_balls)},
          {"blank_balls", std::move(blank_balls)},
          {"planes", std::move(planes)},
          {"trees", Json::array({std::move(tree)})}};
}

/// A part with half edges of 5 about the origin in a blank with half edges of 6, at the origin: all faces are
/// 1 apart, and no rigid motion has more (convex_in_convex in solid_cases.hpp says why).
inline SolidResultFiles cube_in_cube(Json certificate = nullptr, double bound = 1,
                                     const std::string& freedom = "xyz", double shift = 0.5,
                                     double turn_deg = 0) {
  SolidResultFiles made;
  made.part = solid_files::stl_binary(block({-5, -5, -5}, {5, 5, 5}));
  made.blank = solid_files::stl_binary(block({-6, -6, -6}, {6, 6, 6}));
  const bool proved = !certificate.is_null();
  const auto input = [](const char* role) {
    return Json{{"role", role}, {"path", role}, {"sha256", ""}, {"units", "mm"}, {"triangles", 12}};
  };
  made.result = {{"format", {{"name", "lekalo-locate"}, {"version", 1}}},
                 {"status", proved ? "optimal" : "unproved"},
                 {"units", "mm"},
                 {"inputs", Json::array({input("part"), input("blank")})},
                 {"warnings", Json::array()},
                 {"seed", 0},
                 {"work", 1},
                 {"version", "0"},
                 {"method", proved ? "certified" : "climb"},
                 {"freedom", freedom},
                 {"window",
                  {{"quaternion", {1, 0, 0, 0}},
                   {"x", 0},
                   {"y", 0},
                   {"z", 0},
                   {"pivot", {0, 0, 0}},
                   {"shift", shift},
                   {"turn_deg", turn_deg}}},
                 {"quaternion", {1, 0, 0, 0}},
                 {"x", 0},
                 {"y", 0},
                 {"z", 0},
                 {"inside", true},
                 {"clearance", 1},
                 {"upper_bound", proved ? Json(bound) : Json()},
                 {"gap", proved ? Json(bound - 1) : Json()},
                 {"min_allowance", 0},
                 {"shortfall", 0},
                 {"contacts", Json::array({Json{{"part_point", {5, 1, -1}},
                                                {"blank_point", {6, 1, -1}},
                                                {"part_triangle", 10},
                                                {"blank_triangle", 10},
                                                {"distance", 1},
                                                {"multiplier", 1}}})},
                 {"demands", nullptr},
                 {"scan", nullptr},
                 {"unknown_area_mm2", 0},
                 {"certificate", std::move(certificate)},
                 {"certificate_file", nullptr},
                 {"nc", nullptr},
                 {"offset", nullptr},
                 {"run", Json::object()}};
  return made;
}

/// A feature as results have it; what has no minimum is as cast.
inline Json demand_of_result(const std::string& name, std::size_t triangles, Json minimum, Json scale) {
  const bool as_cast = minimum.is_null();
  return {{"name", name},
          {"triangles", triangles},
          {"minimum", std::move(minimum)},
          {"scale", std::move(scale)},
          {"as_cast", as_cast}};
}

/// The cube in the cube with a file of features. \pre its minimum is there
inline SolidResultFiles with_demands(const Json& features, const Json& of_result, Json certificate,
                                     double margin, double bound) {
  SolidResultFiles files = cube_in_cube(std::move(certificate));
  Json& result = files.result;
  result["inputs"].push_back(Json{{"role", "features"}, {"path", "features"}, {"sha256", ""}});
  result["upper_bound"] = result["gap"] = nullptr;
  result["shortfall"] = std::max(0.0, -margin);
  result["demands"] = {{"minimum", features["minimum"]}, {"features", of_result},
                       {"datums", Json::array()},        {"margin", margin},
                       {"margin_bound", bound},          {"margin_gap", bound - margin}};
  files.features = features.dump();
  return files;
}
/// What a result says of a scan without an underside whose surface dips by up to `dip` between its points:
/// all widths are `guard` and that.
inline Json scan_by_dip(double guard, double dip, double widest) {
  return {{"guard", guard},       {"min_radius", nullptr},     {"max_dip", dip},
          {"underside", nullptr}, {"widest", widest},          {"unknown_triangles", 0},
          {"proved", true},       {"left_out", Json::array()}, {"assumptions", {"it is so"}}};
}

/// Changes a number of a tree of values: by a digit, its sign, or to another one.
inline Json changed(Json certificate, Random& random) {
  std::vector<Json*> numbers;
  const std::function<void(Json&)> walk = [&](Json& at) {
    if (at.is_array() || at.is_object())
      for (Json& item : at) walk(item);
    else if (at.dump()[0] != '"')
      numbers.push_back(&at);
  };
  walk(certificate);
  Json& at = *numbers[random.below(numbers.size())];
  const double value = at;
  switch (random.below(6)) {
    case 0:
      at = -value;
      break;
    case 1:
      at = value + random.uniform(-1, 1);
      break;
    case 2:
      at = value * (1 + random.uniform(-1e-3, 1e-3));
      break;
    case 3:
      at = std::nextafter(value, random.uniform(-10, 10));
      break;
    case 4:
      at = static_cast<int>(random.below(13));
      break;
    default:
      at = *numbers[random.below(numbers.size())];
  }
  return certificate;
}

}  // namespace lekalo::cases
