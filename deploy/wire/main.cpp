// longreach-wire: delays and drops whole IP packets between two hosts, that is, handshakes, segments and
// acknowledgements of TCP as well as datagrams. The packets come from the rule `-j NFQUEUE` in its own network
// namespace; with --relay, it is the cable between two namespaces. It shares no code with
// common/link/impairment, against which it serves as a check. Ends on SIGTERM, SIGINT or SIGHUP and prints its
// counts.
//
// Not supported: jitter, reordering, rate limits. A packet is delayed by at least the configured delay, plus
// any scheduling latency of this program. It therefore requests the same priority as the programs at its ends;
// otherwise, on a busy machine, packets could be late enough to trigger their timeouts. Packets in transit
// when it ends are lost.

#include <sched.h>

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "deploy/wire/packet_queue.hpp"
#include "deploy/wire/packet_relay.hpp"

namespace {

volatile std::sig_atomic_t ended = 0;
void end(int) { ended = 1; }

template <class Wire>
void serve(Wire wire) {
  std::puts("ready");
  std::fflush(stdout);
  while (ended == 0) wire->step();
  std::fprintf(stderr, "longreach-wire: packets=%llu dropped=%llu\n",
               static_cast<unsigned long long>(wire->packets()),
               static_cast<unsigned long long>(wire->dropped()));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Delays and drops packets between two hosts.", "longreach-wire"};
  longreach::WireConfig config;
  std::uint16_t queue = 0;
  std::vector<pid_t> hosts;
  app.add_option("--delay", config.delay_s, "delay of each packet, s")->check(CLI::Range(0.0, 100.0));
  app.add_option("--loss", config.loss, "fraction of packets to drop")->check(CLI::Range(0.0, 1.0));
  app.add_option("--seed", config.seed, "seed of the random selection of dropped packets");
  auto* number = app.add_option("--queue", queue, "queue number, as in iptables --queue-num");
  app.add_option("--relay", hosts,
                 "act as the cable between the network namespaces of two processes: PID "
                 "PID")
      ->expected(2)
      ->excludes(number);
  CLI11_PARSE(app, argc, argv);

  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
  const sched_param priority{.sched_priority = 50};
  sched_setscheduler(0, SCHED_FIFO, &priority);  // where the system permits it
  try {
    if (hosts.empty())
      serve(std::make_unique<longreach::PacketQueue>(config, queue));
    else
      serve(std::make_unique<longreach::PacketRelay>(config, std::array{hosts[0], hosts[1]}));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "longreach-wire: %s\n", e.what());
    return 1;
  }
  return 0;
}
