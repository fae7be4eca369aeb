#pragma once
// Authenticated encryption of the datagrams of one direction of one session (AEAD).
//
//   key   = KDF(secret; cipher, direction)    BLAKE2b, crypto_kdf_derive_from_key
//   nonce = type (1) | 0 (3) | sequence (8)   big-endian, used once per key: the sender counts
//   (body, header) -> encrypted body | tag (16); the header is authenticated but not encrypted
//
// A datagram that was sealed for one direction cannot be opened in the other. common/link prevents repeated
// nonces and handles reordering and replay. Does not allocate memory.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/crypto/aes_gcm.hpp"
#include "common/crypto/session.hpp"

namespace longreach {

constexpr std::size_t kTagBytes = 16;

enum class Way : std::uint8_t { kToSlave = 1, kToMaster = 2 };

struct Nonce {
  std::uint8_t type = 0;
  std::uint64_t sequence = 0;
};

class Seal {
 public:
  Seal(const Session& session, Way way);
  ~Seal();  // wipes the key
  Seal(const Seal&) = delete;
  Seal& operator=(const Seal&) = delete;

  /// Encrypts in place. `body` contains the body, followed by space for the tag.
  void close(const Nonce& nonce, std::span<const std::byte> header, std::span<std::byte> body) const;

  /// Decrypts `sealed` (body, then tag) into `body`, which has space for everything except the tag. Returns
  /// true if it was sealed with this key, nonce and header; otherwise `body` contains no decrypted data.
  [[nodiscard]] bool open(const Nonce& nonce, std::span<const std::byte> header,
                          std::span<const std::byte> sealed, std::span<std::byte> body) const;

 private:
  static constexpr std::size_t kKeyBytes = 32;

  Cipher cipher_;
  std::array<unsigned char, kKeyBytes> key_{};
  AesGcm aes_;
};

}  // namespace longreach
