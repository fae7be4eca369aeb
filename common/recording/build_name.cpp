#include "common/recording/build_name.hpp"

#include "commit.hpp"

namespace longreach {

std::string_view build_version() { return LONGREACH_VERSION; }

std::string_view build_commit() { return kCommit; }

std::string build_name() { return "longreach " LONGREACH_VERSION " " + std::string(kCommit); }

}  // namespace longreach
