#include "deploy/lab/mapping/path_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "common/config/config.hpp"
#include "deploy/lab/laboratory.hpp"
#include "master/simulation/hand_model.hpp"
#include "slave/config/path.hpp"

namespace longreach {
namespace {

constexpr double kEngageWithin_s = 30.0, kEnd_s = 900.0;  // time limits for the engagement and for the task
constexpr double kThere_m = 1e-4;                         // distance of the tool from its commanded position

Random person_of(const PathCase& c) { return Random(c.seed).child("person " + std::to_string(c.person)); }

Random trial_of(const PathCase& c) { return person_of(c).child("trial " + std::to_string(c.trial)); }

MasterConfig master_of(const proto::LabConfig& config, const PathCase& c) {
  MasterConfig master = to_struct(config.master());
  master.safety.engage_at_start = true;
  master.mapping.mode = c.strategy == PathStrategy::kPosition ? MotionMode::kPosition : MotionMode::kRate;
  // A hand takes the handle again anywhere in the dead zone.
  master.mapping.rate_centre = RateCentre::kWhereModeBegan;
  master.mapping.simultaneous = c.simultaneous;
  master.link.impairment = {};
  master.link.impairment.delay_s = 0.5 * c.rtt_s;
  return master;
}

PathConfig sized(PathConfig path, double size) {
  for (WaypointConfig& waypoint : path.waypoint) waypoint.point_m *= size;
  path.turn_radius_m *= size;
  return path;
}

SlaveConfig slave_of(const proto::LabConfig& config, const PathCase& c) {
  SlaveConfig slave = to_struct(config.slave());
  slave.scene.surface.clear();
  if (slave.scene.path) slave.scene.path = sized(*slave.scene.path, c.size);
  slave.link.impairment = {};
  slave.link.impairment.delay_s = 0.5 * c.rtt_s;
  return slave;
}

class Trial {
 public:
  Trial(const proto::LabConfig& config, const PathCase& c)
      : case_(c),
        master_(master_of(config, c)),
        lab_(master_, slave_of(config, c), c.seed),
        course_(course_of(config, c)),
        path_(course_.path, Vector3::Zero()),
        person_(PathPerson::draw(person_of(c)), work(), course_.aims,
                trial_of(c).child(to_string(c.strategy))) {}

  PathResult run(Trace* trace) {
    while (lab_.now_s() < kEngageWithin_s && !ready()) lab_.step();
    const double begin_s = lab_.now_s();
    Vector3 before_m = tool();
    double way_m = 0.0, sum_m2 = 0.0, turned_rad_s = 0.0;
    for (std::int64_t ticks = 0; lab_.now_s() < begin_s + kEnd_s && !arrived(); ++ticks) {
      tick();
      const double stride_m = (tool() - before_m).norm();
      before_m = tool();
      way_m += stride_m;
      sum_m2 += stride_m * path_.place(tool()).distance_m;
      turned_rad_s += lab_.period_s() * lab_.master().goal_rad.norm();
      if (trace != nullptr && ticks % 20 == 0) row(*trace, lab_.now_s() - begin_s);
    }
    return {.finished = arrived(),
            .time_s = lab_.now_s() - begin_s,
            .error_m = way_m > 0.0 ? sum_m2 / way_m : 0.0,
            .target_error_m = target_sum_m_ / std::max(targets_, 1),
            .turned_rad = turned_rad_s / std::max(lab_.now_s() - begin_s, lab_.period_s()),
            .moves = person_.moves(),
            .relocations = person_.relocations()};
  }

 private:
  [[nodiscard]] PathWork work() const {
    const Grip grip = master_.hand.grip;
    return {.strategy = case_.strategy,
            .mapping = master_.mapping,
            .spring_share = master_.rendering.rate_stiffness_n_per_m / hand_model(grip).stiffness_n_per_m,
            .grip = grip,
            .near_sd = case_.near_sd,
            .late_s = case_.ghost ? 0.0 : case_.rtt_s};
  }

