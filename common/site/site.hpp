#pragma once
// The site folder: who belongs together. It holds an authority and a certificate for each role, made at the
// first start of any program, so that on one host everything works with no extra step. Only its owner may
// open it (folder 0700, files 0600): whoever has it has the robot. A host that was paired (common/site/pairing)
// has the roles master and client of another host's site, and not its authority's key.

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/site/certificate.hpp"
#include "common/site/rpc_security.hpp"

namespace longreach {

/// One sentence that names the file and says what to do.
class SiteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was given as the folder is none of a site: a file, or a folder of something else.
class NoSiteError : public SiteError {
 public:
  using SiteError::SiteError;
};

/// $XDG_CONFIG_HOME/longreach, or ~/.config/longreach. Throws SiteError when neither is known.
std::filesystem::path default_site();

/// What the role shows to others and trusts, from the site folder; makes the folder first where there is
/// none. Two programs may do so at once: both end up with the same. Throws SiteError when others may open the
/// folder or a file, or when something in it is missing or damaged; NoSiteError when the folder is of
/// something else.
RpcCredentials site_credentials(const std::filesystem::path& site, RpcRole role);

/// The authority of the site with its key; makes the folder first where there is none. Throws SiteError,
/// also on a host that was paired: it has no such key.
Certificate site_authority(const std::filesystem::path& site);

using SiteFiles = std::map<std::string, std::string>;  // text by name

/// Whether something is there that write_site would have to put aside.
bool site_exists(const std::filesystem::path& site);
/// Makes the folder with these files, as a whole or not at all. What was there before is kept under another
/// name, which is returned; empty: nothing was. Throws SiteError.
std::filesystem::path write_site(const std::filesystem::path& site, const SiteFiles& files);

/// The file's text. Throws SiteError when others may open it or it cannot be read.
std::string read_site_file(const std::filesystem::path& file);
/// "slave" of "slave.longreach": its files are slave.crt and slave.key.
std::string file_stem(RpcRole role);

}  // namespace longreach
