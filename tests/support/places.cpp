#include "support/places.hpp"

namespace lekalo::cases {

std::string source_dir() { return LEKALO_SOURCE_DIR; }
std::string program() { return LEKALO_CLI; }

}  // namespace lekalo::cases
