#include "lekalo/io/locate/solid_certificate.hpp"

#include <algorithm>

#include "solid_axes.hpp"

namespace lekalo::io {
namespace {

using locate::SolidTerm;
using locate::SolidTree;
using solid::Vector;

const char* name_of(SolidTerm::Kind kind) {
  switch (kind) {
    case SolidTerm::Kind::ball:
      return "ball";
    case SolidTerm::Kind::plane:
      return "plane";
    case SolidTerm::Kind::face:
      return "face";
    case SolidTerm::Kind::edges:
      return "edges";
    case SolidTerm::Kind::point:
      return "point";
    case SolidTerm::Kind::point_plane:
      return "point_plane";
    case SolidTerm::Kind::point_face:
      return "point_face";
    case SolidTerm::Kind::datum:
      return "datum";
    case SolidTerm::Kind::near:
      return "near";
    case SolidTerm::Kind::part_face:
      break;
  }
  return "part_face";
}

void write(JsonWriter& json, Vector v, double number) { json.list({v.x, v.y, v.z, number}); }

/// The number in the file of what a term is made of: of a triangle, or of an edge.
std::uint32_t number_in_file(SolidTerm::Kind kind, bool is_triangle, std::uint32_t number,
                             const std::vector<std::uint32_t>& triangles, const std::vector<bool>& turned) {
  if (is_triangle) return triangles[number];
  if (kind != SolidTerm::Kind::edges) return number;
  // A triangle that was turned round has its last two corners the other way in its file.
  const std::uint32_t triangle = number / 3, edge = number % 3;
  return 3 * triangles[triangle] + (turned[triangle] ? 2 - edge : edge);
}

void write(JsonWriter& json, const SolidTerm& term, const SolidNumbers& numbers) {
  const SolidTerm::Kind kind = term.kind;
  const bool over_blank = kind == SolidTerm::Kind::face || kind == SolidTerm::Kind::point_face;
  json.list(
      {name_of(kind),
       number_in_file(kind, kind == SolidTerm::Kind::part_face, term.part, numbers.part, numbers.part_turned),
       number_in_file(kind, over_blank, term.blank, numbers.blank, numbers.blank_turned), term.multiplier});
}

void write(JsonWriter& json, const SolidTree& tree, const SolidTree::Node& node,
           const SolidNumbers& numbers) {
  if (node.axis != SolidTree::Axis::leaf) {
    json.list({kSolidAxes[static_cast<std::size_t>(node.axis)], node.at});
    return;
  }
  json.begin_list();
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k) write(json, tree.terms[k], numbers);
  json.end();
}

void write(JsonWriter& json, const SolidTree& tree, const SolidNumbers& numbers) {
  json.begin_object().key("quaternion").list(tree.quaternion);
  for (std::size_t k = 0; k < kSolidAxes.size(); ++k)
    json.key(kSolidAxes[k]).list({tree.low[k], tree.high[k]});
  json.key("nodes").list_of_lines(tree.nodes, 4, 2,
                                  [&](const SolidTree::Node& node) { write(json, tree, node, numbers); });
  json.end();
}

}  // namespace

void write_solid_certificate(JsonWriter& json, const locate::SolidProof& proof, const SolidNumbers& numbers) {
  json.begin_object().key("pivot").list({proof.pivot.x, proof.pivot.y, proof.pivot.z});
  const auto balls = [&](const char* key, const std::vector<locate::SolidBall>& all) {
    json.key(key).list_of_lines(all, 4, 2,
                                [&](const locate::SolidBall& b) { write(json, b.centre, b.radius); });
  };
  balls("part_balls", proof.part_balls);
  // A file without demands has none, and not the word either.
  if (!proof.part_points.empty())
    json.key("part_points").list_of_lines(proof.part_points, 4, 2, [&](const locate::SolidPoint& p) {
      const bool turned = numbers.part_turned[p.triangle];
      json.list({numbers.part[p.triangle], turned ? p.v : p.u, turned ? p.u : p.v});
    });
  if (!proof.datum_points.empty()) {
    json.key("datum_points").list_of_lines(proof.datum_points, 4, 2, [&](const locate::SolidDatumPoint& p) {
      json.list({p.datum, p.point});
    });
    json.key("directions").list_of_lines(proof.directions, 4, 2, [&](Vector u) {
      json.list({u.x, u.y, u.z});
    });
  }
  balls("blank_balls", proof.blank_balls);
  json.key("planes").list_of_lines(proof.planes, 4, 2,
                                   [&](const locate::SolidPlane& p) { write(json, p.normal, p.least); });
  if (!proof.bodies.empty())
    json.key("bodies").list_of_lines(proof.bodies, 4, 2, [&](const locate::SolidBody& body) {
      const auto& [at, a, b, c, apart] = body;
      json.list({at.x, at.y, at.z, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, apart});
    });
  json.key("trees").list(proof.trees, [&](const SolidTree& tree) { write(json, tree, numbers); });
  json.end();
}

std::string solid_certificate_json(const locate::SolidProof& proof, const SolidNumbers& numbers) {
  JsonWriter json(JsonLayout::spaced);
  json.begin_object().key("format").object({{"name", "lekalo-certificate"}, {"version", 1}});
  write_solid_certificate(json.line(0).key("certificate"), proof, numbers);
  json.line(0).end();
  return json.take() + "\n";
}

std::size_t proof_size(const locate::SolidProof& proof) {
  std::size_t leaves = 0;
  for (const SolidTree& tree : proof.trees) leaves += (tree.nodes.size() + 1) / 2;
  return leaves;
}

}  // namespace lekalo::io
