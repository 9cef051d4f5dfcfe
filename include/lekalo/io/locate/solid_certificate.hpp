#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/locate/solid_proof.hpp"

namespace lekalo::io {

/// The numbers of triangles in their files, and which are turned round, as solid::ClosedMesh has
/// them.
struct SolidNumbers {
  const std::vector<std::uint32_t>&part, &blank;
  const std::vector<bool>&part_turned, &blank_turned;
};

/// Writes a certificate of solids as results have it (docs/formats.md), where a value is due. Numbers stand
/// in the shortest form that reads back to the same double. \pre every number is finite
void write_solid_certificate(JsonWriter& json, const locate::SolidProof& proof, const SolidNumbers& numbers);

/// The document of a certificate file.
[[nodiscard]] std::string solid_certificate_json(const locate::SolidProof& proof,
                                                 const SolidNumbers& numbers);

/// How many boxes of poses have terms, over all trees.
[[nodiscard]] std::size_t proof_size(const locate::SolidProof& proof);

}  // namespace lekalo::io
