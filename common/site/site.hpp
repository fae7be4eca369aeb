#pragma once
// The site: a folder of certificates that defines which programs trust each other. It contains an authority
// and a certificate for each role. The first program that starts creates it, so that a single host needs no
// setup. Only its owner may access it (folder 0700, files 0600), because access to the folder permits control
// of the robot. A paired host (common/site/pairing) has the master and client roles in the site of another
// host, but not the key of that site's authority.

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/site/certificate.hpp"
#include "common/site/rpc_security.hpp"

namespace longreach {

/// Error whose message is one sentence that names the file and states a remedy.
class SiteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The given path is not a site, but a file or a folder with other content.
class NoSiteError : public SiteError {
 public:
  using SiteError::SiteError;
};

/// Returns $XDG_CONFIG_HOME/longreach, or ~/.config/longreach if the variable is not set. Throws SiteError if
/// neither is known.
std::filesystem::path default_site();

/// Returns the certificate and key of a role, and the certificate of the trusted authority. Creates the
/// folder if it does not exist; two programs that do this at the same time get the same site. Throws
/// SiteError if other users can access the folder or a file, or if a file is missing or damaged; throws
/// NoSiteError if the folder is not a site.
RpcCredentials site_credentials(const std::filesystem::path& site, RpcRole role);

/// Returns the authority of the site with its key. Creates the folder if it does not exist. Throws SiteError,
/// in particular on a paired host, which does not have this key.
Certificate site_authority(const std::filesystem::path& site);

using SiteFiles = std::map<std::string, std::string>;  // file name -> text

/// Returns whether there is a folder that write_site would rename.
bool site_exists(const std::filesystem::path& site);
/// Creates the folder with these files atomically. Renames an existing folder and returns its new name, or an
/// empty path if there was none. Throws SiteError.
std::filesystem::path write_site(const std::filesystem::path& site, const SiteFiles& files);

/// Returns the content of a file. Throws SiteError if the file cannot be read or other users can access it.
std::string read_site_file(const std::filesystem::path& file);
/// Returns the stem of the file names of a role, e.g. "slave" for slave.crt and slave.key.
std::string file_stem(RpcRole role);

}  // namespace longreach
