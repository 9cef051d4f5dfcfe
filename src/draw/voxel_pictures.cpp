#include "lekalo/draw/voxel_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/draw/grey_png.hpp"

namespace lekalo::draw {
namespace {

/// Node (i, j) is pixel i of row j from below.
std::vector<std::uint16_t> turned_over(const std::vector<std::uint16_t>& nodes, std::size_t columns) {
  std::vector<std::uint16_t> pixels;
  pixels.reserve(nodes.size());
  for (std::size_t row = nodes.size() / columns; row-- > 0;)
    pixels.insert(pixels.end(), nodes.begin() + static_cast<std::ptrdiff_t>(row * columns),
                  nodes.begin() + static_cast<std::ptrdiff_t>((row + 1) * columns));
  return pixels;
}

}  // namespace

Result<std::array<std::string, 4>> voxel_pngs(const field::VoxelImages& images) {
  std::array<std::string, 4> pictures;
  for (std::size_t k = 0; k < 4; ++k) {
    GreyImage image;
    image.columns = images.frame.columns, image.rows = images.frame.rows;
    image.bits = images.palette > 255 ? 16 : 8;
    image.pixels = turned_over(images.images[k], image.columns);
    image.texts = {{"lekalo M-image", std::string(1, "ABCD"[k])},
                   {"palette", fmt::format("{}", images.palette)},
                   {"origin x mm", fmt::format("{}", images.frame.origin.x)},
                   {"origin y mm", fmt::format("{}", images.frame.origin.y)},
                   {"pitch mm", fmt::format("{}", images.frame.pitch)}};
    LEKALO_TRY(std::string bytes, grey_png(image));
    pictures[k] = std::move(bytes);
  }
  return pictures;
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
