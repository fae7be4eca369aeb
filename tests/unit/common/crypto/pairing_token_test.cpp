// The token that a person carries: its text, its typos, and what it authenticates.
#include "common/crypto/pairing_token.hpp"

#include <gtest/gtest.h>
#include <openssl/core_names.h>
#include <openssl/evp.h>
#include <openssl/params.h>

#include <set>

namespace longreach::pairing_token_test {
namespace {

TEST(PairingToken, IsReadAsItIsTypedAndSaid) {
  const PairingToken token = PairingToken::draw();
  const std::string text = token.text();
  ASSERT_EQ(text.size(), 29U) << text;
  std::string bare, lower, said;
  for (const char c : text) {
    if (c == '-') continue;
    bare += c;
    lower += static_cast<char>(std::tolower(c));
    said += c == '0' ? 'o' : c == '1' ? 'l' : c;
  }
  for (const std::string& typed : {text, bare, lower, said, " " + text + " "}) {
    const auto read = PairingToken::parse(typed);
    ASSERT_TRUE(read) << typed;
    EXPECT_EQ(read->text(), text) << typed;
  }
}

// As programs on Windows save it, and as longreach-slave prints it.
TEST(PairingToken, IsReadFromFilesOfOtherPrograms) {
  const std::string text = PairingToken::draw().text();
  for (const std::string& file : {text + "\r\n", "\xEF\xBB\xBF" + text + "\r", "Token: " + text + "\r\n",
                                  "\xEF\xBB\xBFtoken:\t" + text, " Token:" + text + "\n"}) {
    const auto read = PairingToken::parse(file);
    ASSERT_TRUE(read) << file;
    EXPECT_EQ(read->text(), text) << file;
  }
  EXPECT_FALSE(PairingToken::parse("Token " + text));
  EXPECT_FALSE(PairingToken::parse("Token:"));
}

TEST(PairingToken, ATypoIsNoticedBeforeItIsSent) {
  const std::string text = PairingToken::draw().text();
  int unnoticed = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '-') continue;
    for (const char c : std::string("0123456789ABCDEFGHJKMNPQRSTVWXYZ")) {
      std::string typo = text;
      typo[i] = c;
      if (c != text[i] && PairingToken::parse(typo)) ++unnoticed;
    }
    EXPECT_FALSE(PairingToken::parse(text.substr(0, i)));
  }
  EXPECT_LE(unnoticed, 1) << "744 typos, each unnoticed with a chance of 1e-6";
  for (const std::string wrong : {"", "-", "U", "0000", "0000-0000-0000-0000-0000-0000-0"})
    EXPECT_FALSE(PairingToken::parse(wrong)) << wrong;
  EXPECT_FALSE(PairingToken::parse(text + "0"));
}

TEST(PairingToken, EveryCharacterIsDrawnAndNoTokenComesTwice) {
  std::set<std::string> tokens;
  std::array<std::set<char>, 29> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string text = PairingToken::draw().text();
    tokens.insert(text);
    for (std::size_t k = 0; k < text.size(); ++k) seen[k].insert(text[k]);
  }
  EXPECT_EQ(tokens.size(), 1000U);
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_EQ(seen[k].size(), k % 5 == 4 ? 1U : 32U) << k;
}

/// OpenSSL's HMAC as an oracle.
std::string hmac(const std::string& key, const std::string& text) {
  EVP_MAC* mac = EVP_MAC_fetch(nullptr, "HMAC", nullptr);
  EVP_MAC_CTX* context = EVP_MAC_CTX_new(mac);
  std::string digest = "SHA512";
  const OSSL_PARAM parameters[] = {OSSL_PARAM_construct_utf8_string(OSSL_MAC_PARAM_DIGEST, digest.data(), 0),
                                   OSSL_PARAM_construct_end()};
  std::string out(64, '\0');
  EVP_MAC_init(context, reinterpret_cast<const unsigned char*>(key.data()), key.size(), parameters);
  EVP_MAC_update(context, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  EVP_MAC_final(context, reinterpret_cast<unsigned char*>(out.data()), nullptr, out.size());
  EVP_MAC_CTX_free(context);
  EVP_MAC_free(mac);
  return out.substr(0, 32);  // HMAC-SHA-512-256 of libsodium: the first half
}

/// BLAKE2b-256 with a key, of OpenSSL.
std::string blake2b(const std::string& key, const std::string& text) {
  EVP_MAC* mac = EVP_MAC_fetch(nullptr, "BLAKE2BMAC", nullptr);
  EVP_MAC_CTX* context = EVP_MAC_CTX_new(mac);
  std::size_t size = 32;
  const OSSL_PARAM parameters[] = {OSSL_PARAM_construct_size_t(OSSL_MAC_PARAM_SIZE, &size),
                                   OSSL_PARAM_construct_end()};
  std::string out(32, '\0');
  EVP_MAC_init(context, reinterpret_cast<const unsigned char*>(key.data()), key.size(), parameters);
  EVP_MAC_update(context, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  EVP_MAC_final(context, reinterpret_cast<unsigned char*>(out.data()), nullptr, out.size());
  EVP_MAC_CTX_free(context);
  EVP_MAC_free(mac);
  return out;
}

TEST(PairingToken, ATagIsTheHmacThatTheHeaderSays) {
  const PairingToken token = PairingToken::draw();
  std::string digits;
  for (const char c : token.text())
    if (c != '-') digits += static_cast<char>(std::string("0123456789ABCDEFGHJKMNPQRSTVWXYZ").find(c));
  const std::string key = blake2b("longreach pairing token", digits.substr(0, 20));
  EXPECT_EQ(token.tag("label", "text"), hmac(key, std::string("label\0text", 10)));
}

TEST(PairingToken, ATagFitsOneTokenOneLabelAndOneText) {
  const PairingToken token = PairingToken::draw();
  const std::string tag = token.tag("request", "text");
  EXPECT_TRUE(token.verifies(tag, "request", "text"));
  EXPECT_FALSE(token.verifies(tag, "answer", "text"));
  EXPECT_FALSE(token.verifies(tag, "request", "texts"));
  EXPECT_FALSE(token.verifies("", "request", "text"));
  EXPECT_FALSE(token.verifies(tag.substr(0, 31), "request", "text"));
  EXPECT_FALSE(PairingToken::draw().verifies(tag, "request", "text"));
  for (std::size_t bit = 0; bit < 8 * tag.size(); ++bit) {
    std::string flipped = tag;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_FALSE(token.verifies(flipped, "request", "text")) << bit;
  }
}

}  // namespace
}  // namespace longreach::pairing_token_test
