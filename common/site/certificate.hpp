#pragma once
// Certificates of a site (X.509 v3, ECDSA P-256, OpenSSL): an authority and the certificates that it issues.
// By default they are valid from 1970 to 9999, because clocks may be wrong. A site does not expire; it must
// be replaced explicitly.

#include <string>

namespace longreach {

/// A certificate and its private key, both as PEM text.
struct Certificate {
  std::string certificate_pem;
  std::string key_pem;
};

enum class CertificateUse { kServer, kClient, kBoth };

struct CertificateTerms {
  std::string name;  // DNS name of the holder, such as "slave.longreach"
  CertificateUse use = CertificateUse::kBoth;
  std::string not_before = "19700101000000Z";  // YYYYMMDDhhmmssZ
  std::string not_after = "99991231235959Z";
};

/// Creates a new authority. Throws std::runtime_error if OpenSSL fails.
Certificate make_authority(const std::string& name);

/// Creates a new key and its certificate. Throws std::runtime_error if OpenSSL fails.
Certificate issue(const Certificate& authority, const CertificateTerms& terms);

/// A new key, and a request to certify it (PKCS #10), both as PEM text.
struct CertificateRequest {
  std::string request_pem;
  std::string key_pem;
};
CertificateRequest make_request();

/// Issues a certificate for the key in a request, which must be signed with that key. The caller, not the
/// request, determines all other terms. Throws std::runtime_error if the text is not a signed request for a
/// P-256 key.
std::string certify(const Certificate& authority, const std::string& request_pem,
                    const CertificateTerms& terms);

/// Returns whether the text is a valid certificate; false for a damaged file.
bool is_certificate(const std::string& certificate_pem);
bool is_key(const std::string& key_pem);
/// Returns whether the certificate and the key are valid and match.
bool belong_together(const Certificate& certificate);

/// Returns the fingerprint as printed by `openssl x509 -fingerprint -sha256`, e.g. "SHA256:5f0c...". Throws
/// std::runtime_error if the text is not a certificate.
std::string fingerprint(const std::string& certificate_pem);

/// Returns the last day of validity, e.g. "9999-12-31". Throws std::runtime_error if the text is not a
/// certificate.
std::string valid_until(const std::string& certificate_pem);

/// Returns why a peer that trusts the authority would reject the certificate, as a clause such as "it is not
/// signed by the authority". Returns an empty string if the certificate is valid. If `key_pem` is not empty,
/// also checks that it is the matching private key.
std::string certificate_trouble(const std::string& authority_pem, const std::string& certificate_pem,
                                const std::string& key_pem, const std::string& name);

}  // namespace longreach
