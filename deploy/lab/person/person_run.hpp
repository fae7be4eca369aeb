#pragma once
// A person with a yielding hand who moves, presses, rests and retreats, over one link, and what scene truth
// says of it: where the goal is in front of every surface, how far it runs ahead of the tool, and what the
// hand feels then.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/laboratory.hpp"
#include "slave/config/scene_config.hpp"

namespace longreach {

/// One thing that the person does: goes to a place in a straight line, then waits.
struct PersonMove {
  Vector3 to_m = Vector3::Zero();  // of the hand, from home, M
  double speed_m_per_s = 0.02;
  double wait_s = 1.0;
  double wait_rtt = 1.0;               // round trips more
  Vector3 turn_rad = Vector3::Zero();  // rotation vector to turn to meanwhile, M, at 0.1 rad/s
  bool clutch = false;
  std::optional<MotionMode> mode{};
  bool stop = false, hold = false, engage = false, let_go = false;
  std::optional<double> scale{};
  std::optional<bool> load{};
  double blackout_s = 0.0;  // from its beginning on nothing arrives at either side
  std::function<void(MasterConfig&)> change{};
};

struct PersonScenario {
  MasterConfig master{};
  SlaveConfig slave{};
  Grip grip = Grip::kLight;
  double rtt_s = 0.0;
  std::uint64_t seed = 1;
  bool blind =
      false;  // the control: reports without the tool's place and what holds it back, as they once were
  std::vector<PersonMove> moves;
  /// Largest depth of a place behind the surfaces as they are, m; goals and tools from the anchor.
  std::function<double(const Vector3&)> depth_m = [](const Vector3&) { return -1.0; };
};

/// What was seen in one move, its wait included.
struct MoveSeen {
  Vector3 goal_m = Vector3::Zero(), tool_m = Vector3::Zero();  // at its end, from the anchor
  Vector3 tool_least_m = Vector3::Zero(), tool_most_m = Vector3::Zero();
  [[nodiscard]] double tool_span_m() const { return (tool_most_m - tool_least_m).norm(); }
  Vector3 hand_m = Vector3::Zero();  // true, at its end
  double hand_n = 0.0;               // all that is rendered, at its end
  Vector3 felt = Vector3::Zero();    // contact force at the hand, at its end, M, N
  double felt_n = 0.0;               // likewise
  double felt_max_n = 0.0;
  double felt_swing_n = 0.0;  // between its least and its largest in the second half of the wait
  double tool_n = 0.0;        // true force at the tool, at its end
  double tool_max_n = 0.0;
  double felt_nm = 0.0, tool_nm = 0.0;  // moments likewise, at its end
  double given_j = 0.0;                 // work of the contact force on the hand, up to when it last felt none
  double felt_s = -1.0;                 // from its beginning until 0.2 N are felt; -1: never
  double lead_m = 0.0;                  // |goal - tool| at its end
  double lead_max_m = 0.0;
  double goal_step_m = 0.0;   // largest in a tick
  double felt_step_n = 0.0;   // largest rise in a tick
  double hand_m_per_s = 0.0;  // fastest motion of the handle
  double answer_s =
      -1.0;  // from the first motion of the goal by 0.5 mm until the tool has moved by 0.5 mm; -1: never
  bool engaged = true;         // at its end
  bool cut = false;            // the stiffness, to what the device can render
  double tool_m_per_s2 = 0.0;  // largest
};

struct PersonSeen {
  std::vector<MoveSeen> move;
  double front_n = 0.0;  // largest contact force with the goal in front of every surface by over 0.5 mm
  double energy_min_j = 0.0;
  double goal_m_per_s = 0.0;  // fastest
};

PersonSeen run_person(const PersonScenario& scenario);

}  // namespace longreach
