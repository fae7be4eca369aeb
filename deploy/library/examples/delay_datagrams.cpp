// Sends 100 datagrams a second for 60 s over the link to the Moon with 5 % loss, and measures delay and loss.
#include <array>
#include <cstdio>
#include <longreach/link.hpp>

int main() {
  longreach::LinkPair conditions = longreach::link_conditions("moon");
  conditions.up.loss = 0.05;
  longreach::SimulatedLink link(conditions, 1);
  double delay_sum_s = 0.0;
  int received = 0;
  for (int tick = 0; tick < 64000; ++tick) {
    const double now_s = 1e-3 * tick;
    const std::array<std::byte, 2> number{std::byte(tick / 10 / 256), std::byte(tick / 10 % 256)};
    if (tick % 10 == 0 && tick < 60000) link.send(longreach::LinkEnd::kMaster, now_s, number);
    while (const auto datagram = link.receive(longreach::LinkEnd::kSlave, now_s)) {
      const int sent = 256 * int((*datagram)[0]) + int((*datagram)[1]);
      delay_sum_s += now_s - 1e-2 * sent;
      ++received;
    }
  }
  std::printf("mean delay %.3f s\n", delay_sum_s / received);
  std::printf("lost %.1f %%\n", 100.0 - received / 60.0);
  std::printf("counted %d\n", int(link.counts(longreach::LinkEnd::kSlave).sent));
}
