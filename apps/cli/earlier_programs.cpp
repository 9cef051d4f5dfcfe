#include "earlier_programs.hpp"

#include <utility>

#include "lekalo/disk/files.hpp"

namespace lekalo::cli {

Result<std::vector<jobs::EarlierProgram>> read_earlier(const std::vector<EarlierFile>& files) {
  std::vector<jobs::EarlierProgram> earlier;
  for (const EarlierFile& file : files) {
    LEKALO_TRY(std::string text, disk::read_file(file.path));
    earlier.push_back({{file.path, std::move(text)}, file.tool_diameter});
  }
  return earlier;
}

}  // namespace lekalo::cli
