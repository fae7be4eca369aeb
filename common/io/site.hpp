#pragma once
// The site folder: who belongs together. It holds an authority and a certificate for each role, made at the
// first start of any program, so that on one host everything works with no extra step. Only its owner may
// open it (folder 0700, files 0600): whoever has it has the robot.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/io/rpc_security.hpp"

namespace longreach {

/// One sentence that names the file and says what to do.
class SiteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// $XDG_CONFIG_HOME/longreach, or ~/.config/longreach. Throws SiteError when neither is known.
std::filesystem::path default_site();

/// What the role shows to others and trusts, from the site folder; makes the folder first where there is
/// none. Two programs may do so at once: both end up with the same. Throws SiteError when others may open the
/// folder or a file, or when something in it is missing or cannot be read.
RpcCredentials site_credentials(const std::filesystem::path& site, RpcRole role);

}  // namespace longreach
