#pragma once
// AES-256-GCM (NIST SP 800-38D) under one key, by Intel's Multi-Buffer Crypto library: a short datagram in a
// third of the time that libsodium takes. x86 with AES instructions only, since AES by tables tells its key
// to the cache.

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

  /// Whether it was built in and the processor has what it needs; nothing else may be called where not.
  static bool available();

  AesGcm() = default;
  ~AesGcm();  // wipes the key
  AesGcm(const AesGcm&) = delete;
  AesGcm& operator=(const AesGcm&) = delete;

  void set_key(const std::uint8_t* key);
  /// Writes the encrypted body to `out`, which may be the body, and the tag behind it.
  void close(const std::uint8_t* nonce, Bytes header, Bytes body, std::uint8_t* out) const;
  /// Writes the body of `sealed` (body, then tag) to `out` if it was closed with this key, nonce and header;
  /// if not, `out` is zero.
  [[nodiscard]] bool open(const std::uint8_t* nonce, Bytes header, Bytes sealed, std::uint8_t* out) const;

 private:
  alignas(64) std::array<std::uint8_t, 1024> key_{};  // expanded
};

}  // namespace longreach
