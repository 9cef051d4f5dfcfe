#pragma once

#include <string>

namespace lekalo::jobs {

/// The bytes of a file, and its name as it stands in sentences and results. Jobs open nothing: whoever calls
/// them reads the bytes first and writes what comes back.
struct File {
  std::string name, bytes;
};

}  // namespace lekalo::jobs
