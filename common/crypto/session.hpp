#pragma once
// A session: the state that both sides share during a connection. It consists of a number, which every
// datagram contains unencrypted, and a secret, from which the keys of both directions are derived. The slave
// generates the session with the random number generator of the system (libsodium) and gives it to one
// master. Each side requires a new session when it restarts, so that no nonce is ever used twice with the
// same key.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace longreach {

enum class Cipher : std::uint8_t {
  kChaCha20Poly1305,  // RFC 8439, fast everywhere
  kAes256Gcm,         // NIST SP 800-38D; requires has_aes256gcm()
};

constexpr std::size_t kSecretBytes = 32;

/// A secret that is erased from memory when it is destroyed or moved from.
struct Secret : std::array<std::byte, kSecretBytes> {
  Secret() : array{} {}
  Secret(const Secret&) = default;
  Secret(Secret&& from) noexcept;
  Secret& operator=(const Secret&) = default;
  Secret& operator=(Secret&& from) noexcept;
  ~Secret();
};

struct Session {
  std::uint64_t number = 0;  // 0: no session
  Cipher cipher = Cipher::kChaCha20Poly1305;
  Secret secret{};
};

/// Returns whether this processor has the instructions for AES-256-GCM in libsodium.
bool has_aes256gcm();

/// Overwrites the text; call this for each copy of a secret after use.
void wipe(std::string& text);

/// Generates a session with a non-zero number and an unpredictable secret.
Session draw_session(Cipher cipher);

}  // namespace longreach
