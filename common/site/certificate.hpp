#pragma once
// Certificates for a site of ours (X.509 v3, ECDSA P-256, OpenSSL): an authority of its own, and what it
// issues. Clocks in space are wrong, so certificates are valid from 1970 to 9999 unless told otherwise: a
// site ends by being made anew, not by a date.

#include <string>

namespace longreach {

/// A certificate and its private key, both as PEM text.
struct Certificate {
  std::string certificate_pem;
  std::string key_pem;
};

enum class CertificateUse { kServer, kClient, kBoth };

struct CertificateTerms {
  std::string name;  // DNS name of its holder, as "slave.longreach"
  CertificateUse use = CertificateUse::kBoth;
  std::string not_before = "19700101000000Z";  // YYYYMMDDhhmmssZ
  std::string not_after = "99991231235959Z";
};

/// A new authority. Throws std::runtime_error when OpenSSL cannot.
Certificate make_authority(const std::string& name);

/// A new key, certified by the authority. Throws std::runtime_error when OpenSSL cannot.
Certificate issue(const Certificate& authority, const CertificateTerms& terms);

/// A new key, and the wish to have it certified by an authority elsewhere (PKCS #10), as PEM text.
struct CertificateRequest {
  std::string request_pem;
  std::string key_pem;
};
CertificateRequest make_request();

/// A certificate for the key of the request, whose holder must have signed it. The terms are ours: nothing
/// else is taken from the request. Throws std::runtime_error when it is not a signed request of a P-256 key.
std::string certify(const Certificate& authority, const std::string& request_pem,
                    const CertificateTerms& terms);

/// Whether a text can be read as what it should be: what a damaged file does not.
bool is_certificate(const std::string& certificate_pem);
bool is_key(const std::string& key_pem);
/// Whether the key is that of the certificate; both can be read.
bool belong_together(const Certificate& certificate);

/// "SHA256:5f0c...", as `openssl x509 -fingerprint -sha256` says it. Throws std::runtime_error when this is
/// no certificate.
std::string fingerprint(const std::string& certificate_pem);

/// "9999-12-31". Throws std::runtime_error when this is no certificate.
std::string valid_until(const std::string& certificate_pem);

/// What is wrong with a certificate in the hands of somebody who trusts the authority: one clause, as "it is
/// not signed by the authority". Empty: nothing. `key_pem`: empty, or the private key that must fit.
std::string certificate_trouble(const std::string& authority_pem, const std::string& certificate_pem,
                                const std::string& key_pem, const std::string& name);

}  // namespace longreach
