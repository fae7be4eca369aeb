#pragma once
// Certificates that must be rejected. Each has exactly one defect.

#include <openssl/bn.h>
#include <openssl/core_names.h>
#include <openssl/param_build.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "common/site/certificate.hpp"
#include "common/site/rpc_security.hpp"

namespace longreach {

struct WrongCertificate {
  std::string kind;
  RpcSecurity security;
};

namespace wrong {

inline std::string written(const auto& write) {
  BIO* bio = BIO_new(BIO_s_mem());
  write(bio);
  char* at = nullptr;
  const long size = BIO_get_mem_data(bio, &at);
  std::string out(at, static_cast<std::size_t>(size));
  BIO_free(bio);
  return out;
}

inline BIO* reader(const std::string& pem) {
  return BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size()));
}

/// Returns the certificate with one bit of its signature flipped. It can still be parsed.
inline std::string tampered(const std::string& certificate_pem) {
  BIO* bio = reader(certificate_pem);
  X509* certificate = PEM_read_bio_X509(bio, nullptr, nullptr, nullptr);
  const ASN1_BIT_STRING* signature = nullptr;
  X509_get0_signature(&signature, nullptr, certificate);
  signature->data[signature->length - 1] ^= 1;
  std::string out = written([&](BIO* to) { PEM_write_bio_X509(to, certificate); });
  X509_free(certificate);
  BIO_free(bio);
  return out;
}

/// Returns a key pair with the public key of `public_pem` and the private key of `private_pem`. An attacker
/// who copied a certificate without its key could only use such a pair.
inline std::string mismatched(const std::string& public_pem, const std::string& private_pem) {
  const auto read = [](const std::string& pem) {
    BIO* bio = reader(pem);
    EVP_PKEY* key = PEM_read_bio_PrivateKey(bio, nullptr, nullptr, nullptr);
    BIO_free(bio);
    return key;
  };
  EVP_PKEY *shown = read(public_pem), *own = read(private_pem), *out = nullptr;
  unsigned char point[65];
  std::size_t size = 0;
  BIGNUM* number = nullptr;
  EVP_PKEY_get_octet_string_param(shown, OSSL_PKEY_PARAM_PUB_KEY, point, sizeof point, &size);
  EVP_PKEY_get_bn_param(own, OSSL_PKEY_PARAM_PRIV_KEY, &number);
  OSSL_PARAM_BLD* build = OSSL_PARAM_BLD_new();
  OSSL_PARAM_BLD_push_utf8_string(build, OSSL_PKEY_PARAM_GROUP_NAME, "prime256v1", 0);
  OSSL_PARAM_BLD_push_octet_string(build, OSSL_PKEY_PARAM_PUB_KEY, point, size);
  OSSL_PARAM_BLD_push_BN(build, OSSL_PKEY_PARAM_PRIV_KEY, number);
  OSSL_PARAM* parameters = OSSL_PARAM_BLD_to_param(build);
  EVP_PKEY_CTX* context = EVP_PKEY_CTX_new_from_name(nullptr, "EC", nullptr);
  EVP_PKEY_fromdata_init(context);
  if (EVP_PKEY_fromdata(context, &out, EVP_PKEY_KEYPAIR, parameters) != 1)
    throw std::runtime_error("no such key");
  std::string text =
      written([&](BIO* to) { PEM_write_bio_PrivateKey(to, out, nullptr, nullptr, 0, nullptr, nullptr); });
  EVP_PKEY_CTX_free(context);
  OSSL_PARAM_free(parameters);
  OSSL_PARAM_BLD_free(build);
  BN_free(number);
  for (EVP_PKEY* key : {shown, own, out}) EVP_PKEY_free(key);
  return text;
}

}  // namespace wrong

/// Returns invalid certificates of a client `name` for the site of this authority.
inline std::vector<WrongCertificate> wrong_certificates(const Certificate& authority,
                                                        const std::string& name) {
  const Certificate other = make_authority("another site");
  const Certificate good = issue(authority, {.name = name}), unknown_peer = issue(other, {.name = name});
  // The holder of a valid client certificate uses it to issue another certificate.
  Certificate delegated = issue(good, {.name = name});
  delegated.certificate_pem += good.certificate_pem;
  const auto with = [&](const Certificate& own) {
    return RpcSecurity{RpcCredentials{authority.certificate_pem, own.certificate_pem, own.key_pem}};
  };
  return {
      {"of another site", with(unknown_peer)},
      {"self-signed", with(other)},
      {"expired", with(issue(authority, {.name = name, .not_after = "20010101000000Z"}))},
      {"not yet valid", with(issue(authority, {.name = name, .not_before = "99980101000000Z"}))},
      {"for servers only", with(issue(authority, {.name = name, .use = CertificateUse::kServer}))},
      {"with another's key",
       with({good.certificate_pem, wrong::mismatched(good.key_pem, unknown_peer.key_pem)})},
      {"with a forged signature", with({wrong::tampered(good.certificate_pem), good.key_pem})},
      {"issued by one that is no authority", with(delegated)},
      {"none at all", {RpcCredentials{authority.certificate_pem, "", ""}}},
      {"in clear", {}},
  };
}

}  // namespace longreach
