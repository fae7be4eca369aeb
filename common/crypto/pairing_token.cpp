#include "common/crypto/pairing_token.hpp"

#include <sodium.h>

#include "common/core/check.hpp"

namespace longreach {
namespace {

constexpr std::string_view kAlphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr std::string_view kKeyName = "longreach pairing token";
constexpr std::string_view kChecksumName = "longreach pairing checksum";
constexpr std::size_t kChecksum = 4;
constexpr std::size_t kGroup = 4;

std::array<unsigned char, crypto_auth_KEYBYTES> hash(const std::array<std::uint8_t, 20>& digits,
                                                     std::string_view name) {
  std::array<unsigned char, crypto_auth_KEYBYTES> out{};
  crypto_generichash(out.data(), out.size(), digits.data(), digits.size(),
                     reinterpret_cast<const unsigned char*>(name.data()), name.size());
  return out;
}

std::optional<std::uint8_t> digit_of(char c) {
  char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  if (upper == 'O') upper = '0';
  if (upper == 'I' || upper == 'L') upper = '1';
  const std::size_t at = kAlphabet.find(upper);
  if (at == std::string_view::npos) return std::nullopt;
  return static_cast<std::uint8_t>(at);
}

std::array<std::uint8_t, kChecksum> checksum(const std::array<std::uint8_t, 20>& digits) {
  const auto bytes = hash(digits, kChecksumName);
  std::array<std::uint8_t, kChecksum> out{};
  for (std::size_t i = 0; i < kChecksum; ++i) out[i] = bytes[i] % 32;
  return out;
}

// A byte order mark, and the word that longreach-slave prints before the token.
std::string_view without_prefix(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF", kWord = "token:";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  text.remove_prefix(first == std::string_view::npos ? text.size() : first);
  if (text.size() < kWord.size()) return text;
  for (std::size_t i = 0; i < kWord.size(); ++i) {
    const char c = text[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != kWord[i]) return text;
  }
  text.remove_prefix(kWord.size());
  return text;
}

}  // namespace

PairingToken PairingToken::draw() {
  CHECK(sodium_init() >= 0);
  PairingToken token;
  for (std::uint8_t& digit : token.digits_) digit = static_cast<std::uint8_t>(randombytes_uniform(32));
  return token;
}

std::optional<PairingToken> PairingToken::parse(std::string_view text) {
  text = without_prefix(text);
  PairingToken token;
  std::array<std::uint8_t, kChecksum> given{};
  const std::size_t digits = token.digits_.size();
  std::size_t count = 0;
  for (const char c : text) {
    if (c == '-' || c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    const auto digit = digit_of(c);
    if (!digit || count == digits + kChecksum) return std::nullopt;
    (count < digits ? token.digits_[count] : given[count - digits]) = *digit;
    ++count;
  }
  if (count != digits + kChecksum || given != checksum(token.digits_)) return std::nullopt;
  return token;
}

std::string PairingToken::text() const {
  std::string out;
  const auto add = [&out](std::uint8_t digit) {
    if (out.size() % (kGroup + 1) == kGroup) out += '-';
    out += kAlphabet[digit];
  };
  for (const std::uint8_t digit : digits_) add(digit);
  for (const std::uint8_t digit : checksum(digits_)) add(digit);
  return out;
}

std::string PairingToken::tag(std::string_view label, std::string_view text) const {
  auto key = hash(digits_, kKeyName);
  std::string message(label);
  message += '\0';
  message += text;
  std::string out(crypto_auth_BYTES, '\0');
  crypto_auth(reinterpret_cast<unsigned char*>(out.data()),
              reinterpret_cast<const unsigned char*>(message.data()), message.size(), key.data());
  sodium_memzero(key.data(), key.size());
  return out;
}

bool PairingToken::verifies(std::string_view given, std::string_view label, std::string_view text) const {
  const std::string right = tag(label, text);
  return given.size() == right.size() && sodium_memcmp(given.data(), right.data(), right.size()) == 0;
}

}  // namespace longreach
