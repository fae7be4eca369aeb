#pragma once
// Token with which a host joins a site: 100 random bits in a form that a person can read, say and type. The
// class computes authentication tags for messages (libsodium).
//
//   text  24 characters in groups of four: 20 random ones, then 4 of their checksum, of Crockford's 32
//   K     = BLAKE2b-256(random characters, key "longreach pairing token")
//   tag   = HMAC-SHA-512-256(K; label | 0 | text)
//
// A tag does not reveal the token; finding it would take 2^99 guesses on average. common/site/pairing limits
// the lifetime of a token and the number of attempts.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace longreach {

class PairingToken {
 public:
  /// Generates a token with the random number generator of the system.
  static PairingToken draw();
  /// Parses a token that a person typed, in upper or lower case, with or without dashes and spaces; O is
  /// accepted for 0, I and L for 1. Returns none if the token is invalid.
  static std::optional<PairingToken> parse(std::string_view text);

  /// "7KQ2-M8XH-3FZP-W0TR-9VNC-D4AB"
  [[nodiscard]] std::string text() const;
  /// Returns the 32-byte tag of `text`, which cannot be computed without the token.
  [[nodiscard]] std::string tag(std::string_view label, std::string_view text) const;
  /// Returns whether a tag is correct, in constant time.
  [[nodiscard]] bool verifies(std::string_view tag, std::string_view label, std::string_view text) const;

 private:
  std::array<std::uint8_t, 20> digits_{};  // values 0 to 31
};

}  // namespace longreach
