#pragma once
// Implements longreach-slave --pair, which prints a token and waits for a host to join the site with it. This
// is a separate process, which shares only the site folder with the slave and works whether or not the slave
// is running.

#include <atomic>
#include <filesystem>
#include <string>

namespace longreach {

/// Runs until a host is paired, the token becomes invalid or `stop` is set. Logs each attempt, but not the
/// token. Returns whether a host was paired. Throws SiteError, or std::runtime_error if it cannot listen.
bool run_pairing_desk(const std::filesystem::path& site, const std::string& listen,
                      const std::atomic<bool>& stop);

}  // namespace longreach
