#include "page.hpp"

#include <string_view>
#include <utility>

#include "page_files.hpp"

namespace lekalo::server {
namespace {

std::string media_type(std::string_view path) {
  constexpr std::pair<std::string_view, const char*> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".json", "application/json"},
      {".ico", "image/x-icon"},
      {".webmanifest", "application/manifest+json"}};
  for (const auto& [ending, type] : kTypes)
    if (path.ends_with(ending)) return type;
  return "application/octet-stream";
}

}  // namespace

ApiAnswer answer_page(const std::string& method, const std::string& path) {
  if (method != "GET" && method != "HEAD") {
    ApiAnswer wrong = api_error(405, "the methods here are GET, HEAD");
    wrong.allow = "GET, HEAD";
    return wrong;
  }
  const std::string name = path == "/" ? "/index.html" : path;
  const auto file = page_files().find(name);
  if (file == page_files().end()) return api_error(404, "there is nothing here");
  return {200, std::string(file->second), media_type(name), {}, {}, {}};
}

}  // namespace lekalo::server
