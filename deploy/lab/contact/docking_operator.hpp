#pragma once
// A simulated person who docks: approaches in rate mode, grasps in position mode, drags the load in rate
// mode, turns and pushes it in in position mode, and stops when the force that has risen vanishes; then opens
// the gripper and backs off. Knows what a person would: the own hand, the felt contact force, the ghost of
// the own commands, and a picture that comes late and is judged with an error. His hand goes at 10 to 30 mm/s
// and pauses at times; after each leg he waits a round trip and looks again (move and wait, Ferrell 1965).
// Never evidence about people.

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/random.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

enum class DockingMistake : std::uint8_t {
  kNone,
  kTilted,       // does not turn the target straight
  kMissesGuide,  // comes in beside the funnel
  kPushesOn      // does not stop when the catch has given way
};
constexpr int kDockingMistakes = 4;
std::string_view to_string(DockingMistake mistake);

enum class DockingPhase : std::uint8_t {
  kWait,
  kApproach,
  kReach,
  kGrasp,
  kDrag,
  kAlign,
  kInsert,
  kPress,
  kRelease,
  kRetreat,
  kDone
};

/// What is seen: places from where the tool started, turns from how things stood then.
struct DockingPicture {
  Pose tool{};
  Vector3 fixture_m = Vector3::Zero();   // where the gripper belongs
  Vector3 striker_m = Vector3::Zero();   // tip of the probe
  Vector3 turned_rad = Vector3::Zero();  // of the target
  bool load = false;
};

/// The way in, from where the tool started.
struct DockingGuide {
  Vector3 mouth_m = Vector3::Zero();  // the striker's place in front of the funnel
  double end_m = 0.0;                 // x of the striker's centre when it touches the catch
};

struct DockingOperatorInput {
  double t_s = 0.0;
  double dt_s = 0.001;
  const MasterView* master = nullptr;
  DockingPicture picture{};
  Vector3 ghost_m = Vector3::Zero();  // the goal, from where the tool started
  Vector3 ghost_rad = Vector3::Zero();
  double rtt_s = 0.0;
};

struct DockingOperatorOutput {
  HandTarget target{};
  OperatorRequests requests{};
};

class DockingOperator {
 public:
  DockingOperator(const MappingConfig& mapping, double rate_stiffness_n_per_m, const DockingGuide& guide,
                  DockingMistake mistake, Random random);

  DockingOperatorOutput step(const DockingOperatorInput& input);

  [[nodiscard]] DockingPhase phase() const { return phase_; }
  /// A force has risen and vanished, as felt.
  [[nodiscard]] bool felt_success() const { return felt_success_; }
  [[nodiscard]] int grasps() const { return grasps_; }  // attempts

 private:
  void enter(DockingPhase phase, const DockingOperatorInput& in);
  bool held(const DockingOperatorInput& in);
  bool rests(const DockingOperatorInput& in);
  void act(const DockingOperatorInput& in);
  void approach(const DockingOperatorInput& in);
  void reach(const DockingOperatorInput& in);
  void grasp(const DockingOperatorInput& in);
  void drag(const DockingOperatorInput& in);
  void align(const DockingOperatorInput& in);
  void insert(const DockingOperatorInput& in);
  void press(const DockingOperatorInput& in);
  void release(const DockingOperatorInput& in);
  void retreat(const DockingOperatorInput& in);
  /// Ghost to the target; true once it has been there for a moment.
  bool drive(const DockingOperatorInput& in, const Vector3& target_m, double speed_m_per_s);
  bool carry(const DockingOperatorInput& in, const Vector3& target_m, double speed_m_per_s);
  void turn(const DockingOperatorInput& in, const Vector3& target_rad);
  bool relocate(const DockingOperatorInput& in, const Vector3& to_m);
  void choose(const DockingOperatorInput& in, MotionMode mode);
  /// True a round trip and a moment after the first call since the phase or the last look began.
  bool looked(const DockingOperatorInput& in);
  [[nodiscard]] Vector3 striker_from_tool(const DockingOperatorInput& in) const;

  MappingConfig mapping_;
  double rate_stiffness_;
  DockingGuide guide_;
  DockingMistake mistake_;
  Vector3 misjudged_m_;  // error of the eye
  Vector3 misjudged_rad_;
  double reaction_s_, speed_m_per_s_;
  Random random_{0};
  double rest_ends_s_ = 0.0;
  DockingPhase phase_ = DockingPhase::kWait;
  double entered_s_ = 0.0;
  std::optional<double> there_s_{}, look_s_{}, relocating_s_{}, held_s_{};
  std::optional<Vector3> relocate_to_{};
  MotionMode mode_ = MotionMode::kPosition;
  bool closed_ = false, asked_ = false;  // the gripper, as he wants it and has asked for
  Vector3 hand_m_ = Vector3::Zero(), hand_rad_ = Vector3::Zero();  // where he wants the handle
  Vector3 centre_m_ = Vector3::Zero();                             // of rate mode
  Vector3 aim_m_ = Vector3::Zero(), aim_rad_ = Vector3::Zero();
  int rounds_ = 0, grasps_ = 0;
  double felt_peak_n_ = 0.0;
  std::optional<double> vanished_s_{}, felt_s_{};
  bool felt_success_ = false;
  DockingOperatorOutput out_{};
};

}  // namespace longreach
