// Contacts other than a wall perpendicular to the motion, in the complete loop (slave, estimator, link): an
// oblique plane, a corner whose planes are touched one after the other, a corner that is pressed diagonally,
// and a rotational stop. None of them is known to the slave. The slope of the force at the hand between two
// rests, and the position at which it would be zero, are compared with the scene.

#include <algorithm>
#include <cmath>
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

void corner(const ExperimentRun& run, const std::string& name, const std::vector<Vector3>& first,
            std::vector<Metric>& metrics) {
  const Wall walls[] = {{Vector3::UnitX(), 0.01, 800.0}, {Vector3::UnitY(), 0.01, 1200.0}};
  Hand hand(master_of(run), slave_of(run, {walls[0], walls[1]}), run.seed);
  for (const Vector3& place_m : first) {
    hand.to(place_m);
    hand.wait();
  }
  hand.to({0.016, 0.015, 0.0});
  hand.wait();
  const Rest less = hand.rest();
  hand.to({0.022, 0.020, 0.0});
  hand.wait();
  const Rest more = hand.rest();
  judge(name + "_x", walls[0], less, more, metrics);
  judge(name + "_y", walls[1], less, more, metrics);
  metrics.push_back({name + "_port_energy_min_j", hand.port_energy_min_j(), "J"});
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
  corner(run, "corner", {{0.016, 0.0, 0.0}, {0.016, 0.015, 0.0}, Vector3::Zero()}, metrics);
  corner(run, "diagonal", {{0.016, 0.015, 0.0}, Vector3::Zero()}, metrics);
  torque(run, metrics);
  return metrics;
}

}  // namespace longreach
