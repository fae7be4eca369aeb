#include "deploy/lab/contact/docking_task.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/laboratory.hpp"
#include "slave/simulation/scene/free_bodies.hpp"

namespace longreach {
namespace {

constexpr double kEnd_s = 420.0;
constexpr double kGuardShare =
    1.35;  // maximum contact force that the guard promises, relative to force_guard_n
constexpr double kSlowDrift_m_per_s =
    0.05;  // a target that drifts at most at this speed can be grasped again

SlaveConfig slave_config(const proto::LabConfig& lab) {
  proto::SlaveConfig message = lab.slave();
  proto::SlaveConfig of_scene;
  of_scene.set_scene_file("scenes/dock.txtpb");
  resolve_files(of_scene, find_deploy_folder());
  *message.mutable_scene() = of_scene.scene();
  if (message.robot().mjcf().empty()) *message.mutable_robot() = of_scene.robot();
  return to_struct(message);
}

MasterConfig master_config(const proto::LabConfig& lab) {
  MasterConfig config = to_struct(lab.master());
  config.safety.engage_at_start = true;
  config.mapping.mode = MotionMode::kPosition;
  config.hand.grip = Grip::kFirm;
  return config;
}

// Displaces and turns the target by a random amount, and lets it drift.
void disturb(FreeBodies& bodies, Random random) {
  const auto some = [&random](double sd) {
    return Vector3(sd * random.normal(), sd * random.normal(), sd * random.normal());
  };
  const Pose& start = bodies.body(0).X_start;
  bodies.place(
      0, {start.p + clamp_norm(some(0.015), 0.03), exp_rotation(clamp_norm(some(0.03), 0.06)) * start.q});
  bodies.push(0, some(2e-4), some(1e-4));
}

class Task {
 public:
  Task(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake)
      : slave_(slave_config(config)),
        master_(master_config(config)),
        lab_(master_, slave_, seed),
        mistake_(mistake),
        person_(master_.mapping, master_.rendering, kGuide, mistake, Random(seed).child("operator")) {
    disturb(*lab_.arm().bodies(), Random(seed).child("target"));
    if (const auto energy = bodies().energy()) energy_j_ = energy->stored_j;
    momentum_ = target_momentum();
  }

  DockingOutcome run(Trace* trace) {
    for (std::int64_t tick = 0; lab_.now_s() < kEnd_s && person_.phase() != DockingPhase::kDone; ++tick) {
      show();
      const DockingOperatorOutput hand = person_.step({.t_s = lab_.now_s(),
                                                       .dt_s = lab_.period_s(),
                                                       .master = &lab_.master(),
                                                       .picture = picture_,
                                                       .ghost_m = ghost().p,
                                                       .ghost_rad = log_rotation(ghost().q),
                                                       .rtt_s = lab_.link().rtt_s.value_or(0.0)});
      lab_.drive(hand.target);
      lab_.requests() = hand.requests;
      lab_.step();
      watch();
      if (trace != nullptr && tick % 50 == 0) row(*trace);
    }
    return conclude();
  }

 private:
  // Dimensions of dock.xml.
  static constexpr double kMouth_m = 1.48, kBase_m = 1.6, kTouch_m = 0.29;
  inline static const DockingGuide kGuide{{kMouth_m, -0.35, 0.1}, kBase_m + kTouch_m};
  inline static const Vector3 kFixture{-0.3, 0.0, 0.0}, kStriker{0.55, 0.0, 0.0}, kMiddle{0.9, 0.1, 0.05};

  [[nodiscard]] const FreeBodies& bodies() const { return *lab_.arm().bodies(); }
  [[nodiscard]] Vector3 target_momentum() const {
    return bodies().body(0).mass.mass_kg * bodies().state(0).v_m_per_s;
  }
  /// Present position of a point of the spacecraft, given in the coordinates of dock.xml.
  [[nodiscard]] Vector3 seen(const Vector3& p) const {
    const Pose moved = bodies().displaced(0);
    const Vector3 centre = bodies().body(0).X_start.p;
    return centre + moved.p + moved.q * (kMiddle + p - centre);
  }

  /// The goal relative to the start pose of the tool.
  [[nodiscard]] Pose ghost() const {
    const MasterView& m = lab_.master();
    if (lab_.slave().engagement == 0) return {m.goal_m, exp_rotation(m.goal_rad)};
    const Pose &anchor = lab_.slave().X_WE_anchor, &start = lab_.arm().start_pose();
    return {anchor.p - start.p + m.goal_m, exp_rotation(m.goal_rad) * anchor.q * start.q.conjugate()};
  }

  /// Only what the master has received, as the page draws it.
  void show() {
    const MasterView& m = lab_.master();
    const auto& spacecraft = m.bodies.body[0];
    if (!m.far_known || !spacecraft) return;
    const Pose &start = lab_.arm().start_pose(), &tool = m.far.X_WE, &body = spacecraft->X_WB;
    picture_ = {.tool = {tool.p - start.p, tool.q * start.q.conjugate()},
                .fixture_m = body.p + body.q * kFixture - start.p,
                .striker_m = body.p + body.q * kStriker - start.p,
                .turned_rad = log_rotation(body.q),
                .load = m.far.gripper.holds};
  }

