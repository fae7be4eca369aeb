#pragma once
// The site: a folder of certificates that defines which programs trust each other. It contains an authority
// and a certificate for each role, created at the first start of any program, so that a single host needs no
// setup. Only its owner may access it (folder 0700, files 0600): access to the folder permits control of the
// robot. A paired host (common/site/pairing) has the roles master and client of another host's site, but not
// the key of its authority.

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/site/certificate.hpp"
#include "common/site/rpc_security.hpp"

namespace longreach {

/// One sentence that names the file and a remedy.
class SiteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The given folder is not a site: it is a file, or a folder with other content.
class NoSiteError : public SiteError {
 public:
  using SiteError::SiteError;
};

/// Returns $XDG_CONFIG_HOME/longreach, or ~/.config/longreach. Throws SiteError if neither is known.
std::filesystem::path default_site();

/// Returns the certificates of a role and its trusted authority; creates the folder if it does not exist. Two
/// programs may do so at once and get the same result. Throws SiteError if other users can access the folder
/// or a file, or if a file is missing or damaged; NoSiteError if the folder is not a site.
RpcCredentials site_credentials(const std::filesystem::path& site, RpcRole role);

/// Returns the authority of the site with its key; creates the folder if it does not exist. Throws SiteError,
/// also on a paired host, which does not have the key.
Certificate site_authority(const std::filesystem::path& site);

using SiteFiles = std::map<std::string, std::string>;  // text by name

/// Returns whether there is a folder that write_site would have to move away.
bool site_exists(const std::filesystem::path& site);
/// Creates the folder with these files atomically. A previous folder is renamed; returns its new name; empty:
/// there was none. Throws SiteError.
std::filesystem::path write_site(const std::filesystem::path& site, const SiteFiles& files);

/// Returns the text of a file. Throws SiteError if other users can access it or it cannot be read.
std::string read_site_file(const std::filesystem::path& file);
/// "slave" for "slave.longreach": its files are slave.crt and slave.key.
std::string file_stem(RpcRole role);

}  // namespace longreach
