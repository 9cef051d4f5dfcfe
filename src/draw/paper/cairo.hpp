#pragma once

#include <cairo.h>

#include <memory>
#include <optional>
#include <string>

#include "lekalo/base/stop.hpp"
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

/// Keeps what cairo writes. Cairo is C and nothing may be thrown through it: a stop between two pieces looks
/// to it like a full disk, and is thrown when it has returned.
class CairoBytes {
 public:
  /// Takes a piece, for the CairoBytes that cairo was given.
  static cairo_status_t take(void* self, const unsigned char* bytes, unsigned int count) noexcept;

  /// All that was written.
  /// \throws Stopped  where the job was to end meanwhile
  [[nodiscard]] std::string all() &&;

 private:
  std::string bytes_;
  std::optional<Stopped> stopped_;
};

}  // namespace lekalo::draw
