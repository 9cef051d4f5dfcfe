#include "lekalo/disk/file_words.hpp"

#include <fmt/core.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>

namespace lekalo::disk {
namespace {

namespace fs = std::filesystem;

Result<std::vector<std::string>> files_in_folder(const std::string& folder,
                                                 const std::function<bool(const std::string&)>& counts) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
    if (each->is_regular_file(error) && counts(each->path().filename().string()))
      files.push_back(each->path().string());
  if (error)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the folder cannot be read ({})", folder, error.message()));
  if (files.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: no drawing is in this folder", folder));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<std::vector<std::string>> files_meant(const std::string& word,
                                             const std::function<bool(const std::string& name)>& counts) {
  std::error_code error;
  const fs::file_status status = fs::status(word, error);
  if (fs::is_directory(status)) return files_in_folder(word, counts);
  if (fs::exists(status) || word.find_first_of("*?[") == std::string::npos) return std::vector{word};
  glob_t found{};
  const int trouble = glob(word.c_str(), 0, nullptr, &found);
  std::vector<std::string> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (trouble == 0) {
    std::sort(files.begin(), files.end());
    return files;
  }
  return failure(ErrorCode::bad_input,
                 trouble == GLOB_NOMATCH
                     ? fmt::format("{}: no file matches this pattern", word)
                     : fmt::format("{}: the files of this pattern cannot be listed", word));
}

}  // namespace lekalo::disk
