#pragma once
// AES-256-GCM (NIST SP 800-38D) with one key. Uses Intel's Multi-Buffer Crypto library, which is three times
// as fast as libsodium for short datagrams. Only x86 processors with AES instructions are supported, because
// table-based AES leaks the key through the cache.

#include <array>
#include <cstddef>
#include <cstdint>

namespace longreach {

class AesGcm {
 public:
  static constexpr std::size_t kKeyBytes = 32, kNonceBytes = 12, kTagBytes = 16;
  struct Bytes {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
  };

  /// Returns whether AES-256-GCM was built in and the processor supports it. If not, no other function may be
  /// called.
  static bool available();

  AesGcm() = default;
  ~AesGcm();  // wipes the key
  AesGcm(const AesGcm&) = delete;
  AesGcm& operator=(const AesGcm&) = delete;

  void set_key(const std::uint8_t* key);
  /// Encrypts `body` and writes the result, followed by the tag, to `out`, which may alias `body`.
  void close(const std::uint8_t* nonce, Bytes header, Bytes body, std::uint8_t* out) const;
  /// Decrypts `sealed` (body, then tag) into `out`. Returns true if it was sealed with this key, nonce and
  /// header; otherwise fills `out` with zeros.
  [[nodiscard]] bool open(const std::uint8_t* nonce, Bytes header, Bytes sealed, std::uint8_t* out) const;

 private:
  alignas(64) std::array<std::uint8_t, 1024> key_{};  // expanded key
};

}  // namespace longreach
