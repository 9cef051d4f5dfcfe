#pragma once

// What the published schemas say of texts, as python3-jsonschema reads them.

#include <fmt/core.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/places.hpp"

namespace lekalo::cases {

inline std::string python_with_jsonschema() {
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (std::system(fmt::format("{} -c 'import jsonschema' >/dev/null 2>&1", name).c_str()) == 0) return name;
  return "";
}

/// What a schema of docs/schema says of each text.
inline std::vector<std::string> schema_verdicts(const std::string& schema,
                                                const std::vector<std::string>& texts) {
  const auto folder = std::filesystem::temp_directory_path() /
                      fmt::format("lekalo-schema-{}", static_cast<unsigned long>(::getpid()));
  std::filesystem::create_directories(folder);
  std::string command = fmt::format("{0} {1}/tests/support/check_schema.py {1}/docs/schema/{2}",
                                    python_with_jsonschema(), source_dir(), schema);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string path = (folder / fmt::format("{}.json", i)).string();
    std::ofstream(path) << texts[i];
    command += " " + path;
  }
  std::vector<std::string> lines;
  FILE* pipe = ::popen(command.c_str(), "r");
  char line[1000];
  while (pipe != nullptr && std::fgets(line, sizeof line, pipe) != nullptr)
    lines.emplace_back(line, std::string_view(line).find_last_not_of('\n') + 1);
  if (pipe != nullptr) ::pclose(pipe);
  std::filesystem::remove_all(folder);
  return lines;
}

}  // namespace lekalo::cases
