#pragma once
// One attempt at a task that brings a free body to its goal by hand: grasp, drag, dock, release (task of Liu, Geng, Liu,
// Wang 2019, Fig. 20), judged by the poses, the force and the gripper that arrive over the link.
//
//   phase     | begins when
//   kBegun    | the tool has moved by kMoved_m; also if the body is released elsewhere
//   kHeld     | the gripper holds a load
//   kSeated   | the held body is within the tolerances of its goal, and pressed with force_n there before the force vanished
//   kReleased | the gripper has released the seated body
//   kDone     | the tool has retreated by kRetreat_m from the body, which is still within the tolerances
//
// A body that leaves the tolerances is no longer seated, and must press again.

#include <optional>

#include "common/spatial/spatial.hpp"
#include "proto/config.pb.h"
#include "schema/config_scene.hpp"

namespace longreach {

enum class DockPhase { kWaiting, kBegun, kHeld, kSeated, kReleased, kDone };

/// What the master knows in one frame.
struct DockSample {
  double t_s = 0.0;
  Vector3 tool_m = Vector3::Zero();  // in W
  std::optional<Pose> X_WB{};        // of the body's frame, in W; unset: unknown
  bool holds = false;                // the gripper holds a load
  double force_n = 0.0;              // at the tool
};

/// Figures of the attempt. The errors are those of the body against its goal, now or at the end.
struct DockFigures {
  double time_s = 0.0;
  double grasp_s = 0.0, seat_s = 0.0;  // first time; 0: not yet
  double position_error_m = 0.0, angle_error_rad = 0.0;
  double seat_force_n = 0.0;  // maximum force before the body was seated
};

class DockProgress {
 public:
  static constexpr double kMoved_m = 0.005;
  static constexpr double kRetreat_m = 0.03;
  static constexpr double kVanished = 0.4;  // share of force_n below which the force has vanished

  /// `p_WE_start`: start position of the tool, m.
  DockProgress(const BodyGoalConfig& goal, const Vector3& p_WE_start);

  /// `t_s` must not decrease. A sample without a pose of the body advances only the time.
  void step(const DockSample& sample);

  [[nodiscard]] DockPhase phase() const { return phase_; }
  [[nodiscard]] const DockFigures& figures() const { return figures_; }
  [[nodiscard]] int body() const { return static_cast<int>(goal_.body); }  // its number, from 1
  [[nodiscard]] bool body_known() const { return known_; }

 private:
  void judge(const DockSample& sample, const Pose& X_WB);

  BodyGoalConfig goal_;
  Pose X_WG_;  // the goal
  DockPhase phase_ = DockPhase::kWaiting;
  std::optional<Vector3> from_m_{};  // position of the tool in the first sample
  std::optional<double> before_s_{};
  double released_at_m_ = 0.0;  // distance of the tool from the frame of the body when it was released
  double peak_n_ = 0.0;         // force within the tolerances, of the held body
  bool known_ = false;
  DockFigures figures_{};
};

/// The goal of a free body in a slave's scene, from the start pose of its robot; none: the scene has no such goal. Throws
/// std::invalid_argument if the robot is invalid.
std::optional<DockProgress> dock_of(const proto::Robot& robot, const proto::Scene& scene);

}  // namespace longreach
