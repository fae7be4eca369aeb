#pragma once
// A simulated robot behind an adapter socket, which records the setpoints that it receives. Its six joints
// follow live setpoints in free space through servos with a bandwidth of 10 Hz, as in
// deploy/robots/cartesian.txtpb. It runs in a thread of the test.

#include <array>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "common/core/random.hpp"
#include "common/link/adapter_datagram.hpp"
#include "tests/process/adapter_listener.hpp"

namespace longreach {

/// Faults of the force sensor.
enum class SensorFlaw { kNone, kSign, kBase, kExchanged, kWeight, kDead, kZero, kNoMoment, kFrozen };

/// A received setpoint.
struct ReportedSetpoint {
  std::uint64_t sequence = 0;
  bool live = false;
  std::array<double, 3> joint{};
  double off = 0.0;  // largest difference between the setpoint and the position of a joint
};

class RobotBox {
 public:
  RobotBox() : thread_([this] { run(); }) {}
  ~RobotBox() {
    ended_ = true;
    thread_.join();
  }
  RobotBox(const RobotBox&) = delete;
  RobotBox& operator=(const RobotBox&) = delete;

  [[nodiscard]] std::string address() const { return listener_.address(); }
  /// Numbers of datagrams received so far: all datagrams, and those that command a motion.
  [[nodiscard]] std::uint64_t reported() const { return reported_; }
  [[nodiscard]] std::uint64_t live() const { return live_; }
  [[nodiscard]] double joint(int i) {
    const std::lock_guard lock(mutex_);
    return joint_[static_cast<std::size_t>(i)];
  }
  /// Largest step between consecutive live setpoints, and largest step from the joint positions to the first
  /// live setpoint.
  [[nodiscard]] double step() {
    const std::lock_guard lock(mutex_);
    return step_;
  }
  [[nodiscard]] double first_step() {
    const std::lock_guard lock(mutex_);
    return first_step_;
  }
  /// All setpoints received so far.
  [[nodiscard]] std::vector<ReportedSetpoint> setpoints() {
    const std::lock_guard lock(mutex_);
    return setpoints_;
  }
  /// Adds a wall with a stiffness of 1 N/mm in the path of the third joint.
  void wall(double at_m) { wall_m_ = at_m; }
  /// Applies a force (N) and a moment (N m) to the tool, in W.
  void push_tool(std::array<double, 3> force_n, std::array<double, 3> moment_nm) {
    const std::lock_guard lock(mutex_);
    force_n_ = force_n;
    moment_nm_ = moment_nm;
  }
  /// Sets the fault of the force sensor.
  void set_flaw(SensorFlaw flaw) {
    const std::lock_guard lock(mutex_);
    flaw_ = flaw;
  }
  /// Moves the third joint at this speed from now on.
  void push(double m_per_s) { pushed_m_per_s_ = m_per_s; }
  /// Reports a failure, as during a protective stop, from now on.
  void fail(bool fails) { fails_ = fails; }
  /// Adds this error to the reported position of the third joint from now on.
  void sensor_fault(double m) { fault_m_ = m; }

 private:
  void run();
  void take(const adapter::SetpointDatagram& in);
  [[nodiscard]] adapter::RobotDatagram move(double dt);
  void apply(const std::array<double, 3>& felt, double weight, double (&reported)[3]) const;
  void sense(adapter::RobotDatagram& out);

  AdapterListener listener_;
  std::atomic<std::uint64_t> reported_{0}, live_{0};
  std::atomic<double> pushed_m_per_s_{0.0}, fault_m_{0.0}, wall_m_{1e9};
  std::mutex mutex_;
  std::array<double, adapter::kJoints> joint_{}, setpoint_{};
  std::vector<ReportedSetpoint> setpoints_;
  double step_ = 0.0, first_step_ = 0.0;
  bool follows_ = false;
  std::array<double, 3> force_n_{}, moment_nm_{};
  SensorFlaw flaw_ = SensorFlaw::kNone;
  Random random_{5};
  adapter::RobotDatagram sensed_{};  // last reading
  std::atomic<bool> ended_{false}, fails_{false};
  std::thread thread_;
};

}  // namespace longreach
