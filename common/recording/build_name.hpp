#pragma once
// Version and commit of the build, which recordings contain.

#include <string>
#include <string_view>

namespace longreach {

std::string_view build_version();
/// Returns the commit, with "-dirty" appended if the source tree contained uncommitted changes.
std::string_view build_commit();
/// Returns, for example, "longreach 0.1.0 abcdef012345".
std::string build_name();

}  // namespace longreach
