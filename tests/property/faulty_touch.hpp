#pragma once
// A robot with a faulty force sensor, simulated with the slave's node and the simulated arm. The gantry of
// guard_touch.hpp either moves towards a wall while its goal continues behind the wall at a constant speed,
// or rests in front of the wall. Then the fault begins. The master may stop sending commands. The results are
// the true position and the true force.

#include "deploy/lab/rendering/guard_touch.hpp"
#include "deploy/lab/robot/faulty_sensor.hpp"

namespace longreach::test {

struct SensorFaultCase {
  SensorFault sensor_fault{};
  GuardCase guard{.guard_n = 20.0, .delay_s = 1e-3, .mass_kg = 0.0};
  double behind_m = 0.05;  // position of the final goal behind the wall; negative: in front of it
  double fault_s = 0.0;    // start of the fault
  double silent_s = 1e9;   // time after which the master sends nothing
  double end_s = 6.0;
  double coming_m_per_s = 0.0;  // speed of the wall towards the robot; 0: fixed
};

struct SensorFaultRow {
  double t_s;
  Vector3 tool_m;  // position of the tool relative to its start
  double force_n;  // true force
  SafetyState state;
  HoldCause cause;
};

struct SensorFaultRun {
  std::vector<SensorFaultRow> rows{};
  double peak_n = 0.0;
  double reported_s = -1.0;  // time at which a hold cause first named the sensor; -1: never
  HoldCause reported = HoldCause::kNone;
  std::uint64_t limit_violations = 0;
  std::uint32_t touches = 0;

  /// Returns the maximum distance of the tool, after `from_s`, from its position at `from_s`, m.
  [[nodiscard]] double way_m(double from_s) const {
    double way = 0.0;
    const SensorFaultRow* at = nullptr;
    for (const SensorFaultRow& row : rows) {
      if (at == nullptr && row.t_s >= from_s) at = &row;
      if (at != nullptr) way = std::max(way, (row.tool_m - at->tool_m).norm());
    }
    return way;
  }
};

inline bool of_the_sensor(HoldCause cause) {
  return cause == HoldCause::kSensorFault || cause == HoldCause::kSensorSign ||
         cause == HoldCause::kForcePersists;
}

/// Runs a case. `stalls(tick)` returns whether the adapter and the robot are stalled in this tick; if so, the
/// last report is repeated.
template <class Stalls>
SensorFaultRun sensor_fault_run(const SensorFaultCase& c, const SlaveConfig& config, Stalls&& stalls) {
  SlaveNode node(config);
  SimulatedArm arm(config, Random(c.guard.seed));
  FaultySensor sensor(config.robot);
  Received<MotionCommand> command{};
  double goal_m = 0.0;
  RobotState said{};
  SensorFaultRun run;
  for (int i = 1; i * 1e-3 < c.end_s; ++i) {
    const double t_s = 1e-3 * i;
    SlaveInput in;
    in.now = Time{std::chrono::milliseconds(i)};
    const bool stalled = stalls(i);
    if (!stalled) said = arm.read(in.now);
    in.robot = said;
    if (t_s >= c.fault_s && sensor.sensor_fault().sensor_fault != c.sensor_fault.sensor_fault)
      sensor.sensor_fault(c.sensor_fault);
    sensor.apply(in.now, in.robot);
    in.peer_session_count = 1;
    if (i > 5) in.last_heard = command.received;
    if (i % 5 == 0 && t_s < c.silent_s) {
      if (node.engaged()) goal_m = std::min(kGuardWall_m + c.behind_m, goal_m + 5e-3 * c.guard.speed_m_per_s);
      ++command.sequence;
      command.sent = PeerTime{in.now.time_since_epoch()};
      command.received = in.now;
      if (i > 5) command.echo_sent = in.now - std::chrono::milliseconds(5);
      command.message.engagement = 1;
      command.message.request = Request::kEngage;
      command.message.position_m.x() = goal_m;
      in.commands = {&command, 1};
      in.last_heard = in.now;
    }
    const auto setpoint_rad = node.step(in).joint_setpoint_rad;
    if (!stalled) arm.write(setpoint_rad);
    const double force_n = arm.true_wrench().force.norm();
    run.peak_n = std::max(run.peak_n, force_n);
    const SlaveView& view = node.view();
    if (run.reported_s < 0.0 && of_the_sensor(view.cause)) {
      run.reported_s = t_s;
      run.reported = view.cause;
    }
    run.rows.push_back({t_s, arm.true_pose().p - arm.start_pose().p, force_n, view.state, view.cause});
  }
  run.limit_violations = node.view().limit_violations;
  run.touches = node.view().touch;
  return run;
}

inline SlaveConfig sensor_fault_config(const SensorFaultCase& c) {
  SlaveConfig config = guard_config(c.guard);
  if (c.coming_m_per_s != 0.0)
    config.scene.surface.front().movement = MovementConfig{-c.coming_m_per_s * Vector3::UnitX()};
  return config;
}

inline SensorFaultRun sensor_fault_run(const SensorFaultCase& c) {
  return sensor_fault_run(c, sensor_fault_config(c), [](int) { return false; });
}

}  // namespace longreach::test
