#pragma once
// Certificates issued to hosts by pairing, and revoked ones: two append-only files of the site folder.
//
//   paired   host=NAME role=ROLE since=TIME expires=DATE fingerprint=SHA256:...
//   revoked  SHA256:... since=TIME
//
// A server refuses revoked certificates from the next call on (common/rpc/caller_certificate), and ends calls
// in progress. It checks the file in each call. Other hosts of the site have their own folders and are not
// notified.

#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

struct PairedCertificate {
  std::string host, role, since, expires, fingerprint;
  bool revoked = false;
};

/// Adds lines of `host`. Throws SiteError.
void record_pairing(const std::filesystem::path& site, const std::string& host, const std::string& master_pem,
                    const std::string& client_pem);
/// In the order of pairing. Throws SiteError.
std::vector<PairedCertificate> paired_certificates(const std::filesystem::path& site);
/// Revokes all certificates of these hosts, or those with these fingerprints, whether they are known here or
/// not. Returns the newly revoked fingerprints. Throws SiteError, also for an unknown name, and then nothing
/// is revoked.
std::vector<std::string> revoke(const std::filesystem::path& site, const std::vector<std::string>& names);

/// Makes the servers of this program refuse certificates that are revoked in this folder. Throws SiteError if
/// its list is damaged.
void refuse_revoked(const std::filesystem::path& site);
/// Checks a fingerprint; false if no folder was set.
bool is_revoked(const std::string& fingerprint);

}  // namespace longreach
