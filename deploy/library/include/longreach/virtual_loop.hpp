#pragma once
// Both sides of longreach and the link between them in virtual time: the control loops of longreach-master and
// longreach-slave, their datagrams, and a simulated device, hand and robot. The same version, settings and seed give
// the same values. Frames: M is the base of the device, W the world of the robot. A step is one period of both sides
// (1 ms unless loop.rate_hz is set) and runs as fast as the processor permits. Use each loop in one thread only.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// The state of a side, as shown by `longreach status`.
enum class LoopPhase : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// State after a step.
struct LoopState {
  double time_s = 0.0;
  bool engaged = false;                                        // the robot follows the hand
  LoopPhase phase = LoopPhase::kIdle;                          // phase of the master
  Eigen::Vector3d handle_m = Eigen::Vector3d::Zero();          // position relative to home, in M
  Eigen::Vector3d handle_force_n = Eigen::Vector3d::Zero();    // force on the hand, in M
  Eigen::Vector3d handle_moment_nm = Eigen::Vector3d::Zero();  // moment on the hand, in M
  Eigen::Vector3d goal_m = Eigen::Vector3d::Zero();            // commanded displacement of the tool, in W
  Eigen::Isometry3d X_WE = Eigen::Isometry3d::Identity();      // measured pose of the tool
  Eigen::Vector3d tool_force_n = Eigen::Vector3d::Zero();      // measured force on the tool, in W
  bool in_contact = false;                                     // contact detected by the slave
  double estimated_stiffness_n_per_m = 0.0;                    // current estimate of the slave
  double estimated_stiffness_sd_n_per_m = 0.0;                 // standard deviation of the estimate
  double reported_stiffness_n_per_m = 0.0;                     // stiffness reported by the slave
  double rendered_stiffness_n_per_m = 0.0;                     // stiffness rendered by the master
  double true_stiffness_n_per_m = 0.0;   // stiffness of the scene at the position of the rendered report
  double port_energy_j = 0.0;            // net energy from the hand into the device
  std::optional<double> round_trip_s{};  // median; std::nullopt until it is known
};

/// Target of the simulated hand, relative to the home of the handle, in M.
struct LoopHand {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // target as a rotation vector
  bool held = true;                                        // false: the hand has released the handle
};

class [[gnu::visibility("default")]] VirtualLoop {
 public:
  /// `settings` are PATH=VALUE strings as for `longreach-lab run --set`, e.g. "profile=moon",
  /// "robot_file=robots/ur5e.txtpb"; proto/config_*.proto document all fields. `files` is the folder with
  /// links, robots and scenes; empty: $LONGREACH_HOME or the installation of this library. A scripted
  /// operator touches the scene's wall unless drive() is called. Throws an InputError that names the setting.
  explicit VirtualLoop(const std::vector<std::string>& settings = {}, std::uint64_t seed = 1,
                       const std::string& files = {});
  ~VirtualLoop();
  VirtualLoop(VirtualLoop &&) noexcept;
  VirtualLoop& operator=(VirtualLoop&&) noexcept;

  /// Runs one period of both sides.
  void step();
  /// Runs steps until `seconds` of virtual time have passed. Throws InputError if `seconds` is not finite or
  /// is negative.
  void run(double seconds);
  [[nodiscard]] double period_s() const;
  [[nodiscard]] LoopState state() const;

  /// Sets the target of the hand. From now on, it replaces the scripted operator. Throws InputError if a
  /// value is not finite.
  void drive(const LoopHand& hand);
  /// Requests for the next step, as if made by the operator.
  void engage();
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
