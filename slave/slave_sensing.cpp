#include "slave/slave_sensing.hpp"

#include "slave/sensing/free_moment.hpp"

namespace longreach {
namespace {

/// What may be bias, in W.
Wrench possible_bias(const ToolCompensation& tool, const Quaternion& q_WF) {
  return {kMomentLever_m * (q_WF * tool.moment_tracker().possible_n()), q_WF * tool.tracker().possible_n()};
}

constexpr double kQuietInertia = 0.5;  // touch thresholds that the inertial force may be wrong by
// Longest stall of a robot that does not report the age of its state: what repeats for longer is measured again and again.
constexpr double kRepeated_s = 0.1;

}  // namespace

SlaveSensing::SlaveSensing(const SlaveConfig& config)
    : loop_hz_(config.loop.rate_hz),
      touch_bound_n_(configured_touch_n(config.sensing)),
      touch_nm_(config.sensing.touch_nm),
      release_nm_(config.sensing.release_nm),
      force_(config.sensing.force),
      moment_(measures_moment(config.sensing)),
      watch_(config.sensing, config.command),
      plausibility_(config.sensing, config.command),
      load_(config.sensing, CompensationLimits::of(config.command), config.robot.load_max_kg),
      threshold_(config.sensing),
      moment_threshold_(at_moment_lever(config.sensing)),
      contact_(config.sensing, config.estimator),
      turn_contact_(rotational(config.sensing), config.estimator) {}

void SlaveSensing::configure(const SlaveConfig& config) {
  watch_.configure(config.sensing, config.command);
  plausibility_.configure(config.sensing, config.command);
  load_.configure(config.sensing, CompensationLimits::of(config.command));
  threshold_.configure(config.sensing);
  moment_threshold_.configure(at_moment_lever(config.sensing));
  touch_bound_n_ = configured_touch_n(config.sensing);
  touch_nm_ = config.sensing.touch_nm;
  release_nm_ = config.sensing.release_nm;
  contact_.configure(config.sensing, config.estimator);
  turn_contact_.configure(rotational(config.sensing), config.estimator);
}

void SlaveSensing::begin(const Quaternion& q_before, const Quaternion& q_anchor) {
  if (plausibility_.wrong_sign()) contact_.restart();
  plausibility_.reset();
  turn_contact_.move_origin(log_rotation(q_anchor * q_before.conjugate()));
  contact_.forget_goals();
  turn_contact_.forget_goals();
}

void SlaveSensing::update(const RobotState& robot, const Kinematics& arm, bool may_hold, Time now) {
  if (!force_) {
    tool_.X_WE = arm.forward(robot.joint_rad);
    return;
  }
  const bool rests = robot.joint_rad_per_s.isZero(0.0);
  const bool repeated = !rests && sampled_at_ && robot.joint_rad == before_.joint_rad &&
                        robot.joint_rad_per_s == before_.joint_rad_per_s &&
                        robot.F_F_W.force == before_.F_F_W.force;
  const double since_s = sampled_at_ ? to_seconds(now - *sampled_at_) : 0.0;
  const bool missing = robot.age_s > since_s - 2.0 / loop_hz_;  // nothing has arrived since
  if (repeated && (missing || since_s < kRepeated_s)) return;
  const double elapsed_s = sampled_at_ && !repeated ? since_s : 1.0 / loop_hz_;
  if (!repeated) sampled_at_ = now;
  before_ = robot;
  if (!moment_) before_.F_F_W.moment.setZero();
  tool_ = arm.forward_with_jacobian(robot.joint_rad);
  V_WE_ = {tool_.J.topRows<3>() * robot.joint_rad_per_s, tool_.J.bottomRows<3>() * robot.joint_rad_per_s};
  ok_ = plausible(before_, may_hold, elapsed_s);
  forget_lies();
}

bool SlaveSensing::plausible(const RobotState& robot, bool may_hold, double elapsed_s) {
  const Quaternion q_EW = tool_.X_WE.q.conjugate();
  const SensorWatch::Motion moved{tool_.X_WE.p, V_WE_.linear.norm(), elapsed_s, tool_.X_WE.q};
  if (!watch_.read({q_EW * robot.F_F_W.moment, q_EW * robot.F_F_W.force}, moved)) return false;
  load_.grip(may_hold);
  F_E_W_ = load_.step(robot.F_F_W, tool_.X_WE.q, V_WE_, elapsed_s,
                      {free(), tool_.X_WE, threshold_.touch_n(), touch_nm()});
  if (threshold_.derived()) derive(elapsed_s);
  return watch_.felt(F_E_W_.force, moved, load_.uncertainty_n());
}

void SlaveSensing::derive(double elapsed_s) {
  // When the force or the moment has been zeroed, the detected ones become smaller at once. The free moment depends on
  // both.
  const Wrench now = possible_bias(load_, tool_.X_WE.q);
  Wrench before = now;
  if (load_.tracker().known() && !zeroed_) {
    const Vector3 zeroed_n = tool_.X_WE.q * load_.tracker().bias_n();
    contact_.subtract(zeroed_n);
    before.force = zeroed_n;
    zeroed_ = true;
  }
  if (load_.moment_tracker().known() && !moment_zeroed_) {
    before.moment = kMomentLever_m * (tool_.X_WE.q * load_.moment_tracker().bias_n());
    moment_zeroed_ = true;
  }
  turn_contact_.subtract(free_moment_nm(before) - free_moment_nm(now));
  // The inertial force of tool and load is not noise of the sensor.
  const bool quiet = load_.load_known() && load_.uncertainty_n() < kQuietInertia * threshold_.touch_n();
  threshold_.step(F_E_W_.force, V_WE_.linear.norm(), free() && quiet, elapsed_s);
  contact_.set_thresholds(threshold_.touch_n(), threshold_.release_n());
  if (moment_) derive_moment(elapsed_s, quiet);
}

void SlaveSensing::derive_moment(double elapsed_s, bool quiet) {
  const bool steady = quiet && load_.uncertainty_nm() < kQuietInertia * touch_nm();
  moment_threshold_.step(F_E_W_.moment / kMomentLever_m, V_WE_.linear.norm(), free() && steady, elapsed_s);
  turn_contact_.set_thresholds(touch_nm(), touch_nm() * release_nm_ / touch_nm_);
}

// Configured, or as high as the noise requires.
double SlaveSensing::touch_nm() const {
  return threshold_.derived() ? std::max(touch_nm_, kMomentLever_m * moment_threshold_.touch_n()) : touch_nm_;
}

SensorZero SlaveSensing::sensor_zero() const {
  const BiasTracker& tracker = load_.tracker();
  const double touch_n = threshold_.touch_n();
  return {.count = tracker.zeros(),
          .bias_n = tracker.logged_n(),
          .refused_n = tracker.refused_n(),
          .refused_nm = kMomentLever_m * load_.moment_tracker().refused_n(),
          .missing_m = tracker.missing_m(),
          .drift_n = tracker.uncertainty_n(),
          .touch_n = touch_n,
          .noise_n = threshold_.noise_n(),
          .derived = threshold_.derived() && force_,
          // While something is touched or held, its motion counts as noise as well.
          .noisy = threshold_.derived() && threshold_.known() && free() && !load_.load().holds() &&
                   touch_n > touch_bound_n_};
}

// After a wrong sign, the present force still acts on the guard but is not a surface. After an impossible
// reading, the detection restarts and accepts the force again once it is possible.
void SlaveSensing::forget_lies() {
  for (SlaveContact* contact : {&contact_, &turn_contact_}) {
    if (!ok_) contact->restart();
    if (plausibility_.wrong_sign()) contact->forget_surfaces();
  }
}

void SlaveSensing::step(const SensingInput& in) {
  const bool starting = threshold_.derived() && load_.tracker().starting();
  if (!ok_ || !force_ || !load_.ready() || starting) return;
  contact_.step({tool_.X_WE.p, V_WE_.linear, F_E_W_.force, in.played_sequence, in.scale, in.dt,
                 in.clamps.force_guard, load_.uncertainty_n(), tool_.X_WE.q * load_.tracker().possible_n(),
                 in.news_age_s, plausibility_.coming_n_per_m()});
  const double by_load_n = load_.load().holds() ? load_.uncertainty_n() : 0.0;
  plausibility_.step({tool_.X_WE.p, F_E_W_.force, contact_.in_contact(), in.dt, 0.0, by_load_n},
                     contact_.force(), {in.state, in.let_go, in.still});
  if (moment_) {
    const Vector3 turn = log_rotation(tool_.X_WE.q * in.q_anchor.conjugate());
    turn_contact_.step({turn, V_WE_.angular, free_moment_nm(F_E_W_), in.played_turn_sequence, in.scale, in.dt,
                        in.clamps.moment_guard, load_.uncertainty_nm(),
                        free_moment_nm(possible_bias(load_, tool_.X_WE.q)), in.news_age_s});
  }
  // The zero is updated between engagements.
  if (in.state == SafetyState::kEngaged || !free()) return load_.abandon();
  if (!load_.zeroing()) load_.zero();
}

ContactForce SlaveSensing::pressed(const SetpointLead& lead, bool moves) const {
  ContactForce force = contact_.force();
  force.lead_m = -force.reaction.dot(lead.m());
  force.elsewhere_lead_m = -force.elsewhere.dot(lead.m());
  plausibility_.report(force, lead.m());
  force.load_kg = load_.load_kg();
  if (!moves) force.force_n = force.elsewhere_n = force.retreat_m_per_s = 0.0;
  return force;
}

ContactForce SlaveSensing::turned(const SetpointLead& lead, bool moves) const {
  ContactForce moment = turn_contact_.force();
  if (!moves) moment.force_n = moment.elsewhere_n = 0.0;
  moment.elsewhere_lead_m = -moment.elsewhere.dot(lead.rad());
  moment.lead_m = -moment.reaction.dot(lead.rad());
  moment.trusted = !plausibility_.rests();
  return moment;
}

}  // namespace longreach
