#pragma once

#include <cstddef>

namespace lekalo::limits {

/// Models in archives (3MF), for makers and checker alike; docs/limits.md says them to people. The objects
/// that are placed, objects within each other, and the vertices, and triangles, that placing makes beyond
/// those of the file.
inline constexpr std::size_t kMostPlacedObjects = 100'000, kMostObjectLevels = 64,
                             kMostPlacedCopies = 1'000'000;
/// A file in an archive is at most so many times as long as it is packed, or so short.
inline constexpr std::size_t kMostUnpackedTimes = 100, kSmallUnpacked = 65'536;

}  // namespace lekalo::limits
