// This host joins another one's site.

#include <unistd.h>

#include <array>
#include <iostream>

#include "common/io/pairing_rpc.hpp"
#include "deploy/cli/commands.hpp"

namespace longreach {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

}  // namespace

ExitStatus run_pair(const Options& options, const PairCommand& command) {
  const auto token = PairingToken::parse(command.token);
  if (!token)
    throw UsageError(
        "the token is mistyped: it has 24 letters and digits, as longreach-slave --pair printed it");
  const std::filesystem::path site =
      options.site.empty() ? default_site() : std::filesystem::path(options.site);
  // Before the token is spent.
  if (site_exists(site) && !command.replace)
    throw PairingError("this host has a site at " + site.string() +
                       " already; put it aside with --replace, or choose another folder with --site DIR");
  const PairingRequest request(*token, host_name());
  if (!options.json) std::cerr << "asking " << options.slave_address << " ...\n";
  const auto answer = ask_to_join(options.slave_address, request, options.timeout_s);
  const std::filesystem::path aside = write_site(site, request.accept(answer));
  std::string done =
      "paired: " + site.string() + " belongs to the site of the slave at " + options.slave_address;
  if (!aside.empty()) done += "; what was there is in " + aside.string() + " now";
  print_done(options, done);
  if (!options.json) {
    const std::string host = options.slave_address.substr(0, options.slave_address.rfind(':'));
    std::cout << "Next, with the ports that the slave listens on:\n"
              << "  longreach --slave " << host << ":47020 status\n"
              << "  longreach-master --set link.slave=" << host << ":47001\n";
  }
  return ExitStatus::kDone;
}

}  // namespace longreach
