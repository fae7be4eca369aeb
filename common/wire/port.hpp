#pragma once
// The shell between a node and a channel: impairment, header checks, session and replay, decoding, values; and the way
// back. Both programs and the laboratory use it, so the laboratory's bytes are real bytes.
//
// receive() drains the channel through the impairment; what was accepted stays available until the next receive().
// A rejected datagram changes nothing but its counter. Nothing allocates after construction.

#include <cstdint>
#include <span>
#include <vector>

#include "common/link/endpoint.hpp"
#include "common/link/impairment.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

/// What both sides' ports share.
class Port {
 public:
  Port(Channel& channel, std::uint64_t session, const ImpairmentConfig& impairment, Random random);
  virtual ~Port();

  void receive(Time now);

  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  [[nodiscard]] const RejectionCounts& rejected() const { return rejected_; }
  [[nodiscard]] std::uint64_t rejected_total() const;
  Impairment& impairment() { return impairment_; }

 protected:
  void send_bytes(Time now, DatagramType type, std::uint64_t sequence);   // encodes through the side's codec
  Channel& channel_;
  Endpoint endpoint_;
  Impairment impairment_;
  RejectionCounts rejected_{};
};

class MasterPort : public Port {
 public:
  using Port::Port;
  [[nodiscard]] std::span<const Received<StiffnessReport>> reports() const;
  [[nodiscard]] std::span<const Received<Telemetry>> telemetry() const;
  void send(Time now, std::uint64_t sequence, const MotionCommand& command);
};

class SlavePort : public Port {
 public:
  using Port::Port;
  [[nodiscard]] std::span<const Received<MotionCommand>> commands() const;
  void send(Time now, std::uint64_t sequence, const StiffnessReport& report);
  void send(Time now, std::uint64_t sequence, const Telemetry& telemetry);
};

}  // namespace longreach
