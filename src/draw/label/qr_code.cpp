#include "qr_code.hpp"

#ifdef LEKALO_WITH_QR
#include <qrencode.h>

#include <memory>
#include <new>
#endif

namespace lekalo::draw {

#ifndef LEKALO_WITH_QR

Result<QrCode> qr_code(const std::string&, int) {
  return failure(ErrorCode::environment,
                 "this build of lekalo has no QR codes, so it writes no labels: install libqrencode-dev and "
                 "build it again");
}

#else

namespace {

struct FreeQrCode {
  void operator()(QRcode* code) const { QRcode_free(code); }
};
using FoundQrCode = std::unique_ptr<QRcode, FreeQrCode>;

/// The library takes a higher version by itself where the one it is given is too low.
FoundQrCode encoded(const std::string& text, int version, QRecLevel level) {
  FoundQrCode code(QRcode_encodeString(text.c_str(), version, level, QR_MODE_8, 1));
  // A short text that is not empty fits, so nothing but memory can be missing.
  if (!code) throw std::bad_alloc();
  return code;
}

}  // namespace

Result<QrCode> qr_code(const std::string& text, int least_version) {
  FoundQrCode code = encoded(text, least_version, QR_ECLEVEL_M);
  for (const QRecLevel level : {QR_ECLEVEL_Q, QR_ECLEVEL_H}) {
    FoundQrCode safer = encoded(text, code->version, level);
    if (safer->version == code->version) code = std::move(safer);
  }
  QrCode made{code->version, code->width, {}};
  const int count = made.modules * made.modules;
  made.dark.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) made.dark.push_back((code->data[i] & 1U) != 0);
  return made;
}

#endif

}  // namespace lekalo::draw
