#pragma once
// The site that the programs under test create and share: one folder for each test program, separate from the
// user's site.

#include "common/site/rpc_security.hpp"

namespace longreach {

/// Sets XDG_CONFIG_HOME, so that programs started later find the same site.
RpcSecurity test_site(RpcRole role);

}  // namespace longreach
