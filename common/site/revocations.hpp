#pragma once
// Certificates that were issued to hosts by pairing, and revoked certificates: two append-only files in the
// site folder.
//
//   paired   host=NAME role=ROLE since=TIME expires=DATE fingerprint=SHA256:...
//   revoked  SHA256:... since=TIME
//
// A server checks `revoked` on every call, so a revocation takes effect with the next call
// (common/rpc/caller_certificate); calls in progress are also ended. Other hosts of the site have their own
// folders and are not notified.

#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct PairedCertificate {
  std::string host, role, since, expires, fingerprint;
  bool revoked = false;
};

/// Adds the certificates that were issued to `host`. Throws SiteError.
void record_pairing(const std::filesystem::path& site, const std::string& host, const std::string& master_pem,
                    const std::string& client_pem);
/// Lists the certificates in the order of pairing. Throws SiteError.
std::vector<PairedCertificate> paired_certificates(const std::filesystem::path& site);
/// Revokes certificates. Each name is either a host, which stands for all its certificates, or a fingerprint,
/// which need not be known here. Returns the fingerprints. If a name is not valid, for example an unknown
/// host, throws SiteError and revokes nothing.
std::vector<std::string> revoke(const std::filesystem::path& site, const std::vector<std::string>& names);

/// Makes the servers of this program reject the certificates that are revoked in this folder. Throws
/// SiteError if the list of revoked certificates is damaged.
void refuse_revoked(const std::filesystem::path& site);
/// Returns whether a fingerprint is revoked; false if refuse_revoked() was not called.
bool is_revoked(const std::string& fingerprint);

}  // namespace longreach
