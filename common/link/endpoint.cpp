#include "common/link/endpoint.hpp"

#include <limits>

#include "common/core/check.hpp"
#include "common/link/saturating.hpp"

namespace longreach {
namespace {

using std::chrono::seconds;

constexpr Duration kSessionSilence = seconds(1);
// Longer than the longest link that can be configured (100 s each way): whatever exceeds it is not a round
// trip.
constexpr Duration kRttMax = seconds(200);

constexpr std::optional<std::size_t> index_of(DatagramType type) {
  const auto i = static_cast<std::size_t>(type) - 1;
  return i < 3 ? std::optional(i) : std::nullopt;
}

std::optional<Duration> round_trip(Time now, Time echo_sent, Duration held) {
  const std::int64_t age = saturating_sub(to_ns(now), to_ns(echo_sent));
  const Duration rtt{saturating_sub(age, held.count())};
  // An age at the end of the range was cut: nothing can be subtracted from it.
  const bool cut = age == std::numeric_limits<std::int64_t>::max();
  const bool plausible = !cut && held >= Duration{0} && rtt >= Duration{0} && rtt <= kRttMax;
  return plausible ? std::optional(rtt) : std::nullopt;
}

}  // namespace

Endpoint::Endpoint(std::uint64_t session) : session_(session) { CHECK(session != 0); }

std::optional<Rejection> Endpoint::judge(Time now, const Header& header) const {
  if (!index_of(header.type)) return Rejection::kType;
  if (header.session == 0) return Rejection::kSession;
  if (header.session >= peer_session_) return std::nullopt;
  const bool silent = now - *monitor_.last_heard() >= kSessionSilence;
  return silent ? std::nullopt : std::optional(Rejection::kSession);
}

std::variant<Endpoint::Accepted, Rejection> Endpoint::commit(Time now, const Header& header,
                                                             const Stamp& stamp, std::size_t bytes) {
  if (const auto rejection = judge(now, header)) return *rejection;
  if (header.sequence == 0) return Rejection::kReplay;
  Accepted accepted;
  accepted.new_session = header.session != peer_session_;
  if (accepted.new_session) follow(header.session);

  ReplayWindow& window = windows_[*index_of(header.type)];
  accepted.newest = header.sequence > window.newest();
  if (!window.accept(header.sequence)) return Rejection::kReplay;

  std::optional<Duration> rtt;
  // Nobody can have heard what this side has yet to send, nor does a former self's clock count.
  if (stamp.echo.session == session_ && stamp.echo.sent_ns <= to_ns(now)) {
    accepted.echo_sent = Time{Duration{stamp.echo.sent_ns}};
    rtt = round_trip(now, *accepted.echo_sent, stamp.echo.held);
  }
  monitor_.on_datagram(now, header, stamp.sent, rtt, bytes);
  // Whichever came last, late or not: echoing only the newest would prefer the fast ones, and a jittery link
  // would look shorter than it is.
  heard_at_ = now;
  heard_sent_ = stamp.sent;
  return accepted;
}

void Endpoint::follow(std::uint64_t peer_session) {
  if (peer_session_ != 0) ++peer_restarts_;
  peer_session_ = peer_session;
  for (auto& window : windows_) window.clear();
  monitor_.clear();
}

Header Endpoint::header_for(DatagramType type, std::uint64_t sequence) const {
  return {.type = type, .session = session_, .sequence = sequence};
}

Stamp Endpoint::stamp_for(Time now) const {
  Stamp stamp{.sent = PeerTime{now.time_since_epoch()}};
  if (peer_session_ != 0) {
    stamp.echo = {.session = peer_session_, .sent_ns = to_ns(heard_sent_), .held = now - heard_at_};
  }
  return stamp;
}

}  // namespace longreach
