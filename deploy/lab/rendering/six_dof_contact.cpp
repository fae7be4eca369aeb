// Contacts other than a wall perpendicular to the motion, in the complete loop (slave, estimator, link): an
// oblique plane, corners of 60, 90 and 120 degrees whose walls are touched one after the other, a corner of three walls, a
// corner that is pressed diagonally, and a rotational stop. None of them is known to the slave. The force at the hand at
// two rests, its slope between them, and the position at which it would be zero, are compared with the scene.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

struct Wall {
  Vector3 n = Vector3::UnitX();  // inwards
  double at_m = 0.01;            // distance from the start along it
  double n_per_m = 1000.0;
};

MasterConfig master_of(const ExperimentRun& run) {
  MasterConfig config = to_struct(run.config.master());
  config.safety.engage_at_start = true;
  config.mapping.mode = MotionMode::kPosition;
  config.mapping.scale = 1.0;
  config.rendering.friction_n = config.rendering.friction_nm = 0.0;  // all other forces are switched off
  config.rendering.rotational_stiffness_nm_per_rad = 0.0;
  return config;
}

SlaveConfig slave_of(const ExperimentRun& run, const std::vector<Wall>& walls) {
  SlaveConfig config = to_struct(run.config.slave());
  config.scene = {};
  for (const Wall& wall : walls) {
    const std::string name = "wall " + std::to_string(config.scene.surface.size() + 1);
    config.scene.material.push_back({.name = name, .stiffness_n_per_m = wall.n_per_m});
    SurfaceConfig surface;
    surface.name = surface.material = name;
    surface.plane = PlaneConfig{.point_m = wall.at_m * wall.n, .normal = -wall.n};
    config.scene.surface.push_back(surface);
  }
  return config;
}

/// The stops of scenes/hinge.txtpb: 10 N m/rad from 0.05 rad on.
SlaveConfig slave_with_stop(const ExperimentRun& run) {
  SlaveConfig config = slave_of(run, {});
  config.scene.material.push_back({.name = "stop", .stiffness_n_per_m = 1000.0, .damping_s_per_m = 0.2});
  SurfaceConfig surface;
  surface.name = surface.material = "stop";
  surface.hinge = HingeConfig{};
  config.scene.surface.push_back(surface);
  return config;
}

struct Rest {
  Vector3 x_m, force_n;
  double turn_rad, moment_nm;
};

class Hand {
 public:
  Hand(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed) : lab_(master, slave, seed) {
    to(Vector3::Zero());
    stay(2.0);
    for (int i = 0; i < 60 && lab_.master().state != SafetyState::kEngaged; ++i) stay(1.0);
    rtt_s_ = lab_.link().rtt_s.value_or(0.0);
  }

  /// At 20 mm/s.
  void to(const Vector3& x_m) {
    const Vector3 way_m = x_m - target_.position_m;
    const double speed = 0.02, seconds = way_m.norm() / speed;
    const Vector3 from_m = target_.position_m;
    if (seconds > 0.0) target_.velocity_m_per_s = way_m / seconds;
    for (double t = 0.0; t < seconds; t += lab_.period_s()) {
      target_.position_m = from_m + way_m * (t / seconds);
      tick();
    }
    target_.position_m = x_m;
    target_.velocity_m_per_s.setZero();
  }
  void turn_to(double rad) { target_.rotation_rad = {0.0, 0.0, rad}; }
  void stay(double seconds) {
    for (double t = 0.0; t < seconds; t += lab_.period_s()) tick();
  }
  /// Until the contact has been reported and displayed.
  void wait() { stay(2.0 * rtt_s_ + 4.0); }
  [[nodiscard]] Rest rest() const {
    const MasterView& m = lab_.master();
    return {m.p_MH, m.F_H_M.force, log_rotation(lab_.devices().spherical().orientation()).z(),
            m.F_H_M.moment.z()};
  }
  [[nodiscard]] double port_energy_min_j() const { return lab_.master().port_energy_min_j; }
  void trace_into(Trace* trace) { trace_ = trace; }

