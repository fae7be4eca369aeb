#include "common/crypto/seal.hpp"

#include <endian.h>
#include <sodium.h>

#include <cstring>

#include "common/core/check.hpp"

namespace longreach {
namespace {

constexpr char kContext[crypto_kdf_CONTEXTBYTES + 1] = "longrch4";  // 4: the wire version
constexpr std::uint64_t kDirections = 2;

using NonceBytes = std::array<unsigned char, 12>;

// Not returned: a processor that copies in one go what was just written in parts waits for the parts.
void write(const Nonce& nonce, NonceBytes& out) {
  const std::uint64_t sequence = htobe64(nonce.sequence);
  out = {nonce.type};
  std::memcpy(&out[4], &sequence, sizeof sequence);
}

const unsigned char* raw(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}
unsigned char* raw(std::span<std::byte> bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }

AesGcm::Bytes all(std::span<const std::byte> bytes) { return {raw(bytes), bytes.size()}; }

}  // namespace

Seal::Seal(const Session& session, Way way) : cipher_(session.cipher) {
  static_assert(kSecretBytes == crypto_kdf_KEYBYTES &&
                kTagBytes == crypto_aead_chacha20poly1305_ietf_ABYTES && kTagBytes == AesGcm::kTagBytes &&
                sizeof(NonceBytes) == AesGcm::kNonceBytes &&
                sizeof(NonceBytes) == crypto_aead_chacha20poly1305_ietf_NPUBBYTES &&
                kKeyBytes == crypto_aead_chacha20poly1305_ietf_KEYBYTES && kKeyBytes == AesGcm::kKeyBytes);
  CHECK(sodium_init() >= 0);
  const std::uint64_t id =
      kDirections * static_cast<std::uint64_t>(cipher_) + static_cast<std::uint64_t>(way);
  CHECK(crypto_kdf_derive_from_key(key_.data(), key_.size(), id, kContext, raw(std::span(session.secret))) ==
        0);
  if (cipher_ == Cipher::kAes256Gcm) aes_.set_key(key_.data());
}

Seal::~Seal() { sodium_memzero(key_.data(), key_.size()); }

void Seal::close(const Nonce& nonce, std::span<const std::byte> header, std::span<std::byte> body) const {
  CHECK(body.size() >= kTagBytes);
  NonceBytes n;
  write(nonce, n);
  unsigned char* const at = raw(body);
  const std::size_t size = body.size() - kTagBytes;
  if (cipher_ == Cipher::kAes256Gcm) {
    aes_.close(n.data(), all(header), {at, size}, at);
  } else {
    crypto_aead_chacha20poly1305_ietf_encrypt(at, nullptr, at, size, raw(header), header.size(), nullptr,
                                              n.data(), key_.data());
  }
}

bool Seal::open(const Nonce& nonce, std::span<const std::byte> header, std::span<const std::byte> sealed,
                std::span<std::byte> body) const {
  if (sealed.size() < kTagBytes) return false;
  CHECK(body.size() >= sealed.size() - kTagBytes);
  NonceBytes n;
  write(nonce, n);
  if (cipher_ == Cipher::kAes256Gcm) return aes_.open(n.data(), all(header), all(sealed), raw(body));
  return crypto_aead_chacha20poly1305_ietf_decrypt(raw(body), nullptr, nullptr, raw(sealed), sealed.size(),
                                                   raw(header), header.size(), n.data(), key_.data()) == 0;
}

}  // namespace longreach
