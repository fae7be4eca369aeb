// How the master renders reported surfaces: an oblique plane, a corner of two planes, a rotational stop. The
// slave is replaced by a formula that reports the true surfaces with a delay of half a round trip in each
// direction; there is no slave, estimator or link. `six-dof-contact` is the same in the complete loop.

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <string>

#include "common/config/config.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/master_node.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr double kOneWay_s = 1.3;
constexpr double kTick_s = 1e-3;

/// A plane n . g > d, in displacements or rotation vectors from the anchor.
struct Plane {
  Vector3 n = Vector3::UnitX();
  double d = 0.0;
  double stiffness = 0.0;
};

struct World {
  std::vector<Plane> translation, rotation;
};

/// The surface that is touched now, and the command since which it is.
class FarContact {
 public:
  explicit FarContact(std::vector<Plane> planes) : planes_(std::move(planes)) {}

  ContactReport touch(const Vector3& goal, std::uint64_t sequence) {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const Plane& plane = planes_[i];
      ReportedSurface& s = report_.surfaces[i];
      const bool inside = plane.n.dot(goal) > plane.d;
      if (inside && !s.pressed)
        s = {.normal = -plane.n,
             .stiffness = plane.stiffness,
             .touch_sequence = static_cast<double>(sequence),
             .touch = ++touch_};
      s.pressed = inside;
    }
    return report_;
  }

 private:
  std::vector<Plane> planes_;
  ContactReport report_{};
  std::uint32_t touch_ = 0;
};

class Bench {
 public:
  Bench(MasterConfig config, const World& world)
      : config_(prepared(std::move(config))),
        devices_(config_.device),
        node_(config_),
        translation_(world.translation),
        rotation_(world.rotation) {
    node_.render_by(contact_law(config_.rendering.law));
  }

  void run(const HandTarget& target, double seconds, const Vector3& speed = Vector3::Zero()) {
    HandTarget now = target;
    for (double t = 0.0; t < seconds; t += kTick_s) {
      now.position_m += kTick_s * speed;
      now.velocity_m_per_s = speed;
      tick(now);
    }
  }

  [[nodiscard]] const MasterView& view() const { return node_.view(); }
  [[nodiscard]] const MasterOutput& out() const { return out_; }
  [[nodiscard]] const HandleState& handle() const { return handle_; }
  [[nodiscard]] double now_s() const { return to_seconds(now_ - Time{}); }
  void trace_into(Trace* trace) { trace_ = trace; }

 private:
  static MasterConfig prepared(MasterConfig config) {
    config.safety.engage_at_start = true;
    config.mapping.mode = MotionMode::kPosition;
    config.mapping.scale = 1.0;
    config.rendering.friction_n = 0.0;  // all other forces are switched off
    config.rendering.rotational_stiffness_nm_per_rad = 0.0;
    return config;
  }

  struct Sent {
    Time at;
    std::uint64_t sequence;
    Vector3 position_m, rotation_rad;
  };

  void tick(const HandTarget& target) {
    now_ += from_seconds(kTick_s);
    devices_.set_target(target);
    MasterInput in;
    in.now = now_;
    in.handle = handle_ = devices_.read(now_);
    in.last_heard = now_;
    Received<StiffnessReport> report;
    if (answer(report.message)) {
      report.sequence = ++reports_;
      in.reports = {&report, 1};
    }
    out_ = node_.step(in);
    devices_.write(out_.F_H_M);
    if (out_.command)
      way_.push_back({now_, out_.sequence, out_.command->position_m, out_.command->rotation_rad});
    if (trace_ && ++ticks_ % 10 == 0) {
      const Vector3& x = handle_.p_MH;
      trace_->row({now_s(), x.x(), x.y(), out_.F_H_M.force.x(), out_.F_H_M.force.y(), out_.F_H_M.force.z(),
                   log_rotation(handle_.q_MH).x(), out_.F_H_M.moment.x()});
    }
  }

  /// A report every 20 ms for the command that was sent one round trip earlier.
  bool answer(StiffnessReport& report) {
    report.engagement = node_.view().engagement;
    report.state = SafetyState::kEngaged;
    if (node_.view().state != SafetyState::kEngaged) return true;
    bool any = false;
    while (!way_.empty() && now_ - way_.front().at >= from_seconds(2.0 * kOneWay_s)) {
      const Sent s = way_.front();
      way_.pop_front();
      report.translation = translation_.touch(s.position_m, s.sequence);
      report.rotation = rotation_.touch(s.rotation_rad, s.sequence);
      any = s.sequence % 4 == 0;
    }
    return any;
  }

  MasterConfig config_;
  SimulatedDevices devices_;
  MasterNode node_;
  FarContact translation_, rotation_;
  std::deque<Sent> way_;
  MasterOutput out_;
  HandleState handle_;
  Time now_{};
  std::uint64_t reports_ = 0;
  Trace* trace_ = nullptr;
  int ticks_ = 0;
};

HandTarget reach(const Vector3& x_m, const Vector3& rotation_rad = Vector3::Zero()) {
  HandTarget target;
  target.position_m = x_m;
  target.rotation_rad = rotation_rad;
  target.grip = Grip::kFirm;
  return target;
}

