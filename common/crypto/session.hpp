#pragma once
// What two sides share for as long as they talk: a number that every datagram names in clear, and a secret
// that the keys of both directions come from. The slave draws it from the system's randomness (libsodium) and
// hands it to one master; a restart of either side needs a new one, so that no nonce is ever used twice under
// one key.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace longreach {

enum class Cipher : std::uint8_t {
  kChaCha20Poly1305,  // RFC 8439, fast everywhere
  kAes256Gcm,         // NIST SP 800-38D; only where has_aes256gcm()
};

constexpr std::size_t kSecretBytes = 32;

/// Leaves nothing of itself in memory: neither where it ends nor where it was moved from.
struct Secret : std::array<std::byte, kSecretBytes> {
  Secret() : array{} {}
  Secret(const Secret&) = default;
  Secret(Secret&& from) noexcept;
  Secret& operator=(const Secret&) = default;
  Secret& operator=(Secret&& from) noexcept;
  ~Secret();
};

struct Session {
  std::uint64_t number = 0;  // 0: none
  Cipher cipher = Cipher::kChaCha20Poly1305;
  Secret secret{};
};

/// Whether this processor has the instructions that libsodium's AES-256-GCM needs.
bool has_aes256gcm();

/// Overwrites a copy that has served.
void wipe(std::string& text);

/// A number other than zero and a secret that nobody can guess.
Session draw_session(Cipher cipher);

}  // namespace longreach
