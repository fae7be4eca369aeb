#include "common/crypto/aes_gcm.hpp"

#include <sodium.h>

#include "common/core/check.hpp"

#ifdef LONGREACH_IPSEC_MB
#include <intel-ipsec-mb.h>
#endif

namespace longreach {

AesGcm::~AesGcm() { sodium_memzero(key_.data(), key_.size()); }

#ifdef LONGREACH_IPSEC_MB

namespace {

/// The library's functions for this processor, chosen once; null if there is no memory for them.
IMB_MGR* library() {
  static IMB_MGR* const chosen = [] {
    IMB_MGR* const fresh = alloc_mb_mgr(0);
    if (fresh != nullptr) init_mb_mgr_auto(fresh, nullptr);
    return fresh;
  }();
  return chosen;
}

const gcm_key_data* expanded(const std::array<std::uint8_t, 1024>& key) {
  static_assert(sizeof(gcm_key_data) <= sizeof key);
  return reinterpret_cast<const gcm_key_data*>(key.data());
}

}  // namespace

bool AesGcm::available() {
  constexpr std::uint64_t kNeeded = IMB_FEATURE_AESNI | IMB_FEATURE_PCLMULQDQ;
  return library() != nullptr && (library()->features & kNeeded) == kNeeded;
}

void AesGcm::set_key(const std::uint8_t* key) {
  CHECK(available());
  IMB_AES256_GCM_PRE(library(), key, reinterpret_cast<gcm_key_data*>(key_.data()));
}

void AesGcm::close(const std::uint8_t* nonce, Bytes header, Bytes body, std::uint8_t* out) const {
  gcm_context_data context;
  IMB_AES256_GCM_ENC(library(), expanded(key_), &context, out, body.data, body.size, nonce, header.data,
                     header.size, out + body.size, kTagBytes);
}

bool AesGcm::open(const std::uint8_t* nonce, Bytes header, Bytes sealed, std::uint8_t* out) const {
  if (sealed.size < kTagBytes) return false;
  const std::size_t size = sealed.size - kTagBytes;
  std::array<std::uint8_t, kTagBytes> tag;
  gcm_context_data context;
  IMB_AES256_GCM_DEC(library(), expanded(key_), &context, out, sealed.data, size, nonce, header.data,
                     header.size, tag.data(), kTagBytes);
  static_assert(kTagBytes == crypto_verify_16_BYTES);
  if (crypto_verify_16(tag.data(), sealed.data + size) == 0) return true;
  sodium_memzero(out, size);
  return false;
}

#else

bool AesGcm::available() { return false; }
void AesGcm::set_key(const std::uint8_t*) { CHECK(available()); }
void AesGcm::close(const std::uint8_t*, Bytes, Bytes, std::uint8_t*) const { CHECK(available()); }
bool AesGcm::open(const std::uint8_t*, Bytes, Bytes, std::uint8_t*) const { return false; }

#endif

}  // namespace longreach
