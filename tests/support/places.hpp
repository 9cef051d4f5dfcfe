#pragma once

#include <string>

/// Where the checkout and the program under test stand; the only test code that knows (places.cpp), so that
/// the objects of all other tests are the same in every checkout.
namespace lekalo::cases {

[[nodiscard]] std::string source_dir();
[[nodiscard]] std::string program();
/// The library that makes calls fail (support/faults/faults.cpp); empty where the build has none.
[[nodiscard]] std::string faults_library();

}  // namespace lekalo::cases