  void watch() {
    const MasterView& m = lab_.master();
    const BodiesContact& met = bodies().contact();
    const double against = -m.spring_force_n.x();
    const Vector3 tool_n = lab_.arm().true_wrench().force, momentum = target_momentum();
    const Vector3 inertial_n = (momentum - momentum_) / lab_.period_s();
    momentum_ = momentum;
    const double force = tool_n.norm(), speed = bodies().state(0).v_m_per_s.norm();
    if (met.holds && !out_.grasped) out_.grasped = true, out_.grasped_s = lab_.now_s();
    if (met.latched && out_.latched_s == 0.0) out_.latched_s = lab_.now_s();
    out_.tool_force_max_n = std::max(out_.tool_force_max_n, force);
    const double pressed_n = met.holds ? Vector3(tool_n + inertial_n).norm() : force;
    out_.pressed_max_n = std::max(out_.pressed_max_n, pressed_n);
    out_.target_speed_max_m_per_s = std::max(out_.target_speed_max_m_per_s, speed);
    const bool pressing = person_.phase() == DockingPhase::kPress && !person_.felt_success();
    if (pressing) out_.felt_success_n = std::max(out_.felt_success_n, against);
    const bool wrong = mistake_ == DockingMistake::kPushesOn ? person_.felt_success()
                                                             : person_.phase() >= DockingPhase::kInsert;
    if (mistake_ != DockingMistake::kNone && wrong)
      out_.felt_mistake_n = std::max(out_.felt_mistake_n, against);
    if (const auto energy = bodies().energy())
      out_.energy_created_j = std::max(out_.energy_created_j,
                                       energy->stored_j + energy->spent_j - energy_j_ - energy->tool_work_j);
    const SafetyState s = lab_.slave().state;
    stopped_ = stopped_ || s == SafetyState::kStopped || s == SafetyState::kFault;
  }

  DockingOutcome conclude() {
    const BodiesContact& met = bodies().contact();
    out_.ended_s = lab_.now_s();
    out_.ended = person_.phase() == DockingPhase::kDone;
    out_.felt_success = person_.felt_success();
    out_.docked = met.latched && !met.holds && out_.ended;
    out_.target_speed_end_m_per_s = bodies().state(0).v_m_per_s.norm();
    out_.port_energy_min_j = lab_.master().port_energy_min_j;
    out_.limit_violations = lab_.slave().limit_violations;
    out_.unconverged = bodies().unconverged();
    out_.safe = !stopped_ && out_.limit_violations == 0 &&
                out_.pressed_max_n <= kGuardShare * slave_.command.force_guard_n &&
                out_.target_speed_max_m_per_s <= 0.1 && out_.target_speed_end_m_per_s <= kSlowDrift_m_per_s &&
                out_.unconverged == 0;
    return out_;
  }

  void row(Trace& trace) const {
    const MasterView& m = lab_.master();
    const Vector3 tool = lab_.slave().X_WE.p - lab_.arm().start_pose().p, fixture = seen(kFixture),
                  striker = seen(kStriker);
    const Vector3 force = lab_.arm().true_wrench().force;
    const BodiesContact& met = bodies().contact();
    trace.row({lab_.now_s(),
               static_cast<double>(person_.phase()),
               static_cast<double>(m.mode),
               tool.x(),
               tool.y(),
               tool.z(),
               fixture.x(),
               fixture.y(),
               fixture.z(),
               striker.x() - kGuide.end_m,
               log_rotation(bodies().displaced(0).q).norm(),
               force.x(),
               force.norm(),
               -m.spring_force_n.x(),
               m.spring_force_n.norm(),
               -m.F_H_M.force.x(),
               met.holds ? 1.0 : 0.0,
               met.latched ? 1.0 : 0.0,
               m.p_MH.x(),
               lab_.slave().in_contact ? 1.0 : 0.0,
               bodies().energy().value_or(BodiesEnergy{.stored_j = std::nan("")}).stored_j,
               m.stiffness_n_per_m,
               m.goal_m.x()});
  }

  SlaveConfig slave_;
  MasterConfig master_;
  Laboratory lab_;
  DockingMistake mistake_;
  DockingOperator person_;
  DockingPicture picture_{};
  double energy_j_ = 0.0;
  Vector3 momentum_ = Vector3::Zero();  // of the target in the previous tick
  bool stopped_ = false;
  DockingOutcome out_{};
};

}  // namespace

Trace docking_trace(const std::filesystem::path& folder, std::string_view name) {
  return {folder, name, {"t_s",         "phase",
                         "mode",        "tool_x_m",
                         "tool_y_m",    "tool_z_m",
                         "fixture_x_m", "fixture_y_m",
                         "fixture_z_m", "striker_m",
                         "turned_rad",  "force_x_n",
                         "force_n",     "felt_n",
                         "spring_n",    "hand_n",
                         "holds",       "latched",
                         "handle_x_m",  "in_contact",
                         "energy_j",    "stiffness_n_per_m",
                         "goal_x_m"}};
}

DockingOutcome dock(const proto::LabConfig& config, std::uint64_t seed, DockingMistake mistake,
                    Trace* trace) {
  return Task(config, seed, mistake).run(trace);
}

}  // namespace longreach