/// Slope of the contact force over the depth between two depths, after the transients.
struct Slope {
  Vector3 x[2], f[2];
  void take(int i, const Bench& b) {
    x[i] = b.handle().p_MH;
    f[i] = b.out().F_H_M.force;
  }
  [[nodiscard]] double along(const Vector3& n) const { return -(f[1] - f[0]).dot(n) / (x[1] - x[0]).dot(n); }
};

void oblique(const MasterConfig& config, Trace& trace, std::vector<Metric>& metrics) {
  constexpr double kStiffness = 2000.0;
  const Vector3 n = Vector3(1.0, 0.5, -0.3).normalized();
  Bench b(config, {{{n, 0.01, kStiffness}}, {}});
  b.trace_into(&trace);
  b.run(reach(Vector3::Zero()), 1.0);
  b.run(reach(0.02 * n), 6.0);         // first touch, report, settling
  b.run(reach(Vector3::Zero()), 2.0);  // out
  b.run(reach(0.012 * n), 4.0);        // in again: the force is displayed at once
  Slope slope;
  b.run(reach(0.018 * n), 3.0);
  slope.take(0, b);
  const Vector3 beside = n.cross(Vector3::UnitZ()).normalized();
  const double tangential_n = std::abs(b.out().F_H_M.force.dot(beside));
  b.run(reach(0.026 * n), 3.0);
  slope.take(1, b);
  metrics.push_back({"oblique_displayed_error", std::abs(slope.along(n) / kStiffness - 1.0), ""});
  metrics.push_back({"oblique_tangential_n", tangential_n, "N"});
  const double surface_m = n.dot(slope.x[1]) - slope.f[1].norm() / kStiffness;
  metrics.push_back({"oblique_registration_error_m", std::abs(surface_m - 0.01), "m"});
  metrics.push_back({"oblique_port_energy_min_j", b.view().port_energy_min_j, "J"});
}

void corner(const MasterConfig& config, std::vector<Metric>& metrics) {
  Bench b(config, {{{Vector3::UnitX(), 0.01, 1000.0}, {Vector3::UnitY(), 0.008, 2000.0}}, {}});
  b.run(reach(Vector3::Zero()), 1.0);
  b.run(reach({0.018, 0.0, 0.0}), 5.0);    // the first plane
  b.run(reach({0.018, 0.015, 0.0}), 6.0);  // slides along it into the second
  b.run(reach({0.0, 0.0, 0.0}), 2.0);
  b.run(reach({0.015, 0.012, 0.0}), 4.0);
  Slope slope;
  slope.take(0, b);
  b.run(reach({0.022, 0.020, 0.0}), 3.0);
  slope.take(1, b);
  metrics.push_back({"corner_displayed_error_x", std::abs(slope.along(Vector3::UnitX()) / 1000.0 - 1.0), ""});
  metrics.push_back({"corner_displayed_error_y", std::abs(slope.along(Vector3::UnitY()) / 2000.0 - 1.0), ""});
  metrics.push_back({"corner_port_energy_min_j", b.view().port_energy_min_j, "J"});
}

void torque(const MasterConfig& config, std::vector<Metric>& metrics) {
  constexpr double kStiffness = 0.4;  // N m/rad
  Bench b(config, {{}, {{Vector3::UnitX(), 0.1, kStiffness}}});
  const auto turn = [](double rad) { return reach(Vector3::Zero(), {rad, 0.0, 0.0}); };
  b.run(turn(0.0), 1.0);
  b.run(turn(0.25), 5.0);
  b.run(turn(0.0), 2.0);
  b.run(turn(0.2), 4.0);
  const auto sample = [&](int) {
    return std::array{log_rotation(b.handle().q_MH).x(), b.out().F_H_M.moment.x()};
  };
  const auto first = sample(0);
  b.run(turn(0.35), 3.0);
  const auto second = sample(1);
  const double displayed = -(second[1] - first[1]) / (second[0] - first[0]);
  metrics.push_back({"torque_displayed_error", std::abs(displayed / kStiffness - 1.0), ""});
  metrics.push_back({"torque_port_energy_min_j", b.view().port_energy_min_j, "J"});
}

}  // namespace

std::vector<Plot> tensor_rendering_plots() {
  return {{.name = "tensor-rendering",
           .csv = "tensor",
           .title = "Pressing on an oblique plane of 2 N/mm with a round-trip time of 2.6 s",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"handle (mm)", {{"x_m", "x", 1e3}, {"y_m", "y", 1e3}}, ""},
                      {"force (N)", {{"fx_n", "x"}, {"fy_n", "y"}, {"fz_n", "z"}}, ""}}}};
}

std::vector<Metric> run_tensor_rendering(const ExperimentRun& run) {
  const MasterConfig config = to_struct(run.config.master());
  std::vector<Metric> metrics;
  Trace trace(run.out, "tensor", {"t_s", "x_m", "y_m", "fx_n", "fy_n", "fz_n", "turn_rad", "moment_nm"});
  oblique(config, trace, metrics);
  trace.close();
  corner(config, metrics);
  torque(config, metrics);
  return metrics;
}

}  // namespace longreach
