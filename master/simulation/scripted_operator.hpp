#pragma once
// A simulated operator that touches a surface. The operator moves in rate mode to the start distance or until
// a wall is displayed, approaches in scaled position mode, touches, retreats, touches again, presses, probes
// around the pressing force, releases, rests, and repeats from the second touch. At the edge of a small
// workspace, the operator uses the clutch to move the handle home. The behaviour is deterministic. The script
// uses only information that a person would have: the position of the hand, the contact force, and the
// displayed goal and registered surface. The results are not evidence about human operators.

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/time.hpp"
#include "master/devices/hand_target.hpp"
#include "schema/config_master.hpp"
#include "schema/state_link.hpp"

namespace longreach {

enum class ScriptPhase : std::uint8_t {
  kWaiting,
  kCoarse,
  kSettle,
  kApproach,
  kReact,
  kRetreat,
  kPause,
  kReturn,
  kPress,
  kProbe,
  kRelease,
  kRest
};
std::string_view to_string(ScriptPhase phase);

struct ScriptInput {
  Time now{};
  Vector3 handle_m = Vector3::Zero();
  double felt_n = 0.0;               // magnitude of the contact force on the hand
  Vector3 goal_m = Vector3::Zero();  // commanded goal relative to the anchor, W
  double scale = 1.0;
  bool engaged = false;
  std::uint32_t engagement = 0;  // goals restart at zero with each engagement
  bool surface_known = false;
  double depth_m = 0.0;     // depth of the handle behind the registered surface
  bool bring_home = false;  // rate mode has not begun to move the robot, because the handle is not home
};

struct ScriptOutput {
  HandTarget target{};
  std::optional<MotionMode> mode{};  // mode requested in this tick; none: no request
};

class ScriptedOperator {
 public:
  ScriptedOperator(const OperatorConfig& config, const MappingConfig& mapping, Grip grip);

  /// Advances to `input.now`. Returns the target of the hand and a requested mode.
  ScriptOutput step(const ScriptInput& input);

  [[nodiscard]] ScriptPhase phase() const { return phase_; }
  [[nodiscard]] int cycles() const { return cycles_; }  // number of completed touches with probing

 private:
  void enter(ScriptPhase phase, Time now);
  std::optional<MotionMode> decide(const ScriptInput& input);
  void move(const ScriptInput& input, double dt_s);
  bool relocates(const ScriptInput& input);
  [[nodiscard]] double left_m(const ScriptInput& input) const;
  [[nodiscard]] double coarse_deflection(double left_m) const;

  OperatorConfig config_;
  MappingConfig mapping_;
  Grip grip_;
  Vector3 direction_;       // direction of the approach in M
  Vector3 goal_direction_;  // the same direction in W
  double hand_stiffness_;   // N/m
  ScriptPhase phase_ = ScriptPhase::kWaiting;
  Time entered_{};
  Time now_{};
  bool started_ = false;
  double reach_m_ = 0.0;        // target of the hand along direction_
  double speed_m_per_s_ = 0.0;  // speed of that target
  double centre_m_ = 0.0;       // centre of rate mode along direction_
  double probe_centre_m_ = 0.0;
  // Distance covered in previous engagements and, so far, in this one.
  std::uint32_t engagement_ = 0;
  double covered_m_ = 0.0, goal_m_ = 0.0;
  int cycles_ = 0;
  bool relocating_ = false;  // the clutch is pressed to move the handle home
  /// Time since which the handle has not followed its target; while relocating_, the time since which the
  /// clutch has been pressed.
  Time blocked_{};
};

}  // namespace longreach
