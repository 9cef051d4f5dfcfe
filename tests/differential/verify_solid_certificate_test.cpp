// Certificates for solids against tests/support/check_solid_certificate.py, which shares nothing with verify
// and works with fractions alone: both say the same, of true ones and of changed ones.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/solid_proofs.hpp"

namespace lekalo::verify_solid_certificate_test {
namespace {

using cases::Json;
using cases::SolidResultFiles;
using cases::TermKind;

std::string written(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "verify_solid_certificate_" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// What the stranger says of each.
std::vector<std::string> opinions(const std::vector<SolidResultFiles>& all) {
  std::string list;
  for (std::size_t k = 0; k < all.size(); ++k)
    list += fmt::format("{} {} {} - {}\n", written(fmt::format("part{}.stl", k), all[k].part),
                        written(fmt::format("blank{}.stl", k), all[k].blank),
                        written(fmt::format("result{}.json", k), all[k].result.dump()),
                        all[k].features ? written(fmt::format("features{}.json", k), *all[k].features) : "-");
  FILE* pipe = popen(fmt::format("python3 {}/tests/support/check_solid_certificate.py {}",
                                 cases::source_dir(), written("list", list))
                         .c_str(),
                     "r");
  if (pipe == nullptr) return {};
  std::vector<std::string> lines(1);
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += static_cast<char>(c);
  }
  pclose(pipe);
  lines.pop_back();
  return lines;
}

/// The cube in the cube: each face has a demand of its own, but for one that is as cast at times, and two
/// that lie opposite to each other bound the margin.
SolidResultFiles with_demands(Random& random) {
  constexpr std::array kSides{-1.0, 1.0};
  const std::size_t bounded = 2 * random.below(2), rough = random.below(2) == 0 ? 5 : 6;
  Json features = Json::array(), of_result = Json::array(), terms = Json::array(), points = Json::array(),
       balls = Json::array(), planes = Json::array();
  double margin = 1e9, minima = 0, scales = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    // The faces of cases::block are those of z, y and x, two triangles each.
    const std::size_t axis = 2 - k / 2;
    const double side = kSides[k % 2];
    const std::array<double, 3> n{axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
    Json feature{{"name", fmt::format("face {}", k)}};
    switch (random.below(4)) {
      case 0:
        feature["triangles"] = {2 * k, 2 * k + 1};
        break;
      case 1:
        feature["patch"] = {40 * n[0], 40 * n[1] + 0.25, 40 * n[2] - 0.5};
        if (axis == 1) feature["patch"][0] = 0.125;
        break;
      case 2: {
        Json low = Json::array(), high = Json::array();
        for (const double c : n) low.push_back(c > 0 ? 4.5 : -6), high.push_back(c < 0 ? -5 : 5);
        feature["box"] = Json::array({low, high});
        break;
      }
      default:
        feature["plane"] = {{"normal", {-3 * n[0], -3 * n[1], -3 * n[2]}}, {"at", -5.25}, {"within", 0.25}};
    }
    if (k == rough) {
      feature["as_cast"] = true;
      of_result.push_back(cases::demand_of_result(feature["name"], 2, nullptr, nullptr));
    } else {
      const double minimum = random.uniform(0, 0.9), scale = random.uniform(0.5, 2);
      feature["minimum"] = minimum, feature["scale"] = scale;
      of_result.push_back(cases::demand_of_result(feature["name"], 2, minimum, scale));
      margin = std::min(margin, (1 - minimum) / scale);
      if (k / 2 == bounded / 2) {
        minima += minimum, scales += scale;
        const int at = static_cast<int>(points.size());
        points.push_back({2 * k, 0.3, 0.3});
        std::array<double, 3> centre{-2, -2, -2};
        centre[axis] = side * 1006;
        balls.push_back({centre[0], centre[1], centre[2], 1000});
        planes.push_back({-2 * n[0], -2 * n[1], -2 * n[2], -12});
        const Json kinds[]{{"point", at, at, 1},
                           {"point_plane", at, at, 1},
                           {"point_face", at, 2 * k, 1},
                           {"part_face", 2 * k, at, 1}};
        terms.push_back(kinds[random.below(4)]);
      }
    }
    features.push_back(feature);
  }
  const double bound = (2 - minima) / scales + 1e-3;
  Json certificate = cases::one_leaf(terms, Json::array(), balls, planes, 0.3);
  certificate["part_points"] = points;
  SolidResultFiles files = cases::with_demands(Json{{"minimum", 0.25}, {"features", features}}, of_result,
                                               certificate, margin * (1 - 1e-12), bound);
  files.result["window"]["shift"] = 0.3;
  return files;
}

/// The cube in the cube, held by a datum farther along one of its normals than its margin likes.
SolidResultFiles with_datum(Random& random) {
  const auto row = [](const std::array<double, 3>& p) { return Json{p[0], p[1], p[2]}; };
  const std::size_t axis = random.below(3), other = (axis + 1) % 3;
  const double side = random.below(2) == 0 ? 1 : -1;
  // Whole numbers of 1/1024, so that nothing is rounded.
  const auto number = [&](std::uint32_t from, std::uint32_t to) {
    return static_cast<double>(from + random.below(to - from)) / 1024;
  };
  const double least = number(50, 300), within = number(50, 200);
  std::array<double, 3> n{}, through{}, along{}, u{};
  n[axis] = side, through[axis] = side * (least + within);
  Json datum{{"name", "seat"}, {"within", within}};
  Json point{0, 0};
  u[axis] = -side * number(1, 4000);
  switch (random.below(3)) {
    case 0:
      datum["feature"] = "face";
      for (std::size_t k = 0; k < 3; ++k)
        along[k] = n[k] * number(1, 4000), u[k] += k == axis ? 0 : number(0, 999);
      through[axis] += 5 * side, through[other] = number(0, 9999);
      datum["plane"] = {{"normal", row(along)}, {"through", row(through)}};
      // The faces of cases::block are those of z, y and x, two triangles each.
      point = {0, 3 * (4 * (2 - axis) + (side > 0 ? 2 : 0)) + random.below(6)};
      break;
    case 1:
      datum["points"] = Json::array({{0, 0, 0}, {0, 0, 0}});
      datum["points"][1][other] = 3;
      along[other] = number(1, 4000), through[other] = number(0, 9999), u[other] = number(0, 999);
      datum["axis"] = {{"along", row(along)}, {"through", row(through)}};
      point = {0, random.below(2)};
      break;
    default:
      datum["points"] = Json::array({{0, 0, 0}});
      datum["point"] = row(through);
  }
  const auto face = static_cast<int>(4 * (2 - axis) + (side > 0 ? 2 : 0));
  const Json features{{"minimum", 0},
                      {"features", Json::array({Json{{"name", "face"}, {"triangles", {face, face + 1}}}})},
                      {"datums", Json::array({datum})}};
  Json certificate =
      cases::one_leaf(Json::array({{"point_plane", 0, 0, 1}, {"datum", 0, 0, 1 / std::abs(u[axis])}}),
                      Json::array(), Json::array(), Json::array({{-n[0], -n[1], -n[2], -6}}));
  certificate["part_points"] = Json::array({{face, 0.25, 0.5}});
  certificate["datum_points"] = Json::array({point});
  certificate["directions"] = Json::array({row(u)});
  SolidResultFiles files =
      cases::with_demands(features, Json::array({cases::demand_of_result("face", 2, 0, 1)}), certificate,
                          1 - least, 1 - least + 1e-3);
  files.result["clearance"] = 1 - least, files.result["contacts"] = Json::array();
  for (std::size_t k = 0; k < 3; ++k) files.result[std::string(1, "xyz"[k])] = least * n[k];
  files.result["demands"]["datums"] =
      Json::array({Json{{"name", "seat"}, {"within", within}, {"off", within}}});
  return files;
}

/// The cube in the cube, whose top may lie no deeper than is kept where it lies higher; a body below that.
SolidResultFiles with_maximum(Random& random) {
  const double most = random.uniform(0.55, 0.95), up = 1 - most;
  const Json features{
      {"minimum", 0},
      {"features", Json::array({Json{{"name", "top"}, {"triangles", {2, 3}}, {"maximum", most}}})}};
  Json certificate = cases::one_leaf(Json::array({{"point_plane", 0, 0, 1}, {"near", 0, 5, 1}}),
                                     Json::array(), Json::array(), Json::array({{0, 0, -1, -6}}));
  certificate["part_points"] = Json::array({{2, 0.25, 0.5}});
  const double wide = random.uniform(4, 5), lean = random.uniform(0, 0.2);
  certificate["bodies"] = Json::array(
      {{-wide, -wide, 0, 2 * wide, 0, 0, 0, 2 * wide, 0, lean, -lean, 6 - most - 1e-9, most * (1 + 1e-15)}});
  Json of_result = cases::demand_of_result("top", 2, 0, 1);
  of_result["maximum"] = most, of_result["largest"] = most;
  SolidResultFiles files =
      cases::with_demands(features, Json::array({of_result}), certificate, most - 1e-6, most + 1e-6);
  files.result["clearance"] = most - 1e-6, files.result["contacts"] = Json::array();
  files.result["z"] = up + 1e-7;
  return files;
}

TEST(SolidCertificate, AStrangerSaysTheSame) {
  Random random(8);
  std::vector<SolidResultFiles> all;
  const char* const freedoms[]{"xyz", "c-xyz", "six"};
  for (const TermKind kind : {TermKind::plane, TermKind::ball, TermKind::face, TermKind::part_face,
                              TermKind::any, TermKind::edges}) {
    const char* const freedom = freedoms[random.below(3)];
    const std::size_t depth = random.below(2);
    const SolidResultFiles honest = kind == TermKind::edges
                                        ? cases::edges_proof(random, freedom, depth).files
                                        : cases::solid_proof(random, kind, freedom, depth).files;
    EXPECT_EQ(honest.told(), "confirmed") << static_cast<int>(kind);
    all.push_back(honest);
    for (std::uint64_t k = 0; k < cases::case_count(4); ++k) {
      SolidResultFiles other = honest;
      Json& certificate = other.result["certificate"];
      // What the window needs of the root is not the stranger's business.
      const char* const tables[]{"part_balls", "blank_balls", "planes"};
      const std::size_t which = random.below(5);
      if (which < 3 && !certificate[tables[which]].empty())
        certificate[tables[which]] = changed(certificate[tables[which]], random);
      else
        certificate["trees"][0]["nodes"] = changed(certificate["trees"][0]["nodes"], random);
      if (k % 3 == 0) {
        const double clearance = other.result["clearance"], bound = other.result["upper_bound"];
        other.result["upper_bound"] = clearance + (bound - clearance) * random.uniform(0, 0.2);
        other.result["gap"] = double(other.result["upper_bound"]) - clearance;
      }
      // A row, a node or a term that is none is refused; what the stranger would make of it does not matter.
      if (other.report()) all.push_back(other);
    }
  }
  for (std::uint64_t k = 0; k < cases::case_count(12); ++k) {
    const SolidResultFiles honest = k % 4 == 3   ? with_maximum(random)
                                    : k % 3 == 2 ? with_datum(random)
                                                 : with_demands(random);
    EXPECT_EQ(honest.told(), "confirmed") << *honest.features;
    all.push_back(honest);
    SolidResultFiles other = honest;
    Json& certificate = other.result["certificate"];
    const char* const tables[]{"part_points",  "blank_balls", "planes",
                               "datum_points", "directions",  "bodies"};
    const std::size_t which = random.below(7);
    if (which < 6 && !certificate[tables[which]].empty())
      certificate[tables[which]] = changed(certificate[tables[which]], random);
    else
      certificate["trees"][0]["nodes"] = changed(certificate["trees"][0]["nodes"], random);
    if (other.report()) all.push_back(other);
    other = honest;
    const double bound = other.result["demands"]["margin_bound"], margin = other.result["demands"]["margin"];
    other.result["demands"]["margin_bound"] = bound - 2e-3;
    other.result["demands"]["margin_gap"] = bound - 2e-3 - margin;
    if (bound - 2e-3 > margin) all.push_back(other);
  }
  const std::vector<std::string> said = opinions(all);
  ASSERT_EQ(said.size(), all.size()) << "check_solid_certificate.py ended early; is python3 there?";
  std::size_t proved = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string told = all[k].told();
    EXPECT_EQ(told == "confirmed", said[k] == "proved")
        << k << ": " << told << "\n the stranger: " << said[k];
    proved += said[k] == "proved" ? 1 : 0;
  }
  EXPECT_GT(proved, all.size() / 5);
  EXPECT_LT(proved, all.size() * 4 / 5);
}

}  // namespace
}  // namespace lekalo::verify_solid_certificate_test
