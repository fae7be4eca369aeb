#include "tests/support/test_site.hpp"

#include <cstdlib>

#include "common/site/site.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach {

RpcSecurity test_site(RpcRole role) {
  static const TemporaryFolder folder;
  ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
  return {site_credentials(default_site(), role)};
}

}  // namespace longreach
