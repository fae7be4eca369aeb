#pragma once
// The site that the programs under test make and share: a folder of its own for each test program, not the
// user's.

#include "common/site/rpc_security.hpp"

namespace longreach {

/// Sets XDG_CONFIG_HOME, so that programs started later find the same site.
RpcSecurity test_site(RpcRole role);

}  // namespace longreach
