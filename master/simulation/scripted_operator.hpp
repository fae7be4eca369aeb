#pragma once
// A simulated operator who touches a surface: moves in rate mode to the start distance or until a wall is
// displayed, approaches in scaled position mode, touches, retreats, touches again, presses, probes about the
// pressing force, releases, rests, and repeats from the second touch; at the end of a small workspace the
// operator moves the handle home with the clutch. Deterministic; it uses only the information of a person:
// the own hand, the contact force, the display of the own commands (goal) and of the registered surface. It
// is not evidence about people.

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/time.hpp"
#include "common/link/motion_command.hpp"
#include "master/config/mapping_config.hpp"
#include "master/devices/hand_target.hpp"

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
  double felt_n = 0.0;               // contact force at the hand
  Vector3 goal_m = Vector3::Zero();  // own commands, from the anchor, W
  double scale = 1.0;
  bool engaged = false;
  std::uint32_t engagement = 0;  // goals restart with each engagement
  bool surface_known = false;
  double depth_m = 0.0;  // of the handle behind the registered surface
};

struct ScriptOutput {
  HandTarget target{};
  std::optional<MotionMode> mode{};  // requested in this tick
};

class ScriptedOperator {
 public:
  ScriptedOperator(const OperatorConfig& config, const MappingConfig& mapping, Grip grip);

  ScriptOutput step(const ScriptInput& input);

  [[nodiscard]] ScriptPhase phase() const { return phase_; }
  [[nodiscard]] int cycles() const { return cycles_; }  // completed touches with probing

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
  Vector3 direction_;       // in M
  Vector3 goal_direction_;  // the same in W
  double hand_stiffness_;   // N/m
  ScriptPhase phase_ = ScriptPhase::kWaiting;
  Time entered_{};
  Time now_{};
  bool started_ = false;
  double reach_m_ = 0.0;        // target of the hand along the direction
  double speed_m_per_s_ = 0.0;  // its speed
  double centre_m_ = 0.0;       // of rate mode
  double probe_centre_m_ = 0.0;
  // Distance covered in previous engagements, and so far in this one.
  std::uint32_t engagement_ = 0;
  double covered_m_ = 0.0, goal_m_ = 0.0;
  int cycles_ = 0;
  bool relocating_ = false;  // with the clutch
  Time blocked_{};           // time since which the handle does not follow; while relocating: start of it
};

}  // namespace longreach
