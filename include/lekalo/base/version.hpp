#pragma once

namespace lekalo {
inline constexpr const char* kVersion = "0.1.0";
}
