#include "earlier_programs.hpp"

#include "lekalo/disk/files.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::cli {

std::vector<verify::EarlierProgram> EarlierPrograms::programs() const {
  std::vector<verify::EarlierProgram> list;
  for (std::size_t i = 0; i < files.size(); ++i)
    list.push_back({{files[i].path, texts[i]}, files[i].tool_diameter});
  return list;
}

Result<EarlierPrograms> read_earlier(const std::vector<EarlierFile>& files) {
  EarlierPrograms earlier;
  earlier.files = files;
  for (const EarlierFile& file : files) {
    Result<std::string> text = disk::read_file(file.path);
    if (!text) return tl::unexpected(text.error());
    earlier.inputs.push_back({{"role", "after"},
                              {"path", file.path},
                              {"sha256", io::sha256(*text)},
                              {"tool_mm", file.tool_diameter}});
    earlier.texts.push_back(std::move(*text));
  }
  return earlier;
}

}  // namespace lekalo::cli
