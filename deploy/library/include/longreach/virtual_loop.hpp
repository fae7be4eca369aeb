#pragma once
// Both sides of longreach and the link between them in virtual time: the control loops of longreach-master and
// longreach-slave, their datagrams, a simulated device, hand and robot. The same version, settings and seed give the same
// values. Frames: M base of the device, W world of the robot. Not faster or slower than the processor: a step is one period
// of both sides (1 ms unless loop.rate_hz is set). For one thread; several loops may run in several threads.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// As in `longreach status`.
enum class LoopPhase : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// State after a step.
struct LoopState {
  double time_s = 0.0;
  bool engaged = false;                                        // the robot follows the hand
  LoopPhase phase = LoopPhase::kIdle;                          // of the master
  Eigen::Vector3d handle_m = Eigen::Vector3d::Zero();          // from home, in M
  Eigen::Vector3d handle_force_n = Eigen::Vector3d::Zero();    // on the hand, in M
  Eigen::Vector3d handle_moment_nm = Eigen::Vector3d::Zero();  // likewise
  Eigen::Vector3d goal_m = Eigen::Vector3d::Zero();            // commanded displacement, in W
  Eigen::Isometry3d X_WE = Eigen::Isometry3d::Identity();      // measured tool
  Eigen::Vector3d tool_force_n = Eigen::Vector3d::Zero();      // measured, on the tool, in W
  bool in_contact = false;                                     // detected by the slave
  double estimated_stiffness_n_per_m = 0.0;                    // present estimate of the slave
  double estimated_stiffness_sd_n_per_m = 0.0;                 // its standard deviation
  double reported_stiffness_n_per_m = 0.0;                     // as the slave reports it
  double rendered_stiffness_n_per_m = 0.0;                     // as the master renders it
  double true_stiffness_n_per_m = 0.0;   // of the scene at the place of the reported one
  double port_energy_j = 0.0;            // net energy from the hand into the device
  std::optional<double> round_trip_s{};  // median, once known
};

/// Target of the simulated hand, relative to the home of the handle, in M.
struct LoopHand {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // rotation vector
  bool held = true;                                        // false: no hand is on the handle
};

class [[gnu::visibility("default")]] VirtualLoop {
 public:
  /// `settings`: texts PATH=VALUE as of `longreach-lab run --set`, e.g. "profile=moon", "robot_file=robots/ur5e.txtpb";
  /// proto/config.proto documents all fields. `files`: folder with links, robots and scenes; empty: $LONGREACH_HOME, else
  /// the installation of this library. A scripted operator touches the scene's wall unless drive() is called. Throws
  /// InputError that names the setting.
  explicit VirtualLoop(const std::vector<std::string>& settings = {}, std::uint64_t seed = 1,
                       const std::string& files = {});
  ~VirtualLoop();
  VirtualLoop(VirtualLoop &&) noexcept;
  VirtualLoop& operator=(VirtualLoop&&) noexcept;

  /// One period of both sides.
  void step();
  /// Steps until `seconds` of virtual time have passed. Throws InputError if they are not finite or below zero.
  void run(double seconds);
  [[nodiscard]] double period_s() const;
  [[nodiscard]] LoopState state() const;

  /// Moves the hand from now on, instead of the scripted operator. Throws InputError if a value is not finite.
  void drive(const LoopHand& hand);
  /// Requests for the next step, as keys of the operator.
  void engage();
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
