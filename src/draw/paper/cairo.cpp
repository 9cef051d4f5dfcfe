#include "cairo.hpp"

#include <cstring>
#include <new>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"

namespace lekalo::draw {
namespace {

class Painter {
 public:
  explicit Painter(cairo_t* canvas) : canvas_(canvas) {
    cairo_set_line_join(canvas, CAIRO_LINE_JOIN_ROUND);
    // SVG fills by this rule, so pictures of both kinds look alike.
    cairo_set_fill_rule(canvas, CAIRO_FILL_RULE_WINDING);
  }

  void operator()(const PathItem& item) const {
    trace(item.lines, item.closed);
    paint(item.paint);
  }
  void operator()(const DotItem& item) const {
    cairo_new_path(canvas_);
    cairo_arc(canvas_, item.centre.x, item.centre.y, item.radius, 0, kTurn);
    cairo_close_path(canvas_);
    paint(item.paint);
  }
  void operator()(const TextItem& item) const {
    ask(64);
    const std::string text = io::clean_text(item.text);
    cairo_select_font_face(canvas_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           item.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(canvas_, item.size);
    cairo_text_extents_t extents;
    cairo_text_extents(canvas_, text.c_str(), &extents);
    const double share = item.anchor == Anchor::start ? 0 : item.anchor == Anchor::middle ? 0.5 : 1;
    cairo_move_to(canvas_, item.at.x - share * extents.x_advance, item.at.y);
    set(item.colour, 1);
    cairo_show_text(canvas_, text.c_str());
  }
  void operator()(const ImageItem& item) const {
    const Surface surface = surface_of(item.pixels);
    cairo_save(canvas_);
    cairo_translate(canvas_, item.at.x, item.at.y);
    cairo_scale(canvas_, item.width / item.pixels.columns, item.height / item.pixels.rows);
    cairo_set_source_surface(canvas_, surface.get(), 0, 0);
    cairo_paint(canvas_);
    cairo_restore(canvas_);
  }
  void operator()(const ClipBegin& item) const {
    cairo_save(canvas_);
    trace(item.lines, true);
    cairo_clip(canvas_);
  }
  void operator()(const ClipEnd&) const { cairo_restore(canvas_); }

 private:
  void set(Colour c, double alpha) const {
    cairo_set_source_rgba(canvas_, c.red / 255.0, c.green / 255.0, c.blue / 255.0, alpha);
  }
  void trace(const std::vector<geom::Ring>& lines, bool closed) const {
    cairo_new_path(canvas_);
    for (const geom::Ring& line : lines) {
      ask(16 + line.size());
      cairo_new_sub_path(canvas_);
      for (const geom::Point p : line) cairo_line_to(canvas_, p.x, p.y);
      if (closed) cairo_close_path(canvas_);
    }
  }
  void paint(const Paint& paint) const {
    if (paint.fill_alpha > 0) {
      set(paint.fill, paint.fill_alpha);
      cairo_fill_preserve(canvas_);
    }
    if (paint.width > 0) {
      set(paint.stroke, 1);
      cairo_set_line_width(canvas_, paint.width);
      cairo_set_line_cap(canvas_, paint.round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
      const double dashes[] = {paint.dash, paint.dash};
      cairo_set_dash(canvas_, dashes, paint.dash > 0 ? 2 : 0, 0);
      cairo_stroke_preserve(canvas_);
    }
    cairo_new_path(canvas_);
  }

  cairo_t* canvas_;
};

}  // namespace

void paint_scene(const Scene& scene, cairo_t* canvas) {
  const Painter painter(canvas);
  for (const Item& item : scene.items) std::visit(painter, item);
}

Surface surface_of(const Pixels& pixels) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.columns, pixels.rows));
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  if (bytes == nullptr) throw std::bad_alloc();
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  const auto columns = static_cast<std::size_t>(pixels.columns);
  for (std::size_t row = 0; row < static_cast<std::size_t>(pixels.rows); ++row) {
    ask(columns / 64);
    for (std::size_t column = 0; column < columns; ++column) {
      const Colour c = pixels.colours[row * columns + column];
      const std::uint32_t word = static_cast<std::uint32_t>(c.red) << 16 | c.green << 8 | c.blue;
      std::memcpy(bytes + row * stride + 4 * column, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

std::string pixels_png(const Pixels& pixels) {
  CairoBytes bytes;
  const Surface surface = surface_of(pixels);
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), CairoBytes::take, &bytes);
  std::string all = std::move(bytes).all();
  // The bytes go to memory, so nothing but memory can be missing.
  if (status != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  return all;
}

cairo_status_t CairoBytes::take(void* self, const unsigned char* bytes, unsigned int count) noexcept {
  auto& to = *static_cast<CairoBytes*>(self);
  if (to.stopped_) return CAIRO_STATUS_WRITE_ERROR;
  try {
    // Cairo works a microsecond or so for a byte of compressed text.
    ask(count);
    to.bytes_.append(reinterpret_cast<const char*>(bytes), count);
  } catch (const Stopped& stopped) {
    to.stopped_ = stopped;
    return CAIRO_STATUS_WRITE_ERROR;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

std::string CairoBytes::all() && {
  if (stopped_) throw Stopped(*stopped_);
  return std::move(bytes_);
}

}  // namespace lekalo::draw
