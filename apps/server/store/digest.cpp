#include "digest.hpp"

#include "lekalo/io/text/sha256.hpp"

namespace lekalo::server {

Digest& Digest::add(std::string_view field) {
  bytes_ += std::to_string(field.size());
  bytes_ += ':';
  bytes_ += field;
  return *this;
}

Digest& Digest::add(std::int64_t field) { return add(std::to_string(field)); }

std::string Digest::text() const { return io::sha256(bytes_); }

}  // namespace lekalo::server
