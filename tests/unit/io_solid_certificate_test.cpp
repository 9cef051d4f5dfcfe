#include "lekalo/io/locate/solid_certificate.hpp"

#include <gtest/gtest.h>

namespace lekalo::io::io_solid_certificate_test {
namespace {

using locate::SolidTerm;
using locate::SolidTree;

/// A box of poses that is halved once. The blank's triangles were given in another order, and one of the
/// part's was turned round.
locate::SolidProof sample() {
  locate::SolidProof proof;
  proof.pivot = {1, 2, 3};
  proof.part_balls = {{{0.5, 0, -1}, 0.25}};
  proof.part_points = {{1, 0.25, 0.5}};
  proof.blank_balls = {{{10, 0.1, 0}, 2}};
  proof.planes = {{{0, 0, 1}, -7.5}};
  proof.datum_points = {{1, 5}};
  proof.directions = {{0, 1, 0}};
  SolidTree tree;
  tree.low = {-5, -5, -5, 0, 0, -0.125};
  tree.high = {5, 5, 5, 0, 0, 0.125};
  tree.nodes = {
      {SolidTree::Axis::turn_z, 0, 0, 0}, {SolidTree::Axis::leaf, 0, 0, 1}, {SolidTree::Axis::leaf, 0, 1, 8}};
  tree.terms = {{SolidTerm::Kind::plane, 0, 0, 1},       {SolidTerm::Kind::ball, 0, 0, 3},
                {SolidTerm::Kind::face, 0, 1, 2},        {SolidTerm::Kind::part_face, 1, 0, 5},
                {SolidTerm::Kind::edges, 5, 3, 7},       {SolidTerm::Kind::point, 0, 0, 1},
                {SolidTerm::Kind::point_plane, 0, 0, 2}, {SolidTerm::Kind::point_face, 0, 1, 3},
                {SolidTerm::Kind::datum, 0, 0, 4}};
  proof.trees = {tree};
  return proof;
}

TEST(SolidCertificate, IsWrittenAsTheFormatSays) {
  const std::vector<std::uint32_t> part{0, 1}, blank{8, 6};
  const std::vector<bool> of_part{false, true}, of_blank{false, false};
  EXPECT_EQ(solid_certificate_json(sample(), {part, blank, of_part, of_blank}),
            R"({"format": {"name": "lekalo-certificate", "version": 1},
"certificate": {"pivot": [1, 2, 3], "part_balls": [
    [0.5, 0, -1, 0.25]
  ], "part_points": [
    [1, 0.5, 0.25]
  ], "datum_points": [
    [1, 5]
  ], "directions": [
    [0, 1, 0]
  ], "blank_balls": [
    [10, 0.1, 0, 2]
  ], "planes": [
    [0, 0, 1, -7.5]
  ], "trees": [{"quaternion": [1, 0, 0, 0], "x": [-5, 5], "y": [-5, 5], "z": [-5, 5], )"
            R"("turn_x": [0, 0], "turn_y": [0, 0], "turn_z": [-0.125, 0.125], "nodes": [
    ["turn_z", 0],
    [["plane", 0, 0, 1]],
    [["ball", 0, 0, 3], ["face", 0, 6, 2], ["part_face", 1, 0, 5], ["edges", 3, 18, 7], )"
            R"(["point", 0, 0, 1], ["point_plane", 0, 0, 2], ["point_face", 0, 6, 3], )"
            R"(["datum", 0, 0, 4]]
  ]}]}
}
)");
  EXPECT_EQ(proof_size(sample()), 2u);
  EXPECT_EQ(proof_size({}), 0u);
}

}  // namespace
}  // namespace lekalo::io::io_solid_certificate_test
