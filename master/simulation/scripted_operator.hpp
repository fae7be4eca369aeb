#pragma once
// A simulated person who touches a surface: drives up in rate mode, until there or until a wall is felt,
// approaches in scaled position mode, touches, backs off, touches again, presses, probes about the pressing
// force, releases, rests, and begins again from the second touch; at the end of a small workspace brings the
// handle home with the clutch. Deterministic; knows only what a person
// would: the own hand, the felt contact force, the picture of the own commands (goal) and of the surface once
// it is registered. Never evidence about people.

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
  std::uint32_t engagement = 0;  // goals begin anew with each
  bool surface_known = false;
  double depth_m = 0.0;  // of the handle behind the registered surface
};

struct ScriptOutput {
  HandTarget target{};
  std::optional<MotionMode> mode{};  // asked for in this tick
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
  double reach_m_ = 0.0;        // hand's target along the direction
  double speed_m_per_s_ = 0.0;  // its speed
  double centre_m_ = 0.0;       // of rate mode
  double probe_centre_m_ = 0.0;
  // Covered in the engagements before, and so far in this one.
  std::uint32_t engagement_ = 0;
  double covered_m_ = 0.0, goal_m_ = 0.0;
  int cycles_ = 0;
  bool relocating_ = false;  // with the clutch
  Time blocked_{};           // since when the handle does not follow; relocating: since when
};

}  // namespace longreach
