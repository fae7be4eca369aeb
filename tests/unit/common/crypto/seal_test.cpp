// The seal against OpenSSL's implementations of the same standards, and what it must not open.
#include "common/crypto/seal.hpp"

#include <gtest/gtest.h>
#include <openssl/core_names.h>
#include <openssl/evp.h>
#include <openssl/params.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::seal_test {
namespace {

using Bytes = std::vector<std::byte>;

std::vector<Cipher> ciphers() {
  std::vector<Cipher> out{Cipher::kChaCha20Poly1305};
  if (has_aes256gcm()) out.push_back(Cipher::kAes256Gcm);
  return out;
}

Session session(Cipher cipher) {
  Session s{.number = 5, .cipher = cipher};
  for (std::size_t i = 0; i < s.secret.size(); ++i) s.secret[i] = static_cast<std::byte>(3 * i + 1);
  return s;
}

Bytes noise(std::size_t size, std::uint64_t seed) {
  Random random(seed);
  Bytes out(size);
  for (auto& b : out) b = static_cast<std::byte>(random.next());
  return out;
}

Bytes closed(const Seal& seal, const Nonce& nonce, const Bytes& header, const Bytes& body) {
  Bytes out = body;
  out.resize(body.size() + 16);
  seal.close(nonce, header, out);
  return out;
}

bool opens(const Seal& seal, const Nonce& nonce, const Bytes& header, const Bytes& sealed) {
  Bytes body(sealed.size());
  return seal.open(nonce, header, sealed, body);
}

const unsigned char* raw(const Bytes& bytes) { return reinterpret_cast<const unsigned char*>(bytes.data()); }
unsigned char* raw(Bytes& bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }

/// BLAKE2b keyed with the secret, the number of the key as salt, the context as personalisation.
Bytes openssl_key(const Session& s, std::uint8_t id) {
  std::array<unsigned char, 16> salt{id}, custom{'l', 'o', 'n', 'g', 'r', 'c', 'h', '4'};
  std::size_t size = 32;
  const OSSL_PARAM parameters[] = {
      OSSL_PARAM_construct_octet_string(OSSL_MAC_PARAM_SALT, salt.data(), salt.size()),
      OSSL_PARAM_construct_octet_string(OSSL_MAC_PARAM_CUSTOM, custom.data(), custom.size()),
      OSSL_PARAM_construct_size_t(OSSL_MAC_PARAM_SIZE, &size), OSSL_PARAM_construct_end()};
  EVP_MAC* mac = EVP_MAC_fetch(nullptr, "BLAKE2BMAC", nullptr);
  EVP_MAC_CTX* context = EVP_MAC_CTX_new(mac);
  Bytes key(32);
  EXPECT_EQ(EVP_MAC_init(context, reinterpret_cast<const unsigned char*>(s.secret.data()), 32, parameters),
            1);
  EXPECT_EQ(EVP_MAC_final(context, raw(key), &size, key.size()), 1);
  EVP_MAC_CTX_free(context);
  EVP_MAC_free(mac);
  return key;
}

Bytes openssl_sealed(const Session& s, std::uint8_t id, const Bytes& nonce, const Bytes& header,
                     const Bytes& body) {
  const EVP_CIPHER* cipher = s.cipher == Cipher::kAes256Gcm ? EVP_aes_256_gcm() : EVP_chacha20_poly1305();
  const Bytes key = openssl_key(s, id);
  EVP_CIPHER_CTX* context = EVP_CIPHER_CTX_new();
  Bytes out(body.size() + 16);
  int size = 0;
  EXPECT_EQ(EVP_EncryptInit_ex(context, cipher, nullptr, raw(key), raw(nonce)), 1);
  EXPECT_EQ(EVP_EncryptUpdate(context, nullptr, &size, raw(header), static_cast<int>(header.size())), 1);
  EXPECT_EQ(EVP_EncryptUpdate(context, raw(out), &size, raw(body), static_cast<int>(body.size())), 1);
  EXPECT_EQ(EVP_EncryptFinal_ex(context, raw(out) + size, &size), 1);
  EXPECT_EQ(EVP_CIPHER_CTX_ctrl(context, EVP_CTRL_AEAD_GET_TAG, 16, raw(out) + body.size()), 1);
  EVP_CIPHER_CTX_free(context);
  return out;
}

TEST(Seal, IsWhatOpensslMakesOfTheSameKeyNonceAndHeader) {
  const Nonce nonce{3, 0x0102030405060708};
  const Bytes nonce_bytes = {std::byte{3}, std::byte{0}, std::byte{0}, std::byte{0},
                             std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4},
                             std::byte{5}, std::byte{6}, std::byte{7}, std::byte{8}};
  for (const Cipher cipher : ciphers()) {
    const Session s = session(cipher);
    for (const Way way : {Way::kToSlave, Way::kToMaster}) {
      const auto id = static_cast<std::uint8_t>(2 * static_cast<int>(cipher) + static_cast<int>(way));
      for (std::size_t size = 1; size <= 474; ++size) {
        const Bytes header = noise(18, size), body = noise(size, 2 * size);
        ASSERT_EQ(closed(Seal(s, way), nonce, header, body), openssl_sealed(s, id, nonce_bytes, header, body))
            << "cipher " << static_cast<int>(cipher) << ", " << size << " bytes";
      }
    }
  }
}

