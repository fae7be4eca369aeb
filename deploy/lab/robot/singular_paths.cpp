// The tool of a PUMA 560 moves along straight lines through a wrist, an elbow and a shoulder singularity, one
// after the other. Measures the distance from the goal, and the joint speeds relative to their limits.
//
// Each line leads from a pose before the singular pose through it to a pose behind it; then the goal waits
// for the tool. The singular pose is found where det J changes its sign as one joint moves.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "slave/command/motion.hpp"
#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kDt = 1e-3;
constexpr double kLegS = 2.5;
constexpr double kWaitS = 3.0;
constexpr double kPassageS = 2.0 * kLegS + kWaitS;
constexpr int kTicksPerRow = 5;

struct Passage {
  const char* name;
  int joint;                            // whose angle makes the pose singular
  std::array<double, kMaxJoints> near;  // joints at about the singular pose
  std::array<double, kMaxJoints> half;  // from there to the end of the line
};

constexpr std::array<Passage, 3> kPassages{{
    {"wrist", 4, {0.3, 1.0, -0.6, 0.4, 0.0, 0.2}, {0.06, 0.04, -0.06, 0.1, 0.4, 0.05}},
    {"elbow", 2, {0.3, 0.6, -1.5, 0.4, -0.8, 0.2}, {0.1, 0.05, 0.3, 0.05, 0.05, 0.05}},
    {"shoulder", 1, {0.3, 1.6, -1.0, 0.4, -0.8, 0.2}, {0.05, 0.2, 0.05, 0.05, 0.05, 0.05}},
}};

RobotConfig puma() {
  proto::SlaveConfig config;
  config.set_robot_file("robots/puma560.txtpb");
  config.mutable_scene();
  resolve_files(config, find_deploy_folder());
  return to_struct(config).robot;
}

JointVector vector(const std::array<double, kMaxJoints>& a) { return JointVector(a.data()); }

// The zero of det J with respect to the joint of the passage that is nearest to the given position.
JointVector singular(const Kinematics& arm, const Passage& passage) {
  constexpr double kStep = 0.01;
  JointVector q = vector(passage.near);
  const auto negative = [&](double x) {
    q[passage.joint] = x;
    return arm.rigid_with_jacobian(q).J.determinant() < 0.0;
  };
  const double centre = passage.near[static_cast<std::size_t>(passage.joint)];
  double low = centre, high = centre;
  for (int n = 0; n < 300 && low == high; ++n) {
    for (const double x : {centre + n * kStep, centre - (n + 1) * kStep}) {
      if (negative(x) != negative(x + kStep)) low = x, high = x + kStep;
    }
  }
  const bool sign = negative(low);
  for (int n = 0; n < 60; ++n) (negative(0.5 * (low + high)) == sign ? low : high) = 0.5 * (low + high);
  q[passage.joint] = low;
  return q;
}

Pose between(const Pose& a, const Pose& b, double share) {
  const Vector3 turn = log_rotation(b.q * a.q.conjugate());
  return {a.p + share * (b.p - a.p), exp_rotation(share * turn) * a.q};
}

/// Draws the names of the passages in the first panel, and lines between them in all panels.
std::string passage_marks() {
  std::string commands;
  for (std::size_t i = 0; i < kPassages.size(); ++i) {
    const double n = static_cast<double>(i);
    const std::string begin = std::to_string(n * kPassageS), middle = std::to_string((n + 0.5) * kPassageS);
    commands += "set label " + std::to_string(i + 2) + " '" + kPassages[i].name + "' at " + middle +
                ", graph 0.93 center\n";
    if (i > 0)
      commands += "set arrow from " + begin + ", graph 0 to " + begin + ", graph 1 nohead lc rgb '#666666'\n";
  }
  return commands;
}

}  // namespace

std::vector<Plot> singular_paths_plots() {
  std::vector<Curve> joints;
  for (int i = 1; i <= kMaxJoints; ++i)
    joints.push_back(
        {.column = "joint" + std::to_string(i) + "_speed", .title = "joint " + std::to_string(i)});
  return {{.name = "singular_paths",
           .csv = "singular_paths",
           .title = "Straight paths through the wrist, elbow and shoulder singularities of a PUMA 560",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"position error (mm)", {{"off_m", "", 1e3}}, passage_marks()},
                      {"angle error (mrad)", {{"turned_rad", "", 1e3}}, "unset label"},
                      {"joint speed / limit", joints, "set yrange [-1.05:1.05]"},
                      {"conditioning (0: singular)", {{"conditioning", ""}}, ""}}}};
}

std::vector<Metric> run_singular_paths(const ExperimentRun& run) {
  const RobotConfig robot = puma();
  CommandConfig command;
  SlaveMotion motion(command, robot);
  const Kinematics& arm = motion.kinematics();
  Trace trace(run.out, "singular_paths",
              {"t_s", "off_m", "turned_rad", "joint1_speed", "joint2_speed", "joint3_speed", "joint4_speed",
               "joint5_speed", "joint6_speed", "conditioning"});
  std::vector<Metric> metrics;
  double now = 0.0;
  for (const Passage& passage : kPassages) {
    const JointVector middle = singular(arm, passage), half = vector(passage.half);
    const std::array<Pose, 3> X{arm.forward(middle - half), arm.forward(middle), arm.forward(middle + half)};
    motion.reset(middle - half);
    JointVector before = motion.joint_setpoint_rad();
    double off_max_m = 0.0, late_s = 0.0, speed_max = 0.0;
    for (int tick = 0; tick < static_cast<int>(kPassageS / kDt); ++tick, now += kDt) {
      const double share = tick * kDt / kLegS;
      const Pose goal =
          share < 1.0 ? between(X[0], X[1], share) : between(X[1], X[2], std::min(share - 1.0, 1.0));
      motion.step({goal, {}, kDt});
      const double off_m = (motion.X_WE().p - goal.p).norm();
      const double turned = log_rotation(motion.X_WE().q * goal.q.conjugate()).norm();
      JointVector speed = (motion.joint_setpoint_rad() - before) / kDt;
      before = motion.joint_setpoint_rad();
      for (int i = 0; i < kMaxJoints; ++i)
        speed[i] /= robot.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s;
      off_max_m = std::max(off_max_m, off_m);
      speed_max = std::max(speed_max, speed.cwiseAbs().maxCoeff());
      if (off_m > 1e-6 || turned > 1e-6) late_s = tick * kDt - 2.0 * kLegS;
      if (tick % kTicksPerRow != 0) continue;
      trace.row({now, off_m, turned, speed[0], speed[1], speed[2], speed[3], speed[4], speed[5],
                 conditioning(arm.rigid_with_jacobian(before).J, arm.motion_length_m())});
    }
    const std::string name = passage.name;
    metrics.push_back({name + "_off_goal_max_m", off_max_m, "m"});
    metrics.push_back({name + "_arrived_after_s", late_s, "s"});
    metrics.push_back({name + "_joint_speed_max", speed_max, "fraction of the limit"});
  }
  trace.close();
  metrics.push_back({"limit_violations", static_cast<double>(motion.limit_violations()), ""});
  if (run.progress) run.progress(1.0);
  return metrics;
}

}  // namespace longreach
