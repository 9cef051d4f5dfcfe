#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "cairo.hpp"

namespace lekalo::draw {

Result<std::string> scene_png(const Scene& scene, int width_px) {
  if (width_px < 100 || width_px > 20'000) {
    return failure(ErrorCode::usage,
                   fmt::format("a picture {} pixels wide cannot be drawn; choose 100 to 20000", width_px));
  }
  const double scale = width_px / scene.width;
  const int height_px = static_cast<int>(std::lround(scene.height * scale));
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px));
  const Canvas canvas(cairo_create(surface.get()));
  cairo_scale(canvas.get(), scale, scale);
  paint_scene(scene, canvas.get());
  cairo_status_t status = cairo_status(canvas.get());
  CairoBytes bytes;
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(surface.get(), CairoBytes::take, &bytes);
  }
  std::string all = std::move(bytes).all();
  if (status != CAIRO_STATUS_SUCCESS) {
    return failure(ErrorCode::environment, fmt::format("the picture of {} x {} pixels could not be drawn: {}",
                                                       width_px, height_px, cairo_status_to_string(status)));
  }
  return all;
}

}  // namespace lekalo::draw
