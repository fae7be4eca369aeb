#pragma once
// AES-256-GCM (NIST SP 800-38D) with one key, by Intel's Multi-Buffer Crypto library, which needs a third of
// the time of libsodium for a short datagram. Only x86 with AES instructions is supported, because
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

  /// Returns whether it was built in and the processor supports it; if not, no other function may be called.
  static bool available();

  AesGcm() = default;
  ~AesGcm();  // wipes the key
  AesGcm(const AesGcm&) = delete;
  AesGcm& operator=(const AesGcm&) = delete;

  void set_key(const std::uint8_t* key);
  /// Writes the encrypted body to `out`, which may be the body, followed by the tag.
  void close(const std::uint8_t* nonce, Bytes header, Bytes body, std::uint8_t* out) const;
  /// Writes the body of `sealed` (body, then tag) to `out` if it was sealed with this key, nonce and header;
  /// otherwise `out` is zero.
  [[nodiscard]] bool open(const std::uint8_t* nonce, Bytes header, Bytes sealed, std::uint8_t* out) const;

 private:
  alignas(64) std::array<std::uint8_t, 1024> key_{};  // expanded key
};

}  // namespace longreach
