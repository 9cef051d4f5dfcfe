#include <openssl/evp.h>

#include <array>

#include "lekalo/base/assert.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::io {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  const int done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  LEKALO_ASSERT(done == 1 && size == 32);
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += "0123456789abcdef"[digest[i] >> 4U];
    text += "0123456789abcdef"[digest[i] & 15U];
  }
  return text;
}

}  // namespace lekalo::io
