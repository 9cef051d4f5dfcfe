#include "lekalo/io/text/format.hpp"

#include <algorithm>

#include "lekalo/io/text/words.hpp"

namespace lekalo::io {

bool FileFormat::is_named_so(const std::string& file_name) const {
  const std::string ending = ending_of(file_name);
  return !ending.empty() && std::find(endings.begin(), endings.end(), ending) != endings.end();
}

bool FileFormat::begins_so(std::string_view bytes) const {
  if (!signature.empty() && bytes.starts_with(signature)) return true;
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return begin != std::string_view::npos && first_bytes.find(bytes[begin]) != std::string_view::npos;
}

}  // namespace lekalo::io
