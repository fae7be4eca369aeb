#include "common/link/endpoint.hpp"

#include <limits>

#include "common/core/check.hpp"
#include "common/link/saturating.hpp"

namespace longreach {
namespace {

using std::chrono::seconds;

// Exceeds the round-trip time of every link that can be configured (100 s each way, a step of 100 s, jitter,
// a queue and the ticks of both sides). Larger values are not valid round-trip times.
constexpr Duration kRttMax = seconds(600);

constexpr std::size_t index_of(DatagramType type) { return static_cast<std::size_t>(type) - 1; }

Duration round_trip(Time now, Time echo_sent, Duration held) {
  const std::int64_t age = saturating_sub(to_ns(now), to_ns(echo_sent));
  const Duration rtt{saturating_sub(age, held.count())};
  // An age at the end of the range has saturated, so that no difference can be formed from it.
  const bool cut = age == std::numeric_limits<std::int64_t>::max();
  const bool plausible = !cut && held >= Duration{0} && rtt >= Duration{0} && rtt <= kRttMax;
  return plausible ? rtt : kNoRtt;
}

}  // namespace

void Endpoint::follow(std::uint64_t session) {
  CHECK(session != 0);
  leave();
  session_ = session;
  ++sessions_;
}

void Endpoint::leave() {
  session_ = 0;
  sent_.fill(0);
  for (auto& window : windows_) window.clear();
  monitor_.clear();
}

std::optional<Rejection> Endpoint::judge(const Header& header) const {
  if (index_of(header.type) >= kDatagramTypes) return Rejection::kType;
  if (session_ == 0 || header.session != session_) return Rejection::kSession;
  if (!windows_[index_of(header.type)].fresh(header.sequence)) return Rejection::kReplay;
  return std::nullopt;
}

bool Endpoint::mark(const Header& header) {
  ReplayWindow& window = windows_[index_of(header.type)];
  const bool newest = header.sequence > window.newest();
  CHECK(window.accept(header.sequence));
  return newest;
}

Duration Endpoint::learn(Time now, const Header& header, const Stamp& stamp, std::size_t bytes) {
  Duration rtt = kNoRtt;
  if (const auto echoed = echo_sent(now, stamp)) {
    rtt = round_trip(now, *echoed, stamp.echo->held);
    monitor_.on_echo(*echoed);
  }
  monitor_.on_datagram(now, header, stamp.sent, rtt, bytes);
  // The last datagram to arrive is echoed, whether late or not. Echoing only the newest would favour fast
  // datagrams, and a link with jitter would appear to have a shorter delay than it has.
  received_at_ = now;
  received_sent_ = stamp.sent;
  return rtt;
}

std::optional<Header> Endpoint::number(DatagramType type, std::uint64_t sequence) {
  std::uint64_t& sent = sent_[index_of(type)];
  if (session_ == 0 || sequence <= sent || sequence == std::numeric_limits<std::uint64_t>::max())
    return std::nullopt;
  sent = sequence;
  return Header{.type = type, .session = session_, .sequence = sequence};
}

Stamp Endpoint::stamp_for(Time now) const {
  Stamp stamp{.sent = PeerTime{now.time_since_epoch()}};
  if (monitor_.last_heard()) stamp.echo = Echo{.sent_ns = to_ns(received_sent_), .held = now - received_at_};
  return stamp;
}

}  // namespace longreach
