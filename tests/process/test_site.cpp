#include "tests/process/test_site.hpp"

#include <cstdlib>

#include "common/io/site.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace longreach {

RpcSecurity test_site(RpcRole role) {
  static const TemporaryFolder folder;
  ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
  return {site_credentials(default_site(), role)};
}

}  // namespace longreach
