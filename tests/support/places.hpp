#pragma once

#include <string>

/// Where the checkout and the program under test stand; the only test code that knows (places.cpp), so that
/// the objects of all other tests are the same in every checkout.
namespace lekalo::cases {

[[nodiscard]] std::string source_dir();
[[nodiscard]] std::string program();

}  // namespace lekalo::cases
