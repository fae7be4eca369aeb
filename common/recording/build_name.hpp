#pragma once
// What was built: version and commit, for whoever reads a recording later.

#include <string>
#include <string_view>

namespace longreach {

std::string_view build_version();
/// Commit, with "-dirty" if the tree differed.
std::string_view build_commit();
/// "longreach 0.1.0 abcdef012345"
std::string build_name();

}  // namespace longreach