 private:
  void tick() {
    lab_.drive(target_);
    lab_.step();
    if (trace_ == nullptr || ++ticks_ % 10 != 0) return;
    const Rest now = rest();
    trace_->row({lab_.now_s(), now.x_m.x(), now.x_m.y(), now.force_n.x(), now.force_n.y(), now.force_n.z()});
  }

  Laboratory lab_;
  HandTarget target_{.grip = Grip::kFirm};
  double rtt_s_ = 0.0;
  Trace* trace_ = nullptr;
  int ticks_ = 0;
};

void judge(const std::string& name, const Wall& wall, const Rest& less, const Rest& more,
           std::vector<Metric>& metrics) {
  const double slope = -(more.force_n - less.force_n).dot(wall.n) / (more.x_m - less.x_m).dot(wall.n);
  double force_error = 0.0;
  for (const Rest* rest : {&less, &more}) {
    const double due_n = wall.n_per_m * (wall.n.dot(rest->x_m) - wall.at_m);
    force_error = std::max(force_error, std::abs(-rest->force_n.dot(wall.n) / due_n - 1.0));
  }
  const double foot_m = wall.n.dot(more.x_m) + more.force_n.dot(wall.n) / slope;
  metrics.push_back({name + "_displayed_error", std::abs(slope / wall.n_per_m - 1.0), ""});
  metrics.push_back({name + "_force_error", force_error, ""});
  metrics.push_back({name + "_registration_error_m", std::abs(foot_m - wall.at_m), "m"});
}

void oblique(const ExperimentRun& run, std::vector<Metric>& metrics) {
  const Wall wall{Vector3(1.0, 0.5, -0.3).normalized(), 0.01, 1000.0};
  Trace trace(run.out, "oblique", {"t_s", "x_m", "y_m", "fx_n", "fy_n", "fz_n"});
  Hand hand(master_of(run), slave_of(run, {wall}), run.seed);
  hand.trace_into(&trace);
  hand.to(0.016 * wall.n);
  hand.wait();
  hand.to(Vector3::Zero());
  hand.to(0.017 * wall.n);
  hand.wait();
  const Rest less = hand.rest();
  hand.to(0.022 * wall.n);
  hand.wait();
  const Rest more = hand.rest();
  trace.close();
  judge("oblique", wall, less, more, metrics);
  const Vector3 across_n = more.force_n - wall.n.dot(more.force_n) * wall.n;
  metrics.push_back({"oblique_tangential_n", across_n.norm(), "N"});
  metrics.push_back({"oblique_port_energy_min_j", hand.port_energy_min_j(), "J"});
}

/// Walls of 0.8 and 1.2 N/mm with this angle between them, and with `third` one of 1 N/mm perpendicular to both.
std::vector<Wall> corner_walls(double angle_rad, bool third) {
  std::vector<Wall> walls{{Vector3::UnitX(), 0.01, 800.0},
                          {Vector3(-std::cos(angle_rad), std::sin(angle_rad), 0.0), 0.01, 1200.0}};
  if (third) walls.push_back({Vector3::UnitZ(), 0.01, 1000.0});
  return walls;
}

/// The place at these depths behind the walls; without a third wall, in the plane of their normals.
Vector3 behind(const std::vector<Wall>& walls, const Vector3& depth_m) {
  Matrix3 normals = Matrix3::Identity();
  Vector3 at_m = Vector3::Zero();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    normals.row(row) = walls[i].n.transpose();
    at_m[row] = walls[i].at_m + depth_m[row];
  }
  return normals.partialPivLu().solve(at_m);
}

Vector3 due_n(const std::vector<Wall>& walls, const Vector3& x_m) {
  Vector3 sum = Vector3::Zero();
  for (const Wall& wall : walls) sum -= wall.n_per_m * std::max(0.0, wall.n.dot(x_m) - wall.at_m) * wall.n;
  return sum;
}

