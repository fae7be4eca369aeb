#include "common/crypto/session.hpp"

#include <sodium.h>

#include "common/core/check.hpp"
#include "common/crypto/aes_gcm.hpp"

namespace longreach {
namespace {

void start_sodium() { CHECK(sodium_init() >= 0); }

}  // namespace

Secret::Secret(Secret&& from) noexcept : array(from) { sodium_memzero(from.data(), from.size()); }

Secret& Secret::operator=(Secret&& from) noexcept {
  if (this == &from) return *this;
  array::operator=(from);
  sodium_memzero(from.data(), from.size());
  return *this;
}

Secret::~Secret() { sodium_memzero(data(), size()); }

void wipe(std::string& text) { sodium_memzero(text.data(), text.size()); }

bool has_aes256gcm() { return AesGcm::available(); }

Session draw_session(Cipher cipher) {
  start_sodium();
  Session session{.cipher = cipher};
  while (session.number == 0) randombytes_buf(&session.number, sizeof session.number);
  randombytes_buf(session.secret.data(), session.secret.size());
  return session;
}

}  // namespace longreach
