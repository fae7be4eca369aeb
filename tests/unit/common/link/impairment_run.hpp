#pragma once
// Sends numbered datagrams through an impairment in virtual time, and records what arrives and when.

#include <cstring>
#include <map>
#include <vector>

#include "common/link/impairment.hpp"

namespace longreach {

struct DatagramArrival {
  std::uint32_t number = 0;  // number of the datagram in the order of sending, from 0
  double sent_s = 0.0;
  double received_s = 0.0;
  std::size_t bytes = 0;
};

struct ImpairmentRun {
  ImpairmentConfig config{};
  std::uint64_t seed = 1;
  int datagrams = 20000;
  double period_s = 0.005;
  std::size_t bytes = 100;
  double tick_s = 0.001;
};

struct ImpairmentOutcome {
  std::vector<DatagramArrival> arrivals;
  std::map<std::uint32_t, int> copies;  // copies received, by datagram number
  ImpairmentCounts counts{};
};

inline ImpairmentOutcome run(const ImpairmentRun& r) {
  Impairment impairment(r.config, Random(r.seed));
  ImpairmentOutcome outcome;
  std::vector<std::byte> datagram(r.bytes);
  const double end_s = r.datagrams * r.period_s + 30.0;
  int next = 0;
  for (std::int64_t tick = 0; static_cast<double>(tick) * r.tick_s < end_s; ++tick) {
    const double now_s = static_cast<double>(tick) * r.tick_s;
    const Time now{from_seconds(now_s)};
    for (; next < r.datagrams && next * r.period_s <= now_s + 1e-12; ++next) {
      const auto number = static_cast<std::uint32_t>(next);
      std::memcpy(datagram.data(), &number, sizeof number);
      impairment.push(now, datagram);
    }
    while (const auto out = impairment.pop(now)) {
      DatagramArrival a;
      std::memcpy(&a.number, out->data(), sizeof a.number);
      a.sent_s = a.number * r.period_s;
      a.received_s = now_s;
      a.bytes = out->size();
      outcome.arrivals.push_back(a);
      ++outcome.copies[a.number];
    }
    if (next == r.datagrams && impairment.counts().out == impairment.counts().in &&
        now_s > r.datagrams * r.period_s)
      break;
  }
  outcome.counts = impairment.counts();
  return outcome;
}

}  // namespace longreach
