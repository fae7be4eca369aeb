#pragma once
// The certificate folder (site) that the programs under test create and share. Each test program has its own
// site, separate from the user's site.

#include "common/site/rpc_security.hpp"

namespace longreach {

/// Returns the credentials of a role at the test site. Sets XDG_CONFIG_HOME so that programs started later
/// use the same site.
RpcSecurity test_site(RpcRole role);

}  // namespace longreach
