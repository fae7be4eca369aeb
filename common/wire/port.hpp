#pragma once
// Connects a node to a channel. Received datagrams pass through the artificial impairment, the checks of
// header, session, replay and authentication, decoding and value checks; sent messages are encoded and
// encrypted. The programs and the laboratory use the same code, so they exchange the same bytes.
//
// Without a session (`follow`), no datagram is sent or accepted. Accepted messages stay available until the
// next receive(). A datagram that is not authentic only changes a counter. The sequence number of an authentic
// datagram is used up, even if its values are invalid. No memory is allocated after construction. Datagrams
// that arrived while this side was stalled (`stalled`) are too old to follow: their sequence numbers are used
// up, they are counted as stalled, and of their content only a stop takes effect. Each receive() reads at most
// kDatagramsPerReceive datagrams and keeps the newest kInboxCapacity accepted messages of each type.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/crypto/seal.hpp"
#include "common/link/body_poses.hpp"
#include "common/link/byte_budget.hpp"
#include "common/link/endpoint.hpp"
#include "common/link/header.hpp"
#include "common/link/impairment.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/wire/channel.hpp"
#include "common/wire/codec.hpp"
#include "common/wire/inbox.hpp"
#include "schema/state_link.hpp"

namespace longreach {

constexpr int kDatagramsPerReceive = 1024;
constexpr std::size_t kInboxCapacity = 256;

/// Returns the direction of datagrams of this type. A side accepts only datagrams of its incoming direction.
constexpr Way way_of(DatagramType type) {
  return type == DatagramType::kMotionCommand ? Way::kToSlave : Way::kToMaster;
}

/// The part that the ports of both sides have in common.
class Port {
 public:
  /// `channel` must outlive the port. `out` is the direction of the sent datagrams.
  Port(Channel& channel, const ImpairmentConfig& impairment, Random random, Way out);
  virtual ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Leaves the previous session, if any, and joins `session`, which must have a non-zero number.
  void follow(const Session& session);
  /// Leaves the session.
  void leave();

  /// Sets the maximum send rate, kbit/s; 0 means unlimited. The caller must check may_send() before sending.
  void limit(double kbit_per_s) { budget_.configure(kbit_per_s); }
  [[nodiscard]] bool may_send(Time now) const { return budget_.allows(now); }

  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  [[nodiscard]] const RejectionCounts& rejected() const { return rejected_; }
  [[nodiscard]] std::uint64_t rejected_total() const;
  /// Returns the number of datagrams that passed every check.
  [[nodiscard]] std::uint64_t accepted_total() const { return accepted_; }
  Impairment& impairment() { return impairment_; }
  [[nodiscard]] const Channel& channel() const { return channel_; }

 protected:
  /// Receives all pending datagrams.
  void drain(Time now, bool stalled);
  /// An authentic datagram: header, decrypted body, and whether it is the newest of its type so far.
  struct Opened {
    Header header{};
    std::span<const std::byte> body{};
    bool newest = false;
  };
  /// Decodes and stores the message of an authentic datagram.
  virtual std::optional<Rejection> accept(Time now, const Opened& datagram) = 0;

  template <class Message>
  std::optional<Rejection> accept_into(Inbox<Received<Message>>& inbox, Time now, const Opened& datagram);
  /// `budget`: pays for the datagram instead of the budget of the port.
  template <class Message>
  std::size_t send_message(Time now, DatagramType type, std::uint64_t sequence, const Message& message,
                           ByteBudget* budget = nullptr);

 private:
  std::optional<Rejection> judge(Time now, std::span<const std::byte> datagram, const Origin& origin);
  void count(std::optional<Rejection> rejection);

  /// The keys of both directions of a session.
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
  bool stalled_ = false;  // the datagrams of this receive() arrived during a stall
  bool more_ = false;     // the last receive() left some datagrams unread
};

class MasterPort : public Port {
 public:
  MasterPort(Channel& channel, const ImpairmentConfig& impairment, Random random)
      : Port(channel, impairment, random, Way::kToSlave) {}
  /// `stalled`: this side has stalled since the last call.
  void receive(Time now, bool stalled = false);
  [[nodiscard]] std::span<const Received<StiffnessReport>> reports() const { return reports_.items(); }
  [[nodiscard]] std::span<const Received<Telemetry>> telemetry() const { return telemetry_.items(); }
  [[nodiscard]] std::span<const Received<BodyPoses>> bodies() const { return bodies_.items(); }
  void send(Time now, std::uint64_t sequence, const MotionCommand& command);

 private:
  std::optional<Rejection> accept(Time now, const Opened& datagram) override;

  Inbox<Received<StiffnessReport>> reports_{kInboxCapacity};
  Inbox<Received<Telemetry>> telemetry_{kInboxCapacity};
  Inbox<Received<BodyPoses>> bodies_{kInboxCapacity};
};

class SlavePort : public Port {
 public:
  SlavePort(Channel& channel, const ImpairmentConfig& impairment, Random random)
      : Port(channel, impairment, random, Way::kToMaster) {}
  /// `stalled`: this side has stalled since the last call.
  void receive(Time now, bool stalled = false);
  [[nodiscard]] std::span<const Received<MotionCommand>> commands() const { return commands_.items(); }
  // Return the size of the sent datagram in bytes, or 0 if none was sent.
  std::size_t send(Time now, std::uint64_t sequence, const StiffnessReport& report);
  std::size_t send(Time now, std::uint64_t sequence, const Telemetry& telemetry);
  std::size_t send(Time now, std::uint64_t sequence, const BodyPoses& bodies);
  /// The poses of bodies have a budget of their own, so that they do not use up that of the reports; kbit/s, 0 means
  /// unlimited.
  void limit_bodies(double kbit_per_s) { bodies_budget_.configure(kbit_per_s); }
  [[nodiscard]] bool may_send_bodies(Time now) const { return bodies_budget_.allows(now); }

 private:
  std::optional<Rejection> accept(Time now, const Opened& datagram) override;

  Inbox<Received<MotionCommand>> commands_{kInboxCapacity};
  ByteBudget bodies_budget_;
};

}  // namespace longreach
