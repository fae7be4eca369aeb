#include "deploy/lab/rendering/idle_draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/lab/comparison/naive_law.hpp"
#include "deploy/lab/rendering/port_meter.hpp"
#include "master/master_node.hpp"
#include "master/simulation/hand_model.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr double kEngage_s = 0.1;
constexpr double kApproach_s = 0.3;  // start time
constexpr double kApproach_m_per_s = 0.05;
constexpr double kDrive_m_per_s = 0.005;  // out of the dead zone of rate mode
constexpr double kTurn_rad_per_s = 0.5;
constexpr double kSurface_m = 0.002;  // of the goal, from the anchor
constexpr double kSurface_rad = 0.02;
constexpr double kLetsGo_s = 4.0;
constexpr double kLeans_s = 5.0;   // in rate mode, as much as is felt until then
constexpr double kQuiet_s = 10.0;  // and its ripple
constexpr double kStill_s = 8.0;   // judged from here on

/// The slave: it engages on request, and reports a touch when the goal reaches the surface.
class PlayedSlave {
 public:
  explicit PlayedSlave(const IdleDraw& draw) : draw_(draw) {}

  void receive(const MotionCommand& c, std::uint64_t sequence) {
    report_.engagement = c.engagement;
    report_.state = c.request == Request::kEngage ? SafetyState::kEngaged : SafetyState::kObserving;
    touch(report_.translation, draw_.wall_n_per_m, draw_.inward.dot(c.position_m) - kSurface_m, sequence);
    touch(report_.rotation, draw_.wall_nm_per_rad, draw_.inward.dot(c.rotation_rad) - kSurface_rad, sequence);
  }
  [[nodiscard]] const StiffnessReport& report() const { return report_; }

 private:
  void touch(ContactReport& at, double stiffness, double beyond, std::uint64_t sequence) {
    if (at.in_contact() || !(stiffness > 0.0) || beyond <= 0.0) return;
    at.surfaces[0] = {.normal = -draw_.inward,
                      .stiffness = stiffness,
                      .touch_sequence = static_cast<double>(sequence),
                      .touch = 1,
                      .pressed = true};
  }

  const IdleDraw& draw_;
  StiffnessReport report_{};
};

constexpr double kComes_s = 0.5;  // until the handle reaches the surface
/// Further motion, because friction stops the handle before the surface.
constexpr double kFeels_m_per_s = 0.01;

/// A motion of the hand at a constant speed, `since_s` after its start.
double reach(double goal, double speed, double since_s) { return std::clamp(speed * since_s, 0.0, goal); }

class IdleRun {
 public:
  explicit IdleRun(const IdleDraw& draw)
      : draw_(draw), devices_(draw.master.device), node_(draw.master), slave_(draw) {
    node_.render_by(contact_law(draw.master.rendering.law));
    devices_.place(draw.place);
    const DeviceFigures figures = device_figures(draw.master.device, period_s());
    raw_ = draw.raw_damping * figures.mass_kg / period_s();
    raw_turning_ = draw.raw_damping * figures.inertia_kg_m2 / period_s();
    delay_ = std::min<std::size_t>(draw.master.device.delay_samples, kWaiting - 1);
    x_ = devices_.delta().position_m();
    q_ = devices_.spherical().orientation();
  }

  IdleResult run() {
    const auto ticks = static_cast<std::int64_t>(draw_.duration_s / period_s());
    for (std::int64_t i = 0; i < ticks; ++i) step(1e-3 * static_cast<double>(i));
    return result();
  }

 private:
  static constexpr std::size_t kWaiting = 5;
  [[nodiscard]] double period_s() const { return 1.0 / draw_.master.loop.rate_hz; }

  void step(double t_s) {
    const Time now = Time{std::chrono::seconds(100)} + from_seconds(t_s);
    devices_.set_target(target(t_s));
    const HandleState handle = devices_.read(now);
    const Vector3 x = devices_.delta().position_m();
    const Quaternion& q = devices_.spherical().orientation();
    const Wrench& acted = waiting_[delay_];  // force of the motors since the last tick
    linear_.moved(acted.force, x - x_);
    angular_.moved(acted.moment, log_rotation(q * q_.conjugate()));
    x_ = x;
    q_ = q;

    const MasterOutput out = ask(now, t_s, handle);
    Wrench F = out.F_H_M;
    F.force -= raw_ * handle.velocity_m_per_s;
    F.moment -= raw_turning_ * handle.angular_rad_per_s;
    devices_.write(F);
    std::copy_backward(waiting_.begin(), waiting_.end() - 1, waiting_.end());
    waiting_[0] = F;
    judge(t_s, F);
  }

  MasterOutput ask(Time now, double t_s, const HandleState& handle) {
    Received<StiffnessReport> report{.message = slave_.report()};
    MasterInput in;
    in.now = now;
    in.handle = handle;
    in.last_heard = now;
    in.rtt_s = 0.0;
    in.requests.engage = !asked_ && t_s >= kEngage_s;
    asked_ = asked_ || in.requests.engage;
    if (asked_ && ++tick_ % 10 == 0) in.reports = {&report, 1};
    const MasterOutput out = node_.step(in);
    if (out.command) slave_.receive(*out.command, out.sequence);
    return out;
  }

  void judge(double t_s, const Wrench& F) {
    const MasterView& m = node_.view();
    if (t_s < kLeans_s) felt_n_ += 0.01 * (m.spring_force_n.norm() - felt_n_);
    if (!began_ && m.state == SafetyState::kEngaged) {
      began_ = true;
      linear_.engaged();
      angular_.engaged();
    }
    if (began_ && !gone(t_s)) {
      linear_.hold();
      angular_.hold();
    }
    if (t_s < kStill_s) return;
    if (!rests_) rest();
    linear_.watch(F.force, x_, t_s > kQuiet_s + 1.0);
    angular_.watch(F.moment, log_rotation(q_), t_s > kQuiet_s + 1.0);
    injected_ = injected_ || m.damping_injected;
  }

