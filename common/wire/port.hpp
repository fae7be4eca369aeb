#pragma once
// The shell between a node and a channel: impairment, header, session, replay, authentication, decoding,
// values; and the way back. Both programs and the laboratory use it, so the laboratory's bytes are real
// bytes.
//
// Without a session (`follow`) nothing leaves and nothing is accepted. receive() drains the channel through
// the impairment; what was accepted stays available until the next receive(). A datagram that is not
// authentic changes nothing but a counter; an authentic one uses up its number, whatever its values. Nothing
// allocates after construction. What lay in the socket while this side stood still (`stalled`) is too old to
// follow: it uses up its number, is counted as stalled and neither heard nor learnt from, but for a stop,
// which is obeyed however old it is. Bounded: at most kDatagramsPerReceive datagrams a call; of what was
// accepted the newest kInboxCapacity of a type.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/crypto/seal.hpp"
#include "common/link/byte_budget.hpp"
#include "common/link/endpoint.hpp"
#include "common/link/header.hpp"
#include "common/link/impairment.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "common/wire/channel.hpp"
#include "common/wire/codec.hpp"
#include "common/wire/inbox.hpp"

namespace longreach {

constexpr int kDatagramsPerReceive = 1024;
constexpr std::size_t kInboxCapacity = 256;

/// Which way datagrams of this type go; a side takes those that come its way.
constexpr Way way_of(DatagramType type) {
  return type == DatagramType::kMotionCommand ? Way::kToSlave : Way::kToMaster;
}

/// What both sides' ports share.
class Port {
 public:
  /// `channel` must outlive the port. `out`: the way that what it sends goes.
  Port(Channel& channel, const ImpairmentConfig& impairment, Random random, Way out);
  virtual ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Takes part in a session, not number zero, and in no other any more.
  void follow(const Session& session);
  /// Takes part in none.
  void leave();

  /// Most that leaves, kbit/s; 0: no limit. Whoever sends asks before whether it may.
  void limit(double kbit_per_s) { budget_.configure(kbit_per_s); }
  [[nodiscard]] bool may_send(Time now) const { return budget_.allows(now); }

  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  [[nodiscard]] const RejectionCounts& rejected() const { return rejected_; }
  [[nodiscard]] std::uint64_t rejected_total() const;
  /// Datagrams that passed every check.
  [[nodiscard]] std::uint64_t accepted_total() const { return accepted_; }
  Impairment& impairment() { return impairment_; }

 protected:
  /// Takes all that has come.
  void drain(Time now, bool stalled);
  /// An authentic datagram: header, body in clear, whether no newer one of its type came before.
  struct Opened {
    Header header{};
    std::span<const std::byte> body{};
    bool newest = false;
  };
  /// Decodes, books and keeps its message.
  virtual std::optional<Rejection> accept(Time now, const Opened& datagram) = 0;

  template <class Message>
  std::optional<Rejection> accept_into(Inbox<Received<Message>>& inbox, Time now, const Opened& datagram);
  template <class Message>
  std::size_t send_message(Time now, DatagramType type, std::uint64_t sequence, const Message& message);

 private:
  std::optional<Rejection> judge(Time now, std::span<const std::byte> datagram, const Origin& origin);
  void count(std::optional<Rejection> rejection);

  /// Keys of a session.
  struct Seals {
    Seals(const Session& session, Way way_out);
    Seal out;
    Seal in;
  };

  Channel& channel_;
  Way out_;
  Endpoint endpoint_;
  std::optional<Seals> seals_{};
  Impairment impairment_;
  Codec codec_;
  ByteBudget budget_;
  RejectionCounts rejected_{};
  std::uint64_t accepted_ = 0;
  std::array<std::byte, kDatagramMaxBytes> buffer_{};
  std::array<std::byte, kBodyMaxBytes> body_{};
  bool stalled_ = false;  // what this receive() takes lay there
  bool more_ = false;     // and it did not take all of that
};

class MasterPort : public Port {
 public:
  MasterPort(Channel& channel, const ImpairmentConfig& impairment, Random random)
      : Port(channel, impairment, random, Way::kToSlave) {}
  /// `stalled`: this side stood still since the last call.
  void receive(Time now, bool stalled = false);
  [[nodiscard]] std::span<const Received<StiffnessReport>> reports() const { return reports_.items(); }
  [[nodiscard]] std::span<const Received<Telemetry>> telemetry() const { return telemetry_.items(); }
  void send(Time now, std::uint64_t sequence, const MotionCommand& command);

 private:
  std::optional<Rejection> accept(Time now, const Opened& datagram) override;

  Inbox<Received<StiffnessReport>> reports_{kInboxCapacity};
  Inbox<Received<Telemetry>> telemetry_{kInboxCapacity};
};

class SlavePort : public Port {
 public:
  SlavePort(Channel& channel, const ImpairmentConfig& impairment, Random random)
      : Port(channel, impairment, random, Way::kToMaster) {}
  /// `stalled`: this side stood still since the last call.
  void receive(Time now, bool stalled = false);
  [[nodiscard]] std::span<const Received<MotionCommand>> commands() const { return commands_.items(); }
  /// Returns the size of the datagram, bytes; 0: none was sent.
  std::size_t send(Time now, std::uint64_t sequence, const StiffnessReport& report);
  void send(Time now, std::uint64_t sequence, const Telemetry& telemetry);

 private:
  std::optional<Rejection> accept(Time now, const Opened& datagram) override;

  Inbox<Received<MotionCommand>> commands_{kInboxCapacity};
};

}  // namespace longreach
