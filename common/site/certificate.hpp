#pragma once
// Certificates of a site (X.509 v3, ECDSA P-256, OpenSSL): an authority and the certificates that it issues.
// Clocks may be wrong, so certificates are valid from 1970 to 9999 by default: a site is replaced explicitly,
// it does not expire.

#include <string>

namespace longreach {

/// A certificate and its private key, both as PEM text.
struct Certificate {
  std::string certificate_pem;
  std::string key_pem;
};

enum class CertificateUse { kServer, kClient, kBoth };

struct CertificateTerms {
  std::string name;  // DNS name of its holder, such as "slave.longreach"
  CertificateUse use = CertificateUse::kBoth;
  std::string not_before = "19700101000000Z";  // YYYYMMDDhhmmssZ
  std::string not_after = "99991231235959Z";
};

/// Creates a new authority. Throws std::runtime_error if OpenSSL fails.
Certificate make_authority(const std::string& name);

/// Creates a new key and its certificate. Throws std::runtime_error if OpenSSL fails.
Certificate issue(const Certificate& authority, const CertificateTerms& terms);

/// A new key, and a request to certify it by another authority (PKCS #10), as PEM text.
struct CertificateRequest {
  std::string request_pem;
  std::string key_pem;
};
CertificateRequest make_request();

/// Issues a certificate for the key of the request, which its holder must have signed. All other terms are
/// given by the caller, not by the request. Throws std::runtime_error if it is not a signed request of a
/// P-256 key.
std::string certify(const Certificate& authority, const std::string& request_pem,
                    const CertificateTerms& terms);

/// Returns whether the text is a readable certificate, which a damaged file is not.
bool is_certificate(const std::string& certificate_pem);
bool is_key(const std::string& key_pem);
/// Returns whether the key belongs to the certificate and both are readable.
bool belong_together(const Certificate& certificate);

/// "SHA256:5f0c...", like `openssl x509 -fingerprint -sha256`. Throws std::runtime_error if it is not a
/// certificate.
std::string fingerprint(const std::string& certificate_pem);

/// "9999-12-31". Throws std::runtime_error if it is not a certificate.
std::string valid_until(const std::string& certificate_pem);

/// Returns why a peer that trusts the authority rejects the certificate: one clause, such as "it is not
/// signed by the authority". Empty: it is valid. `key_pem`: empty, or the private key that must match.
std::string certificate_trouble(const std::string& authority_pem, const std::string& certificate_pem,
                                const std::string& key_pem, const std::string& name);

}  // namespace longreach