  [[nodiscard]] bool ready() const {
    return lab_.master().state == SafetyState::kEngaged && lab_.master().far_known;
  }
  [[nodiscard]] const Vector3& start() const { return lab_.arm().start_pose().p; }
  [[nodiscard]] Vector3 tool() const { return lab_.slave().X_WE.p - start(); }
  [[nodiscard]] Vector3 shown() const {
    return case_.ghost ? lab_.master().goal_m : Vector3(lab_.master().far.X_WE.p - start());
  }
  [[nodiscard]] bool arrived() const {
    return person_.done() && (tool() - lab_.master().goal_m).norm() < kThere_m;
  }

  void tick() {
    const std::size_t before = person_.next();
    PathOperatorOutput hand = person_.step({.t_s = lab_.now_s(),
                                            .shown_m = shown(),
                                            .handle_m = lab_.master().p_MH,
                                            .approach_m_per_s = lab_.master().approach_m_per_s});
    for (std::size_t i = before; i < person_.next(); ++i) {
      if (!course_.aims[i].target) continue;
      target_sum_m_ += (lab_.master().goal_m - course_.aims[i].at_m).norm();
      ++targets_;
    }
    hand.target.rotation_rad = turn_of_hand();
    lab_.drive(hand.target);
    lab_.requests() = hand.requests;
    lab_.step();
  }

  /// The hand on the other handle turns about each axis with three periods that do not fit.
  [[nodiscard]] Vector3 turn_of_hand() const {
    constexpr std::array kPeriod_s = {3.1, 4.3, 5.7};
    Vector3 turn = Vector3::Zero();
    for (int axis = 0; axis < 3; ++axis)
      turn[axis] = case_.turns_rad * std::sin(2.0 * std::numbers::pi * lab_.now_s() /
                                              kPeriod_s[static_cast<std::size_t>(axis)]);
    return turn;
  }

  void row(Trace& trace, double t_s) const {
    const Vector3 p = tool();
    trace.row({t_s, p.x(), p.y(), p.z(), drawn(p).x(), drawn(p).y(), path_.place(p).distance_m});
  }

  PathCase case_;
  MasterConfig master_;
  Laboratory lab_;
  PathCourse course_;
  Path path_;
  PathOperator person_;
  double target_sum_m_ = 0.0;
  int targets_ = 0;
};

}  // namespace

proto::LabConfig path_task_config(const proto::LabConfig& config) {
  proto::LabConfig task = config;
  proto::SlaveConfig& slave = *task.mutable_slave();
  slave.set_scene_file("scenes/path.txtpb");
  slave.clear_scene();
  slave.clear_robot();
  slave.clear_robot_file();
  /// The axes of the hand are those of the scene.
  task.mutable_master()->mutable_mapping()->clear_base_rotation_rad();
  resolve_files(slave, find_deploy_folder());
  return task;
}

PathCourse course_of(const proto::LabConfig& config, const PathCase& c) {
  return shuffled_course(sized(to_struct(config.slave()).scene.path.value(), c.size),
                         trial_of(c).child("way"));
}

double reaches_of(const proto::LabConfig& config, const PathCase& c) {
  const MasterConfig master = to_struct(config.master());
  return course_of(config, c).length_m / (master.mapping.scale * master.device.delta.workspace_m);
}

Eigen::Vector2d drawn(const Vector3& p_m) {
  return {p_m.sum() / std::sqrt(3.0), (p_m.z() - p_m.x()) / std::sqrt(2.0)};
}

PathResult run_path_trial(const proto::LabConfig& config, const PathCase& c, Trace* trace) {
  return Trial(config, c).run(trace);
}

Trace path_trace(const std::filesystem::path& folder, std::string_view name) {
  return {folder, name, {"t_s", "x_m", "y_m", "z_m", "right_m", "up_m", "distance_m"}};
}

}  // namespace longreach
