#pragma once
// State shared by both sides during a connection: a number that every datagram carries unencrypted, and a
// secret from which the keys of both directions are derived. The slave draws it from the system's random
// source (libsodium) and gives it to one master. A restart of either side requires a new session, so that no
// nonce is ever used twice with the same key.

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

/// Erases itself from memory, both on destruction and when moved from.
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

/// Returns whether this processor has the instructions for AES-256-GCM in libsodium.
bool has_aes256gcm();

/// Overwrites a copy of a secret after use.
void wipe(std::string& text);

/// Draws a session with a non-zero number and an unpredictable secret.
Session draw_session(Cipher cipher);

}  // namespace longreach
