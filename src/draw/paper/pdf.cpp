#include <cairo-pdf.h>
#include <fmt/core.h>

#include <utility>

#include "cairo.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/text/words.hpp"
#include "pdf_pages.hpp"

namespace lekalo::draw {
namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;

}  // namespace

PdfPages::PdfPages(double width, double height, const std::string& title, const std::string& description)
    : surface_(cairo_pdf_surface_create_for_stream(CairoBytes::take, &bytes_, width * kPointsPerMillimetre,
                                                   height * kPointsPerMillimetre)) {
  const auto set = [&](cairo_pdf_metadata_t field, const std::string& text) {
    cairo_pdf_surface_set_metadata(surface_.get(), field, io::clean_text(text).c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, title);
  set(CAIRO_PDF_METADATA_SUBJECT, description);
  set(CAIRO_PDF_METADATA_CREATOR, std::string("lekalo ") + kVersion);
  // The date is left out, because the hour is not part of the input and the same input must give the same
  // bytes.
  set(CAIRO_PDF_METADATA_CREATE_DATE, "");
  canvas_.reset(cairo_create(surface_.get()));
  cairo_scale(canvas_.get(), kPointsPerMillimetre, kPointsPerMillimetre);
}

void PdfPages::add(const Scene& page) {
  paint_scene(page, canvas_.get());
  cairo_show_page(canvas_.get());
}

Result<std::string> PdfPages::finish() && {
  cairo_status_t status = cairo_status(canvas_.get());
  canvas_.reset();
  cairo_surface_finish(surface_.get());
  std::string all = std::move(bytes_).all();
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    return failure(ErrorCode::environment,
                   fmt::format("the page could not be written as PDF: {}", cairo_status_to_string(status)));
  }
  return all;
}

Result<std::string> scene_pdf(const Scene& scene, const std::vector<Scene>& more) {
  PdfPages pages(scene.width, scene.height, scene.title, scene.description);
  pages.add(scene);
  for (const Scene& page : more) pages.add(page);
  return std::move(pages).finish();
}

}  // namespace lekalo::draw
