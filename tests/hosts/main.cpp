// longreach-wire: delays and drops what the rule `-j NFQUEUE` hands it in this network namespace: whole IP
// packets, so handshakes, segments and acknowledgements of TCP as well as datagrams. It shares no code with
// common/link/impairment, which it checks. Ends on SIGTERM or SIGINT and says what it did.
//
// Not here: jitter, reordering, rate. A packet waits at least the delay, and longer by as much as this
// program is scheduled late. What is on its way when it ends is lost.

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdint>
#include <cstdio>

#include "tests/hosts/packet_queue.hpp"

namespace {

volatile std::sig_atomic_t ended = 0;
void end(int) { ended = 1; }

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Delays and drops the packets that iptables -j NFQUEUE hands it.", "longreach-wire"};
  longreach::WireConfig config;
  app.add_option("--delay", config.delay_s, "how long each packet waits, s")->check(CLI::Range(0.0, 100.0));
  app.add_option("--loss", config.loss, "fraction that is dropped")->check(CLI::Range(0.0, 1.0));
  app.add_option("--seed", config.seed, "of the choice what is dropped");
  app.add_option("--queue", config.queue, "number of the queue, as in iptables --queue-num");
  CLI11_PARSE(app, argc, argv);

  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  try {
    longreach::PacketQueue queue(config);
    std::puts("ready");
    std::fflush(stdout);
    while (ended == 0) queue.step();
    std::fprintf(stderr, "longreach-wire: packets=%llu dropped=%llu\n",
                 static_cast<unsigned long long>(queue.packets()),
                 static_cast<unsigned long long>(queue.dropped()));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "longreach-wire: %s\n", e.what());
    return 1;
  }
  return 0;
}
