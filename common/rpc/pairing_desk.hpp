#pragma once
// longreach-slave --pair: prints a token and waits for the host that joins the site with it. It is a separate
// run of the program, with or without a running slave; they share only the site folder.

#include <atomic>
#include <filesystem>
#include <string>

namespace longreach {

/// Runs until a host is paired, the token is invalid, or `stop`. Logs each attempt, but not the token.
/// Returns whether a host was paired. Throws SiteError, or std::runtime_error if it cannot listen.
bool run_pairing_desk(const std::filesystem::path& site, const std::string& listen,
                      const std::atomic<bool>& stop);

}  // namespace longreach
