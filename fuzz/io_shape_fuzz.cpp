#include <cmath>
#include <cstring>

#include "io_contour_check.hpp"

// Points near the edge of what is convex: the bytes are a walk of small steps on a grid whose size they also
// choose, so that nearly collinear, nearly closed and barely crossing contours turn up often.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 8) return 0;
  lekalo::io::ContourFile file;
  file.name = "fuzz.csv";
  const double fine = std::ldexp(1.0, -(data[0] % 53)), far = data[1] % 3 == 0   ? 1e8
                                                              : data[1] % 3 == 1 ? 1000.1
                                                                                 : 0;
  file.coordinate_error = data[2] % 2 == 0 ? 0 : std::ldexp(1.0, -20 - data[2] % 40);
  lekalo::geom::Point at{far, -far};
  for (std::size_t i = 3; i + 2 < size; i += 3) {
    const auto step = [](std::uint8_t byte) { return static_cast<double>(static_cast<std::int8_t>(byte)); };
    at = at + lekalo::geom::Point{step(data[i]), step(data[i + 1])};
    const double nudge = step(data[i + 2]) * fine;
    file.points.push_back({at.x + nudge, at.y - nudge / 3});
    file.places.push_back(i);
    if (!lekalo::geom::is_exact(file.points.back())) return 0;
  }
  if (const auto contour = lekalo::io::make_convex(file)) lekalo::fuzz::check_convex(file, *contour);
  if (const auto trimmed = lekalo::io::trim_to_convex(file, 300)) lekalo::fuzz::check_trimmed(file, *trimmed);
  return 0;
}
