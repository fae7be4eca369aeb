#pragma once
// A person with a compliant hand who moves, presses, rests and retreats, over one link, and the true state of
// the scene: when the goal is in front of every surface, how far it leads the tool, and the force on the
// hand.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/lab/laboratory.hpp"
#include "slave/config/scene_config.hpp"

namespace longreach {

/// One action of the person: moves to a position in a straight line, then waits.
struct PersonMove {
  Vector3 to_m = Vector3::Zero();  // of the hand, from home, M
  double speed_m_per_s = 0.02;
  double wait_s = 1.0;
  double wait_rtt = 1.0;               // additional round trips
  Vector3 turn_rad = Vector3::Zero();  // rotation vector to reach meanwhile, M, at 0.1 rad/s
  bool clutch = false;
  std::optional<MotionMode> mode{};
  bool stop = false, hold = false, engage = false, let_go = false;
  std::optional<double> scale{};
  std::optional<bool> load{};
  double blackout_s = 0.0;  // from its beginning no datagram arrives at either side
  std::function<void(MasterConfig&)> change{};
};

struct PersonScenario {
  MasterConfig master{};
  SlaveConfig slave{};
  Grip grip = Grip::kLight;
  double rtt_s = 0.0;
  std::uint64_t seed = 1;
  bool blind =
      /// the control: reports without the position of the tool and its limits, as in an earlier version
      false;
  std::vector<PersonMove> moves;
  /// Maximum depth of a position behind the true surfaces, m; goals and tools from the anchor.
  std::function<double(const Vector3&)> depth_m = [](const Vector3&) { return -1.0; };
};

/// Observations of one move, including its wait.
struct MoveSeen {
  Vector3 goal_m = Vector3::Zero(), tool_m = Vector3::Zero();  // at its end, from the anchor
  Vector3 tool_least_m = Vector3::Zero(), tool_most_m = Vector3::Zero();
  [[nodiscard]] double tool_span_m() const { return (tool_most_m - tool_least_m).norm(); }
  Vector3 hand_m = Vector3::Zero();  // true, at its end
  double hand_n = 0.0;               // total rendered force, at its end
  Vector3 felt = Vector3::Zero();    // contact force at the hand, at its end, M, N
  double felt_n = 0.0;               // likewise
  double felt_max_n = 0.0;
  double felt_swing_n = 0.0;  // range in the second half of the wait
  double tool_n = 0.0;        // true force at the tool, at its end
  double tool_max_n = 0.0;
  double felt_nm = 0.0, tool_nm = 0.0;  // moments likewise, at its end
  double given_j = 0.0;  // work of the contact force on the hand, until the contact force last vanished
  double felt_s = -1.0;  // from its beginning until 0.2 N are displayed; -1: never
  double lead_m = 0.0;   // |goal - tool| at its end
  double lead_max_m = 0.0;
  double goal_step_m = 0.0;   // maximum in a tick
  double felt_step_n = 0.0;   // maximum increase in a tick
  double hand_m_per_s = 0.0;  // maximum speed of the handle
  double answer_s =
      -1.0;  // from the first motion of the goal by 0.5 mm until the tool has moved by 0.5 mm; -1: never
  bool engaged = true;         // at its end
  bool cut = false;            // the stiffness was limited to the maximum of the device
  double tool_m_per_s2 = 0.0;  // maximum
};

struct PersonSeen {
  std::vector<MoveSeen> move;
  double front_n = 0.0;  // maximum contact force with the goal in front of every surface by over 0.5 mm
  double energy_min_j = 0.0;
  double goal_m_per_s = 0.0;  // maximum
};

PersonSeen run_person(const PersonScenario& scenario);

}  // namespace longreach
