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

}  // namespace longreach
