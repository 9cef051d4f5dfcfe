#include "lekalo/draw/grey_png.hpp"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

namespace lekalo::draw {
namespace {

constexpr std::size_t kMostSide = 30'000, kMostPixels = 100'000'000;

/// The bytes that the library's calls work on. The library leaves its calls by longjmp on trouble, so nothing
/// with a destructor lives in the functions that call it.
struct Stream {
  std::string_view rest;
  std::string* written = nullptr;
  char complaint[200] = "";
};

void complain(png_structp png, png_const_charp words) {
  auto* stream = static_cast<Stream*>(png_get_error_ptr(png));
  std::strncpy(stream->complaint, words, sizeof stream->complaint - 1);
  std::longjmp(*png_set_longjmp_fn(png, std::longjmp, sizeof(jmp_buf)), 1);
}
void ignore(png_structp, png_const_charp) {}

void take(png_structp png, png_bytep to, size_t count) {
  auto* stream = static_cast<Stream*>(png_get_io_ptr(png));
  if (count > stream->rest.size()) png_error(png, "it ends too early");
  std::memcpy(to, stream->rest.data(), count);
  stream->rest.remove_prefix(count);
}
void put(png_structp png, png_bytep from, size_t count) {
  static_cast<Stream*>(png_get_io_ptr(png))->written->append(reinterpret_cast<char*>(from), count);
}
void flush(png_structp) {}

struct Head {
  png_uint_32 columns = 0, rows = 0;
  int bits = 0, colour = 0;
};

/// Returns false when the library complained.
bool read_head(png_structp png, png_infop info, Head& head) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kMostSide, kMostSide);
  png_read_info(png, info);
  png_get_IHDR(png, info, &head.columns, &head.rows, &head.bits, &head.colour, nullptr, nullptr, nullptr);
  return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows);
  png_read_end(png, info);
  return true;
}

bool write_all(png_structp png, png_infop info, const Head& head, png_textp texts, int count,
               png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, head.columns, head.rows, head.bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (count > 0) png_set_text(png, info, texts, count);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::string> grey_png(const GreyImage& image) {
  std::string bytes;
  Stream stream;
  stream.written = &bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, complain, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    return failure(ErrorCode::environment, "the library for PNG pictures does not start");
  }
  png_set_write_fn(png, &stream, put, flush);
  const std::size_t width = static_cast<std::size_t>(image.bits / 8), row_bytes = image.columns * width;
  std::vector<png_byte> data(row_bytes * image.rows);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (width == 2) data[2 * i] = static_cast<png_byte>(image.pixels[i] >> 8);
    data[width * i + width - 1] = static_cast<png_byte>(image.pixels[i] & 255);
  }
  std::vector<png_bytep> rows;
  for (std::size_t r = 0; r < image.rows; ++r) rows.push_back(data.data() + r * row_bytes);
  std::vector<std::pair<std::string, std::string>> words = image.texts;
  std::vector<png_text> texts(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    texts[i].compression = PNG_TEXT_COMPRESSION_NONE;
    texts[i].key = words[i].first.data(), texts[i].text = words[i].second.data();
    texts[i].text_length = words[i].second.size();
  }
  const Head head{static_cast<png_uint_32>(image.columns), static_cast<png_uint_32>(image.rows), image.bits,
                  0};
  const bool good = write_all(png, info, head, texts.data(), static_cast<int>(texts.size()), rows.data());
  png_destroy_write_struct(&png, &info);
  if (!good) return failure(ErrorCode::environment, fmt::format("a PNG picture: {}", stream.complaint));
  return bytes;
}

Result<GreyImage> parse_grey_png(std::string_view bytes, const std::string& name) {
  Stream stream;
  stream.rest = bytes;
  const auto refused = [&](const std::string& why) {
    return failure(ErrorCode::bad_input, fmt::format("{}: no grey PNG picture: {}", name, why));
  };
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, complain, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return failure(ErrorCode::environment, "the library for PNG pictures does not start");
  }
  png_set_read_fn(png, &stream, take);
  struct Freed {
    png_structp& png;
    png_infop& info;
    ~Freed() { png_destroy_read_struct(&png, &info, nullptr); }
  } const freed{png, info};
  Head head;
  if (!read_head(png, info, head)) return refused(stream.complaint);
  if (head.colour != PNG_COLOR_TYPE_GRAY || (head.bits != 8 && head.bits != 16))
    return refused("it has colours, or not 8 or 16 bits");
  const std::size_t pixels = std::size_t{head.columns} * head.rows;
  if (pixels > kMostPixels) return refused("it has more than 10^8 pixels");
  GreyImage image;
  image.columns = head.columns, image.rows = head.rows, image.bits = head.bits;
  const std::size_t width = static_cast<std::size_t>(head.bits / 8), row_bytes = image.columns * width;
  std::vector<png_byte> data(row_bytes * image.rows);
  std::vector<png_bytep> rows;
  for (std::size_t r = 0; r < image.rows; ++r) rows.push_back(data.data() + r * row_bytes);
  if (!read_rows(png, info, rows.data())) return refused(stream.complaint);
  image.pixels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    image.pixels[i] = static_cast<std::uint16_t>(width == 2 ? data[2 * i] << 8 | data[2 * i + 1] : data[i]);
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i)
    image.texts.emplace_back(texts[i].key, texts[i].text != nullptr ? texts[i].text : "");
  return image;
}

}  // namespace lekalo::draw
