#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lekalo::server {

/// Collects the fields of a row and gives the SHA-256 of them. Each field goes in with its length, so that no
/// two rows of different fields give the same bytes. What the rows chain is said in docs/design/server.md.
class Digest {
 public:
  explicit Digest(std::string_view kind) { add(kind); }
  Digest& add(std::string_view field);
  Digest& add(std::int64_t field);
  /// Returns it in lower-case hexadecimal.
  [[nodiscard]] std::string text() const;

 private:
  std::string bytes_;
};

}  // namespace lekalo::server
