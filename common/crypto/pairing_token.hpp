#pragma once
// Token by which a host joins a site: 100 random bits in a form that a person can read, say and type, and the
// tags that it authenticates (libsodium).
//
//   text  24 characters in groups of four: 20 random ones, then 4 of their checksum, of Crockford's 32
//   K     = BLAKE2b-256(random characters, key "longreach pairing token")
//   tag   = HMAC-SHA-512-256(K; label | 0 | text)
//
// A tag does not reveal the token: finding it takes 2^99 guesses. The lifetime of a token and the number of
// attempts are handled in common/site/pairing.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace longreach {

class PairingToken {
 public:
  /// Draws a token from the system's random source.
  static PairingToken draw();
  /// Parses a typed token: any case, with or without dashes and spaces, O for 0, I and L for 1. Returns none
  /// if it is invalid.
  static std::optional<PairingToken> parse(std::string_view text);

  /// "7KQ2-M8XH-3FZP-W0TR-9VNC-D4AB"
  [[nodiscard]] std::string text() const;
  /// Returns 32 bytes that cannot be computed without the token.
  [[nodiscard]] std::string tag(std::string_view label, std::string_view text) const;
  /// Checks a tag in constant time.
  [[nodiscard]] bool verifies(std::string_view tag, std::string_view label, std::string_view text) const;

 private:
  std::array<std::uint8_t, 20> digits_{};  // 0 to 31
};

}  // namespace longreach
