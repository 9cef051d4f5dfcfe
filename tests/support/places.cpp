#include "support/places.hpp"

namespace lekalo::cases {

std::string source_dir() { return LEKALO_SOURCE_DIR; }
std::string program() { return LEKALO_CLI; }
std::string faults_library() { return LEKALO_FAULTS; }

}  // namespace lekalo::cases
