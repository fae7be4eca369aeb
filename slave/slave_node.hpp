#pragma once
// The slave without I/O: playout, limits, inverse kinematics, contact detection and identification, and its
// own safety state machine. step() has no side effects except on the state of the node; it does not allocate
// memory or throw exceptions.

#include <memory>
#include <span>

#include "common/link/envelope.hpp"
#include "schema/state_slave.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

/// What a tick of the node gets.
struct SlaveInput : SlaveTickInput {
  std::span<const Received<MotionCommand>> commands{};
};

class SlaveNode {
 public:
  explicit SlaveNode(const SlaveConfig& config);
  ~SlaveNode();

  SlaveOutput step(const SlaveInput& input);

  /// Changes the configuration from the next step on. Fields that can only be set at startup are ignored.
  void configure(const SlaveConfig& config);

  [[nodiscard]] const SlaveView& view() const;
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` follows the previous one by more than the gap timer. Datagrams that
  /// arrived in between are then too old.
  [[nodiscard]] bool stalled(Time now, double send_hz) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
