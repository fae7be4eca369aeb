#pragma once
// What was given to hosts by pairing, and what of it counts no more: two files of the site folder to which
// lines are only ever added.
//
//   paired   host=NAME role=ROLE since=TIME expires=DATE fingerprint=SHA256:...
//   revoked  SHA256:... since=TIME
//
// A server refuses revoked certificates from the next call on (common/rpc/caller_certificate), and ends what is
// under way. The file is looked at in each call. Does not handle: other hosts of the site, which have folders of
// their own.

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
/// not. Returns the fingerprints that are revoked now. Throws SiteError, and then nothing is revoked: a name
/// is unknown.
std::vector<std::string> revoke(const std::filesystem::path& site, const std::vector<std::string>& names);

/// The servers of this program refuse what is revoked in this folder. Throws SiteError when its list is
/// damaged.
void refuse_revoked(const std::filesystem::path& site);
/// By its fingerprint; false where no folder was named.
bool is_revoked(const std::string& fingerprint);

}  // namespace longreach
