#pragma once
// A simulated operator who docks a target. The operator approaches in rate mode, grasps in position mode,
// drags the load in rate mode, and turns and inserts it in position mode. When the contact force rises and
// then vanishes, the operator stops pushing, opens the gripper and retreats. The operator uses only
// information that a person would have: the position of the hand, the displayed contact force, the ghost (the
// display of the commanded pose), and the picture of the page, which draws the poses that the slave sent, read with an
// error. The hand moves at 10 to 30 mm/s with occasional pauses, in which the operator still feels the force. After each
// segment the operator waits for a round trip and checks the result (move and wait, Ferrell 1965). The model has not been
// validated with human operators.

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/random.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

enum class DockingMistake : std::uint8_t {
  kNone,
  kTilted,       // does not align the target before inserting
  kMissesGuide,  // pushes next to the funnel instead of into it
  kPushesOn      // keeps pushing after the latch has yielded
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

/// The scene as shown by the picture. Positions are relative to the start position of the tool, and rotations
/// are relative to the initial orientation.
struct DockingPicture {
  Pose tool{};
  Vector3 fixture_m = Vector3::Zero();   // where the gripper must grasp the target
  Vector3 striker_m = Vector3::Zero();   // tip of the probe
  Vector3 turned_rad = Vector3::Zero();  // rotation of the target
  bool load = false;
};

/// The insertion path, relative to the start position of the tool.
struct DockingGuide {
  Vector3 mouth_m = Vector3::Zero();  // position of the striker in front of the funnel
  double end_m = 0.0;                 // x of the centre of the striker when it touches the latch
};

struct DockingOperatorInput {
  double t_s = 0.0;
  double dt_s = 0.001;
  const MasterView* master = nullptr;
  DockingPicture picture{};
  Vector3 ghost_m = Vector3::Zero();  // goal relative to the start pose of the tool
  Vector3 ghost_rad = Vector3::Zero();
  double rtt_s = 0.0;
};

struct DockingOperatorOutput {
  HandTarget target{};
  OperatorRequests requests{};
};

class DockingOperator {
 public:
  DockingOperator(const MappingConfig& mapping, const RenderingConfig& rendering, const DockingGuide& guide,
                  DockingMistake mistake, Random random);

  DockingOperatorOutput step(const DockingOperatorInput& input);

  [[nodiscard]] DockingPhase phase() const { return phase_; }
  /// True once the displayed force has risen and vanished.
  [[nodiscard]] bool felt_success() const { return felt_success_; }
  [[nodiscard]] int grasps() const { return grasps_; }  // number of attempts

 private:
  void enter(DockingPhase phase, const DockingOperatorInput& in);
  bool held(const DockingOperatorInput& in);
  bool rests(const DockingOperatorInput& in);
  bool judge(const DockingOperatorInput& in);
  void judge_insertion(const DockingOperatorInput& in);
  void judge_press(const DockingOperatorInput& in);
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
  /// Moves the ghost towards the target in rate mode. Returns true once the ghost has stayed at the target
  /// for a moment.
  bool drive(const DockingOperatorInput& in, const Vector3& target_m, double speed_m_per_s);
  bool carry(const DockingOperatorInput& in, const Vector3& target_m, double speed_m_per_s);
  void turn(const DockingOperatorInput& in, const Vector3& target_rad);
  bool relocate(const DockingOperatorInput& in, const Vector3& to_m);
  void choose(const DockingOperatorInput& in, MotionMode mode);
  /// Returns true once a round trip plus a reaction time has passed since the first call of this function in
  /// the phase, or since the picture was last checked.
  bool looked(const DockingOperatorInput& in);
  [[nodiscard]] Vector3 striker_from_tool(const DockingOperatorInput& in) const;

  MappingConfig mapping_;
  double rate_stiffness_;
  double ke_;  // displayed fraction of the slave's force
  DockingGuide guide_;
  DockingMistake mistake_;
  Vector3 misjudged_m_;  // error made in reading the picture
  Vector3 misjudged_rad_;
  double reaction_s_, speed_m_per_s_;
  Random random_{0};
  double rest_ends_s_ = 0.0;
  DockingPhase phase_ = DockingPhase::kWait;
  double entered_s_ = 0.0;
  std::optional<double> there_s_{}, look_s_{}, relocating_s_{}, held_s_{};
  std::optional<Vector3> relocate_to_{};
  MotionMode mode_ = MotionMode::kPosition;
  bool closed_ = false, asked_ = false;  // desired and requested state of the gripper
  Vector3 hand_m_ = Vector3::Zero(), hand_rad_ = Vector3::Zero();  // target of the handle
  Vector3 centre_m_ = Vector3::Zero();                             // centre of the handle in rate mode
  Vector3 aim_m_ = Vector3::Zero(), aim_rad_ = Vector3::Zero();
  int rounds_ = 0, grasps_ = 0;
  double felt_peak_n_ = 0.0;
  std::optional<double> vanished_s_{}, felt_s_{};
  bool felt_success_ = false;
  DockingOperatorOutput out_{};
};

}  // namespace longreach