/// Rests at places with these depths behind the walls, returns, and presses twice on all walls.
void corner(const ExperimentRun& run, const std::string& name, const std::vector<Wall>& walls,
            const std::vector<Vector3>& first_m, std::vector<Metric>& metrics) {
  Hand hand(master_of(run), slave_of(run, walls), run.seed);
  for (const Vector3& depth_m : first_m) {
    hand.to(behind(walls, depth_m));
    hand.wait();
  }
  hand.to(Vector3::Zero());
  hand.wait();
  std::array<Rest, 2> rests;
  double force_error = 0.0;
  for (std::size_t i = 0; i < rests.size(); ++i) {
    hand.to(behind(walls, i == 0 ? Vector3(0.006, 0.005, 0.004) : Vector3(0.012, 0.010, 0.009)));
    hand.wait();
    rests[i] = hand.rest();
    const Vector3 due = due_n(walls, rests[i].x_m);
    force_error = std::max(force_error, (rests[i].force_n - due).norm() / due.norm());
  }
  const Vector3 due = due_n(walls, rests[1].x_m) - due_n(walls, rests[0].x_m);
  const Vector3 felt = rests[1].force_n - rests[0].force_n;
  metrics.push_back({name + "_force_error", force_error, ""});
  metrics.push_back({name + "_slope_error", (felt - due).norm() / due.norm(), ""});
  metrics.push_back({name + "_port_energy_min_j", hand.port_energy_min_j(), "J"});
}

void corners(const ExperimentRun& run, std::vector<Metric>& metrics) {
  constexpr double kFree_m = -0.01, kRightAngle = std::numbers::pi / 2.0;
  const std::vector<Vector3> by_sliding{{0.006, kFree_m, kFree_m}, {0.006, 0.005, kFree_m}};
  const std::vector<Vector3> at_once{{0.006, 0.005, kFree_m}};
  for (const int degrees : {60, 90, 120})
    corner(run, "corner_" + std::to_string(degrees), corner_walls(degrees * std::numbers::pi / 180.0, false),
           by_sliding, metrics);
  corner(run, "three_walls", corner_walls(kRightAngle, true), by_sliding, metrics);
  corner(run, "diagonal", corner_walls(kRightAngle, false), at_once, metrics);
}

void torque(const ExperimentRun& run, std::vector<Metric>& metrics) {
  constexpr double kStop_nm_per_rad = 10.0, kEffect = 0.04, kStop_rad = 0.05;
  MasterConfig master = master_of(run);
  master.rendering.ke_rotation = kEffect;
  Hand hand(master, slave_with_stop(run), run.seed);
  hand.turn_to(0.12);
  hand.wait();
  hand.turn_to(0.0);
  hand.wait();
  hand.turn_to(0.12);
  hand.wait();
  const Rest less = hand.rest();
  hand.turn_to(0.2);
  hand.wait();
  const Rest more = hand.rest();
  const double slope = -(more.moment_nm - less.moment_nm) / (more.turn_rad - less.turn_rad);
  metrics.push_back({"torque_displayed_error", std::abs(slope / (kEffect * kStop_nm_per_rad) - 1.0), ""});
  metrics.push_back(
      {"torque_registration_error_rad", std::abs(more.turn_rad + more.moment_nm / slope - kStop_rad), "rad"});
  metrics.push_back({"torque_port_energy_min_j", hand.port_energy_min_j(), "J"});
}

}  // namespace

std::vector<Plot> six_dof_contact_plots() {
  return {{.name = "six-dof-contact",
           .csv = "oblique",
           .title = "Pressing on an oblique plane of 1 N/mm without a model of the scene",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"handle (mm)", {{"x_m", "x", 1e3}, {"y_m", "y", 1e3}}, ""},
                      {"force (N)", {{"fx_n", "x"}, {"fy_n", "y"}, {"fz_n", "z"}}, ""}}}};
}

std::vector<Metric> run_six_dof_contact(const ExperimentRun& run) {
  std::vector<Metric> metrics;
  oblique(run, metrics);
  corners(run, metrics);
  torque(run, metrics);
  return metrics;
}

}  // namespace longreach
