#pragma once
// longreach's end of the exchange with an adapter during a check. It can also send invalid datagrams.

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "common/core/random.hpp"
#include "common/link/adapter_datagram.hpp"
#include "deploy/cli/adapter/adapter_socket.hpp"

namespace longreach {

/// Returns the reason why the bytes are not a valid datagram, or an empty string if they are valid.
template <class In>
std::string what_is_wrong(std::span<const std::byte> bytes, std::size_t size) {
  In in;
  if (size != sizeof in) return std::to_string(size) + " bytes instead of " + std::to_string(sizeof in);
  std::memcpy(&in, bytes.data(), sizeof in);
  const adapter::Header& h = in.header;
  if (std::memcmp(h.magic, adapter::Header{}.magic, sizeof h.magic) != 0) return "the magic is not LRAP";
  const auto says = [](const char* field, unsigned found, unsigned expected) {
    return std::string(field) + " " + std::to_string(found) + " instead of " + std::to_string(expected);
  };
  if (h.version != adapter::kVersion) return says("version", h.version, adapter::kVersion);
  if (h.kind != In::kKind) return says("kind", h.kind, In::kKind);
  if (h.size != sizeof in) return says("size", h.size, sizeof in);
  if (h.session == 0) return "the session is 0";
  if (!adapter::finite(in)) {
    if constexpr (std::is_same_v<In, adapter::BodiesDatagram>)
      if (in.count > adapter::kBodiesMost)
        return says("bodies:", in.count, adapter::kBodiesMost) + " at most";
    return "a value is not finite, or the quaternion does not have length 1";
  }
  return "";
}

/// Whether an adapter whose state is `In` may also send the poses of free bodies.
template <class In>
constexpr bool kTracksBodies = std::is_same_v<In, adapter::RobotDatagram>;

template <class Out, class In>
class Conversation {
 public:
  struct Seen {
    std::int64_t at_ns = 0;
    In in{};
    bool excused = false;  // this end was late, so the adapter's watchdog may have triggered
  };
  using Say = std::function<Out(double t_s)>;
  using Beside = std::function<void(const AdapterSocket&, const Out&)>;

  Conversation(const std::string& address, std::uint64_t seed, std::optional<uid_t> user = {})
      : socket_(address, user), random_(seed) {
    begin();
  }

  /// Starts a new session, as a restarted program would.
  void begin() {
    exchange_ = adapter::Exchange(random_.next() | 1U);
    sent_ = 0;
  }

  /// Sends the output of `say` every millisecond and then calls `beside`, which may send additional
  /// datagrams. If `say` is empty, sends nothing. Returns the valid datagrams of the state that were received.
  std::vector<Seen> talk(double seconds, const Say& say, const Beside& beside = {}) {
    constexpr std::int64_t kPeriod_ns = 1'000'000;
    std::vector<Seen> seen;
    headers_.clear();
    const std::int64_t begin_ns = AdapterSocket::now_ns();
    const auto end_ns = begin_ns + static_cast<std::int64_t>(1e9 * seconds);
    for (std::int64_t due_ns = begin_ns; due_ns < end_ns; due_ns += kPeriod_ns) {
      // Datagrams that are overdue are skipped, not sent in a burst.
      due_ns = std::max(due_ns, AdapterSocket::now_ns() - kPeriod_ns);
      if (say) {
        Out out = say(1e-9 * static_cast<double>(due_ns - begin_ns));
        exchange_.stamp(out);
        book_send(socket_.send(std::as_bytes(std::span(&out, 1))));
        ++sent_;
        if (beside) beside(socket_, out);
      }
      while (const auto arrival = socket_.receive(due_ns + kPeriod_ns)) {
        take(*arrival, say != nullptr, seen);
        if (arrival->at_ns > due_ns + kPeriod_ns) break;  // the adapter sends more than this end can process
      }
    }
    return seen;
  }

  [[nodiscard]] std::uint64_t sent() const { return sent_; }  // datagrams sent in this session
  [[nodiscard]] std::int64_t last_sent_ns() const { return sends_ns_.empty() ? 0 : sends_ns_.back(); }
  /// Number of invalid datagrams received, by reason.
  [[nodiscard]] const std::map<std::string, int>& wrong() const { return wrong_; }
  /// Headers of all valid datagrams that the last talk() received, in the order of arrival.
  [[nodiscard]] const std::vector<adapter::Header>& headers() const { return headers_; }
  /// The newest poses of free bodies; none if the adapter sends none.
  [[nodiscard]] const std::optional<adapter::BodiesDatagram>& bodies() const { return bodies_; }
  [[nodiscard]] const AdapterSocket& socket() const { return socket_; }
  Random& random() { return random_; }

 private:
  static constexpr std::int64_t kMemory_ns = 60'000'000, kLate_ns = 12'000'000;

  void book_send(std::int64_t at_ns) {
    sends_ns_.push_back(at_ns);
    while (sends_ns_.front() < at_ns - kMemory_ns) sends_ns_.pop_front();
  }

  /// True if this end paused for more than kLate_ns within the last kMemory_ns.
  [[nodiscard]] bool paused(std::int64_t at_ns) const {
    std::int64_t before_ns = 0;
    for (const std::int64_t send_ns : sends_ns_) {
      if (before_ns != 0 && send_ns - before_ns > kLate_ns) return true;
      before_ns = send_ns;
    }
    return sends_ns_.empty() || at_ns - sends_ns_.back() > kLate_ns;
  }

  static bool are_bodies(const AdapterSocket::Arrival& arrival) {
    adapter::Header header;
    if (!kTracksBodies<In> || arrival.size < sizeof header) return false;
    std::memcpy(&header, arrival.bytes.data(), sizeof header);
    return header.kind == adapter::kBodies;
  }

  void take(const AdapterSocket::Arrival& arrival, bool talking, std::vector<Seen>& seen) {
    const bool bodies = are_bodies(arrival);
    const std::string why = bodies ? what_is_wrong<adapter::BodiesDatagram>(arrival.bytes, arrival.size)
                                   : what_is_wrong<In>(arrival.bytes, arrival.size);
    if (!why.empty()) {
      ++wrong_[why];
      return;
    }
    adapter::Header header;
    std::memcpy(&header, arrival.bytes.data(), sizeof header);
    headers_.push_back(header);
    exchange_.accept(header, arrival.at_ns);
    if (bodies) {
      std::memcpy(&bodies_.emplace(), arrival.bytes.data(), sizeof(adapter::BodiesDatagram));
      return;
    }
    Seen one{arrival.at_ns, {}, talking && paused(arrival.at_ns)};
    std::memcpy(&one.in, arrival.bytes.data(), sizeof one.in);
    seen.push_back(one);
  }

  AdapterSocket socket_;
  Random random_;
  adapter::Exchange exchange_{1};
  std::uint64_t sent_ = 0;
  std::deque<std::int64_t> sends_ns_;
  std::map<std::string, int> wrong_;
  std::vector<adapter::Header> headers_;
  std::optional<adapter::BodiesDatagram> bodies_{};
};

}  // namespace longreach
