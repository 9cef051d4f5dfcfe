#include <cstdio>

#include "lekalo/base/version.hpp"

int main() { std::printf("lekalo %s\n", lekalo::kVersion); }
