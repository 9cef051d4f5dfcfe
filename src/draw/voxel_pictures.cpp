#include "lekalo/draw/voxel_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/draw/grey_png.hpp"

namespace lekalo::draw {
namespace {

constexpr const char *kKind = "lekalo M-image", *kPalette = "palette", *kX = "origin x mm",
                     *kY = "origin y mm", *kPitch = "pitch mm";

/// Node (i, j) is pixel i of row j from below.
std::vector<std::uint16_t> turned_over(const std::vector<std::uint16_t>& nodes, std::size_t columns) {
  std::vector<std::uint16_t> pixels;
  pixels.reserve(nodes.size());
  for (std::size_t row = nodes.size() / columns; row-- > 0;)
    pixels.insert(pixels.end(), nodes.begin() + static_cast<std::ptrdiff_t>(row * columns),
                  nodes.begin() + static_cast<std::ptrdiff_t>((row + 1) * columns));
  return pixels;
}

std::string letter_of(std::size_t k) { return std::string(1, static_cast<char>('A' + k)); }

}  // namespace

Result<std::array<std::string, 4>> voxel_pngs(const field::VoxelImages& images) {
  std::array<std::string, 4> pictures;
  for (std::size_t k = 0; k < 4; ++k) {
    GreyImage image;
    image.columns = images.frame.columns, image.rows = images.frame.rows;
    image.bits = images.palette > 255 ? 16 : 8;
    image.pixels = turned_over(images.images[k], image.columns);
    image.texts = {{kKind, letter_of(k)},
                   {kPalette, fmt::format("{}", images.palette)},
                   {kX, fmt::format("{}", images.frame.origin.x)},
                   {kY, fmt::format("{}", images.frame.origin.y)},
                   {kPitch, fmt::format("{}", images.frame.pitch)}};
    LEKALO_TRY(std::string bytes, grey_png(image));
    pictures[k] = std::move(bytes);
  }
  return pictures;
}

Result<field::VoxelImages> parse_voxel_pngs(const std::array<std::string_view, 4>& bytes,
                                            const std::array<std::string, 4>& names) {
  field::VoxelImages model;
  for (std::size_t k = 0; k < 4; ++k) {
    LEKALO_TRY(const GreyImage image, parse_grey_png(bytes[k], names[k]));
    const auto text = [&](const char* key) -> std::string {
      for (const auto& [name, value] : image.texts)
        if (name == key) return value;
      return {};
    };
    const auto x = double_of_text(text(kX)), y = double_of_text(text(kY)),
               pitch = double_of_text(text(kPitch)), palette = double_of_text(text(kPalette));
    const bool good = text(kKind) == letter_of(k) && x && y && pitch && *pitch > 0 && palette &&
                      *palette >= 2 && *palette < (image.bits == 16 ? 65536 : 256);
    if (!good)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: no M-image {} with its numbers as lekalo writes them", names[k], letter_of(k)));
    const field::GridFrame frame{{*x, *y}, *pitch, image.columns, image.rows};
    if (k == 0) model.frame = frame, model.palette = static_cast<std::uint16_t>(*palette);
    const field::GridFrame& first = model.frame;
    if (!(frame.origin == first.origin) || frame.pitch != first.pitch || frame.columns != first.columns ||
        frame.rows != first.rows || static_cast<std::uint16_t>(*palette) != model.palette)
      return failure(ErrorCode::bad_input, fmt::format("{}: of another grid than {}", names[k], names[0]));
    model.images[k] = turned_over(image.pixels, image.columns);
  }
  return model;
}

Result<std::string> value_png(const field::FieldGrid& grid) {
  float most = 0;
  for (const float value : grid.value) most = std::max(most, value);
  std::vector<std::uint16_t> shades(grid.value.size());
  for (std::size_t n = 0; n < shades.size(); ++n)
    shades[n] = static_cast<std::uint16_t>(most > 0 ? 255 * std::max(0.0F, grid.value[n]) / most : 0);
  GreyImage image;
  image.columns = grid.frame.columns, image.rows = grid.frame.rows, image.bits = 8;
  image.pixels = turned_over(shades, image.columns);
  image.texts = {{"lekalo value", fmt::format("white is {} mm", most)}};
  return grey_png(image);
}

}  // namespace lekalo::draw
