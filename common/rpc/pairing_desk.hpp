#pragma once
// longreach-slave --pair: prints a token and waits for the host that joins the site with it. A program run of
// its own, beside the slave that drives the robot or without it; the site folder is all that they share.

#include <atomic>
#include <filesystem>
#include <string>

namespace longreach {

/// Until somebody is paired, the token is void, or `stop`. Each try is logged, the token is not. Returns
/// whether somebody was paired. Throws SiteError, or std::runtime_error when it cannot listen.
bool run_pairing_desk(const std::filesystem::path& site, const std::string& listen,
                      const std::atomic<bool>& stop);

}  // namespace longreach