  void rest() {
    const DriveConfig &drive = draw_.master.device.delta.drive, &turn = draw_.master.device.spherical.drive;
    const DeltaDynamics& delta = devices_.delta().dynamics();
    linear_.rests(2.0 * cell_radius(drive.resolution_rad, delta.pose(delta.home_m() + x_).rates));
    const Matrix3 turns = devices_.spherical().dynamics().attitude(q_).rates;
    angular_.rests(2.0 * cell_radius(turn.resolution_rad, turns));
    rests_ = true;
  }

  [[nodiscard]] bool gone(double t_s) const { return draw_.lets_go && t_s >= kLetsGo_s; }

  HandTarget target(double t_s) {
    const Grip grip = draw_.master.hand.grip;
    const double since_s = t_s - kApproach_s;
    HandTarget to;
    to.grip = gone(t_s) ? Grip::kReleased : grip;
    to.position_m = draw_.place.p;
    to.rotation_rad = log_rotation(draw_.place.q);
    if (draw_.wall_n_per_m > 0.0) {
      const bool rate = draw_.master.mapping.mode == MotionMode::kRate;
      to.position_m += (rate ? leaning_m(since_s) : pressing_m(since_s)) * draw_.inward;
    }
    if (draw_.wall_nm_per_rad > 0.0) {
      const double k = wrist_model(grip).stiffness_nm_per_rad, scale = draw_.master.mapping.scale;
      const double goal = kSurface_rad / scale + draw_.press_nm * (1.0 / k + 1.0 / draw_.wall_nm_per_rad);
      to.rotation_rad += reach(goal, kTurn_rad_per_s, since_s) * draw_.inward;
    }
    return to;
  }

  [[nodiscard]] double hand_n_per_m() const { return hand_model(draw_.master.hand.grip).stiffness_n_per_m; }
  [[nodiscard]] double depth_m() const { return draw_.press_n / draw_.wall_n_per_m; }

  /// Target of the hand along the normal of the surface, m: behind the surface as far as needed for the
  /// pressing force, and further while no force is displayed.
  double pressing_m(double since_s) {
    const double through_m = kSurface_m / draw_.master.mapping.scale + depth_m();
    const bool short_of_it =
        since_s > kComes_s && !node_.view().surface_known && !gone(since_s + kApproach_s);
    if (short_of_it) further_m_ += kFeels_m_per_s * period_s();
    return reach(through_m + draw_.press_n / hand_n_per_m(), kApproach_m_per_s, since_s) + further_m_;
  }

  /// In rate mode: out of the dead zone until the goal is that deep, then back, against the displayed force.
  double leaning_m(double since_s) {
    deep_ = deep_ || draw_.inward.dot(node_.view().goal_m) > kSurface_m + depth_m();
    if (!deep_) return driven_m_ = reach(0.02, kDrive_m_per_s, since_s);
    driven_m_ = std::max(0.0, driven_m_ - kApproach_m_per_s * period_s());
    return driven_m_ + std::min(felt_n_, draw_.press_n) / hand_n_per_m();
  }

  [[nodiscard]] IdleResult result() const {
    const MasterView& m = node_.view();
    const RenderingConfig& r = draw_.master.rendering;
    const BehaviourConfig& b = draw_.master.device.behaviour;
    const bool released = draw_.lets_go, rate = draw_.master.mapping.mode == MotionMode::kRate;
    IdleResult out{linear_.result(), angular_.result()};
    const DeviceConfig& d = draw_.master.device;
    const double stop = x_.norm() > b.stop_share * d.delta.workspace_m ? b.stop_n_per_m : 0.0;
    const double turn_stop =
        log_rotation(q_).norm() > b.stop_share * d.spherical.workspace_rad ? b.stop_nm_per_rad : 0.0;
    const double mapping = released ? b.home_n_per_m
                           : rate   ? r.rate_stiffness_n_per_m
                                    : r.friction_stiffness_n_per_m;
    const double turning =
        released ? b.home_nm_per_rad
                 : r.rotational_stiffness_nm_per_rad + (rate ? 0.0 : r.friction_stiffness_nm_per_rad);
    out.translation.allowed = out.translation.count * (mapping + stop + m.stiffness_n_per_m);
    out.rotation.allowed = out.rotation.count * (turning + turn_stop + m.rotational_stiffness_nm_per_rad);
    out.engaged = m.state == SafetyState::kEngaged;
    out.touched = m.surface_known;
    out.at_cap = m.stiffness_clamped;
    out.injected = injected_;
    return out;
  }

  const IdleDraw& draw_;
  SimulatedDevices devices_;
  MasterNode node_;
  PlayedSlave slave_;
  PortMeter linear_, angular_;
  std::array<Wrench, kWaiting> waiting_{};  // commanded, newest first
  Vector3 x_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
  double felt_n_ = 0.0;  // of the surface, smoothed
  double raw_ = 0.0, raw_turning_ = 0.0;
  std::size_t delay_ = 0;
  std::int64_t tick_ = 0;
  double driven_m_ = 0.0, further_m_ = 0.0;
  bool deep_ = false;
  bool rests_ = false, asked_ = false, began_ = false, injected_ = false;
};

}  // namespace

IdleResult run_idle_draw(const IdleDraw& draw) { return IdleRun(draw).run(); }

}  // namespace longreach
