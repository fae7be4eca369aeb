#pragma once
// Version and commit of the build, for readers of a recording.

#include <string>
#include <string_view>

namespace longreach {

std::string_view build_version();
/// Commit, with "-dirty" if the tree differed.
std::string_view build_commit();
/// "longreach 0.1.0 abcdef012345"
std::string build_name();

}  // namespace longreach
