#include "common/rpc/pairing_desk.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <thread>
#include <vector>

#include "common/loop/real_time_loop.hpp"
#include "common/rpc/pairing_rpc.hpp"
#include "common/site/revocations.hpp"

namespace longreach {
namespace {

bool is_wildcard(const std::string& host) { return host == "0.0.0.0" || host == "[::]"; }

/// Where other hosts may find this one.
std::vector<std::string> own_addresses() {
  std::vector<std::string> out;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return out;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    if ((at->ifa_flags & IFF_UP) == 0 || (at->ifa_flags & IFF_LOOPBACK) != 0) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(at->ifa_addr);
    ::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    out.emplace_back(text.data());
  }
  ::freeifaddrs(first);
  return out;
}

void print_token(const std::string& token, const std::string& address) {
  const std::size_t colon = address.rfind(':');
  std::vector<std::string> hosts{address.substr(0, colon)};
  if (is_wildcard(hosts.front())) hosts = own_addresses();
  if (hosts.empty()) hosts.emplace_back("ADDRESS");
  std::printf(
      "Token: %s\n"
      "It can be used once, within 10 minutes; five attempts are allowed. On the joining host, run "
      "this command and enter the token when prompted:\n\n",
      token.c_str());
  for (const std::string& host : hosts)
    std::printf("  longreach pair --slave %s%s\n", host.c_str(), address.substr(colon).c_str());
  std::printf("\nWaiting; Ctrl-C invalidates the token.\n");
  std::fflush(stdout);
}

void report_try(const std::string& from, const std::string& refusal, const PairingOffer& offer) {
  const int tries = PairingOffer::kTries - offer.tries_left();
  if (refusal.empty()) {
    spdlog::info("pairing paired={} tries={} {}", from, tries, offer.paired());
  } else {
    spdlog::warn("pairing refused={} tries={} because=\"{}\"", from, tries, refusal);
    std::printf("refused %s: %s\n", from.c_str(), refusal.c_str());
  }
  std::fflush(stdout);
}

const char* ending(PairingOffer::State state) {
  switch (state) {
    case PairingOffer::State::kUsed:
      return "paired: that host can now run a master and a client of this site";
    case PairingOffer::State::kExpired:
      return "no host was paired: the token expired";
    case PairingOffer::State::kSpent:
      return "no host was paired: no attempts are left, and the token is now invalid";
    case PairingOffer::State::kOpen:
      break;
  }
  return "no host was paired: the program was stopped, and the token is now invalid";
}

}  // namespace

bool run_pairing_desk(const std::filesystem::path& site, const std::string& listen,
                      const std::atomic<bool>& stop) {
  const PairingToken token = PairingToken::draw();
  PairingOffer offer(token, site_authority(site), boottime_now(),
                     [&site](const std::string& host, const std::string& master, const std::string& client) {
                       record_pairing(site, host, master, client);
                     });
  PairingOffer::State state = PairingOffer::State::kOpen;
  {
    const PairingServer server(listen, offer, [&offer](const std::string& from, const std::string& refusal) {
      report_try(from, refusal, offer);
    });
    spdlog::info("pairing open={}", server.address());
    print_token(token.text(), server.address());
    while (!stop && (state = server.state()) == PairingOffer::State::kOpen)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  spdlog::info("pairing end=\"{}\"", ending(state));
  std::puts(ending(state));
  return state == PairingOffer::State::kUsed;
}

}  // namespace longreach
