#pragma once
// The token by which a host joins a site: 100 random bits that a person reads, says and types, and what it
// authenticates (libsodium).
//
//   text  24 characters in groups of four: 20 random ones, then 4 of their checksum, of Crockford's 32
//   K     = BLAKE2b-256(random characters, key "longreach pairing token")
//   tag   = HMAC-SHA-512-256(K; label | 0 | text)
//
// Who reads a tag cannot find the token: that takes 2^99 guesses. Does not handle: how long it is good for,
// and how often it may be tried (common/site/pairing).

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace longreach {

class PairingToken {
 public:
  /// From the system's randomness.
  static PairingToken draw();
  /// As a person types it: any case, with or without dashes and spaces, O for 0, I and L for 1. None: it is
  /// mistyped.
  static std::optional<PairingToken> parse(std::string_view text);

  /// "7KQ2-M8XH-3FZP-W0TR-9VNC-D4AB"
  [[nodiscard]] std::string text() const;
  /// 32 bytes that nobody can make without the token.
  [[nodiscard]] std::string tag(std::string_view label, std::string_view text) const;
  /// In constant time.
  [[nodiscard]] bool verifies(std::string_view tag, std::string_view label, std::string_view text) const;

 private:
  std::array<std::uint8_t, 20> digits_{};  // 0 to 31
};

}  // namespace longreach
