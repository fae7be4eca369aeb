#pragma once
// Simulates a person with a compliant hand who moves, presses, rests and retreats over one link. The results
// are evaluated against the true surfaces of the scene: whether the goal is in front of all of them, how far
// the goal leads the tool, and the force on the hand.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/fault_hooks.hpp"
#include "deploy/lab/laboratory.hpp"
#include "schema/config_scene.hpp"

namespace longreach {

/// One action of the person: a straight motion to a position, followed by a wait.
struct PersonMove {
  Vector3 to_m = Vector3::Zero();  // target of the hand relative to home, M
  double speed_m_per_s = 0.02;
  double wait_s = 1.0;
  double wait_rtt = 1.0;  // additional wait in round trips
  /// Rotation vector that the hand reaches during the motion, M, at 0.1 rad/s.
  Vector3 turn_rad = Vector3::Zero();
  bool clutch = false;
  std::optional<MotionMode> mode{};
  bool stop = false, hold = false, engage = false, let_go = false;
  std::optional<double> scale{};
  std::optional<bool> load{};
  /// Duration of a total loss of datagrams in both directions, from the start of the move.
  double blackout_s = 0.0;
  std::function<void(MasterConfig&)> change{};
};

struct PersonScenario {
  MasterConfig master{};
  SlaveConfig slave{};
  Grip grip = Grip::kLight;
  double rtt_s = 0.0;
  std::uint64_t seed = 1;
  /// Control: as in an earlier version, the reports contain neither the position of the tool nor the direction in which
  /// its motion is blocked.
  bool blind = false;
  FaultHooks* hooks = nullptr;  // additional hooks, unless `blind` is set; may be null, not owned
  std::vector<PersonMove> moves;
  /// Returns the depth of a position behind the true surfaces, m (the maximum over the surfaces; negative: in
  /// front of all of them). The position is relative to the anchor.
  std::function<double(const Vector3&)> depth_m = [](const Vector3&) { return -1.0; };
};

/// Values observed during one move, including its wait.
struct MoveSeen {
  Vector3 goal_m = Vector3::Zero(), tool_m = Vector3::Zero();  // at the end, relative to the anchor
  Vector3 tool_least_m = Vector3::Zero(), tool_most_m = Vector3::Zero();
  [[nodiscard]] double tool_span_m() const { return (tool_most_m - tool_least_m).norm(); }
  Vector3 hand_m = Vector3::Zero();  // true position at the end
  double hand_n = 0.0;               // total rendered force at the end
  Vector3 felt = Vector3::Zero();    // contact force on the hand at the end, M, N
  double felt_n = 0.0;               // magnitude of `felt`
  double felt_max_n = 0.0;
  double felt_swing_n = 0.0;  // peak-to-peak range of the contact force in the second half of the wait
  Vector3 tool_force_n = Vector3::Zero();  // true force on the tool at the end, W
  double tool_n = 0.0;                     // its magnitude
  double tool_max_n = 0.0;
  double felt_nm = 0.0, tool_nm = 0.0;  // at the end: moment on the hand; true moment on the tool
  double given_j = 0.0;  // work that the contact force did on the hand until the force last vanished
  double felt_s = -1.0;  // time from the start until a force of 0.2 N is displayed; -1: never
  double lead_m = 0.0;   // |goal - tool| at the end
  double lead_max_m = 0.0;
  double goal_step_m = 0.0;   // maximum step of the goal in one tick
  double felt_step_n = 0.0;   // maximum increase of the force in one tick
  double hand_m_per_s = 0.0;  // maximum speed of the handle
  /// Time from a motion of the goal by 0.5 mm to a motion of the tool by 0.5 mm; -1: never.
  double answer_s = -1.0;
  bool engaged = true;         // engaged at the end
  std::uint64_t holds = 0;     // number of holds of the master since the start
  bool cut = false;            // the stiffness was limited to the maximum of the device
  double tool_m_per_s2 = 0.0;  // maximum acceleration of the tool
};

struct PersonSeen {
  std::vector<MoveSeen> move;
  double front_n = 0.0;  // maximum contact force while the goal was more than 0.5 mm in front of all surfaces
  /// Maximum contact force although tool and goal have been at rest in free space for a round trip and 0.5 s.
  double free_n = 0.0;
  double energy_min_j = 0.0;
  double goal_m_per_s = 0.0;  // maximum speed of the goal
};

PersonSeen run_person(const PersonScenario& scenario);

}  // namespace longreach