TEST(Seal, OpensWhatTheOtherEndOfItsDirectionClosed) {
  for (const Cipher cipher : ciphers()) {
    const Seal one(session(cipher), Way::kToSlave), other(session(cipher), Way::kToSlave);
    for (const std::size_t size : {0U, 1U, 100U, 474U}) {
      const Bytes header = noise(18, 1), body = noise(size, 2);
      Bytes opened(size);
      ASSERT_TRUE(other.open({1, 7}, header, closed(one, {1, 7}, header, body), opened));
      EXPECT_EQ(opened, body);
    }
  }
}

TEST(Seal, OpensNothingElse) {
  for (const Cipher cipher : ciphers()) {
    const Seal seal(session(cipher), Way::kToSlave);
    const Bytes header = noise(18, 1);
    const Bytes sealed = closed(seal, {1, 7}, header, noise(60, 2));
    ASSERT_TRUE(opens(seal, {1, 7}, header, sealed));
    EXPECT_FALSE(opens(Seal(session(cipher), Way::kToMaster), {1, 7}, header, sealed)) << "other direction";
    EXPECT_FALSE(opens(seal, {2, 7}, header, sealed)) << "other type";
    EXPECT_FALSE(opens(seal, {1, 8}, header, sealed)) << "other sequence";
    EXPECT_FALSE(opens(seal, {1, 7 + (1ULL << 63)}, header, sealed)) << "greatest bit of the sequence";
    for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
      Bytes flipped = sealed;
      flipped[bit / 8] ^= std::byte{1} << (bit % 8);
      ASSERT_FALSE(opens(seal, {1, 7}, header, flipped)) << "bit " << bit;
    }
    for (std::size_t bit = 0; bit < 8 * header.size(); ++bit) {
      Bytes flipped = header;
      flipped[bit / 8] ^= std::byte{1} << (bit % 8);
      ASSERT_FALSE(opens(seal, {1, 7}, flipped, sealed)) << "bit " << bit << " of the header";
    }
    for (std::size_t size = 0; size < sealed.size(); ++size)
      ASSERT_FALSE(
          opens(seal, {1, 7}, header, Bytes(sealed.begin(), sealed.begin() + static_cast<long>(size))));
    for (std::size_t bit = 0; bit < 256; ++bit) {
      Session other = session(cipher);
      other.secret[bit / 8] ^= std::byte{1} << (bit % 8);
      ASSERT_FALSE(opens(Seal(other, Way::kToSlave), {1, 7}, header, sealed))
          << "bit " << bit << " of the secret";
    }
  }
}

TEST(Seal, GivesNothingAwayOfWhatDoesNotOpen) {
  for (const Cipher cipher : ciphers()) {
    const Seal seal(session(cipher), Way::kToSlave);
    const Bytes header = noise(18, 1), body = noise(60, 2);
    Bytes sealed = closed(seal, {1, 7}, header, body);
    sealed.back() ^= std::byte{1};
    Bytes opened(body.size());
    ASSERT_FALSE(seal.open({1, 7}, header, sealed, opened));
    EXPECT_EQ(opened, Bytes(body.size())) << "left as it was, or wiped";
  }
}

TEST(Session, IsDrawnAnewEachTime) {
  std::set<std::uint64_t> numbers;
  std::set<Secret> secrets;
  for (int i = 0; i < 1000; ++i) {
    const Session s = draw_session(Cipher::kChaCha20Poly1305);
    EXPECT_NE(s.number, 0U);
    numbers.insert(s.number);
    secrets.insert(s.secret);
  }
  EXPECT_EQ(numbers.size(), 1000U);
  EXPECT_EQ(secrets.size(), 1000U);
}

}  // namespace
}  // namespace longreach::seal_test
