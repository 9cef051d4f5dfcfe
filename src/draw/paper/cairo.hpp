#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "scene.hpp"

namespace lekalo::draw {

struct FreeCairo {
  void operator()(cairo_t* canvas) const { cairo_destroy(canvas); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Canvas = std::unique_ptr<cairo_t, FreeCairo>;
using Surface = std::unique_ptr<cairo_surface_t, FreeCairo>;

/// Paints the scene on a canvas whose unit is a millimetre of paper.
void paint_scene(const Scene& scene, cairo_t* canvas);

/// The pixels as a picture that can be painted; it holds a copy of them.
[[nodiscard]] Surface surface_of(const Pixels& pixels);

/// Appends bytes to `text`, which is a std::string.
cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count);

}  // namespace lekalo::draw
