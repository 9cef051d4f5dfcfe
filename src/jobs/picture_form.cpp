#include "lekalo/jobs/picture_form.hpp"

namespace lekalo::jobs {

std::optional<PictureForm> picture_form(std::string_view name) noexcept {
  if (name.ends_with(".svg")) return PictureForm::svg;
  if (name.ends_with(".png")) return PictureForm::png;
  if (name.ends_with(".pdf")) return PictureForm::pdf;
  return std::nullopt;
}

}  // namespace lekalo::jobs
