#include "refusal.hpp"

namespace lekalo::io {

std::string wrong_encoding(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("AutoCAD Binary DXF"sv)) {
    return "this is a binary DXF; save it as ASCII DXF (R2000 or later)";
  }
  const bool dwg = bytes.size() >= 6 && bytes.starts_with("AC10"sv) && bytes[4] >= '0' && bytes[4] <= '9' &&
                   bytes[5] >= '0' && bytes[5] <= '9' && (bytes.size() == 6 || bytes[6] == '\0');
  if (dwg) return "this is a DWG drawing; save it as ASCII DXF (R2000 or later)";
  const bool zero_first = bytes.size() >= 4 && bytes[0] == '\0' && bytes[2] == '\0';
  const bool zero_second = bytes.size() >= 4 && bytes[1] == '\0' && bytes[3] == '\0';
  if (bytes.starts_with("\xff\xfe"sv) || bytes.starts_with("\xfe\xff"sv) || zero_first || zero_second) {
    return "this is text in UTF-16; save it as UTF-8 (or plain ASCII)";
  }
  if (bytes.find('\0') != std::string_view::npos) return "this is not a text file, it holds zero bytes";
  return {};
}

Result<LengthUnit> agree_on_unit(const std::string& name, std::optional<LengthUnit> file_says,
                                 const std::string& where, std::optional<LengthUnit> user_says) {
  const auto word = [](LengthUnit unit) { return unit == LengthUnit::inch ? "inch" : "mm"; };
  if (file_says && user_says && *file_says != *user_says) {
    return refuse(name, fmt::format("{} says {}, but {} was asked for; leave --units out or correct the file",
                                    where, word(*file_says), word(*user_says)));
  }
  return file_says ? *file_says : user_says.value_or(LengthUnit::millimetre);
}

}  // namespace lekalo::io
