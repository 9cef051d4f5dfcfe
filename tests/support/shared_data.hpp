#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/places.hpp"

namespace lekalo::cases {

/// Data that is kept outside the project: LEKALO_SHARED_DATA, which the full suite sets and which then must
/// be there, else ../shared/data where it exists; "" otherwise, and the test is skipped.
inline std::string shared_data() {
  if (const char* folder = std::getenv("LEKALO_SHARED_DATA")) return folder;
  const std::string usual = cases::source_dir() + "/../shared/data";
  return std::filesystem::is_directory(usual) ? usual : "";
}

}  // namespace lekalo::cases
