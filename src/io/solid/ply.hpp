#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/io/scan/scan_file.hpp"

namespace lekalo::io {

/// A vertex of a PLY, scaled to millimetres.
struct PlyPoint {
  double xyz[3] = {0, 0, 0};
  double error = 0;  ///< of each coordinate, mm
};

/// The vertices of a PLY file (Turk 1994: ascii, binary_little_endian, binary_big_endian, version 1.0), with
/// the properties x and y, and z if `wants_z`. Other elements are not read; a notice counts them. What stands
/// after the vertices is not looked at.
///
/// take(point, vertex) until it fails. Fails with bad_input and a sentence that names file and line of the
/// header, or vertex.
[[nodiscard]] Result<void> read_ply_points(
    std::string_view bytes, const std::string& name, LengthUnit unit, bool wants_z,
    const std::function<Result<void>(const PlyPoint&, std::size_t)>& take, std::vector<std::string>& notices);

}  // namespace lekalo::io
