#include "outputs.hpp"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "lekalo/disk/files.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
  return !whole_a.empty() && whole_a == whole_b;
}

Result<void> check_target(const NamedPath& output) {
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
  if (fs::is_directory(status)) {
    return failure(ErrorCode::environment, fmt::format("{}: {} is a folder", output.option, output.path));
  }
  // Files appear by renaming, which would put a plain file in the place of the device.
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return failure(ErrorCode::environment,
                   fmt::format("{}: {} is not a plain file (--json prints the result on stdout)",
                               output.option, output.path));
  }
  const fs::path folder = fs::path(output.path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    return failure(ErrorCode::environment,
                   fmt::format("{}: there is no folder {}", output.option, folder.string()));
  }
  return {};
}

}  // namespace

Result<void> check_outputs(const std::vector<NamedPath>& outputs, const std::vector<NamedPath>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedPath& output = outputs[i];
    if (output.path.empty()) continue;
    for (const NamedPath& input : inputs) {
      if (!input.path.empty() && same_file(output.path, input.path)) {
        return failure(ErrorCode::usage, fmt::format("{}: {} is the input file of {} and would be replaced",
                                                     output.option, output.path, input.option));
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!outputs[j].path.empty() && same_file(output.path, outputs[j].path)) {
        return failure(ErrorCode::usage, fmt::format("{} and {} name the same file, {}", outputs[j].option,
                                                     output.option, output.path));
      }
    }
  }
  for (const NamedPath& output : outputs) {
    if (output.path.empty()) continue;
    if (Result<void> fine = check_target(output); !fine) return fine;
  }
  return {};
}

std::string path_of_sheet(const std::string& path, std::size_t sheet, std::size_t sheets) {
  if (sheets == 1) return path;
  const fs::path whole(path);
  return (whole.parent_path() /
          (whole.stem().string() + fmt::format("-{}", sheet + 1) + whole.extension().string()))
      .string();
}

Result<void> print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    return failure(ErrorCode::environment, fmt::format("stdout: cannot write: {}", std::strerror(errno)));
  }
  return {};
}

Result<void> deliver(const std::string& path, std::string_view text) {
  if (path.empty()) return print(text);
  disk::AtomicFiles files;
  return files.add(path, text).and_then([&] { return files.commit(); });
}

void complain(std::string_view message) {
  // Without memory of its own: "not enough memory" is one of the messages.
  std::array<char, 512> block;
  std::size_t size = 0;
  const auto put = [&](char c) {
    block[size++] = c;
    if (size == block.size() || c == '\n') std::fwrite(block.data(), 1, std::exchange(size, 0), stderr);
  };
  for (const char c : std::string_view("lekalo: ")) put(c);
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    put(byte < 0x20 || byte == 0x7f ? '?' : c);
  }
  put('\n');
}

}  // namespace lekalo::cli
