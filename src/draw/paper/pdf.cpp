#include <cairo-pdf.h>
#include <fmt/core.h>

#include <utility>

#include "cairo.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"

namespace lekalo::draw {

Result<std::string> scene_pdf(const Scene& scene, const std::vector<Scene>& more) {
  constexpr double kPointsPerMillimetre = 72 / 25.4;
  CairoBytes bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(
      CairoBytes::take, &bytes, scene.width * kPointsPerMillimetre, scene.height * kPointsPerMillimetre));
  const auto set = [&](cairo_pdf_metadata_t field, const std::string& text) {
    cairo_pdf_surface_set_metadata(surface.get(), field, io::clean_text(text).c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, scene.title);
  set(CAIRO_PDF_METADATA_SUBJECT, scene.description);
  set(CAIRO_PDF_METADATA_CREATOR, std::string("lekalo ") + kVersion);
  // The date is left out, because the hour is not part of the input and the same input must give the same
  // bytes.
  set(CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  {
    const Canvas canvas(cairo_create(surface.get()));
    cairo_scale(canvas.get(), kPointsPerMillimetre, kPointsPerMillimetre);
    paint_scene(scene, canvas.get());
    cairo_show_page(canvas.get());
    for (const Scene& page : more) {
      paint_scene(page, canvas.get());
      cairo_show_page(canvas.get());
    }
    status = cairo_status(canvas.get());
  }
  cairo_surface_finish(surface.get());
  std::string all = std::move(bytes).all();
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    return failure(ErrorCode::environment,
                   fmt::format("the page could not be written as PDF: {}", cairo_status_to_string(status)));
  }
  return all;
}

}  // namespace lekalo::draw
